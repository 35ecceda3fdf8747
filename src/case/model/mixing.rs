//! What is between soil and water in a case, and where particles come and go.

use super::Drag;
use crate::case::choice::SchemeChoice;
use crate::mixture::{CouplingForm, VolumeFraction};

/// What is between soil and water.
#[derive(Clone, Debug, PartialEq)]
pub struct Mixing {
    /// How pore pressure acts.
    pub coupling: CouplingForm,
    /// Time in which the water's density relaxes to the volume its particles take \[s\]; 0 is never.
    pub relaxation_time: f64,
    /// How the water's volume fraction follows the soil.
    pub fraction: VolumeFraction,
    /// How they drag each other.
    pub drag: Drag,
    /// How drag goes through a time step.
    pub drag_scheme: SchemeChoice,
    /// Whether the weights of drag add up to one around each soil particle.
    pub normalised_drag: bool,
    /// Whether drag acts along the line between the particles of a pair.
    pub projected_drag: bool,
    /// Whether drag is that of velocities reconstructed between the particles of a pair.
    pub reconstructed_drag: bool,
}

/// A box.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Lowest corner \[m\].
    pub low: Vec<f64>,
    /// Highest corner \[m\].
    pub high: Vec<f64>,
}

/// A box of water that moves towards its mouth, where it comes in.
#[derive(Clone, Debug, PartialEq)]
pub struct Inflow {
    /// The box.
    pub region: Region,
    /// Its velocity, along one axis \[m/s\].
    pub velocity: Vec<f64>,
}
