//! Smoothed particle hydrodynamics of water, soil and their mixture.
#![deny(unsafe_op_in_unsafe_fn)]

pub mod budget;
pub mod error;
pub mod kernel;
mod lanes;
pub mod material;
pub mod mixture;
pub mod neighbours;
pub mod parallel;
pub mod preset;
pub mod real;
pub mod setup;
pub mod simulation;
pub mod space;
pub mod summation;
pub mod time;
#[cfg(feature = "verify")]
pub mod verify;

pub use lanes::{InstructionSet, UnknownInstructionSet};
pub use preset::Preset;
pub use real::{Num, Real};
pub use space::{SymTensor, Tensor, Vector};
