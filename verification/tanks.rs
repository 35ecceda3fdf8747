//! Water under gravity between walls: the standing wave, and exact rest.

use crate::fits::{Series, oscillation};
use crate::water::{WaterMixture, bare, periodic, water};
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, Phase, Slip, StepError, Wall, WallKind};
use alluvium::simulation::Simulation;
use alluvium::time::{Integrator, LeapFrog, StepSize, VelocityVerlet};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study, relative_l2};
use alluvium::{Real, Vector, setup};
use std::f64::consts::PI;
use std::ops::ControlFlow;

const G: f64 = 9.81;
const DEPTH: f64 = 0.3;
const LENGTH: f64 = 1.0;
/// Ten times √(gH), nearly.
const SOUND: f64 = 17.0;
/// So slow that water at rest is compressed by 4 % at the floor, and its pressure 2 % above ρ₀gH.
const SLOW_SOUND: f64 = 8.0;
const LIGHT: &str = "gravity 10 % too weak";
const UNSEEN: &str = "walls that do not see gravity";
const RIGID: &str = "the profile of incompressible water expected";

pub fn studies() -> Vec<Study> {
    vec![
        wave::<f64, 2, _>("gravity wave/2d/f64", LeapFrog::new(), &[15]),
        wave::<f32, 2, _>("gravity wave/2d/f32", LeapFrog::new(), &[15]),
        wave::<f64, 2, _>("gravity wave/verlet", VelocityVerlet::new(), &[15]),
        wave::<f64, 2, _>("gravity wave/fine", LeapFrog::new(), &[15, 30]).level(Level::Full),
        wave::<f64, 3, _>("gravity wave/3d/f64", LeapFrog::new(), &[15]).level(Level::Full),
        wave::<f32, 3, _>("gravity wave/3d/f32", LeapFrog::new(), &[15]).level(Level::Full),
        rest::<f64, 2>("rest/2d/f64", 20),
        rest::<f32, 2>("rest/2d/f32", 20),
        rest::<f64, 2>("rest/fine", 40).level(Level::Full),
        rest::<f64, 3>("rest/3d/f64", 20).level(Level::Full),
        rest::<f32, 3>("rest/3d/f32", 20).level(Level::Full),
    ]
}

/// A column between free-slip walls, `closed` along the first axis or repeating itself.
fn tank<T: Real, const D: usize>(
    size: [f64; D],
    spacing: f64,
    closed: bool,
    sound: f64,
    gravity: f64,
    pressure: impl Fn(f64) -> f64,
) -> WaterMixture<T, D> {
    let up = D - 1;
    let mut sides = [(false, false); D];
    sides[up] = (true, false);
    sides[0] = (closed, closed);
    let volume = T::of(spacing.powi(D as i32));
    let wall = Wall::new(WallKind::Extrapolated { slip: Slip::FreeSlip, suction: false });
    let mut phase = Phase::new(water::<T>(sound, 0.0));
    let field = |x: &Vector<T, D>| T::of(pressure(x[up].as_f64()));
    let mut high = size;
    // Walls reach above the surface, or the water would climb round their edge.
    high[up] = if closed { 1.3 * size[up] } else { size[up] };
    phase.add_wall(wall, &setup::tank([0.0; D], high, spacing, 4, sides), volume, field).expect("a wall");
    phase.add(&setup::fill([0.0; D], size, spacing), volume, field).expect("particles");
    let mut down = Vector::zero();
    down[up] = T::of(-gravity);
    let mut lengths = size;
    lengths[up] = 0.0;
    lengths[0] = if closed { 0.0 } else { size[0] };
    bare(2.0 * spacing, phase)
        .with_gravity(down)
        .with_periodic(periodic(lengths))
        .with_density_diffusion(DensityDiffusion::Hydrostatic(T::of(0.1)))
        .and_then(|mixture| {
            mixture.with_artificial_viscosity(ArtificialViscosity { linear: T::of(0.01), quadratic: T::ONE })
        })
        .expect("numerics")
}

/// Pressure of still water whose surface is at `depth`, exact for Tait's equation of state.
fn hydrostatic(depth: f64, gravity: f64, sound: f64, z: f64) -> f64 {
    let below = (depth - z).max(0.0);
    let stiffness = 1000.0 * sound * sound / 7.0;
    stiffness * ((1.0 + 6.0 * gravity * below / (sound * sound)).powf(7.0 / 6.0) - 1.0)
}

fn wave<T: Real, const D: usize, I: Integrator<T> + Sync>(
    name: &str,
    integrator: I,
    rows: &'static [usize],
) -> Study {
    Study::new(name, "a standing wave on water of finite depth has ω² = gk tanh kH", move |conditions| {
        Measured::errors(rows.iter().map(|&rows| {
            let spacing = DEPTH / rows as f64;
            (spacing, wave_error::<T, D, I>(spacing, &integrator, conditions))
        }))
    })
    .equations(&["16", "52", "58", "71"])
    .source("linear waves: H = 0.3 m, k = π/L, L = 1 m: ω = 4.76381 rad/s")
    .expect(Expected::Bound { largest: 0.02 })
    .mutant(LIGHT)
}

