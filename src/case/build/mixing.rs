//! What is between the soil and the water of a case.

use super::SoilLaw;
use crate::case::model::{Drag, Mixing};
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::{Conductivity, Darcy};
use crate::mixture::Mixture;
use crate::real::Real;

impl Mixing {
    /// The mixture with this coupling.
    pub(super) fn apply<T: Real, const D: usize, K: Kernel<T, D>>(
        &self,
        mut mixture: Mixture<T, D, K, SoilLaw<T>>,
    ) -> Result<Mixture<T, D, K, SoilLaw<T>>, ParameterError> {
        mixture = mixture.with_coupling(self.coupling);
        if self.relaxation_time > 0.0 {
            mixture = mixture.with_density_relaxation(T::of(self.relaxation_time))?;
        }
        Ok(match self.drag {
            Drag::None => mixture,
            Drag::Darcy { conductivity } => {
                mixture.with_drag(Darcy::new(Conductivity::new(T::of(conductivity))?))
            }
        })
    }
}
