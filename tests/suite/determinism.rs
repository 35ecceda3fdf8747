//! The state after 200 steps of a dam break is the same to the last bit for any number of threads,
//! any neighbour search and any instruction set; and the hash that says so is not blind.

use crate::fingerprint::hash;
use crate::tank::Dam;
use alluvium::mixture::{ArtificialViscosity, Mixture, Slip, Wall};
use alluvium::neighbours::{BruteForce, CellList};
use alluvium::parallel::Threads;
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::{InstructionSet, Real};

const STEPS: usize = 200;

fn state_after<T: Real, const D: usize>(mixture: Mixture<T, D>, threads: usize) -> u64 {
    let mut run = Simulation::new(
        mixture,
        LeapFrog::new().with_third_order_density(),
        StepSize::courant(T::of(0.2)).unwrap(),
    );
    Threads::new(threads).unwrap().install(|| {
        for _ in 0..STEPS {
            run.step().unwrap();
        }
        assert!(run.mixture().water_neighbourhood().rebuilds() > 1, "nothing was ever re-sorted");
        hash(run.mixture())
    })
}

fn agrees<T: Real, const D: usize>(dam: Dam, wall: &Wall<T, D>) {
    let mixture = || dam.mixture::<T, D>(wall.clone());
    let what = format!("{} {D}D {:?}, {} particles", T::NAME, wall.kind(), mixture().water().len());
    let reference = state_after(mixture(), 1);
    for threads in [2, 3] {
        assert_eq!(state_after(mixture(), threads), reference, "{what}: {threads} threads");
    }
    for name in InstructionSet::NAMES {
        let set = InstructionSet::at_most(name).unwrap();
        let state = state_after(mixture().with_instruction_set(set), 1);
        assert_eq!(state, reference, "{what}: instructions {name}");
    }
    let brute = mixture().with_search(|| Box::new(BruteForce::default()));
    assert_eq!(state_after(brute, 2), reference, "{what}: brute force");
    let cells = mixture().with_search(|| Box::<CellList<T, D>>::default());
    assert_eq!(state_after(cells, 2), reference, "{what}: cell list");
    #[cfg(feature = "kd-tree")]
    {
        let tree = mixture().with_search(|| Box::<alluvium::neighbours::KdTree<T, D>>::default());
        assert_eq!(state_after(tree, 2), reference, "{what}: kd-tree");
    }
}

/// More particles than a task of the parallel loops takes.
const PLANE: Dam = Dam { spacing: 0.0025, ..Dam::SMALL };
const SPACE: Dam = Dam { water: [0.1, 0.1, 0.08], tank: [0.2, 0.14, 0.08], spacing: 0.01 };

#[test]
fn plane_dynamic_walls() {
    agrees::<f64, 2>(PLANE, &Wall::dynamic());
    agrees::<f32, 2>(PLANE, &Wall::dynamic());
}

#[test]
fn plane_extrapolated_walls() {
    agrees::<f64, 2>(PLANE, &Wall::extrapolated(Slip::NoSlip));
    agrees::<f32, 2>(PLANE, &Wall::extrapolated(Slip::FreeSlip));
}

#[test]
fn space_dynamic_walls() {
    agrees::<f64, 3>(SPACE, &Wall::dynamic());
    agrees::<f32, 3>(SPACE, &Wall::dynamic());
}

#[test]
fn space_extrapolated_walls() {
    agrees::<f64, 3>(SPACE, &Wall::extrapolated(Slip::FreeSlip));
    agrees::<f32, 3>(SPACE, &Wall::extrapolated(Slip::NoSlip));
}

#[test]
fn the_hash_sees_the_last_bit_of_a_parameter() {
    let mixture = || Dam::SMALL.mixture::<f64, 2>(Wall::dynamic());
    let nearly = ArtificialViscosity { linear: 0.01 * (1.0 + f64::EPSILON), quadratic: 1.0 };
    let other = mixture().with_artificial_viscosity(nearly).unwrap();
    assert_ne!(state_after(other, 1), state_after(mixture(), 1));
}
