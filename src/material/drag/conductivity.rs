//! How easily water seeps: hydraulic conductivity, which has the fluid in it, and intrinsic permeability, which is
//! the soil's alone. One becomes the other only through a fluid.

use super::{positive, viscosity};
use crate::error::ParameterError;
use crate::real::Real;

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
        positive("conductivity", metres_per_second, "a positive speed [m/s]").map(Self)
    }
    /// In metres per second.
    pub fn metres_per_second(self) -> T {
        self.0
    }
    /// The permeability κ = k μ/(ρ̃ g) of the soil that conducts this fluid so.
    ///
    /// # Errors
    /// It is too small for the precision.
    pub fn permeability(self, fluid: &PoreFluid<T>) -> Result<Permeability<T>, ParameterError> {
        Permeability::new(self.0 / fluid.mobility())
    }
}

/// Intrinsic permeability κ \[m²\] of a soil: the same for every fluid.
///
/// It is no conductivity, and does not pass for one:
/// ```compile_fail
/// use alluvium::material::{Darcy, Permeability};
/// let law = Darcy::new(Permeability::new(1e-10).unwrap());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Permeability<T>(T);

impl<T: Real> Permeability<T> {
    /// From square metres.
    ///
    /// # Errors
    /// It is not positive and finite.
    pub fn new(square_metres: T) -> Result<Self, ParameterError> {
        positive("permeability", square_metres, "a positive area [m²]").map(Self)
    }
    /// In square metres.
    pub fn square_metres(self) -> T {
        self.0
    }
    /// The conductivity k = κ ρ̃ g/μ for this fluid.
    ///
    /// # Errors
    /// It is too large for the precision.
    pub fn conductivity(self, fluid: &PoreFluid<T>) -> Result<Conductivity<T>, ParameterError> {
        Conductivity::new(self.0 * fluid.mobility())
    }
}

/// What of a fluid makes conductivity out of permeability.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PoreFluid<T> {
    density: T,
    gravity: T,
    viscosity: T,
}

impl<T: Real> PoreFluid<T> {
    /// Of true density ρ̃ \[kg/m³\] and dynamic viscosity μ \[Pa s\], under the gravity g \[m/s²\] the conductivity
    /// is measured under.
    ///
    /// # Errors
    /// One of them is not positive and finite.
    pub fn new(density: T, gravity: T, dynamic_viscosity: T) -> Result<Self, ParameterError> {
        Ok(Self {
            density: positive("density", density, "a positive density [kg/m³]")?,
            gravity: positive("gravity", gravity, "a positive acceleration [m/s²]")?,
            viscosity: viscosity(dynamic_viscosity)?,
        })
    }

    /// ρ̃ g/μ \[1/m/s\].
    fn mobility(&self) -> T {
        self.density * self.gravity / self.viscosity
    }
}
