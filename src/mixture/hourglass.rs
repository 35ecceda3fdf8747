//! Forces against motion of soil that its velocity gradient does not see: hourglass modes.
//!
//! A velocity that alternates from particle to particle has no gradient (65), so stress does not resist it, and near
//! a surface it sees only part of the strain. Of the motion that the mean gradient of a pair does not explain,
//!
//! $$\hat{\mathbf v}_{ij} = \mathbf v_{ij} - \tfrac12(\nabla\mathbf v_i + \nabla\mathbf v_j)\,\mathbf x_{ij},$$
//!
//! the control makes an elastic force, which grows with its rate, and a viscous one,
//!
//! $$\Big(\frac{D\mathbf v_i}{Dt}\Big)_h =
//! \mathbf a_i + \frac{2\eta\,\tilde\rho_0 c\,h}{\rho_i}\sum_j V_j\,\hat{\mathbf v}_{ij}F_{ij},\qquad
//! \frac{D\mathbf a_i}{Dt} = \frac{\xi\,G}{\rho_i}\sum_j V_j\,\hat{\mathbf v}_{ij}F_{ij}$$
//!
//! (Zhang, Wu, Lourenço & Hu 2025, who have no viscous part). Pairs stay equal and opposite. Where gradients are exact
//! for linear fields, both vanish for every linear velocity, turning as a whole included; angular momentum is not
//! exact otherwise.

use super::Phase;
use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::setting::Setting;
use crate::budget::Account;
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::Real;
use crate::space::Vector;
use crate::time::Moment;

/// Strength of the forces against motion of soil that the velocity gradient does not see.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HourglassControl<T> {
    /// ξ \[-\]: stiffness over the shear modulus G; usually 4.
    pub stiffness: T,
    /// η \[-\]: viscosity over ρ̃₀ c h, with the speed c of compression waves; usually 0.1. Without it the elastic
    /// force alone may grow.
    pub viscosity: T,
}

impl<T: Real> HourglassControl<T> {
    /// Itself, if it is usable.
    pub(super) fn checked(self) -> Result<Self, ParameterError> {
        if !(self.stiffness >= T::ZERO && self.stiffness <= T::of(10.0)) {
            return Err(ParameterError::new("hourglass_control.stiffness", self.stiffness, "from 0 to 10"));
        }
        if !(self.viscosity >= T::ZERO && self.viscosity <= T::ONE) {
            return Err(ParameterError::new("hourglass_control.viscosity", self.viscosity, "from 0 to 1"));
        }
        Ok(self)
    }
}

/// The elastic part: an acceleration of each particle \[m/s²\] and its rate \[m/s³\]; empty without control.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ElasticHold<T: Real, const D: usize> {
    pub(crate) now: Vec<Vector<T, D>>,
    pub(crate) half: Vec<Vector<T, D>>,
    pub(crate) rate: Vec<Vector<T, D>>,
}

impl<T: Real, const D: usize> ElasticHold<T, D> {
    /// Its arrays.
    pub(crate) fn arrays(&mut self) -> [&mut Vec<Vector<T, D>>; 3] {
        [&mut self.now, &mut self.half, &mut self.rate]
    }

    /// Particles in each array; `count` if there is nothing in any.
    pub(crate) fn lengths(&self, count: usize) -> [usize; 3] {
        let lengths = [self.now.len(), self.half.len(), self.rate.len()];
        if lengths == [0; 3] { [count; 3] } else { lengths }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Phase<T, D, M> {
    /// `a_target ← a_base + dt · Da/Dt` of the elastic hold.
    pub(super) fn advance_hold(&mut self, target: Moment, base: Moment, dt: T) {
        let ElasticHold { now, half, rate } = &mut self.hold;
        for ((now, half), &rate) in now.iter_mut().zip(half).zip(&*rate) {
            let start = if base == Moment::Now { *now } else { *half };
            let end = start + rate * dt;
            match target {
                Moment::Now => *now = end,
                Moment::Half => *half = end,
            }
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// A place for the elastic hold of every particle; who is new is not held yet.
    pub(super) fn prepare_hold(&mut self) {
        if self.hourglass_control.is_some() {
            let count = self.phase.len();
            for array in self.phase.hold.arrays() {
                array.resize(count, Vector::zero());
            }
        }
    }

    /// Adds the control to the accelerations and books what it takes.
    pub(super) fn add_hourglass_control<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let Some(control) = self.hourglass_control else { return };
        self.sum_unseen_motion(setting);
        let material = self.phase.material();
        let stiffness = control.stiffness * material.shear_modulus();
        let viscosity = T::of(2.0)
            * control.viscosity
            * material.reference_density()
            * material.fastest_wave()
            * setting.kernel.smoothing_length();
        let mut taken = 0.0;
        for i in 0..self.phase.len() {
            // Soil glides along without being held.
            if self.phase.is_gliding(i) {
                continue;
            }
            let sum: Vector<T, D> = vector_sum(&self.scratch.extra, i, 0) * (T::ONE / self.phase.density(i));
            self.phase.hold.rate[i] = sum * stiffness;
            let push = self.phase.hold.now[i] + sum * viscosity;
            self.phase.rate.acceleration[i] += push;
            taken -= (self.phase.mass[i] * push.dot(self.phase.now.velocity[i])).as_f64();
        }
        self.exchange_rate.taken[Account::HourglassControl] += taken;
    }
}
