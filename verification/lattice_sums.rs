//! Sums over square and cubic lattices: kernel, search and pair loop together, to the last digits.

use crate::bench::Bench;
use alluvium::Real;
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::neighbours::{CellList, NeighbourSearch};
use alluvium::verify::{Arrangement, Conditions, Expected, Flawed, Measured, ShortSighted, Study};

/// Dimension, h/Δx, neighbours with the particle itself, ΣVW − 1, ΣV x ∂W/∂x + 1, ΣVWx²/h².
const TABLE: &str = include_str!("data/kernel_lattice_sums.csv");
const SOURCE: &str = "sums over lattice vectors by an independent program";
const CONSTANT: &str = "kernel constant off by 1e-6";
const LARGE: &str = "kernel constant off by 1e-4";
const SHORT: &str = "neighbour radius 1 % short";

/// Particles along an edge; a power of two, so that all positions are exact.
const SIDE: usize = 8;

pub fn studies() -> Vec<Study> {
    let claim = "neighbours, ΣVW and the gain of a linear gradient on a lattice, Wendland C2";
    let sums = |name: &str, run: fn(&Conditions) -> Measured, largest, mutant| {
        Study::new(name, claim, run)
            .equations(&["43", "44", "50"])
            .source(SOURCE)
            .expect(Expected::Bound { largest })
            .mutant(mutant)
    };
    let count = |name: &str, run: fn(&Conditions) -> Measured| {
        Study::new(name, "neighbours are all lattice vectors shorter than κh, strictly, and no other", run)
            .equations(&["41"])
            .expect(Expected::Identical)
            .mutant(SHORT)
    };
    vec![
        sums("lattice/sums/2d/f64", table::<f64, 2>, 1e-12, CONSTANT),
        sums("lattice/sums/3d/f64", table::<f64, 3>, 1e-12, CONSTANT),
        sums("lattice/sums/2d/f32", table::<f32, 2>, 4e-6, LARGE),
        sums("lattice/sums/3d/f32", table::<f32, 3>, 4e-6, LARGE),
        count("lattice/neighbours/2d", neighbours::<2>),
        count("lattice/neighbours/3d", neighbours::<3>),
    ]
}

fn kernel<T: Real, const D: usize>(ratio: f64) -> WendlandC2<T, D> {
    WendlandC2::new(T::of(ratio / SIDE as f64)).expect("a length")
}

/// Deviations from the table, at the particle where they are largest.
fn table<T: Real, const D: usize>(conditions: &Conditions) -> Measured {
    let mut values = Vec::new();
    for line in TABLE.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|x| x.parse().expect("a number")).collect();
        if row[0] != D as f64 {
            continue;
        }
        let factor = if conditions.is(CONSTANT) {
            1.0 + 1e-6
        } else if conditions.is(LARGE) {
            1.0 + 1e-4
        } else {
            1.0
        };
        let kernel = Flawed::scaled(kernel::<T, D>(row[1]), factor);
        let bench = Bench::new(&Arrangement::<D>::lattice(SIDE), kernel, true);
        let (shepard, corrections) = (bench.cloud().shepard(), bench.cloud().corrections());
        let worst = |deviation: &dyn Fn(usize) -> f64| {
            (0..bench.x.len()).map(deviation).fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a })
        };
        let name = |what| format!("{what}, h/Δx = {}", row[1]);
        values.push((name("neighbours"), worst(&|i| count(&bench, i) + 1.0 - row[2])));
        values.push((name("ΣVW"), worst(&|i| shepard[i].as_f64() - 1.0 - row[3])));
        let gain = |i: usize, k: usize| 1.0 / corrections.matrices[i][k][k].as_f64();
        for k in 0..D {
            values.push((name("gain"), worst(&|i| 1.0 - gain(i, k) - row[4])));
        }
    }
    Measured::values(values)
}

fn count<T: Real, K: Kernel<T, D>, const D: usize>(bench: &Bench<T, K, D>, i: usize) -> f64 {
    let mut count = 0.0;
    bench.neighbourhood.for_each_neighbour(&bench.x, i, |_, _, _| count += 1.0);
    count
}

/// Differences between neighbours found and lattice vectors counted.
fn neighbours<const D: usize>(conditions: &Conditions) -> Measured {
    let difference = |ratio: f64| {
        let search: Box<dyn NeighbourSearch<f64, D>> = match conditions.is(SHORT) {
            true => Box::new(ShortSighted::new(Box::<CellList<f64, D>>::default(), 0.99)),
            false => Box::<CellList<f64, D>>::default(),
        };
        let bench = Bench::with_search(&Arrangement::lattice(SIDE), kernel::<f64, D>(ratio), true, search);
        let expected = lattice_vectors::<D>(2.0 * ratio);
        let wrong = (0..bench.x.len()).filter(|&i| count(&bench, i) != expected).count();
        (format!("h/Δx = {ratio}"), wrong as f64)
    };
    // With 1.005, 1.12, 1.415 a ring lies just inside; with 1, 1.5, 2, 2.5 one lies on the edge.
    Measured::values([1.0, 1.005, 1.12, 1.415, 1.5, 2.0, 2.5].map(difference))
}

/// How many integer vectors but zero are shorter than `radius`.
fn lattice_vectors<const D: usize>(radius: f64) -> f64 {
    let reach = radius.ceil() as i32;
    let edge = 2 * reach + 1;
    let length2 = |mut index: i32| {
        let mut sum = 0;
        for _ in 0..D {
            let k = index % edge - reach;
            index /= edge;
            sum += k * k;
        }
        sum
    };
    let inside = (0..edge.pow(D as u32)).map(length2).filter(|&r2| r2 > 0 && f64::from(r2) < radius * radius);
    inside.count() as f64
}
