//! Darcy's law with a conductivity that follows the porosity.

use super::darcy::GRAVITY;
use super::{Conductivity, DragLaw, diameter, porosity, viscosity};
use crate::error::ParameterError;
use crate::real::Real;

/// Darcy's law (37) with the conductivity of Kozeny (1927) and Carman (1937), which follows the porosity:
///
/// $$\kappa(\phi_f) = \frac{d^2}{180}\,\frac{\phi_f^3}{(1-\phi_f)^2},\qquad
/// C_d = \frac{\phi_f^2\mu}{\kappa} = \frac{180\,\mu\,(1-\phi_f)^2}{d^2\,\phi_f}$$
///
/// for grains of diameter d, or with a conductivity k₀ measured at the porosity φ₀,
/// k(φ_f) = k₀ f(φ_f)/f(φ₀), f(φ) = φ³/(1 − φ)². For packed beds: beyond φ_f ≈ 0.8 it drags too little. Below
/// φ_f = 0.05 it stays what it is there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct KozenyCarman<T> {
    scale: Scale<T>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Scale<T> {
    /// Diameter \[m\] and viscosity \[Pa s\].
    Grains { diameter: T, viscosity: T },
    /// k₀ \[m/s\] at φ₀.
    Measured { conductivity: Conductivity<T>, porosity: T },
}

/// 150 in Ergun's law, which was fitted to more beds.
const CARMAN: f64 = 180.0;

impl<T: Real> KozenyCarman<T> {
    /// Of grains of this diameter d \[m\] in a fluid of dynamic viscosity μ \[Pa s\].
    ///
    /// # Errors
    /// One of them is not positive and finite.
    pub fn of_grains(grain_diameter: T, dynamic_viscosity: T) -> Result<Self, ParameterError> {
        let scale =
            Scale::Grains { diameter: diameter(grain_diameter)?, viscosity: viscosity(dynamic_viscosity)? };
        Ok(Self { scale })
    }

    /// Of a conductivity measured at this porosity φ₀ \[-\], under 9.81 m/s².
    ///
    /// # Errors
    /// The porosity is not from 0.05 to 0.95.
    pub fn measured(conductivity: Conductivity<T>, porosity: T) -> Result<Self, ParameterError> {
        if !(porosity >= T::of(super::LEAST_POROSITY) && porosity <= T::of(0.95)) {
            return Err(ParameterError::new("reference_porosity", porosity, "from 0.05 to 0.95"));
        }
        Ok(Self { scale: Scale::Measured { conductivity, porosity } })
    }
}

impl<T: Real> DragLaw<T> for KozenyCarman<T> {
    #[inline(always)]
    fn coefficient(&self, fraction: T, true_density: T, _: T) -> T {
        // (1 − φ)²/φ: φ² (37) over φ³/(1 − φ)².
        let resistance = |porosity: T| {
            let grains = T::ONE - porosity;
            grains * grains / porosity
        };
        let resistance_here = resistance(porosity(fraction));
        match self.scale {
            Scale::Grains { diameter, viscosity } => {
                T::of(CARMAN) * viscosity * resistance_here / (diameter * diameter)
            }
            Scale::Measured { conductivity, porosity } => {
                let there = porosity * porosity * true_density * T::of(GRAVITY);
                there / conductivity.metres_per_second() * (resistance_here / resistance(porosity))
            }
        }
    }
    fn knows_slip(&self) -> bool {
        false
    }
    fn describe(&self) -> String {
        match self.scale {
            Scale::Grains { diameter, .. } => {
                format!("the law of Kozeny and Carman with grains of d = {diameter:e} m")
            }
            Scale::Measured { conductivity, porosity } => format!(
                "the law of Kozeny and Carman with k = {:e} m/s at a porosity of {porosity}",
                conductivity.metres_per_second()
            ),
        }
    }
}
