//! Between what has moved and what has stayed.

use super::Pile;
use std::collections::BTreeMap;

/// The line on the soil of the start that parts what has moved from what has stayed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FailureLine {
    points: Vec<(f64, f64)>,
}

impl FailureLine {
    /// Through points x, y \[m\], as published.
    pub fn new(mut points: Vec<(f64, f64)>) -> Self {
        points.sort_by(|a, b| a.1.total_cmp(&b.1));
        Self { points }
    }

    /// Where, row by row, the displacement first exceeds `moved` \[m\]; in three dimensions its mean over
    /// what lies behind each other. A row that moved as a whole, or not at all, has no point.
    pub fn between(start: &Pile, end: &Pile, moved: f64) -> Self {
        let cell = |x: f64| (x / start.spacing()).floor() as i64;
        let mut rows: BTreeMap<i64, BTreeMap<i64, Cell>> = BTreeMap::new();
        for before in start.grains() {
            let Some(after) = end.grain(before.id) else { continue };
            let [[x, y], [to_x, to_y]] = [before.place, after.place];
            let row = rows.entry(cell(y)).or_default();
            row.entry(cell(x)).or_default().add([x, y, (to_x - x).hypot(to_y - y)]);
        }
        Self::new(rows.values().filter_map(|row| crossing(row.values(), moved)).collect())
    }

    /// Its points \[m\], the lowest first.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Its lowest point \[m\]: where it comes out at the floor.
    pub fn foot(&self) -> Option<f64> {
        self.points.first().map(|point| point.0)
    }

    /// The straight line through it: its angle with the floor \[°\], and where it meets the floor \[m\].
    pub fn straight(&self) -> Option<(f64, f64)> {
        let n = self.points.len() as f64;
        let mean = |of: fn(&(f64, f64)) -> f64| self.points.iter().map(of).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let square: f64 = self.points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
        let cross: f64 = self.points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
        let slope = cross / square;
        let found = slope.is_finite() && slope != 0.0;
        found.then(|| ((-slope).atan().to_degrees(), x - y / slope))
    }
}

/// Means of x, y and displacement of what started in one cell.
#[derive(Clone, Copy, Default)]
struct Cell {
    sum: [f64; 3],
    count: f64,
}

impl Cell {
    fn add(&mut self, values: [f64; 3]) {
        self.sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
        self.count += 1.0;
    }

    fn means(&self) -> [f64; 3] {
        self.sum.map(|sum| sum / self.count)
    }
}

/// The first place along a row where the displacement exceeds `moved`, straight between cells.
fn crossing<'a>(row: impl Iterator<Item = &'a Cell>, moved: f64) -> Option<(f64, f64)> {
    let mut before: Option<[f64; 3]> = None;
    for cell in row.map(Cell::means) {
        if cell[2] > moved {
            let [x, y, d] = before?;
            let part = (moved - d) / (cell[2] - d);
            return Some((x + (cell[0] - x) * part, y + (cell[1] - y) * part));
        }
        before = Some(cell);
    }
    None
}
