//! The linear system of implicit drag: conjugate gradients on its Schur complement, in double precision.
//!
//! For the accelerations k with v' = v + Δt k the system reads `(M + Δt L) k = M a − L v`. Both diagonal blocks
//! are diagonal, D = M + Δt ΣK, so that the soil goes first:
//!
//! $$k_i = \frac{b_i + \Delta t\sum_a K_{ia} k_a}{D_i},\qquad
//! m_a k_a + \Delta t\sum_i K_{ia}\Big(k_a - \frac{\Delta t}{D_i}\sum_b K_{ib} k_b\Big)
//! = b_a + \Delta t\sum_i \frac{K_{ia}}{D_i}\,b_i .$$
//!
//! Held particles have k = 0 in it: their rows are gone, and they drag the others as before.

use super::pairs::Pairs;
use crate::parallel::{self, CHUNK};
use crate::space::Vector;

/// How large the error of a velocity may be against the velocities of the step.
const TOLERANCE: f64 = 1e-10;
/// The residual's rounding, in units of ε times the diagonal.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Beyond this the iteration is lost.
const MOST_ITERATIONS: usize = 10_000;

/// The iteration ended without a solution.
#[derive(Clone, Debug)]
pub(super) struct Unsolved {
    /// ‖r‖ in the norm Σ r²/m, which bounds the error's own Σ m e² \[m/s² √kg\].
    pub(super) residual: f64,
    pub(super) allowed: f64,
    pub(super) iterations: usize,
}

/// The system over one step; its arrays have the soil first.
pub(super) struct System<'a> {
    pairs: &'a Pairs,
    masses: Vec<f64>,
    /// How many particles of soil and of water are held; they come first.
    held: [usize; 2],
    soil: usize,
    step: f64,
    /// Δt/D_i of soil, zero where it is held.
    yielding: Vec<f64>,
    /// The diagonal of the Schur complement.
    diagonal: Vec<f64>,
}

impl<'a> System<'a> {
    pub(super) fn new(pairs: &'a Pairs, masses: Vec<f64>, held: [usize; 2], step: f64) -> Self {
        let soil = pairs.of_soil.len();
        let yielding: Vec<f64> = (0..soil)
            .map(|i| if i < held[0] { 0.0 } else { step / (masses[i] + step * pairs.of_soil.sum(i)) })
            .collect();
        let diagonal = (0..pairs.of_water.len())
            .map(|a| {
                let drag = pairs.of_water.of(a).map(|(i, k)| k * (1.0 - yielding[i] * k));
                masses[soil + a] + step * drag.sum::<f64>()
            })
            .collect();
        Self { pairs, masses, held, soil, step, yielding, diagonal }
    }

    fn is_held(&self, i: usize) -> bool {
        match i.checked_sub(self.soil) {
            None => i < self.held[0],
            Some(a) => a < self.held[1],
        }
    }

    /// The effective accelerations of a step from `velocity` with the accelerations `without` drag; of held
    /// particles, what they resist. The iteration begins at the accelerations `begin` of the water.
    pub(super) fn accelerations<const D: usize>(
        &self,
        velocity: &[Vector<f64, D>],
        without: &[Vector<f64, D>],
        begin: &[Vector<f64, D>],
    ) -> Result<Vec<Vector<f64, D>>, Unsolved> {
        let mut sides = self.drag(velocity);
        for (i, side) in sides.iter_mut().enumerate() {
            *side += without[i] * self.masses[i];
        }
        let mut water = begin.to_vec();
        water[..self.held[1]].fill(Vector::zero());
        self.iterate(&sides, &mut water, self.scale(velocity, without))?;
        let mut accelerations = self.soil_behind(&water, &sides[..self.soil]);
        accelerations.extend(water);
        self.make_exact(velocity, without, &mut accelerations);
        Ok(accelerations)
    }

    /// The velocities after `time` \[s\] of these accelerations; those of held particles are given.
    pub(super) fn moved<const D: usize>(
        &self,
        velocity: &[Vector<f64, D>],
        accelerations: &[Vector<f64, D>],
        time: f64,
    ) -> Vec<Vector<f64, D>> {
        let both = velocity.iter().zip(accelerations).enumerate();
        both.map(|(i, (&v, &k))| if self.is_held(i) { v } else { v + k * time }).collect()
    }

    /// Drag on every particle.
    fn drag<const D: usize>(&self, velocity: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let (soil, water) = velocity.split_at(self.soil);
        let mut drag = vec![Vector::zero(); velocity.len()];
        let (on_soil, on_water) = drag.split_at_mut(self.soil);
        parallel::for_each_part(on_soil, 1, CHUNK, &|first, part: &mut [Vector<f64, D>]| {
            for (i, force) in (first..).zip(part) {
                for (a, k) in self.pairs.of_soil.of(i) {
                    *force += (water[a] - soil[i]) * k;
                }
            }
        });
        parallel::for_each_part(on_water, 1, CHUNK, &|first, part: &mut [Vector<f64, D>]| {
            for (a, force) in (first..).zip(part) {
                for (i, k) in self.pairs.of_water.of(a) {
                    *force += (soil[i] - water[a]) * k;
                }
            }
        });
        drag
    }

    /// The soil's accelerations that go with those of the water; `sides` may be of no soil at all.
    fn soil_behind<const D: usize>(
        &self,
        water: &[Vector<f64, D>],
        sides: &[Vector<f64, D>],
    ) -> Vec<Vector<f64, D>> {
        let mut soil = vec![Vector::zero(); self.soil];
        parallel::for_each_part(&mut soil, 1, CHUNK, &|first, part: &mut [Vector<f64, D>]| {
            for (i, x) in (first..).zip(part) {
                for (a, k) in self.pairs.of_soil.of(i) {
                    *x += water[a] * k;
                }
                let side = sides.get(i).map_or(Vector::zero(), |&side| side * (1.0 / self.step));
                *x = (*x + side) * self.yielding[i];
            }
        });
        soil
    }

