//! A search with a mistake.

use crate::neighbours::NeighbourSearch;
use crate::real::Real;
use crate::space::Vector;
use core::ops::Range;

/// A search that proposes nobody beyond a part of the radius.
#[derive(Debug)]
pub struct ShortSighted<T, const D: usize> {
    search: Box<dyn NeighbourSearch<T, D>>,
    points: Vec<Vector<T, D>>,
    radius: T,
    part: f64,
}

impl<T: Real, const D: usize> ShortSighted<T, D> {
    /// Of what `search` proposes, only those within this `part` \[-\] of the radius.
    pub fn new(search: Box<dyn NeighbourSearch<T, D>>, part: f64) -> Self {
        Self { search, points: Vec::new(), radius: T::ZERO, part }
    }
}

impl<T: Real, const D: usize> NeighbourSearch<T, D> for ShortSighted<T, D> {
    fn name(&self) -> &'static str {
        "short-sighted"
    }
    fn rebuild(&mut self, points: &[Vector<T, D>], radius: T) {
        self.search.rebuild(points, radius);
        self.points = points.to_vec();
        self.radius = radius * T::of(self.part);
    }
    fn candidates(&self, place: &Vector<T, D>, ranges: &mut Vec<Range<u32>>) {
        let mut proposed = Vec::new();
        self.search.candidates(place, &mut proposed);
        for j in proposed.into_iter().flatten() {
            if (self.points[j as usize] - *place).norm2() <= self.radius * self.radius {
                ranges.push(j..j + 1);
            }
        }
    }
}
