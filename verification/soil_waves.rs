//! Plane waves in elastic soil: the speeds of compression and shear.

use crate::fits::{Series, oscillation};
use crate::soil::{along, bare, elastic, elasticity};
use crate::water::periodic;
use alluvium::material::{Elasticity, Soil, Unyielding};
use alluvium::mixture::Phase;
use alluvium::simulation::Simulation;
use alluvium::time::{StepSize, VelocityVerlet};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, setup};
use std::f64::consts::PI;
use std::ops::ControlFlow;

const SOURCE: &str = "c_P = √((K + 4G/3)/ρ̃₀), c_S = √(G/ρ̃₀): the volume fraction cancels";
const STIFF: &str = "shear modulus a fifth too large";
const LIGHT: &str = "waves of the partial density";
const WAVE_NUMBER: f64 = 2.0 * PI;

#[derive(Clone, Copy, PartialEq)]
enum Wave {
    Compression,
    Shear,
}

pub fn studies() -> Vec<Study> {
    let mut studies = Vec::new();
    for (kind, wave) in [("p-wave", Wave::Compression), ("s-wave", Wave::Shear)] {
        studies.push(study::<f64, 2>(&format!("soil/{kind}/2d/f64"), wave, &[50, 100]));
        studies.push(study::<f32, 2>(&format!("soil/{kind}/2d/f32"), wave, &[50]));
        studies.push(study::<f64, 3>(&format!("soil/{kind}/3d/f64"), wave, &[50]));
        studies.push(study::<f32, 3>(&format!("soil/{kind}/3d/f32"), wave, &[50]).level(Level::Full));
        studies.push(converging(&format!("soil/{kind}/order/2d/f64"), wave));
    }
    studies
}

fn study<T: Real, const D: usize>(name: &str, wave: Wave, sides: &'static [usize]) -> Study {
    Study::new(
        name,
        "a standing wave in elastic soil, h = 2Δx, has the speed of its modulus within 2 %",
        move |c| {
            Measured::errors(sides.iter().map(|&side| (1.0 / side as f64, error::<T, D>(wave, side, 2.0, c))))
        },
    )
    .equations(&["33", "53", "55", "63", "64", "65"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 0.02 })
    .mutant(STIFF)
    .mutant(LIGHT)
}

/// With h growing against the spacing, as consistency asks: at fixed h/Δx the error is the plateau of the
/// gradient's gain.
fn converging(name: &str, wave: Wave) -> Study {
    Study::new(name, "the speed of a standing wave converges as h → 0 with h/Δx = 2, 2.4, 2.8", move |c| {
        let runs = [(25, 2.0), (50, 2.4), (100, 2.8)];
        Measured::errors(
            runs.map(|(side, ratio)| (ratio / side as f64, error::<f64, 2>(wave, side, ratio, c))),
        )
    })
    .equations(&["55", "65"])
    .source("smoothing of the order h² beside the lattice's own error, which falls with h/Δx")
    .expect(Expected::Order { at_least: 1.5, at_most: 2.6 })
    .mutant(STIFF)
}

/// |frequency/exact − 1|.
fn error<T: Real, const D: usize>(wave: Wave, side: usize, ratio: f64, conditions: &Conditions) -> f64 {
    let exact = elasticity::<f64>();
    let modulus = if wave == Wave::Shear { exact.shear() } else { exact.plane_wave_modulus() };
    let frequency = WAVE_NUMBER * (modulus / crate::soil::GRAINS).sqrt();
    let series = run::<T, D>(wave, side, ratio, 3.0 * 2.0 * PI / frequency, conditions);
    (oscillation(&series, frequency).frequency / frequency - 1.0).abs()
}

/// The amplitude of the velocity's mode over three periods.
fn run<T: Real, const D: usize>(
    wave: Wave,
    side: usize,
    ratio: f64,
    end: f64,
    conditions: &Conditions,
) -> Series {
    let spacing = 1.0 / side as f64;
    let mut size = [12.0 * spacing; D];
    size[0] = 1.0;
    let soil: Soil<T, Unyielding> = match (conditions.is(STIFF), conditions.is(LIGHT)) {
        (true, _) => {
            let (k, g) = (exact_bulk(), 1.2 * elasticity::<f64>().shear());
            let (e, nu) = (9.0 * k * g / (3.0 * k + g), (3.0 * k - 2.0 * g) / (6.0 * k + 2.0 * g));
            let stiff = Elasticity::new(T::of(e), T::of(nu)).expect("moduli");
            Soil::new(T::of(crate::soil::GRAINS), stiff, Unyielding).expect("a soil")
        }
        (_, true) => Soil::new(T::of(0.6 * crate::soil::GRAINS), elasticity(), Unyielding).expect("a soil"),
        _ => elastic(),
    };
    let mut phase = Phase::new(soil);
    let places = setup::fill([0.0; D], size, spacing);
    phase.add(&places, T::of(spacing.powi(D as i32)), |_| T::ZERO).expect("particles");
    phase.set_volume_fraction(|_| T::of(0.6));
    let axis = usize::from(wave == Wave::Shear);
    let amplitude = 1e-4;
    phase.set_velocity(|x| along(axis, amplitude * (WAVE_NUMBER * x[0].as_f64()).sin()));
    let mixture = bare(ratio * spacing, phase).with_periodic(periodic(size));
    let step = StepSize::courant(T::of(0.1)).expect("0.1");
    let mut run = Simulation::new(mixture, VelocityVerlet::new(), step);
    let mut series = Series::new();
    let _: ControlFlow<()> = run
        .run_until(end, |run| {
            let soil = run.mixture().soil();
            let mode: f64 = (soil.positions().iter().zip(soil.velocities()))
                .map(|(x, v)| (WAVE_NUMBER * x[0].as_f64()).sin() * v[axis].as_f64())
                .sum();
            series.push((run.time(), mode / (0.5 * amplitude * soil.len() as f64)));
            ControlFlow::Continue(())
        })
        .expect("a sound run");
    series
}

fn exact_bulk() -> f64 {
    elasticity::<f64>().bulk()
}
