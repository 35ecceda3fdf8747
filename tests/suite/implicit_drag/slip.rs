//! Drag that grows with the slip, evaluated and solved over the step.

use super::{Both, H, Run, SIDE, SPACING, box_of, cloud, nearest, slip, weight};
use alluvium::Vector;
use alluvium::material::{Conductivity, DragLaw, Ergun, Forchheimer, PoreFluid};
use alluvium::mixture::{DragScheme, StepError};
use alluvium::time::{Evolve, Integrator, LeapFrog, Moment, StepSize, VelocityVerlet};

/// Grains so coarse that inertia rules the drag of the fast slips here, and viscosity that of the slow.
const GRAINS: f64 = 2e-3;

fn ergun() -> Ergun<f64> {
    Ergun::new(GRAINS, 1e-3).unwrap()
}

/// Two streams on coincident lattices, with the law of Ergun.
fn streams(speed: f64, scheme: DragScheme) -> Both<f64> {
    box_of(0.1, scheme, 0.0, |_| Vector::zero(), move |_| Vector([speed, 0.0])).with_drag(ergun())
}

/// 1/ρ_s + 1/ρ_f times the kernel's lattice sum: the slip falls at C_d times that.
fn mobility(mixture: &Both<f64>) -> f64 {
    let (soil, water) = (mixture.soil(), mixture.water());
    let around: f64 = (0..soil.len()).map(|i| weight(mixture, i, 0)).sum::<f64>() * SPACING * SPACING;
    around * (1.0 / soil.density(0) + 1.0 / water.density(0))
}

/// C_d at a slip, wherever in the box.
fn coefficient(mixture: &Both<f64>, slip: f64) -> f64 {
    let water = mixture.water();
    ergun().coefficient(water.volume_fraction(0), water.true_density(0), slip)
}

#[test]
fn evaluated_drag_is_that_of_the_slip() {
    for speed in [1e-6, 1e-2, 1.0] {
        let mut mixture = streams(speed, DragScheme::Explicit);
        mixture.evaluate().unwrap();
        let expected = mobility(&mixture) * coefficient(&mixture, speed) * speed;
        let (soil, water) = (mixture.soil(), mixture.water());
        let rate = soil.accelerations()[3][0] - water.accelerations()[3][0];
        assert!((rate / expected - 1.0).abs() < 1e-12, "{rate:e} for {expected:e} at {speed} m/s");
        // Taken at another slip it is another force.
        let linear = mobility(&mixture) * coefficient(&mixture, 0.0) * speed;
        assert!(speed < 0.1 || rate > 1.5 * linear);
    }
}

#[test]
fn one_step_of_backward_euler_ends_on_its_parabola() {
    for (speed, dt) in [(1e-4, 1e-2), (0.1, 1e-3), (0.3, 1.0), (0.3, 1e3)] {
        let mut mixture = streams(speed, DragScheme::BackwardEuler);
        mixture.evaluate().unwrap();
        mixture.complete(Moment::Now, dt).unwrap();
        let (soil, water) = (mixture.soil(), mixture.water());
        let effective = water.accelerations()[3][0] - soil.accelerations()[3][0];
        let found = speed + dt * effective;
        // s' + Δt β (A + B s') s' = s.
        let beta = dt * mobility(&mixture);
        let linear = 1.0 + beta * coefficient(&mixture, 0.0);
        let quadratic = beta * (coefficient(&mixture, 1.0) - coefficient(&mixture, 0.0));
        let root = 2.0 * speed / (linear + (linear * linear + 4.0 * quadratic * speed).sqrt());
        let error = (found - root).abs();
        assert!(error <= 1e-7 * root + 1e-8 * speed, "{found:e} for {root:e}, {speed} m/s, {dt} s");
    }
}

/// Drag whose inertia rules slips of 1 µm/s already: lattices stay where they are.
fn inertial() -> Forchheimer<f64> {
    let fluid = PoreFluid::new(1000.0, 9.81, 1e-3).unwrap();
    Forchheimer::new(Conductivity::new(0.1).unwrap(), &fluid, 3e4).unwrap()
}

