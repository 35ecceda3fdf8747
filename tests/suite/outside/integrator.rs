//! Integrators of one's own, in the three verbs: Heun's method and the symplectic Euler method.

use crate::tank::Dam;
use alluvium::mixture::{Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, Integrator, Moment, StepSize};

#[derive(Clone, Debug)]
pub struct Heun;

impl Integrator<f64> for Heun {
    fn name(&self) -> &'static str {
        "heun"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        system.complete(Moment::Now, 0.5 * dt)?;
        system.advance(Moment::Half, Moment::Now, 0.5 * dt); // half of the first rates
        system.advance(Moment::Now, Moment::Now, dt);
        system.drift(Moment::Half, dt);
        system.evaluate()?;
        system.complete(Moment::Half, 0.5 * dt)?;
        system.advance(Moment::Now, Moment::Half, 0.5 * dt); // and half of the second
        Ok(())
    }
}

#[derive(Clone, Debug)]
pub struct Euler;

impl Integrator<f64> for Euler {
    fn name(&self) -> &'static str {
        "symplectic euler"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        system.complete(Moment::Now, dt)?;
        system.advance(Moment::Now, Moment::Now, dt);
        system.drift(Moment::Now, dt);
        Ok(())
    }
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
