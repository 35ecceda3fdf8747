//! What is measured on a column of soil that collapses: surface, run-out, failure line, volume, rest.
//!
//! Every measure is one of a [`Pile`], the soil of an instant seen in a section; what has moved since the
//! start is found by the particles' numbers.

mod failure;
mod pile;
mod scaling;
#[cfg(test)]
mod tests;

pub use failure::FailureLine;
pub use pile::{Grain, Pile, Section};
pub use scaling::{RUN_OUT, ScalingLaw, run_out};

/// Width L₀ of the column against a wall \[m\] (Bui, Fukagawa, Sako & Ohno 2008; the paper, Table 2).
pub const WIDTH: f64 = 0.2;
/// Its height H₀ \[m\].
pub const HEIGHT: f64 = 0.1;
/// Friction angle θ of the aluminium bars of the experiment \[°\].
pub const FRICTION_ANGLE: f64 = 19.8;
/// Displacement \[m\] beyond which soil has failed.
pub const MOVED: f64 = 2.5e-3;
/// The surface is compared with the measured one up to here \[m\]; beyond, the bars lie one by one.
pub const COMPARED: f64 = 0.4;
