//! `[soil]`.

use super::list;
use crate::case::choice::{Choice, SurfaceKind};
use crate::case::model::{Frictional, Shape, Soil, SoilBody, Stiffness, Strength};
use core::fmt;

pub(super) fn soil(f: &mut fmt::Formatter<'_>, soil: &Soil) -> fmt::Result {
    writeln!(f, "\n[soil]")?;
    writeln!(f, "reference_density_kg_per_m3 = {:?}", soil.reference_density)?;
    writeln!(f, "volume_fraction = {:?}", soil.volume_fraction)?;
    match soil.stiffness {
        Stiffness::Bulk(modulus) => writeln!(f, "bulk_modulus_pa = {modulus:?}")?,
        Stiffness::Youngs(modulus) => writeln!(f, "youngs_modulus_pa = {modulus:?}")?,
    }
    writeln!(f, "poissons_ratio = {:?}", soil.poissons_ratio)?;
    strength(f, &soil.strength)?;
    writeln!(f, "plasticity = \"{}\"", soil.plasticity.word())?;
    writeln!(f, "sound_speed_m_per_s = {:?}", soil.sound_speed)?;
    writeln!(f, "\n[soil.artificial_viscosity]")?;
    writeln!(f, "linear = {:?}", soil.artificial_viscosity_linear)?;
    writeln!(f, "quadratic = {:?}", soil.artificial_viscosity_quadratic)?;
    writeln!(f, "\n[soil.density_diffusion]\ncoefficient = {:?}", soil.diffusion_coefficient)?;
    writeln!(f, "\n[soil.stress_regularisation]\nevery_steps = {}", soil.regularisation_every)?;
    writeln!(f, "\n[soil.artificial_stress]\nstrength = {:?}", soil.artificial_stress_strength)?;
    writeln!(f, "exponent = {}", soil.artificial_stress_exponent)?;
    soil.bodies.iter().try_for_each(|each| body(f, each))
}

fn strength(f: &mut fmt::Formatter<'_>, strength: &Strength) -> fmt::Result {
    match strength {
        Strength::Elastic => writeln!(f, "yield_surface = \"{}\"", SurfaceKind::Elastic),
        Strength::MohrCoulomb(each) => {
            writeln!(f, "yield_surface = \"{}\"", SurfaceKind::MohrCoulomb)?;
            frictional(f, each)
        }
        Strength::DruckerPrager { frictional: each, cone, tension_cut_off } => {
            writeln!(f, "yield_surface = \"{}\"", SurfaceKind::DruckerPrager)?;
            frictional(f, each)?;
            if let Some(tension) = tension_cut_off {
                writeln!(f, "tension_cut_off_pa = {tension:?}")?;
            }
            writeln!(f, "cone = \"{}\"", cone.word())
        }
    }
}

fn frictional(f: &mut fmt::Formatter<'_>, frictional: &Frictional) -> fmt::Result {
    writeln!(f, "friction_angle_deg = {:?}", frictional.friction_angle)?;
    writeln!(f, "dilatancy_angle_deg = {:?}", frictional.dilatancy_angle)?;
    writeln!(f, "cohesion_pa = {:?}", frictional.cohesion)
}

fn body(f: &mut fmt::Formatter<'_>, body: &SoilBody) -> fmt::Result {
    match &body.shape {
        Shape::Block { low, high } => {
            writeln!(f, "\n[[soil.block]]\nlow_m = {}\nhigh_m = {}", list(low), list(high))?;
        }
        Shape::Cylinder { base, radius, height } => {
            writeln!(f, "\n[[soil.cylinder]]\nbase_m = {}", list(base))?;
            writeln!(f, "radius_m = {radius:?}\nheight_m = {height:?}")?;
        }
    }
    writeln!(f, "velocity_m_per_s = {}", list(&body.velocity))?;
    writeln!(f, "initial_stress = \"{}\"", body.initial_stress)?;
    writeln!(f, "surface_m = {:?}", body.surface)?;
    writeln!(f, "lateral_stress_ratio = {:?}", body.lateral_ratio)?;
    writeln!(f, "held = {}", body.held)
}
