//! The volume fraction of water by its sum (68): exact at every evaluation, where the rate (69) drifts.

use crate::fingerprint;
use alluvium::budget::Account;
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{Mixture, Phase, VolumeFraction};
use alluvium::neighbours::Periodic;
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, LeapFrog, StepSize, VelocityVerlet};
use alluvium::{Vector, setup};
use core::f64::consts::PI;

const SPACING: f64 = 0.05;
const SIDE: f64 = 0.6;
const H: f64 = 1.5 * SPACING;

type Both = Mixture<f64, 2, WendlandC2<f64, 2>, Soil<f64, Unyielding>, Water<f64>>;

/// Soil and water in a periodic box, the water stirred with this speed \[m/s\]; the soil denser in the middle.
fn stirred(form: VolumeFraction, speed: f64) -> Both {
    let (places, volume) = (setup::fill::<f64, 2>([0.0; 2], [SIDE; 2], SPACING), SPACING * SPACING);
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).unwrap();
    let mut soil = Phase::new(Soil::new(2650.0, elasticity, Unyielding).unwrap());
    soil.add(&places, volume, |_| 0.0).unwrap();
    soil.set_volume_fraction(|x| 0.4 + 0.1 * (2.0 * PI * x[0] / SIDE).cos());
    let mut water = Phase::new(Water::new(1000.0, 30.0).unwrap());
    water.add(&places, volume, |_| 0.0).unwrap();
    water.set_velocity(|x| Vector([(2.0 * PI * x[1] / SIDE).sin(), (2.0 * PI * x[0] / SIDE).cos()]) * speed);
    Mixture::new(WendlandC2::new(H).unwrap(), soil, water)
        .with_periodic(Periodic::new(Vector::zero(), [Some(SIDE); 2]).unwrap())
        .with_volume_fraction(form)
}

/// Largest distance of the volume fraction from its sum (68) in the last evaluation.
fn distance(mixture: &Both) -> f64 {
    let (soil, water) = (mixture.soil(), mixture.water());
    let off = |a: usize| {
        let near = |i: usize| {
            let away = soil.positions()[i] - water.positions()[a];
            let r2 = Vector(away.0.map(|x| x - SIDE * (x / SIDE).round())).norm2();
            let value: f64 = if r2 < 4.0 * H * H { mixture.kernel().value(r2) } else { 0.0 };
            value * soil.masses()[i] / 2650.0
        };
        (1.0 - (0..soil.len()).map(near).sum::<f64>() - water.volume_fraction(a)).abs()
    };
    (0..water.len()).map(off).fold(0.0, f64::max)
}

/// At the evaluation after 12 ms: the distance of φ, the part of the kinetic energy at the start nobody explains, and
/// the part the sum takes.
fn after<I: Integrator<f64>>(form: VolumeFraction, mut integrator: I, speed: f64, step: f64) -> [f64; 3] {
    let mut mixture = stirred(form, speed);
    mixture.evaluate().unwrap();
    let before = mixture.budget();
    (0..(12e-3 / step).round() as usize).for_each(|_| integrator.step(&mut mixture, step).unwrap());
    mixture.evaluate().unwrap();
    let budget = mixture.budget();
    let size = before.kinetic.max(f64::MIN_POSITIVE);
    let unexplained = (budget.energy() + budget.taken.total() - before.energy() - before.taken.total()).abs();
    [distance(&mixture), unexplained / size, budget.taken[Account::VolumeFraction] / size]
}

#[test]
fn the_sum_is_kept_where_the_rate_drifts() {
    let [summed, unexplained, taken] = after(VolumeFraction::Sum, VelocityVerlet::new(), 1.0, 2e-4);
    let [drifted, ..] = after(VolumeFraction::Rate, VelocityVerlet::new(), 1.0, 2e-4);
    assert!(summed < 1e-12 && drifted > 1e3 * summed, "{summed:e}, {drifted:e}");
    assert!(unexplained < 1e-3 && taken != 0.0, "unexplained {unexplained:e}, taken {taken:e}");
    // What drifts is an error of the integration in time, of its second order.
    let [finer, ..] = after(VolumeFraction::Rate, VelocityVerlet::new(), 1.0, 1e-4);
    assert!(drifted / finer > 3.0, "{drifted:e}, {finer:e}");
}

#[test]
fn at_rest_on_a_lattice_both_agree() {
    for form in [VolumeFraction::Sum, VolumeFraction::Rate] {
        let [distance, ..] = after(form, LeapFrog::new(), 0.0, 2e-4);
        assert!(distance < 1e-14, "{form:?}: {distance:e}");
    }
}

#[test]
fn a_resumed_run_has_the_same_bits() {
    let begin = || {
        let mixture = stirred(VolumeFraction::Sum, 1.0);
        Simulation::new(mixture, LeapFrog::new(), StepSize::fixed(2e-4).unwrap())
    };
    let mut run = begin();
    (0..20).for_each(|_| _ = run.step().unwrap());
    let snapshot = run.snapshot();
    (0..20).for_each(|_| _ = run.step().unwrap());
    let mut resumed = begin();
    resumed.restore(snapshot).unwrap();
    (0..20).for_each(|_| _ = resumed.step().unwrap());
    assert_eq!(fingerprint::hash(run.mixture()), fingerprint::hash(resumed.mixture()));
    assert_eq!(run.budget(), resumed.budget());
}

/// Soil moved a little between two evaluations, and fractions put to their sums: the energy \[J\] before and after,
/// and what the account takes.
fn disturbed() -> [f64; 3] {
    let mut mixture = stirred(VolumeFraction::Sum, 0.0);
    mixture.evaluate().unwrap();
    let before = mixture.budget();
    for (n, x) in mixture.soil_mut().positions_mut().iter_mut().enumerate() {
        *x += Vector([(7.0 * n as f64).sin(), (11.0 * n as f64).cos()]) * (0.2 * SPACING);
    }
    mixture.evaluate().unwrap();
    let after = mixture.budget();
    let taken = after.taken[Account::VolumeFraction] - before.taken[Account::VolumeFraction];
    [before.energy(), after.energy(), taken]
}

#[test]
fn what_the_sum_takes_is_what_is_missing() {
    let [before, after, taken] = disturbed();
    let lost = before - after;
    assert!(lost.abs() > 1.0, "{lost} J show nothing");
    let wrong = |taken: f64| (lost - taken).abs() / lost.abs();
    assert!(wrong(taken) < 1e-12, "lost {lost:e} J, taken {taken:e} J");
    // Booked twice, with the wrong sign or not at all would be seen.
    assert!([2.0 * taken, -taken, 0.0].into_iter().all(|mistaken| wrong(mistaken) > 0.9));
}
