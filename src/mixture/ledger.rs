//! Where energy and momentum are, and what takes energy at which rate.

use super::Mixture;
use super::constituent::Constituent;
use super::own_pairs::sum;
use super::setting::Setting;
use crate::budget::{Account, Budget, Exchange};
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel;
use crate::real::Real;
use crate::space::Vector;
use crate::time::Moment;
use core::ops::Range;

/// Most lanes of a slice.
const LANES: usize = 16;

/// The terms of an [`Exchange`]. What every particle adds to is summed lane by lane, which makes vector
/// code of it, with the same bits on every machine.
struct Terms<const D: usize> {
    artificial_viscosity: [f64; LANES],
    density_diffusion: [f64; LANES],
    /// Of the particles that only gravity accelerates.
    falling_mass: [f64; LANES],
    wall_work: f64,
    wall_extrapolation: f64,
    external: f64,
    impulse: Vector<f64, D>,
}

impl<const D: usize> Terms<D> {
    fn new() -> Self {
        Self {
            artificial_viscosity: [0.0; LANES],
            density_diffusion: [0.0; LANES],
            falling_mass: [0.0; LANES],
            wall_work: 0.0,
            wall_extrapolation: 0.0,
            external: 0.0,
            impulse: Vector::zero(),
        }
    }

