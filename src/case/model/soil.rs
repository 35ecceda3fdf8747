//! Soil in a case: its law, its dissipation, where it is.

use super::cells;
use crate::case::choice::InitialStress;
use crate::error::ParameterError;
use crate::material::{
    self, AnySurface, Cone, DruckerPrager, Elasticity, LateralRatio, MohrCoulomb, Plasticity,
};
use crate::real::Real;

/// Soil: its law, its dissipation, where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Soil {
    /// Reference density ρ̃₀ of the grains \[kg/m³\].
    pub reference_density: f64,
    /// Volume fraction φ of the grains at the start \[–\].
    pub volume_fraction: f64,
    /// The modulus that is given.
    pub stiffness: Stiffness,
    /// Poisson's ratio ν \[–\].
    pub poissons_ratio: f64,
    /// Speed of sound c in artificial viscosity and diffusion \[m/s\].
    pub sound_speed: f64,
    /// Where elasticity ends.
    pub strength: Strength,
    /// How stress is kept admissible.
    pub plasticity: Plasticity,
    /// Artificial viscosity, linear η₁ \[–\].
    pub artificial_viscosity_linear: f64,
    /// Artificial viscosity, quadratic η₂ \[–\].
    pub artificial_viscosity_quadratic: f64,
    /// Coefficient δ of the density diffusion \[–\].
    pub diffusion_coefficient: f64,
    /// Steps between regularisations of the stress; 0 is never.
    pub regularisation_every: u64,
    /// Strength ε of the artificial stress under tension \[–\]; 0 is none.
    pub artificial_stress_strength: f64,
    /// Its exponent n \[–\].
    pub artificial_stress_exponent: u32,
    /// Where the soil is at the start: blocks, then cylinders.
    pub bodies: Vec<SoilBody>,
}

/// A modulus, which with Poisson's ratio gives the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stiffness {
    /// Bulk modulus K \[Pa\].
    Bulk(f64),
    /// Young's modulus E \[Pa\].
    Youngs(f64),
}

/// Where elasticity ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strength {
    /// On the cone of Drucker and Prager.
    DruckerPrager {
        /// Angles and cohesion.
        frictional: Frictional,
        /// In which states the cone meets the pyramid of Mohr and Coulomb.
        cone: Cone,
        /// Largest mean tension \[Pa\], if it is less than the cone's apex.
        tension_cut_off: Option<f64>,
    },
    /// On the pyramid of Mohr and Coulomb.
    MohrCoulomb(Frictional),
    /// Nowhere.
    Elastic,
}

/// Friction, dilatancy and cohesion of Mohr and Coulomb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frictional {
    /// θ \[°\].
    pub friction_angle: f64,
    /// ψ \[°\].
    pub dilatancy_angle: f64,
    /// c \[Pa\].
    pub cohesion: f64,
}

/// A body of soil at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct SoilBody {
    /// Its shape and place.
    pub shape: Shape,
    /// Velocity \[m/s\].
    pub velocity: Vec<f64>,
    /// Stress at the start.
    pub initial_stress: InitialStress,
    /// Level of the surface under which stress is geostatic, measured against gravity \[m\].
    pub surface: f64,
    /// Lateral over vertical stress K₀ \[–\].
    pub lateral_ratio: f64,
    /// Whether it is held in place: water seeps through it.
    pub held: bool,
}

/// The shape of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A box.
    Block {
        /// Lowest corner \[m\].
        low: Vec<f64>,
        /// Highest corner \[m\].
        high: Vec<f64>,
    },
    /// A cylinder that stands upright, against gravity; of three dimensions.
    Cylinder {
        /// Centre of its base \[m\].
        base: Vec<f64>,
        /// Radius \[m\].
        radius: f64,
        /// Height \[m\].
        height: f64,
    },
}

/// A radius that ends at a particle's centre, but for rounding, holds it.
pub(in crate::case) const ROUNDING: f64 = 1e-9;

/// The axis along which gravity acts most, and whether it points down along it.
pub(in crate::case) fn upright(gravity: &[f64]) -> (usize, bool) {
    let steepest = |a: &usize, b: &usize| gravity[*a].abs().total_cmp(&gravity[*b].abs());
    let axis = (0..gravity.len()).rev().max_by(steepest).unwrap_or(1);
    (axis, gravity[axis] <= 0.0)
}

impl Shape {
    /// Lowest and highest corner of the box around it \[m\].
    pub fn bounds(&self, gravity: &[f64]) -> (Vec<f64>, Vec<f64>) {
        match self {
            Self::Block { low, high } => (low.clone(), high.clone()),
            Self::Cylinder { base, radius, height } => {
                let (up, rises) = upright(gravity);
                let (below, above) = if rises { (0.0, *height) } else { (*height, 0.0) };
                let corner = |sign: f64, along: f64| {
                    let shift = |k| if k == up { sign * along } else { sign * radius };
                    base.iter().enumerate().map(|(k, x)| x + shift(k)).collect()
                };
                (corner(-1.0, below), corner(1.0, above))
            }
        }
    }

