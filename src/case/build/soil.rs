//! The soil of a case.

use super::walls::Kept;
use super::{SoilLaw, array, vector};
use crate::case::choice::InitialStress;
use crate::case::model::{Case, ROUNDING, Shape, Soil, SoilBody, upright};
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::{AnySurface, Elasticity};
use crate::mixture::{ArtificialStress, ArtificialViscosity, Mixture, Phase, Wall};
use crate::real::Real;
use crate::setup;
use crate::space::{SymTensor, Vector};

/// Stress (75) \[Pa\] under a vertical stress, negative in compression, and K₀ times as much across the
/// unit vector `up`.
pub(in crate::case) fn at_rest<T: Real, const D: usize>(
    vertical: T,
    lateral_ratio: T,
    up: Vector<T, D>,
) -> SymTensor<T> {
    let mut stress = SymTensor::isotropic(vertical * lateral_ratio); // (75)
    let rest = vertical * (T::ONE - lateral_ratio);
    for k in 0..D {
        for l in k..D {
            stress.0[SymTensor::<T>::index(k, l)] += rest * up[k] * up[l];
        }
    }
    stress
}

impl Case {
    /// The soil and the walls around it; no particle where there is none.
    pub(super) fn soil_phase<T: Real, const D: usize>(
        &self,
    ) -> Result<Phase<T, D, SoilLaw<T>>, ParameterError> {
        let Some(soil) = &self.soil else { return Ok(Phase::new(nominal()?)) };
        let mut phase = Phase::new(soil.law()?);
        let beside = |x: &Vector<T, D>| {
            let mut bounds = soil.bodies.iter().map(|body| body.shape.bounds(&self.gravity));
            bounds.any(|(low, high)| self.is_behind(&low, &high, x))
        };
        // Where there is water too, it has all of the space beside walls without soil.
        let filled = |x: &Vector<T, D>| self.water.is_none() || beside(x);
        self.add_walls(&mut phase, Kept { filled: &filled, apart: false, slip: None }, |_| T::ZERO)?;
        if self.water.is_some() {
            let empty = |x: &Vector<T, D>| !beside(x);
            self.add_walls(&mut phase, Kept { filled: &empty, apart: true, slip: None }, |_| T::ZERO)?;
        }
        for body in soil.bodies.iter().filter(|body| body.held) {
            phase.add_wall(Wall::dynamic(), &self.lattice(&body.shape), self.volume(), |_| T::ZERO)?;
        }
        for body in soil.bodies.iter().filter(|body| !body.held) {
            let first = phase.len();
            phase.add(&self.lattice(&body.shape), self.volume(), |_| T::ZERO)?;
            phase.velocities_mut()[first..].fill(vector(&body.velocity));
        }
        let fraction = T::of(soil.volume_fraction);
        phase.set_volume_fraction(|_| fraction);
        phase.set_stress(|x| self.rest_stress(soil, x));
        Ok(phase)
    }

    /// Where the particles of a body stand.
    fn lattice<T: Real, const D: usize>(&self, shape: &Shape) -> Vec<Vector<T, D>> {
        let spacing = self.particles.spacing;
        let (low, high) = shape.bounds(&self.gravity);
        let Shape::Cylinder { base, radius, .. } = shape else {
            return setup::fill(array(&low), array(&high), spacing);
        };
        // Whole cells about the axis, of which those stay whose centre is in the cylinder.
        let up = upright(&self.gravity).0;
        let half = (radius / spacing).ceil() * spacing;
        let end = |sign: f64, corner: &[f64]| -> [f64; D] {
            core::array::from_fn(|k| if k == up { corner[k] } else { base[k] + sign * half })
        };
        let from_axis = |x: &Vector<f64, D>| -> f64 {
            (0..D).filter(|k| *k != up).map(|k| (x[k] - base[k]).powi(2)).sum::<f64>().sqrt()
        };
        let cells = setup::fill::<f64, D>(end(-1.0, &low), end(1.0, &high), spacing);
        let inside = cells.iter().filter(|x| from_axis(x) <= radius * (1.0 + ROUNDING));
        inside.map(|x| Vector::of(x.0)).collect()
    }

    /// What the water around it bears of the weight \[Pa\] of soil that reaches `fall` \[m²/s²\] above `x`.
    fn uplift<T: Real, const D: usize>(&self, x: &Vector<T, D>, fall: f64) -> f64 {
        let Some(water) = &self.water else { return 0.0 };
        let near = water.blocks.iter().filter(|block| self.is_beside(&block.low, &block.high, x));
        let deepest = near.map(|block| self.fall(block.surface, x)).fold(0.0, f64::max);
        water.reference_density * deepest.min(fall)
    }

    /// The stress \[Pa\] soil starts with at `x`: of the body that is there; on a wall, the greatest of the
    /// bodies beside it.
    fn rest_stress<T: Real, const D: usize>(&self, soil: &Soil, x: &Vector<T, D>) -> SymTensor<T> {
        let weight = |body: &SoilBody| match body.initial_stress {
            InitialStress::Geostatic => {
                let fall = self.fall(body.surface, x);
                soil.reference_density * fall - self.uplift(x, fall)
            }
            InitialStress::Zero => 0.0,
        };
        let holds = |body: &&SoilBody| {
            let (low, high) = body.shape.bounds(&self.gravity);
            (0..D).all(|k| (low[k]..=high[k]).contains(&x[k].as_f64()))
        };
        let is_beside = |body: &&SoilBody| {
            let (low, high) = body.shape.bounds(&self.gravity);
            self.is_beside(&low, &high, x)
        };
        let beside = || soil.bodies.iter().filter(is_beside);
        let heaviest = || beside().max_by(|a, b| weight(a).total_cmp(&weight(b)));
        let Some(body) = soil.bodies.iter().find(holds).or_else(heaviest) else { return SymTensor::zero() };
        let strength = self.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        if strength == 0.0 {
            return SymTensor::zero();
        }
        let up: [f64; D] = core::array::from_fn(|k| -self.gravity[k] / strength);
        at_rest(T::of(-weight(body)), T::of(body.lateral_ratio), Vector::of(up))
    }
}

impl Soil {
    /// The mixture with this soil's numerical choices.
    pub(super) fn apply<T: Real, const D: usize, K: Kernel<T, D>>(
        &self,
        mixture: Mixture<T, D, K, SoilLaw<T>>,
        spacing: f64,
    ) -> Result<Mixture<T, D, K, SoilLaw<T>>, ParameterError> {
        let viscosity = ArtificialViscosity {
            linear: T::of(self.artificial_viscosity_linear),
            quadratic: T::of(self.artificial_viscosity_quadratic),
        };
        let opposed = ArtificialStress {
            strength: T::of(self.artificial_stress_strength),
            exponent: self.artificial_stress_exponent,
            spacing: T::of(spacing),
        };
        mixture
            .with_soil_artificial_viscosity(viscosity)?
            .with_soil_density_diffusion(T::of(self.diffusion_coefficient))?
            .with_artificial_stress(opposed)
    }
}

/// Soil that is not there needs a law all the same.
fn nominal<T: Real>() -> Result<SoilLaw<T>, ParameterError> {
    SoilLaw::new(T::of(1000.0), Elasticity::new(T::of(1e6), T::ZERO)?, AnySurface::Unyielding)
}
