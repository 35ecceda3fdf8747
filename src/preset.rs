//! The two sets of numerical choices: the paper's, and the library's.

use crate::kernel::Kernel;
use crate::material::Material;
use crate::mixture::{ArtificialViscosity, DensityDiffusion, GradientWeight, Mixture, Slip, Wall};
use crate::real::Real;
use crate::time::LeapFrog;
use core::fmt;

/// Numerical choices for water or soil alone. `docs/errata.md` says what goes wrong with the paper's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Preset {
    /// As printed: h = Δx, diffusion of the partial density, (70) every 20 steps, dynamic walls of
    /// three layers, Courant number 0.3; plastic flow by (36) and scaling back.
    Paper,
    /// h = 1.3 Δx, diffusion of what gravity does not explain, of water alone, no (70), extrapolated walls
    /// as thick as the support, Courant number 0.2; plastic flow by return mapping.
    #[default]
    Default,
}

impl Preset {
    /// Its name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Default => "default",
        }
    }

    /// h/Δx \[-\].
    pub fn smoothing_ratio(self) -> f64 {
        match self {
            Self::Paper => 1.0,
            Self::Default => 1.3,
        }
    }

    /// Courant number in (73) \[-\].
    pub fn courant(self) -> f64 {
        match self {
            Self::Paper => 0.3,
            Self::Default => 0.2,
        }
    }

    /// The leap-frog (71)–(72): as printed, or with the density of third order.
    pub fn leap_frog<T: Real>(self) -> LeapFrog<T> {
        match self {
            Self::Paper => LeapFrog::new(),
            Self::Default => LeapFrog::new().with_third_order_density(),
        }
    }

    /// Steps between reinitialisations (70); 0 means never.
    pub fn reinitialise_every(self) -> usize {
        match self {
            Self::Paper => 20,
            Self::Default => 0,
        }
    }

    /// Layers of wall particles for a kernel of support `reach` spacings \[-\].
    pub fn wall_layers(self, reach: f64) -> usize {
        match self {
            Self::Paper => 3,
            Self::Default => (reach - 1e-9).ceil() as usize,
        }
    }

    /// A fixed wall that holds soil.
    pub fn soil_wall<T: Real, const D: usize>(self) -> Wall<T, D> {
        match self {
            Self::Paper => Wall::dynamic(),
            Self::Default => Wall::extrapolated(Slip::NoSlip),
        }
    }

    /// A fixed wall that holds water.
    pub fn wall<T: Real, const D: usize>(self) -> Wall<T, D> {
        match self {
            Self::Paper => Wall::dynamic(),
            Self::Default => Wall::extrapolated(Slip::FreeSlip),
        }
    }

    /// η₁ and η₂ of (59) for soil: the same in both.
    pub fn soil_artificial_viscosity<T: Real>(self) -> ArtificialViscosity<T> {
        ArtificialViscosity { linear: T::of(0.1), quadratic: T::ONE }
    }

    /// δ of (53) for soil.
    pub fn soil_density_diffusion<T: Real>(self) -> T {
        match self {
            Self::Paper => T::of(0.1),
            Self::Default => T::ZERO,
        }
    }

    /// η₁ and η₂ of (59) for water: the same in both.
    pub fn artificial_viscosity<T: Real>(self) -> ArtificialViscosity<T> {
        ArtificialViscosity { linear: T::of(0.01), quadratic: T::ONE }
    }

    /// Density diffusion (52) of water, δ = 0.1.
    pub fn density_diffusion<T: Real>(self) -> DensityDiffusion<T> {
        match self {
            Self::Paper => DensityDiffusion::PartialDensity(T::of(0.1)),
            Self::Default => DensityDiffusion::Hydrostatic(T::of(0.1)),
        }
    }

    /// Weights in the velocity gradient (62).
    pub fn gradient_weight(self) -> GradientWeight {
        match self {
            Self::Paper => GradientWeight::Printed,
            Self::Default => GradientWeight::Conjugate,
        }
    }

    /// The mixture with these choices of artificial viscosity, diffusion and gradient weight.
    pub fn apply<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
        self,
        mixture: Mixture<T, D, K, S, F>,
    ) -> Mixture<T, D, K, S, F> {
        mixture
            .with_artificial_viscosity(self.artificial_viscosity())
            .and_then(|mixture| mixture.with_soil_artificial_viscosity(self.soil_artificial_viscosity()))
            .and_then(|mixture| mixture.with_density_diffusion(self.density_diffusion()))
            .and_then(|mixture| mixture.with_soil_density_diffusion(self.soil_density_diffusion()))
            .map(|mixture| mixture.with_gradient_weight(self.gradient_weight()))
            .expect("the constants above are in range")
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
