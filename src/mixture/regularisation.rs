//! Stress regularisation: a Shepard filter against stress that alternates from particle to particle, which
//! the stress sums of (55) do not feel.

use super::constituent::Constituent;
use super::extrapolation::StressExtrapolation;
use super::setting::Setting;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::Real;
use crate::space::{SymTensor, Tensor};

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Replaces the stress a law remembers by its Shepard mean over particles that are no wall's; returns
    /// the energy that took \[J\].
    pub(super) fn regularise_stress<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) -> f64 {
        if self.phase.is_empty() || !M::RIGID_GRAINS {
            return 0.0;
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
        let before = self.stored_energy();
        let own = setting.kernel.value(T::ZERO);
        for i in walls..self.phase.len() {
            let material = self.phase.material();
            let (now, half) = (self.phase.now.memory[i], self.phase.half.memory[i]);
            let (stress, half_stress) =
                (remembered_stress(material, &now), remembered_stress(material, &half));
            let own = own * self.phase.volume(i);
            let sum = SymTensor(core::array::from_fn(|k| self.scratch.extra.get(i, 1 + k))) + stress * own;
            let change = sum * (T::ONE / (self.scratch.extra.get(i, 0) + own)) - stress;
            let (now, half) = (
                material.with_stress(now, &(stress + change)),
                material.with_stress(half, &(half_stress + change)),
            );
            self.phase.now.memory[i] = now;
            self.phase.half.memory[i] = half;
        }
        before - self.stored_energy()
    }
}

fn remembered_stress<T: Real, M: Material<T>>(material: &M, memory: &M::Memory) -> SymTensor<T> {
    material.deviator(&Tensor::zero(), memory) - SymTensor::isotropic(material.pressure(T::ZERO, memory))
}
