//! Single precision against double, resolution by resolution; where it stops converging, what places relative to
//! cells would bring, and how fast each is.

use crate::kept_places::Places;
use crate::motions::{Run, WATER, darcy, errors_alone, errors_together, flow, fluid, mixed, skeleton};
use alluvium::Real;
use alluvium::parallel::Threads;
use alluvium::time::VelocityVerlet;
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study, observed_orders};
use cpu_time::ThreadTime;

const SOURCE: &str = "the same run in double precision";
const FAR: &str = "a thousand lengths from the origin";
const ONE_CELL: &str = "one cell from the origin to the end of the box";

/// Which manufactured motion.
#[derive(Clone, Copy)]
pub enum Motion {
    Water,
    Both,
}

/// It, followed with more and more particles along an edge.
#[derive(Clone, Copy)]
struct Ladder {
    motion: Motion,
    sides: &'static [usize],
    /// h/Δx.
    ratio: f64,
    /// Where the box of length one begins \[m\].
    origin: f64,
}

pub fn studies() -> Vec<Study> {
    let (water, both) = (Motion::Water, Motion::Both);
    let of = |motion, sides: &'static [usize]| Ladder { motion, sides, ratio: 2.0, origin: 0.0 };
    let far = |metres, ladder| Ladder { origin: metres, ..ladder };
    // At h = dx disorder grows, out of nothing but rounding: by 64 particles single precision is lost.
    let narrow = Ladder { ratio: 1.0, ..of(water, &[16, 32, 48]) };
    vec![
        as_double::<2>("h = 2 dx", of(water, &[12, 24, 48]), 1e-3).level(Level::Quick),
        as_double::<2>("h = 2 dx/fine", of(water, &[16, 32, 64, 96]), 1e-3),
        as_double::<3>("h = 2 dx/3d", of(water, &[8, 12, 16]), 1e-3),
        as_double::<2>("h = dx", narrow, 0.1)
            .falls_short(Expected::Bound { largest: 0.17 }, "disorder grows out of rounding"),
        as_double::<2>("both/h = 2 dx", of(both, &[12, 24]), 1e-3).level(Level::Quick),
        as_double::<2>("both/h = 2 dx/fine", of(both, &[16, 32, 48]), 1e-3),
        as_double::<3>("both/h = 2 dx/3d", of(both, &[8, 12, 16]), 1e-3),
        in_cells::<2>("from 100 m on", far(1e2, of(water, &[24, 48, 96]))),
        in_cells::<2>("from 1000 m on", far(1e3, of(water, &[12, 24, 48]))),
        in_cells::<2>("both/from 1000 m on", far(1e3, of(both, &[12, 24, 48]))),
    ]
}

/// Near the origin.
fn as_double<const D: usize>(name: &str, ladder: Ladder, largest: f64) -> Study {
    let claim = "has the same error in single precision as in double, whether places are kept relative to the origin or \
                 to cells of 2h (values: relative difference of the two errors, by particles along an edge)";
    study::<D>(name, ladder, claim, |errors| {
        let from = |what: &'static str, found: f64| (what, found / errors.double - 1.0);
        vec![from("f32", errors.single), from("f32 in cells", errors.cells)]
    })
    .expect(Expected::Bound { largest })
    .mutant(FAR)
}

/// Far from it.
fn in_cells<const D: usize>(name: &str, ladder: Ladder) -> Study {
    let claim = "that begins far from the origin has with places kept as singles relative to cells of 2h the error it has \
                 in double precision; where single precision stops converging is noted (values: relative difference of \
                 the two errors, by particles along an edge)";
    study::<D>(name, ladder, claim, |errors| vec![("f32 in cells", errors.cells / errors.double - 1.0)])
        .expect(Expected::Bound { largest: 1e-3 })
        .mutant(ONE_CELL)
}

