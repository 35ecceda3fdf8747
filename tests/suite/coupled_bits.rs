//! Soil and water with what is not there by default, all at once: a kernel of its own between them, drag of
//! reconstructed velocities with normalised weights, explicit and solved, summed volume fractions and cavities. A run has the same bits for any threads,
//! instructions and search, and if it is kept and resumed on the way.

use crate::fingerprint::hash;
use alluvium::kernel::{WendlandC2, WendlandC4};
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{DragScheme, Mixture, Phase, VolumeFraction};
use alluvium::neighbours::{BruteForce, Periodic};
use alluvium::parallel::Threads;
use alluvium::simulation::Simulation;
use alluvium::time::{Integrator, LeapFrog, StepSize, VelocityVerlet};
use alluvium::{InstructionSet, Real, Vector, setup};
use core::f64::consts::TAU;

type Both<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>>;
type Run<T, const D: usize, I> = Simulation<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>, I>;

const STEPS: usize = 40;
/// The pressure at which the water cavitates \[Pa\].
const LEAST: f64 = -500.0;

/// In a unit box that repeats itself, soil and water streaming through each other in swirls of 3 m/s.
fn cloud<T: Real, const D: usize>(scheme: DragScheme) -> Both<T, D> {
    // More particles than a task of the parallel loops takes.
    let side = if D == 2 { 46 } else { 13 };
    let spacing = 1.0 / f64::from(side);
    let mut state = 3_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        0.3 * spacing * ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
    };
    let lattice = setup::fill::<f64, D>([0.0; D], [1.0; D], spacing);
    let mut places = || -> Vec<Vector<T, D>> {
        lattice.iter().map(|x| Vector::of(core::array::from_fn(|k| x[k] + random()))).collect()
    };
    let swirl = |phase: f64| {
        move |x: &Vector<T, D>| {
            let x = x.as_f64();
            Vector::of(core::array::from_fn(|k| 3.0 * (TAU * x[(k + 1) % D] + phase + k as f64).sin()))
        }
    };
    let volume = T::of(spacing.powi(D as i32));
    let elasticity = Elasticity::from_bulk(T::of(0.7e6), T::of(0.3)).unwrap();
    let mut soil = Phase::new(Soil::new(T::of(2650.0), elasticity, Unyielding).unwrap());
    soil.add(&places(), volume, |_| T::ZERO).unwrap();
    soil.set_volume_fraction(|x| T::of(0.4 + 0.1 * (TAU * x[0].as_f64()).cos()));
    soil.set_velocity(swirl(0.0));
    let law = Water::new(T::of(1000.0), T::of(30.0)).unwrap().with_cavitation(T::of(LEAST)).unwrap();
    let mut water = Phase::new(law);
    water.add(&places(), volume, |_| T::ZERO).unwrap();
    water.set_velocity(swirl(1.0));
    let between = WendlandC4::new(T::of(1.2 * spacing)).unwrap();
    Mixture::new(WendlandC2::new(T::of(1.5 * spacing)).unwrap(), soil, water)
        .with_interphase_kernel(between)
        .unwrap()
        .with_periodic(Periodic::new(Vector::zero(), [Some(T::ONE); D]).unwrap())
        .with_drag(Darcy::new(Conductivity::new(T::of(0.02)).unwrap()))
        .with_drag_scheme(scheme)
        .with_reconstructed_drag()
        .with_normalised_drag()
        .with_volume_fraction(VolumeFraction::Sum)
}

fn steps<T: Real, const D: usize, I: Integrator<T>>(run: &mut Run<T, D, I>, count: usize, threads: usize) {
    Threads::new(threads).unwrap().install(|| (0..count).for_each(|_| _ = run.step().unwrap()));
}

fn agrees<T: Real, const D: usize>(scheme: DragScheme, integrator: impl Integrator<T>) {
    let what = format!("{} {D}D {scheme:?} {}", T::NAME, integrator.name());
    let step = StepSize::courant(T::of(0.2)).unwrap();
    let run = |mixture: Both<T, D>| Simulation::new(mixture, integrator.clone(), step);
    let own = || run(cloud::<T, D>(scheme));
    let mut whole = own();
    steps(&mut whole, STEPS, 1);
    let (mixture, expected) = (whole.mixture(), hash(whole.mixture()));
    let renewed = [mixture.soil_neighbourhood().rebuilds(), mixture.water_neighbourhood().rebuilds()];
    assert!(renewed.into_iter().all(|times| times >= 3), "{what}: lists made {renewed:?} times");
    let open = mixture.water().pressures().iter().filter(|p| p.as_f64() == LEAST).count();
    assert!(open > 0 && open < mixture.water().len(), "{what}: {open} particles cavitate");
    let same = |run: &Run<T, D, _>, how: &str| {
        assert_eq!(hash(run.mixture()), expected, "{what}: {how}");
        assert_eq!(run.budget(), whole.budget(), "{what}: {how}");
    };
    // The narrowest lanes on three threads; the widest there are on one above.
    let narrow = InstructionSet::at_most(InstructionSet::NAMES[0]).unwrap();
    let mut other = run(cloud::<T, D>(scheme).with_instruction_set(narrow));
    steps(&mut other, STEPS, 3);
    same(&other, "three threads, other instructions");
    let mut other = run(cloud::<T, D>(scheme).with_search(|| Box::<BruteForce>::default()));
    steps(&mut other, STEPS, 2);
    same(&other, "every pair looked at");
    let (mut half, mut resumed) = (own(), own());
    steps(&mut half, STEPS / 2, 2);
    resumed.restore(half.snapshot()).unwrap();
    steps(&mut resumed, STEPS - STEPS / 2, 2);
    same(&resumed, "resumed");
}

#[test]
fn explicit_drag() {
    agrees::<f64, 2>(DragScheme::Explicit, LeapFrog::new().with_third_order_density());
    agrees::<f64, 2>(DragScheme::Explicit, LeapFrog::new());
    agrees::<f64, 2>(DragScheme::Explicit, VelocityVerlet::new());
    agrees::<f32, 3>(DragScheme::Explicit, LeapFrog::new().with_third_order_density());
}

#[cfg(feature = "implicit")]
#[test]
fn solved_drag() {
    agrees::<f64, 2>(DragScheme::BackwardEuler, LeapFrog::new().with_third_order_density());
    agrees::<f64, 2>(DragScheme::BackwardEuler, VelocityVerlet::new());
    agrees::<f32, 3>(DragScheme::SecondOrder, LeapFrog::new().with_third_order_density());
}
