//! Darcy's law.

use super::{Conductivity, DragLaw};
use crate::real::Real;

/// Gravity under which conductivities are measured \[m/s²\].
pub(super) const GRAVITY: f64 = 9.81;

/// Darcy's law with a constant conductivity, Eq. (37).
///
/// $$C_d = \frac{\phi_f\,\gamma_w}{k},\qquad \gamma_w = \rho_f g = \phi_f\,\tilde\rho_f\,g$$
///
/// γ_w with the partial density is right: the seepage velocity φ_f (v_f − v_s) is then k times the gradient
/// of the head. Its g is that under which k was measured, not that of the mixture.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Darcy<T> {
    conductivity: Conductivity<T>,
    gravity: T,
}

impl<T: Real> Darcy<T> {
    /// Of this conductivity, measured under 9.81 m/s².
    pub fn new(conductivity: Conductivity<T>) -> Self {
        Self { conductivity, gravity: T::of(GRAVITY) }
    }

    /// Its conductivity.
    pub fn conductivity(&self) -> Conductivity<T> {
        self.conductivity
    }
}

impl<T: Real> DragLaw<T> for Darcy<T> {
    #[inline(always)]
    fn coefficient(&self, fraction: T, true_density: T, _: T) -> T {
        fraction * fraction * true_density * self.gravity / self.conductivity.metres_per_second() // (37)
    }
    fn knows_slip(&self) -> bool {
        false
    }
    fn describe(&self) -> String {
        format!("Darcy's law with k = {:e} m/s", self.conductivity.metres_per_second())
    }
}
