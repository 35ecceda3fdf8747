//! The equations, one method each, in the order of [`Mixture`]'s evaluation.

use super::continuity::{DensityDiffusion, PairDiffusion};
use super::extrapolation::{self, Extrapolation, StressExtrapolation};
use super::momentum::Viscosity;
use super::own_pairs::{OwnPairs, sum};
use super::reinitialisation::ShepardCompression;
use super::renormalised::{CompressionGradient, RenormalisedDiffusion};
use super::velocity_gradient::VelocityGradient;
use super::wall_friction::{self, WallFriction};
use super::{GradientWeight, Mixture, Slip, WallKind};
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::{SymTensor, Tensor, Vector};
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

    fn has_extrapolated_walls(&self) -> bool {
        self.water.walls().iter().any(|wall| wall.kind() != WallKind::Dynamic)
    }

    /// Pressure and velocity of extrapolated walls (Adami et al. 2012):
    /// `p_w = ⟨p⟩ + (g − a_w)·⟨ρ̃ (x_w − x)⟩`; viscosity sees `2v_w − ⟨v⟩`
    /// without slip, and a wall gliding along with the fluid with free slip.
    pub(super) fn extrapolate_walls(&mut self) {
        if !self.has_extrapolated_walls() {
            return;
        }
        let formula = Extrapolation::<K, D> { kernel: self.kernel.clone() };
        let water = &self.water;
        let o = T::ZERO;
        let dummy: &[T] = &[o, o, o, o, o, o][..D + 3];
        self.neighbourhood.pack::<Extrapolation<K, D>>(
            &water.position,
            &mut self.scratch.records,
            dummy,
            &|i, record: &mut [T]| {
                record[..D].copy_from_slice(&water.now.velocity[i].0);
                record[D] = water.volume(i);
                record[D + 1] = water.pressure[i];
                record[D + 2] = water.true_density(i);
            },
        );
        self.neighbourhood.sum_first(
            water.wall_particles(),
            &formula,
            &self.scratch.records,
            &mut self.scratch.sums,
        );
        self.scratch.wall_velocity.clear();
        for i in 0..self.water.wall_particles() {
            let shown = self.extrapolate_wall(i);
            self.scratch.wall_velocity.push(shown);
        }
    }

    /// Sets pressure and density of wall particle `i`; returns the velocity it shows to viscosity.
    fn extrapolate_wall(&mut self, i: usize) -> Vector<T, D> {
        let v_wall = self.water.now.velocity[i];
        let WallKind::Extrapolated { slip, suction } =
            self.water.walls()[usize::from(self.water.body[i])].kind()
        else {
            return v_wall;
        };
        let sums = &self.scratch.sums;
        let weight = sums.get(i, extrapolation::sum::WEIGHT);
        let (mut pressure, mut shown) = (T::ZERO, v_wall);
        if weight > T::ZERO {
            let fall = self.gravity - self.water.wall_acceleration[i];
            let lever: Vector<T, D> = vector_sum(sums, i, extrapolation::sum::LEVER);
            let mean: Vector<T, D> = vector_sum(sums, i, extrapolation::sum::LEVER + D);
            pressure = (sums.get(i, extrapolation::sum::PRESSURE) + fall.dot(lever)) / weight;
            let slip_velocity = mean * (T::ONE / weight) - v_wall;
            shown = match slip {
                Slip::NoSlip => v_wall - slip_velocity,
                // The lever points from the fluid into the wall.
                Slip::FreeSlip => {
                    v_wall + slip_velocity - lever * (lever.dot(slip_velocity) / lever.norm2().max(tiny()))
                }
            };
        }
        if !suction {
            pressure = pressure.max(T::ZERO);
        }
        let excess = self.water.material().compression(pressure) * self.water.volume_fraction[i];
        self.water.pressure[i] = pressure;
        self.water.now.excess[i] = excess;
        self.water.half.excess[i] = excess;
        shown
    }

    /// Velocity gradient (62) → deviatoric stress (14), (15) and rate of the memory.
    pub(super) fn find_stress(&mut self) {
        self.exchange_rate.taken[Account::Viscosity] = 0.0;
        if !self.water.material().needs_velocity_gradient() {
            return;
        }
        let formula = VelocityGradient::<K, D> { kernel: self.kernel.clone() };
        let weight = self.gradient_weight;
        let (water, wall_velocity) = (&self.water, &self.scratch.wall_velocity);
        self.neighbourhood.pack::<VelocityGradient<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[T::ZERO; 4][..D + 1],
            &|i, record: &mut [T]| {
                let v = wall_velocity.get(i).unwrap_or(&water.now.velocity[i]);
                record[..D].copy_from_slice(&v.0);
                record[D] = match weight {
                    GradientWeight::Conjugate => water.mass[i],
                    GradientWeight::Printed => water.volume(i),
                };
            },
        );
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.sums);
        self.apply_law();
        if self.has_extrapolated_walls() {
            self.extrapolate_stress();
            self.book_wall_friction();
        }
    }

    fn apply_law(&mut self) {
        let mut deviator = core::mem::take(&mut self.water.deviator);
        let mut memory_rate = core::mem::take(&mut self.water.rate.memory);
        deviator.resize(self.water.len(), SymTensor::zero());
        let (water, sums, weight) = (&self.water, &self.scratch.sums, self.gradient_weight);
        let scale = |i: usize| match weight {
            GradientWeight::Conjugate => T::ONE / water.density(i),
            GradientWeight::Printed => T::ONE,
        };
        let gradient = |i: usize| {
            let scale = scale(i);
            let mut rows = [[T::ZERO; D]; D];
            for (a, row) in rows.iter_mut().enumerate() {
                for (b, value) in row.iter_mut().enumerate() {
                    *value = sums.get(i, a * D + b) * scale;
                }
            }
            Tensor::embed(&rows)
        };
        if self.strain_control > T::ZERO {
            let rows = |i: usize| -> [Vector<T, D>; D] {
                core::array::from_fn(|a| vector_sum(sums, i, a * D) * scale(i))
            };
            self.scratch.velocity_gradient.clear();
            self.scratch.velocity_gradient.extend((0..water.len()).map(rows));
        }
        parallel::for_each_part(&mut deviator, 1, CHUNK, &|first, part: &mut [SymTensor<T>]| {
            for (k, tau) in part.iter_mut().enumerate() {
                *tau = water.material().deviator(&gradient(first + k), &water.now.memory[first + k]);
            }
        });
        if size_of::<F::Memory>() > 0 {
            parallel::for_each_part(&mut memory_rate, 1, CHUNK, &|first, part: &mut [F::Memory]| {
                for (k, rate) in part.iter_mut().enumerate() {
                    *rate = water.material().rate(&gradient(first + k), &water.now.memory[first + k]);
                }
            });
        }
        // Work of τ per time, V φ τ:∇v, for every particle that has its own stress.
        self.exchange_rate.taken[Account::Viscosity] = parallel::reduce(
            water.len(),
            0.0,
            |range| {
                let own = range.filter(|&i| water.is_evolving(i));
                own.map(|i| {
                    let stretch = gradient(i).symmetric();
                    (water.volume(i) * water.volume_fraction[i] * deviator[i].double_dot(&stretch)).as_f64()
                })
                .sum()
            },
            |a, b| a + b,
        );
        self.water.deviator = deviator;
        self.water.rate.memory = memory_rate;
    }

    /// Stress of extrapolated walls: the fluid's without slip, none where it glides.
    fn extrapolate_stress(&mut self) {
        let formula = StressExtrapolation::<K, D> { kernel: self.kernel.clone() };
        let water = &self.water;
        self.neighbourhood.pack::<StressExtrapolation<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[T::ZERO; 7],
            &|i, record: &mut [T]| {
                record[0] = water.volume(i);
                record[1..7].copy_from_slice(&water.deviator[i].0);
            },
        );
        self.neighbourhood.sum_first(
            water.wall_particles(),
            &formula,
            &self.scratch.records,
            &mut self.scratch.extra,
        );
        let sums = &self.scratch.extra;
        for i in 0..self.water.wall_particles() {
            let WallKind::Extrapolated { slip, .. } =
                self.water.walls()[usize::from(self.water.body[i])].kind()
            else {
                continue;
            };
            let weight = sums.get(i, 0);
            let mut stress = SymTensor::zero();
            if slip == Slip::NoSlip && weight > T::ZERO {
                for k in 0..6 {
                    stress.0[k] = sums.get(i, 1 + k) / weight;
                }
            }
            self.water.deviator[i] = stress;
        }
    }

    /// Adds to the loss by viscosity what it takes between fluid and extrapolated walls.
    fn book_wall_friction(&mut self) {
        let formula = WallFriction::<K, D> { kernel: self.kernel.clone() };
        let (water, shown) = (&self.water, &self.scratch.wall_velocity);
        self.neighbourhood.pack::<WallFriction<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[T::ZERO; 13][..wall_friction::record_length(D) - D],
            &|i, record: &mut [T]| {
                let (v, density) = (&water.now.velocity[i], water.density(i));
                let pull = water.volume_fraction[i] / (density * density);
                let velocities = [v, shown.get(i).unwrap_or(v)];
                wall_friction::write(record, velocities, water.mass[i], pull, &water.deviator[i]);
            },
        );
        let walls = water.wall_particles();
        self.neighbourhood.sum_first(walls, &formula, &self.scratch.records, &mut self.scratch.extra);
        let friction = |i: usize| (water.mass[i] * self.scratch.extra.get(i, 0)).as_f64();
        let extrapolated = (0..walls).filter(|&i| !water.is_evolving(i));
        self.exchange_rate.taken[Account::Viscosity] += extrapolated.map(friction).sum::<f64>();
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

    /// The diffusive sum of (52) with the renormalised density gradient.
    pub(super) fn add_renormalised_diffusion(&mut self) {
        if !matches!(self.diffusion, DensityDiffusion::Renormalised(_)) {
            return;
        }
        let o = T::ZERO;
        let water = &self.water;
        self.neighbourhood.pack::<CompressionGradient<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[o, o],
            &|i, record: &mut [T]| {
                record[0] = water.volume(i);
                record[1] = water.compression(i);
            },
        );
        let formula = CompressionGradient::<K, D> { kernel: self.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let sums = &self.scratch.extra;
        let gradient = |i: usize| -> Vector<T, D> {
            let raw: Vector<T, D> = vector_sum(sums, i, 0);
            let mut matrix = [[T::ZERO; D]; D];
            for (a, row) in matrix.iter_mut().enumerate() {
                for (b, value) in row.iter_mut().enumerate() {
                    *value = sums.get(i, D + a * D + b);
                }
            }
            // Too few neighbours to know a gradient: none, as in free flight.
            T::inverse(&matrix).map_or_else(Vector::zero, |inverse| {
                let mut out = Vector::zero();
                for a in 0..D {
                    for b in 0..D {
                        out[a] += inverse[a][b] * raw[b];
                    }
                }
                if out.is_finite() { out } else { Vector::zero() }
            })
        };
        let gradients: Vec<Vector<T, D>> = {
            let mut all = vec![Vector::zero(); water.len()];
            parallel::for_each_part(&mut all, 1, CHUNK, &|first, part: &mut [Vector<T, D>]| {
                for (k, g) in part.iter_mut().enumerate() {
                    *g = gradient(first + k);
                }
            });
            all
        };
        self.neighbourhood.pack::<RenormalisedDiffusion<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[o, o],
            &|i, record: &mut [T]| {
                record[0] = water.volume(i);
                record[1] = water.compression(i);
                record[2..2 + D].copy_from_slice(&gradients[i].0);
            },
        );
        let formula = RenormalisedDiffusion::<K, D> { kernel: self.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let factor = self.diffusivity();
        for (i, rate) in self.water.rate.excess.iter_mut().enumerate() {
            *rate += factor * self.water.volume_fraction[i] * self.scratch.extra.get(i, 0);
        }
    }

    /// The body force beside gravity.
    pub(super) fn add_body_forces(&mut self) {
        let Some(force) = &self.force else { return };
        let walls = self.water.wall_particles();
        let (time, positions) = (self.time, &self.water.position);
        parallel::for_each_part(&mut self.water.rate.acceleration, 1, CHUNK, &|first,
                                                                               part: &mut [Vector<
            T,
            D,
        >]| {
            for (k, a) in part.iter_mut().enumerate().skip(walls.saturating_sub(first)) {
                *a += (force.acceleration)(&positions[first + k], time);
            }
        });
    }

    /// Replaces densities by their Shepard mean (70), on the true density; the energy is booked.
    pub fn reinitialise_density(&mut self) {
        self.find_neighbours();
        let water = &self.water;
        self.neighbourhood.pack::<ShepardCompression<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[T::ZERO, T::ZERO],
            &|i, record: &mut [T]| {
                record[0] = water.volume(i);
                record[1] = water.compression(i);
            },
        );
        let formula = ShepardCompression::<K, D> { kernel: self.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let before = self.compressive_energy();
        let own = self.kernel.value(T::ZERO);
        for i in self.water.wall_particles()..self.water.len() {
            let (volume, e) = (self.water.volume(i), self.water.compression(i));
            let weight = self.scratch.extra.get(i, 0) + volume * own;
            let mean = (self.scratch.extra.get(i, 1) + volume * e * own) / weight; // (70)
            let shift = (mean - e) * self.water.volume_fraction[i];
            self.water.shift_excess(i, shift);
        }
        let lost = before - self.compressive_energy();
        for exchanged in &mut self.exchanged {
            exchanged.taken[Account::Reinitialisation] += lost;
        }
    }
}

/// Keeps `x/x` finite at `x = 0`.
fn tiny<T: Real>() -> T {
    T::of(1e-30)
}

/// The vector whose components are sums `k…` of particle `i`.
pub(super) fn vector_sum<T: Real, const D: usize>(sums: &Sums<T>, i: usize, k: usize) -> Vector<T, D> {
    let mut x = Vector::zero();
    for axis in 0..D {
        x[axis] = sums.get(i, k + axis);
    }
    x
}
