//! Fields at any place: what a gauge reads.

use super::Mixture;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;

/// Shepard means of the water around a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe<T, const D: usize> {
    /// `Σ V W` \[-\]: how much of the kernel is filled with water; the means are worth little below ½.
    pub support: T,
    /// Pressure \[Pa\]; 0 without support.
    pub pressure: T,
    /// Velocity \[m/s\]; 0 without support.
    pub velocity: Vector<T, D>,
}

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    /// Pressure and velocity of the water at `place` \[m\], walls left out, as of the last evaluation.
    pub fn probe(&self, place: &Vector<T, D>) -> Probe<T, D> {
        let water = &self.water;
        let mut probe = Probe { support: T::ZERO, pressure: T::ZERO, velocity: Vector::zero() };
        if self.neighbourhood.particles() != water.len() {
            return probe; // nothing has been evaluated yet
        }
        self.neighbourhood.for_each_near(&water.position, place, |j, _, r2: T| {
            if j >= water.wall_particles() {
                let weight = water.volume(j) * self.kernel.value(r2);
                probe.support += weight;
                probe.pressure += weight * water.pressure[j];
                probe.velocity += water.now.velocity[j] * weight;
            }
        });
        if probe.support > T::ZERO {
            let scale = T::ONE / probe.support;
            probe.pressure *= scale;
            probe.velocity *= scale;
        }
        probe
    }

    /// Height of the water along axis `up` \[m\] near `place`: the highest particle at less than h beside
    /// it, and half its spacing; `None` where there is none.
    pub fn surface(&self, place: &Vector<T, D>, up: usize) -> Option<T> {
        let (water, h) = (&self.water, self.kernel.smoothing_length());
        let periodic = self.neighbourhood.periodic();
        let beside = |x: &Vector<T, D>| {
            let mut away = periodic.difference(*x, *place);
            away[up] = T::ZERO;
            away.norm2() < h * h
        };
        let near = (water.wall_particles()..water.len()).filter(|&i| beside(&water.position[i]));
        near.map(|i| water.position[i][up] + half_spacing::<T, D>(water.volume(i))).reduce(Num::max)
    }
}

fn half_spacing<T: Real, const D: usize>(volume: T) -> T {
    T::of(0.5) * volume.powf(T::of(1.0 / D as f64))
}
