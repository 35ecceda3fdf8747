//! Laws and yield surfaces with one deliberate mistake, for the driver's studies to catch.

use alluvium::material::{
    DruckerPrager, Elasticity, Flow, Loss, Material, Place, Returned, Soil, SoilMemory, Unyielding,
    YieldSurface,
};
use alluvium::{Real, SymTensor, Tensor};

/// What is wrong with a law's rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mistake {
    None,
    /// The spin of (66) as printed: the opposite of (35).
    Spin,
    /// ∂v_x/∂y + ∂v_y/∂x for the shear rate, without ½.
    Shear,
    /// A stress that depends on how fast it is made.
    Viscous,
    /// Plastic work is not booked.
    Unbooked,
}

/// A soil with a mistake.
#[derive(Clone, Debug)]
pub struct Mistaken<T, Y = Unyielding> {
    pub soil: Soil<T, Y>,
    pub mistake: Mistake,
}

impl<T: Real, Y: YieldSurface<T>> Mistaken<T, Y> {
    fn wronged(&self, gradient: &Tensor<T>) -> Tensor<T> {
        let g = gradient.0;
        match self.mistake {
            Mistake::Spin => Tensor(core::array::from_fn(|a| core::array::from_fn(|b| g[b][a]))),
            Mistake::Shear => {
                let once_more =
                    |a: usize, b: usize| if a == b { T::ZERO } else { T::of(0.5) * (g[a][b] + g[b][a]) };
                Tensor(core::array::from_fn(|a| core::array::from_fn(|b| g[a][b] + once_more(a, b))))
            }
            _ => *gradient,
        }
    }
}

impl<T: Real, Y: YieldSurface<T>> Material<T> for Mistaken<T, Y> {
    type Memory = SoilMemory<T>;
    const RIGID_GRAINS: bool = true;
    fn reference_density(&self) -> T {
        self.soil.reference_density()
    }
    fn sound_speed(&self) -> T {
        self.soil.sound_speed()
    }
    fn pressure(&self, compression: T, memory: &SoilMemory<T>) -> T {
        self.soil.pressure(compression, memory)
    }
    fn compression(&self, pressure: T) -> T {
        self.soil.compression(pressure)
    }
    fn hydrostatic_slope(&self) -> (T, T) {
        self.soil.hydrostatic_slope()
    }
    fn needs_velocity_gradient(&self) -> bool {
        true
    }
    fn deviator(&self, gradient: &Tensor<T>, memory: &SoilMemory<T>) -> SymTensor<T> {
        self.soil.deviator(gradient, memory)
    }
    fn rate(&self, gradient: &Tensor<T>, memory: &SoilMemory<T>) -> SoilMemory<T> {
        let mut rate = self.soil.rate(&self.wronged(gradient), memory);
        if self.mistake == Mistake::Viscous {
            let speed = gradient.symmetric().root_j2();
            rate.stress = rate.stress * (T::ONE + T::of(0.1) * speed / (T::ONE + speed));
        }
        rate
    }
    fn admit(&self, memory: SoilMemory<T>) -> (SoilMemory<T>, Loss<T>) {
        let (memory, mut loss) = self.soil.admit(memory);
        if self.mistake == Mistake::Unbooked {
            loss.plastic = T::ZERO;
        }
        (memory, loss)
    }
    fn power_lost(&self, stretch: &SymTensor<T>, deviator: &SymTensor<T>, memory: &SoilMemory<T>) -> Loss<T> {
        self.soil.power_lost(stretch, deviator, memory)
    }
    fn kinematic_viscosity(&self) -> T {
        T::ZERO
    }
    fn stored_energy(&self, compression: T, memory: &SoilMemory<T>) -> f64 {
        self.soil.stored_energy(compression, memory)
    }
}

/// What is wrong with a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slip {
    None,
    /// Δλ by 9 α_θ² K + G, whatever the dilatancy.
    AssociatedDenominator,
    /// J₂ without its third normal component.
    PlaneJ2,
    /// p where (27) says I₁.
    MeanForI1,
    /// The paper's correction in place of a return: no dilation.
    ScaledBack,
    /// The cone goes on beyond its apex.
    NoApex,
}

/// The cone of Drucker and Prager with a slip.
#[derive(Clone, Copy, Debug)]
pub struct Slipped<T> {
    pub cone: DruckerPrager<T>,
    pub slip: Slip,
}

impl<T: Real> Slipped<T> {
    fn invariants(&self, stress: &SymTensor<T>) -> (T, T) {
        let mean = stress.trace() * T::of(1.0 / 3.0);
        let mut tau = stress.deviator();
        if self.slip == Slip::PlaneJ2 {
            tau.0[2] = T::ZERO;
        }
        let first = if self.slip == Slip::MeanForI1 { mean } else { stress.trace() };
        ((tau.double_dot(&tau) * T::of(0.5)).sqrt(), first)
    }
    fn slipped_excess(&self, stress: &SymTensor<T>) -> T {
        let (shear, first) = self.invariants(stress);
        shear + self.cone.friction() * first - self.cone.cohesion()
    }
}

impl<T: Real> YieldSurface<T> for Slipped<T> {
    fn excess(&self, stress: &SymTensor<T>) -> T {
        self.cone.excess(stress)
    }
    fn flow(&self, stress: &SymTensor<T>) -> Flow<T> {
        self.cone.flow(stress)
    }
    fn largest_tension(&self) -> T {
        self.cone.largest_tension()
    }
    fn returned(&self, elasticity: &Elasticity<T>, trial: &SymTensor<T>) -> Returned<T> {
        if self.slip == Slip::None {
            return self.cone.returned(elasticity, trial);
        }
        if self.slip == Slip::ScaledBack {
            return self.cone.scaled_back(trial);
        }
        let excess = self.slipped_excess(trial);
        let outside = excess > T::ZERO;
        if !outside {
            return Returned::inside(*trial);
        }
        let (shear, _) = self.invariants(trial);
        let (k, g, a) = (elasticity.bulk(), elasticity.shear(), self.cone.friction());
        let dilatancy = self.cone.dilatancy();
        let flow = if self.slip == Slip::AssociatedDenominator { a } else { dilatancy };
        let multiplier = excess / (g + T::of(9.0) * a * flow * k);
        let mean = trial.trace() * T::of(1.0 / 3.0) - T::of(3.0) * dilatancy * k * multiplier;
        let left = T::ONE - g * multiplier / shear;
        if left < T::ZERO && self.slip != Slip::NoApex {
            return Returned::apex(self.largest_tension());
        }
        let stress = trial.deviator() * left + SymTensor::isotropic(mean);
        Returned { stress, place: Place::Face }
    }
    fn scaled_back(&self, stress: &SymTensor<T>) -> Returned<T> {
        if self.slip == Slip::None {
            return self.cone.scaled_back(stress);
        }
        let (shear, first) = self.invariants(stress);
        let scale = (self.cone.cohesion() - self.cone.friction() * first) / shear;
        let isotropic = SymTensor::isotropic(stress.trace() * T::of(1.0 / 3.0));
        Returned { stress: isotropic + stress.deviator() * scale, place: Place::Face }
    }
}
