//! Sums over neighbours: the discrete form of values and derivatives.

mod neighbourhood;
mod pair_sum;

pub use neighbourhood::Neighbourhood;
pub(crate) use pair_sum::{Aligned, MOST, PairFormula, Sums, pair_sum};
