//! What single precision loses far from the origin: the last digits of places, and no other number's.

use crate::motions::{END, Run, WATER, errors_alone, flow, fluid};
use alluvium::simulation::Simulation;
use alluvium::time::{StepSize, VelocityVerlet};
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, Vector};

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
    let as_single = |x: f64| f64::from(x as f32);
    let size = if conditions.is(ONE_CELL) { f64::INFINITY } else { 2.0 * RATIO / side as f64 };
    let in_cell = |x: f64| {
        let corner = if size.is_finite() { (x / size).floor() * size } else { 0.0 };
        corner + as_single(x - corner)
    };
    let mut values = Vec::new();
    let mut curves: [Vec<(f64, f64)>; 4] = Default::default();
    let mut rows = Vec::new();
    for origin in ORIGINS {
        let run = Run { origin, ..Run::new(side, RATIO) };
        let double = error::<f64>(run, None);
        let single = error::<f32>(run, None);
        let places = if conditions.is(UNROUNDED) { double } else { error::<f64>(run, Some(&as_single)) };
        let cells = error::<f64>(run, Some(&in_cell));
        values.push((format!("singles at {origin} m"), (single / places - 1.0) / OF_SINGLES));
        values.push((format!("cells at {origin} m"), (cells / double - 1.0) / OF_CELLS));
        rows.push(format!(
            "from {origin} m on: error {double:.4e} in f64, {single:.4e} in f32, {places:.4e} with places as f32 has \
             them, {cells:.4e} with places relative to cells"
        ));
        for (curve, error) in curves.iter_mut().zip([double, single, places, cells]) {
            // A logarithmic axis has no zero: the box itself is as far.
            curve.push((origin.max(1.0), error));
        }
    }
    let [double, single, places, cells] = curves;
    let chart = Chart::new(name, "distance from the origin [m]", "relative error of the velocity [-]")
        .logarithmic(true, true)
        .with(Series::line("f64", double))
        .with(Series::points("f32", single))
        .with(Series::line("f64, places rounded to f32", places))
        .with(Series::points("f64, places rounded to f32 in cells of 2h", cells));
    rows.into_iter().fold(Measured::values(values), Measured::note).picture(&chart)
}

/// Error of the velocity at the end, with each coordinate `rounded` after each step; NaN if the
/// particles do not come so far.
fn error<T: Real>(run: Run, rounded: Option<&dyn Fn(f64) -> f64>) -> f64 {
    let step = StepSize::fixed(T::of(END / run.steps as f64)).expect("a step");
    let mixture = flow::<T, 2>(run, fluid(WATER.viscosity));
    let mut following = Simulation::new(mixture, VelocityVerlet::new(), step);
    for _ in 0..run.steps {
        if following.step().is_err() {
            return f64::NAN;
        }
        if let Some(rounded) = rounded {
            for x in following.mixture_mut().water_mut().positions_mut() {
                *x = Vector::of(x.as_f64().map(rounded));
            }
        }
    }
    errors_alone(following.mixture())[0]
}