/// Relative error of the frequency over two periods; in 3D of a wave along x, across which space repeats itself.
fn wave_error<T: Real, const D: usize, I: Integrator<T>>(
    spacing: f64,
    integrator: &I,
    conditions: &Conditions,
) -> f64 {
    let gravity = if conditions.is(LIGHT) { 0.9 * G } else { G };
    let k = PI / LENGTH;
    let exact = (G * k * (k * DEPTH).tanh()).sqrt();
    let mode = move |x: [f64; D]| {
        let (scale, height) = (1.0 / (k * DEPTH).sinh(), k * x[D - 1]);
        let mut v = [0.0; D];
        v[0] = -(k * x[0]).sin() * height.cosh() * scale;
        v[D - 1] = (k * x[0]).cos() * height.sinh() * scale;
        v
    };
    let mut size = [10.0 * spacing; D];
    (size[0], size[D - 1]) = (LENGTH, DEPTH);
    let still = |z| hydrostatic(DEPTH, gravity, SOUND, z);
    let mut mixture = tank::<T, D>(size, spacing, true, SOUND, gravity, still);
    // A tenth of the depth high: less would be a fraction of a spacing, which rows of particles at a
    // wall of particles resist.
    let speed = 0.1 * DEPTH * exact;
    mixture.water_mut().set_velocity(|x| Vector::of(mode(x.as_f64()).map(|v| speed * v)));
    let step = StepSize::courant(T::of(0.2)).expect("0.2");
    let mut run = Simulation::new(mixture, integrator.clone(), step);
    let mut series = Series::new();
    let _ = run
        .run_until(4.0 * PI / exact, |run| -> ControlFlow<()> {
            let water = run.mixture().water();
            let free = water.wall_particles()..water.len();
            let dot = |i: usize| {
                let (m, v) = (mode(water.positions()[i].as_f64()), water.velocities()[i].as_f64());
                (m[0] * v[0] + m[D - 1] * v[D - 1], m[0] * m[0] + m[D - 1] * m[D - 1])
            };
            let (up, down) = free.map(dot).fold((0.0, 0.0), |(a, b), (c, d)| (a + c, b + d));
            series.push((run.time(), up / (down * speed)));
            ControlFlow::Continue(())
        })
        .expect("a run");
    let fit = oscillation(&series, exact);
    (fit.frequency / exact - 1.0).abs()
}

fn rest<T: Real, const D: usize>(name: &str, rows: usize) -> Study {
    Study::new(name, "still water keeps the exact pressure of Tait's equation of state", move |conditions| {
        rest_errors::<T, D>(rows, conditions)
    })
    .equations(&["16", "74"])
    .source("dp = ρg dz with (16): (ρ/ρ₀)^{χ−1} = 1 + (χ−1) g z/c₀²")
    .expect(Expected::Bound { largest: 0.01 })
    .mutant(UNSEEN)
    .mutant(RIGID)
}

/// Relative L2 error of the pressure two seconds after a start with (74); the largest speed over c.
fn rest_errors<T: Real, const D: usize>(rows: usize, conditions: &Conditions) -> Measured {
    let spacing = DEPTH / rows as f64;
    let mut size = [10.0 * spacing; D];
    size[D - 1] = DEPTH;
    let gravity = if conditions.is(UNSEEN) { 0.0 } else { G };
    let mut mixture =
        tank::<T, D>(size, spacing, false, SLOW_SOUND, gravity, |z| 1000.0 * G * (DEPTH - z).max(0.0));
    if conditions.is(UNSEEN) {
        // The same pull, as a force that walls know nothing of.
        mixture = mixture.with_force(|_, _| {
            let mut down = Vector::zero();
            down[D - 1] = T::of(-G);
            down
        });
    }
    let step = StepSize::courant(T::of(0.2)).expect("0.2");
    let run = Simulation::new(mixture, LeapFrog::new(), step);
    let state = match settled(run) {
        Ok(state) => state,
        // A floor that does not hold: that is measured, as no number.
        Err(_) if conditions.is(UNSEEN) => Vec::new(),
        Err(error) => panic!("{error}"),
    };
    let sound = if conditions.is(RIGID) { 1e3 } else { SLOW_SOUND };
    let exact: Vec<f64> = state.iter().map(|row| hydrostatic(DEPTH, G, sound, row.0)).collect();
    let measured: Vec<f64> = state.iter().map(|row| row.1).collect();
    let fastest = state.iter().map(|row| row.2).fold(0.0, f64::max) / SLOW_SOUND;
    let error = relative_l2(&measured, &exact);
    Measured::values([("pressure", error), ("ten times the largest speed over c", 10.0 * fastest)])
}

/// Height, pressure and speed of every particle after two seconds.
fn settled<T: Real, const D: usize>(mut run: Simulation<T, D>) -> Result<Vec<(f64, f64, f64)>, StepError> {
    let _ = run.run_until(2.0, |_| ControlFlow::<()>::Continue(()))?;
    let water = run.mixture().water();
    let row = |i: usize| {
        let height = water.positions()[i][D - 1].as_f64();
        (height, water.pressures()[i].as_f64(), water.velocities()[i].norm().as_f64())
    };
    Ok((water.wall_particles()..water.len()).map(row).collect())
}
