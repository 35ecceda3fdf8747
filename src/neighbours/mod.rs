//! Who is near whom.
//!
//! A [`NeighbourSearch`] only proposes candidates; the library keeps those with `r < radius`,
//! strictly (41), in ascending order. So every search gives the same pairs in the same order, and
//! with them the same bits.

mod brute_force;
mod cell_list;
mod grid;
#[cfg(feature = "kd-tree")]
mod kd_tree;
mod pairs;
mod periodic;
mod sliced_list;

pub use brute_force::BruteForce;
pub use cell_list::CellList;
#[cfg(feature = "kd-tree")]
pub use kd_tree::KdTree;
pub use pairs::Pairs;
pub use periodic::{Ghost, Periodic};

pub(crate) use grid::Grid;
pub(crate) use sliced_list::SlicedList;

use crate::real::Real;
use crate::space::Vector;
use core::fmt::Debug;
use core::ops::Range;

/// Proposes which points may lie near another. Object-safe: bring your own.
pub trait NeighbourSearch<T: Real, const D: usize>: Debug + Send + Sync {
    /// Its name, for logs and benchmarks.
    fn name(&self) -> &'static str;
    /// Indexes `points`; later queries ask for points within `radius` \[m\] of somewhere.
    fn rebuild(&mut self, points: &[Vector<T, D>], radius: T);
    /// Appends ranges of indices that together hold every point at `r ≤ radius` from `place`.
    ///
    /// They may hold more, in any order; few long ranges are faster than many short. A place or a
    /// point with an infinite or undefined coordinate has no neighbours and must not cause a panic;
    /// nor has any if the radius is not positive.
    fn candidates(&self, place: &Vector<T, D>, ranges: &mut Vec<Range<u32>>);
    /// A number that two places share only if they have the same candidates, so that neighbours need
    /// not ask twice; `None` if there is no telling.
    fn cell(&self, _place: &Vector<T, D>) -> Option<usize> {
        None
    }
}

/// The candidates near `place` as ascending, non-touching ranges, each inside one of `allowed`
/// (ascending ranges themselves).
pub(crate) fn sorted_candidates<T: Real, const D: usize>(
    search: &dyn NeighbourSearch<T, D>,
    place: &Vector<T, D>,
    allowed: &[Range<u32>],
    raw: &mut Vec<Range<u32>>,
    sorted: &mut Vec<Range<u32>>,
) {
    raw.clear();
    sorted.clear();
    search.candidates(place, raw);
    if !raw.is_sorted_by_key(|range| range.start) {
        raw.sort_unstable_by_key(|range| range.start);
    }
    for range in raw.iter() {
        for window in allowed {
            // What an earlier range held is not taken twice.
            let done = sorted.last().map_or(0, |last| last.end);
            let (start, end) = (range.start.max(window.start).max(done), range.end.min(window.end));
            if start >= end {
                continue;
            }
            match sorted.last_mut() {
                Some(last) if last.end == start => last.end = end,
                _ => sorted.push(start..end),
            }
        }
    }
}
