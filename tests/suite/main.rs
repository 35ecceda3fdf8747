//! Integration tests, one binary.

#[cfg(feature = "case")]
mod case;
#[cfg(feature = "case")]
mod case_build;
mod kernels;
mod lattice_sums;
mod neighbours;
mod output;
#[cfg(feature = "cli")]
mod program;
