//! The integrators are of second order on a system with no particle in sight: undamped, damped, and
//! with steps of changing length. Each way to get them wrong falls to first order in at least one.

use alluvium::Real;
use alluvium::time::{Evolve, Integrator, LeapFrog, Moment, VelocityVerlet};
use core::convert::Infallible;

/// `x″ = −x − 2ζx′` from x = 1, x′ = ½; the field is the velocity.
#[derive(Clone, Debug)]
struct Oscillator<T> {
    damping: T,
    position: T,
    velocity: [T; 2],
    rate: T,
}

impl<T: Real> Oscillator<T> {
    fn new(damping: f64) -> Self {
        let v = T::of(0.5);
        Self { damping: T::of(damping), position: T::ONE, velocity: [v, v], rate: T::ZERO }
    }

    fn exact(damping: f64, t: f64) -> (f64, f64) {
        let omega = (1.0 - damping * damping).sqrt();
        let (a, b) = (1.0, (0.5 + damping) / omega);
        let (sin, cos) = (omega * t).sin_cos();
        let decay = (-damping * t).exp();
        let x = decay * (a * cos + b * sin);
        (x, -damping * x + decay * omega * (b * cos - a * sin))
    }
}

impl<T: Real> Evolve<T> for Oscillator<T> {
    type Error = Infallible;
    fn evaluate(&mut self) -> Result<(), Infallible> {
        let v = self.velocity[Moment::Now as usize];
        self.rate = -self.position - T::of(2.0) * self.damping * v;
        Ok(())
    }
    fn advance(&mut self, target: Moment, base: Moment, dt: T) {
        self.velocity[target as usize] = self.velocity[base as usize] + dt * self.rate;
    }
    fn drift(&mut self, moment: Moment, dt: T) {
        self.position += dt * self.velocity[moment as usize];
    }
}

/// How the length of a step changes from one to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Steps {
    Even,
    /// Growing to three times the first, smoothly.
    Growing,
    /// 1, 2, 1, 3, …: no rule would do this, a second-order method bears it.
    Ragged,
}

impl Steps {
    fn length(self, k: usize, count: usize) -> f64 {
        match self {
            Self::Even => 1.0,
            Self::Growing => 1.0 + 2.0 * k as f64 / count as f64,
            Self::Ragged => [1.0, 2.0, 1.0, 3.0, 2.0][k % 5],
        }
    }
}

const END: f64 = 5.0;

fn error<T: Real>(integrator: &impl Integrator<T>, damping: f64, steps: Steps, count: usize) -> f64 {
    let mut integrator = integrator.clone();
    let mut system = Oscillator::<T>::new(damping);
    let total: f64 = (0..count).map(|k| steps.length(k, count)).sum();
    for k in 0..count {
        let dt = T::of(END * steps.length(k, count) / total);
        let Ok(()) = integrator.step(&mut system, dt);
    }
    let (x, v) = Oscillator::<T>::exact(damping, END);
    (system.position.as_f64() - x).hypot(system.velocity[Moment::Now as usize].as_f64() - v)
}

/// Slope of ln(error) over ln(Δt) through four resolutions.
fn order<T: Real>(integrator: &impl Integrator<T>, damping: f64, steps: Steps, coarsest: usize) -> f64 {
    let points: Vec<(f64, f64)> = (0..4)
        .map(|level| {
            let count = coarsest << level;
            (-(count as f64).ln(), error(integrator, damping, steps, count).ln())
        })
        .collect();
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    mean(&|p| (p.0 - x) * (p.1 - y)) / mean(&|p| (p.0 - x) * (p.0 - x))
}

fn is_second_order<T: Real>(integrator: impl Integrator<T>, coarsest: usize) {
    for damping in [0.0, 0.3] {
        for steps in [Steps::Even, Steps::Growing, Steps::Ragged] {
            let order = order(&integrator, damping, steps, coarsest);
            let what = format!("{} {}, damping {damping}, {steps:?}", integrator.name(), T::NAME);
            assert!((order - 2.0).abs() <= 0.1, "{what}: order {order}");
        }
    }
}

