//! What a user does to a run between two steps, and what is read off it.

use alluvium::kernel::WendlandC2;
use alluvium::material::Water;
use alluvium::mixture::{DensityDiffusion, Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize, VelocityVerlet};
use alluvium::{Real, Vector, setup};
use std::ops::ControlFlow;

const SPACING: f64 = 0.01;

/// A block of water of 0.2 m, flying at `speed` [m/s] along x.
fn block<T: Real>(speed: f64) -> Mixture<T, 2> {
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(25.0)).unwrap());
    let volume = T::of(SPACING * SPACING);
    water.add(&setup::fill([0.0, 0.0], [0.2, 0.2], SPACING), volume, |_| T::ZERO).unwrap();
    water.set_velocity(|_| Vector::of([speed, 0.0]));
    Mixture::of_water(WendlandC2::new(T::of(1.3 * SPACING)).unwrap(), water)
        .with_density_diffusion(DensityDiffusion::None)
        .unwrap()
}

#[test]
fn a_probe_finds_water_that_flies_as_one() {
    let mut run = Simulation::new(block::<f64>(1.0), LeapFrog::new(), StepSize::courant(0.2).unwrap());
    let _ = run.run_until(0.1, |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(run.mixture().water_neighbourhood().rebuilds(), 1, "the list should have lasted");
    let probe = run.mixture().probe(&Vector([0.2, 0.1]));
    assert!((probe.support - 1.0).abs() < 0.02, "support {}", probe.support);
    assert!((probe.velocity[0] - 1.0).abs() < 1e-12, "velocity {:?}", probe.velocity);
    assert_eq!(run.mixture().probe(&Vector([0.0, 0.1])).support, 0.0, "nothing is left behind");
}

#[test]
fn a_push_in_the_middle_of_a_run_stays() {
    let mut run = Simulation::new(block::<f64>(0.0), LeapFrog::new(), StepSize::courant(0.2).unwrap());
    run.step().unwrap();
    run.mixture_mut().water_mut().add_velocity(|_| Vector([0.5, 0.0]));
    run.step().unwrap();
    let budget = run.budget();
    assert!((budget.momentum[0] - 0.5 * budget.mass).abs() < 1e-12 * budget.mass);
}

#[test]
fn no_crumbs_of_steps_in_single_precision() {
    let mut run = Simulation::new(block::<f32>(0.0), VelocityVerlet::new(), StepSize::courant(0.2).unwrap());
    for end in 1..=20 {
        let _ = run
            .run_until(1e-3 * f64::from(end), |run| {
                let step = run.last_step().length;
                assert!(step == 0.0 || step > 1e-6, "a step of {step:e} s");
                ControlFlow::Continue(())
            })
            .unwrap();
    }
}

#[test]
fn a_step_of_no_length_does_nothing() {
    let mut run = Simulation::new(block::<f64>(1.0), LeapFrog::new(), StepSize::courant(0.2).unwrap());
    for longest in [0.0, -1.0, f64::NAN] {
        assert_eq!(run.step_at_most(longest).unwrap().length, 0.0);
    }
    assert_eq!((run.time(), run.steps()), (0.0, 0));
}
