//! Numbers that have to lie in bands of their own, so that one study can judge them together.

use alluvium::verify::{Expected, Measured};

/// What a study of bands expects: no number further from the middle of its band than half the width.
pub const WITHIN: Expected = Expected::Bound { largest: 1.0 };

/// A number and its band.
#[derive(Clone)]
pub struct Band {
    what: String,
    value: f64,
    low: f64,
    high: f64,
}

impl Band {
    pub fn new(what: impl Into<String>, value: Option<f64>, (low, high): (f64, f64)) -> Self {
        Self { what: what.into(), value: value.unwrap_or(f64::NAN), low, high }
    }
}

/// The largest number, not below zero; NaN if any is.
pub fn worst(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, |worst, x| if x.is_nan() || x > worst { x } else { worst })
}

/// The least and the largest number; NaN if any is.
pub fn range(numbers: impl IntoIterator<Item = f64>) -> [f64; 2] {
    numbers.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
        [if x.is_nan() || x < least { x } else { least }, if x.is_nan() || x > most { x } else { most }]
    })
}

/// Distances from the middle of each band in half widths, with the numbers themselves as a note.
pub fn measured(bands: Vec<Band>) -> Measured {
    let number = |band: &Band| format!("{} {:.4e}", band.what, band.value);
    let note = bands.iter().map(number).collect::<Vec<_>>().join(", ");
    let half_widths = |band: Band| {
        let (middle, half) = (0.5 * (band.low + band.high), 0.5 * (band.high - band.low));
        (band.what, (band.value - middle) / half)
    };
    Measured::values(bands.into_iter().map(half_widths)).note(note)
}
