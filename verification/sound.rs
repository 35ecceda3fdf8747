//! A standing sound wave: frequency, damping, and both integrators.

use crate::fits::{Series, oscillation};
use crate::water::{Unpredicted, bare, periodic, water};
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::mixture::Phase;
use alluvium::simulation::Simulation;
use alluvium::time::{Integrator, LeapFrog, StepSize, VelocityVerlet};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, Vector, setup};
use std::f64::consts::PI;
use std::ops::ControlFlow;

const SOURCE: &str = "linear acoustics: ω = c₀k; τ is deviatoric, so a plane wave feels 4μ/3";
const STALE: &str = "rates from fields half a step old";
const DOUBLE: &str = "viscosity twice as large";
const STIFF: &str = "speed of sound 3 % too high";

/// Wavelength one, speed of sound one.
const WAVE_NUMBER: f64 = 2.0 * PI;
/// So that the wave loses 6 % of its amplitude in a period.
const VISCOSITY: f64 = 0.0024;
/// So small that steepening is below 1e-3 in the time looked at.
const AMPLITUDE: f64 = 1e-5;

/// What of the wave, and over what.
#[derive(Clone, Copy, PartialEq)]
enum Asked {
    /// ω / c₀k
    Frequency,
    /// Damping / (2/3)νk²
    Damping,
    /// The same two, over what the particles' lattice makes of k: the linearised sums, exactly.
    OnLattice,
}

pub fn studies() -> Vec<Study> {
    let mut studies = both::<f64, 2, _>("leap-frog/2d/f64", LeapFrog::new(), &[50, 100]);
    let third_order_density = LeapFrog::new().with_third_order_density();
    studies.extend(both::<f64, 2, _>("leap-frog-ab3/2d/f64", third_order_density, &[50, 100]));
    studies.extend(both::<f64, 2, _>("verlet/2d/f64", VelocityVerlet::new(), &[50, 100]));
    studies.extend(both::<f32, 2, _>("leap-frog/2d/f32", LeapFrog::new(), &[100]));
    studies.extend(both::<f32, 2, _>("verlet/2d/f32", VelocityVerlet::new(), &[100]));
    studies.extend(in_space::<f64>("leap-frog/3d/f64"));
    studies.extend(in_space::<f32>("leap-frog/3d/f32"));
    studies
}

/// In 3D the frequency to a percent asks for 50 particles in a wavelength, the damping for 100.
fn in_space<T: Real>(name: &str) -> Vec<Study> {
    let mut studies = both::<T, 3, _>(name, LeapFrog::new(), &[50]);
    studies.truncate(2);
    let damping = both::<T, 3, _>(name, LeapFrog::new(), &[100]).pop();
    studies.extend(damping.map(|study| study.level(Level::Full)));
    studies
}

/// Frequency, dispersion and damping.
fn both<T: Real, const D: usize, I: Integrator<T> + Sync>(
    name: &str,
    integrator: I,
    sides: &'static [usize],
) -> Vec<Study> {
    let study = |what: &str, claim: &str, asked: Asked, sides: &'static [usize]| {
        let integrator = integrator.clone();
        Study::new(format!("sound/{what}/{name}"), claim, move |conditions| {
            errors::<T, D, I>(asked, sides, &integrator, conditions)
        })
        .equations(&["14", "15", "16", "52", "58", "62", "71"])
    };
    let fine = &sides[sides.len() - 1..];
    vec![
        study("frequency", "a standing sound wave has the frequency c₀k", Asked::Frequency, sides)
            .source(SOURCE)
            .expect(Expected::Bound { largest: 0.01 })
            .mutant(STIFF),
        study(
            "dispersion",
            "frequency and damping of a sound wave are those of the linearised sums",
            Asked::OnLattice,
            fine,
        )
        .source("(52), (58), (62) for a plane wave on a lattice: k becomes Σ V sin(kx) ∂W/∂x")
        // Steepening and the step's own error are below 1e-4 and 1e-3.
        .expect(Expected::Bound { largest: 2e-3 })
        .mutant(STALE)
        .mutant(DOUBLE)
        .mutant(STIFF),
        study("damping", "a standing sound wave is damped at the rate (2/3)νk²", Asked::Damping, fine)
            .source(SOURCE)
            .expect(Expected::Bound { largest: 0.01 })
            .mutant(STALE)
            .mutant(DOUBLE),
    ]
}

