//! Drag of packed grains, quadratic where the flow is fast.

use super::{DragLaw, diameter, porosity, viscosity};
use crate::error::ParameterError;
use crate::real::Real;

/// The law of Ergun (1952) for a bed of grains of diameter d, with the slip s = |v_f − v_s|:
///
/// $$C_d = 150\,\frac{\mu\,(1-\phi_f)^2}{\phi_f\,d^2} + 1.75\,\frac{\tilde\rho_f\,(1-\phi_f)}{d}\,s$$
///
/// Per volume of mixture C_d s is φ_f times the pressure gradient he gives for the seepage velocity φ_f s. For
/// packed beds, up to φ_f ≈ 0.8. Below φ_f = 0.05 it stays what it is there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ergun<T> {
    diameter: T,
    viscosity: T,
}

impl<T: Real> Ergun<T> {
    /// Of grains of this diameter d \[m\] in a fluid of dynamic viscosity μ \[Pa s\].
    ///
    /// # Errors
    /// One of them is not positive and finite.
    pub fn new(grain_diameter: T, dynamic_viscosity: T) -> Result<Self, ParameterError> {
        Ok(Self { diameter: diameter(grain_diameter)?, viscosity: viscosity(dynamic_viscosity)? })
    }
}

impl<T: Real> DragLaw<T> for Ergun<T> {
    #[inline(always)]
    fn coefficient(&self, fraction: T, true_density: T, slip: T) -> T {
        let porosity = porosity(fraction);
        let grains = (T::ONE - porosity) / self.diameter;
        let viscous = T::of(150.0) * self.viscosity * grains * grains / porosity;
        viscous + T::of(1.75) * true_density * grains * slip
    }
    fn describe(&self) -> String {
        format!("the law of Ergun with grains of d = {:e} m", self.diameter)
    }
}
