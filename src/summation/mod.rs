//! Sums over neighbours: the discrete form of values and derivatives.

mod corrections;
mod formulas;
mod neighbourhood;
mod operators;
mod pair_sum;

pub use corrections::Corrections;
pub use neighbourhood::Neighbourhood;
pub use operators::{Cloud, Form};
pub(crate) use pair_sum::{Aligned, MOST, PairFormula, Sums, pair_sum};
