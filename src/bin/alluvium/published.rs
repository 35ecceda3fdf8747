//! Published data, part of the program.

use alluvium::output::{Table, TableError};
use alluvium::verify::Curve;
use alluvium::verify::dam_break::Reference;

/// Martin & Moyce 1952, front of a column twice as high as wide: T = t √(2g/L), X = x/L.
pub const MARTIN_MOYCE: &str = include_str!("../../../verification/data/martin_moyce_1952_n2eq2_front.csv");
/// Koshizuka & Oka 1996, experiment.
pub const KOSHIZUKA_OKA: &str = include_str!("../../../verification/data/koshizuka_oka_1996_experiment.csv");
/// Koshizuka & Oka 1996, their moving-particle computation.
pub const KOSHIZUKA_OKA_MPS: &str = include_str!("../../../verification/data/koshizuka_oka_1996_mps.csv");
/// Bui et al. 2008, final surface of a column of aluminium bars.
pub const BUI_SURFACE: &str = include_str!("../../../verification/data/bui_2008_surface.csv");
/// The same column's failure line.
pub const BUI_FAILURE_LINE: &str = include_str!("../../../verification/data/bui_2008_failure_line.csv");
/// Finite-volume reference of the dam break: horizontal velocity at t = 0.2 s.
const VOLUME_OF_FLUID: &str = include_str!("../../../verification/data/dam_break_vof_u_t0.200.csv");

/// Cells of the finite-volume reference \[m\].
const CELL: f64 = 0.001_25;

/// Two columns of a table, as a curve.
pub fn curve(text: &str, x: &str, y: &str) -> Result<Curve, TableError> {
    let table = Table::parse(text)?;
    Ok(Curve::new(table.column(x)?.into_iter().zip(table.column(y)?).collect()))
}

/// The finite-volume reference.
pub fn volume_of_fluid() -> Result<Reference, TableError> {
    let table = Table::parse(VOLUME_OF_FLUID)?;
    let [x, y, ux, uy] = ["x", "y", "ux", "uy"].map(|name| table.column(name));
    let (x, y, ux, uy) = (x?, y?, ux?, uy?);
    Ok(Reference::new((0..x.len()).map(|n| [x[n], y[n], ux[n], uy[n]]), CELL))
}
