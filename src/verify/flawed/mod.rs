//! Kernels, searches and laws with one deliberate mistake, for mutants.

mod kernel;
mod law;
mod search;

pub use kernel::Flawed;
pub(super) use law::{Mistake, MistakenLaw};
pub use search::ShortSighted;
