//! A run at rest: everything it needs to go on with the same bits.

use crate::budget::Exchange;
use crate::error::ParameterError;
use crate::mixture::PhaseState;
use crate::real::Real;
use crate::simulation::Step;

/// A run between two steps, without what the program that resumes it has to set up again: kernel,
/// law, walls and their motion, forces, numerics, search.
///
/// With the feature `serde` it can be written in any format. Take it with
/// [`Simulation::snapshot`](crate::simulation::Simulation::snapshot), put it back with
/// [`Simulation::restore`](crate::simulation::Simulation::restore).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: serde::Serialize, M: serde::Serialize, I: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, M: serde::Deserialize<'de>, I: serde::Deserialize<'de>"
    ))
)]
pub struct Snapshot<T: Real, const D: usize, M, I> {
    pub(crate) mixture: MixtureState<T, D, M>,
    pub(crate) integrator: I,
    pub(crate) steps: u64,
    pub(crate) last: Step,
}

impl<T: Real, const D: usize, M, I> Snapshot<T, D, M, I> {
    /// Time \[s\].
    pub fn time(&self) -> f64 {
        self.mixture.time
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.steps
    }
}

/// The state of a mixture.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "T: serde::Serialize, M: serde::Serialize",
        deserialize = "T: serde::Deserialize<'de>, M: serde::Deserialize<'de>"
    ))
)]
pub(crate) struct MixtureState<T: Real, const D: usize, M> {
    pub(crate) time: f64,
    pub(crate) water: PhaseState<T, D, M>,
    /// Where the particles were when the neighbour list was built: the list follows from it.
    pub(crate) listed: Vec<crate::space::Vector<T, D>>,
    pub(crate) exchanged: [Exchange<D>; 2],
    pub(crate) exchange_rate: Exchange<D>,
    pub(crate) fastest_acceleration: T,
}

/// A snapshot does not belong to the simulation it is put into.
pub(crate) fn mismatch(what: &'static str, given: usize, allowed: &'static str) -> ParameterError {
    ParameterError::new(what, given, allowed)
}
