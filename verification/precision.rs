//! Single precision against double, resolution by resolution, and how fast each is.

use crate::motions::{Run, WATER, alone, darcy, errors_alone, errors_together, fluid, skeleton, together};
use alluvium::Real;
use alluvium::time::VelocityVerlet;
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use std::time::Instant;

const SOURCE: &str = "the same run in double precision";
const FAR: &str = "a thousand lengths from the origin";

/// Which manufactured motion.
#[derive(Clone, Copy)]
enum Motion {
    Water,
    Both,
}

pub fn studies() -> Vec<Study> {
    let study = |name: &str, motion, sides, ratio, largest| {
        let name = format!("precision/manufactured/{name}");
        precision(name, motion, sides, ratio).expect(Expected::Bound { largest }).mutant(FAR)
    };
    vec![
        study("h = 2 dx", Motion::Water, &[12, 24, 48], 2.0, 1e-3).level(Level::Quick),
        study("h = 2 dx/fine", Motion::Water, &[16, 32, 64, 96], 2.0, 1e-3).level(Level::Full),
        // At h = dx disorder grows, out of nothing but rounding: by 64 particles single precision is lost.
        study("h = dx", Motion::Water, &[16, 32, 48], 1.0, 0.1)
            .level(Level::Full)
            .falls_short(Expected::Bound { largest: 0.17 }, "disorder grows out of rounding"),
        study("both/h = 2 dx", Motion::Both, &[12, 24], 2.0, 1e-3).level(Level::Quick),
        study("both/h = 2 dx/fine", Motion::Both, &[16, 32, 48], 2.0, 1e-3).level(Level::Full),
    ]
}

fn precision(name: String, motion: Motion, sides: &'static [usize], ratio: f64) -> Study {
    let title = name.clone();
    let of = match motion {
        Motion::Water => "flow of water",
        Motion::Both => "motion of soil and water",
    };
    Study::new(
        name,
        format!(
            "a manufactured {of} has the same error in single precision as in double (values: relative \
             difference of the two errors, by particles along an edge)"
        ),
        move |conditions| {
            let (single, double) = (runs::<f32>(motion, sides, ratio, conditions), runs::<f64>(motion, sides, ratio, conditions));
            let difference = |k: usize| (format!("{}", sides[k]), single[k].error / double[k].error - 1.0);
            let measured = Measured::values((0..sides.len()).map(difference));
            let row = |(single, double): (&Ran, &Ran)| {
                format!(
                    "{} particles along an edge: error {:.4e} at {:.2e} particle-steps per second in f64, {:.4e} at \
                     {:.2e} in f32, sources included",
                    (1.0 / double.spacing).round(), double.error, double.speed, single.error, single.speed
                )
            };
            let measured = single.iter().zip(&double).map(row).fold(measured, Measured::note);
            let points = |runs: &[Ran]| runs.iter().map(|ran| (ran.spacing, ran.error)).collect::<Vec<_>>();
            let named = |what: &str, runs: &[Ran]| {
                format!("{what}, {:.1e} particle-steps/s", runs.last().map_or(f64::NAN, |ran| ran.speed))
            };
            measured.picture(
                &Chart::new(&title, "resolution [m]", "relative error of the velocity [-]")
                    .logarithmic(true, true)
                    .with(Series::line(&named("f64", &double), points(&double)))
                    .with(Series::points(&named("f32", &single), points(&single))),
            )
        },
    )
    .equations(&["52", "58"])
    .source(SOURCE)
}

/// One run.
struct Ran {
    spacing: f64,
    /// Of the velocity (of both: with that of the stress), relative.
    error: f64,
    /// Particle-steps per second.
    speed: f64,
}

fn runs<T: Real>(motion: Motion, sides: &[usize], ratio: f64, conditions: &Conditions) -> Vec<Ran> {
    let ran = |&side: &usize| {
        let origin = if conditions.is(FAR) { 1e3 } else { 0.0 };
        let run = Run { origin, ..Run::new(side, ratio) };
        let start = Instant::now();
        let (error, particles) = match motion {
            Motion::Water => {
                let mixture = alone::<T, 2>(run, fluid(WATER.viscosity), VelocityVerlet::new());
                (errors_alone(&mixture)[0], mixture.water().len())
            }
            Motion::Both => {
                let mixture = together::<T, 2, _>(run, skeleton(), darcy(1.0), VelocityVerlet::new());
                (errors_together(&mixture)[0], mixture.soil().len() + mixture.water().len())
            }
        };
        let speed = (particles * run.steps) as f64 / start.elapsed().as_secs_f64();
        Ran { spacing: 1.0 / side as f64, error, speed }
    };
    sides.iter().map(ran).collect()
}
