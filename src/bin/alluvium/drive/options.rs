//! What `alluvium drive` can be told.

use crate::arguments::PrecisionName;
use alluvium::material::{Cone, Plasticity};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Stress and strain are positive in tension and extension, confining stress in compression; z is axial.
#[derive(Args, Debug)]
#[command(allow_negative_numbers = true)]
pub struct DriveOptions {
    /// The path.
    #[arg(value_enum)]
    pub path: PathName,
    #[command(flatten)]
    pub law: LawOptions,
    #[command(flatten)]
    pub way: WayOptions,
    /// The numbers to compute in.
    #[arg(long, value_enum, default_value_t = PrecisionName::F64)]
    pub precision: PrecisionName,
    /// Write `path.csv` and `path.svg` into this folder instead of the table to standard output.
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
}

#[derive(Args, Debug)]
#[command(next_help_heading = "Law")]
pub struct LawOptions {
    /// Young's modulus E [Pa]; it or the bulk modulus.
    #[arg(
        long,
        value_name = "PA",
        required_unless_present = "bulk_modulus",
        conflicts_with = "bulk_modulus"
    )]
    pub youngs_modulus: Option<f64>,
    /// Bulk modulus K [Pa].
    #[arg(long, value_name = "PA")]
    pub bulk_modulus: Option<f64>,
    /// Poisson's ratio ν [-].
    #[arg(long, value_name = "RATIO", default_value_t = 0.3)]
    pub poissons_ratio: f64,
    /// Where elasticity ends.
    #[arg(long, value_enum, default_value_t = SurfaceName::DruckerPrager)]
    pub surface: SurfaceName,
    /// Friction angle θ [°] of Mohr and Coulomb.
    #[arg(long, value_name = "DEGREES")]
    pub friction_angle: Option<f64>,
    /// Dilatancy angle ψ [°], at most θ [default: 0].
    #[arg(long, value_name = "DEGREES")]
    pub dilatancy_angle: Option<f64>,
    /// Cohesion c [Pa] of Mohr and Coulomb [default: 0].
    #[arg(long, value_name = "PA")]
    pub cohesion: Option<f64>,
    /// Largest mean tension [Pa] of the cone of Drucker and Prager [default: that of its apex].
    #[arg(long, value_name = "PA")]
    pub tension_cut_off: Option<f64>,
    /// In which states the cone of Drucker and Prager meets the pyramid of Mohr and Coulomb [default:
    /// plane-strain].
    #[arg(long, value_enum)]
    pub cone: Option<ConeName>,
    /// How stress is kept on the surface [default: return-mapping].
    #[arg(long, value_enum)]
    pub plasticity: Option<PlasticityName>,
}

#[derive(Args, Debug)]
#[command(next_help_heading = "Path")]
pub struct WayOptions {
    /// Isotropic pressure at the start [Pa] [default: 100000].
    #[arg(long, value_name = "PA", conflicts_with = "start_stress")]
    pub confining_stress: Option<f64>,
    /// Stress at the start [Pa] instead: xx,yy,zz,xy,yz,xz, positive in tension.
    #[arg(long, value_name = "SIX", value_delimiter = ',', num_args = 1)]
    pub start_stress: Option<Vec<f64>>,
    /// How far to go [-]: shortening, lengthening, volume lost, or shear strain γ [default: 0.05].
    #[arg(long, value_name = "STRAIN")]
    pub strain: Option<f64>,
    /// How far to turn [°], from x towards y, on the path `rotation` [default: 45].
    #[arg(long, value_name = "DEGREES")]
    pub angle: Option<f64>,
    /// Increments of each way.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub steps: u32,
    /// Legs of the path `own`, in TOML; docs/case-format.md lists the keys.
    #[arg(long, value_name = "FILE")]
    pub legs: Option<PathBuf>,
    /// There, as far the other way, and back, so often; 0 is one way only [default: 0; 1 on the path
    /// `cyclic`].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub cycles: Option<u32>,
}

/// The paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PathName {
    /// Axial strain alone.
    Oedometer,
    /// Axial shortening under constant lateral stress.
    TriaxialCompression,
    /// Axial lengthening under constant lateral stress.
    TriaxialExtension,
    /// v_x = γ̇ y: turns as it shears.
    SimpleShear,
    /// The same strain without turning.
    PureShear,
    /// Equal normal strains.
    Isotropic,
    /// Turning about z without strain: give a stress to turn by --start-stress.
    Rotation,
    /// Simple shear to and fro.
    Cyclic,
    /// Legs of strain, stress or both from a file: give --legs.
    Own,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SurfaceName {
    /// A circular cone.
    DruckerPrager,
    /// A six-sided pyramid.
    MohrCoulomb,
    /// Nowhere.
    Elastic,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ConeName {
    /// At failure in plane strain, for θ and ψ together.
    PlaneStrain,
    /// The paper's (29): plane strain if ψ = θ.
    PlaneStrainAssociated,
    /// sin θ / 3: plane strain if ψ = 0.
    PlaneStrainNonDilatant,
    /// Axial compression.
    TriaxialCompression,
    /// Axial extension.
    TriaxialExtension,
}

impl ConeName {
    pub fn cone(self) -> Cone {
        match self {
            Self::PlaneStrain => Cone::PlaneStrain,
            Self::PlaneStrainAssociated => Cone::PlaneStrainAssociated,
            Self::PlaneStrainNonDilatant => Cone::PlaneStrainNonDilatant,
            Self::TriaxialCompression => Cone::TriaxialCompression,
            Self::TriaxialExtension => Cone::TriaxialExtension,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PlasticityName {
    /// Closest return to the surface after each increment.
    ReturnMapping,
    /// The paper's: a plastic multiplier in the rate, then scaling back.
    Rate,
    /// The same with F ≥ 0 to the letter: which steps flow is chance.
    LiteralRate,
}

impl PlasticityName {
    pub fn plasticity(self) -> Plasticity {
        match self {
            Self::ReturnMapping => Plasticity::ReturnMapping,
            Self::Rate => Plasticity::Rate,
            Self::LiteralRate => Plasticity::LiteralRate,
        }
    }
}
