//! Drops without walls: oscillating in a central force, stretching without one.

use crate::water::{WaterMixture, bare, water};
use alluvium::budget::Account;
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize, VelocityVerlet};
use alluvium::verify::{Arrangement, Conditions, Expected, Level, Measured, Random, Study};
use alluvium::{Real, Vector, setup};
use std::ops::ControlFlow;

const SOURCE: &str = "Monaghan & Rafiee (2013): ellipse a, b = ω/a with a' = as, s' = (B² + s²)(b² − a²)/(a² + b²), by Runge–Kutta";
const STRONG: &str = "central force 5 % too strong";
const FAST: &str = "initial strain 5 % too fast";
const UNBOOKED: &str = "density diffusion not booked";
const PUSHED: &str = "a force without reaction";

/// A drop of radius one.
#[derive(Clone, Copy)]
struct Drop {
    /// B \[1/s\] of the force −B²x.
    force: f64,
    /// Initial strain s₀ \[1/s\].
    strain: f64,
    sound: f64,
    end: f64,
}

/// Fifteen times the fastest flow; a period of 4.827 s.
const OSCILLATING: Drop = Drop { force: 1.0, strain: 1.0, sound: 15.0, end: 4.827 };
const STRETCHING: Drop = Drop { force: 0.0, strain: 100.0, sound: 1400.0, end: 0.0076 };

pub fn studies() -> Vec<Study> {
    let mut studies = vec![exact_numbers()];
    for (name, drop) in [("oscillating", OSCILLATING), ("stretching", STRETCHING)] {
        studies.push(axis::<f64>(&format!("drop/{name}/axis/f64"), drop, &[20]));
        studies.push(axis::<f32>(&format!("drop/{name}/axis/f32"), drop, &[20]));
        studies.push(axis::<f64>(&format!("drop/{name}/axis/fine"), drop, &[20, 40]).level(Level::Full));
        studies.push(energy(&format!("drop/{name}/energy"), drop));
    }
    studies.push(momentum::<f64, 2>("drop/momentum/2d/f64", 1e-13));
    studies.push(momentum::<f32, 2>("drop/momentum/2d/f32", 1e-6));
    studies.push(momentum::<f64, 3>("drop/momentum/3d/f64", 1e-13));
    studies.push(momentum::<f32, 3>("drop/momentum/3d/f32", 1e-6));
    studies
}

impl Drop {
    /// The semi-axis along x at equal intervals `dt`, from time zero to the end.
    fn exact(self, dt: f64) -> Vec<f64> {
        let square = self.force * self.force;
        let rate = |[a, s]: [f64; 2]| {
            let (a2, b2) = (a * a, 1.0 / (a * a));
            [a * s, (square + s * s) * (b2 - a2) / (a2 + b2)]
        };
        let mut y = [1.0, self.strain];
        let mut axes = vec![1.0];
        for _ in 0..(self.end / dt).round() as usize {
            let plus = |k: [f64; 2], w: f64| [y[0] + w * dt * k[0], y[1] + w * dt * k[1]];
            let k1 = rate(y);
            let k2 = rate(plus(k1, 0.5));
            let k3 = rate(plus(k2, 0.5));
            let k4 = rate(plus(k3, 1.0));
            y = core::array::from_fn(|k| y[k] + dt / 6.0 * (k1[k] + 2.0 * k2[k] + 2.0 * k3[k] + k4[k]));
            axes.push(y[0]);
        }
        axes
    }

    fn mixture<T: Real>(self, radius: usize, conditions: &Conditions) -> WaterMixture<T, 2> {
        let spacing = 1.0 / radius as f64;
        let strain = if conditions.is(FAST) { 1.05 } else { 1.0 } * self.strain;
        let square = if conditions.is(STRONG) { 1.05 } else { 1.0 } * self.force * self.force;
        let mut places: Vec<Vector<T, 2>> = setup::fill([-1.0; 2], [1.0; 2], spacing);
        // Out of place by up to a tenth: mirror images on a lattice would be pressed into each other.
        let mut random = Random::new(1);
        for x in places.iter_mut().flat_map(|x| &mut x.0) {
            *x += T::of(spacing * random.between(-0.1, 0.1));
        }
        let inside: Vec<_> = places.into_iter().filter(|x| x.norm2() < T::ONE).collect();
        let mut phase = Phase::new(water::<T>(self.sound, 0.0));
        // P₀ (1 − r²) of the round drop.
        let top = 500.0 * (self.strain * self.strain + square);
        phase
            .add(&inside, T::of(spacing * spacing), |x| T::of(top) * (T::ONE - x.norm2()))
            .expect("particles");
        phase.set_velocity(|x| Vector([x[0] * T::of(strain), -x[1] * T::of(strain)]));
        bare(2.0 * spacing, phase)
            .with_density_diffusion(DensityDiffusion::TrueDensity(T::of(0.1)))
            .expect("numerics")
            .with_conservative_force(
                move |x, _| *x * T::of(-square),
                move |x, _| 0.5 * square * x.norm2().as_f64(),
            )
    }
}

