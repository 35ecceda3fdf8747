//! The step water between grains bears: where dense soil leaves it little space, shorter than either sound.

use alluvium::kernel::WendlandC2;
use alluvium::material::{Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{CouplingForm, Mixture, Phase, StepError};
use alluvium::neighbours::Periodic;
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, LeapFrog, Limit, StepSize, VelocityVerlet};
use alluvium::{Vector, setup};

type Both = Mixture<f64, 2, WendlandC2<f64, 2>, Soil<f64, Unyielding>, Water<f64>>;

const SPACING: f64 = 0.05;
const SIDE: f64 = 0.6;
const H: f64 = 1.5 * SPACING;
const SOUND: f64 = 250.0;

/// Soil and water at rest on one lattice but for a micrometre per second of noise, without drag.
fn noisy(fraction: f64) -> Both {
    let (places, volume) = (setup::fill::<f64, 2>([0.0; 2], [SIDE; 2], SPACING), SPACING * SPACING);
    let mut state = 11_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        1e-6 * ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
    };
    let elasticity = Elasticity::from_bulk(125e6, 0.3).unwrap();
    let mut soil = Phase::new(Soil::new(2700.0, elasticity, Unyielding).unwrap());
    soil.add(&places, volume, |_| 0.0).unwrap();
    soil.set_volume_fraction(|_| fraction);
    let mut water = Phase::new(Water::new(1000.0, SOUND).unwrap());
    water.add(&places, volume, |_| 0.0).unwrap();
    soil.velocities_mut().fill_with(|| Vector([random(), random()]));
    water.velocities_mut().fill_with(|| Vector([random(), random()]));
    Mixture::new(WendlandC2::new(H).unwrap(), soil, water)
        .with_periodic(Periodic::new(Vector::zero(), [Some(SIDE); 2]).unwrap())
}

/// The same with a smoothing length between soil and water of so many times that within.
fn coupled(ratio: f64) -> Both {
    noisy(0.8).with_interphase_kernel(WendlandC2::new(ratio * H).unwrap()).unwrap()
}

fn kinetic(mixture: &Both) -> f64 {
    mixture.budget().kinetic
}

/// By how much the kinetic energy has grown after 600 steps, and what bound the step.
fn growth(mixture: Both, integrator: impl Integrator<f64>) -> (f64, Limit) {
    let mut run = Simulation::new(mixture, integrator, StepSize::courant(0.2).unwrap());
    let before = kinetic(run.mixture());
    (0..600).for_each(|_| _ = run.step().unwrap());
    (kinetic(run.mixture()) / before, run.step().unwrap().limit)
}

#[test]
fn dense_soil_full_of_water_rests() {
    for fraction in [0.7, 0.8, 0.9] {
        let (leap_frog, limit) = growth(noisy(fraction), LeapFrog::new());
        assert_eq!(limit, Limit::Pores, "{fraction}");
        let (verlet, _) = growth(noisy(fraction), VelocityVerlet::new());
        assert!(leap_frog < 1.0 && verlet < 1.0, "{fraction}: {leap_frog:e}, {verlet:e}");
    }
    // What soil and water bear by themselves is shorter where half of the space is water.
    assert_eq!(growth(noisy(0.5), LeapFrog::new()).1, Limit::Acoustic);
}

#[test]
fn a_kernel_between_soil_and_water_narrower_or_wider_leaves_rest_at_rest() {
    for ratio in [0.5, 0.7, 1.5] {
        let (leap_frog, limit) = growth(coupled(ratio), LeapFrog::new());
        assert_eq!(limit, Limit::Pores, "{ratio}");
        let (verlet, _) = growth(coupled(ratio), VelocityVerlet::new());
        assert!(leap_frog < 1.0 && verlet < 1.0, "{ratio}: {leap_frog:e}, {verlet:e}");
    }
}

/// A fifth of what sound alone bears in 600 steps.
fn without_it(fraction: f64) -> Result<f64, StepError> {
    let mut mixture = noisy(fraction);
    let (before, mut integrator) = (kinetic(&mixture), LeapFrog::new());
    mixture.evaluate()?;
    let step = 0.2 * mixture.limits().acoustic;
    for _ in 0..600 {
        integrator.step(&mut mixture, step)?;
    }
    Ok(kinetic(&mixture) / before)
}

#[test]
fn sound_alone_would_let_it_burst() {
    assert!(without_it(0.5).unwrap() < 1.0);
    let burst = without_it(0.8);
    assert!(burst.as_ref().is_err() || burst.as_ref().is_ok_and(|growth| *growth > 1e9), "{burst:?}");
}

#[test]
fn it_is_of_the_least_fraction_and_of_pressure_by_differences() {
    let mut mixture = noisy(0.8);
    mixture.evaluate().unwrap();
    let water = mixture.water();
    let least = (0..water.len()).map(|a| water.volume_fraction(a)).fold(1.0, f64::min);
    assert!((mixture.limits().pores * SOUND / (H * least) - 1.0).abs() < 1e-12);
    let mut printed = noisy(0.8).with_coupling(CouplingForm::Printed);
    printed.evaluate().unwrap();
    assert_eq!(printed.limits().pores, f64::INFINITY);
}