    /// `out ← S x` of the Schur complement; returns x · S x.
    fn apply<const D: usize>(&self, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) -> f64 {
        let soil = self.soil_behind(x, &[]);
        let rows = |first: usize, part: &mut [Vector<f64, D>]| {
            let mut product = 0.0;
            for (a, out) in (first..).zip(part) {
                let mut drag = Vector::zero();
                if a >= self.held[1] {
                    for (i, k) in self.pairs.of_water.of(a) {
                        drag += (x[a] - soil[i]) * k;
                    }
                }
                *out = x[a] * self.masses[self.soil + a] + drag * self.step;
                product += x[a].dot(*out);
            }
            product
        };
        parallel::change_and_reduce(out, 0.0, rows, |a, b| a + b)
    }

    /// Conjugate gradients with the diagonal as preconditioner. S is no less than the water's masses, so that
    /// Σ r²/m bounds Σ m e² of the error e.
    fn iterate<const D: usize>(
        &self,
        sides: &[Vector<f64, D>],
        x: &mut [Vector<f64, D>],
        scale: f64,
    ) -> Result<(), Unsolved> {
        let masses = &self.masses[self.soil..];
        let norm =
            |r: &[Vector<f64, D>]| r.iter().zip(masses).map(|(r, m)| r.norm2() / m).sum::<f64>().sqrt();
        let rounding: f64 = self.diagonal.iter().zip(masses).map(|(d, m)| d * d / m).sum();
        let mass: f64 = masses.iter().sum();
        let allowed = scale * (TOLERANCE * mass.sqrt()).max(ROUNDING * rounding.sqrt());

        let mut residual = self.condensed(sides);
        let mut applied = vec![Vector::zero(); x.len()];
        self.apply(x, &mut applied);
        for (r, s) in residual.iter_mut().zip(&applied) {
            *r -= *s;
        }
        let mut direction = vec![Vector::zero(); x.len()];
        let mut before = f64::INFINITY;
        for iterations in 0.. {
            let size = norm(&residual);
            if size <= allowed {
                break;
            }
            if iterations == MOST_ITERATIONS || !size.is_finite() {
                return Err(Unsolved { residual: size, allowed, iterations });
            }
            let now: f64 = residual.iter().zip(&self.diagonal).map(|(r, d)| r.norm2() / d).sum();
            let kept = now / before;
            for ((p, r), d) in direction.iter_mut().zip(&residual).zip(&self.diagonal) {
                *p = *r * (1.0 / d) + *p * kept;
            }
            let far = now / self.apply(&direction, &mut applied);
            for ((x, r), (p, s)) in x.iter_mut().zip(&mut residual).zip(direction.iter().zip(&applied)) {
                *x += *p * far;
                *r -= *s * far;
            }
            before = now;
        }
        Ok(())
    }

    /// The right-hand side of the Schur complement; zero where water is held.
    fn condensed<const D: usize>(&self, sides: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let (soil, water) = sides.split_at(self.soil);
        let mut out = water.to_vec();
        parallel::for_each_part(&mut out, 1, CHUNK, &|first, part: &mut [Vector<f64, D>]| {
            for (a, out) in (first..).zip(part) {
                for (i, k) in self.pairs.of_water.of(a) {
                    *out += soil[i] * (k * self.yielding[i]);
                }
                if a < self.held[1] {
                    *out = Vector::zero();
                }
            }
        });
        out
    }

    /// The size of accelerations that would undo or double the velocities of the step.
    fn scale<const D: usize>(&self, velocity: &[Vector<f64, D>], without: &[Vector<f64, D>]) -> f64 {
        let (mut mass, mut moving, mut pushed) = (0.0, 0.0, 0.0);
        for ((m, v), a) in self.masses.iter().zip(velocity).zip(without) {
            mass += m;
            moving += m * v.norm2();
            pushed += m * a.norm2();
        }
        ((moving / mass).sqrt() / self.step) + (pushed / mass).sqrt()
    }

    /// Gives held particles what they resist, and makes momentum exact to rounding, whatever the tolerance: what
    /// the solution lacks of it, which is of the tolerance's size, goes to the held particles that are dragged;
    /// to the others if there are none, where it is the one motion without drag.
    fn make_exact<const D: usize>(
        &self,
        velocity: &[Vector<f64, D>],
        without: &[Vector<f64, D>],
        accelerations: &mut [Vector<f64, D>],
    ) {
        let drag = self.drag(&self.moved(velocity, accelerations, self.step));
        let mut lacking = Vector::zero();
        let mut masses = [0.0; 2];
        for i in 0..accelerations.len() {
            let (mass, is_held) = (self.masses[i], self.is_held(i));
            if is_held {
                accelerations[i] = without[i] + drag[i] * (1.0 / mass);
            }
            if self.is_dragged(i) {
                masses[usize::from(is_held)] += mass;
            }
            lacking += (without[i] - accelerations[i]) * mass;
        }
        let held_take = masses[1] > 0.0;
        for i in 0..accelerations.len() {
            if self.is_held(i) == held_take && self.is_dragged(i) {
                accelerations[i] += lacking * (1.0 / masses[usize::from(held_take)]);
            }
        }
    }

    fn is_dragged(&self, i: usize) -> bool {
        match i.checked_sub(self.soil) {
            None => self.pairs.of_soil.of(i).next().is_some(),
            Some(a) => self.pairs.of_water.of(a).next().is_some(),
        }
    }
}
