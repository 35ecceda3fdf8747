//! The water's volume fraction by its sum over the soil (68) at every evaluation, beside its rate (69).

use super::constituent::Constituent;
use super::{Mixture, WallKind};
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::Real;
use crate::time::Moment;

/// How the volume fraction of water that shares its space follows the soil.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum VolumeFraction {
    /// By its rate (69), which is exactly that of the sum: what the integration in time makes of it is its error,
    /// and stays.
    #[default]
    Rate,
    /// By its sum (68) at every evaluation, and the rate in between: φ never leaves what the soil leaves of the
    /// space. Costs a pass over pairs more.
    Sum,
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// How the water's volume fraction follows the soil; by its rate by default.
    pub fn with_volume_fraction(mut self, form: VolumeFraction) -> Self {
        self.fraction = form;
        self
    }

    /// Puts the volume fractions to their sums (68), and books the energy.
    pub(super) fn sum_fractions(&mut self) {
        self.coupling.look(&self.setting, &mut self.soil, &self.water);
        let lost = self.water.put_fractions(&self.coupling.pores.fraction);
        for exchanged in &mut self.exchanged {
            exchanged.taken[Account::VolumeFraction] += lost;
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Gives every particle, but those that come in, this volume fraction at unchanged partial density; returns the
    /// energy \[J\] that takes.
    fn put_fractions(&mut self, fractions: &[T]) -> f64 {
        let before = self.stored_energy();
        let phase = &mut self.phase;
        for (i, &fraction) in fractions.iter().enumerate() {
            if i < phase.wall_particles && phase.wall_kind(i) == WallKind::Given {
                continue;
            }
            let change = fraction - phase.volume_fraction[i];
            phase.volume_fraction[i] = fraction;
            for moment in [Moment::Now, Moment::Half] {
                phase.fields_mut(moment).excess[i] -= change;
            }
            if let Some(evolving) = &mut phase.evolving_fraction {
                evolving.half[i] += change;
            }
        }
        before - self.stored_energy()
    }
}
