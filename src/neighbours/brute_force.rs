//! Every point is a candidate: the oracle the others are held against.

use super::NeighbourSearch;
use crate::real::Real;
use crate::space::Vector;
use core::ops::Range;

/// Proposes every point. Quadratic cost; use it to check another search.
#[derive(Clone, Copy, Debug, Default)]
pub struct BruteForce {
    count: u32,
}

impl<T: Real, const D: usize> NeighbourSearch<T, D> for BruteForce {
    fn name(&self) -> &'static str {
        "brute-force"
    }
    fn rebuild(&mut self, points: &[Vector<T, D>], _: T) {
        self.count = points.len() as u32;
    }
    fn cell(&self, _: &Vector<T, D>) -> Option<usize> {
        Some(0)
    }
    fn candidates(&self, _: &Vector<T, D>, ranges: &mut Vec<Range<u32>>) {
        ranges.push(0..self.count);
    }
}
