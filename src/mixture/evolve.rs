//! How a phase moves in time: the loops behind the integrator's verbs.

use super::Phase;
use super::fields::EvolvingFraction;
use crate::budget::Works;
use crate::material::{Material, Memory};
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::Vector;
use crate::time::Moment;
use core::ops::{Add, Mul};

impl<T: Real, const D: usize, M: Material<T>> Phase<T, D, M> {
    /// `X_target ← X_base + dt · DX/Dt` for every particle but prescribed walls, made admissible;
    /// returns what the law's return took \[J\].
    pub(crate) fn advance(&mut self, target: Moment, base: Moment, dt: T) -> Works {
        let mut fields = core::mem::take(self.fields_mut(target));
        let base_moment = base;
        let base = (base != target).then(|| self.fields(base));
        let walls = self.wall_particles();
        parallel::for_each_part(&mut fields.velocity, 1, CHUNK, &|first, part: &mut [Vector<T, D>]| {
            let (i, (_, part)) = (walls.max(first), split(part, walls, first));
            kick(part, base.map(|base| &base.velocity[i..]), &self.rate.acceleration[i..], dt);
        });
        parallel::for_each_part(&mut fields.excess, 1, CHUNK, &|first, part: &mut [T]| {
            let (i, (wall, rest)) = (walls.max(first), split(part, walls, first));
            for (k, e) in wall.iter_mut().enumerate().filter(|(k, _)| self.is_evolving(first + k)) {
                *e = base.map_or(*e, |base| base.excess[first + k]) + self.rate.excess[first + k] * dt;
            }
            kick(rest, base.map(|base| &base.excess[i..]), &self.rate.excess[i..], dt);
        });
        let mut returned = Works::default();
        if size_of::<M::Memory>() > 0 {
            returned = self.advance_memory(&mut fields.memory, base.map(|base| &base.memory[..]), dt);
        }
        *self.fields_mut(target) = fields;
        self.advance_fraction(target, base_moment, dt);
        self.advance_hold(target, base_moment, dt);
        returned
    }

    /// [`advance`](Self::advance) to half the step over `kick` \[s\], [`drift`](Self::drift) over `dt`, and the fields at
    /// the whole step, the density with the slope of its rate: chunk by chunk, which stays in the cache meanwhile.
    /// Returns what the law's return took at half the step and at the whole \[J\].
    pub(crate) fn leap(&mut self, kick: T, dt: T, slope: T, start: f64) -> [Works; 2] {
        let whole = T::of(0.5) * dt;
        let [mut half, mut now] = [core::mem::take(&mut self.half), core::mem::take(&mut self.now)];
        self.leap_positions(&mut half.velocity, &mut now.velocity, [kick, dt, whole]);
        self.leap_densities(&mut half.excess, &mut now.excess, [kick, whole, slope]);
        let mut returned = [Works::default(); 2];
        if size_of::<M::Memory>() > 0 {
            returned[0] = self.advance_memory(&mut half.memory, None, kick);
            returned[1] = self.advance_memory(&mut now.memory, Some(&half.memory), whole);
        }
        (self.half, self.now) = (half, now);
        self.advance_fraction(Moment::Half, Moment::Half, kick);
        self.advance_fraction(Moment::Now, Moment::Half, whole);
        self.advance_hold(Moment::Half, Moment::Half, kick);
        if self.walls().iter().any(super::Wall::moves) {
            self.move_walls(dt, start);
        }
        self.advance_hold(Moment::Now, Moment::Half, whole);
        returned
    }

    /// Velocities at half the step (71), positions (72), velocities at the whole step, of all but walls.
    fn leap_positions(&mut self, half: &mut [Vector<T, D>], now: &mut [Vector<T, D>], steps: [T; 3]) {
        let [by, dt, whole] = steps;
        let walls = self.wall_particles();
        let acceleration = &self.rate.acceleration;
        let chunks = half.chunks_mut(CHUNK).zip(now.chunks_mut(CHUNK)).zip(self.position.chunks_mut(CHUNK));
        let mut chunks: Vec<_> = chunks.collect();
        parallel::for_each_part(&mut chunks, 1, 1, &|n, chunk: &mut [((&mut [_], &mut [_]), &mut [_])]| {
            let ((half, now), x) = &mut chunk[0];
            let rate = &acceleration[walls.max(n * CHUNK)..];
            let [(_, half), (_, now), (_, x)] = [half, now, x].map(|part| split(part, walls, n * CHUNK));
            kick(half, None, rate, by);
            kick(x, None, half, dt);
            kick(now, Some(half), rate, whole);
        });
    }

