//! Case files: strict TOML, SI units in the keys, every mistake shown where it stands.
//!
//! ```
//! use alluvium::case::Case;
//! let (case, warnings) = Case::parse("drop.toml", r#"
//!     name = "drop"
//!     end_time_s = 0.1
//!     particles.spacing_m = 0.01
//!     [[water.block]]
//!     low_m = [0.0, 0.0]
//!     high_m = [0.2, 0.2]
//! "#).map_err(|error| error.to_string())?;
//! assert_eq!(case.water_particles(), 400);
//! assert!(warnings.problems.is_empty());
//! // Written with every default resolved, it is the same case again.
//! assert_eq!(Case::parse("case.used.toml", &case.to_string()).unwrap().0, case);
//! # Ok::<(), String>(())
//! ```
//! `docs/case-format.md` lists every key. [`OwnPath`] reads a path of strain and stress in the same way.

mod bounds;
mod build;
mod check;
mod choice;
mod legs;
mod model;
mod objection;
mod plan;
mod preset;
mod problem;
mod read;
mod reader;
mod section;
mod write;

pub use crate::mixture::Slip;
pub use crate::preset::Preset;
pub use build::{BuildError, CaseSimulation, SoilLaw};
pub use choice::{
    Axis, Choice, Component, DiffusionKind, DragKind, Field, InitialPressure, InitialStress,
    IntegratorChoice, KernelChoice, Precision, Quantity, SchemeChoice, SearchChoice, Side, SlipChoice,
    SurfaceKind, WallKind,
};
pub use legs::{OwnLeg, OwnPath};
pub use model::{
    Block, Case, Drag, Dumps, Frictional, Gauge, Inflow, InterphaseKernel, Mixing, MovingWall, Neighbours,
    Output, Particles, Region, Seepage, Shape, Soil, SoilBody, StepSize, Stiffness, Strength, Tank, Time,
    Walls, Water,
};
pub use objection::Objection;
pub use plan::{DragPlan, StepLimit};
pub use problem::{CaseError, Problem, Warnings};

impl Case {
    /// Reads a case from `text`; `file` is the name used in messages.
    ///
    /// # Errors
    /// Everything that is wrong with it: text that is not TOML, unknown or missing keys, wrong types,
    /// values out of range, parts that do not fit together.
    pub fn parse(file: &str, text: &str) -> Result<(Self, Warnings), CaseError> {
        let reader = reader::Reader::new(text);
        let case = reader.with_root(|root| read::case(&reader, root));
        if let (Some(case), false) = (&case, reader.has_errors()) {
            check::check(&reader, case);
        }
        let (errors, warnings) = reader.finish();
        let file = file.to_owned();
        match case {
            Some(case) if errors.is_empty() => Ok((case, Warnings { file, problems: warnings })),
            _ => Err(CaseError { file, problems: errors }),
        }
    }
}
