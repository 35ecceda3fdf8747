//! Neighbour searches: index the points and find all pairs. Brute force, the baseline, on few points.

mod scene;

#[cfg(feature = "kd-tree")]
use alluvium::neighbours::KdTree;
use alluvium::neighbours::{BruteForce, CellList, NeighbourSearch, Pairs, Periodic};
use alluvium::{Real, Vector};
use criterion::{BenchmarkId, Criterion, Throughput};
use scene::CpuTime;
use std::hint::black_box;

const FEW: usize = 1_000;
const MANY: usize = 20_000;
/// Radius in spacings: 2 h with h = 1.2 Δx.
const RADIUS: f64 = 2.4;

fn searches<T: Real, const D: usize>(criterion: &mut Criterion<CpuTime>) {
    for count in [FEW, MANY] {
        let lattice_order = scene::jittered::<T, D>(count);
        let shuffled = shuffled(&lattice_order);
        let mut searches: Vec<Box<dyn NeighbourSearch<T, D>>> = vec![Box::<CellList<T, D>>::default()];
        #[cfg(feature = "kd-tree")]
        searches.push(Box::<KdTree<T, D>>::default());
        if count == FEW {
            searches.push(Box::new(BruteForce::default()));
        }
        for (order, points) in [("in order", &lattice_order), ("shuffled", &shuffled)] {
            let mut group = criterion.benchmark_group(format!("searches/{D}D/{}/{count} {order}", T::NAME));
            group.throughput(Throughput::Elements(points.len() as u64));
            for search in &mut searches {
                group.bench_function(BenchmarkId::from_parameter(search.name()), |bencher| {
                    bencher.iter(|| {
                        black_box(Pairs::find(&mut **search, points, T::of(RADIUS), &Periodic::none()))
                    });
                });
            }
            group.finish();
        }
    }
}

/// The points in an order without neighbourhood: strides that share no divisor with their number.
fn shuffled<T: Real, const D: usize>(points: &[Vector<T, D>]) -> Vec<Vector<T, D>> {
    const STRIDE: usize = 7_919;
    (0..points.len()).map(|k| points[k * STRIDE % points.len()]).collect()
}

fn main() {
    scene::run(|criterion| {
        searches::<f32, 2>(criterion);
        searches::<f64, 2>(criterion);
        searches::<f32, 3>(criterion);
        searches::<f64, 3>(criterion);
    });
}
