//! What every integrator must do (71), (72).

use crate::real::Real;
use crate::time::{Evolve, Integrator, Moment};
use crate::verify::{Conditions, Expected, Measured, Study};
use core::convert::Infallible;

const UNPREDICTED: &str = "half-step predictor left out";
const UNCOMPLETED: &str = "stiff rates left out";
const LATE: &str = "moved by the length of the last step";

/// How the length of a step changes from one to the next.
#[derive(Clone, Copy, Debug)]
enum Steps {
    Equal,
    /// Growing to three times the first, smoothly.
    Growing,
    /// 1, 2, 1, 3, 2: no rule would do this, a second-order method bears it.
    Ragged,
}

impl Steps {
    fn length(self, k: usize, count: usize) -> f64 {
        match self {
            Self::Equal => 1.0,
            Self::Growing => 1.0 + 2.0 * k as f64 / count as f64,
            Self::Ragged => [1.0, 2.0, 1.0, 3.0, 2.0][k % 5],
        }
    }
}

/// How long the system is followed \[s\].
const END: f64 = 5.0;
const DAMPING: f64 = 0.3;
/// Speed of the centre of mass \[m/s\].
const GLIDE: f64 = 1.0;

/// Studies of an integrator, made anew for each run by `make`: second order (or higher) on two masses
/// with a spring and a dashpot between them, in `undamped`, `equal steps`, `growing steps` and `ragged
/// steps`; and `stiff rates`, that drag solved over the step is not left out.
///
/// What becomes of energy and momentum is noted beside.
pub fn integrator<T: Real, I: Integrator<T>>(
    name: &str,
    make: impl Fn() -> I + Clone + Send + Sync + 'static,
) -> Vec<Study> {
    let study = |what: &str, claim: &str, damping: f64, steps: Steps, is_stiff: bool| {
        let make = make.clone();
        let run = move |conditions: &Conditions| {
            let coarsest = if T::EPSILON.as_f64() < 1e-10 { 50 } else { 30 };
            let error = |level: u32| {
                let count = coarsest << level;
                let mut system = Pair::new(damping, is_stiff, conditions);
                let error = system.error_of(make(), steps, count);
                (END / count as f64, error)
            };
            let measured = Measured::errors((0..4).map(error));
            if damping == 0.0 { measured.note(balance::<T, I>(make())) } else { measured }
        };
        Study::new(format!("{name}/{what}"), claim, run).source("exact solution")
    };
    let second = Expected::Order { at_least: 1.9, at_most: f64::INFINITY };
    let order = |what: &str, claim: &str, damping, steps| {
        study(what, claim, damping, steps, false).expect(second).mutant(UNPREDICTED)
    };
    vec![
        order("undamped", "of second order on an undamped oscillator", 0.0, Steps::Equal),
        order("equal steps", "of second order on a damped oscillator", DAMPING, Steps::Equal),
        order("growing steps", "the same with steps that grow", DAMPING, Steps::Growing).mutant(LATE),
        order("ragged steps", "the same with steps of any length", DAMPING, Steps::Ragged).mutant(LATE),
        study("stiff rates", "rates solved over the step are completed", DAMPING, Steps::Equal, true)
            .expect(Expected::Order { at_least: 0.9, at_most: f64::INFINITY })
            .mutant(UNCOMPLETED),
    ]
}

/// Two masses of 1 kg, a spring and a dashpot between them: their distance obeys `x″ = −x − 2ζx′`, from
/// x = 1, x′ = ½, and the centre glides on.
#[derive(Clone, Debug)]
struct Pair<T> {
    damping: T,
    /// The dashpot is solved over the step.
    is_stiff: bool,
    mutant: Option<&'static str>,
    position: [T; 2],
    velocity: [[T; 2]; 2],
    spring: T,
    force: T,
    last_step: Option<T>,
}

impl<T: Real> Pair<T> {
    fn new(damping: f64, is_stiff: bool, conditions: &Conditions) -> Self {
        let half = |x: f64| [T::of(0.5 * x), T::of(-0.5 * x)];
        let velocity = half(0.5).map(|v| v + T::of(GLIDE));
        Self {
            damping: T::of(damping),
            is_stiff,
            mutant: [UNPREDICTED, UNCOMPLETED, LATE].into_iter().find(|mutant| conditions.is(mutant)),
            position: half(1.0),
            velocity: [velocity; 2],
            spring: T::ZERO,
            force: T::ZERO,
            last_step: None,
        }
    }

