//! Soil: an elastic-perfectly plastic skeleton of rigid grains (21)–(36), (79).

use super::yield_surface::{Place, YieldSurface};
use super::{DruckerPrager, Elasticity, Loss, Material, Memory};
use crate::error::ParameterError;
use crate::real::Real;
use crate::space::{SymTensor, Tensor};

/// How stress is kept admissible.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Plasticity {
    /// The rate is elastic, and every step ends with a return to the surface.
    #[default]
    ReturnMapping,
    /// The paper's: where F ≥ 0 the rate holds the plastic multiplier (26), and every step ends with
    /// tension cracking and scaling back. F is taken as zero already at −10⁻⁴ of √J₂ + |p|: a step
    /// along a curved surface ends beside it, and the next would be elastic by chance.
    Rate,
    /// The same with F ≥ 0 to the letter, for comparison: scaled back, F is zero but for rounding, so chance
    /// decides which steps flow and dilate.
    LiteralRate,
}

/// How far below zero F counts as zero in [`Plasticity::Rate`], as part of √J₂ + |p|.
const SLACK: f64 = 1e-4;

/// What soil remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SoilMemory<T: Real> {
    /// Effective stress σ \[Pa\], per area of the grains, positive in tension.
    pub stress: SymTensor<T>,
    /// Accumulated plastic strain \[-\], positive in extension; its xy component is Eq. (79). It
    /// cancels when shear turns back.
    pub plastic_strain: SymTensor<T>,
    /// Equivalent plastic strain `∫√(⅔ ė_p:ė_p) dt` \[-\] of the plastic strain's deviator; never falls.
    pub equivalent_plastic_strain: T,
}

impl<T: Real> SoilMemory<T> {
    /// Under a stress \[Pa\], positive in tension, without plastic strain.
    pub fn stressed(stress: SymTensor<T>) -> Self {
        Self { stress, ..Self::default() }
    }

    /// In the ground, Eq. (75): `vertical_stress` \[Pa\], negative in compression, along the axis
    /// `up` (0, 1 or 2), and `lateral_ratio` K₀ \[-\] times as much along the other two.
    ///
    /// # Panics
    /// `up` is above 2.
    pub fn geostatic(vertical_stress: T, lateral_ratio: T, up: usize) -> Self {
        let mut normal = [vertical_stress * lateral_ratio; 3]; // (75)
        normal[up] = vertical_stress;
        let ([x, y, z], o) = (normal, T::ZERO);
        Self::stressed(SymTensor([x, y, z, o, o, o]))
    }

    /// Pressure `−σ^γγ/3` \[Pa\], positive in compression.
    #[inline(always)]
    pub fn pressure(&self) -> T {
        self.stress.trace() * T::of(-1.0 / 3.0)
    }

    /// The same with this plastic strain \[-\] added.
    #[inline(always)]
    fn strained(mut self, plastic: &SymTensor<T>) -> Self {
        self.plastic_strain = self.plastic_strain + *plastic; // (79)
        self.equivalent_plastic_strain += equivalent(plastic);
        self
    }
}

/// `√(⅔ e:e)` of a strain's deviator.
#[inline(always)]
fn equivalent<T: Real>(strain: &SymTensor<T>) -> T {
    strain.root_j2() * T::of(4.0 / 3.0).sqrt()
}

impl<T: Real> Memory<T> for SoilMemory<T> {
    const SHOWN: &'static [(&'static str, usize)] =
        &[("stress", 6), ("plastic_strain", 6), ("equivalent_plastic_strain", 1)];

    fn show(&self, out: &mut Vec<f64>) {
        out.extend(self.stress.0.map(T::as_f64));
        out.extend(self.plastic_strain.0.map(T::as_f64));
        out.push(self.equivalent_plastic_strain.as_f64());
    }

    #[inline(always)]
    fn advanced(self, rate: Self, dt: T) -> Self {
        Self {
            stress: self.stress + rate.stress * dt,
            plastic_strain: self.plastic_strain + rate.plastic_strain * dt,
            equivalent_plastic_strain: self.equivalent_plastic_strain + rate.equivalent_plastic_strain * dt,
        }
    }

    fn is_finite(&self) -> bool {
        let finite = |tensor: &SymTensor<T>| tensor.0.iter().all(|x| x.is_finite());
        finite(&self.stress) && finite(&self.plastic_strain) && self.equivalent_plastic_strain.is_finite()
    }
}

