//! Cells of the size of the support: the default search.

use super::{Grid, NeighbourSearch};
use crate::real::Real;
use crate::space::Vector;
use core::ops::Range;

/// Points in cells of the search radius; a query looks at the 3ᴰ cells around it.
///
/// Fastest when the points come sorted by cell, in a few stretches, as the library keeps them:
/// a row of cells is then one range. Any order of points works.
#[derive(Clone, Debug)]
pub struct CellList<T, const D: usize> {
    grid: Grid<T, D>,
    stretches: Vec<Stretch>,
    /// The points by cell, when they do not come in few sorted stretches.
    order: Option<Vec<u32>>,
}

/// A run of points sorted by cell, and where each cell begins in it.
#[derive(Clone, Debug)]
struct Stretch {
    starts: Vec<u32>,
}

/// More stretches than this are sorted into one.
const MOST_STRETCHES: usize = 4;

impl<T: Real, const D: usize> Default for CellList<T, D> {
    fn default() -> Self {
        Self { grid: Grid::cover(&[], T::ONE), stretches: Vec::new(), order: None }
    }
}

impl<T: Real, const D: usize> NeighbourSearch<T, D> for CellList<T, D> {
    fn name(&self) -> &'static str {
        "cell-list"
    }

    fn rebuild(&mut self, points: &[Vector<T, D>], radius: T) {
        self.grid = Grid::cover(points, radius);
        let mut cells: Vec<u32> =
            points.iter().map(|x| self.grid.index(self.grid.coordinates(x)) as u32).collect();
        self.order = None;
        let breaks = cells.windows(2).filter(|pair| pair[0] > pair[1]).count();
        if breaks >= MOST_STRETCHES {
            let mut order = Vec::with_capacity(points.len());
            self.grid.order(points, 0..points.len(), &mut order);
            cells = order.iter().map(|&i| cells[i as usize]).collect();
            self.order = Some(order);
        }
        self.stretches.clear();
        let mut begin = 0;
        for end in 1..=cells.len() {
            if end == cells.len() || cells[end - 1] > cells[end] {
                self.stretches.push(Stretch::new(&cells, begin..end, self.grid.len()));
                begin = end;
            }
        }
    }

    fn cell(&self, place: &Vector<T, D>) -> Option<usize> {
        Some(self.grid.index(self.grid.coordinates(place)))
    }

    fn candidates(&self, place: &Vector<T, D>, ranges: &mut Vec<Range<u32>>) {
        if !place.is_finite() {
            return; // it has no neighbours, but a cell full of its like could take for ever to tell
        }
        let centre = self.grid.coordinates(place);
        let counts = &self.grid.counts;
        let low: [usize; D] = core::array::from_fn(|k| centre[k].saturating_sub(1));
        let high: [usize; D] = core::array::from_fn(|k| (centre[k] + 1).min(counts[k] - 1));
        for stretch in &self.stretches {
            let mut row = low;
            'rows: loop {
                row[0] = low[0];
                let first = self.grid.index(row);
                let last = first + (high[0] - low[0]);
                let range = stretch.starts[first]..stretch.starts[last + 1];
                match &self.order {
                    _ if range.is_empty() => {}
                    None => ranges.push(range),
                    Some(order) => ranges
                        .extend(order[range.start as usize..range.end as usize].iter().map(|&i| i..i + 1)),
                }
                for k in 1..=D {
                    if k == D {
                        break 'rows;
                    }
                    row[k] += 1;
                    if row[k] <= high[k] {
                        break;
                    }
                    row[k] = low[k];
                }
            }
        }
    }
}

impl Stretch {
    fn new(cells: &[u32], range: Range<usize>, count: usize) -> Self {
        let mut starts = vec![0; count + 1];
        let mut next = 0;
        for (position, &cell) in cells[range.clone()].iter().enumerate() {
            while next <= cell as usize {
                starts[next] = (range.start + position) as u32;
                next += 1;
            }
        }
        for start in &mut starts[next..] {
            *start = range.end as u32;
        }
        Self { starts }
    }
}
