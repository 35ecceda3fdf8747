//! Still water stays still, at every wall, in both precisions.

use crate::scene::Tank;
use alluvium::mixture::{DensityDiffusion, Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::StepSize;
use alluvium::verify::{Conditions, Expected, Measured, Study, dam_break};
use alluvium::{Preset, Real, Vector};
use std::ops::ControlFlow;

const SOURCE: &str = "still water under gravity is at rest";
const UNBALANCED: &str = "diffusion that does not know the hydrostatic state";
const TILTED: &str = "gravity tilted by fifteen degrees";
const DEPTH: f64 = 0.2;
const SECONDS: f64 = 2.0;

pub fn studies() -> Vec<Study> {
    vec![
        tank::<f64>("dynamic", Wall::dynamic),
        tank::<f32>("dynamic", Wall::dynamic),
        tank::<f64>("extrapolated", || Wall::extrapolated(Slip::FreeSlip)),
        tank::<f32>("extrapolated", || Wall::extrapolated(Slip::FreeSlip)),
        tank::<f64>("extrapolated-no-slip", || Wall::extrapolated(Slip::NoSlip)),
    ]
}

/// Every value is a fraction of its bar, so that one run serves three claims.
fn tank<T: Real>(walls: &str, wall: fn() -> Wall<T, 2>) -> Study {
    Study::new(
        format!("still-tank/{walls}/{}", T::NAME),
        "in 2 s the energy changes by less than 0.2 % per second, v_rms over particles and time is below 1 % of √(gH), and the \
         surface drifts by less than a tenth of a spacing (values: fractions of these bars)",
        move |conditions| rest(wall(), conditions),
    )
    .equations(&["16", "20", "52", "58", "74", "77"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 1.0 })
    .mutant(UNBALANCED)
    .mutant(TILTED)
}

fn still_water<T: Real>(scene: &Tank<2>, wall: Wall<T, 2>, conditions: &Conditions) -> Simulation<T, 2> {
    let mut mixture = scene.mixture(wall);
    if conditions.is(UNBALANCED) {
        let plain = DensityDiffusion::TrueDensity(T::of(0.1));
        mixture = mixture.with_density_diffusion(plain).expect("in range");
    }
    if conditions.is(TILTED) {
        let angle = 15_f64.to_radians();
        let (across, down) = (dam_break::GRAVITY * angle.sin(), dam_break::GRAVITY * angle.cos());
        mixture = mixture.with_gravity(Vector::of([across, -down]));
    }
    Simulation::new(mixture, Preset::Default.leap_frog(), StepSize::Courant(T::of(0.2)))
}

fn rest<T: Real>(wall: Wall<T, 2>, conditions: &Conditions) -> Measured {
    let scene = Tank {
        water: [DEPTH, DEPTH],
        tank: [DEPTH, 1.5 * DEPTH],
        spacing: 0.01,
        sound_speed: 25.0,
        viscosity: 1e-3,
        preset: Preset::Default,
        periodic: None,
    };
    let mut run = still_water(&scene, wall, conditions);
    if let Err(error) = run.start() {
        return Measured::value(f64::INFINITY).note(error.to_string());
    }
    let (start, before) = (run.budget(), surface(&run));
    let (mut squares, mut samples, mut largest) = (0.0, 0_u32, 0.0_f64);
    let end = run.run_until(SECONDS, |run| -> ControlFlow<()> {
        if run.steps() % 100 == 0 {
            let budget = run.budget();
            let square = 2.0 * budget.kinetic / budget.mass;
            squares += square;
            samples += 1;
            largest = largest.max(square.sqrt());
        }
        ControlFlow::Continue(())
    });
    if let Err(error) = end {
        return Measured::value(f64::INFINITY).note(error.to_string());
    }
    let energy = (run.budget().energy() - start.energy()) / start.energy() / SECONDS;
    let drift = (surface(&run) - before) / scene.spacing;
    let bar = 0.01 * (dam_break::GRAVITY * DEPTH).sqrt();
    // The square lattice of the start is not the densest packing: once it gives way there is a short
    // burst, which the largest speed shows and the mean over time bears.
    Measured::values([
        ("energy", energy / 0.002),
        ("speed", (squares / f64::from(samples)).sqrt() / bar),
        ("surface", drift / 0.1),
    ])
    .note(format!("largest v_rms at one instant: {:.2} of its bar", largest / bar))
}

/// Mean height of the highest particle over columns of four spacings \[m\].
fn surface<T: Real>(run: &Simulation<T, 2>) -> f64 {
    let columns = [0.03, 0.07, 0.1, 0.13, 0.17];
    let height = |x: f64| run.mixture().surface(&Vector::of([x, 0.0]), 1).map_or(0.0, T::as_f64);
    columns.iter().map(|&x| height(x)).sum::<f64>() / columns.len() as f64
}
