//! The paper's leap-frog (71)–(72) with its half-step approximation, and one whose density is foretold better.

use super::{Evolve, Integrator, Moment};
use crate::real::Real;

/// Leap-frog as printed: fields live half a step beside positions,
///
/// $$X_{n+1/2} = X_{n-1/2} + \Delta t\,(DX/Dt)_n \quad (71),\qquad
/// x_{n+1} = x_n + \Delta t\, v_{n+1/2} \quad (72),$$
///
/// and the fields at the whole step, which the rates need, are approximated by another half step with
/// the last rates, $X_{n+1} = X_{n+1/2} + \tfrac12\Delta t\,(DX/Dt)_n$. For the fields this *is* the
/// second-order Adams–Bashforth method: a vibration without damping grows by (ωΔt)⁴/4 in a step, and a linear
/// drag is borne only up to Δt < t_s. [`with_third_order_density`](Self::with_third_order_density) cures the first.
///
/// Where the step changes, the kick is `½(Δt_{n−1} + Δt_n)`, and it starts from
/// `X_{−1/2} = X₀ − ½Δt (DX/Dt)₀`; otherwise the order would fall to one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LeapFrog<T> {
    previous: Option<T>,
    foresees: bool,
}

/// With this slope the half-step approximation makes the method of Adams and Bashforth of third order.
const THIRD_ORDER: f64 = 5.0 / 6.0;

impl<T: Real> LeapFrog<T> {
    /// A leap-frog about to start, as printed.
    pub fn new() -> Self {
        Self { previous: None, foresees: false }
    }

    /// Foretells the density at the whole step with the slope of its rate,
    /// $\rho_{n+1} = \rho_{n+1/2} + \tfrac12\Delta t\,[\dot\rho_n + \tfrac56(\dot\rho_n - \dot\rho_{n-1})]$,
    /// as the method of Adams and Bashforth of third order does. A vibration of velocity and density, which is sound,
    /// then loses (ωΔt)⁴/16 in a step instead of gaining four times as much, up to ωΔt = 0.69; drag and viscosity,
    /// which act on velocities alone, are borne as far as before.
    pub fn with_third_order_density(self) -> Self {
        Self { foresees: true, ..self }
    }
}

impl<T: Real> Integrator<T> for LeapFrog<T> {
    fn name(&self) -> &'static str {
        if self.foresees { "leap-frog-ab3" } else { "leap-frog" }
    }

    fn step<S: Evolve<T>>(&mut self, system: &mut S, dt: T) -> Result<(), S::Error> {
        let half = T::of(0.5);
        system.evaluate()?;
        if self.previous.is_none() {
            system.complete(Moment::Now, dt)?;
            system.advance(Moment::Half, Moment::Now, -(half * dt));
        }
        let previous = self.previous.unwrap_or(dt);
        let kick = half * (previous + dt);
        system.complete(Moment::Half, kick)?;
        // After a very short step a slope is mostly rounding: it is not taken further than it was seen.
        let slope = if self.foresees { T::of(THIRD_ORDER) * (dt / previous).min(T::ONE) } else { T::ZERO };
        system.leap(kick, dt, slope); // (71), (72)
        self.previous = Some(dt);
        Ok(())
    }
}
