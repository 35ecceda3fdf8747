//! Integration tests, one binary.

mod determinism;
mod forensics;
mod integrators;
mod outside;
mod tank;
mod walls;
