//! A step of soil and water with drag solved over it, against the same step with explicit drag.
//!
//! The time is that of one step of leap-frog with backward Euler, in `f64`: of the paper's jet as it digs, and of soil
//! and water in disorder through a periodic box, water in two waves; z is the step over the stopping time.

mod scene;

#[cfg(feature = "case")]
use alluvium::Preset;
#[cfg(feature = "case")]
use alluvium::case::{Case, Drag, Seepage, SoilLaw};
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{DragScheme, Mixture, Phase};
use alluvium::neighbours::Periodic;
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::{Vector, setup};
use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput};
use scene::CpuTime;
use std::f64::consts::TAU;
use std::hint::black_box;
#[cfg(feature = "case")]
use std::ops::ControlFlow;

/// ρ_f, ρ_s \[kg/m³\] and φ_s of soil and water.
const DENSITIES: [f64; 2] = [1000.0, 2650.0];
const FRACTION: f64 = 0.5;
const SOUND_SPEED: f64 = 25.0;
/// h/Δx.
const SMOOTHING: f64 = 1.3;
/// Step over stopping time of explicit drag, the baseline.
const EVALUATED: f64 = 0.1;
const STIFF: [f64; 6] = [1.0, 10.0, 1e2, 1e3, 1e4, 1e6];

type Run<const D: usize> =
    Simulation<f64, D, WendlandC2<f64, D>, Soil<f64, Unyielding>, Water<f64>, LeapFrog<f64>>;

#[cfg(feature = "case")]
type JetRun = Simulation<f64, 2, WendlandC2<f64, 2>, SoilLaw<f64>, Water<f64>, LeapFrog<f64>>;

/// A box of side one, `side` particles of soil and as many of water along each axis, whose steps are `z` stopping
/// times.
fn mixed<const D: usize>(side: usize, z: f64, scheme: DragScheme) -> Run<D> {
    let spacing = 1.0 / side as f64;
    let (h, volume) = (SMOOTHING * spacing, spacing.powi(D as i32));
    let step = 0.2 * h / SOUND_SPEED;
    // 1/t_s = C_d (1/ρ_f + 1/ρ_s) with the partial densities.
    let [water, grains] = DENSITIES;
    let (of_water, of_soil) = ((1.0 - FRACTION) * water, FRACTION * grains);
    let drag = z / step / (1.0 / of_water + 1.0 / of_soil);
    let conductivity = (1.0 - FRACTION).powi(2) * water * 9.81 / drag;
    let [for_soil, for_water] = disordered::<D>(side);
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).expect("moduli");
    let mut soil = Phase::new(Soil::new(grains, elasticity, Unyielding).expect("a soil"));
    soil.add(&for_soil, volume, |_| 0.0).expect("particles");
    soil.set_volume_fraction(|_| FRACTION);
    let along = |x: &Vector<f64, D>, speed: f64| {
        let mut velocity = Vector::zero();
        velocity[0] = speed * (TAU * x[1]).sin();
        velocity[1] = 0.5 * speed * (3.0 * TAU * x[0]).sin();
        velocity
    };
    soil.set_velocity(|x| along(x, -1.0));
    let mut fluid = Phase::new(Water::new(water, SOUND_SPEED).expect("water"));
    fluid.add(&for_water, volume, |_| 100.0).expect("particles");
    fluid.set_velocity(|x| along(x, 1.0));
    let mixture = Mixture::new(WendlandC2::new(h).expect("a length"), soil, fluid)
        .with_periodic(Periodic::new(Vector::zero(), [Some(1.0); D]).expect("a period"))
        .with_drag(Darcy::new(Conductivity::new(conductivity).expect("a conductivity")))
        .with_drag_scheme(scheme);
    Simulation::new(mixture, LeapFrog::new(), StepSize::fixed(step).expect("a step"))
}

