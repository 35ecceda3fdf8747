//! Where energy and momentum are, and what takes energy at which rate.

use super::Mixture;
use super::own_pairs::sum;
use crate::budget::{Account, Budget, Exchange};
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel;
use crate::real::Real;
use crate::space::Vector;
use crate::time::Moment;
use core::ops::Range;

/// The terms of an [`Exchange`], each by itself: in an array the loops would keep them in memory, and
/// wait for it at every particle.
struct Terms<const D: usize> {
    artificial_viscosity: f64,
    density_diffusion: f64,
    wall_work: f64,
    wall_extrapolation: f64,
    external: f64,
    impulse: [f64; D],
}

impl<const D: usize> Default for Terms<D> {
    fn default() -> Self {
        Self {
            artificial_viscosity: 0.0,
            density_diffusion: 0.0,
            wall_work: 0.0,
            wall_extrapolation: 0.0,
            external: 0.0,
            impulse: [0.0; D],
        }
    }
}

impl<const D: usize> Terms<D> {
    fn booked(&self) -> Exchange<D> {
        let mut booked = Exchange { impulse: Vector(self.impulse), ..Exchange::default() };
        booked.taken[Account::ArtificialViscosity] = self.artificial_viscosity;
        booked.taken[Account::DensityDiffusion] = self.density_diffusion;
        booked.taken[Account::WallWork] = self.wall_work;
        booked.taken[Account::WallExtrapolation] = self.wall_extrapolation;
        booked.taken[Account::External] = self.external;
        booked
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    /// What the particles of `range` lose and are given per time, term by term.
    pub(super) fn exchange(&self, range: Range<usize>) -> Exchange<D> {
        let middle = self.water.wall_particles().clamp(range.start, range.end);
        let mut terms = Terms::default();
        for i in range.start..middle {
            self.add_dissipation(i, self.water.is_evolving(i), &mut terms);
            let (mass, a) = (self.water.mass[i].as_f64(), self.water.rate.acceleration[i]);
            terms.wall_work += mass * a.dot(self.water.now.velocity[i]).as_f64();
            for k in 0..D {
                terms.impulse[k] -= mass * a[k].as_f64();
            }
        }
        let gravity = self.gravity.as_f64();
        for i in middle..range.end {
            self.add_dissipation(i, true, &mut terms);
            if self.force.is_none() {
                let mass = self.water.mass[i].as_f64();
                for k in 0..D {
                    terms.impulse[k] += mass * gravity[k];
                }
            }
        }
        if self.force.is_some() {
            self.add_force(middle..range.end, &mut terms);
        }
        terms.booked()
    }

    /// What artificial viscosity, diffusion and extrapolated walls take.
    #[inline(always)]
    fn add_dissipation(&self, i: usize, is_evolving: bool, terms: &mut Terms<D>) {
        let (water, sums) = (&self.water, &self.scratch.sums);
        let mass = water.mass[i].as_f64();
        let half = 0.5 * mass;
        terms.artificial_viscosity += half * sums.get(i, D + sum::VISCOUS_LOSS).as_f64();
        // p φ/ρ² per unit of dρ is the energy a density rate stores.
        let density = water.density(i);
        let stores = (water.pressure[i] * water.volume_fraction[i] / (density * density)).as_f64() * mass;
        let compression = sums.get(i, D + sum::COMPRESSION).as_f64();
        if is_evolving {
            let reference = water.material().reference_density().as_f64();
            terms.density_diffusion -= stores * (water.rate.excess[i].as_f64() * reference - compression);
        } else {
            terms.wall_extrapolation += stores * compression;
        }
    }

    /// What gravity and the body force give to particles that are no wall's.
    fn add_force(&self, range: Range<usize>, terms: &mut Terms<D>) {
        let (water, Some(force)) = (&self.water, &self.force) else { return };
        for i in range {
            let (mass, velocity) = (water.mass[i].as_f64(), water.now.velocity[i]);
            let other = (force.acceleration)(&water.position[i], self.time);
            if force.potential.is_none() {
                terms.external -= mass * other.dot(velocity).as_f64();
            }
            let push = self.gravity + other;
            for k in 0..D {
                terms.impulse[k] += mass * push[k].as_f64();
            }
        }
    }

    /// Energy stored by compression and in the law's memory \[J\], that of evolving walls included.
    pub(super) fn compressive_energy(&self) -> f64 {
        let water = &self.water;
        parallel::reduce(
            water.len(),
            0.0,
            |range| {
                let own = range.filter(|&i| water.is_evolving(i));
                own.map(|i| {
                    let stored = water.material().stored_energy(water.compression(i), &water.now.memory[i]);
                    water.mass[i].as_f64() * stored
                })
                .sum()
            },
            |a, b| a + b,
        )
    }

    /// Mass, momentum and energy now, and what has been taken so far.
    pub fn budget(&self) -> Budget<D> {
        let mut budget = Budget {
            time: self.time,
            mass: 0.0,
            momentum: [0.0; D],
            angular_momentum: [0.0; 3],
            kinetic: 0.0,
            potential: 0.0,
            compressive: self.compressive_energy(),
            taken: self.exchanged[Moment::Now as usize].taken,
            impulse: self.exchanged[Moment::Now as usize].impulse.0,
        };
        let water = &self.water;
        let gravity = self.gravity.as_f64();
        for i in water.wall_particles()..water.len() {
            let mass = water.mass[i].as_f64();
            let (x, v) = (water.position[i].as_f64(), water.now.velocity[i].as_f64());
            budget.mass += mass;
            for k in 0..D {
                budget.momentum[k] += mass * v[k];
                budget.kinetic += 0.5 * mass * v[k] * v[k];
                budget.potential -= mass * gravity[k] * x[k];
            }
            if let Some(potential) = self.force.as_ref().and_then(|force| force.potential.as_ref()) {
                budget.potential += mass * potential(&water.position[i], self.time);
            }
            let (x, v) = (in_three(x), in_three(v));
            for k in 0..3 {
                let (a, b) = ((k + 1) % 3, (k + 2) % 3);
                budget.angular_momentum[k] += mass * (x[a] * v[b] - x[b] * v[a]);
            }
        }
        budget
    }
}

fn in_three<const D: usize>(x: [f64; D]) -> [f64; 3] {
    let mut out = [0.0; 3];
    out[..D].copy_from_slice(&x);
    out
}
