//! What an integrator advances, and the order all arrays of a phase are in.

use super::Phase;
use crate::material::Material;
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::Vector;

/// The fields an integrator advances, at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Fields<T: Real, const D: usize, M> {
    pub(crate) velocity: Vec<Vector<T, D>>,
    /// ρ/ρ̃₀ − φ: the partial density beyond its reference; kept instead of ρ so that `f32` does not
    /// lose the pressure. Of rigid grains, with φ at the start: they change φ itself.
    pub(crate) excess: Vec<T>,
    pub(crate) memory: Vec<M>,
}

/// Rates of change at the whole step.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Rates<T: Real, const D: usize, M> {
    /// \[m/s²\]; for wall particles what they would feel, kept as the reaction.
    pub(crate) acceleration: Vec<Vector<T, D>>,
    pub(crate) excess: Vec<T>,
    pub(crate) memory: Vec<M>,
    /// Those of the excess a prediction was made with last; none if the integrator does not ask for them, or
    /// particles have been added since.
    pub(crate) excess_before: Vec<T>,
}

/// What a volume fraction that evolves (69) needs beside its value now.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct EvolvingFraction<T> {
    pub(crate) half: Vec<T>,
    /// Dφ/Dt \[1/s\].
    pub(crate) rate: Vec<T>,
}

impl<T: Real, const D: usize, M> Fields<T, D, M> {
    /// Of no particle.
    pub(crate) fn none() -> Self {
        Self { velocity: Vec::new(), excess: Vec::new(), memory: Vec::new() }
    }
    /// Particles in every array; the smallest number where they differ.
    pub(crate) fn len(&self) -> usize {
        self.velocity.len().min(self.excess.len()).min(self.memory.len())
    }
}

impl<T: Real, const D: usize, M> Rates<T, D, M> {
    /// Of no particle.
    pub(crate) fn none() -> Self {
        Self { acceleration: Vec::new(), excess: Vec::new(), memory: Vec::new(), excess_before: Vec::new() }
    }
    /// Particles in every array; the smallest number where they differ.
    pub(crate) fn len(&self) -> usize {
        self.acceleration.len().min(self.excess.len()).min(self.memory.len())
    }
}

impl<T: Real, const D: usize, M: Material<T>> Phase<T, D, M> {
    /// Puts all arrays into another order: particle `order[k]` comes to place `k`. Who is not in the order,
    /// and no wall's, is gone; who is in it twice is there twice.
    pub(crate) fn permute(&mut self, order: &[u32]) {
        if self.deviator.len() == self.position.len() {
            permute(&mut self.deviator, order);
        }
        permute(&mut self.id, order);
        permute(&mut self.body, order);
        permute(&mut self.position, order);
        permute(&mut self.mass, order);
        permute(&mut self.volume_fraction, order);
        if let Some(fraction) = &mut self.evolving_fraction {
            permute(&mut fraction.half, order);
            permute(&mut fraction.rate, order);
        }
        for array in self.hold.arrays() {
            permute(array, order);
        }
        permute(&mut self.pressure, order);
        permute(&mut self.rate.acceleration, order);
        permute(&mut self.rate.excess, order);
        permute(&mut self.rate.memory, order);
        permute(&mut self.rate.excess_before, order);
        permute(&mut self.wall_acceleration, &order[..self.wall_particles]);
        for fields in [&mut self.now, &mut self.half] {
            permute(&mut fields.velocity, order);
            permute(&mut fields.excess, order);
            permute(&mut fields.memory, order);
        }
    }
}

fn permute<X: Copy + Send + Sync>(array: &mut Vec<X>, order: &[u32]) {
    let Some(&any) = array.first() else { return };
    if size_of::<X>() == 0 {
        array.resize(order.len(), any);
    } else {
        let mut sorted = vec![any; order.len()];
        parallel::for_each_part(&mut sorted, 1, CHUNK, &|first, part: &mut [X]| {
            for (x, &i) in part.iter_mut().zip(&order[first..]) {
                *x = array[i as usize];
            }
        });
        *array = sorted;
    }
}
