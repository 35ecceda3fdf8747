//! What acts on one constituent alone, from outside: sources that make a chosen motion exact.

use super::Mixture;
use super::constituent::Constituent;
use super::setting::Setting;
use crate::kernel::Kernel;
use crate::material::{Material, Memory};
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::Vector;
use std::sync::Arc;

/// What is given to the particles of one constituent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source<T: Real, const D: usize, X> {
    /// Force per mass \[m/s²\].
    pub acceleration: Vector<T, D>,
    /// Added to the rate of what the law remembers, such as stress \[Pa/s\].
    pub memory: X,
}

/// A source as a function of place \[m\] and time \[s\].
pub(super) type SourceField<T, const D: usize, X> =
    Arc<dyn Fn(&Vector<T, D>, f64) -> Source<T, D, X> + Send + Sync>;

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// Gives this to the soil alone, beside gravity and the force on both; its work, that on the law's memory
    /// included, is booked as external.
    pub fn with_soil_source(
        mut self,
        source: impl Fn(&Vector<T, D>, f64) -> Source<T, D, S::Memory> + Send + Sync + 'static,
    ) -> Self {
        self.soil.source = Some(Arc::new(source));
        self
    }

    /// The same for the water.
    pub fn with_water_source(
        mut self,
        source: impl Fn(&Vector<T, D>, f64) -> Source<T, D, F::Memory> + Send + Sync + 'static,
    ) -> Self {
        self.water.source = Some(Arc::new(source));
        self
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Adds the source to the rates of all particles that are no wall's.
    pub(super) fn add_source<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let Some(source) = &self.source else { return };
        let (walls, time) = (self.phase.wall_particles(), setting.time);
        let (positions, rate) = (&self.phase.position, &mut self.phase.rate);
        let mut given =
            vec![Source { acceleration: Vector::zero(), memory: M::Memory::default() }; positions.len()];
        parallel::for_each_part(&mut given, 1, CHUNK, &|first, part: &mut [Source<T, D, M::Memory>]| {
            for (k, given) in part.iter_mut().enumerate().skip(walls.saturating_sub(first)) {
                *given = source(&positions[first + k], time);
            }
        });
        for (a, given) in rate.acceleration.iter_mut().zip(&given) {
            *a += given.acceleration;
        }
        for (memory, given) in rate.memory.iter_mut().zip(&given) {
            *memory = memory.advanced(given.memory, T::ONE);
        }
    }

    /// What the source gives to the kinetic and the stored energy of particle `i` \[W\], and its force \[N\].
    pub(super) fn given_by_source(&self, i: usize, time: f64) -> (f64, Vector<f64, D>) {
        let Some(source) = &self.source else { return (0.0, Vector::zero()) };
        let phase = &self.phase;
        let given = source(&phase.position[i], time);
        let mass = phase.mass[i].as_f64();
        let stored = |dt: T| {
            let memory = phase.now.memory[i].advanced(given.memory, dt);
            phase.material().stored_energy(phase.compression(i), &memory)
        };
        // A law that stores the square of its memory has its derivative in this for any length.
        let dt = T::of(STEP);
        let storing = (stored(dt) - stored(-dt)) / (2.0 * dt.as_f64());
        let work = given.acceleration.dot(phase.now.velocity[i]).as_f64();
        (mass * (work + storing), Vector(given.acceleration.as_f64()) * mass)
    }
}

/// Of the difference that gives the rate of stored energy \[s\]: a power of two, near which neither rounding nor
/// the difference's own error is felt.
const STEP: f64 = 1.0 / 1024.0;
