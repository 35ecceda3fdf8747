//! What a constituent is made of: how deformation becomes stress.
//!
//! A law sees one particle at a time and always three dimensions; it knows no kernel and no neighbour.

mod absent;
mod any_surface;
mod at_rest;
mod drag;
mod drucker_prager;
mod elasticity;
mod mohr_coulomb;
mod soil;
mod water;
mod yield_surface;

pub use absent::Absent;
pub use any_surface::AnySurface;
pub use at_rest::LateralRatio;
pub use drag::{
    Conductivity, Darcy, DragLaw, Ergun, Forchheimer, KozenyCarman, NoDrag, Permeability, PoreFluid,
};
pub use drucker_prager::{Cone, DruckerPrager};
pub use elasticity::Elasticity;
pub use mohr_coulomb::MohrCoulomb;
pub use soil::{Plasticity, Soil, SoilMemory};
pub use water::Water;
pub use yield_surface::{Flow, Place, Returned, Unyielding, YieldSurface};

use crate::real::Real;
use crate::space::{SymTensor, Tensor};
use core::fmt::Debug;

/// What a law remembers of a particle's past, such as stress. Nothing, for water.
pub trait Memory<T: Real>: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// What there is to show of it in files, as (name, components): 1, 3 for a vector, 6 for a symmetric
    /// tensor (xx, yy, zz, xy, yz, xz). None unless a law says so.
    const SHOWN: &'static [(&'static str, usize)] = &[];
    /// Appends the numbers of [`SHOWN`](Self::SHOWN), in that order.
    fn show(&self, _out: &mut Vec<f64>) {}
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

/// Energy a law does not give back, per volume of the constituent itself: power \[W/m³\] where it
/// belongs to a rate, energy \[J/m³\], at the reference density, where it belongs to an event.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loss<T> {
    /// By viscosity.
    pub viscous: T,
    /// By plastic flow.
    pub plastic: T,
    /// By scaling stress back to the yield surface.
    pub scale_back: T,
    /// By cutting off tension.
    pub cut_off: T,
}

impl<T: Real> Loss<T> {
    /// Nothing.
    pub fn none() -> Self {
        Self { viscous: T::ZERO, plastic: T::ZERO, scale_back: T::ZERO, cut_off: T::ZERO }
    }
    /// All of it.
    pub fn total(&self) -> T {
        self.viscous + self.plastic + self.scale_back + self.cut_off
    }
}

/// A constitutive law.
///
/// Signs: pressure is positive in compression, deviatoric stress positive in tension.
pub trait Material<T: Real>: Clone + Debug + Send + Sync + 'static {
    /// What the law remembers of a particle.
    type Memory: Memory<T>;
    /// Whether the constituent's own matter keeps its density, as grains do. The volume fraction then
    /// follows from the partial density, φ = ρ/ρ̃₀, the compression is always zero, and all of the stress
    /// is in the memory.
    const RIGID_GRAINS: bool = false;
    /// Reference true density ρ̃₀ \[kg/m³\].
    fn reference_density(&self) -> T;
    /// Speed of sound c at the reference density \[m/s\], in artificial viscosity and diffusion.
    fn sound_speed(&self) -> T;
    /// Speed of the fastest wave \[m/s\], for the step limit.
    fn fastest_wave(&self) -> T {
        self.sound_speed()
    }
    /// Shear modulus G \[Pa\]; none but of laws that are elastic in shear.
    fn shear_modulus(&self) -> T {
        T::ZERO
    }
    /// Pressure p \[Pa\] at the compression ρ̃/ρ̃₀ − 1 \[-\].
    fn pressure(&self, compression: T, memory: &Self::Memory) -> T;
    /// The compression ρ̃/ρ̃₀ − 1 \[-\] at pressure p \[Pa\]: the inverse of [`pressure`](Self::pressure).
    fn compression(&self, pressure: T) -> T;
    /// The lowest pressure \[Pa\] the law has at any density; −∞ if there is none.
    fn least_pressure(&self) -> T {
        -T::INFINITY
    }
    /// Change of the compression along hydrostatic equilibrium, `d(ρ̃/ρ̃₀)/d(g·x)` \[s²/m²\], to
    /// first order in the compression: `(value at zero, relative change per unit compression)`.
    fn hydrostatic_slope(&self) -> (T, T);
    /// Whether the law has a deviatoric stress or a memory, and so needs the velocity gradient.
    fn needs_velocity_gradient(&self) -> bool;
    /// Deviatoric stress τ \[Pa\] under the velocity gradient ∂v^α/∂x^β \[1/s\].
    fn deviator(&self, velocity_gradient: &Tensor<T>, memory: &Self::Memory) -> SymTensor<T>;
    /// The memory with the stress σ \[Pa\] in it, for a law that remembers stress; else the memory as it
    /// is.
    fn with_stress(&self, memory: Self::Memory, _stress: &SymTensor<T>) -> Self::Memory {
        memory
    }
    /// Rate of change of the memory.
    fn rate(&self, velocity_gradient: &Tensor<T>, memory: &Self::Memory) -> Self::Memory;
    /// The nearest admissible memory, such as the stress returned to the yield surface, and the
    /// energy that took \[J/m³\].
    fn admit(&self, memory: Self::Memory) -> (Self::Memory, Loss<T>);
    /// What is lost at the strain rate `stretch` \[1/s\] under the deviatoric stress `deviator` \[Pa\],
    /// as power \[W/m³\]. The whole of `τ:∇v`, unless a law stores it.
    fn power_lost(&self, stretch: &SymTensor<T>, deviator: &SymTensor<T>, _memory: &Self::Memory) -> Loss<T> {
        Loss { viscous: deviator.double_dot(stretch), ..Loss::none() }
    }
    /// Kinematic viscosity ν \[m²/s\], for the step limit.
    fn kinematic_viscosity(&self) -> T;
    /// Recoverable energy \[J/kg\], in double precision for the ledger.
    fn stored_energy(&self, compression: T, memory: &Self::Memory) -> f64;
}
