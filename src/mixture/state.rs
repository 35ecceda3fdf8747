//! What a mixture has to remember to go on with the same bits.

use super::Mixture;
use super::constituent::Constituent;
use super::fields::{EvolvingFraction, Fields, Rates};
use super::hourglass::ElasticHold;
use super::phase::Phase;
use crate::budget::Exchange;
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::Real;
use crate::space::Vector;

/// Every per-particle array of a phase.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct PhaseState<T: Real, const D: usize, M> {
    id: Vec<u32>,
    body: Vec<u16>,
    position: Vec<Vector<T, D>>,
    mass: Vec<T>,
    volume_fraction: Vec<T>,
    evolving_fraction: Option<EvolvingFraction<T>>,
    hold: ElasticHold<T, D>,
    pressure: Vec<T>,
    now: Fields<T, D, M>,
    half: Fields<T, D, M>,
    rate: Rates<T, D, M>,
    wall_acceleration: Vec<Vector<T, D>>,
    next_id: u32,
}

impl<T: Real, const D: usize, M> PhaseState<T, D, M> {
    fn len(&self) -> usize {
        self.position.len()
    }
}

/// The state of a constituent between two steps.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct ConstituentState<T: Real, const D: usize, M> {
    phase: PhaseState<T, D, M>,
    /// Where the particles were when their neighbours were listed: the list follows from it.
    listed: Vec<Vector<T, D>>,
    exchange_rate: Exchange<D>,
    fastest_acceleration: T,
}

/// The state of a [`Mixture`] between two steps, without what has to be set up again: kernel, law,
/// walls and their motion, forces, numerics, search.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MixtureState<T: Real, const D: usize, S, F> {
    time: f64,
    soil: ConstituentState<T, D, S>,
    water: ConstituentState<T, D, F>,
    exchanged: [Exchange<D>; 2],
    /// How fast the fastest pair is dragged \[1/s\].
    fastest_drag: T,
    /// Where the particles were when those of the other constituent were listed, and their shifts.
    across: (Vec<Vector<T, D>>, Vec<Vector<T, D>>),
    /// Accelerations of soil and water without drag, where that is solved over the step.
    #[cfg(feature = "implicit")]
    without_drag: [Vec<Vector<T, D>>; 2],
    started: bool,
}

impl<T: Real, const D: usize, S, F> MixtureState<T, D, S, F> {
    /// Time \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }
}

impl<T: Real, const D: usize, M: Material<T>> Phase<T, D, M> {
    fn state(&self) -> PhaseState<T, D, M::Memory> {
        PhaseState {
            id: self.id.clone(),
            body: self.body.clone(),
            position: self.position.clone(),
            mass: self.mass.clone(),
            volume_fraction: self.volume_fraction.clone(),
            evolving_fraction: self.evolving_fraction.clone(),
            hold: self.hold.clone(),
            pressure: self.pressure.clone(),
            now: self.now.clone(),
            half: self.half.clone(),
            rate: self.rate.clone(),
            wall_acceleration: self.wall_acceleration.clone(),
            next_id: self.next_id,
        }
    }

    /// Whether `state` is of as many particles and walls, unless some may come or go, else what is wrong with
    /// it.
    fn fits(&self, state: &PhaseState<T, D, M::Memory>, is_open: bool) -> Result<(), ParameterError> {
        let count = if is_open { state.len() } else { self.len() };
        let [now, half, rate] = state.hold.lengths(count);
        let lengths = [
            state.id.len(),
            state.body.len(),
            state.position.len(),
            state.mass.len(),
            state.volume_fraction.len(),
            state.evolving_fraction.as_ref().map_or(count, |fraction| fraction.half.len()),
            state.evolving_fraction.as_ref().map_or(count, |fraction| fraction.rate.len()),
            now,
            half,
            rate,
            state.pressure.len(),
            state.now.len(),
            state.half.len(),
            state.rate.len(),
            if state.rate.excess_before.is_empty() { count } else { state.rate.excess_before.len() },
        ];
        let walls = self.walls().len();
        let known = self.wall_particles() <= count
            && state.body.iter().take(self.wall_particles()).all(|&body| usize::from(body) < walls);
        if let Some(other) = lengths.into_iter().find(|&n| n != count) {
            return Err(ParameterError::new("particles in the state", other, "as many as in this mixture"));
        }
        if state.wall_acceleration.len() != self.wall_particles() || !known {
            let given = state.wall_acceleration.len();
            return Err(ParameterError::new(
                "wall particles in the state",
                given,
                "the walls of this mixture",
            ));
        }
        Ok(())
    }