    fn booked(&self, gravity: Vector<f64, D>) -> Exchange<D> {
        let weight = gravity * self.falling_mass.iter().sum();
        let mut booked = Exchange { impulse: self.impulse + weight, ..Exchange::default() };
        booked.taken[Account::ArtificialViscosity] = self.artificial_viscosity.iter().sum();
        booked.taken[Account::DensityDiffusion] = self.density_diffusion.iter().sum();
        booked.taken[Account::WallWork] = self.wall_work;
        booked.taken[Account::WallExtrapolation] = self.wall_extrapolation;
        booked.taken[Account::External] = self.external;
        booked
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// What the particles of `range`, which begins with a slice, lose and are given per time, term by
    /// term.
    #[inline(always)]
    pub(super) fn exchange<K: Kernel<T, D>>(
        &self,
        setting: &Setting<T, D, K>,
        range: Range<usize>,
    ) -> Exchange<D> {
        let walls = self.phase.wall_particles().clamp(range.start, range.end);
        let mut terms = Terms::new();
        for first in range.clone().step_by(T::SLICE) {
            let slice = first..range.end.min(first + T::SLICE);
            if slice.start < walls {
                self.add_walls(slice.start..walls.min(slice.end), &mut terms);
            }
            self.add_dissipation(walls.clamp(slice.start, slice.end)..slice.end, &mut terms);
        }
        if setting.force.is_some() || self.source.is_some() {
            terms.falling_mass = [0.0; LANES];
            self.add_force(setting, walls..range.end, &mut terms);
        }
        terms.booked(Vector(setting.gravity.as_f64()))
    }

    /// What the particles of walls take and are given.
    fn add_walls(&self, range: Range<usize>, terms: &mut Terms<D>) {
        let phase = &self.phase;
        for i in range {
            if phase.is_evolving(i) {
                // Its mass does not fall.
                let falling_mass = terms.falling_mass;
                self.add_dissipation(i..i + 1, terms);
                terms.falling_mass = falling_mass;
            } else {
                let mass = phase.mass[i].as_f64();
                let loss = self.scratch.sums.get(i, D + sum::VISCOUS_LOSS).as_f64();
                terms.artificial_viscosity[i % T::SLICE] += 0.5 * mass * loss;
                if !M::RIGID_GRAINS {
                    let density = phase.density(i);
                    let stores = phase.pressure[i] * phase.volume_fraction[i] / (density * density);
                    let compression = self.scratch.sums.get(i, D + sum::COMPRESSION).as_f64();
                    // What of the density's rate is only the fraction's compresses nothing.
                    let shared = (phase.true_density(i) * phase.fraction_rate(i)).as_f64();
                    terms.wall_extrapolation += stores.as_f64() * mass * (compression - shared);
                }
            }
            let (mass, a) = (phase.mass[i].as_f64(), phase.rate.acceleration[i]);
            terms.wall_work += mass * a.dot(phase.now.velocity[i]).as_f64();
            terms.impulse -= Vector(a.as_f64()) * mass;
        }
    }

    /// What artificial viscosity and diffusion take from evolving particles of one slice.
    #[inline(always)]
    fn add_dissipation(&self, range: Range<usize>, terms: &mut Terms<D>) {
        let (slice, lane) = (range.start / T::SLICE, range.start % T::SLICE);
        // A whole slice is told apart, so that it becomes vector code.
        if range.len() == T::SLICE {
            self.add_lanes(slice, 0..T::SLICE, terms);
        } else if !range.is_empty() {
            self.add_lanes(slice, lane..lane + range.len(), terms);
        }
        if self.shares_space() {
            self.add_fraction_change(range, terms);
        }
    }

    #[inline(always)]
    fn add_lanes(&self, slice: usize, lanes: Range<usize>, terms: &mut Terms<D>) {
        let (phase, sums) = (&self.phase, &self.scratch.sums);
        let (first, count) = (slice * T::SLICE + lanes.start, lanes.len());
        let losses = &sums.lanes(slice, D + sum::VISCOUS_LOSS)[lanes.clone()];
        let compressions = &sums.lanes(slice, D + sum::COMPRESSION)[lanes.clone()];
        let (masses, pressures) = (&phase.mass[first..][..count], &phase.pressure[first..][..count]);
        let (fractions, excesses) =
            (&phase.volume_fraction[first..][..count], &phase.now.excess[first..][..count]);
        let rates = &phase.rate.excess[first..][..count];
        let reference = phase.material().reference_density();
        let viscosity = &mut terms.artificial_viscosity[lanes.clone()];
        let (diffusion, falling) =
            (&mut terms.density_diffusion[lanes.clone()], &mut terms.falling_mass[lanes]);
        for k in 0..count {
            let mass = masses[k].as_f64();
            let density = reference * (fractions[k] + excesses[k]);
            // p φ/ρ² per unit of dρ is the energy a density rate stores.
            let stores = (pressures[k] * fractions[k] / (density * density)).as_f64() * mass;
            let diffused = rates[k].as_f64() * reference.as_f64() - compressions[k].as_f64();
            viscosity[k] += 0.5 * mass * losses[k].as_f64();
            if !M::RIGID_GRAINS {
                diffusion[k] -= stores * diffused;
            }
            falling[k] += mass;
        }
    }

    /// The rate of the excess is that of ρ/ρ̃₀ less that of φ: where φ changes, diffusion is what remains of
    /// both.
    fn add_fraction_change(&self, range: Range<usize>, terms: &mut Terms<D>) {
        let phase = &self.phase;
        for a in range {
            let density = phase.density(a);
            let stores = phase.pressure[a] * phase.volume_fraction[a] / (density * density) * phase.mass[a];
            let change = phase.fraction_rate(a) * phase.material().reference_density();
            terms.density_diffusion[a % T::SLICE] -= (stores * change).as_f64();
        }
    }

    /// What gravity, the body force and the source give to particles that are no wall's.
    fn add_force<K: Kernel<T, D>>(
        &self,
        setting: &Setting<T, D, K>,
        range: Range<usize>,
        terms: &mut Terms<D>,
    ) {
        let phase = &self.phase;
        for i in range {
            let (mass, velocity) = (phase.mass[i].as_f64(), phase.now.velocity[i]);
            let mut acceleration = setting.gravity;
            if let Some(force) = &setting.force {
                let other = (force.acceleration)(&phase.position[i], setting.time);
                if force.potential.is_none() {
                    terms.external -= mass * other.dot(velocity).as_f64();
                }
                acceleration += other;
            }
            let (power, force) = self.given_by_source(i, setting.time);
            terms.external -= power;
            terms.impulse += Vector(acceleration.as_f64()) * mass + force;
        }
    }

    /// Energy stored by compression and in the law's memory \[J\], that of evolving walls included.
    pub(super) fn stored_energy(&self) -> f64 {
        let phase = &self.phase;
        parallel::reduce(
            phase.len(),
            0.0,
            |range| range.filter(|&i| phase.is_evolving(i)).map(|i| self.stored_by(i, Moment::Now)).sum(),
            |a, b| a + b,
        )
    }

    /// Adds mass, momentum, kinetic and potential energy of the particles.
    fn add_to<K: Kernel<T, D>>(
        &self,
        budget: &mut Budget<D>,
        setting: &Setting<T, D, K>,
        particles: impl Iterator<Item = usize>,
        moment: Moment,
    ) {
        let phase = &self.phase;
        let velocity = &phase.fields(moment).velocity;
        let gravity = setting.gravity.as_f64();
        for i in particles {
            let mass = phase.mass[i].as_f64();
            let (x, v) = (phase.position[i].as_f64(), velocity[i].as_f64());
            budget.mass += mass;
            for k in 0..D {
                budget.momentum[k] += mass * v[k];
                budget.kinetic += 0.5 * mass * v[k] * v[k];
                budget.potential -= mass * gravity[k] * x[k];
            }
            if let Some(potential) = setting.force.as_ref().and_then(|force| force.potential.as_ref()) {
                budget.potential += mass * potential(&phase.position[i], setting.time);
            }
            let (x, v) = (in_three(x), in_three(v));
            for k in 0..3 {
                let (a, b) = ((k + 1) % 3, (k + 2) % 3);
                budget.angular_momentum[k] += mass * (x[a] * v[b] - x[b] * v[a]);
            }
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// What these particles, no wall's, bring if they come in now, with the fields of this moment; booked in
    /// `account`.
    pub(super) fn brought<K: Kernel<T, D>>(
        &self,
        setting: &Setting<T, D, K>,
        particles: &[usize],
        account: Account,
        moment: Moment,
    ) -> Exchange<D> {
        let mut budget = Budget::empty(setting.time);
        self.add_to(&mut budget, setting, particles.iter().copied(), moment);
        let stored: f64 = particles.iter().map(|&i| self.stored_by(i, moment)).sum();
        let mut brought = Exchange { impulse: Vector(budget.momentum), ..Exchange::default() };
        brought.entered = budget.mass;
        brought.taken[account] = -(budget.energy() + stored);
        brought
    }

    /// Energy \[J\] particle `i` stores.
    pub(super) fn stored_by(&self, i: usize, moment: Moment) -> f64 {
        let phase = &self.phase;
        let memory = &phase.fields(moment).memory[i];
        phase.mass[i].as_f64() * phase.material().stored_energy(phase.compression_at(i, moment), memory)
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// Mass, momentum and energy now, and what has been taken so far.
    pub fn budget(&self) -> Budget<D> {
        let exchanged = &self.exchanged[Moment::Now as usize];
        let mut budget = Budget {
            compressive: self.water.stored_energy(),
            elastic: self.soil.stored_energy(),
            taken: exchanged.taken,
            impulse: exchanged.impulse.0,
            entered: exchanged.entered,
            buoyancy: exchanged.buoyancy,
            ..Budget::empty(self.setting.time)
        };
        let (soil, water) = (&self.soil.phase, &self.water.phase);
        self.soil.add_to(&mut budget, &self.setting, soil.wall_particles()..soil.len(), Moment::Now);
        self.water.add_to(&mut budget, &self.setting, water.wall_particles()..water.len(), Moment::Now);
        budget
    }
}

fn in_three<const D: usize>(x: [f64; D]) -> [f64; 3] {
    let mut out = [0.0; 3];
    out[..D].copy_from_slice(&x);
    out
}