fn study<const D: usize>(
    name: &str,
    ladder: Ladder,
    claim: &str,
    judged: fn(&Errors) -> Vec<(&'static str, f64)>,
) -> Study {
    let name = format!("precision/manufactured/{name}");
    let of = match ladder.motion {
        Motion::Water => "flow of water",
        Motion::Both => "motion of soil and water",
    };
    Study::new(name.clone(), format!("a manufactured {of} {claim}"), move |conditions| {
        let all: Vec<Errors> =
            ladder.sides.iter().map(|&side| errors::<D>(ladder, side, conditions)).collect();
        let values = ladder.sides.iter().zip(&all).flat_map(|(side, errors)| {
            judged(errors).into_iter().map(move |(what, value)| (format!("{what}, {side}"), value))
        });
        report(&name, ladder, &all, Measured::values(values))
    })
    .equations(&["52", "58"])
    .source(SOURCE)
    .level(Level::Full)
}

/// Of the velocity (of both: with that of the stress), relative; and particle-steps per second of one core.
struct Errors {
    double: f64,
    single: f64,
    /// In double precision with places as singles relative to cells have them: the pair vectors of single precision
    /// with places relative to cells. What that does to other numbers `precision/places` shows to be little.
    cells: f64,
    speeds: [f64; 2],
}

fn errors<const D: usize>(ladder: Ladder, side: usize, conditions: &Conditions) -> Errors {
    let origin = if conditions.is(FAR) { 1e3 } else { ladder.origin };
    let run = Run { origin, ..Run::new(side, ladder.ratio) };
    let cell = if conditions.is(ONE_CELL) { f64::INFINITY } else { 2.0 * ladder.ratio / side as f64 };
    Errors {
        double: error::<f64, D>(ladder.motion, run),
        single: error::<f32, D>(ladder.motion, run),
        cells: error::<f64, D>(ladder.motion, Run { kept: Places::Singles { cell }, ..run }),
        speeds: [speed::<f64, D>(ladder.motion, run), speed::<f32, D>(ladder.motion, run)],
    }
}

/// At the end; NaN if the particles do not come so far.
pub fn error<T: Real, const D: usize>(motion: Motion, run: Run) -> f64 {
    let error = match motion {
        Motion::Water => {
            let mixture = flow::<T, D>(run, fluid(WATER.viscosity));
            run.follow_for(run.steps, mixture, VelocityVerlet::new()).map(|mixture| errors_alone(&mixture)[0])
        }
        Motion::Both => {
            let mixture = mixed::<T, D, _>(run, skeleton(), darcy(1.0));
            run.follow_for(run.steps, mixture, VelocityVerlet::new())
                .map(|mixture| errors_together(&mixture)[0])
        }
    };
    error.unwrap_or(f64::NAN)
}

/// Over some steps without sources, whose derivatives would take most of the time.
fn speed<T: Real, const D: usize>(motion: Motion, run: Run) -> f64 {
    const STEPS: usize = 20;
    let run = Run { driven: false, ..run };
    Threads::new(1).expect("a thread").install(|| match motion {
        Motion::Water => {
            let mixture = flow::<T, D>(run, fluid(WATER.viscosity));
            let (particles, start) = (mixture.water().len(), ThreadTime::now());
            run.follow_for(STEPS, mixture, VelocityVerlet::new()).expect("steps");
            (particles * STEPS) as f64 / start.elapsed().as_secs_f64()
        }
        Motion::Both => {
            let mixture = mixed::<T, D, _>(run, skeleton(), darcy(1.0));
            let (particles, start) = (mixture.soil().len() + mixture.water().len(), ThreadTime::now());
            run.follow_for(STEPS, mixture, VelocityVerlet::new()).expect("steps");
            (particles * STEPS) as f64 / start.elapsed().as_secs_f64()
        }
    })
}

/// One table and one picture.
fn report(name: &str, ladder: Ladder, all: &[Errors], measured: Measured) -> Measured {
    let spacing = |k: usize| 1.0 / ladder.sides[k] as f64;
    let curve = |of: fn(&Errors) -> f64| -> Vec<(f64, f64)> {
        all.iter().enumerate().map(|(k, errors)| (spacing(k), of(errors))).collect()
    };
    let curves: [Vec<(f64, f64)>; 3] = [curve(|e| e.double), curve(|e| e.single), curve(|e| e.cells)];
    let orders = curves.each_ref().map(|curve| observed_orders(curve));
    let row = |k: usize| {
        let order = |of: usize| k.checked_sub(1).map_or(String::new(), |k| format!("{:.2}", orders[of][k]));
        let error = |of: usize| format!("{:.4e}", curves[of][k].1);
        let [double, single] = all[k].speeds.map(|speed| format!("{:.2}", 1e-6 * speed));
        let side = ladder.sides[k].to_string();
        [side, error(0), order(0), error(1), order(1), error(2), order(2), double, single]
    };
    let heading =
        ["particles", "f64", "order", "f32", "order", "f32 in cells", "order", "f64, M/s", "f32, M/s"];
    let lost = (1..all.len()).find(|&k| orders[1][k - 1] < 0.5 && orders[0][k - 1] >= 0.5);
    let where_lost = match lost {
        Some(k) => format!("stops converging between {} and {}", ladder.sides[k - 1], ladder.sides[k]),
        None => format!("converges as far as it was followed, to {}", ladder.sides[all.len() - 1]),
    };
    let rows: Vec<_> = (0..all.len()).map(row).collect();
    let [double, single, cells] = curves;
    let last = all.last().map_or([f64::NAN; 2], |errors| errors.speeds.map(|speed| 1e-6 * speed));
    measured
        .table(heading, rows)
        .note(format!("single precision {where_lost} particles along an edge"))
        .note("M/s: millions of particle-steps a second of one core, without sources")
        .picture(
            &Chart::new(name, "resolution [m]", "relative error of the velocity [-]")
                .logarithmic(true, true)
                .with(Series::line(&format!("f64, {:.1} M/s", last[0]), double))
                .with(Series::points(&format!("f32, {:.1} M/s", last[1]), single))
                .with(Series::points("f32 in cells of 2h", cells)),
        )
}
