//! What is between the soil and the water of a case.

use super::{BuildError, SoilLaw};
use crate::case::model::{Case, Mixing, Water};
use crate::kernel::Kernel;
use crate::mixture::{DragScheme, Mixture};
use crate::real::Real;

impl Mixing {
    /// The mixture with this coupling.
    pub(super) fn apply<T: Real, const D: usize, K: Kernel<T, D>>(
        &self,
        mut mixture: Mixture<T, D, K, SoilLaw<T>>,
        case: &Case,
        water: &Water,
    ) -> Result<Mixture<T, D, K, SoilLaw<T>>, BuildError> {
        mixture = mixture
            .with_coupling(self.coupling)
            .with_volume_fraction(self.fraction)
            .with_drag(self.drag.law::<T>(water)?);
        if self.relaxation_time > 0.0 {
            mixture = mixture.with_density_relaxation(T::of(self.relaxation_time))?;
        }
        if self.normalised_drag {
            mixture = mixture.with_normalised_drag();
        }
        if self.projected_drag {
            mixture = mixture.with_projected_drag();
        }
        if self.reconstructed_drag {
            mixture = mixture.with_reconstructed_drag();
        }
        let scheme = case.drag_plan().map_or(DragScheme::Explicit, |plan| plan.scheme);
        with_scheme(mixture, scheme)
    }
}

#[cfg(feature = "implicit")]
fn with_scheme<T: Real, const D: usize, K: Kernel<T, D>>(
    mixture: Mixture<T, D, K, SoilLaw<T>>,
    scheme: DragScheme,
) -> Result<Mixture<T, D, K, SoilLaw<T>>, BuildError> {
    Ok(mixture.with_drag_scheme(scheme))
}

#[cfg(not(feature = "implicit"))]
fn with_scheme<T: Real, const D: usize, K: Kernel<T, D>>(
    mixture: Mixture<T, D, K, SoilLaw<T>>,
    scheme: DragScheme,
) -> Result<Mixture<T, D, K, SoilLaw<T>>, BuildError> {
    if scheme == DragScheme::Explicit { Ok(mixture) } else { Err(BuildError::DragScheme(scheme)) }
}