/// A and B of C_d = A + B s, times the kernel's lattice sum.
fn parts(mixture: &Both<f64>) -> [f64; 2] {
    let water = mixture.water();
    let at = |slip: f64| {
        let c = inertial().coefficient(water.volume_fraction(0), water.true_density(0), slip);
        c * (0..water.len()).map(|i| weight(mixture, i, 0)).sum::<f64>() * SPACING * SPACING
    };
    [at(0.0), (at(1.0) - at(0.0))]
}

/// The slip s at which `a s + b s² = force`.
fn balance([a, b]: [f64; 2], force: f64) -> f64 {
    2.0 * force / (a + (a * a + 4.0 * b * force).sqrt())
}

/// Water that falls through held soil.
fn falling(scheme: DragScheme, speed: f64) -> Both<f64> {
    let still = |_: &Vector<f64, 2>| Vector::zero();
    box_of(0.1, scheme, SIDE, still, move |_| Vector([0.0, -speed]))
        .with_drag(inertial())
        .with_gravity(Vector([0.0, -9.81]))
}

fn terminal(mixture: &Both<f64>) -> f64 {
    let [a, b] = parts(mixture);
    let slip = balance([a, b], 9.81 * mixture.water().density(0));
    assert!(b * slip > 10.0 * a, "inertia rules");
    slip
}

#[test]
fn the_terminal_slip_of_quadratic_drag_is_exact() {
    let mut still = falling(DragScheme::Explicit, 0.0);
    still.evaluate().unwrap();
    let root = terminal(&still);
    let mut explicit = falling(DragScheme::Explicit, root);
    explicit.evaluate().unwrap();
    let rest = explicit.water().accelerations().iter().map(|a| a.norm()).fold(0.0, f64::max);
    assert!(rest < 1e-11 * 9.81, "explicit: {rest:e} m/s²");

    fn implicit(scheme: DragScheme, integrator: impl Integrator<f64>) -> f64 {
        let mut run = Run::new(falling(scheme, 0.0), integrator, StepSize::courant(0.2).unwrap());
        for _ in 0..40 {
            run.step().unwrap();
        }
        let water = run.mixture().water();
        let mean = -water.velocities().iter().map(|v| v[1]).sum::<f64>() / water.len() as f64;
        (mean / terminal(run.mixture()) - 1.0).abs()
    }
    for scheme in [DragScheme::BackwardEuler, DragScheme::SecondOrder] {
        for slip in [implicit(scheme, LeapFrog::new()), implicit(scheme, VelocityVerlet::new())] {
            assert!(slip < 1e-6, "{scheme:?}: {slip:e}");
        }
    }
}

#[test]
fn the_schemes_have_their_orders_for_quadratic_drag_too() {
    let (start, time) = (1e-6, 0.01);
    let streams = |scheme| {
        box_of(0.1, scheme, 0.0, |_| Vector::zero(), move |_| Vector([start, 0.0])).with_drag(inertial())
    };
    let after = |scheme, count: u32| {
        let step = StepSize::fixed(time / f64::from(count)).unwrap();
        let mut run = Run::new(streams(scheme), LeapFrog::new(), step);
        for _ in 0..count {
            run.step().unwrap();
        }
        slip(run.mixture())
    };
    // ds/dt = −(a + b s) s.
    let mut mixture = streams(DragScheme::Explicit);
    mixture.evaluate().unwrap();
    let inverse = 1.0 / mixture.soil().density(0) + 1.0 / mixture.water().density(0);
    let [a, b] = parts(&mixture).map(|part| part * inverse);
    assert!(b * start > a && a * time > 0.3, "{} {}", b * start / a, a * time);
    let decay = (-a * time).exp();
    let exact = start * a * decay / (a + b * start * (1.0 - decay));
    let order = |scheme| {
        let error = |count| (after(scheme, count) - exact).abs();
        (error(64) / error(256)).log2() / 2.0
    };
    let (first, second) = (order(DragScheme::BackwardEuler), order(DragScheme::SecondOrder));
    assert!((first - 1.0).abs() < 0.15 && (second - 2.0).abs() < 0.15, "{first}, {second}");
}

