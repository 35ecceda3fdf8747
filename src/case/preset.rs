//! The defaults: what is recommended, and what the paper prints.

use super::choice::{DiffusionKind, IntegratorChoice, KernelChoice, Preset, WallKind};

/// What a case gets for the keys it leaves out.
pub(super) struct Defaults {
    pub(super) smoothing_ratio: f64,
    pub(super) kernel: KernelChoice,
    pub(super) artificial_viscosity: (f64, f64),
    pub(super) diffusion: DiffusionKind,
    pub(super) diffusion_coefficient: f64,
    pub(super) reinitialisation_every: u64,
    pub(super) walls: WallKind,
    /// None: as many as the support needs.
    pub(super) layers: Option<u64>,
    pub(super) integrator: IntegratorChoice,
    pub(super) courant: f64,
}

/// The defaults of a preset.
pub(super) fn defaults(preset: Preset) -> Defaults {
    let recommended = Defaults {
        smoothing_ratio: 1.3,
        kernel: KernelChoice::WendlandC2,
        artificial_viscosity: (0.01, 1.0),
        diffusion: DiffusionKind::Hydrostatic,
        diffusion_coefficient: 0.1,
        reinitialisation_every: 0,
        walls: WallKind::Extrapolated,
        layers: None,
        integrator: IntegratorChoice::LeapFrog,
        courant: 0.2,
    };
    match preset {
        Preset::Default => recommended,
        Preset::Paper => Defaults {
            smoothing_ratio: 1.0,
            diffusion: DiffusionKind::PartialDensity,
            reinitialisation_every: 20,
            walls: WallKind::Dynamic,
            layers: Some(3),
            courant: 0.3,
            ..recommended
        },
    }
}
