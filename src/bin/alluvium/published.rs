//! Published data, part of the program.

use alluvium::output::{Table, TableError};

/// Martin & Moyce 1952, front of a column twice as high as wide: T = t √(2g/L), X = x/L.
pub const MARTIN_MOYCE: &str = include_str!("../../../verification/data/martin_moyce_1952_n2eq2_front.csv");
/// Koshizuka & Oka 1996, experiment.
pub const KOSHIZUKA_OKA: &str = include_str!("../../../verification/data/koshizuka_oka_1996_experiment.csv");
/// Koshizuka & Oka 1996, their moving-particle computation.
pub const KOSHIZUKA_OKA_MPS: &str = include_str!("../../../verification/data/koshizuka_oka_1996_mps.csv");
/// Finite-volume reference of the dam break: horizontal velocity at t = 0.2 s.
#[expect(dead_code, reason = "the convergence study will read it")]
pub const VOLUME_OF_FLUID: &str = include_str!("../../../verification/data/dam_break_vof_u_t0.200.csv");

/// Two columns of a table, as points.
pub fn points(table: &Table, x: &str, y: &str) -> Result<Vec<(f64, f64)>, TableError> {
    Ok(table.column(x)?.into_iter().zip(table.column(y)?).collect())
}
