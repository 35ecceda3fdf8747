//! What long seepage through soil must not do to the water: lose pressure, crowd, or be held by the lattice
//! of the grains.

use crate::mixture_rates::lattice_sum;
use crate::rungs::every_rung;
use crate::soil::{along, elastic};
use crate::water::periodic;
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Conductivity, Darcy, NoDrag, Soil, Unyielding, Water};
use alluvium::mixture::{CouplingForm, DensityDiffusion, Mixture, Phase, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, LeapFrog, StepSize};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, setup};

const UNRELAXED: &str = "density that is not relaxed";
const PRINTED: &str = "pressure by (55), (58) as printed";
const PARTIAL: &str = "diffusion of the partial density, as printed";
const GRAVITY: f64 = 9.81;
const SPACING: f64 = 0.05;
const SOUND_SPEED: f64 = 30.0;
/// Pressure at the start \[Pa\].
const PRESSURE: f64 = 3e4;
/// Volume fraction of the soil \[-\], its conductivity \[m/s\] and the gradient of the head in it \[-\].
const FRACTION: f64 = 0.55;
const CONDUCTIVITY: f64 = 0.01;
const SLOPE: f64 = 4.0;

pub fn studies() -> Vec<Study> {
    let mut studies = vec![
        drift::<f64, 2>("mixture/pore volumes/quick/2d/f64", USUAL, &[1.0]),
        drift::<f32, 2>("mixture/pore volumes/quick/2d/f32", USUAL, &[1.0]).level(Level::Full),
        drift::<f64, 2>("mixture/pore volumes/to five/2d/f64", USUAL, &[1.0, 2.0, 5.0]).level(Level::Full),
        drift::<f64, 2>("mixture/pore volumes/corrected/2d/f64", CORRECTED, &[1.0]).level(Level::Full),
        drift::<f64, 2>("mixture/pore volumes/interphase kernel/2d/f64", WIDER_BETWEEN, &[1.0])
            .level(Level::Full),
        drift::<f64, 3>("mixture/pore volumes/quick/3d/f64", SHORT, &[1.0]).level(Level::Full),
        drift::<f32, 3>("mixture/pore volumes/quick/3d/f32", SHORT, &[1.0]).level(Level::Full),
        unlocked::<f64, 2>("mixture/no locking in motion/2d/f64"),
        unlocked::<f32, 2>("mixture/no locking in motion/2d/f32"),
        unlocked::<f64, 3>("mixture/no locking in motion/3d/f64").level(Level::Full),
        unlocked::<f32, 3>("mixture/no locking in motion/3d/f32").level(Level::Full),
    ];
    // As many units in the last place of either precision.
    let single = 1e-9 * f64::from(f32::EPSILON) / f64::EPSILON;
    studies.extend(every_rung!(jump, "mixture/jump of the fraction"; 1e-9, single));
    studies
}

fn unlocked<T: Real, const D: usize>(name: &str) -> Study {
    Study::new(
        name,
        "water under 30 kPa that moves through soil without drag keeps its speed over 20 Δx (value: the part it loses)",
        |c| Measured::value(1.0 - speed_left::<T, D>(c)),
    )
    .equations(&["55", "58"])
    .source("nothing holds it")
    .expect(Expected::Bound { largest: 0.01 })
    .mutant(PRINTED)
}

fn jump<T: Real, const D: usize>(name: &str, largest: f64) -> Study {
    Study::new(
        name,
        "at uniform true density and rest, density changes nowhere, also where soil ends (values: largest Dρ/Dt in \
         kg/m³/s)",
        |c| {
            let of = DensityDiffusion::TrueDensity(T::of(0.1));
            let kinds = [("true density", of), ("hydrostatic", DensityDiffusion::Hydrostatic(T::of(0.1)))];
            Measured::values(kinds.map(|(name, kind)| (name, fastest_change::<T, D>(kind, c))))
        },
    )
    .equations(&["52", "54", "69"])
    .source("Dρ/Dt = ρ̃ Dφ/Dt + φ Dρ̃/Dt, of which neither changes at rest")
    .expect(Expected::Bound { largest })
    .mutant(PARTIAL)
}

type Both<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>>;

