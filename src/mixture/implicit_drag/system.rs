//! The linear system of implicit drag, in double precision, and its Schur complement.
//!
//! For the accelerations k with v' = v + Δt k the system reads `(M + Δt L) k = M a − L v`. Both diagonal blocks
//! are diagonal, D = M + Δt ΣK, so that the soil goes first:
//!
//! $$k_i = \frac{b_i + \Delta t\sum_a K_{ia} k_a}{D_i},\qquad
//! m_a k_a + \Delta t\sum_i K_{ia}\Big(k_a - \frac{\Delta t}{D_i}\sum_b K_{ib} k_b\Big)
//! = b_a + \Delta t\sum_i \frac{K_{ia}}{D_i}\,b_i .$$
//!
//! Drag along the lines between particles ([`Along`](super::bond::Along)) makes matrices of the directions of
//! K, D and the diagonal.
//!
//! Held particles have k = 0 in it: their rows are gone, and they drag the others as before.

use super::bond::{Block, Bond};
use super::cholesky::{Factor, Pattern};
use super::conjugate_gradients::{self, Precondition};
use super::pairs::Pairs;
use super::scheme::Stage;
use crate::parallel::{self, CHUNK};
use crate::space::Vector;

/// How large the error of a velocity may be against the velocities of the step.
const TOLERANCE: f64 = 1e-10;
/// The residual's rounding, in units of ε times the diagonal.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// An iteration ended without a solution.
#[derive(Clone, Debug)]
pub(super) enum Unsolved {
    /// That for the accelerations.
    Iteration {
        /// ‖r‖ in the norm Σ r²/m, which bounds the error's own Σ m e² \[m/s² √kg\].
        residual: f64,
        allowed: f64,
        iterations: usize,
    },
    /// That for the slips drag depends on \[m/s\].
    Sweeps { change: f64, allowed: f64, sweeps: usize },
}

/// The system over one stage; its arrays have the soil first.
pub(super) struct System<'a, E: Bond<D>, const D: usize> {
    pub(super) pairs: &'a Pairs<E>,
    pub(super) stage: Stage<'a, D>,
    /// Δt/D_i of soil, zero where it is held.
    yielding: Vec<E::Block>,
    /// The inverse of the diagonal of the Schur complement, and √Σ d²/m of that diagonal.
    inverse_diagonal: Vec<E::Block>,
    stiffness: f64,
    factor: Option<Factor<'a>>,
}

/// By the inverse of the diagonal.
impl<E: Bond<D>, const D: usize> Precondition<D> for System<'_, E, D> {
    fn apply(&self, residual: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        for ((z, r), inverse) in out.iter_mut().zip(residual).zip(&self.inverse_diagonal) {
            *z = inverse.apply(*r);
        }
    }
}

impl<'a, E: Bond<D>, const D: usize> System<'a, E, D> {
    /// With a factor, if there is a pattern for one and rounding leaves it.
    pub(super) fn new(pairs: &'a Pairs<E>, stage: Stage<'a, D>, pattern: Option<&'a Pattern>) -> Self {
        let Stage { masses, soil, held, step, .. } = stage;
        let yielding: Vec<E::Block> = (0..soil)
            .map(|i| match i < held[0] {
                true => E::Block::zero(),
                false => pairs.of_soil.sum(i).with_mass(masses[i], step).inverse(step),
            })
            .collect();
        let diagonal = |a: usize| {
            let mut drag = E::Block::zero();
            for (i, bond) in pairs.of_water.of(a) {
                drag += bond.left(&yielding[i]).block();
            }
            drag.with_mass(masses[soil + a], step)
        };
        let diagonal: Vec<E::Block> = (0..pairs.of_water.len()).map(diagonal).collect();
        let stiffness = diagonal.iter().zip(&masses[soil..]).map(|(d, m)| d.size2() / m).sum::<f64>().sqrt();
        let inverse_diagonal = diagonal.into_iter().map(|d| d.inverse(1.0)).collect();
        let factor = pattern.and_then(|pattern| Factor::new(pattern, pairs, &stage));
        Self { pairs, stage, yielding, inverse_diagonal, stiffness, factor }
    }

    /// The effective accelerations of a stage from `velocity`; of held particles, what they resist. The solution
    /// begins at the accelerations `begin` of the water.
    pub(super) fn accelerations(
        &self,
        velocity: &[Vector<f64, D>],
        begin: &[Vector<f64, D>],
    ) -> Result<Vec<Vector<f64, D>>, Unsolved> {
        let Stage { masses, without, soil, held, .. } = self.stage;
        let mut sides = self.drag(velocity);
        for (i, side) in sides.iter_mut().enumerate() {
            *side += without[i] * masses[i];
        }
        let mut water = begin.to_vec();
        water[..held[1]].fill(Vector::zero());
        let precondition: &dyn Precondition<D> = match &self.factor {
            Some(factor) => factor,
            None => self,
        };
        let (condensed, allowed) = (self.condensed(&sides), self.allowed(velocity));
        conjugate_gradients::solve(self, precondition, &condensed, &mut water, allowed)?;
        let mut accelerations = self.soil_behind(&water, &sides[..soil]);
        accelerations.extend(water);
        self.make_exact(velocity, &mut accelerations);
        Ok(accelerations)
    }