#[test]
fn leap_frog_is_second_order() {
    is_second_order::<f64>(LeapFrog::new(), 200);
    is_second_order::<f32>(LeapFrog::new(), 80);
}

#[test]
fn velocity_verlet_is_second_order() {
    is_second_order::<f64>(VelocityVerlet::new(), 200);
    is_second_order::<f32>(VelocityVerlet::new(), 80);
}

/// Sound in one number: `v′ = −ωρ − κv`, `ρ′ = ωv` from v = 0, ρ = 1, with ω = 1; its system keeps the last rate of
/// the density.
#[derive(Clone, Debug)]
struct Sound {
    drag: f64,
    velocity: [f64; 2],
    density: [f64; 2],
    rates: [f64; 2],
    before: Option<f64>,
}

impl Sound {
    fn new(drag: f64) -> Self {
        Self { drag, velocity: [0.0; 2], density: [1.0; 2], rates: [0.0; 2], before: None }
    }

    fn size(&self) -> f64 {
        self.velocity[0].hypot(self.density[0])
    }
}

impl Evolve<f64> for Sound {
    type Error = Infallible;
    fn evaluate(&mut self) -> Result<(), Infallible> {
        let (v, density) = (self.velocity[0], self.density[0]);
        self.rates = [-density - self.drag * v, v];
        Ok(())
    }
    fn advance(&mut self, target: Moment, base: Moment, dt: f64) {
        self.velocity[target as usize] = self.velocity[base as usize] + dt * self.rates[0];
        self.density[target as usize] = self.density[base as usize] + dt * self.rates[1];
    }
    fn leap(&mut self, kick: f64, dt: f64, slope: f64) {
        self.advance(Moment::Half, Moment::Half, kick);
        self.advance(Moment::Now, Moment::Half, 0.5 * dt);
        let before = self.before.replace(self.rates[1]).unwrap_or(self.rates[1]);
        self.density[0] += 0.5 * dt * slope * (self.rates[1] - before);
    }
    fn drift(&mut self, _: Moment, _: f64) {}
}

/// By how much each of `count` steps of this length makes a vibration larger, relative.
fn growth(mut integrator: LeapFrog<f64>, drag: f64, dt: f64, count: usize) -> f64 {
    let mut sound = Sound::new(drag);
    let mut steps = |count: usize| {
        for _ in 0..count {
            let Ok(()) = integrator.step(&mut sound, dt);
        }
        sound.size()
    };
    let begin = steps(500);
    (steps(count) / begin).powf(1.0 / count as f64) - 1.0
}

#[test]
fn a_vibration_gains_with_the_density_as_printed_and_loses_with_that_of_third_order() {
    let foreseen = LeapFrog::new().with_third_order_density();
    for dt in [0.05_f64, 0.1] {
        let fourth = dt.powi(4);
        // So many that it does not matter where in its swing the vibration is looked at.
        let (printed, third_order) =
            (growth(LeapFrog::new(), 0.0, dt, 100_000), growth(foreseen, 0.0, dt, 100_000));
        assert!((printed / (fourth / 4.0) - 1.0).abs() < 0.06, "{printed:e} at {dt}");
        assert!((third_order / (fourth / -16.0) - 1.0).abs() < 0.06, "{third_order:e} at {dt}");
    }
    assert!(growth(foreseen, 0.0, 0.68, 1000) < 0.0 && growth(foreseen, 0.0, 0.71, 1000) > 0.0);
}

#[test]
fn drag_is_borne_as_far_with_the_density_of_third_order() {
    // Without sound: the density follows and does not answer.
    for integrator in [LeapFrog::new(), LeapFrog::new().with_third_order_density()] {
        let (dt, drag) = (1e-6, 1e6);
        assert!(
            growth(integrator, 0.98 * drag, dt, 1000) < 1e-5
                && growth(integrator, 1.02 * drag, dt, 1000) > 1e-3
        );
    }
}

