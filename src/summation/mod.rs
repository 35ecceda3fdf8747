//! Sums over neighbours: the discrete form of values and derivatives.

mod neighbourhood;
mod pair_sum;
mod record;

pub use neighbourhood::Neighbourhood;
pub(crate) use pair_sum::{Aligned, MOST, PairFormula, Sums, pair_sum};
pub(crate) use record::{Record, add_vector, number, vector};
