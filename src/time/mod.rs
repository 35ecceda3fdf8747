//! Time: a system's verbs, and the integrators that order them.
//!
//! An integrator knows nothing of particles: it evaluates rates, advances fields and drifts positions
//! of whatever can [`Evolve`].

mod leap_frog;
mod step_size;
mod velocity_verlet;

pub use leap_frog::LeapFrog;
pub use step_size::{Limit, Limits, StepSize};
pub use velocity_verlet::VelocityVerlet;

use crate::real::Real;
use core::fmt::Debug;

/// One of the two instants a system keeps its fields at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// The instant of the positions, t_n.
    Now,
    /// The instant in between, t_{n±1/2}.
    Half,
}

/// A system of positions x and fields X, of which X includes the velocity, that can be moved in time.
pub trait Evolve<T: Real> {
    /// Why an evaluation can fail.
    type Error;
    /// Computes the rates DX/Dt from positions and fields [`Now`](Moment::Now).
    ///
    /// # Errors
    /// The rates are not usable.
    fn evaluate(&mut self) -> Result<(), Self::Error>;
    /// Completes the rates with those so stiff that they are solved over a step of `dt` \[s\] from the fields
    /// `base`, right before the kick that does that step. May come several times after an evaluation, and each
    /// time begins with what that left. Most systems have no such rates.
    ///
    /// # Errors
    /// There is no solution.
    fn complete(&mut self, base: Moment, dt: T) -> Result<(), Self::Error> {
        let _ = (base, dt);
        Ok(())
    }
    /// `X_target ← X_base + dt · DX/Dt`, made admissible; positions stay.
    fn advance(&mut self, target: Moment, base: Moment, dt: T);
    /// `x ← x + dt · v_moment` and `t ← t + dt` \[s\].
    fn drift(&mut self, moment: Moment, dt: T);
    /// What leap-frog does with rates: fields to half the step over `kick` \[s\] (71), positions over `dt` (72), and the
    /// fields at the next whole step foretold, `X_now ← X_half + ½dt · DX/Dt`.
    ///
    /// Of fields that swing against the velocity, as density does, a system may keep the rates of one leap to the next
    /// and foretell with `DX/Dt + slope · (DX/Dt − last DX/Dt)`; and one of large arrays may go over them once.
    fn leap(&mut self, kick: T, dt: T, slope: T) {
        let _ = slope;
        self.advance(Moment::Half, Moment::Half, kick);
        self.drift(Moment::Half, dt);
        self.advance(Moment::Now, Moment::Half, T::of(0.5) * dt);
    }
}

/// A way through one time step.
pub trait Integrator<T: Real>: Clone + Debug + Send + 'static {
    /// Its name, for logs.
    fn name(&self) -> &'static str;
    /// Moves the system by `dt` \[s\].
    ///
    /// # Errors
    /// Those of the system's evaluation.
    fn step<S: Evolve<T>>(&mut self, system: &mut S, dt: T) -> Result<(), S::Error>;
    /// Particles have come or gone since the last step: rates that were kept from it are void.
    fn disturbed(&mut self) {}
}
