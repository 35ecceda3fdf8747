//! Drag of velocities reconstructed between particles: what it conserves, what it takes and what it leaves alone.

use super::projected::{By, given, heap};
use super::{Both, SIDE, SPACING, bits, box_of, darcy, drag_rate};
use alluvium::Vector;
use alluvium::budget::Account;
use alluvium::material::{DragLaw, Ergun};
use alluvium::mixture::{ArtificialViscosity, DragScheme, StepError};
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, LeapFrog, Moment, StepSize, VelocityVerlet};
use core::f64::consts::PI;

const K: f64 = 1e-3;

#[test]
fn momentum_is_exact_and_the_account_is_the_power() {
    for by in [By::Reconstructed, By::ReconstructedAndNormalised] {
        let [momentum, _, power] = given(by);
        assert!(momentum < 1e-13 && power < 1e-12, "{momentum:e} {power:e}");
        // However wild the velocities are, drag takes.
        assert!(heap(by).exchange_rate().taken[Account::Drag] > 0.0);
    }
}

/// Soil and water on one lattice, both in the same wave of shear or compression.
fn common(scheme: DragScheme, along: usize) -> Both<f64> {
    let wave = move |x: &Vector<f64, 2>| Vector([(2.0 * PI * x[along] / SIDE).sin(), 0.0]);
    box_of(K, scheme, 0.0, wave, wave)
}

/// What drag takes of it \[W\], over what the kernel's width makes it take, ρ ν k² v².
fn taken(mixture: Both<f64>) -> f64 {
    let mut mixture = mixture;
    mixture.evaluate().unwrap();
    let (soil, water) = (mixture.soil(), mixture.water());
    let c = darcy::<f64>(K).coefficient(water.volume_fraction(0), water.true_density(0), 0.0);
    let (h, wave_number) = (1.5 * SPACING, 2.0 * PI / SIDE);
    let viscosity = 5.0 / 18.0 * h * h * c;
    let energy: f64 = soil.velocities().iter().map(|v| v.norm2() * SPACING * SPACING).sum();
    mixture.exchange_rate().taken[Account::Drag] / (viscosity * wave_number * wave_number * energy)
}

#[test]
fn what_both_do_together_is_left_alone() {
    for along in 0..2 {
        let plain = taken(common(DragScheme::Explicit, along));
        assert!((plain - 1.0).abs() < 0.1, "plain drag is a viscosity: {plain}");
        let left = taken(common(DragScheme::Explicit, along).with_reconstructed_drag());
        // At kh = 0.79 the kernel smooths the gradient by ½m₂k²h² = 0.09, the middle is off by some 0.03: squared.
        assert!(left > 0.0 && left < 0.02, "{left} of it");
    }
}

#[test]
fn a_uniform_slip_is_dragged_as_ever() {
    let moving = |_: &Vector<f64, 2>| Vector([1e-3, 2e-3]);
    let evaluated = |reconstructed: bool| {
        let mixture = box_of(K, DragScheme::Explicit, 0.0, |_| Vector::zero(), moving);
        let mut mixture = if reconstructed { mixture.with_reconstructed_drag() } else { mixture };
        mixture.evaluate().unwrap();
        mixture
    };
    let (plain, found) = (evaluated(false), evaluated(true));
    let size = plain.water().accelerations()[0].norm();
    for (a, b) in plain.water().accelerations().iter().zip(found.water().accelerations()) {
        assert!((*a - *b).norm() < 1e-12 * size);
    }
    for (a, b) in plain.soil().accelerations().iter().zip(found.soil().accelerations()) {
        assert!((*a - *b).norm() < 1e-12 * size);
    }
    let limits = [plain.limits().drag, found.limits().drag];
    assert!((limits[1] * 1.1 / limits[0] - 1.0).abs() < 1e-12, "the step is a tenth shorter: {limits:?}");
    let taken = [plain, found].map(|mixture| mixture.exchange_rate().taken[Account::Drag]);
    assert!((taken[1] / taken[0] - 1.0).abs() < 1e-12, "{taken:?}");
}

/// Largest difference of what a short step of solved drag makes of wild velocities from evaluated drag, relative.
fn difference(evaluated: By, dt: f64) -> f64 {
    let (expected, mut solved) = (heap(evaluated), heap(By::ReconstructedAndSolved));
    solved.complete(Moment::Now, dt).unwrap();
    let size = expected.water().accelerations().iter().map(|a| a.norm()).fold(0.0, f64::max);
    let apart = |of: [&[Vector<f64, 2>]; 2]| {
        of[0].iter().zip(of[1]).map(|(a, b)| (*a - *b).norm()).fold(0.0, f64::max) / size
    };
    let soil = apart([expected.soil().accelerations(), solved.soil().accelerations()]);
    soil.max(apart([expected.water().accelerations(), solved.water().accelerations()]))
}

#[test]
fn solved_over_a_short_step_it_is_that_evaluated() {
    let errors = [1e-6, 1e-7].map(|dt| difference(By::Reconstructed, dt));
    assert!(errors[0] < 1e-2 && (errors[0] / errors[1] - 10.0).abs() < 0.5, "of first order: {errors:?}");
    // Plain drag is another.
    assert!(difference(By::Plain, 1e-7) > 0.1);
}