/// Water everywhere in a periodic strip under [`PRESSURE`], soil that is held in the first `columns` of it.
fn strip<T: Real, const D: usize>(length: f64, columns: f64, h: f64) -> Both<T, D> {
    let size = size_of::<D>(length);
    let mut soiled = size;
    soiled[0] = columns * SPACING;
    let volume = T::of(SPACING.powi(D as i32));
    let mut soil = Phase::new(elastic());
    let grains = setup::fill([0.0; D], soiled, SPACING);
    soil.add_wall(Wall::dynamic(), &grains, volume, |_| T::ZERO).expect("soil that is held");
    soil.set_volume_fraction(|_| T::of(FRACTION));
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(SOUND_SPEED)).expect("water"));
    water.add(&setup::fill([0.0; D], size, SPACING), volume, |_| T::of(PRESSURE)).expect("water");
    Mixture::new(WendlandC2::new(T::of(h)).expect("a length"), soil, water).with_periodic(periodic(size))
}

/// So many columns long, eight rows in the other directions \[m\].
fn size_of<const D: usize>(length: f64) -> [f64; D] {
    let mut size = [8.0 * SPACING; D];
    size[0] = length * SPACING;
    size
}

/// How the water is summed.
#[derive(Clone, Copy)]
struct Sums {
    /// Columns of soil, and as many of water without soil.
    columns: f64,
    /// h/Δx; none for 1.5 spacings of the water in the soil.
    ratio: Option<f64>,
    corrected: bool,
    /// h_c/Δx between soil and water, if it is another.
    between: Option<f64>,
}

const USUAL: Sums = Sums { columns: 24.0, ratio: None, corrected: false, between: None };
const CORRECTED: Sums = Sums { corrected: true, ..USUAL };
const SHORT: Sums = Sums { columns: 12.0, ..USUAL };
const WIDER_BETWEEN: Sums = Sums { ratio: Some(1.5), between: Some(2.0), ..USUAL };

fn drift<T: Real, const D: usize>(name: &str, sums: Sums, volumes: &'static [f64]) -> Study {
    Study::new(
        name,
        "water driven through soil and round again keeps Darcy's flow, its pressure and its spacing (values, \
         over what is allowed: flow, 5 %; mean pressure, 20 %; Σ V W in each column, 0.02)",
        move |c| seep::<T, D>(volumes, sums, c),
    )
    .equations(&["37", "52", "55", "58", "69"])
    .source("steady flow q = k i; nothing leaves")
    .expect(Expected::Bound { largest: 1.0 })
    .mutant(UNRELAXED)
}

/// After so many pore volumes.
fn seep<T: Real, const D: usize>(volumes: &[f64], sums: Sums, conditions: &Conditions) -> Measured {
    let in_soil = 1.5 * SPACING / (1.0 - FRACTION).powf(1.0 / D as f64);
    let h = sums.ratio.map_or(in_soil, |ratio| ratio * SPACING);
    let (columns, length) = (sums.columns, 2.0 * sums.columns);
    let flow = CONDUCTIVITY * SLOPE;
    // The push on all water is the loss of head in the soil.
    let pull = along(0, GRAVITY * SLOPE * columns / length);
    let darcy = Darcy::new(Conductivity::new(T::of(CONDUCTIVITY)).expect("a conductivity"));
    let mut mixture = strip::<T, D>(length, columns, h).with_gravity(pull).with_drag(darcy);
    if sums.corrected {
        mixture = mixture.with_gradient_correction();
    }
    if let Some(ratio) = sums.between {
        let kernel = WendlandC2::new(T::of(ratio * SPACING)).expect("a length");
        mixture = mixture.with_interphase_kernel(kernel).expect("a length near that within");
    }
    if !conditions.is(UNRELAXED) {
        mixture = mixture.with_density_relaxation(T::of(200.0 * h / SOUND_SPEED)).expect("a time");
    }
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.2)).expect("a number"));
    let one = columns * SPACING * (1.0 - FRACTION) / flow;
    let mut measured = Measured::default();
    for &volume in volumes {
        let (begin, end) = ((volume - 0.2) * one, volume * one);
        let (mut seeped, mut pressure) = (0.0, 0.0);
        while run.time() < end {
            let step = run.step_at_most(end - run.time()).expect("a step");
            if run.time() > begin {
                let part = step.length / (end - begin);
                seeped += part * through(run.mixture(), columns);
                let water = run.mixture().water();
                pressure += part * mean(water.pressures().iter().map(|p| p.as_f64()));
            }
        }
        let (least, most) = excess_of_space(run.mixture(), length);
        let crowded = most.max(-least);
        let values = [
            ("flow", (seeped / flow - 1.0) / 0.05),
            ("pressure", (pressure / PRESSURE - 1.0) / 0.2),
            ("space", crowded / 0.02),
        ];
        let named = values.map(|(name, value)| (format!("{name} after {volume}"), value));
        measured.points.extend(Measured::values(named).points);
        measured = measured.note(format!(
            "after {volume} pore volumes: q/(k i) = {:.3}, mean pressure {:.1} kPa, S − 1 − s₀ from {least:.4} \
             to {most:.4}",
            seeped / flow,
            1e-3 * pressure,
        ));
    }
    measured
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// ⟨φ v⟩ in the soil \[m/s\].
fn through<T: Real, const D: usize>(mixture: &Both<T, D>, columns: f64) -> f64 {
    let water = mixture.water();
    let inside = |a: &usize| water.positions()[*a][0].as_f64() < columns * SPACING;
    let flow = |a: usize| (water.volume(a) * water.volume_fraction(a) * water.velocities()[a][0]).as_f64();
    (0..water.len()).filter(inside).map(flow).sum::<f64>() / size_of::<D>(columns).iter().product::<f64>()
}

