//! Integration tests, one binary.

mod determinism;
mod forensics;
mod integrators;
mod kernels;
mod lattice_sums;
mod layers;
mod neighbours;
mod outside;
mod register;
mod tank;
mod walls;