/// Elastic-perfectly plastic soil with a yield surface `Y`; elastic with [`Unyielding`](super::Unyielding).
///
/// $$\dot\sigma = \omega\sigma - \sigma\omega + C : (\dot\epsilon - \dot\epsilon_p),\qquad
/// \dot\epsilon_p = \dot\lambda\,\frac{\partial H}{\partial\sigma}$$
///
/// Stress and pressure are those of the skeleton, without pore water, and per area of the grains: in a
/// mixture both act times the volume fraction of the soil.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Soil<T, Y = DruckerPrager<T>> {
    reference_density: T,
    sound_speed: T,
    elasticity: Elasticity<T>,
    surface: Y,
    plasticity: Plasticity,
}

impl<T: Real, Y: YieldSurface<T>> Soil<T, Y> {
    /// `reference_density` ρ̃₀ \[kg/m³\]: that of the grains. The speed of sound is √(K/ρ̃₀).
    ///
    /// # Errors
    /// The density is not positive and finite.
    pub fn new(reference_density: T, elasticity: Elasticity<T>, surface: Y) -> Result<Self, ParameterError> {
        if !(reference_density > T::ZERO && reference_density.is_finite()) {
            let allowed = "a positive density [kg/m³]";
            return Err(ParameterError::new("reference_density", reference_density, allowed));
        }
        let sound_speed = (elasticity.bulk() / reference_density).sqrt();
        Ok(Self { reference_density, sound_speed, elasticity, surface, plasticity: Plasticity::default() })
    }

    /// The same soil kept admissible in another way.
    pub fn with_plasticity(mut self, plasticity: Plasticity) -> Self {
        self.plasticity = plasticity;
        self
    }

    /// The same soil with another speed of sound \[m/s\] in artificial viscosity and diffusion, as
    /// the paper's tables give one. The step limit keeps the speed of its waves.
    ///
    /// # Errors
    /// The speed is not positive and finite.
    pub fn with_sound_speed(mut self, sound_speed: T) -> Result<Self, ParameterError> {
        if !(sound_speed > T::ZERO && sound_speed.is_finite()) {
            return Err(ParameterError::new("sound_speed", sound_speed, "a positive speed [m/s]"));
        }
        self.sound_speed = sound_speed;
        Ok(self)
    }

    /// Its elastic part.
    pub fn elasticity(&self) -> &Elasticity<T> {
        &self.elasticity
    }

    /// Its yield surface.
    pub fn surface(&self) -> &Y {
        &self.surface
    }

    /// How its stress is kept admissible.
    pub fn plasticity(&self) -> Plasticity {
        self.plasticity
    }

    /// Plastic strain rate \[1/s\] at a stress, Eq. (24); zero inside the surface.
    #[inline(always)]
    fn plastic_rate(&self, stretch: &SymTensor<T>, stress: &SymTensor<T>) -> SymTensor<T> {
        let size = stress.root_j2() + stress.trace().abs() * T::of(1.0 / 3.0);
        let slack = if self.plasticity == Plasticity::Rate { SLACK } else { 0.0 };
        let yields = self.surface.excess(stress) >= -T::of(slack) * size;
        if !yields {
            return SymTensor::zero();
        }
        let flow = self.surface.flow(stress);
        flow.direction * flow.multiplier(&self.elasticity, stretch) // (24)
    }

    /// The memory after plastic strain has taken its stress to `stress`, and what that took \[J/m³\]: the
    /// work of the stress on the surface. A trial beyond it holds energy that no work has put there.
    #[inline(always)]
    fn flowed(&self, memory: &SoilMemory<T>, stress: SymTensor<T>) -> (SoilMemory<T>, T) {
        let strain = self.elasticity.strain(&(memory.stress - stress));
        (SoilMemory { stress, ..memory.strained(&strain) }, stress.double_dot(&strain))
    }

    /// The memory under another stress, and the stored energy the change sets free \[J/m³\].
    #[inline(always)]
    fn relieved(&self, memory: &SoilMemory<T>, stress: SymTensor<T>) -> (SoilMemory<T>, T) {
        let strain = self.elasticity.strain(&(memory.stress - stress));
        let energy = T::of(0.5) * (memory.stress + stress).double_dot(&strain);
        (SoilMemory { stress, ..*memory }, energy)
    }
}