/// Least and largest S − 1 − s₀, S = Σ V W, means column by column.
fn excess_of_space<T: Real, const D: usize>(mixture: &Both<T, D>, length: f64) -> (f64, f64) {
    let water = mixture.water();
    let kernel = WendlandC2::<f64, D>::new(mixture.kernel().smoothing_length().as_f64()).expect("a length");
    let size = size_of::<D>(length);
    let mut bins = vec![(0.0, 0.0); length as usize];
    for a in 0..water.len() {
        let near = |b: usize| {
            let x = (water.positions()[a] - water.positions()[b]).as_f64();
            let r2 = (0..D).map(|k| (x[k] - size[k] * (x[k] / size[k]).round()).powi(2)).sum::<f64>();
            if r2.sqrt() < kernel.support() {
                water.volume(b).as_f64() * kernel.value::<f64>(r2)
            } else {
                0.0
            }
        };
        let space: f64 = (0..water.len()).map(near).sum();
        let ratio = kernel.smoothing_length() / water.volume(a).as_f64().powf(1.0 / D as f64);
        let column = (water.positions()[a][0].as_f64() / SPACING) as usize;
        let last = bins.len() - 1;
        let bin = &mut bins[column.min(last)];
        *bin = (bin.0 + space - 1.0 - lattice_excess::<D>(ratio), bin.1 + 1.0);
    }
    let means = bins.iter().map(|(sum, count)| sum / count);
    means.fold((f64::MAX, f64::MIN), |(least, most), mean| (least.min(mean), most.max(mean)))
}

/// `Σ V W − 1` on a square or cubic lattice with h = `ratio` spacings.
fn lattice_excess<const D: usize>(ratio: f64) -> f64 {
    lattice_sum(&WendlandC2::<f64, D>::new(ratio).expect("a length"), 1.0) - 1.0
}

/// The part of its speed that water keeps on a way of 20 Δx, at a slope to the lattice it begins on.
fn speed_left<T: Real, const D: usize>(conditions: &Conditions) -> f64 {
    let form = if conditions.is(PRINTED) { CouplingForm::Printed } else { CouplingForm::PressureDifference };
    let speed = 0.5;
    let mut mixture = strip::<T, D>(24.0, 24.0, 1.5 * SPACING).with_coupling(form).with_drag(NoDrag);
    mixture.water_mut().set_velocity(|_| along(0, speed) + along(1, 0.3 * speed));
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.2)).expect("a number"));
    let end = 20.0 * SPACING / speed;
    while run.time() < end {
        run.step_at_most(end - run.time()).expect("a step");
    }
    mean(run.mixture().water().velocities().iter().map(|v| v[0].as_f64())) / speed
}

fn fastest_change<T: Real, const D: usize>(kind: DensityDiffusion<T>, conditions: &Conditions) -> f64 {
    let kind = if conditions.is(PARTIAL) { DensityDiffusion::PartialDensity(T::of(0.1)) } else { kind };
    let mut mixture =
        strip::<T, D>(24.0, 12.0, 1.5 * SPACING).with_density_diffusion(kind).expect("a number");
    mixture.evaluate().expect("rates");
    let water = mixture.water();
    (0..water.len()).map(|a| water.density_rate(a).as_f64().abs()).fold(0.0, f64::max)
}
