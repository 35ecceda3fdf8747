//! A law of one's own that remembers stress: a fluid whose shear is elastic.

use alluvium::material::{Loss, Material, Memory};
use alluvium::{SymTensor, Tensor};

/// Deviatoric stress \[Pa\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shear(SymTensor<f64>);

impl Memory<f64> for Shear {
    const SHOWN: &'static [(&'static str, usize)] = &[("shear", 6)];
    fn show(&self, out: &mut Vec<f64>) {
        out.extend(self.0.0);
    }
    fn advanced(self, rate: Self, dt: f64) -> Self {
        Self(self.0 + rate.0 * dt)
    }
    fn is_finite(&self) -> bool {
        self.0.0.iter().all(|x| x.is_finite())
    }
}

/// `p = ρ̃₀ c² (ρ̃/ρ̃₀ − 1)`, `τ̇ = 2G ė + ωτ − τω`.
#[derive(Clone, Debug)]
pub struct Jelly {
    pub density: f64,
    pub sound_speed: f64,
    /// G \[Pa\].
    pub shear: f64,
    /// 1, or −1 for a deliberate mistake: the sign of the spin.
    pub turns: f64,
}

impl Jelly {
    fn bulk(&self) -> f64 {
        self.density * self.sound_speed * self.sound_speed
    }
}

impl Material<f64> for Jelly {
    type Memory = Shear;
    fn reference_density(&self) -> f64 {
        self.density
    }
    fn sound_speed(&self) -> f64 {
        self.sound_speed
    }
    fn fastest_wave(&self) -> f64 {
        ((self.bulk() + 4.0 / 3.0 * self.shear) / self.density).sqrt()
    }
    fn pressure(&self, compression: f64, _: &Shear) -> f64 {
        self.bulk() * compression
    }
    fn compression(&self, pressure: f64) -> f64 {
        pressure / self.bulk()
    }
    fn hydrostatic_slope(&self) -> (f64, f64) {
        (self.sound_speed.powi(-2), 1.0)
    }
    fn needs_velocity_gradient(&self) -> bool {
        true
    }
    fn deviator(&self, _: &Tensor<f64>, memory: &Shear) -> SymTensor<f64> {
        memory.0
    }
    fn with_stress(&self, _: Shear, stress: &SymTensor<f64>) -> Shear {
        Shear(stress.deviator())
    }
    fn rate(&self, velocity_gradient: &Tensor<f64>, memory: &Shear) -> Shear {
        let turning = memory.0.turning(&velocity_gradient.spin()) * self.turns;
        Shear(turning + velocity_gradient.symmetric().deviator() * (2.0 * self.shear))
    }
    fn admit(&self, memory: Shear) -> (Shear, Loss<f64>) {
        (memory, Loss::none())
    }
    fn power_lost(&self, _: &SymTensor<f64>, _: &SymTensor<f64>, _: &Shear) -> Loss<f64> {
        Loss::none() // its shear is stored
    }
    fn kinematic_viscosity(&self) -> f64 {
        0.0
    }
    fn stored_energy(&self, compression: f64, memory: &Shear) -> f64 {
        let by_pressure = self.sound_speed.powi(2) * (compression.ln_1p() + 1.0 / (1.0 + compression) - 1.0);
        by_pressure + memory.0.double_dot(&memory.0) / (4.0 * self.shear * self.density)
    }
}
