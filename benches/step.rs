//! A whole step of a dam break: neighbours, sums, walls, ledger, checks, integration.
//!
//! The time is that of [`STEPS`] steps; the throughput is in particle-steps.

mod scene;

use alluvium::Real;
use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput};
use scene::{CpuTime, DamBreak, LARGE, LARGE_WIDE, SMALL, SPACE};
use std::hint::black_box;

/// Steps in one go, so that the neighbour list is rebuilt within.
const STEPS: u64 = 10;

fn step<T: Real, const D: usize>(criterion: &mut Criterion<CpuTime>, case: &DamBreak<D>) {
    let mut group = criterion.benchmark_group(format!("step/{}/{}", case.name, T::NAME));
    group.sampling_mode(SamplingMode::Flat);
    group.throughput(Throughput::Elements(STEPS * case.particles() as u64));
    for set in scene::instruction_sets() {
        let mut simulation = case.simulation::<T>(set);
        group.bench_function(BenchmarkId::from_parameter(set.name()), |bencher| {
            bencher.iter(|| {
                for _ in 0..STEPS {
                    black_box(simulation.step().expect("a sound step"));
                }
            });
        });
        let (mixture, particles) = (simulation.mixture(), case.particles() as f64);
        println!(
            "{} bytes per particle, {:.1} steps per list",
            (mixture.bytes() as f64 / particles).round(),
            simulation.steps() as f64 / mixture.water_neighbourhood().rebuilds() as f64
        );
    }
    group.finish();
}

/// The same of sand, on the widest lanes: what stress and its return cost.
fn sand<T: Real, const D: usize>(criterion: &mut Criterion<CpuTime>, case: &DamBreak<D>) {
    let mut group = criterion.benchmark_group(format!("step/sand {}/{}", case.name, T::NAME));
    group.sampling_mode(SamplingMode::Flat);
    group.throughput(Throughput::Elements(STEPS * case.particles() as u64));
    let set = alluvium::InstructionSet::detect();
    let mut simulation = case.of_sand::<T>(set);
    group.bench_function(BenchmarkId::from_parameter(set.name()), |bencher| {
        bencher.iter(|| {
            for _ in 0..STEPS {
                black_box(simulation.step().expect("a sound step"));
            }
        });
    });
    group.finish();
}

fn main() {
    scene::run(|criterion| {
        for case in [SMALL, LARGE, LARGE_WIDE] {
            step::<f32, 2>(criterion, &case);
            step::<f64, 2>(criterion, &case);
        }
        sand::<f32, 2>(criterion, &SMALL);
        sand::<f64, 2>(criterion, &SMALL);
        step::<f32, 3>(criterion, &SPACE);
        step::<f64, 3>(criterion, &SPACE);
    });
}
