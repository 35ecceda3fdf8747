//! Studies ready made, for a kernel, a law, a search, an integrator or a law of drag of your own.
//!
//! Each function takes a name and the thing, and gives studies whose names begin with that name. Hand
//! them to [`all`](super::all) in a test, or run them with their mutants in a program.
//!
//! ```
//! use alluvium::verify::{all, ready};
//! # use alluvium::{kernel::WendlandC2, material::{Ergun, Water}, neighbours::CellList, time::LeapFrog};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! all(ready::kernel::<f64, 2, _>("mine", WendlandC2::new(0.013)?))?;
//! all(ready::law("mine", Water::new(1000.0, 25.0)?))?;
//! all(ready::search::<f64, 2>("mine", || Box::new(CellList::default())))?;
//! all(ready::integrator::<f64, _>("mine", LeapFrog::new))?;
//! all(ready::drag::<f64, _>("mine", Ergun::new(1e-3, 1e-3)?))?;
//! # Ok(()) }
//! ```
//!
//! What one of them claims and yours does not want, leave out by name:
//! `studies.retain(|study| !study.name.ends_with("/rate"))`.

mod drag;
mod drag_pairs;
mod integrator;
mod kernel;
mod law;
mod law_energy;
mod law_states;
mod search;

pub use drag::drag;
pub use integrator::integrator;
pub use kernel::{kernel, kernel_shape};
pub use law::law;
pub use search::search;

use crate::real::Real;

/// What goes with the precision: of doubles, of singles.
fn by_precision<T: Real, X>(double: X, single: X) -> X {
    if T::EPSILON.as_f64() < 1e-10 { double } else { single }
}

/// The largest number; NaN if any is.
fn worst(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |worst, x| if x.is_nan() || x > worst { x } else { worst })
}
