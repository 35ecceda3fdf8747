//! The water of a case.

use super::walls::Kept;
use super::{SoilLaw, array, vector};
use crate::case::choice::{DiffusionKind, InitialPressure};
use crate::case::model::{Block, Case, Water};
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material;
use crate::mixture::{ArtificialViscosity, DensityDiffusion, Mixture, Phase};
use crate::real::Real;
use crate::setup;
use crate::space::Vector;

/// Water that is not there needs a law all the same.
const NOMINAL: (f64, f64) = (1000.0, 1.0);

impl Case {
    /// The water and the walls around it; no particle where there is none.
    pub(super) fn water_phase<T: Real, const D: usize>(
        &self,
    ) -> Result<Phase<T, D, material::Water<T>>, ParameterError> {
        let Some(water) = &self.water else {
            return Ok(Phase::new(material::Water::new(T::of(NOMINAL.0), T::of(NOMINAL.1))?));
        };
        let mut phase = Phase::new(water.law()?);
        let kept = Kept {
            filled: &|_: &Vector<T, D>| true,
            apart: false,
            slip: self.tank.as_ref().and_then(|tank| tank.water_slip),
        };
        self.add_walls(&mut phase, kept, |x| T::of(self.wall_pressure(water, x)))?;
        for inflow in &water.inflows {
            let (low, high) = (array(&inflow.region.low), array(&inflow.region.high));
            phase.add_inflow(low, high, self.particles.spacing, vector(&inflow.velocity))?;
        }
        for block in &water.blocks {
            let first = phase.len();
            let positions = setup::fill(array(&block.low), array(&block.high), self.particles.spacing);
            phase.add(&positions, self.volume(), |x| T::of(self.rest_pressure(water, block, x)))?;
            phase.velocities_mut()[first..].fill(vector(&block.velocity));
        }
        Ok(phase)
    }

    /// The pressure \[Pa\] water of a block starts with at `x`: ρ̃₀ g (surface − height).
    fn rest_pressure<T: Real, const D: usize>(&self, water: &Water, block: &Block, x: &Vector<T, D>) -> f64 {
        match block.initial_pressure {
            InitialPressure::Zero => 0.0,
            InitialPressure::Hydrostatic => water.reference_density * self.fall(block.surface, x),
        }
    }

    /// A wall near a block carries its pressure from the start \[Pa\].
    fn wall_pressure<T: Real, const D: usize>(&self, water: &Water, x: &Vector<T, D>) -> f64 {
        let blocks = water.blocks.iter().filter(|block| self.is_beside(&block.low, &block.high, x));
        blocks.map(|block| self.rest_pressure(water, block, x)).fold(0.0, f64::max)
    }
}

impl Water {
    fn law<T: Real>(&self) -> Result<material::Water<T>, ParameterError> {
        let water = material::Water::new(T::of(self.reference_density), T::of(self.sound_speed))?
            .with_viscosity(T::of(self.viscosity))?
            .with_exponent(self.tait_exponent)?;
        match self.cavitation_pressure {
            Some(least) => water.with_cavitation(T::of(least)),
            None => Ok(water),
        }
    }

    /// The mixture with this water's numerical choices.
    pub(super) fn apply<T: Real, const D: usize, K: Kernel<T, D>>(
        &self,
        mixture: Mixture<T, D, K, SoilLaw<T>>,
    ) -> Result<Mixture<T, D, K, SoilLaw<T>>, ParameterError> {
        let viscosity = ArtificialViscosity {
            linear: T::of(self.artificial_viscosity_linear),
            quadratic: T::of(self.artificial_viscosity_quadratic),
        };
        mixture.with_artificial_viscosity(viscosity)?.with_density_diffusion(self.diffusion())
    }

    fn diffusion<T: Real>(&self) -> DensityDiffusion<T> {
        let delta = T::of(self.diffusion_coefficient);
        match self.diffusion {
            DiffusionKind::None => DensityDiffusion::None,
            DiffusionKind::PartialDensity => DensityDiffusion::PartialDensity(delta),
            DiffusionKind::TrueDensity => DensityDiffusion::TrueDensity(delta),
            DiffusionKind::Hydrostatic => DensityDiffusion::Hydrostatic(delta),
            DiffusionKind::Renormalised => DensityDiffusion::Renormalised(delta),
        }
    }
}
