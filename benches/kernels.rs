//! Kernels: value and slope of one number after another, and the slope in the pair loop (a gradient).

mod scene;

use alluvium::kernel::{CubicSpline, Kernel, QuinticSpline, WendlandC2, WendlandC4, WendlandC6};
use alluvium::summation::Form;
use alluvium::{Real, Vector};
use criterion::{BenchmarkId, Criterion, Throughput};
use scene::{CpuTime, Points};
use std::hint::black_box;

const DISTANCES: usize = 4096;
const COUNT: usize = 10_000;

fn kernel<T: Real, K: Kernel<T, D>, const D: usize>(
    criterion: &mut Criterion<CpuTime>,
    name: &str,
    kernel: &K,
) {
    let mut group = criterion.benchmark_group(format!("kernels/{D}D/{}", T::NAME));
    let support = kernel.support();
    let fraction = |k| T::of(k as f64 / DISTANCES as f64);
    let r2: Vec<T> = (0..DISTANCES).map(|k| fraction(k) * support * support).collect();
    group.throughput(Throughput::Elements(DISTANCES as u64));
    group.bench_function(BenchmarkId::new("one by one", name), |bencher| {
        bencher.iter(|| {
            let mut sum = Vector([T::ZERO; 2]);
            for &r2 in black_box(&r2) {
                sum += Vector([kernel.value(r2), kernel.slope(r2)]);
            }
            sum
        });
    });
    for set in scene::instruction_sets() {
        let points = Points::<T, D>::new(COUNT, support, set);
        let (cloud, field) = (points.cloud(kernel), points.field());
        group.throughput(Throughput::Elements(field.len() as u64));
        group.bench_function(BenchmarkId::new(format!("gradient {}", set.name()), name), |bencher| {
            bencher.iter(|| black_box(cloud.gradient(Form::Symmetric, &field)));
        });
    }
    group.finish();
}

fn kernels<T: Real, const D: usize>(criterion: &mut Criterion<CpuTime>) {
    let h = T::of(1.2);
    kernel(criterion, "wendland-c2", &WendlandC2::<T, D>::new(h).expect("a length"));
    kernel(criterion, "wendland-c4", &WendlandC4::<T, D>::new(h).expect("a length"));
    kernel(criterion, "wendland-c6", &WendlandC6::<T, D>::new(h).expect("a length"));
    kernel(criterion, "cubic-spline", &CubicSpline::<T, D>::new(h).expect("a length"));
    kernel(criterion, "quintic-spline", &QuinticSpline::<T, D>::new(h).expect("a length"));
}

fn main() {
    scene::run(|criterion| {
        kernels::<f32, 2>(criterion);
        kernels::<f64, 2>(criterion);
        kernels::<f32, 3>(criterion);
        kernels::<f64, 3>(criterion);
    });
}
