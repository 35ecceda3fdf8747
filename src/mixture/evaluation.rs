//! The equations, one method each, in the order of [`Mixture`]'s evaluation.

use super::Mixture;
use super::continuity::{DensityDiffusion, PairDiffusion};
use super::momentum::Viscosity;
use super::own_pairs::{OwnPairs, sum};
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::{SymTensor, Vector};
use crate::summation::Sums;

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    /// Brings the neighbour lists up to date; now and then that re-sorts the particles.
    pub(super) fn find_neighbours(&mut self) {
        if !self.neighbourhood.is_stale(&self.water.position) {
            return;
        }
        let periodic = *self.neighbourhood.periodic();
        if periodic.is_any() {
            for x in &mut self.water.position {
                *x = periodic.wrap(*x);
            }
        }
        let walls = self.water.wall_particles();
        let order = self.neighbourhood.cell_order(&self.water.position, walls);
        self.water.permute(&order);
        self.neighbourhood.rebuild(&self.water.position, walls);
    }

    /// Pressure from density: (16), (20).
    pub(super) fn find_pressure(&mut self) {
        let mut pressures = core::mem::take(&mut self.water.pressure);
        let water = &self.water;
        parallel::for_each_part(&mut pressures, 1, CHUNK, &|first, part: &mut [T]| {
            let (fractions, memories) = (&water.volume_fraction[first..], &water.now.memory[first..]);
            let fields = water.now.excess[first..].iter().zip(fractions).zip(memories);
            for (p, ((&excess, &fraction), memory)) in part.iter_mut().zip(fields) {
                *p = water.material().pressure(excess / fraction, memory);
            }
        });
        self.water.pressure = pressures;
    }

    /// Continuity (52) and the phase's own part of momentum (58).
    pub(super) fn sum_own_pairs(&mut self) {
        if self.water.material().needs_velocity_gradient() {
            self.sum_own_pairs_with::<true>();
        } else {
            self.sum_own_pairs_with::<false>();
        }
        self.collect_rates();
    }

    fn sum_own_pairs_with<const STRESS: bool>(&mut self) {
        let h = self.kernel.smoothing_length();
        let material = self.water.material();
        let (c, reference) = (material.sound_speed(), material.reference_density());
        let formula = OwnPairs::<T, K, D, STRESS> {
            kernel: self.kernel.clone(),
            viscosity: Viscosity::new(self.viscosity, h, c),
            diffusion: PairDiffusion::new(
                self.diffusion,
                reference,
                material.hydrostatic_slope(),
                self.gravity,
            ),
        };
        let partial = matches!(self.diffusion, DensityDiffusion::PartialDensity(_));
        let water = &self.water;
        let (o, one) = (T::ZERO, T::ONE);
        // Density one keeps the division of (59) finite; volume zero takes the dummy out.
        let dummy: &[T] = if D == 2 { &[o, o, o, one] } else { &[o, o, o, o, one] };
        self.neighbourhood.pack::<OwnPairs<T, K, D, STRESS>>(
            &water.position,
            &mut self.scratch.records,
            dummy,
            &|i, record: &mut [T]| {
                let density = water.density(i);
                let volume = water.mass[i] / density;
                let pull = water.volume_fraction[i] / (density * density);
                record[..D].copy_from_slice(&water.now.velocity[i].0);
                record[D] = if water.is_gliding(i) { -volume } else { volume };
                record[D + 1] = density;
                record[D + 2] = water.pressure[i] * pull;
                record[D + 3] = if partial { density / reference } else { water.compression(i) };
                if STRESS {
                    let mut k = D + 4;
                    for a in 0..D {
                        for b in a..D {
                            record[k] = water.deviator[i].0[SymTensor::<T>::index(a, b)] * pull;
                            k += 1;
                        }
                    }
                }
            },
        );
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.sums);
    }

    /// Factor of `Σ V ψ·∇W/2ρ̃₀` in the rate of the excess: `2 δ h c`.
    pub(super) fn diffusivity(&self) -> T {
        let h = self.kernel.smoothing_length();
        T::of(2.0) * self.diffusion.coefficient() * h * self.water.material().sound_speed()
    }

    /// Turns the sums into rates.
    fn collect_rates(&mut self) {
        let factor = self.diffusivity();
        let inverse_reference = T::ONE / self.water.material().reference_density();
        let (sums, rate) = (&self.scratch.sums, &mut self.water.rate);
        let gravity = self.gravity;
        let walls = self.water.wall_acceleration.len();
        // Slice by slice, as the sums lie.
        parallel::for_each_part(&mut rate.acceleration, 1, CHUNK, &|first, part: &mut [Vector<T, D>]| {
            for (s, slice) in part.chunks_mut(T::SLICE).enumerate() {
                let begin = first + s * T::SLICE;
                let own: [&[T]; D] = core::array::from_fn(|axis| sums.lanes(begin / T::SLICE, axis));
                for (lane, a) in slice.iter_mut().enumerate() {
                    *a = Vector(own.map(|sum| sum[lane]));
                    if begin + lane >= walls {
                        *a += gravity;
                    }
                }
            }
        });
        parallel::for_each_part(&mut rate.excess, 1, CHUNK, &|first, part: &mut [T]| {
            for (s, slice) in part.chunks_mut(T::SLICE).enumerate() {
                let s = first / T::SLICE + s;
                let compression = sums.lanes(s, D + sum::COMPRESSION);
                let diffusion = sums.lanes(s, D + sum::DIFFUSION);
                for ((e, &compression), &diffusion) in slice.iter_mut().zip(compression).zip(diffusion) {
                    *e = compression * inverse_reference + factor * diffusion; // (52)
                }
            }
        });
    }

    /// The body force beside gravity.
    pub(super) fn add_body_forces(&mut self) {
        let Some(force) = &self.force else { return };
        let walls = self.water.wall_particles();
        let (time, positions) = (self.time, &self.water.position);
        let acceleration = &mut self.water.rate.acceleration;
        parallel::for_each_part(acceleration, 1, CHUNK, &|first, part: &mut [Vector<T, D>]| {
            for (k, a) in part.iter_mut().enumerate().skip(walls.saturating_sub(first)) {
                *a += (force.acceleration)(&positions[first + k], time);
            }
        });
    }
}

/// The vector whose components are sums `k…` of particle `i`.
pub(super) fn vector_sum<T: Real, const D: usize>(sums: &Sums<T>, i: usize, k: usize) -> Vector<T, D> {
    let mut x = Vector::zero();
    for axis in 0..D {
        x[axis] = sums.get(i, k + axis);
    }
    x
}
