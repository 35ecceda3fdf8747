//! A small column of sand: the same bits for any number of threads, any search, any instructions, and
//! across a restart; a stop that names what went wrong.

use crate::fingerprint::hash;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Absent, Cone, DruckerPrager, Elasticity, LateralRatio, Soil, SoilMemory};
use alluvium::mixture::{ArtificialStress, Mixture, Phase, Slip, StepError, Wall};
use alluvium::neighbours::{BruteForce, CellList};
use alluvium::parallel::Threads;
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, LeapFrog, StepSize, VelocityVerlet};
use alluvium::{InstructionSet, Real, SymTensor, Vector, setup};

const SPACING: f64 = 0.008;
const COLUMN: [f64; 3] = [0.12, 0.08, 0.06];
const TRAY: [f64; 3] = [0.3, 0.1, 0.06];

type Sand<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T>, Absent>;
type Run<T, const D: usize> = Simulation<T, D, WendlandC2<T, D>, Soil<T>, Absent>;

fn column<T: Real, const D: usize>(wall: Wall<T, D>) -> Sand<T, D> {
    let elasticity = Elasticity::from_bulk(T::of(0.7e6), T::of(0.3)).unwrap();
    let cone = Cone::PlaneStrainNonDilatant;
    let friction = T::of(19.8_f64.to_radians());
    let cone = DruckerPrager::cohesive(cone, friction, T::ZERO, T::of(50.0)).unwrap();
    let ratio = LateralRatio::new(&elasticity, &cone).admissible();
    let mut soil = Phase::new(Soil::new(T::of(2650.0), elasticity, cone).unwrap());
    let volume = T::of(SPACING.powi(D as i32));
    let first = |x: [f64; 3]| core::array::from_fn::<f64, D, _>(|k| x[k]);
    let closed = core::array::from_fn(|k| (true, k == 2));
    let tray = setup::tank([0.0; D], first(TRAY), SPACING, 3, closed);
    soil.add_wall(wall, &tray, volume, |_| T::ZERO).unwrap();
    soil.add(&setup::fill([0.0; D], first(COLUMN), SPACING), volume, |_| T::ZERO).unwrap();
    soil.set_stress(|x| {
        let depth = (COLUMN[1] - x[1].as_f64()).clamp(0.0, COLUMN[1]);
        SoilMemory::geostatic(T::of(-2650.0 * 9.81 * depth), ratio, 1).stress
    });
    let mut down = Vector::zero();
    down[1] = T::of(-9.81);
    let artificial = ArtificialStress { strength: T::of(0.3), exponent: 4, spacing: T::of(SPACING) };
    Mixture::of_soil(WendlandC2::new(T::of(1.3 * SPACING)).unwrap(), soil)
        .with_gravity(down)
        .with_artificial_stress(artificial)
        .unwrap()
}

fn run<T: Real, const D: usize>(mixture: Sand<T, D>) -> Run<T, D> {
    let step = StepSize::courant(T::of(0.2)).unwrap();
    Simulation::new(mixture, LeapFrog::new(), step).with_stress_regularisation(50)
}

fn state_after<T: Real, const D: usize>(mixture: Sand<T, D>, threads: usize) -> u64 {
    let mut run = run(mixture);
    Threads::new(threads).unwrap().install(|| {
        for _ in 0..200 {
            run.step().unwrap();
        }
        hash(run.mixture())
    })
}

fn agrees<T: Real, const D: usize>(wall: &Wall<T, D>) {
    let mixture = || column::<T, D>(wall.clone());
    let reference = state_after(mixture(), 1);
    let what = format!("{} {D}D {:?}", T::NAME, wall.kind());
    for threads in [2, 3] {
        assert_eq!(state_after(mixture(), threads), reference, "{what}: {threads} threads");
    }
    for name in InstructionSet::NAMES {
        let set = InstructionSet::at_most(name).unwrap();
        assert_eq!(state_after(mixture().with_instruction_set(set), 1), reference, "{what}: {name}");
    }
    let brute = mixture().with_search(|| Box::new(BruteForce::default()));
    assert_eq!(state_after(brute, 1), reference, "{what}: brute force");
    let cells = mixture().with_search(|| Box::<CellList<T, D>>::default());
    assert_eq!(state_after(cells, 2), reference, "{what}: cell list");
    #[cfg(feature = "kd-tree")]
    {
        let tree = mixture().with_search(|| Box::<alluvium::neighbours::KdTree<T, D>>::default());
        assert_eq!(state_after(tree, 2), reference, "{what}: kd-tree");
    }
}

