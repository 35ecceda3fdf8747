//! What a preset means for the keys a case leaves out.

use super::choice::{DiffusionKind, IntegratorChoice, KernelChoice, WallKind};
use crate::material::{Cone, Plasticity};
use crate::mixture::{self, DensityDiffusion};
use crate::preset::Preset;
use crate::time::LeapFrog;

/// What a case gets for the keys it leaves out.
pub(super) struct Defaults {
    pub(super) preset: Preset,
    pub(super) smoothing_ratio: f64,
    pub(super) kernel: KernelChoice,
    pub(super) artificial_viscosity: (f64, f64),
    pub(super) diffusion: DiffusionKind,
    pub(super) diffusion_coefficient: f64,
    pub(super) reinitialisation_every: u64,
    pub(super) soil: SoilDefaults,
    pub(super) walls: WallKind,
    pub(super) integrator: IntegratorChoice,
    pub(super) courant: f64,
}

/// What the soil of a case gets for the keys it leaves out.
pub(super) struct SoilDefaults {
    pub(super) artificial_viscosity: (f64, f64),
    pub(super) diffusion_coefficient: f64,
    pub(super) plasticity: Plasticity,
    /// Whether the dilatancy angle is the friction angle, else it is 0.
    pub(super) associated: bool,
    /// Of two dimensions.
    pub(super) cone: Cone,
    /// Whether soil starts under the lateral stress as printed (76), else under one it can bear.
    pub(super) printed_lateral_ratio: bool,
}

fn soil_defaults(preset: Preset) -> SoilDefaults {
    let viscosity = preset.soil_artificial_viscosity::<f64>();
    let is_paper = preset == Preset::Paper;
    SoilDefaults {
        artificial_viscosity: (viscosity.linear, viscosity.quadratic),
        diffusion_coefficient: preset.soil_density_diffusion(),
        plasticity: if is_paper { Plasticity::Rate } else { Plasticity::ReturnMapping },
        associated: is_paper,
        cone: if is_paper { Cone::PlaneStrainAssociated } else { Cone::PlaneStrain },
        printed_lateral_ratio: is_paper,
    }
}

/// The defaults of a preset.
pub(super) fn defaults(preset: Preset) -> Defaults {
    let viscosity = preset.artificial_viscosity::<f64>();
    let diffusion = preset.density_diffusion::<f64>();
    Defaults {
        preset,
        smoothing_ratio: preset.smoothing_ratio(),
        kernel: KernelChoice::WendlandC2,
        artificial_viscosity: (viscosity.linear, viscosity.quadratic),
        diffusion: kind(diffusion),
        diffusion_coefficient: diffusion.coefficient(),
        reinitialisation_every: preset.reinitialise_every() as u64,
        soil: soil_defaults(preset),
        walls: match preset.wall::<f64, 2>().kind() {
            mixture::WallKind::Dynamic => WallKind::Dynamic,
            mixture::WallKind::Extrapolated { .. } | mixture::WallKind::Given => WallKind::Extrapolated,
        },
        integrator: if preset.leap_frog::<f64>() == LeapFrog::new() {
            IntegratorChoice::LeapFrog
        } else {
            IntegratorChoice::LeapFrogAb3
        },
        courant: preset.courant(),
    }
}

fn kind(diffusion: DensityDiffusion<f64>) -> DiffusionKind {
    match diffusion {
        DensityDiffusion::None => DiffusionKind::None,
        DensityDiffusion::PartialDensity(_) => DiffusionKind::PartialDensity,
        DensityDiffusion::TrueDensity(_) => DiffusionKind::TrueDensity,
        DensityDiffusion::Hydrostatic(_) => DiffusionKind::Hydrostatic,
        DensityDiffusion::Renormalised(_) => DiffusionKind::Renormalised,
    }
}
