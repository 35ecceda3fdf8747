//! Darcy's law with the inertia of a fast flow.

use super::{Conductivity, DragLaw, Permeability, PoreFluid};
use crate::error::ParameterError;
use crate::material::Darcy;
use crate::real::Real;

/// Darcy's law (37) with the inertial term of Forchheimer (1901), in the form of Ward (1964):
///
/// $$C_d = \frac{\phi_f\,\gamma_w}{k} + c_F\,\frac{\phi_f^3\,\tilde\rho_f}{\sqrt\kappa}\,s$$
///
/// with the permeability κ that belongs to k and the slip s = |v_f − v_s|; Ward found c_F = 0.55.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Forchheimer<T> {
    darcy: Darcy<T>,
    permeability: Permeability<T>,
    inertia: T,
}

impl<T: Real> Forchheimer<T> {
    /// Of a conductivity for this fluid and c_F \[-\].
    ///
    /// # Errors
    /// c_F is negative or not finite, or the permeability too small for the precision.
    pub fn new(
        conductivity: Conductivity<T>,
        fluid: &PoreFluid<T>,
        inertia: T,
    ) -> Result<Self, ParameterError> {
        if !(inertia >= T::ZERO && inertia.is_finite()) {
            return Err(ParameterError::new("forchheimer_coefficient", inertia, "a number, 0 or above"));
        }
        let permeability = conductivity.permeability(fluid)?;
        Ok(Self { darcy: Darcy::new(conductivity), permeability, inertia })
    }
}

impl<T: Real> DragLaw<T> for Forchheimer<T> {
    #[inline(always)]
    fn coefficient(&self, fraction: T, true_density: T, slip: T) -> T {
        // The slip of a stray particle with no room at all must not push.
        let fraction = fraction.max(T::ZERO);
        let cube = fraction * fraction * fraction;
        let inertia = self.inertia * cube * true_density / self.permeability.square_metres().sqrt();
        self.darcy.coefficient(fraction, true_density, slip) + inertia * slip
    }
    fn describe(&self) -> String {
        let k = self.darcy.conductivity().metres_per_second();
        format!("the law of Forchheimer with k = {k:e} m/s and c_F = {}", self.inertia)
    }
}
