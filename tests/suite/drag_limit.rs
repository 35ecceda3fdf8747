//! The step explicit drag bears: where theory puts it, over pairs that see each other, and enforced.

use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Conductivity, Darcy, DragLaw, Elasticity, Ergun, Soil, Unyielding, Water};
use alluvium::mixture::{Mixture, Phase, StepError};
use alluvium::neighbours::Periodic;
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, LeapFrog, Limit, StepSize, VelocityVerlet};
use alluvium::{Vector, setup};

type Both = Mixture<f64, 2, WendlandC2<f64, 2>, Soil<f64, Unyielding>, Water<f64>>;

const SPACING: f64 = 0.05;
const SIDE: f64 = 0.6;
const H: f64 = 1.5 * SPACING;

/// Soil and water in a periodic box, displaced from a common lattice by `disorder` spacings; the water moves at
/// 1 µm/s.
fn periodic_box(disorder: f64, law: impl DragLaw<f64> + 'static) -> Both {
    let mut state = 11_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        disorder * SPACING * ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
    };
    let lattice = setup::fill::<f64, 2>([0.0; 2], [SIDE; 2], SPACING);
    let mut places = || -> Vec<_> { lattice.iter().map(|x| *x + Vector([random(), random()])).collect() };
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).unwrap();
    let mut soil = Phase::new(Soil::new(2650.0, elasticity, Unyielding).unwrap());
    soil.add(&places(), SPACING * SPACING, |_| 0.0).unwrap();
    // Loose on the left, dense on the right, with one light grain in it.
    let light = Vector([9.5 * SPACING, 6.5 * SPACING]);
    soil.set_volume_fraction(|x| match disorder > 0.0 {
        true if (*x - light).norm() < 0.5 * SPACING => 0.1,
        true if x[0] > 0.5 * SIDE => 0.7,
        true => 0.4,
        false => 0.5,
    });
    let mut water = Phase::new(Water::new(1000.0, 30.0).unwrap());
    water.add(&places(), SPACING * SPACING, |_| 0.0).unwrap();
    water.set_velocity(|_| Vector([1e-6, 0.0]));
    Mixture::new(WendlandC2::new(H).unwrap(), soil, water)
        .with_periodic(Periodic::new(Vector::zero(), [Some(SIDE); 2]).unwrap())
        .with_drag(law)
}

fn darcy(k: f64) -> Darcy<f64> {
    Darcy::new(Conductivity::new(k).unwrap())
}

/// Σ_j K_ij/m_i of each particle, soil and water, and the pairs, from all pairs there are.
fn rates(mixture: &Both, law: &dyn DragLaw<f64>) -> ([Vec<f64>; 2], Vec<(usize, usize)>) {
    let (soil, water) = (mixture.soil(), mixture.water());
    let mut rates = [vec![0.0; soil.len()], vec![0.0; water.len()]];
    let mut pairs = Vec::new();
    for i in 0..soil.len() {
        for a in 0..water.len() {
            let away = soil.positions()[i] - water.positions()[a];
            let away = Vector(away.0.map(|x| x - SIDE * (x / SIDE).round()));
            if away.norm2() < 4.0 * H * H {
                let c = law.coefficient(water.volume_fraction(a), water.true_density(a), 0.0);
                let k = soil.volume(i) * water.volume(a) * c * mixture.kernel().value(away.norm2());
                rates[0][i] += k / soil.masses()[i];
                rates[1][a] += k / water.masses()[a];
                pairs.push((i, a));
            }
        }
    }
    (rates, pairs)
}

/// By how much the slip has grown after 400 steps of this part of the limit.
fn growth<I: Integrator<f64>>(mut integrator: I, part: f64) -> f64 {
    let mut mixture = periodic_box(0.0, darcy(1e-4));
    mixture.evaluate().unwrap();
    let dt = part * mixture.limits().drag;
    for _ in 0..400 {
        integrator.step(&mut mixture, dt).unwrap();
    }
    (mixture.water().velocities()[7][0] - mixture.soil().velocities()[7][0]).abs() / 1e-6
}

