//! A run between two steps: everything it needs to go on with the same bits.

use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::mixture::MixtureState;
use crate::real::Real;
use crate::simulation::{Simulation, Step};
use crate::time::Integrator;

/// The state of a [`Simulation`], without what has to be set up again (see
/// [`MixtureState`]). With the feature `serde` it can be written in any format.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Snapshot<T: Real, const D: usize, S, F, I> {
    mixture: MixtureState<T, D, S, F>,
    integrator: I,
    steps: u64,
    last: Step,
    started: bool,
}

impl<T: Real, const D: usize, S, F, I> Snapshot<T, D, S, F, I> {
    /// Time \[s\].
    pub fn time(&self) -> f64 {
        self.mixture.time()
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.steps
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>, I: Integrator<T>>
    Simulation<T, D, K, S, F, I>
{
    /// The run as it is now.
    pub fn snapshot(&self) -> Snapshot<T, D, S::Memory, F::Memory, I> {
        Snapshot {
            mixture: self.mixture.state(),
            integrator: self.integrator.clone(),
            steps: self.steps,
            last: self.last,
            started: self.started,
        }
    }

    /// Goes back to a snapshot of a run set up the same way; what follows has the same bits.
    ///
    /// # Errors
    /// The snapshot is of another number of particles or walls.
    pub fn restore(
        &mut self,
        snapshot: Snapshot<T, D, S::Memory, F::Memory, I>,
    ) -> Result<(), ParameterError> {
        self.mixture.restore(snapshot.mixture)?;
        self.integrator = snapshot.integrator;
        self.steps = snapshot.steps;
        self.last = snapshot.last;
        self.started = snapshot.started;
        Ok(())
    }
}