#[test]
fn soil_has_the_same_bits_however_it_is_computed() {
    agrees::<f64, 2>(&Wall::extrapolated(Slip::NoSlip));
    agrees::<f32, 2>(&Wall::extrapolated(Slip::Friction(0.3)));
    agrees::<f64, 3>(&Wall::dynamic());
}

#[test]
fn a_resumed_run_of_soil_has_the_same_bits() {
    let mut whole = run(column::<f64, 2>(Wall::extrapolated(Slip::Friction(0.3))));
    let steps = |run: &mut Run<f64, 2>| {
        for _ in 0..150 {
            run.step().unwrap();
        }
    };
    steps(&mut whole);
    let snapshot = whole.snapshot();
    steps(&mut whole);
    let mut resumed = run(column::<f64, 2>(Wall::extrapolated(Slip::Friction(0.3))));
    resumed.restore(snapshot).unwrap();
    steps(&mut resumed);
    assert_eq!(hash(resumed.mixture()), hash(whole.mixture()));
    assert_eq!(resumed.budget(), whole.budget());
    assert!(whole.mixture().soil_neighbourhood().rebuilds() > 1, "the list was never renewed");
}

#[test]
fn stress_that_is_not_a_number_is_named() {
    let mut run = run(column::<f64, 2>(Wall::extrapolated(Slip::NoSlip)));
    run.step().unwrap();
    run.mixture_mut().soil_mut().set_stress(|_| SymTensor([f64::NAN; 6]));
    let Err(StepError::NotFinite { culprit, field, .. }) = run.step() else {
        panic!("a step with a stress that is no number");
    };
    assert_eq!((culprit.kind.split(' ').next(), field), (Some("soil"), "memory"));
}

#[test]
fn a_lone_constituent_is_what_a_mixture_with_an_empty_one_is() {
    let mut alone = run(column::<f64, 2>(Wall::dynamic()));
    let (kernel, soil) = (*alone.mixture().kernel(), alone.mixture().soil().clone());
    let artificial = ArtificialStress { strength: 0.3, exponent: 4, spacing: SPACING };
    let water = Phase::new(alluvium::material::Water::new(1000.0, 10.0).unwrap());
    let beside = Mixture::<f64, 2, _, _, _>::new(kernel, soil, water);
    let beside = beside.with_gravity(alone.mixture().gravity()).with_artificial_stress(artificial).unwrap();
    let step = StepSize::courant(0.2).unwrap();
    let mut beside = Simulation::new(beside, LeapFrog::new(), step).with_stress_regularisation(50);
    for _ in 0..50 {
        alone.step().unwrap();
        beside.step().unwrap();
    }
    assert_eq!(alone.mixture().soil().positions(), beside.mixture().soil().positions());
}

#[test]
fn the_ledger_of_flowing_sand_closes() {
    for wall in [Wall::dynamic(), Wall::extrapolated(Slip::NoSlip), Wall::extrapolated(Slip::Friction(0.2))] {
        let step = StepSize::courant(0.1).unwrap();
        let mut run = Simulation::new(column::<f64, 2>(wall.clone()), VelocityVerlet::new(), step);
        run.start().unwrap();
        let start = run.budget();
        let _ = run.run_until(0.05, |_| core::ops::ControlFlow::Continue(())).unwrap();
        let now = run.budget();
        let plastic = now.taken[alluvium::budget::Account::Plastic];
        assert!(plastic > 1e-3 * start.potential, "it flowed: {plastic} J");
        let closure = now.closure(&start).abs() / start.potential;
        assert!(closure < 1e-4, "{:?}: {closure:e}", wall.kind());
    }
}

#[test]
fn a_probe_and_the_surface_see_the_soil() {
    let mut mixture = column::<f64, 2>(Wall::extrapolated(Slip::NoSlip));
    mixture.evaluate().unwrap();
    let probe = mixture.probe_soil(&Vector([0.06, 0.04]));
    assert!((probe.support - 1.0).abs() < 0.05 && probe.pressure > 500.0, "{probe:?}");
    let surface = mixture.soil_surface(&Vector([0.06, 0.0]), 1).unwrap();
    assert!((surface - COLUMN[1]).abs() < 1e-9, "{surface}");
    assert!(mixture.surface(&Vector([0.06, 0.0]), 1).is_none(), "there is no water");
}