impl<T: Real, Y: YieldSurface<T>> Material<T> for Soil<T, Y> {
    type Memory = SoilMemory<T>;
    const RIGID_GRAINS: bool = true;

    fn reference_density(&self) -> T {
        self.reference_density
    }

    fn sound_speed(&self) -> T {
        self.sound_speed
    }

    /// √((K + 4G/3)/ρ̃₀), whatever the volume fraction.
    fn fastest_wave(&self) -> T {
        (self.elasticity.plane_wave_modulus() / self.reference_density).sqrt()
    }

    fn shear_modulus(&self) -> T {
        self.elasticity.shear()
    }

    #[inline(always)]
    fn pressure(&self, _: T, memory: &SoilMemory<T>) -> T {
        memory.pressure()
    }

    /// Zero: grains keep their density.
    fn compression(&self, _: T) -> T {
        T::ZERO
    }

    fn hydrostatic_slope(&self) -> (T, T) {
        (T::ZERO, T::ZERO)
    }

    fn needs_velocity_gradient(&self) -> bool {
        true
    }

    #[inline(always)]
    fn deviator(&self, _: &Tensor<T>, memory: &SoilMemory<T>) -> SymTensor<T> {
        memory.stress.deviator()
    }

    fn with_stress(&self, memory: SoilMemory<T>, stress: &SymTensor<T>) -> SoilMemory<T> {
        SoilMemory { stress: *stress, ..memory }
    }

    /// (34), and with the plastic rate (21), of which (30)–(32) are the case of one cone.
    #[inline(always)]
    fn rate(&self, velocity_gradient: &Tensor<T>, memory: &SoilMemory<T>) -> SoilMemory<T> {
        let elastic = SoilMemory::stressed(self.elasticity.stress_rate(velocity_gradient, &memory.stress));
        if self.plasticity == Plasticity::ReturnMapping {
            return elastic;
        }
        let plastic = self.plastic_rate(&velocity_gradient.symmetric(), &memory.stress);
        let stress = elastic.stress - self.elasticity.stress(&plastic); // (21)
        SoilMemory { stress, ..elastic }.strained(&plastic)
    }

    /// Return mapping books the work of plastic flow as plastic, or as cut off where tension ends; the
    /// paper's correction books the stored energy it sets free as scaling back or cut off, and leaves the
    /// plastic strain to the rate.
    #[inline(always)]
    fn admit(&self, memory: SoilMemory<T>) -> (SoilMemory<T>, Loss<T>) {
        let flows = self.plasticity == Plasticity::ReturnMapping;
        let returned = match flows {
            true => self.surface.returned(&self.elasticity, &memory.stress),
            false => self.surface.scaled_back(&memory.stress),
        };
        if returned.place == Place::Inside {
            return (memory, Loss::none());
        }
        let (memory, energy) = match flows {
            true => self.flowed(&memory, returned.stress),
            false => self.relieved(&memory, returned.stress),
        };
        let loss = match returned.place {
            Place::Apex | Place::CutOff => Loss { cut_off: energy, ..Loss::none() },
            _ if flows => Loss { plastic: energy, ..Loss::none() },
            _ => Loss { scale_back: energy, ..Loss::none() },
        };
        (memory, loss)
    }

    /// The work of stress is stored; the rate form loses `σ:ε̇_p`, on a cone `λ̇ (k_c − (α_θ − α_ψ) I₁)`.
    fn power_lost(&self, stretch: &SymTensor<T>, _: &SymTensor<T>, memory: &SoilMemory<T>) -> Loss<T> {
        if self.plasticity == Plasticity::ReturnMapping {
            return Loss::none();
        }
        let plastic = memory.stress.double_dot(&self.plastic_rate(stretch, &memory.stress));
        Loss { plastic, ..Loss::none() }
    }

    fn kinematic_viscosity(&self) -> T {
        T::ZERO
    }

    /// `(p²/2K + τ:τ/4G)/ρ̃₀`.
    fn stored_energy(&self, _: T, memory: &SoilMemory<T>) -> f64 {
        self.elasticity.energy(&memory.stress) / self.reference_density.as_f64()
    }
}
