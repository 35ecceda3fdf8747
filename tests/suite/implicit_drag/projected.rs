//! Drag along the line between particles.

use super::{Both, H, SPACING, box_of, darcy};
use alluvium::Vector;
use alluvium::budget::Account;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Elasticity, NoDrag, Soil, Unyielding, Water};
use alluvium::mixture::{DragScheme, Mixture, Phase};
use alluvium::setup;
use alluvium::time::{Evolve, Moment};

#[derive(Clone, Copy, PartialEq)]
pub(super) enum By {
    Nothing,
    Plain,
    Projected,
    ProjectedAndSolved,
    PlainAndSolved,
    Reconstructed,
    ReconstructedAndNormalised,
    ReconstructedAndSolved,
}

/// A heap of soil and water in disorder, with random velocities and nothing around.
pub(super) fn heap(by: By) -> Both<f64> {
    let mut state = 9_u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut places = || -> Vec<Vector<f64, 2>> {
        let lattice = setup::fill::<f64, 2>([0.0; 2], [0.5; 2], SPACING);
        lattice.iter().map(|x| *x + Vector([random(), random()]) * (0.5 * SPACING)).collect()
    };
    let volume = SPACING * SPACING;
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).unwrap();
    let mut soil = Phase::new(Soil::new(2650.0, elasticity, Unyielding).unwrap());
    soil.add(&places(), volume, |_| 0.0).unwrap();
    soil.set_volume_fraction(|_| 0.5);
    soil.set_velocity(|x| Vector([(40.0 * x[1]).sin(), (30.0 * x[0]).cos()]));
    let mut water = Phase::new(Water::new(1000.0, 30.0).unwrap());
    water.add(&places(), volume, |_| 0.0).unwrap();
    water.set_velocity(|x| Vector([(25.0 * x[0]).cos(), (35.0 * x[0] * x[1]).sin()]));
    let mixture = Mixture::new(WendlandC2::new(H).unwrap(), soil, water);
    let mut mixture = match by {
        By::Nothing => mixture.with_drag(NoDrag),
        By::Plain => mixture.with_drag(darcy(1e-3)),
        By::Projected => mixture.with_drag(darcy(1e-3)).with_projected_drag(),
        By::ProjectedAndSolved => {
            mixture.with_drag(darcy(1e-6)).with_projected_drag().with_drag_scheme(DragScheme::BackwardEuler)
        }
        By::PlainAndSolved => mixture.with_drag(darcy(1e-6)).with_drag_scheme(DragScheme::BackwardEuler),
        By::Reconstructed => mixture.with_drag(darcy(1e-3)).with_reconstructed_drag(),
        By::ReconstructedAndNormalised => {
            mixture.with_drag(darcy(1e-3)).with_reconstructed_drag().with_normalised_drag()
        }
        By::ReconstructedAndSolved => mixture
            .with_drag(darcy(1e-3))
            .with_reconstructed_drag()
            .with_drag_scheme(DragScheme::BackwardEuler),
    };
    mixture.evaluate().unwrap();
    mixture
}

/// What drag gives of momentum and of angular momentum, relative; its power less the account's, relative.
pub(super) fn given(by: By) -> [f64; 3] {
    given_to(&heap(by))
}

fn given_to(with: &Both<f64>) -> [f64; 3] {
    let without = heap(By::Nothing);
    let (mut momentum, mut turning, mut power) = (Vector([0.0; 2]), 0.0, 0.0);
    let (mut size, mut lever) = (0.0, 0.0);
    let mut add = |x: Vector<f64, 2>, v: Vector<f64, 2>, force: Vector<f64, 2>| {
        momentum += force;
        turning += x[0] * force[1] - x[1] * force[0];
        power += force.dot(v);
        size += force.norm();
        lever += force.norm() * x.norm();
    };
    let (s, w) = (with.soil(), with.water());
    for i in 0..s.len() {
        let force = (s.accelerations()[i] - without.soil().accelerations()[i]) * s.masses()[i];
        add(s.positions()[i], s.velocities()[i], force);
    }
    for a in 0..w.len() {
        let force = (w.accelerations()[a] - without.water().accelerations()[a]) * w.masses()[a];
        add(w.positions()[a], w.velocities()[a], force);
    }
    let taken = with.exchange_rate().taken[Account::Drag];
    [momentum.norm() / size, turning.abs() / lever, (power + taken).abs() / taken]
}

#[test]
fn it_conserves_angular_momentum_too() {
    let [momentum, turning, power] = given(By::Projected);
    assert!(momentum < 1e-13 && turning < 1e-13 && power < 1e-12, "{momentum:e} {turning:e} {power:e}");
    // Plain drag does not.
    let [momentum, turning, power] = given(By::Plain);
    assert!(momentum < 1e-13 && turning > 1e-4 && power < 1e-12, "{momentum:e} {turning:e} {power:e}");
}

#[test]
fn on_coincident_lattices_it_lacks_the_particles_at_the_same_place() {
    let rate = |is_projected: bool| {
        let moving = |_: &Vector<f64, 2>| Vector([1e-3, 0.0]);
        let mixture = box_of(1e-3, DragScheme::Explicit, 0.0, |_| Vector::zero(), moving);
        let mut mixture = if is_projected { mixture.with_projected_drag() } else { mixture };
        mixture.evaluate().unwrap();
        mixture.soil().accelerations()[7][0]
    };
    // W(0) Δx² = 7/(4π 1.5²), of a sum of 1.0051.
    let missing = 7.0 / (4.0 * core::f64::consts::PI * 2.25) / 1.0051;
    let part = rate(true) / rate(false);
    assert!((part - (1.0 - missing)).abs() < 1e-3, "{part} for {}", 1.0 - missing);
}

#[test]
fn solved_over_the_step_it_conserves_angular_momentum_to_the_tolerance() {
    let solved = |by, dt| {
        let mut mixture = heap(by);
        mixture.complete(Moment::Now, dt).unwrap();
        given_to(&mixture)
    };
    // A hundred times the stopping time.
    let [momentum, turning, _] = solved(By::ProjectedAndSolved, 1e-4);
    assert!(momentum < 1e-13 && turning < 1e-9, "{momentum:e} {turning:e}");
    let [momentum, turning, _] = solved(By::PlainAndSolved, 1e-4);
    assert!(momentum < 1e-13 && turning > 1e-4, "{momentum:e} {turning:e}");
}

#[test]
fn over_a_short_step_it_is_what_is_evaluated() {
    let mut solved = heap(By::ProjectedAndSolved);
    solved.complete(Moment::Now, 1e-12).unwrap();
    let with = |by: By| {
        let heap = heap(by);
        [heap.soil().accelerations(), heap.water().accelerations()].concat()
    };
    // Drag is linear in 1/k: a thousand times that of the heap with k = 1e-3 m/s.
    let (evaluated, without) = (with(By::Projected), with(By::Nothing));
    let found = [solved.soil().accelerations(), solved.water().accelerations()].concat();
    let (mut apart, mut size) = (0.0_f64, 0.0_f64);
    for ((found, evaluated), without) in found.iter().zip(&evaluated).zip(&without) {
        let expected = (*evaluated - *without) * 1e3;
        apart = apart.max((*found - *without - expected).norm());
        size = size.max(expected.norm());
    }
    assert!(apart < 1e-5 * size, "{apart:e} of {size:e}");
}