/// Places of soil and of water, both off the lattice by up to a fifth of the spacing.
fn disordered<const D: usize>(side: usize) -> [Vec<Vector<f64, D>>; 2] {
    let count = side.pow(D as u32);
    let points = scene::jittered::<f64, D>(count);
    let scaled = |x: &Vector<f64, D>| *x * (1.0 / side as f64);
    let soil = points.iter().map(scaled).collect();
    // The disorder of water is that of soil, mirrored.
    let lattice = setup::fill::<f64, D>([0.0; D], [side as f64; D], 1.0);
    let water = points.iter().zip(&lattice).map(|(x, at)| scaled(&(*at * 2.0 - *x))).collect();
    [soil, water]
}

fn step<const D: usize>(criterion: &mut Criterion<CpuTime>, name: &str, side: usize) {
    let mut group = criterion.benchmark_group(format!("drag/{name}"));
    group.sampling_mode(SamplingMode::Flat);
    group.throughput(Throughput::Elements(2 * side.pow(D as u32) as u64));
    let explicit = ("explicit".to_owned(), EVALUATED, DragScheme::Explicit);
    let solved = STIFF.map(|z| (format!("z = {z:e}"), z, DragScheme::BackwardEuler));
    for (what, z, scheme) in core::iter::once(explicit).chain(solved) {
        // Made when it is asked for, and only then.
        let mut run = None;
        group.bench_function(BenchmarkId::from_parameter(what), |bencher| {
            let run = run.get_or_insert_with(|| mixed::<D>(side, z, scheme));
            bencher.iter(|| black_box(run.step().expect("a sound step")));
        });
    }
    group.finish();
}

/// A step of the paper's jet as it digs, with the default preset.
#[cfg(feature = "case")]
fn jet(criterion: &mut Criterion<CpuTime>) {
    let mut group = criterion.benchmark_group("drag/jet");
    group.sampling_mode(SamplingMode::Flat);
    for (scheme, conductivity) in
        [("explicit", 5e-4), ("backward-euler", 5e-4), ("backward-euler", 1e-5), ("backward-euler", 1e-8)]
    {
        let mut run = None;
        group.bench_function(BenchmarkId::new(scheme, format!("k = {conductivity:e}")), |bencher| {
            let run = run.get_or_insert_with(|| digging(scheme, conductivity));
            bencher.iter(|| black_box(run.step().expect("a sound step")));
        });
    }
    group.finish();
}

/// The jet 4 ms after its start.
#[cfg(feature = "case")]
fn digging(scheme: &str, conductivity: f64) -> JetRun {
    let text = include_str!("../verification/cases/jet.toml")
        .replace("PRESET", "default")
        .replace("INTEGRATOR", "leap-frog-ab3")
        .replace("[[water.block]]", "cavitation_pressure_pa = -101325.0\n[[water.block]]")
        .replace("[mixture]", &format!("[mixture]\ndrag_scheme = \"{scheme}\""))
        .replace("conductivity_m_per_s = 5.0e-4", &format!("conductivity_m_per_s = {conductivity:?}"));
    let (case, _) = Case::parse("jet", &text).expect("a case");
    let drag = case.mixing.as_ref().map(|mixing| &mixing.drag);
    assert_eq!(drag, Some(&Drag::Darcy(Seepage::Conductivity(conductivity))), "the case has another wording");
    let kernel = WendlandC2::new(case.smoothing_length()).expect("a length");
    let mut run = case.simulation(kernel, Preset::Default.leap_frog()).expect("a case");
    let _: ControlFlow<()> = run.run_until(0.004, |_| ControlFlow::Continue(())).expect("a sound run");
    run
}

fn main() {
    scene::run(|criterion| {
        #[cfg(feature = "case")]
        jet(criterion);
        step::<2>(criterion, "2D 7k", 60);
        step::<2>(criterion, "2D 20k", 100);
        step::<2>(criterion, "2D 60k", 173);
        step::<2>(criterion, "2D 200k", 316);
        step::<3>(criterion, "3D 19k", 21);
        step::<3>(criterion, "3D 65k", 32);
        step::<3>(criterion, "3D 195k", 46);
    });
}
