//! Sums over neighbours: the discrete form of values and derivatives.

mod pair_sum;
#[cfg(test)]
mod tests;

pub(crate) use pair_sum::{Aligned, MOST, PairFormula, Sums, pair_sum};
