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

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    /// Adds what particle `i`, accelerated by `a`, loses and is given per time, term by term.
    #[inline(always)]
    pub(super) fn add_exchange(&self, i: usize, a: Vector<T, D>, rate: &mut Exchange<D>) {
        let powers = &mut rate.taken;
        let (water, sums) = (&self.water, &self.scratch.sums);
        let mass = water.mass[i].as_f64();
        let half = 0.5 * mass;
        powers[Account::ArtificialViscosity] += half * sums.get(i, D + sum::VISCOUS_LOSS).as_f64();
        // p φ/ρ² per unit of dρ is the energy a density rate stores.
        let density = water.density(i);
        let stores = (water.pressure[i] * water.volume_fraction[i] / (density * density)).as_f64() * mass;
        let reference = water.material().reference_density().as_f64();
        let compression = sums.get(i, D + sum::COMPRESSION).as_f64();
        if water.is_evolving(i) {
            let diffusion = water.rate.excess[i].as_f64() * reference - compression;
            powers[Account::DensityDiffusion] -= stores * diffusion;
        } else {
            powers[Account::WallExtrapolation] += stores * compression;
        }
        if i < water.wall_particles() {
            powers[Account::WallWork] += mass * a.dot(water.now.velocity[i]).as_f64();
            for k in 0..D {
                rate.impulse[k] -= mass * a[k].as_f64();
            }
            return;
        }
        let mut push = self.gravity;
        if let Some(force) = &self.force {
            let other = (force.acceleration)(&water.position[i], self.time);
            push += other;
            if force.potential.is_none() {
                powers[Account::External] -= mass * other.dot(water.now.velocity[i]).as_f64();
            }
        }
        for k in 0..D {
            rate.impulse[k] += mass * push[k].as_f64();
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
