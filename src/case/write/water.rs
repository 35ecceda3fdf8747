//! `[water]`.

use super::list;
use crate::case::choice::DiffusionKind;
use crate::case::model::{Block, Water};
use core::fmt;

pub(super) fn water(f: &mut fmt::Formatter<'_>, water: &Water) -> fmt::Result {
    writeln!(f, "\n[water]")?;
    writeln!(f, "reference_density_kg_per_m3 = {:?}", water.reference_density)?;
    writeln!(f, "sound_speed_m_per_s = {:?}", water.sound_speed)?;
    writeln!(f, "viscosity_pa_s = {:?}", water.viscosity)?;
    writeln!(f, "tait_exponent = {}", water.tait_exponent)?;
    if let Some(least) = water.cavitation_pressure {
        writeln!(f, "cavitation_pressure_pa = {least:?}")?;
    }
    writeln!(f, "\n[water.artificial_viscosity]")?;
    writeln!(f, "linear = {:?}", water.artificial_viscosity_linear)?;
    writeln!(f, "quadratic = {:?}", water.artificial_viscosity_quadratic)?;
    writeln!(f, "\n[water.density_diffusion]\nkind = \"{}\"", water.diffusion)?;
    if water.diffusion != DiffusionKind::None {
        writeln!(f, "coefficient = {:?}", water.diffusion_coefficient)?;
    }
    writeln!(f, "\n[water.reinitialisation]\nevery_steps = {}", water.reinitialisation_every)?;
    water.blocks.iter().try_for_each(|each| block(f, each))?;
    water.inflows.iter().try_for_each(|each| {
        super::mixing::region(f, "[[water.inflow]]", &each.region)?;
        writeln!(f, "velocity_m_per_s = {}", list(&each.velocity))
    })
}

fn block(f: &mut fmt::Formatter<'_>, block: &Block) -> fmt::Result {
    writeln!(f, "\n[[water.block]]")?;
    writeln!(f, "low_m = {}\nhigh_m = {}", list(&block.low), list(&block.high))?;
    writeln!(f, "velocity_m_per_s = {}", list(&block.velocity))?;
    writeln!(f, "initial_pressure = \"{}\"", block.initial_pressure)?;
    writeln!(f, "surface_m = {:?}", block.surface)
}
