//! The numerical choices of a mixture, and what acts on it from outside.

use super::relaxation::{LatticeExcess, Relaxation};
use super::setting::BodyForce;
use super::{
    ArtificialStress, ArtificialViscosity, CouplingForm, DensityDiffusion, GradientWeight, HourglassControl,
    Mixture,
};
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::lanes::InstructionSet;
use crate::material::{DragLaw, Material};
use crate::neighbours::{NeighbourSearch, Periodic};
use crate::real::Real;
use crate::space::Vector;
use crate::summation::Neighbourhood;
use std::sync::Arc;

/// Smoothing lengths between soil and water, over that within them \[-\].
const LEAST_INTERPHASE: f64 = 0.5;
const LARGEST_INTERPHASE: f64 = 4.0;

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// Gravity g \[m/s²\].
    pub fn with_gravity(mut self, gravity: Vector<T, D>) -> Self {
        self.setting.gravity = gravity;
        self
    }

    /// A body force per mass, `acceleration(x, t)` \[m/s²\], beside gravity; its work is booked as
    /// external. Extrapolated walls and hydrostatic diffusion know gravity alone: use
    /// [`with_gravity`](Self::with_gravity) for what presses the water against a wall.
    pub fn with_force(
        mut self,
        acceleration: impl Fn(&Vector<T, D>, f64) -> Vector<T, D> + Send + Sync + 'static,
    ) -> Self {
        self.setting.force = Some(BodyForce { acceleration: Arc::new(acceleration), potential: None });
        self
    }

    /// A body force per mass with the potential `potential(x, t)` \[J/kg\] it derives from. The ledger
    /// closes if the potential does not change in time.
    pub fn with_conservative_force(
        mut self,
        acceleration: impl Fn(&Vector<T, D>, f64) -> Vector<T, D> + Send + Sync + 'static,
        potential: impl Fn(&Vector<T, D>, f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        self.setting.force =
            Some(BodyForce { acceleration: Arc::new(acceleration), potential: Some(Arc::new(potential)) });
        self
    }

    /// How pore pressure acts between soil and water; to be chosen before the first evaluation.
    pub fn with_coupling(mut self, form: CouplingForm) -> Self {
        self.coupling.form = form;
        self
    }

    /// Another kernel for all that acts between soil and water: volume fractions (67)–(69), pore pressure, drag. It is
    /// that of the mixture by default. A wider one smooths the coupling, and drag acts as a viscosity ∝ h_c²; walls then
    /// have to be as thick as its support. To be chosen before the first evaluation.
    ///
    /// # Errors
    /// Its smoothing length h_c is not from half to four times that of the mixture.
    pub fn with_interphase_kernel(mut self, kernel: impl Kernel<T, D>) -> Result<Self, ParameterError> {
        let (own, length) = (self.setting.kernel.smoothing_length(), kernel.smoothing_length());
        if !(length >= T::of(LEAST_INTERPHASE) * own && length <= T::of(LARGEST_INTERPHASE) * own) {
            let allowed = "from half to four times the smoothing length within soil and water";
            return Err(ParameterError::new("interphase_smoothing_length", length, allowed));
        }
        self.coupling.across.take_kernel(kernel);
        Ok(self)
    }

    /// Relaxation of the density of water that shares its space to the volume its particles take, in the
    /// time τ \[s\]; none by default, 200 h/c is usual. Acts where pressure acts by differences.
    ///
    /// # Errors
    /// The time is not positive.
    pub fn with_density_relaxation(mut self, time: T) -> Result<Self, ParameterError> {
        if !(time > T::ZERO && time.is_finite()) {
            return Err(ParameterError::new("density_relaxation", time, "a positive time [s]"));
        }
        let lattice = LatticeExcess::of::<T, D, K>(&self.setting.kernel);
        self.relaxation = Some(Relaxation { time, lattice });
        Ok(self)
    }

    /// Drag between soil and water (37); none by default.
    pub fn with_drag(mut self, law: impl DragLaw<T> + 'static) -> Self {
        self.coupling.drag.law = Arc::new(law);
        self
    }

    /// Drag whose weights K_ia/S_i add up to one over the water around each soil particle, S_i = Σ V_a W, where that
    /// fills at least half of its surroundings; not by default. One weight for both of a pair: momentum stays
    /// exact.
    pub fn with_normalised_drag(mut self) -> Self {
        self.coupling.drag.is_normalised = true;
        self
    }

    /// Drag D (v·r̂) r̂ along the line between the particles of a pair: angular momentum is exact too, to the
    /// tolerance of the solution where drag is solved over the step. Not by default: particles at the same place do not drag each other then, which on coincident lattices
    /// at h = 1.5 Δx is a quarter of all drag.
    pub fn with_projected_drag(mut self) -> Self {
        self.coupling.drag.is_projected = true;
        self
    }

    /// Drag of velocities reconstructed between the particles of a pair with the velocity gradients of both (after
    /// Price & Laibe 2020): the flow's own shear is not taken for slip, so that drag hardly damps what soil and
    /// water do together. Momentum is exact, and the rate at which drag takes energy is never negative. Not by default:
    /// it costs three more passes over pairs. Where drag is solved over the step, what reconstruction changes is that at
    /// its start: of first order in Δt with either scheme, and that no step then adds kinetic energy is measured, not
    /// proven. Not beside [`with_projected_drag`](Self::with_projected_drag).
    pub fn with_reconstructed_drag(mut self) -> Self {
        self.coupling.drag.is_reconstructed = true;
        self
    }

    /// Artificial viscosity (59) of water.
    ///
    /// # Errors
    /// A factor is negative or not finite.
    pub fn with_artificial_viscosity(
        mut self,
        factors: ArtificialViscosity<T>,
    ) -> Result<Self, ParameterError> {
        self.water.viscosity = factors.checked()?;
        Ok(self)
    }

    /// Artificial viscosity (59) of soil.
    ///
    /// # Errors
    /// A factor is negative or not finite.
    pub fn with_soil_artificial_viscosity(
        mut self,
        factors: ArtificialViscosity<T>,
    ) -> Result<Self, ParameterError> {
        self.soil.viscosity = factors.checked()?;
        Ok(self)
    }

    /// Density diffusion (52), (54) of water.
    ///
    /// # Errors
    /// The coefficient is not in [0, 1].
    pub fn with_density_diffusion(mut self, diffusion: DensityDiffusion<T>) -> Result<Self, ParameterError> {
        self.water.diffusion = diffusion.checked()?;
        Ok(self)
    }

    /// Artificial stress in soil under tension, which only cohesion can bear (Gray, Monaghan & Swift 2001);
    /// none by default.
    ///
    /// # Errors
    /// The strength is not in \[0, 1\], the exponent not in 1 … 10, or the spacing not positive.
    pub fn with_artificial_stress(mut self, stress: ArtificialStress<T>) -> Result<Self, ParameterError> {
        self.soil.artificial_stress = Some(stress.checked()?);
        Ok(self)
    }

    /// Density diffusion (53), (54) of soil, as printed: δ \[-\], 0 for none, the default. It diffuses the
    /// volume fraction and damps no pressure, which does not depend on the density of rigid grains.
    ///
    /// # Errors
    /// The coefficient is not in [0, 1].
    pub fn with_soil_density_diffusion(mut self, coefficient: T) -> Result<Self, ParameterError> {
        self.soil.diffusion = match DensityDiffusion::PartialDensity(coefficient).checked()? {
            diffusion if coefficient > T::ZERO => diffusion,
            _ => DensityDiffusion::None,
        };
        Ok(self)
    }

    /// Weight of a neighbour in the velocity gradient.
    pub fn with_gradient_weight(mut self, weight: GradientWeight) -> Self {
        self.soil.gradient_weight = weight;
        self.water.gradient_weight = weight;
        self
    }

    /// Makes the gradients of stress and velocity exact for linear fields, wherever the particles are (Bonet & Lok
    /// 1999), of both constituents; the pairs stay equal and opposite, and the energy closes as before. Costs two
    /// to three more passes. What acts between soil and water stays as it is.
    pub fn with_gradient_correction(mut self) -> Self {
        self.soil.is_corrected = true;
        self.water.is_corrected = true;
        self
    }

    /// Viscosity of motion that the velocity gradient (62) of water does not see, of strength ξ \[-\]; 0, the
    /// default, is none, 1 is as viscous as the gradient's own.
    ///
    /// The gradient of a velocity that alternates from particle to particle is zero, so (58) with (62)
    /// neither damps it nor holds it at a wall: flows in which viscosity leads need the control.
    ///
    /// # Errors
    /// The strength is not in [0, 2].
    pub fn with_strain_control(mut self, strength: T) -> Result<Self, ParameterError> {
        if !(strength >= T::ZERO && strength <= T::of(2.0)) {
            return Err(ParameterError::new("strain_control", strength, "from 0 to 2"));
        }
        self.water.strain_control = strength;
        Ok(self)
    }

    /// Forces against motion that the velocity gradient (65) of soil does not see; none by default. Meant for elastic
    /// bodies with free surfaces, beside [`with_gradient_correction`](Self::with_gradient_correction), which are lost
    /// without; costs one more pass. Of soil that yields, what the elastic part holds is not bounded by its strength.
    ///
    /// # Errors
    /// The stiffness is not in [0, 10], or the viscosity not in [0, 1].
    pub fn with_hourglass_control(mut self, control: HourglassControl<T>) -> Result<Self, ParameterError> {
        self.soil.hourglass_control = Some(control.checked()?);
        Ok(self)
    }

    /// Another neighbour search, of which each constituent gets one; results do not depend on it.
    pub fn with_search(self, search: impl Fn() -> Box<dyn NeighbourSearch<T, D>>) -> Self {
        self.with_neighbourhoods(|old| {
            Neighbourhood::new(search(), old.support())
                .with_skin(old.skin())
                .with_periodic(*old.periodic())
                .with_instruction_set(old.instruction_set())
        })
    }

    /// Lists neighbours this much beyond the support \[m\]: a matter of speed, and of the moments at which
    /// particles are re-sorted.
    pub fn with_skin(self, skin: T) -> Self {
        self.with_neighbourhoods(|old| old.with_skin(skin))
    }

    /// Lets space repeat itself.
    pub fn with_periodic(self, periodic: Periodic<T, D>) -> Self {
        self.with_neighbourhoods(|old| old.with_periodic(periodic))
    }

    /// Uses these instructions; results do not depend on them.
    pub fn with_instruction_set(self, set: InstructionSet) -> Self {
        self.with_neighbourhoods(|old| old.with_instruction_set(set))
    }

    fn with_neighbourhoods(mut self, change: impl Fn(Neighbourhood<T, D>) -> Neighbourhood<T, D>) -> Self {
        self.soil.neighbourhood = change(self.soil.neighbourhood);
        self.water.neighbourhood = change(self.water.neighbourhood);
        self.coupling.across.neighbourhood = change(self.coupling.across.neighbourhood);
        self
    }
}
