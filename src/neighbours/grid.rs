//! A regular grid of cells over a cloud of points: where the cell order comes from.

use crate::real::Real;
use crate::space::Vector;

/// Cubic cells of at least the given size, numbered with the first axis fastest.
#[derive(Clone, Debug)]
pub(crate) struct Grid<T, const D: usize> {
    low: Vector<T, D>,
    inverse_size: T,
    pub(crate) counts: [usize; D],
}

impl<T: Real, const D: usize> Grid<T, D> {
    /// Covers `points` with cells of size `size`, or larger ones where the cloud is so sparse that
    /// there would be many more cells than points. Points that are nowhere do not count.
    pub(crate) fn cover(points: &[Vector<T, D>], size: T) -> Self {
        let mut low = points.iter().copied().find(Vector::is_finite).unwrap_or_default();
        let mut high = low;
        for x in points.iter().filter(|x| x.is_finite()) {
            for k in 0..D {
                low[k] = low[k].min(x[k]);
                high[k] = high[k].max(x[k]);
            }
        }
        let most = 4 * points.len() + 1024;
        let mut size = size;
        loop {
            let mut total = 1.0;
            let mut counts = [1; D];
            for k in 0..D {
                let cells = ((high[k] - low[k]).as_f64() / size.as_f64()).floor() + 1.0;
                total *= cells;
                counts[k] = if cells < 1e9 { cells as usize } else { usize::MAX };
            }
            if total <= most as f64 || !total.is_finite() && size.as_f64() > 1e300 {
                return Self { low, inverse_size: T::ONE / size, counts };
            }
            size = size + size;
        }
    }

    /// How many cells there are.
    pub(crate) fn len(&self) -> usize {
        self.counts.iter().product()
    }

    /// The cell coordinates of a place; places outside belong to the nearest cell.
    pub(crate) fn coordinates(&self, x: &Vector<T, D>) -> [usize; D] {
        core::array::from_fn(|k| {
            let cell = ((x[k] - self.low[k]) * self.inverse_size).as_f64();
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
