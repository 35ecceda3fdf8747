//! How soil and the water that seeps through it drag each other.

mod conductivity;
mod darcy;
mod ergun;
mod forchheimer;
mod kozeny_carman;

pub use conductivity::{Conductivity, Permeability, PoreFluid};
pub use darcy::Darcy;
pub use ergun::Ergun;
pub use forchheimer::Forchheimer;
pub use kozeny_carman::KozenyCarman;

use crate::error::ParameterError;
use crate::real::Real;
use core::fmt::Debug;
use std::sync::Arc;

/// A law of drag between soil and the water in it.
///
/// ```
/// use alluvium::material::{Conductivity, Darcy, DragLaw, Ergun};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let darcy = Darcy::new(Conductivity::new(1e-3)?);
/// // φ_f ρ_f g/k, whatever the slip.
/// let close = |x: f64, y: f64| (x / y - 1.0).abs() < 1e-12;
/// assert!(close(darcy.coefficient(0.5, 1000.0, 0.0), 0.5 * 500.0 * 9.81 / 1e-3));
/// // Grains of 1 mm resist harder the faster the water passes them.
/// let ergun = Ergun::new(1e-3, 1e-3)?;
/// assert!(ergun.coefficient(0.5, 1000.0, 1.0) > 2.0 * ergun.coefficient(0.5, 1000.0, 0.1));
/// # Ok(()) }
/// ```
pub trait DragLaw<T: Real>: Debug + Send + Sync {
    /// C_d \[kg/m³/s\]: force per volume of mixture and per velocity of the water against the soil, at the
    /// volume fraction φ_f \[-\] and the true density ρ̃_f \[kg/m³\] of the water and the slip
    /// |v_f − v_s| \[m/s\]. Not negative, and C_d times the slip must not fall where the slip grows.
    fn coefficient(&self, fraction: T, true_density: T, slip: T) -> T;

    /// Whether the coefficient depends on the slip. A law that says no is given none, which saves a sum over
    /// all pairs and, in implicit drag, an iteration.
    fn knows_slip(&self) -> bool {
        true
    }

    /// ∂(C_d s)/∂s \[kg/m³/s\]: how hard drag resists a change of the slip s, which bounds the step of explicit
    /// drag. By a central difference, exact for quadratic drag, unless a law has it in closed form.
    fn tangent(&self, fraction: T, true_density: T, slip: T) -> T {
        let apart = slip * T::of(1.0 / 32.0);
        let force = |slip: T| self.coefficient(fraction, true_density, slip) * slip;
        if self.knows_slip() && apart > T::ZERO {
            (force(slip + apart) - force(slip - apart)) / (apart + apart)
        } else {
            self.coefficient(fraction, true_density, slip)
        }
    }

    /// The law in a few words, with its parameters, for messages.
    fn describe(&self) -> String {
        format!("{self:?}")
    }
}

impl<T: Real> DragLaw<T> for Arc<dyn DragLaw<T>> {
    fn coefficient(&self, fraction: T, true_density: T, slip: T) -> T {
        (**self).coefficient(fraction, true_density, slip)
    }
    fn knows_slip(&self) -> bool {
        (**self).knows_slip()
    }
    fn tangent(&self, fraction: T, true_density: T, slip: T) -> T {
        (**self).tangent(fraction, true_density, slip)
    }
    fn describe(&self) -> String {
        (**self).describe()
    }
}

/// No drag at all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoDrag;

impl<T: Real> DragLaw<T> for NoDrag {
    #[inline(always)]
    fn coefficient(&self, _: T, _: T, _: T) -> T {
        T::ZERO
    }
    fn knows_slip(&self) -> bool {
        false
    }
    fn describe(&self) -> String {
        "no drag".to_owned()
    }
}

/// Grains leave at least this part of the space to the water, as far as laws of φ_f are concerned: where sums
/// over a few particles say less, or nothing, drag stays finite.
const LEAST_POROSITY: f64 = 0.05;

/// φ_f as far as packed grains go: from [`LEAST_POROSITY`] to 1.
fn porosity<T: Real>(fraction: T) -> T {
    fraction.max(T::of(LEAST_POROSITY)).min(T::ONE)
}

fn positive<T: Real>(name: &'static str, value: T, allowed: &'static str) -> Result<T, ParameterError> {
    if value > T::ZERO && value.is_finite() {
        Ok(value)
    } else {
        Err(ParameterError::new(name, value, allowed))
    }
}

/// A diameter of grains \[m\].
fn diameter<T: Real>(value: T) -> Result<T, ParameterError> {
    positive("grain_diameter", value, "a positive length [m]")
}

/// A dynamic viscosity \[Pa s\].
fn viscosity<T: Real>(value: T) -> Result<T, ParameterError> {
    positive("viscosity", value, "a positive viscosity [Pa s]")
}