    /// How large ‖r‖ may be.
    fn allowed(&self, velocity: &[Vector<f64, D>]) -> f64 {
        let mass: f64 = self.water_masses().iter().sum();
        self.stage.scale(velocity) * (TOLERANCE * mass.sqrt()).max(ROUNDING * self.stiffness)
    }

    /// ‖r‖ in the norm Σ r²/m. The Schur complement is no less than the water's masses, so that it bounds the
    /// error's own Σ m e².
    pub(super) fn norm(&self, residual: &[Vector<f64, D>]) -> f64 {
        residual.iter().zip(self.water_masses()).map(|(r, m)| r.norm2() / m).sum::<f64>().sqrt()
    }

    fn water_masses(&self) -> &[f64] {
        &self.stage.masses[self.stage.soil..]
    }

    /// Drag on every particle.
    fn drag(&self, velocity: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let (soil, water) = velocity.split_at(self.stage.soil);
        let mut drag = vec![Vector::zero(); velocity.len()];
        let (on_soil, on_water) = drag.split_at_mut(self.stage.soil);
        parallel::for_each_part(on_soil, 1, CHUNK, &|first, part: &mut [Vector<f64, D>]| {
            for (i, force) in (first..).zip(part) {
                *force = self.pairs.of_soil.pulled(i, |a| water[a] - soil[i]);
            }
        });
        parallel::for_each_part(on_water, 1, CHUNK, &|first, part: &mut [Vector<f64, D>]| {
            for (a, force) in (first..).zip(part) {
                *force = self.pairs.of_water.pulled(a, |i| soil[i] - water[a]);
            }
        });
        drag
    }

    /// The soil's accelerations that go with those of the water; `sides` may be of no soil at all.
    fn soil_behind(&self, water: &[Vector<f64, D>], sides: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let mut soil = vec![Vector::zero(); self.stage.soil];
        parallel::for_each_part(&mut soil, 1, CHUNK, &|first, part: &mut [Vector<f64, D>]| {
            for (i, x) in (first..).zip(part) {
                let pulled = self.pairs.of_soil.pulled(i, |a| water[a]);
                let side = sides.get(i).map_or(Vector::zero(), |&side| side * (1.0 / self.stage.step));
                *x = self.yielding[i].apply(pulled + side);
            }
        });
        soil
    }

    /// `out ← S x` of the Schur complement; returns x · S x.
    pub(super) fn complement(&self, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) -> f64 {
        let soil = self.soil_behind(x, &[]);
        let Stage { masses, held, step, .. } = self.stage;
        let rows = |first: usize, part: &mut [Vector<f64, D>]| {
            let mut product = 0.0;
            for (a, out) in (first..).zip(part) {
                let mut drag = Vector::zero();
                if a >= held[1] {
                    drag = self.pairs.of_water.pulled(a, |i| x[a] - soil[i]);
                }
                *out = x[a] * masses[soil.len() + a] + drag * step;
                product += x[a].dot(*out);
            }
            product
        };
        parallel::change_and_reduce(out, 0.0, rows, |a, b| a + b)
    }

    /// The right-hand side of the Schur complement; zero where water is held.
    fn condensed(&self, sides: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let (soil, water) = sides.split_at(self.stage.soil);
        let mut out = water.to_vec();
        parallel::for_each_part(&mut out, 1, CHUNK, &|first, part: &mut [Vector<f64, D>]| {
            for (a, out) in (first..).zip(part) {
                for (i, bond) in self.pairs.of_water.of(a) {
                    *out += bond.pull_through(&self.yielding[i], soil[i]);
                }
                if a < self.stage.held[1] {
                    *out = Vector::zero();
                }
            }
        });
        out
    }

    /// Gives held particles what they resist, and makes momentum exact to rounding, whatever the tolerance: what
    /// the solution lacks of it, which is of the tolerance's size, goes to the held particles that are dragged;
    /// to the others if there are none, where it is the one motion without drag.
    fn make_exact(&self, velocity: &[Vector<f64, D>], accelerations: &mut [Vector<f64, D>]) {
        let stage = &self.stage;
        let drag = self.drag(&stage.moved(velocity, accelerations, stage.step));
        let mut lacking = Vector::zero();
        let mut masses = [0.0; 2];
        for i in 0..accelerations.len() {
            let (mass, is_held) = (stage.masses[i], stage.is_held(i));
            if is_held {
                accelerations[i] = stage.without[i] + drag[i] * (1.0 / mass);
            }
            if self.is_dragged(i) {
                masses[usize::from(is_held)] += mass;
            }
            lacking += (stage.without[i] - accelerations[i]) * mass;
        }
        let held_take = masses[1] > 0.0;
        for i in 0..accelerations.len() {
            if stage.is_held(i) == held_take && self.is_dragged(i) {
                accelerations[i] += lacking * (1.0 / masses[usize::from(held_take)]);
            }
        }
    }

    fn is_dragged(&self, i: usize) -> bool {
        match i.checked_sub(self.stage.soil) {
            None => self.pairs.of_soil.of(i).next().is_some(),
            Some(a) => self.pairs.of_water.of(a).next().is_some(),
        }
    }
}
