//! How soil and water drag each other in a case.

use super::Water;
use crate::error::ParameterError;
use crate::material::{
    Conductivity, Darcy, DragLaw, Ergun, Forchheimer, KozenyCarman, NoDrag, Permeability, PoreFluid,
};
use crate::real::Real;
use std::sync::Arc;

/// How soil and water drag each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drag {
    /// Not at all.
    None,
    /// By Darcy's law (37).
    Darcy(Seepage),
    /// With a conductivity that follows the porosity, of grains of this diameter \[m\].
    GrainsOfCarman(f64),
    /// With a conductivity that follows the porosity.
    KozenyCarman {
        /// As measured.
        seepage: Seepage,
        /// Porosity where it was \[–\].
        porosity: f64,
    },
    /// As Ergun's bed of grains of this diameter \[m\].
    Ergun(f64),
    /// By Darcy's law with inertia.
    Forchheimer {
        /// Where the flow is slow.
        seepage: Seepage,
        /// c_F \[–\].
        coefficient: f64,
    },
}

/// How easily water seeps, in the quantity that is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seepage {
    /// Hydraulic conductivity k \[m/s\].
    Conductivity(f64),
    /// Intrinsic permeability κ \[m²\].
    Permeability(f64),
}

impl Seepage {
    fn conductivity<T: Real>(self, water: &Water) -> Result<Conductivity<T>, ParameterError> {
        match self {
            Self::Conductivity(k) => Conductivity::new(T::of(k)),
            Self::Permeability(kappa) => Permeability::new(T::of(kappa))?.conductivity(&water.pore_fluid()?),
        }
    }
}

impl Drag {
    /// The law.
    ///
    /// # Errors
    /// A value is out of range, or too small or large for the precision.
    pub fn law<T: Real>(&self, water: &Water) -> Result<Arc<dyn DragLaw<T>>, ParameterError> {
        let viscosity = T::of(water.viscosity);
        Ok(match *self {
            Self::None => Arc::new(NoDrag),
            Self::Darcy(seepage) => Arc::new(Darcy::new(seepage.conductivity(water)?)),
            Self::GrainsOfCarman(diameter) => Arc::new(KozenyCarman::of_grains(T::of(diameter), viscosity)?),
            Self::KozenyCarman { seepage, porosity } => {
                Arc::new(KozenyCarman::measured(seepage.conductivity(water)?, T::of(porosity))?)
            }
            Self::Ergun(diameter) => Arc::new(Ergun::new(T::of(diameter), viscosity)?),
            Self::Forchheimer { seepage, coefficient } => {
                let conductivity = seepage.conductivity(water)?;
                Arc::new(Forchheimer::new(conductivity, &water.pore_fluid()?, T::of(coefficient))?)
            }
        })
    }

    /// Whether the law needs the viscosity of the water.
    pub fn needs_viscosity(&self) -> bool {
        match self {
            Self::None => false,
            Self::Darcy(seepage) | Self::KozenyCarman { seepage, .. } => {
                matches!(seepage, Seepage::Permeability(_))
            }
            Self::GrainsOfCarman(_) | Self::Ergun(_) | Self::Forchheimer { .. } => true,
        }
    }
}

impl Water {
    /// What of it makes conductivity out of permeability, under 9.81 m/s².
    fn pore_fluid<T: Real>(&self) -> Result<PoreFluid<T>, ParameterError> {
        PoreFluid::new(T::of(self.reference_density), T::of(9.81), T::of(self.viscosity))
    }
}
