//! An elastic plate, clamped at one end, that swings freely.

use crate::fits::{Series, oscillation};
use crate::soil::{SoilMixture, artificial_stress};
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Elasticity, Soil, Unyielding};
use alluvium::mixture::{ArtificialViscosity, HourglassControl, Mixture, Phase, Wall};
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
/// h/Δx.
const SMOOTHING: f64 = 1.5;
/// Timoshenko's frequency over that of a thin plate, at this thickness and ν.
const SHEARED: f64 = 0.990_5;

/// Of the first order or better.
const ORDERS: Expected = Expected::Order { at_least: 0.7, at_most: 2.5 };
/// And within 2 % in the end. With this stiffness it is so from 10 particles across on.
const CLOSE: Expected = Expected::Approach { at_least: 1.0, at_most: 2.5, largest: BAR };
/// ξ as published.
const STIFFNESS: f64 = 4.0;
/// Largest relative difference of the frequency of a plate that is held.
const BAR: f64 = 0.02;

type Plate<T> = SoilMixture<T, 2, Soil<T, Unyielding>>;

pub fn studies() -> Vec<Study> {
    vec![
        plate("soil/plate", &[7, 14]).level(Level::Full).expect(ORDERS).mutant(STIFF),
        held::<f64>("soil/plate held/coarse", &[6]).expect(Expected::Bound { largest: BAR }).mutant(STIFF),
        held::<f32>("soil/plate held/coarse/f32", &[6])
            .level(Level::Full)
            .expect(Expected::Bound { largest: BAR })
            .mutant(STIFF),
        held::<f64>("soil/plate held", &[10, 14])
            .level(Level::Full)
            .expect(Expected::Bound { largest: BAR })
            .mutant(STIFF),
        converging("soil/plate held/half as stiff", 0.5, &[6, 10])
            .level(Level::Full)
            .expect(ORDERS)
            .mutant(STIFF),
        converging("soil/plate held/three quarters as stiff", 0.75, &[6, 10, 14])
            .level(Level::Full)
            .expect(CLOSE)
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
                (THICKNESS / count as f64, difference(clamped::<f64>(THICKNESS / count as f64, conditions)))
            }))
        },
    )
    .equations(&["33", "34", "35", "53", "55", "64", "65"])
    .source(SOURCE)
}

/// Held with the published stiffness. The spacing divides the clamp: with an odd number
/// across, its last row would stand in the plate.
fn held<T: Real>(name: &str, counts: &'static [usize]) -> Study {
    Study::new(
        name,
        "with corrected gradients and hourglass control the frequency of a clamped plate is that of theory (values: \
         relative difference, by particles across)",
        move |conditions| {
            Measured::values(counts.iter().map(|&count| {
                let spacing = THICKNESS / count as f64;
                (count.to_string(), difference(controlled::<T>(spacing, STIFFNESS, conditions)))
            }))
        },
    )
    .equations(&["33", "34", "35", "53", "55", "64", "65"])
    .source(SOURCE)
}

/// What the hold adds at the surfaces depends on its stiffness, here a share of the published one, but goes to zero.
fn converging(name: &str, share: f64, counts: &'static [usize]) -> Study {
    Study::new(
        name,
        format!(
            "with hourglass control {share} times as stiff as usual the frequency of the plate approaches that of theory \
             too (values: relative difference, at {counts:?} particles across)"
        ),
        move |conditions| {
            Measured::errors(counts.iter().map(|&count| {
                let spacing = THICKNESS / count as f64;
                (spacing, difference(controlled::<f64>(spacing, share * STIFFNESS, conditions)))
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

/// |ω/ω_exact − 1|.
fn difference<T: Real>(mixture: Plate<T>) -> f64 {
    let fit = oscillation(&tip(mixture), exact());
    (fit.frequency / exact() - 1.0).abs()
}

/// Height of the plate's tip over three quarters of a period.
fn tip<T: Real>(mixture: Plate<T>) -> Series {
    let spacing = mixture.kernel().smoothing_length().as_f64() / SMOOTHING;
    let step = StepSize::courant(T::of(0.2)).expect("0.2");
    let mut run = Simulation::new(mixture, VelocityVerlet::new(), step);
    let soil = run.mixture().soil();
    let is_tip = |i: &usize| soil.positions()[*i][0].as_f64() > LENGTH - 1.5 * spacing;
    let tip: Vec<u32> = (0..soil.len()).filter(is_tip).map(|i| soil.ids()[i]).collect();
    let mut series = Series::new();
    let _: ControlFlow<()> = run
        .run_until(1.5 * core::f64::consts::PI / exact(), |run| {
            let soil = run.mixture().soil();
            let places = soil.ids().iter().zip(soil.positions());
            let heights = places.filter(|(id, _)| tip.contains(id)).map(|(_, x)| x[1].as_f64());
            series.push((run.time(), heights.sum::<f64>() / tip.len() as f64));
            ControlFlow::Continue(())
        })
        .expect("a sound run");
    series
}

/// With the sums as printed, held together by artificial stress.
fn clamped<T: Real>(spacing: f64, conditions: &Conditions) -> Plate<T> {
    free(spacing, conditions).with_artificial_stress(artificial_stress(spacing)).expect("numerics")
}

/// With corrected gradients and control of what they do not see.
fn controlled<T: Real>(spacing: f64, stiffness: f64, conditions: &Conditions) -> Plate<T> {
    let control = HourglassControl { stiffness: T::of(stiffness), viscosity: T::of(0.1) };
    let mixture = free(spacing, conditions).with_gradient_correction();
    mixture.with_hourglass_control(control).expect("a strength")
}

/// The plate and its clamp, without artificial stress.
fn free<T: Real>(spacing: f64, conditions: &Conditions) -> Plate<T> {
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
    let kernel = WendlandC2::new(T::of(SMOOTHING * spacing)).expect("a length");
    Mixture::of_soil(kernel, phase)
        .with_soil_artificial_viscosity(ArtificialViscosity { linear: T::of(0.05), quadratic: T::ZERO })
        .expect("numerics")
}
