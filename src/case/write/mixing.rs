//! `[mixture]` and boxes.

use super::list;
use crate::case::choice::{Choice, DragKind};
use crate::case::model::{Drag, Mixing, Region};
use core::fmt;

pub(super) fn mixing(f: &mut fmt::Formatter<'_>, mixing: &Mixing) -> fmt::Result {
    writeln!(f, "\n[mixture]\ncoupling = \"{}\"", mixing.coupling.word())?;
    writeln!(f, "density_relaxation_s = {:?}", mixing.relaxation_time)?;
    match mixing.drag {
        Drag::None => writeln!(f, "drag = \"{}\"", DragKind::None),
        Drag::Darcy { conductivity } => {
            writeln!(f, "drag = \"{}\"\nhydraulic_conductivity_m_per_s = {conductivity:?}", DragKind::Darcy)
        }
    }
}

pub(super) fn region(f: &mut fmt::Formatter<'_>, table: &str, region: &Region) -> fmt::Result {
    writeln!(f, "\n{table}\nlow_m = {}\nhigh_m = {}", list(&region.low), list(&region.high))
}
