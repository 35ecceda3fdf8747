//! Integration tests, one binary.

#[cfg(feature = "case")]
mod case;
mod kernels;
mod lattice_sums;
mod neighbours;
mod output;