/// Drag that jumps up at a slip no step can agree with.
#[derive(Debug)]
struct Jump;

impl DragLaw<f64> for Jump {
    fn coefficient(&self, _: f64, _: f64, slip: f64) -> f64 {
        if slip < 0.05 { 1.0 } else { 1e9 }
    }
}

#[test]
fn slips_that_do_not_settle_end_the_step() {
    let mut mixture = streams(0.3, DragScheme::BackwardEuler).with_drag(Jump);
    mixture.evaluate().unwrap();
    match mixture.complete(Moment::Now, 1e-3).unwrap_err() {
        StepError::DragUnsettled { change, allowed, sweeps, law, .. } => {
            assert!(change > allowed && sweeps > 10 && law == "Jump");
        }
        other => panic!("{other}"),
    }
}

#[test]
fn in_disorder_momentum_is_exact_and_the_coefficients_are_those_of_the_end() {
    ends_with_its_own_coefficients(false);
}

#[test]
fn projected_too() {
    ends_with_its_own_coefficients(true);
}

/// A step from a cloud in disorder, against drag summed pair by pair with the velocities and slips at its end.
fn ends_with_its_own_coefficients(is_projected: bool) {
    let dt = 5e-3;
    let settled = |scheme| {
        let mixture = cloud(0.1, scheme).with_drag(ergun());
        let mut mixture = if is_projected { mixture.with_projected_drag() } else { mixture };
        mixture.evaluate().unwrap();
        mixture
    };
    let without = settled(DragScheme::BackwardEuler);
    let mut mixture = settled(DragScheme::BackwardEuler);
    mixture.complete(Moment::Now, dt).unwrap();
    let (soil, water) = (mixture.soil(), mixture.water());
    let mut worst = 0.0_f64;
    let soil_end: Vec<Vector<f64, 2>> = (0..soil.len())
        .map(|i| {
            if i < soil.wall_particles() {
                soil.velocities()[i]
            } else {
                soil.velocities()[i] + soil.accelerations()[i] * dt
            }
        })
        .collect();
    let mut momentum = Vector([0.0; 2]);
    let mut size = 0.0;
    for a in 0..water.len() {
        let v = water.velocities()[a] + water.accelerations()[a] * dt;
        let (mut slip, mut around, mut pulled) = (Vector([0.0; 2]), 0.0, Vector([0.0; 2]));
        for (i, u) in soil_end.iter().enumerate() {
            let w = soil.volume(i) * weight(&mixture, i, a);
            slip += (v - *u) * w;
            around += w;
            let line = nearest(&mixture, i, a);
            pulled += if is_projected {
                line * (2.0 * w * line.dot(v - *u) / (line.norm2() + 1e-6 * H * H))
            } else {
                (v - *u) * w
            };
        }
        let c = ergun().coefficient(water.volume_fraction(a), water.true_density(a), slip.norm() / around);
        let gained = water.accelerations()[a] - without.water().accelerations()[a];
        let drag = pulled * (-c / water.density(a));
        worst = worst.max((gained - drag).norm() * dt);
        momentum += gained * water.masses()[a];
        size += gained.norm() * water.masses()[a];
    }
    for i in 0..soil.len() {
        momentum += (soil.accelerations()[i] - without.soil().accelerations()[i]) * soil.masses()[i];
    }
    // The linear iteration ends at 1e-10 of the velocities, the slips at 1e-8.
    assert!(worst < 1e-7, "{worst:e} m/s");
    assert!(momentum.norm() < 1e-13 * size, "{:e}", momentum.norm() / size);
}
