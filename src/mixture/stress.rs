//! From the velocity gradient to stress: (62) → (14), (15).

use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::setting::Setting;
use super::velocity_gradient::VelocityGradient;
use crate::budget::Works;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::{SymTensor, Tensor, Vector};

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Velocity gradient (62) → deviatoric stress (14), (15) and rate of the memory.
    pub(super) fn find_stress<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        self.exchange_rate.taken = Works::default();
        self.exchange_rate.buoyancy = 0.0;
        if self.is_corrected {
            self.find_corrected_expansion(setting);
        }
        if !self.phase.material().needs_velocity_gradient() {
            return;
        }
        self.sum_velocity_gradient(setting, true);
        self.take_contact_shear(setting);
        if self.is_corrected {
            self.correct_gradient_sums();
        }
        self.apply_law();
        if self.has_extrapolated_walls() {
            if !M::RIGID_GRAINS {
                self.extrapolate_viscous_stress(setting);
            }
            self.book_wall_friction(setting);
        }
    }

    /// The sums of [`VelocityGradient`], with the velocities walls show viscosity, or those they have.
    pub(super) fn sum_velocity_gradient<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>, shown: bool) {
        let formula = VelocityGradient::<K, D> { kernel: setting.kernel.clone() };
        let weight = self.effective_weight();
        let (phase, wall_velocity) = (&self.phase, &self.scratch.wall_velocity);
        self.neighbourhood.pack::<VelocityGradient<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 4][..D + 1],
            &|i, record: &mut [T]| {
                let own = &phase.now.velocity[i];
                let v = if shown { wall_velocity.get(i).unwrap_or(own) } else { own };
                record[..D].copy_from_slice(&v.0);
                record[D] = weight.of(phase, i);
            },
        );
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.sums);
    }

    /// Deviatoric stress of a law that does not store it, rate of the memory, and what the law loses, all
    /// under the gradient just summed.
    fn apply_law(&mut self) {
        if self.strain_control > T::ZERO || self.hourglass_control.is_some() {
            let gradients = (0..self.phase.len()).map(|i| self.velocity_gradient(i)).collect();
            self.scratch.velocity_gradient = gradients;
        }
        let mut deviator = core::mem::take(&mut self.phase.deviator);
        let mut memory_rate = core::mem::take(&mut self.phase.rate.memory);
        let (this, phase) = (&*self, &self.phase);
        if !M::RIGID_GRAINS {
            deviator.resize(phase.len(), SymTensor::zero());
            parallel::for_each_part(&mut deviator, 1, CHUNK, &|first, part: &mut [SymTensor<T>]| {
                for (k, tau) in part.iter_mut().enumerate() {
                    let gradient = this.embedded_gradient(first + k);
                    *tau = phase.material().deviator(&gradient, &phase.now.memory[first + k]);
                }
            });
        }
        let law = |first: usize, part: &mut [M::Memory]| {
            let mut lost = Works::default();
            for (k, rate) in part.iter_mut().enumerate() {
                let i = first + k;
                if !phase.is_evolving(i) {
                    continue;
                }
                let (gradient, memory) = (this.embedded_gradient(i), &phase.now.memory[i]);
                *rate = phase.material().rate(&gradient, memory);
                let loss = phase.material().power_lost(&gradient.symmetric(), &deviator[i], memory);
                lost.book(&loss, phase.volume(i) * phase.volume_fraction(i));
            }
            lost
        };
        let lost = parallel::change_and_reduce(&mut memory_rate, Works::default(), law, |a, b| a + b);
        self.exchange_rate.taken = self.exchange_rate.taken + lost;
        self.phase.deviator = deviator;
        self.phase.rate.memory = memory_rate;
    }

    /// ∂v^α/∂x^β of particle `i`, row α, from the sums of [`VelocityGradient`] \[1/s\].
    pub(super) fn velocity_gradient(&self, i: usize) -> [Vector<T, D>; D] {
        let scale = self.effective_weight().scale(&self.phase, i);
        core::array::from_fn(|a| vector_sum(&self.scratch.sums, i, a * D) * scale)
    }

    fn embedded_gradient(&self, i: usize) -> Tensor<T> {
        Tensor::embed(&self.velocity_gradient(i).map(|row| row.0))
    }
}
