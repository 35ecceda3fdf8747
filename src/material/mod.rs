//! What a constituent is made of: how deformation becomes stress.
//!
//! A law sees one particle at a time and always three dimensions; it knows no kernel and no neighbour.

mod water;

pub use water::Water;

use crate::real::Real;
use crate::space::{SymTensor, Tensor};
use core::fmt::Debug;

/// What a law remembers of a particle's past, such as stress. Nothing, for water.
pub trait Memory<T: Real>: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// `self + rate · dt`.
    fn advanced(self, rate: Self, dt: T) -> Self;
    /// No number in it is infinite or NaN.
    fn is_finite(&self) -> bool;
}

impl<T: Real> Memory<T> for () {
    fn advanced(self, (): (), _: T) {}
    fn is_finite(&self) -> bool {
        true
    }
}

/// A constitutive law.
///
/// Signs: pressure is positive in compression, deviatoric stress positive in tension.
pub trait Material<T: Real>: Clone + Debug + Send + Sync + 'static {
    /// What the law remembers of a particle.
    type Memory: Memory<T>;
    /// Reference true density ρ̃₀ \[kg/m³\].
    fn reference_density(&self) -> T;
    /// Speed of sound c at the reference density \[m/s\]: of the fastest wave.
    fn sound_speed(&self) -> T;
    /// Pressure p \[Pa\] at the compression ρ̃/ρ̃₀ − 1 \[-\].
    fn pressure(&self, compression: T, memory: &Self::Memory) -> T;
    /// The compression ρ̃/ρ̃₀ − 1 \[-\] at pressure p \[Pa\]: the inverse of [`pressure`](Self::pressure).
    fn compression(&self, pressure: T) -> T;
    /// Change of the compression along hydrostatic equilibrium, `d(ρ̃/ρ̃₀)/d(g·x)` \[s²/m²\], to
    /// first order in the compression: `(value at zero, relative change per unit compression)`.
    fn hydrostatic_slope(&self) -> (T, T);
    /// Whether the law has a deviatoric stress or a memory, and so needs the velocity gradient.
    fn needs_velocity_gradient(&self) -> bool;
    /// Deviatoric stress τ \[Pa\] under the velocity gradient ∂v^α/∂x^β \[1/s\].
    fn deviator(&self, velocity_gradient: &Tensor<T>, memory: &Self::Memory) -> SymTensor<T>;
    /// Rate of change of the memory.
    fn rate(&self, velocity_gradient: &Tensor<T>, memory: &Self::Memory) -> Self::Memory;
    /// The nearest admissible memory, such as the stress returned to the yield surface, and the
    /// energy that took \[J/kg\].
    fn admit(&self, memory: Self::Memory) -> (Self::Memory, T);
    /// Kinematic viscosity ν \[m²/s\], for the step limit.
    fn kinematic_viscosity(&self) -> T;
    /// Recoverable energy \[J/kg\], in double precision for the ledger.
    fn stored_energy(&self, compression: T, memory: &Self::Memory) -> f64;
}