    fn distance(&self) -> T {
        self.position[0] - self.position[1]
    }

    fn growth(&self, moment: Moment) -> T {
        let [a, b] = self.velocity[moment as usize];
        a - b
    }

    /// Distance and its rate at t.
    fn exact(damping: f64, t: f64) -> (f64, f64) {
        let omega = (1.0 - damping * damping).sqrt();
        let (a, b) = (1.0, (0.5 + damping) / omega);
        let (sin, cos) = (omega * t).sin_cos();
        let decay = (-damping * t).exp();
        let x = decay * (a * cos + b * sin);
        (x, -damping * x + decay * omega * (b * cos - a * sin))
    }

    /// Follows it in so many steps; how far it is then from where it should be.
    fn error_of(&mut self, mut by: impl Integrator<T>, steps: Steps, count: usize) -> f64 {
        let total: f64 = (0..count).map(|k| steps.length(k, count)).sum();
        for k in 0..count {
            let Ok(()) = by.step(self, T::of(END * steps.length(k, count) / total));
        }
        let (x, v) = Self::exact(self.damping.as_f64(), END);
        (self.distance().as_f64() - x).hypot(self.growth(Moment::Now).as_f64() - v)
    }
}

impl<T: Real> Evolve<T> for Pair<T> {
    type Error = Infallible;
    fn evaluate(&mut self) -> Result<(), Infallible> {
        let half = T::of(0.5);
        self.spring = -half * self.distance();
        let dashpot = if self.is_stiff { T::ZERO } else { self.damping * self.growth(Moment::Now) };
        self.force = self.spring - dashpot;
        Ok(())
    }
    fn complete(&mut self, base: Moment, dt: T) -> Result<(), Infallible> {
        if self.is_stiff && self.mutant != Some(UNCOMPLETED) {
            // v = v₀ + 2 dt (spring − ζ v) for the difference of the velocities.
            let two = T::of(2.0);
            let end = (self.growth(base) + two * dt * self.spring) / (T::ONE + two * dt * self.damping);
            self.force = self.spring - self.damping * end;
        }
        Ok(())
    }
    fn advance(&mut self, target: Moment, base: Moment, dt: T) {
        let predicts = (target, base) == (Moment::Now, Moment::Half);
        let dt = if predicts && self.mutant == Some(UNPREDICTED) { T::ZERO } else { dt };
        let [a, b] = self.velocity[base as usize];
        self.velocity[target as usize] = [a + dt * self.force, b - dt * self.force];
    }
    fn drift(&mut self, moment: Moment, dt: T) {
        let last = self.last_step.replace(dt).unwrap_or(dt);
        let dt = if self.mutant == Some(LATE) { last } else { dt };
        for (x, v) in self.position.iter_mut().zip(self.velocity[moment as usize]) {
            *x += dt * v;
        }
    }
}

/// What becomes of energy and momentum of the undamped pair in a hundred periods.
fn balance<T: Real, I: Integrator<T>>(mut by: I) -> String {
    let mut system = Pair::<T>::new(0.0, false, &Conditions::default());
    let energy = |system: &Pair<T>| {
        let (x, v) = (system.distance().as_f64(), system.growth(Moment::Now).as_f64());
        x * x + v * v
    };
    let momentum = |system: &Pair<T>| system.velocity[Moment::Now as usize].iter().map(|v| v.as_f64()).sum();
    let (start, before): (f64, f64) = (energy(&system), momentum(&system));
    for _ in 0..6000 {
        let Ok(()) = by.step(&mut system, T::of(core::f64::consts::TAU / 60.0));
    }
    let (gained, moved) = (energy(&system) / start - 1.0, momentum(&system) / before - 1.0);
    format!(
        "without damping, after 100 periods of 60 steps each: energy {:+.1e}, momentum {:+.1e} of what they were",
        gained, moved
    )
}
