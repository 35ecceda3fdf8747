//! How soil and the water that seeps through it drag each other.

use crate::error::ParameterError;
use crate::real::Real;
use core::fmt::Debug;

/// Hydraulic conductivity k \[m/s\]: how fast a fluid of its own weight seeps through the soil.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conductivity<T>(T);

impl<T: Real> Conductivity<T> {
    /// From metres per second.
    ///
    /// # Errors
    /// It is not positive and finite.
    pub fn new(metres_per_second: T) -> Result<Self, ParameterError> {
        if metres_per_second > T::ZERO && metres_per_second.is_finite() {
            Ok(Self(metres_per_second))
        } else {
            Err(ParameterError::new("conductivity", metres_per_second, "a positive speed [m/s]"))
        }
    }
    /// In metres per second.
    pub fn metres_per_second(self) -> T {
        self.0
    }
}

/// A law of drag between soil and the water in it.
pub trait DragLaw<T: Real>: Debug + Send + Sync {
    /// C_d \[kg/m³/s\]: force per volume of mixture and per velocity of the water against the soil, at the
    /// volume fraction φ_f \[-\] and the true density ρ̃_f \[kg/m³\] of the water.
    fn coefficient(&self, fraction: T, true_density: T) -> T;
}

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
        Self { conductivity, gravity: T::of(9.81) }
    }

    /// Its conductivity.
    pub fn conductivity(&self) -> Conductivity<T> {
        self.conductivity
    }
}

impl<T: Real> DragLaw<T> for Darcy<T> {
    #[inline(always)]
    fn coefficient(&self, fraction: T, true_density: T) -> T {
        fraction * fraction * true_density * self.gravity / self.conductivity.0 // (37)
    }
}

/// No drag at all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoDrag;

impl<T: Real> DragLaw<T> for NoDrag {
    #[inline(always)]
    fn coefficient(&self, _: T, _: T) -> T {
        T::ZERO
    }
}
