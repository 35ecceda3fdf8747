//! What the studies of soil on particles share.

use alluvium::kernel::WendlandC2;
use alluvium::material::{
    Absent, DruckerPrager, Elasticity, Loss, Material, Soil, SoilMemory, Unyielding, YieldSurface,
};
use alluvium::mixture::{ArtificialStress, ArtificialViscosity, Mixture, Phase};
use alluvium::{Real, SymTensor, Tensor, Vector};

pub type SoilMixture<T, const D: usize, S> = Mixture<T, D, WendlandC2<T, D>, S, Absent>;

/// Density of the grains \[kg/m³\].
pub const GRAINS: f64 = 2650.0;

/// Elastic soil of the sand column's stiffness: K = 0.7 MPa, ν = 0.3 (paper, Table 2).
pub fn elasticity<T: Real>() -> Elasticity<T> {
    Elasticity::from_bulk(T::of(0.7e6), T::of(0.3)).expect("moduli")
}

/// Soil that never yields.
pub fn elastic<T: Real>() -> Soil<T, Unyielding> {
    Soil::new(T::of(GRAINS), elasticity(), Unyielding).expect("a soil")
}

/// Soil of these grains \[kg/m³\] that never yields, of bulk and shear modulus \[Pa\].
pub fn elastic_of<T: Real>(grains: f64, bulk: f64, shear: f64) -> Soil<T, Unyielding> {
    let ratio = (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear);
    let elasticity = Elasticity::from_bulk(T::of(bulk), T::of(ratio)).expect("moduli");
    Soil::new(T::of(grains), elasticity, Unyielding).expect("a soil")
}

/// Soil on that cone.
pub fn on_cone<T: Real>(cone: DruckerPrager<T>) -> Soil<T> {
    Soil::new(T::of(GRAINS), elasticity(), cone).expect("a soil")
}

/// The usual artificial stress against tensile instability, on particles of that spacing \[m\].
pub fn artificial_stress<T: Real>(spacing: f64) -> ArtificialStress<T> {
    ArtificialStress { strength: T::of(0.3), exponent: 4, spacing: T::of(spacing) }
}

/// A mixture of that phase without artificial viscosity.
pub fn bare<T: Real, const D: usize, S: Material<T>>(h: f64, phase: Phase<T, D, S>) -> SoilMixture<T, D, S> {
    let none = ArtificialViscosity { linear: T::ZERO, quadratic: T::ZERO };
    Mixture::of_soil(WendlandC2::new(T::of(h)).expect("a length"), phase)
        .with_soil_artificial_viscosity(none)
        .expect("none")
}

/// A mistake: the spin has the sign of (66), the opposite of (35).
#[derive(Clone, Debug)]
pub struct SpinningBack<T, Y>(pub Soil<T, Y>);

impl<T: Real, Y: YieldSurface<T>> Material<T> for SpinningBack<T, Y> {
    type Memory = SoilMemory<T>;
    const RIGID_GRAINS: bool = true;
    fn reference_density(&self) -> T {
        self.0.reference_density()
    }
    fn sound_speed(&self) -> T {
        self.0.sound_speed()
    }
    fn fastest_wave(&self) -> T {
        self.0.fastest_wave()
    }
    fn pressure(&self, compression: T, memory: &SoilMemory<T>) -> T {
        self.0.pressure(compression, memory)
    }
    fn compression(&self, pressure: T) -> T {
        self.0.compression(pressure)
    }
    fn hydrostatic_slope(&self) -> (T, T) {
        self.0.hydrostatic_slope()
    }
    fn needs_velocity_gradient(&self) -> bool {
        true
    }
    fn deviator(&self, velocity_gradient: &Tensor<T>, memory: &SoilMemory<T>) -> SymTensor<T> {
        self.0.deviator(velocity_gradient, memory)
    }
    fn with_stress(&self, memory: SoilMemory<T>, stress: &SymTensor<T>) -> SoilMemory<T> {
        self.0.with_stress(memory, stress)
    }
    fn rate(&self, velocity_gradient: &Tensor<T>, memory: &SoilMemory<T>) -> SoilMemory<T> {
        let t = &velocity_gradient.0;
        let transposed = core::array::from_fn(|a| core::array::from_fn(|b| t[b][a]));
        self.0.rate(&Tensor(transposed), memory)
    }
    fn admit(&self, memory: SoilMemory<T>) -> (SoilMemory<T>, Loss<T>) {
        self.0.admit(memory)
    }
    fn kinematic_viscosity(&self) -> T {
        T::ZERO
    }
    fn stored_energy(&self, compression: T, memory: &SoilMemory<T>) -> f64 {
        self.0.stored_energy(compression, memory)
    }
}

/// A vector with one component.
pub fn along<T: Real, const D: usize>(axis: usize, value: f64) -> Vector<T, D> {
    let mut v = Vector::zero();
    v[axis] = T::of(value);
    v
}
