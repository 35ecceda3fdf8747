//! A kd-tree, the one of kiddo: an alternative search. The only file that names kiddo.

use super::NeighbourSearch;
use crate::real::Real;
use crate::space::Vector;
use core::marker::PhantomData;
use core::ops::Range;
use kiddo::{ImmutableKdTree, SquaredEuclidean};

/// Points in a balanced tree of boxes: its cost does not depend on how evenly they fill space.
///
/// The tree is double precision for both precisions: every `f32` is an `f64`, so nothing is lost,
/// and the bounds kiddo puts on its numbers stay in this file.
#[derive(Debug)]
pub struct KdTree<T, const D: usize> {
    /// Immutable and rebuilt each time; `None` stands for no points. (The mutable tree of kiddo has
    /// buckets of fixed size and fails on many equal coordinates, hence on a lattice.)
    tree: Option<ImmutableKdTree<f64, D>>,
    /// Squared search radius \[m²\], widened.
    radius2: f64,
    precision: PhantomData<T>,
}

impl<T, const D: usize> Default for KdTree<T, D> {
    fn default() -> Self {
        Self { tree: None, radius2: 0.0, precision: PhantomData }
    }
}

impl<T: Real, const D: usize> NeighbourSearch<T, D> for KdTree<T, D> {
    fn name(&self) -> &'static str {
        "kd-tree"
    }

    fn rebuild(&mut self, points: &[Vector<T, D>], radius: T) {
        // Only finite places have an order; the others have no neighbours.
        let entries: Vec<(u32, [f64; D])> =
            (0..).zip(points).filter(|(_, x)| x.is_finite()).map(|(i, x)| (i, x.as_f64())).collect();
        self.tree = (!entries.is_empty()).then(|| {
            ImmutableKdTree::new_from_entries(&entries)
                .expect("the buckets of an immutable tree grow, and every item has its number")
        });
        // The caller compares r² in its own precision, off by D roundings; the tree sums its bound
        // of a box's distance along the path, off by two roundings a level.
        let rounding = 16.0 * T::EPSILON.as_f64() + 256.0 * f64::EPSILON;
        let radius = radius.as_f64();
        self.radius2 = radius * radius * (1.0 + rounding);
    }

    fn candidates(&self, place: &Vector<T, D>, ranges: &mut Vec<Range<u32>>) {
        let Some(tree) = self.tree.as_ref().filter(|_| place.is_finite()) else { return };
        tree.query(&place.as_f64())
            .within::<SquaredEuclidean<f64>>(self.radius2)
            .unsorted()
            .visit(|hit| ranges.push(hit.item..hit.item + 1));
    }
}
