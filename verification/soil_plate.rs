//! An elastic plate, clamped at one end, that swings freely.

use crate::fits::{Series, oscillation};
use crate::soil::{SoilMixture, artificial_stress};
use alluvium::kernel::WendlandC2;
use alluvium::material::{Elasticity, Soil, Unyielding};
use alluvium::mixture::{ArtificialViscosity, Mixture, Phase, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{StepSize, VelocityVerlet};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, Vector, setup};
use std::ops::ControlFlow;

const SOURCE: &str = "Landau & Lifshitz: ω² = E H² k⁴/(12 ρ (1 − ν²)), kL = 1.8751, less 0.95 % for the plate's own shear \
                      and rotation (Timoshenko 1921, shear coefficient 5/6); set-up of Gray, Monaghan & Swift (2001)";
const STIFF: &str = "Young's modulus a fifth too large";
const LENGTH: f64 = 0.2;
const THICKNESS: f64 = 0.02;
const DENSITY: f64 = 1000.0;
const YOUNG: f64 = 2e6;
const POISSON: f64 = 0.3975;
const ROOT: f64 = 1.8751;
/// Timoshenko's frequency over that of a thin plate, at this thickness and ν.
const SHEARED: f64 = 0.990_5;

pub fn studies() -> Vec<Study> {
    vec![
        plate("soil/plate", &[7, 14])
            .level(Level::Full)
            .expect(Expected::Order { at_least: 0.7, at_most: 2.5 })
            .mutant(STIFF),
    ]
}

fn plate(name: &str, counts: &'static [usize]) -> Study {
    Study::new(
        name,
        "the frequency of a clamped plate approaches that of theory (values: relative difference, at 7 and 14 \
         particles across)",
        move |conditions| {
            Measured::errors(counts.iter().map(|&count| {
                let fit = oscillation(&tip::<f64>(count, conditions), exact());
                (THICKNESS / count as f64, (fit.frequency / exact() - 1.0).abs())
            }))
        },
    )
    .equations(&["33", "34", "35", "53", "55", "64", "65"])
    .source(SOURCE)
}

/// ω \[1/s\].
fn exact() -> f64 {
    let k = ROOT / LENGTH;
    SHEARED
        * (YOUNG * THICKNESS * THICKNESS * k.powi(4) / (12.0 * DENSITY * (1.0 - POISSON * POISSON))).sqrt()
}

/// Height of the plate's tip over three quarters of a period.
fn tip<T: Real>(count: usize, conditions: &Conditions) -> Series {
    let spacing = THICKNESS / count as f64;
    let step = StepSize::courant(T::of(0.2)).expect("0.2");
    let mut run = Simulation::new(clamped::<T>(spacing, conditions), VelocityVerlet::new(), step);
    let mut series = Series::new();
    let _: ControlFlow<()> = run
        .run_until(1.5 * core::f64::consts::PI / exact(), |run| {
            let soil = run.mixture().soil();
            let free = soil.positions().iter().skip(soil.wall_particles());
            let tip: Vec<f64> =
                free.filter(|x| x[0].as_f64() > LENGTH - 1.5 * spacing).map(|x| x[1].as_f64()).collect();
            series.push((run.time(), tip.iter().sum::<f64>() / tip.len() as f64));
            ControlFlow::Continue(())
        })
        .expect("a sound run");
    series
}

fn clamped<T: Real>(spacing: f64, conditions: &Conditions) -> SoilMixture<T, 2, Soil<T, Unyielding>> {
    let stiffer = if conditions.is(STIFF) { 1.2 } else { 1.0 };
    let elasticity = Elasticity::new(T::of(YOUNG * stiffer), T::of(POISSON)).expect("moduli");
    let sound = elasticity.bulk().as_f64() / DENSITY;
    let mut phase = Phase::new(Soil::new(T::of(DENSITY), elasticity, Unyielding).expect("a soil"));
    let volume = T::of(spacing * spacing);
    // The clamp holds the plate between two jaws and inside them.
    let (jaw, half) = (0.25 * LENGTH, 0.5 * THICKNESS);
    let clamp = setup::fill([-jaw, -2.0 * half], [0.0, 2.0 * half], spacing);
    phase.add_wall(Wall::dynamic(), &clamp, volume, |_| T::ZERO).expect("a wall");
    phase.add(&setup::fill([0.0, -half], [LENGTH, half], spacing), volume, |_| T::ZERO).expect("particles");
    let speed = 0.01 * sound.sqrt();
    phase.set_velocity(|x| {
        let at = |x: f64| {
            let z = ROOT * x / LENGTH;
            let ratio = (ROOT.cos() + ROOT.cosh()) / (ROOT.sin() + ROOT.sinh());
            (z.cosh() - z.cos()) - ratio * (z.sinh() - z.sin())
        };
        Vector::of([0.0, speed * at(x[0].as_f64()) / at(LENGTH)])
    });
    let kernel = WendlandC2::new(T::of(1.5 * spacing)).expect("a length");
    Mixture::of_soil(kernel, phase)
        .with_soil_artificial_viscosity(ArtificialViscosity { linear: T::of(0.05), quadratic: T::ZERO })
        .and_then(|mixture| mixture.with_artificial_stress(artificial_stress(spacing)))
        .expect("numerics")
}