    /// Densities at half the step and at the whole, of all but walls that have their fields given.
    fn leap_densities(&mut self, half: &mut [T], now: &mut [T], [by, whole, slope]: [T; 3]) {
        let rates = &self.rate.excess;
        let mut before = core::mem::take(&mut self.rate.excess_before);
        if slope == T::ZERO {
            before.clear();
        } else if before.len() != rates.len() {
            before.clone_from(rates);
        }
        let mut chunks_before = before.chunks_mut(CHUNK);
        let mut chunks: Vec<_> = half
            .chunks_mut(CHUNK)
            .zip(now.chunks_mut(CHUNK))
            .map(|(half, now)| (half, now, chunks_before.next()))
            .collect();
        type Chunk<'a, T> = (&'a mut [T], &'a mut [T], Option<&'a mut [T]>);
        parallel::for_each_part(&mut chunks, 1, 1, &|n, chunk: &mut [Chunk<T>]| {
            let (half, now, before) = &mut chunk[0];
            let first = n * CHUNK;
            let walls = self.wall_particles().saturating_sub(first).min(half.len());
            // Walls whose fields are given are gone over with the others, in plain vector code, and get theirs back.
            let given = |k: &usize| !self.is_evolving(first + k);
            let kept: Vec<_> = (0..walls).filter(given).map(|k| (k, half[k], now[k])).collect();
            let rates = &rates[first..first + half.len()];
            kick(half, None, rates, by);
            kick(now, Some(half), rates, whole);
            if let Some(before) = before {
                for ((e, before), &rate) in now.iter_mut().zip(&mut **before).zip(rates) {
                    *e += (rate - *before) * (slope * whole);
                    *before = rate;
                }
            }
            for (k, kept_half, kept_now) in kept {
                (half[k], now[k]) = (kept_half, kept_now);
            }
        });
        drop(chunks);
        self.rate.excess_before = before;
    }

    /// `φ_target ← φ_base + dt · Dφ/Dt` (69), of water that shares its space.
    fn advance_fraction(&mut self, target: Moment, base: Moment, dt: T) {
        let Some(EvolvingFraction { half, rate }) = &mut self.evolving_fraction else { return };
        for ((now, half), &rate) in self.volume_fraction.iter_mut().zip(half).zip(&*rate) {
            let start = if base == Moment::Now { *now } else { *half };
            let end = start + rate * dt;
            match target {
                Moment::Now => *now = end,
                Moment::Half => *half = end,
            }
        }
    }

    /// `memory ← base + dt · rate`, made admissible; returns what that took \[J\].
    fn advance_memory(&self, memories: &mut [M::Memory], base: Option<&[M::Memory]>, dt: T) -> Works {
        let advance = |first: usize, part: &mut [M::Memory]| {
            let mut returned = Works::default();
            for (k, memory) in part.iter_mut().enumerate() {
                let i = first + k;
                if self.is_evolving(i) {
                    let start = base.map_or(*memory, |base| base[i]);
                    let (admitted, loss) = self.material().admit(start.advanced(self.rate.memory[i], dt));
                    *memory = admitted;
                    returned.book(&loss, self.matter(i));
                }
            }
            returned
        };
        parallel::change_and_reduce(memories, Works::default(), advance, |a, b| a + b)
    }

    /// `x ← x + dt · v`; walls follow their prescribed motion from time `start` \[s\].
    pub(crate) fn drift(&mut self, moment: Moment, dt: T, start: f64) {
        let walls = self.wall_particles();
        let mut positions = core::mem::take(&mut self.position);
        let velocity = &self.fields(moment).velocity;
        parallel::for_each_part(&mut positions, 1, CHUNK, &|first, part: &mut [Vector<T, D>]| {
            let (i, (_, part)) = (walls.max(first), split(part, walls, first));
            kick(part, None, &velocity[i..], dt);
        });
        self.position = positions;
        if self.walls().iter().any(super::Wall::moves) {
            self.move_walls(dt, start);
        }
    }

    /// Second order: with the velocity at half the step, at half the way.
    fn move_walls(&mut self, dt: T, start: f64) {
        let (middle, end) = (start + 0.5 * dt.as_f64(), start + dt.as_f64());
        let half = dt * T::of(0.5);
        for i in 0..self.wall_particles() {
            let wall = &self.walls()[usize::from(self.body[i])];
            let x = self.position[i];
            let midway = x + wall.velocity(&x, start) * half;
            let next = x + wall.velocity(&midway, middle) * dt;
            let (before, after) = (wall.velocity(&x, start), wall.velocity(&next, end));
            self.position[i] = next;
            self.wall_acceleration[i] = (after - before) * (T::ONE / dt);
            self.now.velocity[i] = after;
            self.half.velocity[i] = after;
        }
    }
}

/// Splits a part that begins at particle `first` into walls and the others. The index of the first
/// of these is `walls.max(first)`, if there is one.
fn split<X>(part: &mut [X], walls: usize, first: usize) -> (&mut [X], &mut [X]) {
    part.split_at_mut(walls.saturating_sub(first).min(part.len()))
}

/// `x ← base + dt · rate`, or `x ← x + dt · rate`. Plain slices, so that it becomes vector code.
fn kick<T: Copy, X: Copy + Add<Output = X> + Mul<T, Output = X>>(
    part: &mut [X],
    base: Option<&[X]>,
    rate: &[X],
    dt: T,
) {
    match base {
        Some(base) => {
            for ((x, &base), &rate) in part.iter_mut().zip(base).zip(rate) {
                *x = base + rate * dt;
            }
        }
        None => {
            for (x, &rate) in part.iter_mut().zip(rate) {
                *x = *x + rate * dt;
            }
        }
    }
}
