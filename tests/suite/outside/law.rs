//! Laws of one's own: a fluid whose pressure is linear, and a law that remembers.

use crate::tank::Dam;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Absent, Loss, Material, Memory, Water};
use alluvium::mixture::{DensityDiffusion, Mixture, Phase, Slip, Wall};
use alluvium::neighbours::Periodic;
use alluvium::simulation::Simulation;
use alluvium::time::{StepSize, VelocityVerlet};
use alluvium::{SymTensor, Tensor, Vector, setup};
use core::f64::consts::PI;
use core::ops::ControlFlow;

/// `p = ρ̃₀ c² (ρ̃/ρ̃₀ − 1)`.
#[derive(Clone, Debug)]
pub struct Hooke {
    pub density: f64,
    pub sound_speed: f64,
}

impl Hooke {
    fn stiffness(&self) -> f64 {
        self.density * self.sound_speed * self.sound_speed
    }
}

impl Material<f64> for Hooke {
    type Memory = ();
    fn reference_density(&self) -> f64 {
        self.density
    }
    fn sound_speed(&self) -> f64 {
        self.sound_speed
    }
    fn pressure(&self, compression: f64, (): &()) -> f64 {
        self.stiffness() * compression
    }
    fn compression(&self, pressure: f64) -> f64 {
        pressure / self.stiffness()
    }
    fn hydrostatic_slope(&self) -> (f64, f64) {
        (self.sound_speed.powi(-2), 1.0)
    }
    fn needs_velocity_gradient(&self) -> bool {
        false
    }
    fn deviator(&self, _: &Tensor<f64>, (): &()) -> SymTensor<f64> {
        SymTensor::zero()
    }
    fn rate(&self, _: &Tensor<f64>, (): &()) {}
    fn admit(&self, (): ()) -> ((), Loss<f64>) {
        ((), Loss::none())
    }
    fn kinematic_viscosity(&self) -> f64 {
        0.0
    }
    fn stored_energy(&self, compression: f64, (): &()) -> f64 {
        // ∫ p/ρ̃² dρ̃ with ρ̃ = ρ̃₀ (1 + e).
        self.sound_speed.powi(2) * (compression.ln_1p() + 1.0 / (1.0 + compression) - 1.0)
    }
}

fn dam<F: Material<f64>>(law: F) -> Simulation<f64, 2, WendlandC2<f64, 2>, Absent, F, VelocityVerlet> {
    let dam = Dam { spacing: 0.01, ..Dam::SMALL };
    let kernel = WendlandC2::new(0.013).unwrap();
    let mixture = dam.of(kernel, law, Wall::extrapolated(Slip::FreeSlip));
    Simulation::new(mixture, VelocityVerlet::new(), StepSize::courant(0.1).unwrap())
}

#[test]
fn a_linear_fluid_flows_like_water_of_exponent_one() {
    let mut own = dam(Hooke { density: 1000.0, sound_speed: 25.0 });
    let mut water = dam(Water::new(1000.0, 25.0).unwrap().with_exponent(1).unwrap());
    own.start().unwrap();
    let start = own.budget();
    for _ in 0..400 {
        own.step().unwrap();
        water.step().unwrap();
    }
    let by_id = |run: &[Vector<f64, 2>], ids: &[u32]| {
        let mut places = vec![Vector::zero(); ids.len()];
        ids.iter().zip(run).for_each(|(&id, x)| places[id as usize] = *x);
        places
    };
    let (a, b) = (own.mixture().water(), water.mixture().water());
    let (a, b) = (by_id(a.positions(), a.ids()), by_id(b.positions(), b.ids()));
    let apart = a.iter().zip(&b).map(|(a, b)| (*a - *b).norm()).fold(0.0, f64::max);
    // The laws differ by roundings of the first density; those grow in a flow this lively.
    assert!(apart < 1e-4, "{apart} m apart after {} s", own.time());
    let closure = own.budget().closure(&start).abs() / start.potential;
    assert!(closure < 1e-4, "the ledger closes with its stored energy: {closure:e}");
}

/// `∫ ∂v^γ/∂x^γ dt`: minus the logarithm of the density, if the two go together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stretch(f64);

impl Memory<f64> for Stretch {
    fn advanced(self, rate: Self, dt: f64) -> Self {
        Self(self.0 + rate.0 * dt)
    }
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
}

/// Water that remembers how far it was stretched.
#[derive(Clone, Debug)]
pub struct Remembering(pub Water<f64>);

impl Material<f64> for Remembering {
    type Memory = Stretch;
    fn reference_density(&self) -> f64 {
        self.0.reference_density()
    }
    fn sound_speed(&self) -> f64 {
        self.0.sound_speed()
    }
    fn pressure(&self, compression: f64, _: &Stretch) -> f64 {
        self.0.pressure(compression, &())
    }
    fn compression(&self, pressure: f64) -> f64 {
        self.0.compression(pressure)
    }
    fn hydrostatic_slope(&self) -> (f64, f64) {
        self.0.hydrostatic_slope()
    }
    fn needs_velocity_gradient(&self) -> bool {
        true
    }
    fn deviator(&self, _: &Tensor<f64>, _: &Stretch) -> SymTensor<f64> {
        SymTensor::zero()
    }
    fn rate(&self, velocity_gradient: &Tensor<f64>, _: &Stretch) -> Stretch {
        Stretch(velocity_gradient.trace())
    }
    fn admit(&self, memory: Stretch) -> (Stretch, Loss<f64>) {
        (memory, Loss::none())
    }
    fn kinematic_viscosity(&self) -> f64 {
        0.0
    }
    fn stored_energy(&self, compression: f64, _: &Stretch) -> f64 {
        self.0.stored_energy(compression, &())
    }
}

#[test]
fn a_law_with_a_memory_remembers_what_happened_to_its_particle() {
    let spacing = 0.05;
    let mut phase = Phase::new(Remembering(Water::new(1000.0, 10.0).unwrap()));
    phase.add(&setup::fill([0.0; 2], [1.0; 2], spacing), spacing * spacing, |_| 0.0).unwrap();
    phase.set_velocity(|x| Vector([0.5 * (2.0 * PI * x[0]).sin(), 0.2 * (2.0 * PI * x[1]).cos()]));
    let kernel = WendlandC2::new(1.3 * spacing).unwrap();
    let mixture = Mixture::<f64, 2, _, _, _>::of_water(kernel, phase)
        .with_density_diffusion(DensityDiffusion::None)
        .unwrap()
        .with_periodic(Periodic::new(Vector::zero(), [Some(1.0); 2]).unwrap());
    let mut run = Simulation::new(mixture, VelocityVerlet::new(), StepSize::courant(0.05).unwrap());
    let _ = run.run_until(0.1, |_| ControlFlow::Continue(())).unwrap();
    let fluid = run.mixture().water();
    let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
    for i in 0..fluid.len() {
        let logarithm = fluid.compression(i).ln_1p();
        largest = largest.max(logarithm.abs());
        apart = apart.max((logarithm + fluid.memory(i).0).abs());
    }
    assert!(largest > 1e-2, "something was compressed: {largest}");
    assert!(apart < 1e-3 * largest, "{apart:e} of {largest:e}");
}
