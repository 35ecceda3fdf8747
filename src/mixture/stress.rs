//! From the velocity gradient to stress: (62) → (14), (15).

use super::evaluation::vector_sum;
use super::velocity_gradient::VelocityGradient;
use super::{GradientWeight, Mixture};
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::{SymTensor, Tensor, Vector};

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    /// Velocity gradient (62) → deviatoric stress (14), (15) and rate of the memory.
    pub(super) fn find_stress(&mut self) {
        self.exchange_rate.taken[Account::Viscosity] = 0.0;
        if !self.water.material().needs_velocity_gradient() {
            return;
        }
        let formula = VelocityGradient::<K, D> { kernel: self.kernel.clone() };
        let weight = self.gradient_weight;
        let (water, wall_velocity) = (&self.water, &self.scratch.wall_velocity);
        self.neighbourhood.pack::<VelocityGradient<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[T::ZERO; 4][..D + 1],
            &|i, record: &mut [T]| {
                let v = wall_velocity.get(i).unwrap_or(&water.now.velocity[i]);
                record[..D].copy_from_slice(&v.0);
                record[D] = match weight {
                    GradientWeight::Conjugate => water.mass[i],
                    GradientWeight::Printed => water.volume(i),
                };
            },
        );
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.sums);
        self.apply_law();
        if self.has_extrapolated_walls() {
            self.extrapolate_stress();
            self.book_wall_friction();
        }
    }

    /// Deviatoric stress and rate of the memory under the gradient just summed, and the work of the
    /// stress.
    fn apply_law(&mut self) {
        let mut deviator = core::mem::take(&mut self.water.deviator);
        let mut memory_rate = core::mem::take(&mut self.water.rate.memory);
        deviator.resize(self.water.len(), SymTensor::zero());
        if self.strain_control > T::ZERO {
            let gradients = (0..self.water.len()).map(|i| self.velocity_gradient(i)).collect();
            self.scratch.velocity_gradient = gradients;
        }
        let (this, water) = (&*self, &self.water);
        parallel::for_each_part(&mut deviator, 1, CHUNK, &|first, part: &mut [SymTensor<T>]| {
            for (k, tau) in part.iter_mut().enumerate() {
                let gradient = this.embedded_gradient(first + k);
                *tau = water.material().deviator(&gradient, &water.now.memory[first + k]);
            }
        });
        if size_of::<F::Memory>() > 0 {
            parallel::for_each_part(&mut memory_rate, 1, CHUNK, &|first, part: &mut [F::Memory]| {
                for (k, rate) in part.iter_mut().enumerate() {
                    let gradient = this.embedded_gradient(first + k);
                    *rate = water.material().rate(&gradient, &water.now.memory[first + k]);
                }
            });
        }
        let loss = this.stress_power(&deviator);
        self.exchange_rate.taken[Account::Viscosity] = loss;
        self.water.deviator = deviator;
        self.water.rate.memory = memory_rate;
    }

    /// ∂v^α/∂x^β of particle `i`, row α, from the sums of [`VelocityGradient`] \[1/s\].
    fn velocity_gradient(&self, i: usize) -> [Vector<T, D>; D] {
        let scale = match self.gradient_weight {
            GradientWeight::Conjugate => T::ONE / self.water.density(i),
            GradientWeight::Printed => T::ONE,
        };
        core::array::from_fn(|a| vector_sum(&self.scratch.sums, i, a * D) * scale)
    }

    fn embedded_gradient(&self, i: usize) -> Tensor<T> {
        Tensor::embed(&self.velocity_gradient(i).map(|row| row.0))
    }

    /// Work of τ per time, `Σ V φ τ:∇v`, of every particle that has its own stress \[W\].
    fn stress_power(&self, deviator: &[SymTensor<T>]) -> f64 {
        let water = &self.water;
        let power = |i: usize| {
            let stretch = self.embedded_gradient(i).symmetric();
            (water.volume(i) * water.volume_fraction[i] * deviator[i].double_dot(&stretch)).as_f64()
        };
        parallel::reduce(
            water.len(),
            0.0,
            |range| range.filter(|&i| water.is_evolving(i)).map(power).sum(),
            |a, b| a + b,
        )
    }
}