/// Kinetic energy of a wave of both after each of 50 steps of a hundred stopping times, over that at the start.
fn solved(reconstructed: bool) -> Vec<f64> {
    let (none, k) = (ArtificialViscosity { linear: 0.0, quadratic: 0.0 }, 1e-6);
    let slow = |x: &Vector<f64, 2>| Vector([0.0, 1e-5 * (2.0 * PI * x[0] / SIDE).sin()]);
    let mixture = box_of(k, DragScheme::BackwardEuler, 0.0, slow, slow);
    let mixture =
        mixture.with_artificial_viscosity(none).unwrap().with_soil_artificial_viscosity(none).unwrap();
    let mut mixture = if reconstructed { mixture.with_reconstructed_drag() } else { mixture };
    mixture.evaluate().unwrap();
    let dt = 100.0 / drag_rate(&mixture, k);
    let before = mixture.budget().kinetic;
    let mut step = || {
        mixture.evaluate().unwrap();
        mixture.complete(Moment::Now, dt).unwrap();
        mixture.advance(Moment::Now, Moment::Now, dt);
        mixture.budget().kinetic / before
    };
    (0..50).map(|_| step()).collect()
}

#[test]
fn however_stiff_the_common_motion_stays() {
    let (plain, left) = (solved(false), solved(true));
    assert!(plain[0] < 0.1, "plain drag damps it: {}", plain[0]);
    assert!(left[0] > 0.8, "{}", left[0]);
    assert!(left.windows(2).all(|pair| pair[1] <= pair[0]), "it never grows: {left:?}");
}

/// The largest growth in a step of 60, from wild velocities on a random heap, of the kinetic energy and of the energy
/// ½ v·(M + Δt L) v, in a step Δt of `stiffness` stopping times; L of plain drag, whose power is v·L v.
fn growth(scheme: DragScheme, stiffness: f64) -> [f64; 2] {
    let (none, k) = (ArtificialViscosity { linear: 0.0, quadratic: 0.0 }, 1e-8);
    let make = |scheme: DragScheme| {
        let mixture = heap(By::Nothing).with_drag(darcy(k)).with_drag_scheme(scheme);
        mixture.with_artificial_viscosity(none).unwrap().with_soil_artificial_viscosity(none).unwrap()
    };
    let mut plain = make(DragScheme::Explicit);
    plain.evaluate().unwrap();
    // So short that nothing but drag acts.
    let dt = stiffness * plain.limits().drag;
    let mut mixture = make(scheme).with_reconstructed_drag();
    let mut sizes = |mixture: &Both<f64>| {
        plain.soil_mut().velocities_mut().copy_from_slice(mixture.soil().velocities());
        plain.water_mut().velocities_mut().copy_from_slice(mixture.water().velocities());
        plain.evaluate().unwrap();
        let kinetic = plain.budget().kinetic;
        [kinetic, kinetic + 0.5 * dt * plain.exchange_rate().taken[Account::Drag]]
    };
    let (mut before, mut most) = (sizes(&mixture), [f64::NEG_INFINITY; 2]);
    let start = before[0];
    for _ in 0..60 {
        mixture.evaluate().unwrap();
        mixture.complete(Moment::Now, dt).unwrap();
        mixture.advance(Moment::Now, Moment::Now, dt);
        let now = sizes(&mixture);
        most = [0, 1].map(|n| most[n].max(now[n] / before[n] - 1.0));
        before = now;
    }
    let left = sizes(&mixture)[0] / start;
    assert!(left < 0.9, "{scheme:?}, {stiffness:e}: drag has done nothing, {left}");
    most
}

#[test]
fn solved_over_the_step_wild_velocities_never_gain_energy() {
    for scheme in [DragScheme::BackwardEuler, DragScheme::SecondOrder] {
        for stiffness in [0.01, 0.1, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5] {
            let [kinetic, of_both] = growth(scheme, stiffness);
            assert!(kinetic < 0.0 && of_both < 0.0, "{scheme:?}, {stiffness:e}: {kinetic:e}, {of_both:e}");
        }
    }
}

#[test]
fn a_resumed_run_has_the_same_bits() {
    let ergun = || Ergun::new(1e-3, 1e-3).unwrap();
    for scheme in [DragScheme::Explicit, DragScheme::BackwardEuler] {
        let make = || {
            let slow = |x: &Vector<f64, 2>| Vector([0.01 * (10.0 * x[1]).sin(), 0.0]);
            let mixture = box_of(K, scheme, 0.2, |_| Vector::zero(), slow).with_drag(ergun());
            let mixture = mixture.with_reconstructed_drag().with_normalised_drag();
            let step = StepSize::fixed(2e-5).unwrap();
            Simulation::new(mixture, VelocityVerlet::new(), step)
        };
        let mut run = make();
        (0..5).for_each(|_| _ = run.step().unwrap());
        let snapshot = run.snapshot();
        (0..5).for_each(|_| _ = run.step().unwrap());
        let mut resumed = make();
        resumed.restore(snapshot).unwrap();
        (0..5).for_each(|_| _ = resumed.step().unwrap());
        assert_eq!(bits(run.mixture()), bits(resumed.mixture()));
        assert_eq!(run.budget(), resumed.budget());
    }
}

#[test]
fn it_is_not_projected() {
    let still = |_: &Vector<f64, 2>| Vector::zero();
    let mixture = box_of(K, DragScheme::Explicit, 0.0, still, still);
    let step = StepSize::fixed(1e-5).unwrap();
    let mixture = mixture.with_projected_drag().with_reconstructed_drag();
    let error = Simulation::new(mixture, LeapFrog::new(), step).step().unwrap_err();
    assert_eq!(error, StepError::ProjectedDragReconstructed);
    assert!(error.to_string().contains("not both"));
}
