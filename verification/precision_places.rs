//! What single precision loses far from the origin: the last digits of places, and no other number's.

use crate::kept_places::Places;
use crate::motions::Run;
use crate::precision::{Motion, error};
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};

const ONE_CELL: &str = "one cell from the origin to the end of the box";
const UNROUNDED: &str = "places of the comparison not rounded";

/// Where the box of length one begins \[m\].
const ORIGINS: [f64; 4] = [0.0, 1e2, 1e3, 4e3];
const RATIO: f64 = 2.0;
/// Largest relative difference of errors: of singles and of doubles whose places are rounded, which differ in
/// the roundings that are left to chance; of places relative to a cell and of doubles.
const OF_SINGLES: f64 = 0.05;
const OF_CELLS: f64 = 1e-3;

pub fn studies() -> Vec<Study> {
    vec![
        study("precision/places/24", 24).level(Level::Quick),
        study("precision/places/48", 48).level(Level::Full),
    ]
}

fn study(name: &'static str, side: usize) -> Study {
    Study::new(
        name,
        "far from the origin single precision has the error of double precision whose places, and nothing else, \
         are rounded to singles after each step; rounded relative to cells of 2h instead, they have the error of doubles \
         anywhere (values: differences of errors, over 5 % for singles and 0.1 % for cells)",
        move |conditions| compare(name, side, conditions),
    )
    .equations(&["52", "58", "72"])
    .source("the same run in double precision; the flow repeats itself from length to length")
    .expect(Expected::Bound { largest: 1.0 })
    .mutant(ONE_CELL)
    .mutant(UNROUNDED)
}

fn compare(name: &str, side: usize, conditions: &Conditions) -> Measured {
    let cell = if conditions.is(ONE_CELL) { f64::INFINITY } else { 2.0 * RATIO / side as f64 };
    let mut values = Vec::new();
    let mut curves: [Vec<(f64, f64)>; 4] = Default::default();
    for origin in ORIGINS {
        let run = Run { origin, ..Run::new(side, RATIO) };
        let kept = |cell: f64| error::<f64, 2>(Motion::Water, Run { kept: Places::Singles { cell }, ..run });
        let double = error::<f64, 2>(Motion::Water, run);
        let single = error::<f32, 2>(Motion::Water, run);
        let places = if conditions.is(UNROUNDED) { double } else { kept(f64::INFINITY) };
        let cells = kept(cell);
        values.push((format!("singles at {origin} m"), (single / places - 1.0) / OF_SINGLES));
        values.push((format!("cells at {origin} m"), (cells / double - 1.0) / OF_CELLS));
        for (curve, error) in curves.iter_mut().zip([double, single, places, cells]) {
            // A logarithmic axis has no zero: the box itself is as far.
            curve.push((origin.max(1.0), error));
        }
    }
    let row = |k: usize| {
        let [double, single, places, cells] = curves.each_ref().map(|curve| format!("{:.4e}", curve[k].1));
        [ORIGINS[k].to_string(), double, single, places, cells]
    };
    let heading = [
        "begins at [m]",
        "f64",
        "f32",
        "f64, places rounded to f32",
        "f64, places rounded to f32 in cells of 2h",
    ];
    let measured = Measured::values(values).table(heading, (0..ORIGINS.len()).map(row));
    let [double, single, places, cells] = curves;
    let chart = Chart::new(name, "distance from the origin [m]", "relative error of the velocity [-]")
        .logarithmic(true, true)
        .with(Series::line("f64", double))
        .with(Series::points("f32", single))
        .with(Series::line("f64, places rounded to f32", places))
        .with(Series::points("f64, places rounded to f32 in cells of 2h", cells));
    measured.picture(&chart)
}
