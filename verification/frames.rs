//! Another frame to see a cloud from, and what may be done wrong on the way into it.

use alluvium::neighbours::{CellList, NeighbourSearch};
use alluvium::{Real, SymTensor, Vector};
use core::ops::Range;

/// Another frame: places and directions turned (or mirrored) by an orthogonal matrix, about the origin, and a
/// uniform velocity \[m/s\] on top.
#[derive(Clone, Copy, Debug)]
pub struct Frame<const D: usize> {
    pub turn: [[f64; D]; D],
    pub velocity: [f64; D],
}

impl<const D: usize> Frame<D> {
    /// The frame everything is defined in.
    pub fn own() -> Self {
        let turn = core::array::from_fn(|a| core::array::from_fn(|b| f64::from(u8::from(a == b))));
        Self { turn, velocity: [0.0; D] }
    }
    pub fn vector(&self, v: [f64; D]) -> [f64; D] {
        core::array::from_fn(|a| (0..D).map(|b| self.turn[a][b] * v[b]).sum())
    }
    /// The inverse of [`vector`](Self::vector).
    pub fn back(&self, v: [f64; D]) -> [f64; D] {
        core::array::from_fn(|a| (0..D).map(|b| self.turn[b][a] * v[b]).sum())
    }
    /// R t Rᵀ, the directions beyond D left as they are.
    pub fn tensor(&self, t: SymTensor<f64>) -> SymTensor<f64> {
        let r = |a: usize, b: usize| match (a < D, b < D) {
            (true, true) => self.turn[a][b],
            _ => f64::from(u8::from(a == b)),
        };
        let mut turned = SymTensor::zero();
        for (a, b) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)] {
            let terms = (0..3).flat_map(|c| (0..3).map(move |d| (c, d)));
            turned.0[SymTensor::<f64>::index(a, b)] =
                terms.map(|(c, d)| r(a, c) * t.0[SymTensor::<f64>::index(c, d)] * r(b, d)).sum();
        }
        turned
    }
}

/// What is done wrong on the way into another frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// Gravity stays as it was.
    GravityStays,
    /// The stress of the soil stays as it was.
    StressStays,
    /// Artificial viscosity takes the absolute velocity for a part of the speed of its signals.
    AbsoluteSpeed,
    /// The search forgets the neighbours in one corner.
    Corner,
    /// The search sees 1 % less far than the kernel.
    ShortSighted,
    /// Of two particles the velocities are those of each other.
    MixedUp,
}

/// The cell list, whose candidates lack those in one corner: as if one of the cells around were forgotten.
#[derive(Debug, Default)]
pub struct OneCornerShort<T: Real, const D: usize> {
    cells: CellList<T, D>,
    points: Vec<Vector<T, D>>,
    radius: T,
}

impl<T: Real, const D: usize> NeighbourSearch<T, D> for OneCornerShort<T, D> {
    fn name(&self) -> &'static str {
        "one corner short"
    }
    fn rebuild(&mut self, points: &[Vector<T, D>], radius: T) {
        self.cells.rebuild(points, radius);
        self.points = points.to_vec();
        self.radius = radius;
    }
    fn candidates(&self, place: &Vector<T, D>, ranges: &mut Vec<Range<u32>>) {
        let mut proposed = Vec::new();
        self.cells.candidates(place, &mut proposed);
        let far = self.radius * T::of(0.4);
        for j in proposed.into_iter().flatten() {
            let apart = self.points[j as usize] - *place;
            if !(apart[0] > far && apart[1] > far) {
                ranges.push(j..j + 1);
            }
        }
    }
}
