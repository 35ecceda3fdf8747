//! Fields at any place: what a gauge reads.

use super::Mixture;
use super::constituent::Constituent;
use super::setting::Setting;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;

/// Shepard means of a constituent around a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe<T, const D: usize> {
    /// `Σ V W` \[-\]: how much of the kernel it fills; the means are worth little below ½.
    pub support: T,
    /// Pressure \[Pa\]; 0 without support.
    pub pressure: T,
    /// Velocity \[m/s\]; 0 without support.
    pub velocity: Vector<T, D>,
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    fn probe<K: Kernel<T, D>>(&self, setting: &Setting<T, D, K>, place: &Vector<T, D>) -> Probe<T, D> {
        let phase = &self.phase;
        let mut probe = Probe { support: T::ZERO, pressure: T::ZERO, velocity: Vector::zero() };
        if self.neighbourhood.particles() != phase.len() {
            return probe; // nothing has been evaluated yet
        }
        self.neighbourhood.for_each_near(&phase.position, place, |j, _, r2: T| {
            if j >= phase.wall_particles() {
                let weight = phase.volume(j) * setting.kernel.value(r2);
                probe.support += weight;
                probe.pressure += weight * phase.pressure[j];
                probe.velocity += phase.now.velocity[j] * weight;
            }
        });
        if probe.support > T::ZERO {
            let scale = T::ONE / probe.support;
            probe.pressure *= scale;
            probe.velocity *= scale;
        }
        probe
    }

    fn surface<K: Kernel<T, D>>(
        &self,
        setting: &Setting<T, D, K>,
        place: &Vector<T, D>,
        up: usize,
    ) -> Option<T> {
        let (phase, h) = (&self.phase, setting.kernel.smoothing_length());
        let periodic = self.neighbourhood.periodic();
        let beside = |x: &Vector<T, D>| {
            let mut away = periodic.difference(*x, *place);
            away[up] = T::ZERO;
            away.norm2() < h * h
        };
        let near = (phase.wall_particles()..phase.len()).filter(|&i| beside(&phase.position[i]));
        near.map(|i| phase.position[i][up] + half_spacing::<T, D>(phase.volume(i))).reduce(Num::max)
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// Pressure and velocity of the water at `place` \[m\], walls left out, as of the last evaluation.
    pub fn probe(&self, place: &Vector<T, D>) -> Probe<T, D> {
        self.water.probe(&self.setting, place)
    }

    /// Pressure and velocity of the soil at `place` \[m\], walls left out, as of the last evaluation.
    pub fn probe_soil(&self, place: &Vector<T, D>) -> Probe<T, D> {
        self.soil.probe(&self.setting, place)
    }

    /// Height of the water along axis `up` \[m\] near `place`: the highest particle at less than h beside
    /// it, and half its spacing; `None` where there is none.
    pub fn surface(&self, place: &Vector<T, D>, up: usize) -> Option<T> {
        self.water.surface(&self.setting, place, up)
    }

    /// Height of the soil along axis `up` \[m\] near `place`, as [`surface`](Self::surface).
    pub fn soil_surface(&self, place: &Vector<T, D>, up: usize) -> Option<T> {
        self.soil.surface(&self.setting, place, up)
    }
}

fn half_spacing<T: Real, const D: usize>(volume: T) -> T {
    T::of(0.5) * volume.powf(T::of(1.0 / D as f64))
}