#[test]
fn on_coincident_lattices_the_limit_is_the_stopping_time_and_explicit_drag_breaks_there() {
    let mut mixture = periodic_box(0.0, darcy(1e-4));
    mixture.evaluate().unwrap();
    let (soil, water) = (mixture.soil(), mixture.water());
    let c = darcy(1e-4).coefficient(water.volume_fraction(0), water.true_density(0), 0.0);
    let around: f64 = {
        let (rates, _) = rates(&mixture, &darcy(1e-4));
        rates[1][0] * water.density(0) / c
    };
    assert!((around - 1.0).abs() < 0.01, "a lattice sum: {around}");
    let stopping_time = 1.0 / (c * (1.0 / soil.density(0) + 1.0 / water.density(0)));
    let limit = mixture.limits().drag;
    assert!((limit * around / stopping_time - 1.0).abs() < 1e-12, "{limit:e} s for {stopping_time:e} s");
    assert!(growth(LeapFrog::new(), 0.98) < 1e-2 && growth(LeapFrog::new(), 1.02) > 1e1);
    assert!(growth(VelocityVerlet::new(), 0.98) < 1e-2 && growth(VelocityVerlet::new(), 1.02) > 1e1);
}

#[test]
fn only_pairs_that_see_each_other_count() {
    let mut mixture = periodic_box(0.4, darcy(1e-4));
    mixture.evaluate().unwrap();
    let (rates, pairs) = rates(&mixture, &darcy(1e-4));
    let fastest = pairs.iter().map(|&(i, a)| rates[0][i] + rates[1][a]).fold(0.0, f64::max);
    let limit = mixture.limits().drag;
    assert!((limit * fastest - 1.0).abs() < 1e-12, "{limit:e} s for {:e} s", 1.0 / fastest);
    // The largest of each constituent, wherever they are, would ask for less.
    let apart: f64 = rates.iter().map(|of| of.iter().copied().fold(0.0, f64::max)).sum();
    assert!(apart * limit > 1.02, "{}", apart * limit);
}

#[test]
fn a_fixed_step_beyond_it_is_refused_with_the_law_and_the_limit() {
    let run = |part: f64| {
        let mut mixture = periodic_box(0.0, darcy(1e-4));
        mixture.evaluate().unwrap();
        let limit = mixture.limits().drag;
        let step = StepSize::fixed(part * limit).unwrap();
        (limit, Simulation::new(mixture, LeapFrog::new(), step).step())
    };
    let (_, step) = run(0.999);
    assert_eq!(step.unwrap().limit, Limit::Fixed);
    let (limit, step) = run(1.001);
    let error = step.unwrap_err();
    match &error {
        StepError::DragTooStiff { step, allowed, law, .. } => {
            assert!((step / limit - 1.001).abs() < 1e-12 && (allowed / limit - 1.0).abs() < 1e-12);
            assert_eq!(law, "Darcy's law with k = 1e-4 m/s");
        }
        other => panic!("{other}"),
    }
    let text = error.to_string();
    for part in
        ["implicit drag", "k = 1e-4 m/s", &format!("{:.3e} s", 1.001 * limit), &format!("{limit:.3e} s")]
    {
        assert!(text.contains(part), "{part} is not in: {text}");
    }
}

#[test]
fn a_chosen_step_keeps_away_from_it() {
    let mixture = periodic_box(0.4, darcy(1e-4));
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(0.2).unwrap());
    run.start().unwrap();
    let limit = run.mixture().limits().drag;
    let step = run.step().unwrap();
    assert_eq!((step.limit, step.length), (Limit::Drag, 0.5 * limit));
}

#[test]
fn quadratic_drag_counts_by_its_tangent() {
    let limit = |speed: f64| {
        let mut mixture = periodic_box(0.0, Ergun::new(5e-3, 1e-3).unwrap());
        mixture.water_mut().set_velocity(|_| Vector([speed, 0.0]));
        mixture.evaluate().unwrap();
        let water = mixture.water();
        let law = Ergun::new(5e-3, 1e-3).unwrap();
        let at = |slip: f64| law.tangent(water.volume_fraction(0), water.true_density(0), slip);
        (mixture.limits().drag, at(speed))
    };
    let ((slow, slow_tangent), (fast, fast_tangent)) = (limit(1e-6), limit(5.0));
    assert!((slow / fast / (fast_tangent / slow_tangent) - 1.0).abs() < 1e-10);
}
