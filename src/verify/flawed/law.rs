//! A law with a mistake.

use crate::material::{Loss, Material, Memory};
use crate::real::Real;
use crate::space::{SymTensor, Tensor};

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::verify) enum Mistake {
    /// The spin has the wrong sign, as in (66) as printed.
    Spin,
    /// The compression is off by 0.1 %.
    Compression,
    /// The hydrostatic slope is off by 5 %.
    Slope,
    /// The stored energy is off by 0.1 %.
    Energy,
    /// A memory is admitted half of the way.
    Halfway,
    /// Losses have the other sign.
    Loss,
    /// The memory changes the more per strain the faster it is strained.
    Viscous,
}

/// A law with a mistake, or without.
#[derive(Clone, Debug)]
pub(in crate::verify) struct MistakenLaw<M> {
    pub law: M,
    pub mistake: Option<Mistake>,
}

impl<M> MistakenLaw<M> {
    fn is(&self, mistake: Mistake) -> bool {
        self.mistake == Some(mistake)
    }
    fn seen<T: Real>(&self, gradient: &Tensor<T>) -> Tensor<T> {
        let g = gradient.0;
        match self.is(Mistake::Spin) {
            true => Tensor(core::array::from_fn(|a| core::array::from_fn(|b| g[b][a]))),
            false => *gradient,
        }
    }
    fn booked<T: Real>(&self, loss: Loss<T>) -> Loss<T> {
        if !self.is(Mistake::Loss) {
            return loss;
        }
        let Loss { viscous, plastic, scale_back, cut_off } = loss;
        Loss { viscous: -viscous, plastic: -plastic, scale_back: -scale_back, cut_off: -cut_off }
    }
    fn factor<T: Real>(&self, mistake: Mistake) -> T {
        T::of(if self.is(mistake) { 1.001 } else { 1.0 })
    }
}

impl<T: Real, M: Material<T>> Material<T> for MistakenLaw<M> {
    type Memory = M::Memory;
    const RIGID_GRAINS: bool = M::RIGID_GRAINS;
    fn reference_density(&self) -> T {
        self.law.reference_density()
    }
    fn sound_speed(&self) -> T {
        self.law.sound_speed()
    }
    fn shear_modulus(&self) -> T {
        self.law.shear_modulus()
    }
    fn fastest_wave(&self) -> T {
        self.law.fastest_wave()
    }
    fn pressure(&self, compression: T, memory: &M::Memory) -> T {
        self.law.pressure(compression, memory)
    }
    fn compression(&self, pressure: T) -> T {
        self.law.compression(pressure) * self.factor(Mistake::Compression)
    }
    fn hydrostatic_slope(&self) -> (T, T) {
        let (slope, bend) = self.law.hydrostatic_slope();
        (slope * T::of(if self.is(Mistake::Slope) { 1.05 } else { 1.0 }), bend)
    }
    fn needs_velocity_gradient(&self) -> bool {
        self.law.needs_velocity_gradient()
    }
    fn deviator(&self, gradient: &Tensor<T>, memory: &M::Memory) -> SymTensor<T> {
        self.law.deviator(&self.seen(gradient), memory)
    }
    fn with_stress(&self, memory: M::Memory, stress: &SymTensor<T>) -> M::Memory {
        self.law.with_stress(memory, stress)
    }
    fn rate(&self, gradient: &Tensor<T>, memory: &M::Memory) -> M::Memory {
        let rate = self.law.rate(&self.seen(gradient), memory);
        if !self.is(Mistake::Viscous) {
            return rate;
        }
        let speed = gradient.symmetric().root_j2();
        rate.advanced(rate, T::of(0.1) * speed / (T::ONE + speed))
    }
    fn admit(&self, memory: M::Memory) -> (M::Memory, Loss<T>) {
        let (admitted, loss) = self.law.admit(memory);
        let half = T::of(0.5);
        let halfway = memory.advanced(memory, -half).advanced(admitted, half);
        (if self.is(Mistake::Halfway) { halfway } else { admitted }, self.booked(loss))
    }
    fn power_lost(&self, stretch: &SymTensor<T>, deviator: &SymTensor<T>, memory: &M::Memory) -> Loss<T> {
        self.booked(self.law.power_lost(stretch, deviator, memory))
    }
    fn kinematic_viscosity(&self) -> T {
        self.law.kinematic_viscosity()
    }
    fn stored_energy(&self, compression: T, memory: &M::Memory) -> f64 {
        self.law.stored_energy(compression, memory) * self.factor::<f64>(Mistake::Energy)
    }
}
