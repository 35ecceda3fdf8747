//! Integrators of one's own, in the three verbs: Heun's method and the symplectic Euler method.

use crate::tank::Dam;
use alluvium::mixture::{Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, Moment, StepSize};
use core::convert::Infallible;

#[derive(Clone, Debug)]
struct Heun;

impl Integrator<f64> for Heun {
    fn name(&self) -> &'static str {
        "heun"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        system.advance(Moment::Half, Moment::Now, 0.5 * dt); // half of the first rates
        system.advance(Moment::Now, Moment::Now, dt);
        system.drift(Moment::Half, dt);
        system.evaluate()?;
        system.advance(Moment::Now, Moment::Half, 0.5 * dt); // and half of the second
        Ok(())
    }
}

#[derive(Clone, Debug)]
struct Euler;

impl Integrator<f64> for Euler {
    fn name(&self) -> &'static str {
        "symplectic euler"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        system.advance(Moment::Now, Moment::Now, dt);
        system.drift(Moment::Now, dt);
        Ok(())
    }
}

/// `x″ = −x − x′/2`.
struct Oscillator {
    x: f64,
    v: [f64; 2],
    rate: f64,
}

impl Evolve<f64> for Oscillator {
    type Error = Infallible;
    fn evaluate(&mut self) -> Result<(), Infallible> {
        self.rate = -self.x - 0.5 * self.v[Moment::Now as usize];
        Ok(())
    }
    fn advance(&mut self, target: Moment, base: Moment, dt: f64) {
        self.v[target as usize] = self.v[base as usize] + dt * self.rate;
    }
    fn drift(&mut self, moment: Moment, dt: f64) {
        self.x += dt * self.v[moment as usize];
    }
}

fn order(integrator: &impl Integrator<f64>) -> f64 {
    let end = |count: u32| {
        let (mut system, mut integrator) =
            (Oscillator { x: 1.0, v: [0.0; 2], rate: 0.0 }, integrator.clone());
        for _ in 0..count {
            let Ok(()) = integrator.step(&mut system, 4.0 / f64::from(count));
        }
        system.x
    };
    // Three resolutions need no exact solution.
    ((end(200) - end(400)) / (end(400) - end(800))).abs().log2()
}

#[test]
fn they_have_their_orders_on_a_damped_oscillator() {
    assert!((order(&Heun) - 2.0).abs() < 0.1, "heun: {}", order(&Heun));
    assert!((order(&Euler) - 1.0).abs() < 0.1, "euler: {}", order(&Euler));
}

/// Unexplained energy over the potential energy at the start, after 0.1 s of a dam break.
fn closure(integrator: impl Integrator<f64>) -> f64 {
    let dam = Dam { spacing: 0.01, ..Dam::SMALL };
    let mixture = dam.mixture::<f64, 2>(Wall::extrapolated(Slip::FreeSlip));
    let mut run = Simulation::new(mixture, integrator, StepSize::courant(0.1).unwrap());
    run.start().unwrap();
    let start = run.budget();
    while run.time() < 0.1 {
        run.step().unwrap();
    }
    run.budget().closure(&start).abs() / start.potential
}

#[test]
fn the_ledger_closes_with_them_as_the_works_are_advanced_like_any_field() {
    let (heun, euler) = (closure(Heun), closure(Euler));
    assert!(heun < 1e-4, "heun: {heun:e}");
    assert!(euler < 1e-2, "euler: {euler:e}");
}
