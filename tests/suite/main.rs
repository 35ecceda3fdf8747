//! Integration tests, one binary.

mod admissible;
#[cfg(feature = "case")]
mod case;
#[cfg(feature = "case")]
mod case_build;
#[cfg(feature = "case")]
mod case_mixture;
#[cfg(feature = "case")]
mod case_plan;
#[cfg(feature = "case")]
mod case_soil;
#[cfg(feature = "case")]
mod case_soil_build;
mod cavitation;
#[cfg(feature = "implicit")]
mod coupled_bits;
mod determinism;
mod drag_laws;
mod drag_limit;
#[cfg(feature = "cli")]
mod drive;
#[cfg(feature = "cli")]
mod drive_own;
mod errata;
mod fingerprint;
mod forensics;
mod from_outside;
mod hourglass;
#[cfg(feature = "implicit")]
mod implicit_drag;
mod integrators;
mod interphase_kernel;
mod kernels;
mod lane_code;
mod lattice_sums;
mod layers;
mod links;
mod mixture;
mod neighbours;
mod openings;
mod output;
mod outside;
mod pore_limit;
#[cfg(feature = "cli")]
mod program;
mod register;
mod restart;
mod soil;
mod soil_law;
mod source;
mod summed_fraction;
mod tank;
mod walls;
mod water_bits;
mod water_law;
mod yield_surfaces;