    /// Number of particles of one `spacing` \[m\] that fill it.
    pub fn cells(&self, spacing: f64) -> u64 {
        match self {
            Self::Block { low, high } => cells(low, high, spacing).product(),
            Self::Cylinder { radius, height, .. } => {
                let ratio = radius / spacing * (1.0 + ROUNDING);
                let half = |i: u64| (i as f64 + 0.5) * (i as f64 + 0.5);
                // Of a quarter, column by column.
                let rows = 0..ratio.ceil() as u64;
                let row = |i: u64| ((ratio * ratio - half(i)).max(0.0).sqrt() + 0.5).floor() as u64;
                4 * rows.map(row).sum::<u64>() * (height / spacing).round() as u64
            }
        }
    }
}

impl Soil {
    /// The elastic part of its law.
    ///
    /// # Errors
    /// A modulus or Poisson's ratio is out of range.
    pub fn elasticity<T: Real>(&self) -> Result<Elasticity<T>, ParameterError> {
        let ratio = T::of(self.poissons_ratio);
        match self.stiffness {
            Stiffness::Bulk(modulus) => Elasticity::from_bulk(T::of(modulus), ratio),
            Stiffness::Youngs(modulus) => Elasticity::new(T::of(modulus), ratio),
        }
    }

    /// Speed of compression waves, √((K + 4G/3)/ρ̃₀) \[m/s\].
    pub fn fastest_wave(&self) -> f64 {
        let modulus =
            self.elasticity().map_or(0.0, |elasticity: Elasticity<f64>| elasticity.plane_wave_modulus());
        (modulus / self.reference_density).sqrt()
    }

    /// Its law.
    ///
    /// # Errors
    /// A value is out of range.
    pub fn law<T: Real>(&self) -> Result<material::Soil<T, AnySurface<T>>, ParameterError> {
        material::Soil::new(T::of(self.reference_density), self.elasticity()?, self.strength.surface()?)?
            .with_plasticity(self.plasticity)
            .with_sound_speed(T::of(self.sound_speed))
    }

    /// The bodies with their names in the file, as in `soil.block[1]`.
    pub(in crate::case) fn named_bodies(&self) -> impl Iterator<Item = (String, &SoilBody)> {
        let mut counts = [0, 0];
        self.bodies.iter().map(move |body| {
            let (kind, table) = match body.shape {
                Shape::Block { .. } => (0, "block"),
                Shape::Cylinder { .. } => (1, "cylinder"),
            };
            counts[kind] += 1;
            (format!("soil.{table}[{}]", counts[kind]), body)
        })
    }
}

impl Strength {
    /// The yield surface.
    ///
    /// # Errors
    /// A value is out of range.
    pub fn surface<T: Real>(&self) -> Result<AnySurface<T>, ParameterError> {
        match *self {
            Self::DruckerPrager { frictional, cone, tension_cut_off } => {
                let surface = frictional.cone(cone)?;
                let surface = match tension_cut_off {
                    Some(tension) => surface.with_tension_cut_off(T::of(tension))?,
                    None => surface,
                };
                Ok(AnySurface::DruckerPrager(surface))
            }
            Self::MohrCoulomb(frictional) => {
                let [friction, dilatancy] = frictional.angles();
                let cohesion = T::of(frictional.cohesion);
                Ok(AnySurface::MohrCoulomb(MohrCoulomb::cohesive(friction, dilatancy, cohesion)?))
            }
            Self::Elastic => Ok(AnySurface::Unyielding),
        }
    }

    /// Lateral over vertical stress at rest (76) \[–\]: as printed, and the one to start from, which the
    /// surface bears without cohesion.
    ///
    /// # Errors
    /// A value is out of range.
    pub fn lateral_ratios(&self, elasticity: &Elasticity<f64>) -> Result<(f64, f64), ParameterError> {
        let printed = elasticity.lateral_ratio();
        let (frictional, cone) = match *self {
            Self::DruckerPrager { frictional, cone, .. } => (frictional, cone),
            // At rest two stresses are the same: there this cone is the pyramid.
            Self::MohrCoulomb(frictional) => (frictional, Cone::TriaxialCompression),
            Self::Elastic => return Ok((printed, printed)),
        };
        Ok((printed, LateralRatio::new(elasticity, &frictional.cone(cone)?).admissible()))
    }
}

impl Frictional {
    fn angles<T: Real>(&self) -> [T; 2] {
        [self.friction_angle, self.dilatancy_angle].map(|angle| T::of(angle.to_radians()))
    }

    fn cone<T: Real>(&self, cone: Cone) -> Result<DruckerPrager<T>, ParameterError> {
        let [friction, dilatancy] = self.angles();
        DruckerPrager::cohesive(cone, friction, dilatancy, T::of(self.cohesion))
    }
}
