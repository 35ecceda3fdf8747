//! Velocity-Verlet, kick–drift–kick: for energy work.

use super::{Evolve, Integrator, Moment};
use crate::real::Real;

/// Kick by half a step, drift, kick by half a step with the new rates.
///
/// Rates that depend on the fields themselves (drag, viscosity, density) are evaluated with fields
/// predicted to the end of the step, else the method would be of first order; an undamped oscillator
/// does not show that, a damped one does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VelocityVerlet {
    started: bool,
}

impl VelocityVerlet {
    /// A velocity-Verlet about to start.
    pub fn new() -> Self {
        Self::default()
    }
}

impl<T: Real> Integrator<T> for VelocityVerlet {
    fn name(&self) -> &'static str {
        "velocity-verlet"
    }

    fn step<S: Evolve<T>>(&mut self, system: &mut S, dt: T) -> Result<(), S::Error> {
        let half = T::of(0.5) * dt;
        if !self.started {
            system.evaluate()?;
            self.started = true;
        }
        system.complete(Moment::Now, half)?;
        system.advance(Moment::Half, Moment::Now, half);
        system.drift(Moment::Half, dt);
        system.advance(Moment::Now, Moment::Half, half);
        system.evaluate()?;
        system.complete(Moment::Half, half)?;
        system.advance(Moment::Now, Moment::Half, half);
        Ok(())
    }

    fn disturbed(&mut self) {
        self.started = false;
    }
}
