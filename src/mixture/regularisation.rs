//! Stress regularisation: a Shepard filter against stress that alternates from particle to particle, which
//! the stress sums of (55) do not feel.

use super::constituent::Constituent;
use super::extrapolation::StressExtrapolation;
use super::setting::Setting;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::Real;
use crate::space::{SymTensor, Tensor};
use crate::time::Moment;

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Replaces the stress a law remembers by its Shepard mean over particles that are no wall's, and shifts it
    /// at half the step by as much, as far as the law bears it; returns the energy that took at both moments \[J\].
    pub(super) fn regularise_stress<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) -> [f64; 2] {
        let mut taken = [0.0; 2];
        if self.phase.is_empty() || !M::RIGID_GRAINS {
            return taken;
        }
        self.find_neighbours();
        let formula = StressExtrapolation::<K, D> { kernel: setting.kernel.clone() };
        let phase = &self.phase;
        let walls = phase.wall_particles();
        self.neighbourhood.pack::<StressExtrapolation<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 7],
            &|i, record: &mut [T]| {
                record[0] = if i < walls { T::ZERO } else { phase.volume(i) };
                record[1..7].copy_from_slice(&remembered_stress(phase.material(), &phase.now.memory[i]).0);
            },
        );
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let own = setting.kernel.value(T::ZERO);
        for i in walls..self.phase.len() {
            let stress = remembered_stress(self.phase.material(), &self.phase.now.memory[i]);
            let own = own * self.phase.volume(i);
            let sum = SymTensor(core::array::from_fn(|k| self.scratch.extra.get(i, 1 + k))) + stress * own;
            let change = sum * (T::ONE / (self.scratch.extra.get(i, 0) + own)) - stress;
            for moment in [Moment::Now, Moment::Half] {
                taken[moment as usize] += self.shift_stress(i, moment, &change);
            }
        }
        taken
    }

    /// Shifts a remembered stress \[Pa\], as far as the law bears it; returns the energy that took \[J\]. Nothing is
    /// deformed by it: of what the law admits, the stress alone is taken.
    fn shift_stress(&mut self, i: usize, moment: Moment, change: &SymTensor<T>) -> f64 {
        let before = self.stored_by(i, moment);
        let material = self.phase.material();
        let memory = self.phase.fields(moment).memory[i];
        let shifted = material.with_stress(memory, &(remembered_stress(material, &memory) + *change));
        let admitted = material.admit(shifted).0;
        let is_borne = admitted == shifted;
        let after = if is_borne {
            shifted
        } else {
            material.with_stress(memory, &remembered_stress(material, &admitted))
        };
        self.phase.fields_mut(moment).memory[i] = after;
        before - self.stored_by(i, moment)
    }
}

fn remembered_stress<T: Real, M: Material<T>>(material: &M, memory: &M::Memory) -> SymTensor<T> {
    material.deviator(&Tensor::zero(), memory) - SymTensor::isotropic(material.pressure(T::ZERO, memory))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::budget::Account;
    use crate::kernel::WendlandC2;
    use crate::material::{
        Absent, Cone, DruckerPrager, Elasticity, MohrCoulomb, Soil, SoilMemory, YieldSurface,
    };
    use crate::mixture::{Mixture, Phase};
    use crate::setup;

    type Sand<Y> = Mixture<f64, 2, WendlandC2<f64, 2>, Soil<f64, Y>, Absent>;

    /// A block whose stress is on its yield surface everywhere, in directions without order, other ones at half the
    /// step.
    fn block<Y: YieldSurface<f64>>(surface: Y) -> Sand<Y> {
        let law = Soil::new(2650.0, Elasticity::from_bulk(0.7e6, 0.3).unwrap(), surface).unwrap();
        let mut soil = Phase::new(law);
        soil.add(&setup::fill([0.0, 0.0], [0.1, 0.1], 0.01), 1e-4, |_| 0.0).unwrap();
        for i in 0..soil.len() {
            let yielding = |salt: f64| {
                let at = |k: usize| 3e3 * (salt * (7 * i + k) as f64).sin();
                let stress = SymTensor(core::array::from_fn(at)) - SymTensor::isotropic(1e3);
                soil.material().admit(SoilMemory::stressed(stress)).0
            };
            (soil.now.memory[i], soil.half.memory[i]) = (yielding(1.3), yielding(2.1));
        }
        Mixture::of_soil(WendlandC2::new(0.013).unwrap(), soil)
    }

    fn energy<Y: YieldSurface<f64>>(mixture: &Sand<Y>, moment: Moment) -> f64 {
        (0..mixture.soil.phase.len()).map(|i| mixture.soil.stored_by(i, moment)).sum()
    }

    fn stays_admissible<Y: YieldSurface<f64>>(surface: &Y) {
        let mut mixture = block(surface.clone());
        // Sorted now, so that a particle keeps its place in what follows.
        mixture.soil.find_neighbours();
        let stress = |mixture: &Sand<Y>, moment: Moment| -> Vec<SymTensor<f64>> {
            mixture.soil.phase.fields(moment).memory.iter().map(|memory| memory.stress).collect()
        };
        let moments = [Moment::Now, Moment::Half];
        let [now, half] = moments.map(|moment| stress(&mixture, moment));
        let before = moments.map(|moment| energy(&mixture, moment));
        let strain = |mixture: &Sand<Y>| -> Vec<SymTensor<f64>> {
            mixture.soil.phase.half.memory.iter().map(|memory| memory.plastic_strain).collect()
        };
        let strained = strain(&mixture);
        mixture.regularise_stress();
        let [now_after, half_after] = moments.map(|moment| stress(&mixture, moment));
        let is_outside = |stress: &SymTensor<f64>| {
            surface.excess(stress) > 1e-12 * (stress.root_j2() + stress.trace().abs())
        };
        assert!(!now_after.iter().chain(&half_after).any(is_outside), "{surface:?}");
        // The shift alone would have left the surface.
        let shifted = (0..half.len()).map(|i| half[i] + now_after[i] - now[i]);
        assert!(shifted.filter(is_outside).count() > 10, "{surface:?}: nothing to catch");
        assert!(strain(&mixture) == strained, "smoothing is no deformation");
        for (moment, before) in moments.into_iter().zip(before) {
            let taken = mixture.exchanged[moment as usize].taken[Account::Regularisation];
            let freed = before - energy(&mixture, moment);
            assert!((taken - freed).abs() < 1e-12 * before, "{moment:?}: {taken} of {freed}");
            assert!(freed.abs() > 1e-3 * before, "{moment:?}: nothing to book");
        }
    }

    #[test]
    fn smoothed_stress_is_admitted_at_both_moments_and_booked() {
        stays_admissible(&DruckerPrager::new(Cone::PlaneStrain, 0.35, 0.0).unwrap());
        stays_admissible(&MohrCoulomb::new(0.35, 0.1).unwrap());
    }
}