    /// Takes over a state that fits.
    fn restore(&mut self, state: PhaseState<T, D, M::Memory>) {
        self.id = state.id;
        self.body = state.body;
        self.position = state.position;
        self.mass = state.mass;
        self.volume_fraction = state.volume_fraction;
        self.evolving_fraction = state.evolving_fraction;
        self.hold = state.hold;
        self.pressure = state.pressure;
        self.now = state.now;
        self.half = state.half;
        self.rate = state.rate;
        self.wall_acceleration = state.wall_acceleration;
        self.next_id = state.next_id;
        self.placed = false;
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    fn state(&self) -> ConstituentState<T, D, M::Memory> {
        ConstituentState {
            phase: self.phase.state(),
            listed: self.neighbourhood.reference_positions().to_vec(),
            exchange_rate: self.exchange_rate,
            fastest_acceleration: self.fastest_acceleration,
        }
    }

    /// Whether `state` is of as many particles and walls, unless some may come or go, else what is wrong with
    /// it.
    fn fits(&self, state: &ConstituentState<T, D, M::Memory>, is_open: bool) -> Result<(), ParameterError> {
        let listed = state.listed.len();
        if listed != 0 && listed != state.phase.len() {
            let allowed = "none, or as many as there are particles";
            return Err(ParameterError::new("listed particles in the state", listed, allowed));
        }
        self.phase.fits(&state.phase, is_open || self.phase.has_inflows())
    }

    /// Takes over a state that fits.
    fn restore(&mut self, state: ConstituentState<T, D, M::Memory>) {
        self.phase.restore(state.phase);
        if state.listed.is_empty() {
            self.neighbourhood.forget();
        } else {
            self.neighbourhood.rebuild(&state.listed, self.phase.wall_particles());
        }
        self.exchange_rate = state.exchange_rate;
        self.fastest_acceleration = state.fastest_acceleration;
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// What it has to remember.
    pub fn state(&self) -> MixtureState<T, D, S::Memory, F::Memory> {
        MixtureState {
            time: self.setting.time,
            soil: self.soil.state(),
            water: self.water.state(),
            exchanged: self.exchanged,
            fastest_drag: self.coupling.drag.fastest,
            across: self.coupling.across.listed(),
            #[cfg(feature = "implicit")]
            without_drag: self.implicit_drag.without.clone(),
            started: self.started,
        }
    }

    /// Goes back to a state of a mixture set up the same way; what follows has the same bits.
    ///
    /// # Errors
    /// The state is of another number of particles or walls; nothing is changed then.
    pub fn restore(&mut self, state: MixtureState<T, D, S::Memory, F::Memory>) -> Result<(), ParameterError> {
        let is_open = !self.setting.outlets.is_empty();
        self.soil.fits(&state.soil, is_open)?;
        self.water.fits(&state.water, is_open)?;
        self.soil.restore(state.soil);
        self.water.restore(state.water);
        self.setting.time = state.time;
        self.exchanged = state.exchanged;
        self.coupling.drag.fastest = state.fastest_drag;
        let sorted = [self.soil.neighbourhood.rebuilds(), self.water.neighbourhood.rebuilds()];
        self.coupling.across.list_again(state.across, self.soil.phase.len(), sorted);
        #[cfg(feature = "implicit")]
        self.implicit_drag.restore(state.without_drag);
        self.started = state.started;
        Ok(())
    }
}
