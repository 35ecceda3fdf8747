//! Sums over neighbours: the discrete form of values and derivatives.

mod corrections;
mod formulas;
mod neighbourhood;
mod operators;
mod pair_sum;
mod record;

pub use corrections::Corrections;
pub use neighbourhood::Neighbourhood;
pub use operators::{Cloud, Form};
pub(crate) use pair_sum::{Aligned, ChunkSums, MOST, PairFormula, Sums, Then, pair_sum};
pub(crate) use record::{Record, add_vector, number, symmetric, vector};
