//! What is between the soil and the water of a case.

use super::{BuildError, SoilLaw};
use crate::case::choice::KernelChoice;
use crate::case::model::{Case, Mixing, Water};
use crate::error::ParameterError;
use crate::kernel::{CubicSpline, Kernel, QuinticSpline, WendlandC2, WendlandC4, WendlandC6};
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
        mixture = with_interphase_kernel(mixture, case)?;
        let scheme = case.drag_plan().map_or(DragScheme::Explicit, |plan| plan.scheme);
        with_scheme(mixture, scheme)
    }
}

/// With a kernel of its own between soil and water, where the case has one.
fn with_interphase_kernel<T: Real, const D: usize, K: Kernel<T, D>>(
    mixture: Mixture<T, D, K, SoilLaw<T>>,
    case: &Case,
) -> Result<Mixture<T, D, K, SoilLaw<T>>, ParameterError> {
    let (own, h) = (&case.particles, T::of(case.interphase_smoothing_length()));
    match own.interphase {
        Some(it) if it.kernel != own.kernel || it.smoothing_ratio != own.smoothing_ratio => match it.kernel {
            KernelChoice::WendlandC2 => mixture.with_interphase_kernel(WendlandC2::new(h)?),
            KernelChoice::WendlandC4 => mixture.with_interphase_kernel(WendlandC4::new(h)?),
            KernelChoice::WendlandC6 => mixture.with_interphase_kernel(WendlandC6::new(h)?),
            KernelChoice::CubicSpline => mixture.with_interphase_kernel(CubicSpline::new(h)?),
            KernelChoice::QuinticSpline => mixture.with_interphase_kernel(QuinticSpline::new(h)?),
        },
        _ => Ok(mixture),
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
