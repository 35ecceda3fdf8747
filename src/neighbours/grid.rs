//! A regular grid of cells over a cloud of points: where the cell order comes from.

use crate::real::Real;
use crate::space::Vector;

/// Cubic cells of at least the given size, numbered with the first axis fastest.
#[derive(Clone, Debug)]
pub(crate) struct Grid<T, const D: usize> {
    low: Vector<T, D>,
    // Double precision, so that rounding in the cell number is known: see `cover`.
    inverse_size: f64,
    pub(crate) counts: [usize; D],
}

/// Particles looked at to tell where the bulk of a sparse cloud is.
const SAMPLE: usize = 4096;

impl<T: Real, const D: usize> Grid<T, D> {
    /// Covers `points` with cells such that two places less than `size` apart along each axis are in
    /// the same or in adjacent cells.
    ///
    /// Where there would be many more cells than points, the grid covers the bulk of the cloud only
    /// (what flew off counts to the outermost cells), with larger cells if need be. Places that are
    /// not finite do not matter; a size that is not positive is taken as zero.
    pub(crate) fn cover(points: &[Vector<T, D>], size: T) -> Self {
        let most = (4.0 * points.len() as f64 + 1024.0).min(f64::from(u32::MAX / 2));
        let size = size.as_f64().max(0.0);
        let mut bounds = bounds(points);
        if cells(&bounds, widened(&bounds, size)).iter().product::<f64>() > most {
            bounds = bulk(points, &bounds);
        }
        let mut size = widened(&bounds, size);
        while cells(&bounds, size).iter().product::<f64>() > most {
            size += size;
        }
        Self {
            low: Vector::of(bounds.map(|(low, _)| low)),
            inverse_size: 1.0 / size,
            counts: cells(&bounds, size).map(|count| count as usize),
        }
    }

    /// How many cells there are.
    pub(crate) fn len(&self) -> usize {
        self.counts.iter().product()
    }

    /// The cell coordinates of a place; places outside belong to the nearest cell.
    pub(crate) fn coordinates(&self, x: &Vector<T, D>) -> [usize; D] {
        core::array::from_fn(|k| {
            let cell = (x[k].as_f64() - self.low[k].as_f64()) * self.inverse_size;
            // A float-to-integer cast saturates, and turns NaN into 0.
            (cell as usize).min(self.counts[k] - 1)
        })
    }

    /// The number of a cell.
    pub(crate) fn index(&self, coordinates: [usize; D]) -> usize {
        (0..D).rev().fold(0, |index, k| index * self.counts[k] + coordinates[k])
    }

    /// The order of `points[range]` by cell, stable within one.
    pub(crate) fn order(
        &self,
        points: &[Vector<T, D>],
        range: core::ops::Range<usize>,
        order: &mut Vec<u32>,
    ) {
        let cells: Vec<u32> =
            points[range.clone()].iter().map(|x| self.index(self.coordinates(x)) as u32).collect();
        let mut starts = vec![0u32; self.len() + 1];
        for &cell in &cells {
            starts[cell as usize + 1] += 1;
        }
        for cell in 0..self.len() {
            starts[cell + 1] += starts[cell];
        }
        let base = order.len();
        order.resize(base + cells.len(), 0);
        for (offset, &cell) in cells.iter().enumerate() {
            let slot = &mut starts[cell as usize];
            order[base + *slot as usize] = (range.start + offset) as u32;
            *slot += 1;
        }
    }
}

/// The lowest and highest coordinate of the finite points, along each axis.
fn bounds<T: Real, const D: usize>(points: &[Vector<T, D>]) -> [(f64, f64); D] {
    let mut bounds = [(f64::INFINITY, f64::NEG_INFINITY); D];
    for x in points.iter().filter(|x| x.is_finite()) {
        for (bound, x) in bounds.iter_mut().zip(x.as_f64()) {
            *bound = (bound.0.min(x), bound.1.max(x));
        }
    }
    bounds.map(|(low, high)| if low <= high { (low, high) } else { (0.0, 0.0) })
}

/// `bounds` without what lies further out than half the width of the inner 126/128 of the points.
fn bulk<T: Real, const D: usize>(points: &[Vector<T, D>], bounds: &[(f64, f64); D]) -> [(f64, f64); D] {
    let sample = points.iter().step_by(points.len() / SAMPLE + 1).filter(|x| x.is_finite());
    let sample: Vec<[f64; D]> = sample.map(Vector::as_f64).collect();
    let tail = (sample.len() / 128).max(1);
    if sample.len() <= 2 * tail {
        return *bounds;
    }
    core::array::from_fn(|k| {
        let mut axis: Vec<f64> = sample.iter().map(|x| x[k]).collect();
        axis.sort_unstable_by(f64::total_cmp);
        let (low, high) = (axis[tail], axis[axis.len() - 1 - tail]);
        let half = 0.5 * extent((low, high));
        // Rounded to the precision of the points, as the grid keeps its low corner.
        let low = T::of((low - half).max(bounds[k].0)).as_f64();
        (low, (high + half).min(bounds[k].1))
    })
}

fn extent((low, high): (f64, f64)) -> f64 {
    (high - low).clamp(0.0, f64::MAX)
}

/// How many cells of `size` it takes along each axis.
fn cells<const D: usize>(bounds: &[(f64, f64); D], size: f64) -> [f64; D] {
    bounds.map(|bound| (extent(bound) / size).floor() + 1.0)
}

/// `size` and what rounding can shift two cell boundaries: the difference to the low corner, the
/// inverse of the size and their product are off by half an epsilon each. Never zero.
fn widened<const D: usize>(bounds: &[(f64, f64); D], size: f64) -> f64 {
    let longest = bounds.iter().fold(0.0, |longest: f64, &bound| longest.max(extent(bound)));
    (size + 4.0 * f64::EPSILON * (size + longest)).max(f64::MIN_POSITIVE)
}