#[test]
fn leap_frog_with_the_density_of_third_order_is_second_order_with_any_steps() {
    let error = |steps: Steps, count: usize| {
        let mut integrator = LeapFrog::new().with_third_order_density();
        let mut sound = Sound::new(0.6);
        let total: f64 = (0..count).map(|k| steps.length(k, count)).sum();
        for k in 0..count {
            let Ok(()) = integrator.step(&mut sound, END * steps.length(k, count) / total);
        }
        // ρ″ = −ρ − 0.6 ρ′ from ρ = 1, ρ′ = 0.
        let (damping, omega) = (0.3, 0.91_f64.sqrt());
        let (sin, cos) = (omega * END).sin_cos();
        let decay = (-damping * END).exp();
        let density = decay * (cos + damping / omega * sin);
        (sound.density[0] - density).hypot(sound.velocity[0] + decay * sin / omega)
    };
    for steps in [Steps::Even, Steps::Growing, Steps::Ragged] {
        let order = (error(steps, 200) / error(steps, 800)).log2() / 2.0;
        assert!((order - 2.0).abs() <= 0.15, "{steps:?}: order {order}");
    }
}

/// Leap-frog with one of two mistakes.
#[derive(Clone, Debug)]
struct WrongLeapFrog {
    /// Starts the fields at X₀ instead of X_{−1/2}.
    cold_start: bool,
    /// Kicks with Δt_n instead of ½(Δt_{n−1} + Δt_n).
    careless_kick: bool,
    previous: Option<f64>,
}

impl Integrator<f64> for WrongLeapFrog {
    fn name(&self) -> &'static str {
        "wrong leap-frog"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        if self.previous.is_none() {
            system.advance(Moment::Half, Moment::Now, if self.cold_start { 0.0 } else { -0.5 * dt });
        }
        let previous = if self.careless_kick { dt } else { self.previous.unwrap_or(dt) };
        system.advance(Moment::Half, Moment::Half, 0.5 * (previous + dt));
        system.drift(Moment::Half, dt);
        system.advance(Moment::Now, Moment::Half, 0.5 * dt);
        self.previous = Some(dt);
        Ok(())
    }
}

/// Velocity-Verlet that evaluates its second rates with the fields of the first.
#[derive(Clone, Debug)]
struct WrongVelocityVerlet;

impl Integrator<f64> for WrongVelocityVerlet {
    fn name(&self) -> &'static str {
        "wrong velocity-verlet"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        system.advance(Moment::Half, Moment::Now, 0.5 * dt);
        system.drift(Moment::Half, dt);
        system.evaluate()?;
        system.advance(Moment::Now, Moment::Half, 0.5 * dt);
        Ok(())
    }
}

const FIRST_ORDER: core::ops::Range<f64> = 0.8..1.3;

#[test]
fn a_cold_started_leap_frog_is_first_order() {
    let wrong = WrongLeapFrog { cold_start: true, careless_kick: false, previous: None };
    let order = order(&wrong, 0.0, Steps::Even, 200);
    assert!(FIRST_ORDER.contains(&order), "order {order}");
}

#[test]
fn a_leap_frog_that_ignores_the_last_step_is_first_order() {
    let wrong = WrongLeapFrog { cold_start: false, careless_kick: true, previous: None };
    let order_even = order(&wrong, 0.0, Steps::Even, 200);
    assert!((order_even - 2.0).abs() <= 0.1, "even steps hide it: order {order_even}");
    let order = order(&wrong, 0.0, Steps::Growing, 200);
    assert!(FIRST_ORDER.contains(&order), "order {order}");
}

#[test]
fn a_velocity_verlet_that_does_not_predict_is_first_order() {
    let undamped = order(&WrongVelocityVerlet, 0.0, Steps::Even, 200);
    assert!((undamped - 2.0).abs() <= 0.1, "an undamped oscillator hides it: order {undamped}");
    let order = order(&WrongVelocityVerlet, 0.3, Steps::Even, 200);
    assert!(FIRST_ORDER.contains(&order), "order {order}");
}
