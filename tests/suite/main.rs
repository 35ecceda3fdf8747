//! Integration tests, one binary.

mod kernels;
mod lattice_sums;
mod neighbours;
