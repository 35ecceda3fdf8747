//! Control of what the velocity gradient of soil does not see: nothing of linear motion, momentum exact, the same bits
//! for any number of threads and across a restart.

use crate::fingerprint::hash;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Absent, Elasticity, Soil, Unyielding};
use alluvium::mixture::{ArtificialViscosity, HourglassControl, Mixture, Phase};
use alluvium::parallel::Threads;
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, LeapFrog, StepSize};
use alluvium::{Real, Vector, setup};

type Jelly<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Absent>;

const SPACING: f64 = 0.1;

fn control<T: Real>(stiffness: f64, viscosity: f64) -> HourglassControl<T> {
    HourglassControl { stiffness: T::of(stiffness), viscosity: T::of(viscosity) }
}

/// A body without forces in it, off its lattice by up to a fifth of the spacing.
fn jelly<T: Real, const D: usize>(velocity: impl Fn(&Vector<T, D>) -> Vector<T, D>) -> Jelly<T, D> {
    let elasticity = Elasticity::from_bulk(T::of(1e6), T::of(0.3)).unwrap();
    let mut body = Phase::new(Soil::new(T::of(1000.0), elasticity, Unyielding).unwrap());
    let mut places = setup::fill([0.0; D], [1.0; D], SPACING);
    for x in &mut places {
        *x += disorder(x) * T::of(0.2 * SPACING);
    }
    body.add(&places, T::of(SPACING.powi(D as i32)), |_| T::ZERO).unwrap();
    body.set_velocity(velocity);
    let none = ArtificialViscosity { linear: T::ZERO, quadratic: T::ZERO };
    Mixture::of_soil(WendlandC2::new(T::of(1.5 * SPACING)).unwrap(), body)
        .with_gradient_correction()
        .with_skin(T::of(0.1 * SPACING))
        .with_soil_artificial_viscosity(none)
        .unwrap()
}

/// In −1…1, different from place to place.
fn disorder<T: Real, const D: usize>(x: &Vector<T, D>) -> Vector<T, D> {
    let phase = x.0.iter().enumerate().map(|(k, x)| (k as f64 + 1.3) * 47.0 * x.as_f64()).sum::<f64>();
    Vector::of(core::array::from_fn(|k| (phase * (k as f64 + 1.0)).sin()))
}

/// Largest difference the control makes to an acceleration.
fn difference<T: Real, const D: usize>(velocity: impl Fn(&Vector<T, D>) -> Vector<T, D> + Copy) -> f64 {
    let mut free = jelly(velocity);
    let mut held = jelly(velocity).with_hourglass_control(control(4.0, 0.1)).unwrap();
    for mixture in [&mut free, &mut held] {
        mixture.evaluate().unwrap();
    }
    let pairs = free.soil().accelerations().iter().zip(held.soil().accelerations());
    pairs.map(|(a, b)| (*a - *b).norm2().as_f64().sqrt()).fold(0.0, f64::max)
}

fn spares_linear_motion<T: Real, const D: usize>(rounding: f64) {
    let linear = |x: &Vector<T, D>| {
        Vector(core::array::from_fn(|k| x[k] * T::of(0.3) - x[(k + 1) % D] * T::of(1.0 + k as f64)))
    };
    let disordered = difference::<T, D>(disorder);
    assert!(disordered > 1.0, "{disordered}");
    let error = difference::<T, D>(linear) / disordered;
    assert!(error < rounding, "{} {D}D: {error:e}", T::NAME);
}

#[test]
fn linear_motion_is_not_touched() {
    spares_linear_motion::<f64, 2>(1e-12);
    spares_linear_motion::<f64, 3>(1e-12);
    spares_linear_motion::<f32, 2>(1e-4);
    spares_linear_motion::<f32, 3>(1e-4);
}

fn run<T: Real, const D: usize>() -> Simulation<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Absent> {
    let mixture = jelly(disorder).with_hourglass_control(control(4.0, 0.1)).unwrap();
    Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.1)).unwrap())
}

fn keeps_momentum<T: Real, const D: usize>(rounding: f64) {
    let mut run = run::<T, D>();
    let before = run.budget();
    for _ in 0..60 {
        run.step().unwrap();
    }
    let after = run.budget();
    let taken = after.taken[alluvium::budget::Account::HourglassControl];
    assert!(taken > 0.1 * before.kinetic, "the control took {taken} J");
    let change = before.momentum.iter().zip(&after.momentum).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let scale = before.mass;
    assert!(change < rounding * scale, "{} {D}D: {change:e} of {scale:e}", T::NAME);
}

#[test]
fn momentum_is_kept() {
    keeps_momentum::<f64, 2>(1e-13);
    keeps_momentum::<f64, 3>(1e-13);
    keeps_momentum::<f32, 2>(1e-4);
}

#[test]
fn threads_and_a_restart_leave_the_bits_as_they_are() {
    let state = |threads: usize| {
        Threads::new(threads).unwrap().install(|| {
            let mut run = run::<f64, 2>();
            for _ in 0..80 {
                run.step().unwrap();
            }
            assert!(run.mixture().soil_neighbourhood().rebuilds() > 1, "nothing was ever re-sorted");
            hash(run.mixture())
        })
    };
    assert_eq!(state(1), state(3));
    let mut first = run::<f64, 2>();
    for _ in 0..40 {
        first.step().unwrap();
    }
    let mut second = run::<f64, 2>();
    second.restore(first.snapshot()).unwrap();
    for _ in 0..40 {
        second.step().unwrap();
    }
    assert_eq!(hash(second.mixture()), state(1));
}

#[test]
fn strengths_out_of_range_are_refused() {
    let refused = |stiffness, viscosity| {
        jelly::<f64, 2>(disorder)
            .with_hourglass_control(control(stiffness, viscosity))
            .unwrap_err()
            .to_string()
    };
    assert!(refused(-1.0, 0.1).contains("hourglass_control.stiffness"), "{}", refused(-1.0, 0.1));
    assert!(refused(4.0, f64::NAN).contains("hourglass_control.viscosity"), "{}", refused(4.0, f64::NAN));
}
