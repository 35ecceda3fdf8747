//! Places with fewer digits than a run has.

use alluvium::material::Material;
use alluvium::mixture::Phase;
use alluvium::{Real, Vector};

/// How many digits of a place are kept.
#[derive(Clone, Copy, Debug)]
pub enum Places {
    /// Those of the run's precision.
    Own,
    /// Those of singles relative to the corner of a cell of this length \[m\]; if it is infinite, to the origin.
    Singles { cell: f64 },
}

impl Places {
    /// Between two steps.
    pub fn keep<T: Real, const D: usize, M: Material<T>>(self, phase: &mut Phase<T, D, M>) {
        let Self::Singles { cell } = self else { return };
        let rounded = |x: f64| {
            let corner = if cell.is_finite() { (x / cell).floor() * cell } else { 0.0 };
            corner + f64::from((x - corner) as f32)
        };
        phase.positions_mut().iter_mut().for_each(|x| *x = Vector::of(x.as_f64().map(rounded)));
    }
}
