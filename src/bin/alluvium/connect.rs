//! From a case to a simulation of it.

use crate::outcome::Failure;
use crate::solver::Solver;
use alluvium::case::Case;

/// The simulation of a case, in its precision and dimension.
pub fn connect(case: &Case) -> Result<Box<dyn Solver + Send>, Failure> {
    Err(Failure::NotInThisBuild(format!("this build cannot simulate `{}` yet", case.name)))
}
