//! `[mixture]` and boxes.

use super::list;
use crate::case::choice::{Choice, DragKind};
use crate::case::model::{Drag, Mixing, Region, Seepage};
use core::fmt;

pub(super) fn mixing(f: &mut fmt::Formatter<'_>, mixing: &Mixing) -> fmt::Result {
    writeln!(f, "\n[mixture]\ncoupling = \"{}\"", mixing.coupling.word())?;
    writeln!(f, "density_relaxation_s = {:?}", mixing.relaxation_time)?;
    writeln!(f, "volume_fraction = \"{}\"", mixing.fraction.word())?;
    drag(f, &mixing.drag)?;
    writeln!(f, "drag_scheme = \"{}\"", mixing.drag_scheme)?;
    writeln!(f, "normalised_drag = {}", mixing.normalised_drag)?;
    writeln!(f, "projected_drag = {}", mixing.projected_drag)?;
    writeln!(f, "reconstructed_drag = {}", mixing.reconstructed_drag)
}

fn drag(f: &mut fmt::Formatter<'_>, drag: &Drag) -> fmt::Result {
    let kind = match drag {
        Drag::None => DragKind::None,
        Drag::Darcy(_) => DragKind::Darcy,
        Drag::GrainsOfCarman(_) | Drag::KozenyCarman { .. } => DragKind::KozenyCarman,
        Drag::Ergun(_) => DragKind::Ergun,
        Drag::Forchheimer { .. } => DragKind::Forchheimer,
    };
    writeln!(f, "drag = \"{kind}\"")?;
    match *drag {
        Drag::None => Ok(()),
        Drag::Darcy(seepage) => self::seepage(f, seepage),
        Drag::GrainsOfCarman(diameter) | Drag::Ergun(diameter) => {
            writeln!(f, "grain_diameter_m = {diameter:?}")
        }
        Drag::KozenyCarman { seepage, porosity } => {
            self::seepage(f, seepage)?;
            writeln!(f, "reference_porosity = {porosity:?}")
        }
        Drag::Forchheimer { seepage, coefficient } => {
            self::seepage(f, seepage)?;
            writeln!(f, "forchheimer_coefficient = {coefficient:?}")
        }
    }
}

fn seepage(f: &mut fmt::Formatter<'_>, seepage: Seepage) -> fmt::Result {
    match seepage {
        Seepage::Conductivity(k) => writeln!(f, "hydraulic_conductivity_m_per_s = {k:?}"),
        Seepage::Permeability(kappa) => writeln!(f, "intrinsic_permeability_m2 = {kappa:?}"),
    }
}

pub(super) fn region(f: &mut fmt::Formatter<'_>, table: &str, region: &Region) -> fmt::Result {
    writeln!(f, "\n{table}\nlow_m = {}\nhigh_m = {}", list(&region.low), list(&region.high))
}