/// Relative errors.
fn errors<T: Real, const D: usize, I: Integrator<T>>(
    asked: Asked,
    sides: &[usize],
    integrator: &I,
    conditions: &Conditions,
) -> Measured {
    Measured::errors(sides.iter().map(|&side| {
        let spacing = 1.0 / side as f64;
        let series = match conditions.is(STALE) {
            true => run::<T, D, _>(spacing, &Unpredicted, conditions),
            false => run::<T, D, I>(spacing, integrator, conditions),
        };
        let fit = oscillation(&series, WAVE_NUMBER);
        let k = if asked == Asked::OnLattice { on_lattice::<D>(spacing) } else { WAVE_NUMBER };
        let frequency = (fit.frequency / k - 1.0).abs();
        let damping = (fit.damping / (2.0 / 3.0 * VISCOSITY * k * k) - 1.0).abs();
        let error = match asked {
            Asked::Frequency => frequency,
            Asked::Damping => damping,
            Asked::OnLattice => frequency.max(damping),
        };
        (spacing, error)
    }))
}

/// −Σ V sin(kx) ∂W/∂x over a square or cubic lattice: what its sums make of k.
fn on_lattice<const D: usize>(spacing: f64) -> f64 {
    let kernel = WendlandC2::<f64, D>::new(2.0 * spacing).expect("a length");
    let cells = [-4 * i64::from(D == 3), 4 * i64::from(D == 3)];
    let mut sum = 0.0;
    for (a, b, c) in (-4_i64..=4)
        .flat_map(|a| (-4_i64..=4).map(move |b| (a, b)))
        .flat_map(|(a, b)| (cells[0]..=cells[1]).map(move |c| (a, b, c)))
    {
        let (r2, x) = ((a * a + b * b + c * c) as f64 * spacing * spacing, a as f64 * spacing);
        if r2 < kernel.support() * kernel.support() {
            sum -= spacing.powi(D as i32) * (WAVE_NUMBER * x).sin() * x * kernel.slope(r2);
        }
    }
    sum
}

/// The amplitude of the velocity's mode over three periods.
fn run<T: Real, const D: usize, I: Integrator<T>>(
    spacing: f64,
    integrator: &I,
    conditions: &Conditions,
) -> Series {
    let c = if conditions.is(STIFF) { 1.03 } else { 1.0 };
    let viscosity = if conditions.is(DOUBLE) { 2.0 } else { 1.0 } * VISCOSITY;
    // Two smoothing lengths are four spacings; the box is wider than that across the wave.
    let mut size = [10.0 * spacing; D];
    size[0] = 1.0;
    let mut phase = Phase::new(water::<T>(c, viscosity));
    let places = setup::fill([0.0; D], size, spacing);
    phase.add(&places, T::of(spacing.powi(D as i32)), |_| T::ZERO).expect("particles");
    phase.set_velocity(|x| {
        let mut v = Vector::zero();
        v[0] = T::of(AMPLITUDE * (WAVE_NUMBER * x[0].as_f64()).sin());
        v
    });
    let mixture = bare(2.0 * spacing, phase).with_periodic(periodic(size));
    let mut run = Simulation::new(mixture, integrator.clone(), StepSize::courant(T::of(0.1)).expect("0.1"));
    let mut series = Series::new();
    let _: ControlFlow<()> = run
        .run_until(3.0, |run| {
            let water = run.mixture().water();
            let mode: f64 = (water.positions().iter().zip(water.velocities()))
                .map(|(x, v)| (WAVE_NUMBER * x[0].as_f64()).sin() * v[0].as_f64())
                .sum();
            series.push((run.time(), mode / (0.5 * AMPLITUDE * water.len() as f64)));
            ControlFlow::Continue(())
        })
        .expect("a sound run");
    series
}
