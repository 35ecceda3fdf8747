//! The paper's leap-frog (71)–(72) with its half-step approximation.

use super::{Evolve, Integrator, Moment};
use crate::real::Real;

/// Leap-frog as printed: fields live half a step beside positions,
///
/// $$X_{n+1/2} = X_{n-1/2} + \Delta t\,(DX/Dt)_n \quad (71),\qquad
/// x_{n+1} = x_n + \Delta t\, v_{n+1/2} \quad (72),$$
///
/// and the fields at the whole step, which the rates need, are approximated by another half step with
/// the last rates, $X_{n+1} = X_{n+1/2} + \tfrac12\Delta t\,(DX/Dt)_n$. For the fields this *is* the
/// second-order Adams–Bashforth method: it bears oscillations only weakly and a linear drag only up to
/// Δt < t_s.
///
/// Where the step changes, the kick is `½(Δt_{n−1} + Δt_n)`, and it starts from
/// `X_{−1/2} = X₀ − ½Δt (DX/Dt)₀`; otherwise the order would fall to one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LeapFrog<T> {
    previous: Option<T>,
}

impl<T: Real> LeapFrog<T> {
    /// A leap-frog about to start.
    pub fn new() -> Self {
        Self { previous: None }
    }
}

impl<T: Real> Integrator<T> for LeapFrog<T> {
    fn name(&self) -> &'static str {
        "leap-frog"
    }

    fn step<S: Evolve<T>>(&mut self, system: &mut S, dt: T) -> Result<(), S::Error> {
        let half = T::of(0.5);
        system.evaluate()?;
        if self.previous.is_none() {
            system.complete(Moment::Now, dt)?;
            system.advance(Moment::Half, Moment::Now, -(half * dt));
        }
        let kick = half * (self.previous.unwrap_or(dt) + dt);
        system.complete(Moment::Half, kick)?;
        system.advance(Moment::Half, Moment::Half, kick); // (71)
        system.drift(Moment::Half, dt); // (72)
        system.advance(Moment::Now, Moment::Half, half * dt);
        self.previous = Some(dt);
        Ok(())
    }
}
