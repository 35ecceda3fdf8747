//! The same bits whatever the threads, the instructions and the search.

use crate::bench::Bench;
use alluvium::kernel::WendlandC2;
use alluvium::neighbours::{BruteForce, CellList, NeighbourSearch};
use alluvium::parallel::Threads;
use alluvium::summation::{Form, Neighbourhood};
use alluvium::verify::{Arrangement, Conditions, Expected, Measured, ShortSighted, Study};
use alluvium::{InstructionSet, Real};

const SHORT: &str = "search 1 % short of the support";

pub fn studies() -> Vec<Study> {
    let study = |name: &str, run: fn(&Conditions) -> Measured| {
        Study::new(name, "sums are the same to the last bit for any threads, instructions and search", run)
            .source("each particle adds its own neighbours in ascending order")
            .expect(Expected::Identical)
            .mutant(SHORT)
    };
    vec![
        study("identity/2d/f64", differences::<f64, 2>),
        study("identity/2d/f32", differences::<f32, 2>),
        study("identity/3d/f64", differences::<f64, 3>),
        study("identity/3d/f32", differences::<f32, 3>),
    ]
}

/// How many numbers differ from those of one thread, one lane and the search of all pairs.
fn differences<T: Real, const D: usize>(conditions: &Conditions) -> Measured {
    let oracle = bits::<T, D>(Box::<BruteForce>::default(), "scalar", 1);
    let mut values = Vec::new();
    let most = if conditions.is(SHORT) { 1 } else { 3 };
    for threads in 1..=most {
        for set in InstructionSet::NAMES {
            let search: Box<dyn NeighbourSearch<T, D>> = match conditions.is(SHORT) {
                // The list reaches a tenth further than the support: less would not be a mistake.
                true => Box::new(ShortSighted::new(Box::<BruteForce>::default(), 0.99 / 1.1)),
                false => Box::<CellList<T, D>>::default(),
            };
            let found = bits::<T, D>(search, set, threads);
            let different = oracle.iter().zip(&found).filter(|(a, b)| a != b).count();
            let missing = oracle.len().abs_diff(found.len());
            values.push((format!("{threads} threads, {set}"), (different + missing) as f64));
        }
    }
    Measured::values(values)
}

/// The bits of gradients and matrices of a disordered cloud of several parts.
fn bits<T: Real, const D: usize>(
    search: Box<dyn NeighbourSearch<T, D>>,
    set: &str,
    threads: usize,
) -> Vec<u64> {
    let arrangement = Arrangement::<D>::jittered(if D == 2 { 70 } else { 17 }, 0.3, 5);
    let kernel = WendlandC2::<T, D>::new(T::of(1.3 * arrangement.spacing)).expect("a length");
    let set = InstructionSet::at_most(set).expect("a name of the list");
    let threads = Threads::new(threads).expect("a few threads");
    threads.install(|| {
        let neighbourhood = Neighbourhood::new(search, T::of(2.6 * arrangement.spacing))
            .with_instruction_set(set)
            .with_periodic(arrangement.periodic().expect("a box with an extent"));
        let bench = Bench::with_neighbourhood(&arrangement, kernel, neighbourhood);
        let values = bench.field(|x| (3.0 * x[0] - 2.0 * x[1]).sin());
        let gradients = bench.cloud().gradient(Form::Symmetric, &values);
        let matrices = bench.cloud().corrections().matrices;
        let numbers = gradients.iter().flat_map(|g| g.0).chain(matrices.into_iter().flatten().flatten());
        numbers.map(Real::bits).collect()
    })
}
