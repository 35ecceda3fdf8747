//! The direct solution against the iteration, over clouds of any kind.

use super::{Both, SPACING, box_of};
use alluvium::Vector;
use alluvium::mixture::{DragScheme, DragSolver};
use alluvium::time::{Evolve, LeapFrog, Moment, StepSize};
use proptest::prelude::*;

/// Soil, some of it held, and water in disorder with random velocities; drag along the lines between particles, or
/// along the slip.
fn cloud(seed: u64, conductivity: f64, floor: f64, solver: DragSolver, along: bool) -> Both<f64> {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let still = |_: &Vector<f64, 2>| Vector::zero();
    let mut mixture = box_of(conductivity, DragScheme::BackwardEuler, floor, still, still);
    for x in mixture.soil_mut().positions_mut().iter_mut() {
        *x += Vector([random(), random()]) * (0.6 * SPACING);
    }
    for x in mixture.water_mut().positions_mut().iter_mut() {
        *x += Vector([random(), random()]) * (0.6 * SPACING);
    }
    for v in mixture.soil_mut().velocities_mut().iter_mut() {
        *v = Vector([random(), random()]);
    }
    for v in mixture.water_mut().velocities_mut().iter_mut() {
        *v = Vector([random(), random()]);
    }
    let mixture = mixture.with_gravity(Vector([0.0, -9.81])).with_drag_solver(solver);
    if along { mixture.with_projected_drag() } else { mixture }
}

/// Effective accelerations over a step, soil first, with the masses; and how many particles are held.
fn solved(
    seed: u64,
    k: f64,
    floor: f64,
    solver: DragSolver,
    along: bool,
) -> (Vec<(f64, Vector<f64, 2>)>, usize) {
    let mut mixture = cloud(seed, k, floor, solver, along);
    mixture.evaluate().unwrap();
    mixture.complete(Moment::Now, DT).unwrap();
    let (soil, water) = (mixture.soil(), mixture.water());
    let masses = soil.masses().iter().chain(water.masses()).copied();
    let all = masses.zip(soil.accelerations().iter().chain(water.accelerations()).copied()).collect();
    (all, soil.wall_particles())
}

const DT: f64 = 5e-4;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn both_solvers_find_the_same_velocities(seed in 1_u64..10_000, exponent in -9.0_f64..-0.5, floor in 0.0_f64..0.3, along in any::<bool>()) {
        let k = 10_f64.powf(exponent);
        let (iterative, held) = solved(seed, k, floor, DragSolver::Iterative, along);
        let (direct, _) = solved(seed, k, floor, DragSolver::Direct, along);
        // κ = 4 Δt C_d/(ρ_s + ρ_f); velocities are up to 0.7 m/s.
        let condition = 4.0 * DT * 0.25 * 1000.0 * 9.81 / k / 1825.0;
        let allowed = (10.0 * condition * f64::EPSILON).max(1e-9);
        let mut momentum = Vector([0.0; 2]);
        let mut size = 0.0;
        for (n, ((m, a), (_, b))) in iterative.iter().zip(&direct).enumerate() {
            // What held particles resist is no velocity: relative.
            let apart = (*a - *b).norm() * DT / if n < held { 1.0 + a.norm() * DT } else { 1.0 };
            prop_assert!(apart <= allowed, "particle {n} of {held} held: {apart:e} m/s");
            momentum += (*a - *b) * *m;
            size += m * (a.norm() + b.norm());
        }
        prop_assert!(momentum.norm() <= 1e-13 * size, "{:e}", momentum.norm() / size);
    }
}

#[test]
fn a_run_with_factors_is_that_without_and_resumes() {
    let run = |solver| {
        let step = StepSize::courant(0.2).unwrap();
        super::Run::new(cloud(3, 1e-6, 0.15, solver, false), LeapFrog::new(), step)
    };
    let (mut direct, mut iterative) = (run(DragSolver::Direct), run(DragSolver::Iterative));
    for _ in 0..15 {
        direct.step().unwrap();
        iterative.step().unwrap();
    }
    let velocities = |run: &super::Run<f64, LeapFrog<f64>>| {
        let water = run.mixture().water();
        let mut all: Vec<_> = water.ids().iter().copied().zip(water.velocities().to_vec()).collect();
        all.sort_by_key(|(id, _)| *id);
        all
    };
    for ((_, a), (_, b)) in velocities(&direct).iter().zip(&velocities(&iterative)) {
        assert!((*a - *b).norm() < 1e-7, "{:?} {:?}", a.0, b.0);
    }
    let snapshot = direct.snapshot();
    let mut resumed = run(DragSolver::Direct);
    resumed.restore(snapshot).unwrap();
    for _ in 0..15 {
        direct.step().unwrap();
        resumed.step().unwrap();
    }
    assert!(super::bits(direct.mixture()) == super::bits(resumed.mixture()));
}