fn exact_numbers() -> Study {
    Study::new("drop/exact", "the equations of the ellipse have their known solutions", |conditions| {
        let of =
            |drop: Drop| Drop { strain: if conditions.is(FAST) { 1.05 } else { 1.0 } * drop.strain, ..drop };
        let largest = of(OSCILLATING).exact(1e-4).into_iter().fold(0.0, f64::max);
        let stretched = of(STRETCHING).exact(1e-7).last().copied().unwrap_or(f64::NAN);
        Measured::values([("a_max", largest - 1.93185), ("a(0.0076 s)", stretched - 1.9445)])
    })
    .source("verified numbers: a_max = 1.93185 for a₀ = s₀ = B = 1; 1.9445 for s₀ = 100 /s, B = 0")
    .expect(Expected::Bound { largest: 5e-5 })
    .mutant(FAST)
}

fn axis<T: Real>(name: &str, drop: Drop, radii: &'static [usize]) -> Study {
    Study::new(name, "the semi-axis of an elliptic drop follows the exact equations", move |conditions| {
        Measured::errors(
            radii.iter().map(|&radius| (1.0 / radius as f64, axis_error::<T>(drop, radius, conditions))),
        )
    })
    .equations(&["16", "52", "58", "71"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 0.01 })
    .mutant(if drop.force > 0.0 { STRONG } else { FAST })
}

/// The largest relative error of the semi-axis, 2√⟨x²⟩ over its first value.
fn axis_error<T: Real>(drop: Drop, radius: usize, conditions: &Conditions) -> f64 {
    const SAMPLES: usize = 100;
    let fine = 20;
    let interval = drop.end / SAMPLES as f64;
    let exact = drop.exact(interval / fine as f64);
    let mixture = drop.mixture::<T>(radius, conditions);
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.2)).expect("0.2"));
    let extent = |run: &Simulation<T, 2>| {
        run.mixture().water().positions().iter().map(|x| x[0].as_f64().powi(2)).sum::<f64>().sqrt()
    };
    let first = extent(&run);
    let mut worst: f64 = 0.0;
    for k in 1..=SAMPLES {
        let _ = run.run_until(k as f64 * interval, |_| ControlFlow::<()>::Continue(())).expect("a run");
        let error = extent(&run) / first / exact[k * fine] - 1.0;
        worst = if error.abs() <= worst { worst } else { error.abs() };
    }
    worst
}

fn energy(name: &str, drop: Drop) -> Study {
    Study::new(name, "the ledger explains every loss of energy of a drop", move |conditions| {
        let mixture = drop.mixture::<f64>(20, conditions);
        let mut run = Simulation::new(mixture, VelocityVerlet::new(), StepSize::courant(0.2).expect("0.2"));
        let start = run.budget();
        let mut worst: f64 = 0.0;
        let _ = run
            .run_until(drop.end, |run| -> ControlFlow<()> {
                let unbooked = match conditions.is(UNBOOKED) {
                    true => run.budget().taken[Account::DensityDiffusion],
                    false => 0.0,
                };
                worst = worst.max((run.budget().closure(&start) - unbooked).abs());
                ControlFlow::Continue(())
            })
            .expect("a run");
        let end = run.budget();
        let note = format!("energy lost to density diffusion: {:.2e}", 1.0 - end.energy() / start.energy());
        Measured::value(worst / start.energy()).note(note)
    })
    .equations(&["52", "54", "58"])
    .source("energy is conserved but for what the ledger books, to the error of the time integration")
    .expect(Expected::Bound { largest: 1e-4 })
    .mutant(UNBOOKED)
}

fn momentum<T: Real, const D: usize>(name: &str, largest: f64) -> Study {
    Study::new(
        name,
        "a drop left alone keeps its momentum to round-off, whatever its particles do",
        move |c| momentum_error::<T, D>(c),
    )
    .equations(&["58", "59", "62"])
    .source("(58) is antisymmetric pair by pair")
    .expect(Expected::Bound { largest })
    .mutant(PUSHED)
}

/// Change of the momentum over the sum of its magnitudes, after a hundred steps of a viscous cloud.
fn momentum_error<T: Real, const D: usize>(conditions: &Conditions) -> Measured {
    let arrangement = Arrangement::<D>::jittered(if D == 2 { 30 } else { 12 }, 0.2, 11);
    let mut random = Random::new(4);
    let mut phase = Phase::new(water::<T>(10.0, 0.01));
    phase.add(&arrangement.positions(), T::of(arrangement.volume), |_| T::of(500.0)).expect("particles");
    for v in phase.velocities_mut() {
        *v = Vector::of(core::array::from_fn(|k| 0.2 * k as f64 + random.between(-0.3, 0.3)));
    }
    let mut mixture = bare(1.3 * arrangement.spacing, phase)
        .with_artificial_viscosity(ArtificialViscosity { linear: T::of(0.1), quadratic: T::ONE })
        .and_then(|mixture| mixture.with_strain_control(T::ONE))
        .expect("numerics");
    if conditions.is(PUSHED) {
        mixture = mixture.with_force(|x, _| *x * T::of(0.1));
    }
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.2)).expect("0.2"));
    let start = run.budget();
    for _ in 0..100 {
        run.step().expect("a step");
    }
    let end = run.budget();
    let scale = (2.0 * start.kinetic * start.mass).sqrt();
    let worst = (0..D).map(|k| (end.momentum[k] - start.momentum[k]).abs()).fold(0.0, f64::max) / scale;
    let spin =
        (0..3).map(|k| (end.angular_momentum[k] - start.angular_momentum[k]).abs()).fold(0.0, f64::max);
    Measured::value(worst).note(format!("angular momentum changed by {:.1e} of the same scale", spin / scale))
}
