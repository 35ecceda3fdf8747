//! Smoothed particle hydrodynamics of water, soil and their mixture: verified, generic over precision
//! (`f32`, `f64`) and dimension (2, 3), and the same to the last bit on any number of threads.
//!
//! > A mixture is two phases; a phase is particles plus a law; a law turns deformation into stress; a
//! > sum turns neighbours into derivatives; time knows four verbs.
//!
//! The method is that of Wang, Wang, Peng & Meng (2016), *J. Hydraul. Eng.*,
//! [10.1061/(ASCE)HY.1943-7900.0001163](https://doi.org/10.1061/(ASCE)HY.1943-7900.0001163); numbers in
//! brackets such as (58) are its equations. For water, continuity (52) and momentum (58) are
//!
//! $$\frac{D\rho_i}{Dt} = \sum_j m_j\,\mathbf v_{ij}\cdot\nabla_i W_{ij} + \delta h c \sum_j
//! \boldsymbol\psi_{ij}\cdot\nabla_i W_{ij}\,\frac{m_j}{\rho_j},$$
//!
//! $$\frac{D\mathbf v_i}{Dt} = -\sum_j m_j\left(\frac{p_i\phi_i}{\rho_i^2}+\frac{p_j\phi_j}{\rho_j^2}
//! +\Pi_{ij}\right)\nabla_i W_{ij} + \sum_j m_j\left(\frac{\phi_i\boldsymbol\tau_i}{\rho_i^2}
//! +\frac{\phi_j\boldsymbol\tau_j}{\rho_j^2}\right)\cdot\nabla_i W_{ij} + \mathbf g .$$
//!
//! and for soil the same with the stress of its skeleton ([`material::Soil`]).
//!
//! # A dam break
//!
//! ```
//! use alluvium::{Preset, Vector, kernel::WendlandC2, material::Water, mixture::{Mixture, Phase}, setup};
//! use alluvium::{simulation::Simulation, time::StepSize};
//! use std::ops::ControlFlow;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let (dx, preset) = (0.01, Preset::Default);
//! let still = setup::hydrostatic(1000.0, 9.81, 1, 0.2);
//! let mut water = Phase::new(Water::new(1000.0, 25.0)?);
//! let walls = setup::tank([0.0, 0.0], [0.4, 0.4], dx, 3, [(true, true), (true, false)]);
//! water.add_wall(preset.wall(), &walls, dx * dx, &still)?;
//! water.add(&setup::fill([0.0, 0.0], [0.1, 0.2], dx), dx * dx, &still)?;
//! let kernel = WendlandC2::new(preset.smoothing_ratio() * dx)?;
//! let mixture = preset.apply(Mixture::<f64, 2>::of_water(kernel, water)).with_gravity(Vector([0.0, -9.81]));
//! let mut run = Simulation::new(mixture, preset.leap_frog(), StepSize::courant(preset.courant())?);
//! let _ = run.run_until(0.1, |_| ControlFlow::Continue(()))?;
//! let front = run.mixture().water().positions().iter().filter(|x| x[1] > 0.0 && x[0] < 0.4);
//! assert!((0.16..0.21).contains(&front.map(|x| x[0]).fold(0.0, f64::max)));
//! # Ok(()) }
//! ```
//!
//! # Map
//!
//! | module | what |
//! |---|---|
//! | [`real`], [`space`] | numbers or their SIMD lanes; vectors and tensors |
//! | [`kernel`], [`neighbours`], [`summation`] | W and its slope; who is near whom; sums for values and derivatives |
//! | [`material`] | laws: water; soil and its yield surfaces |
//! | [`driver`] | a law driven along a path of strain and stress, without particles |
//! | [`time`] | the four verbs, integrators, step size |
//! | [`mixture`] | phases, walls, the equations of a step, forensics |
//! | [`setup`], [`preset`] | where particles start; the paper's numerical choices and the library's |
//! | [`simulation`], [`budget`] | the driver; where mass, momentum and energy are |
//! | [`output`], `case` | files for ParaView and tables; case files in TOML |
//! | [`parallel`], [`error`] | threads; what can go wrong |
//! | `verify` | studies with expectations and mutants, for this library and for yours |
//!
//! Kernels, searches, laws, integrators, wall motions, body forces and onlookers can be your own: each is
//! one trait or closure, and `docs/extending.md` in the repository has a recipe for each.
//!
//! # Units and signs
//!
//! SI; in two dimensions everything is per metre of depth, and strain is plane. Pressure is positive in
//! compression, stress in tension. Gravity is a vector. `density` is mass per volume of mixture,
//! `true_density` per volume of the constituent itself.
//!
//! # Features
//!
//! | feature | default | what |
//! |---|---|---|
//! | `rayon` | yes | several threads; the bits of the result stay |
//! | `kd-tree` | | the kd-tree of kiddo as a neighbour search |
//! | `implicit` | | drag between soil and water solved over the step: any conductivity at the step sound allows |
//! | `serde` | | serialisable parameters and states |
//! | `verify` | | the module `verify` |
//! | `case` | | the module `case`: strict case files |
//! | `cli` | | the program `alluvium` |
//!
//! SIMD instructions are detected at run time and need no feature.
#![deny(unsafe_op_in_unsafe_fn)]

pub mod budget;
#[cfg(feature = "case")]
pub mod case;
pub mod driver;
pub mod error;
pub mod kernel;
mod lanes;
pub mod material;
pub mod mixture;
pub mod neighbours;
pub mod output;
pub mod parallel;
pub mod preset;
pub mod real;
pub mod setup;
pub mod simulation;
pub mod snapshot;
pub mod space;
pub mod summation;
pub mod time;
#[cfg(feature = "verify")]
pub mod verify;

pub use lanes::{InstructionSet, UnknownInstructionSet};
pub use preset::Preset;
pub use real::{Num, Real};
pub use space::{SymTensor, Tensor, Vector};

/// The code in the documents is compiled and run.
#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../README.md")]
    struct Readme;
    #[cfg(feature = "verify")]
    #[doc = include_str!("../docs/extending.md")]
    struct Extending;
}
