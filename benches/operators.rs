//! Discrete derivatives of a field at the particles of a cloud: pack, sum, write.

mod scene;

use alluvium::Real;
use alluvium::kernel::WendlandC2;
use alluvium::summation::Form;
use criterion::{BenchmarkId, Criterion, Throughput};
use scene::{CpuTime, Points};
use std::hint::black_box;

const COUNT: usize = 20_000;
/// h/Δx of the default preset.
const SMOOTHING: f64 = 1.3;

fn operators<T: Real, const D: usize>(criterion: &mut Criterion<CpuTime>) {
    let kernel = WendlandC2::<T, D>::new(T::of(SMOOTHING)).expect("a length");
    for set in scene::instruction_sets() {
        let points = Points::<T, D>::new(COUNT, T::of(2.0 * SMOOTHING), set);
        let (cloud, field) = (points.cloud(&kernel), points.field());
        let mut group = criterion.benchmark_group(format!("operators/{D}D/{}", T::NAME));
        group.throughput(Throughput::Elements(field.len() as u64));
        group.bench_function(BenchmarkId::new("interpolate", set.name()), |bencher| {
            bencher.iter(|| black_box(cloud.interpolate(&field)));
        });
        group.bench_function(BenchmarkId::new("gradient", set.name()), |bencher| {
            bencher.iter(|| black_box(cloud.gradient(Form::Symmetric, &field)));
        });
        group.bench_function(BenchmarkId::new("divergence", set.name()), |bencher| {
            bencher.iter(|| black_box(cloud.divergence(Form::Difference, points.vectors())));
        });
        group.bench_function(BenchmarkId::new("laplacian", set.name()), |bencher| {
            bencher.iter(|| black_box(cloud.laplacian(&field)));
        });
        group.finish();
    }
}

fn main() {
    scene::run(|criterion| {
        operators::<f32, 2>(criterion);
        operators::<f64, 2>(criterion);
        operators::<f32, 3>(criterion);
        operators::<f64, 3>(criterion);
    });
}
