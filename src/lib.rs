//! Smoothed particle hydrodynamics of water, soil and their mixture.
#![deny(unsafe_op_in_unsafe_fn)]

#[cfg(feature = "case")]
pub mod case;
pub mod error;
pub mod kernel;
mod lanes;
pub mod neighbours;
pub mod output;
pub mod parallel;
pub mod real;
pub mod space;
pub mod summation;

pub use lanes::{InstructionSet, UnknownInstructionSet};
pub use real::{Num, Real};
pub use space::{SymTensor, Tensor, Vector};
