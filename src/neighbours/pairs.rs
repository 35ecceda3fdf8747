//! A plain list of pairs, for tools and tests.

use super::{NeighbourSearch, Periodic};
use crate::real::Real;
use crate::space::Vector;

/// For each point, the others at `r < radius`, strictly, in an order that does not depend on the search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pairs {
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

impl Pairs {
    /// Finds all pairs with any search; periodic images count, under their owner's index.
    ///
    /// Points outside a periodic box are taken at their place inside. A point with an infinite or
    /// undefined coordinate has no neighbours; no point has if the radius is not positive.
    pub fn find<T: Real, const D: usize>(
        search: &mut dyn NeighbourSearch<T, D>,
        points: &[Vector<T, D>],
        radius: T,
        periodic: &Periodic<T, D>,
    ) -> Self {
        let mut all: Vec<_> = points.iter().map(|&x| periodic.wrap(x)).collect();
        let ghosts = periodic.ghosts(&all, radius);
        all.extend(ghosts.iter().map(|g| all[g.owner as usize] + g.shift).collect::<Vec<_>>());
        let radius2 = if radius > T::ZERO { radius * radius } else { T::ZERO };
        search.rebuild(&all, radius);
        let (mut candidates, mut near) = (Vec::new(), Vec::new());
        let (mut starts, mut neighbours) = (vec![0], Vec::new());
        for (i, x) in all[..points.len()].iter().enumerate() {
            candidates.clear();
            search.candidates(x, &mut candidates);
            near.clear();
            for range in &candidates {
                for j in range.start..range.end.min(all.len() as u32) {
                    if (*x - all[j as usize]).norm2() < radius2 && j as usize != i {
                        near.push(j);
                    }
                }
            }
            // Sorted now, when most candidates are gone; a search may have proposed one twice.
            near.sort_unstable();
            near.dedup();
            let owner = |&j: &u32| (j as usize).checked_sub(points.len()).map_or(j, |g| ghosts[g].owner);
            neighbours.extend(near.iter().map(owner));
            starts.push(neighbours.len());
        }
        Self { starts, neighbours }
    }

    /// The neighbours of point `i`: first those in the box, ascending, then those seen as periodic
    /// images, ascending; a point seen through several images appears as often, also to itself.
    pub fn of(&self, i: usize) -> &[u32] {
        &self.neighbours[self.starts[i]..self.starts[i + 1]]
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many directed pairs there are.
    pub fn count(&self) -> usize {
        self.neighbours.len()
    }
}
