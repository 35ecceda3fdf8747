//! Walls that hold soil: a block that slides down a slope, or stays.

use crate::soil::{GRAINS, SoilMixture, elastic};
use alluvium::kernel::WendlandC2;
use alluvium::material::{Soil, Unyielding};
use alluvium::mixture::{ArtificialViscosity, Mixture, Phase, Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, SymTensor, Vector, setup};
use std::ops::ControlFlow;

const SOURCE: &str =
    "a rigid block on a slope of angle β: g (sin β − μ cos β), or rest where μ > tan β (Coulomb)";
const GLIDING: &str = "no friction";
const ROUGH: &str = "0.1 more friction";
const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.4;
const SPACING: f64 = 0.01;
const BLOCK: [f64; 2] = [0.3, 0.08];

pub fn studies() -> Vec<Study> {
    vec![
        sliding::<f64>("soil/gliding block/f64", 0.0).mutant(ROUGH),
        sliding::<f64>("soil/sliding block/f64", 0.2).mutant(GLIDING).mutant(ROUGH),
        sliding::<f32>("soil/sliding block/f32", 0.2).mutant(GLIDING),
        sliding::<f64>("soil/fluttering block/f64", FRICTION).falls_short(
            Expected::Value { value: 0.044, tolerance: 0.01 },
            "the block swings and sticks: decision 12",
        ),
        resting::<f64>("soil/resting block/f64"),
        resting::<f32>("soil/resting block/f32"),
    ]
}

fn sliding<T: Real>(name: &str, friction: f64) -> Study {
    let claim = format!(
        "an elastic block slides down a slope of 35° with friction {friction} as a rigid one does (value: its mean \
         acceleration over the exact one)"
    );
    Study::new(name, claim, move |conditions| {
        let angle = 35_f64.to_radians();
        let exact = GRAVITY * (angle.sin() - friction * angle.cos());
        let (early, late) = (0.1, 0.25);
        let speeds = speeds::<T>(angle, friction, &[early, late], conditions);
        Measured::value((speeds[1] - speeds[0]) / (late - early) / exact)
    })
    .source(SOURCE)
    .level(Level::Full)
    .expect(Expected::Value { value: 1.0, tolerance: 0.02 })
}

fn resting<T: Real>(name: &str) -> Study {
    let claim = "the block stays on a slope of 15°, less steep than its friction (value: its mean speed after \
                 0.25 s over that of one without friction)";
    Study::new(name, claim, |conditions| {
        let angle = 15_f64.to_radians();
        let speed = speeds::<T>(angle, FRICTION, &[0.25], conditions)[0];
        Measured::value(speed / (GRAVITY * angle.sin() * 0.25))
    })
    .source(SOURCE)
    .expect(Expected::Bound { largest: 0.01 })
    .mutant(GLIDING)
}

/// Mean speed along the slope at these times.
fn speeds<T: Real>(angle: f64, friction: f64, times: &[f64], conditions: &Conditions) -> Vec<f64> {
    let step = StepSize::courant(T::of(0.2)).expect("0.2");
    let mut run = Simulation::new(block::<T>(angle, friction, conditions), LeapFrog::new(), step);
    let speed = |time: &f64| {
        let _ = run.run_until(*time, |_| ControlFlow::Continue(())).expect("a sound run");
        let soil = run.mixture().soil();
        let free = &soil.velocities()[soil.wall_particles()..];
        free.iter().map(|v| v[0].as_f64()).sum::<f64>() / free.len() as f64
    };
    times.iter().map(speed).collect()
}

/// A block on a floor; gravity is tilted instead.
fn block<T: Real>(
    angle: f64,
    friction: f64,
    conditions: &Conditions,
) -> SoilMixture<T, 2, Soil<T, Unyielding>> {
    let rougher = if conditions.is(ROUGH) { 0.1 } else { 0.0 };
    let friction = if conditions.is(GLIDING) { 0.0 } else { friction + rougher };
    let volume = T::of(SPACING * SPACING);
    let mut phase = Phase::new(elastic::<T>());
    let floor = setup::tank([-0.1, 0.0], [0.8, 0.2], SPACING, 3, [(false, false), (true, false)]);
    let wall = Wall::extrapolated(Slip::Friction(friction));
    phase.add_wall(wall, &floor, volume, |_| T::ZERO).expect("a wall");
    phase.add(&setup::fill([0.0; 2], BLOCK, SPACING), volume, |_| T::ZERO).expect("particles");
    phase.set_stress(|x| {
        let weight = GRAINS * GRAVITY * angle.cos() * (BLOCK[1] - x[1].as_f64()).clamp(0.0, BLOCK[1]);
        let mut stress = SymTensor::zero();
        stress.0[1] = T::of(-weight);
        stress
    });
    let kernel = WendlandC2::new(T::of(1.3 * SPACING)).expect("a length");
    Mixture::of_soil(kernel, phase)
        .with_gravity(Vector::of([GRAVITY * angle.sin(), -GRAVITY * angle.cos()]))
        .with_soil_artificial_viscosity(ArtificialViscosity { linear: T::of(0.1), quadratic: T::ONE })
        .expect("numerics")
}
