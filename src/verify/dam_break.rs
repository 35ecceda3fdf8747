//! What is measured on the paper's water dam break: front, pressure noise, velocity error (78).

use crate::kernel::Kernel;
use crate::material::Material;
use crate::mixture::Mixture;
use crate::real::{Num, Real};
use std::collections::BTreeMap;

/// Width L of the water column \[m\]; it is twice as high.
pub const WIDTH: f64 = 0.1;
/// Height H of the water column \[m\].
pub const HEIGHT: f64 = 0.2;
/// Width of the tank \[m\].
pub const TANK: f64 = 0.4;
/// Gravity \[m/s²\].
pub const GRAVITY: f64 = 9.81;
/// Typical velocity in (78) \[m/s\].
pub const TYPICAL_VELOCITY: f64 = 2.5;

/// The paper's dimensionless time `T = t √(2g/L)`.
pub fn dimensionless_time(t: f64) -> f64 {
    t * (2.0 * GRAVITY / WIDTH).sqrt()
}

/// Dimensionless position `X = x/L` of the leading edge: the foremost particle and half its spacing.
pub fn front<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
    mixture: &Mixture<T, D, K, S, F>,
) -> f64 {
    let water = mixture.water();
    let edge =
        |i: usize| water.positions()[i][0].as_f64() + 0.5 * water.volume(i).as_f64().powf(1.0 / D as f64);
    (water.wall_particles()..water.len()).map(edge).fold(0.0, f64::max) / WIDTH
}

/// A curve `X(T)`, straight between its points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    points: Vec<(f64, f64)>,
}

impl Curve {
    /// A curve through points in ascending order of `T`.
    pub fn new(points: Vec<(f64, f64)>) -> Self {
        Self { points }
    }

    /// Adds a point behind the last.
    pub fn push(&mut self, time: f64, value: f64) {
        self.points.push((time, value));
    }

    /// Its points.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Its value at `time`; `None` outside.
    pub fn at(&self, time: f64) -> Option<f64> {
        let after = self.points.partition_point(|p| p.0 < time);
        let right = *self.points.get(after)?;
        if right.0 == time {
            return Some(right.1);
        }
        let left = *self.points.get(after.checked_sub(1)?)?;
        Some(left.1 + (right.1 - left.1) * (time - left.0) / (right.0 - left.0))
    }

    /// The part of it between two times, ends included.
    pub fn between(&self, from: f64, to: f64) -> Self {
        Self::new(self.points.iter().copied().filter(|p| (from..=to).contains(&p.0)).collect())
    }

    /// How far its points leave the envelope of `others` at most: zero if it stays inside. Where only
    /// some of them are known, those make the envelope.
    pub fn beyond(&self, others: &[&Self]) -> f64 {
        let beyond = self.points.iter().map(|&(time, value)| {
            let known = || others.iter().filter_map(|other| other.at(time));
            let (low, high) =
                (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
            (low - value).max(value - high).max(0.0)
        });
        // Where nothing is known, nothing can be said.
        beyond.filter(|x| x.is_finite()).fold(0.0, f64::max)
    }

    /// Root mean square of its distance from `reference`'s points, each `shift` later, and how many
    /// points had a counterpart.
    pub fn distance(&self, reference: &Self, shift: f64) -> (f64, usize) {
        let errors: Vec<f64> = reference
            .points
            .iter()
            .filter_map(|&(time, value)| Some(self.at(time + shift)? - value))
            .collect();
        let mean = errors.iter().map(|e| e * e).sum::<f64>() / errors.len().max(1) as f64;
        (mean.sqrt(), errors.len())
    }

    /// The time shift of `reference` between −0.5 and 0.5 that fits best, with what then remains; at
    /// least nine tenths of the points must have a counterpart.
    pub fn best_shift(&self, reference: &Self) -> (f64, f64) {
        let enough = reference.points.len() * 9 / 10;
        (-500..=500)
            .map(|k| f64::from(k) * 1e-3)
            .map(|shift| (shift, self.distance(reference, shift)))
            .filter(|(_, (_, count))| *count >= enough)
            .map(|(shift, (rms, _))| (shift, rms))
            .fold((0.0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
    }
}

/// Root mean square of the pressure less its Shepard mean, over `ρgH`, of the particles farther than
/// the support from surface and walls; and how many those are.
pub fn pressure_noise<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
    mixture: &Mixture<T, D, K, S, F>,
) -> (f64, usize) {
    let (water, neighbourhood) = (mixture.water(), mixture.water_neighbourhood());
    let (walls, kernel) = (water.wall_particles(), mixture.kernel());
    let own = kernel.value(T::ZERO);
    let mut filled = vec![T::ZERO; water.len()];
    let mut mean = vec![T::ZERO; water.len()];
    for i in walls..water.len() {
        let mut weight = water.volume(i) * own;
        let mut pressure = weight * water.pressures()[i];
        neighbourhood.for_each_neighbour(water.positions(), i, |j, _, r2: T| {
            let w = water.volume(j) * kernel.value(r2);
            weight += w;
            pressure += w * water.pressures()[j];
        });
        filled[i] = weight;
        mean[i] = pressure / weight;
    }
    let at_surface = |i: usize| i >= walls && filled[i] < T::of(0.9);
    let (mut sum, mut count) = (0.0, 0);
    for i in walls..water.len() {
        let mut inside = !at_surface(i);
        neighbourhood.for_each_neighbour(water.positions(), i, |j, _, _: T| {
            inside &= j >= walls && !at_surface(j);
        });
        if inside {
            let noise = (water.pressures()[i] - mean[i]).as_f64();
            sum += noise * noise;
            count += 1;
        }
    }
    let scale = water.material().reference_density().as_f64() * GRAVITY * HEIGHT;
    ((sum / f64::from(count.max(1))).sqrt() / scale, count as usize)
}

/// Velocities of a finite-volume solution on a regular grid, where there is water.
#[derive(Clone, Debug)]
pub struct Reference {
    cell: f64,
    velocity: BTreeMap<(i64, i64), [f64; 2]>,
}

/// Error of the horizontal velocity (78).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityError {
    /// L₂ (78) \[-\].
    pub l2: f64,
    /// Particles compared.
    pub compared: usize,
    /// Particles more than 1.5 cells from any water cell, left out.
    pub left_out: usize,
}

impl Reference {
    /// From rows `x, y, u_x, u_y` of cell centres on a grid of cells of size `cell` \[m\] that begins at
    /// the origin.
    pub fn new(rows: impl IntoIterator<Item = [f64; 4]>, cell: f64) -> Self {
        let index = |x: f64| (x / cell).floor() as i64;
        Self { cell, velocity: rows.into_iter().map(|[x, y, u, v]| ((index(x), index(y)), [u, v])).collect() }
    }

    /// Horizontal velocity at a place: bilinear between four water cells, else of the nearest within
    /// 1.5 cells; `None` farther away.
    pub fn horizontal(&self, x: f64, y: f64) -> Option<f64> {
        let (a, b) = (x / self.cell - 0.5, y / self.cell - 0.5);
        let (i, j) = (a.floor() as i64, b.floor() as i64);
        let corner = |di: i64, dj: i64| self.velocity.get(&(i + di, j + dj)).map(|u| u[0]);
        let (s, t) = (a - a.floor(), b - b.floor());
        if let (Some(u00), Some(u10), Some(u01), Some(u11)) =
            (corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1))
        {
            return Some((1.0 - t) * ((1.0 - s) * u00 + s * u10) + t * ((1.0 - s) * u01 + s * u11));
        }
        let mut nearest = (1.5f64 * 1.5, None);
        for di in -1..=2 {
            for dj in -1..=2 {
                let distance2 = (s - di as f64).powi(2) + (t - dj as f64).powi(2);
                if let Some(u) = corner(di, dj).filter(|_| distance2 <= nearest.0) {
                    nearest = (distance2, Some(u));
                }
            }
        }
        nearest.1
    }

    /// Error of the horizontal velocity of all particles against this solution (78).
    pub fn velocity_error<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
        &self,
        mixture: &Mixture<T, D, K, S, F>,
    ) -> VelocityError {
        let water = mixture.water();
        let (mut sum, mut volume, mut compared, mut left_out) = (0.0, 0.0, 0, 0);
        for i in water.wall_particles()..water.len() {
            let x = water.positions()[i];
            let Some(reference) = self.horizontal(x[0].as_f64(), x[1].as_f64()) else {
                left_out += 1;
                continue;
            };
            let error = (water.velocities()[i][0].as_f64() - reference) / TYPICAL_VELOCITY;
            sum += water.volume(i).as_f64() * error * error;
            volume += water.volume(i).as_f64();
            compared += 1;
        }
        VelocityError { l2: (sum / volume).sqrt(), compared, left_out }
    }
}

/// How many particles are outside the tank's walls, sideways or below.
pub fn leaked<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
    mixture: &Mixture<T, D, K, S, F>,
) -> usize {
    let water = mixture.water();
    let outside = |x: f64, y: f64| !(0.0..=TANK).contains(&x) || y < 0.0;
    water.positions()[water.wall_particles()..]
        .iter()
        .filter(|x| outside(x[0].as_f64(), x[1].as_f64()))
        .count()
}

/// How many particles hang at the left wall, two spacings or more above the surface beside it.
pub fn stuck<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
    mixture: &Mixture<T, D, K, S, F>,
) -> usize {
    let water = mixture.water();
    let spacing =
        (0..water.len()).map(|i| water.volume(i)).fold(T::ZERO, Num::max).as_f64().powf(1.0 / D as f64);
    let particles = &water.positions()[water.wall_particles()..];
    let near = |x: f64, from: f64, to: f64| (from * spacing..to * spacing).contains(&x);
    let beside = particles.iter().filter(|x| near(x[0].as_f64(), 3.0, 8.0));
    let surface = beside.map(|x| x[1].as_f64()).fold(0.0, f64::max);
    particles
        .iter()
        .filter(|x| near(x[0].as_f64(), -9.0, 2.0) && x[1].as_f64() > surface + 2.0 * spacing)
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parabola(shift: f64) -> Curve {
        let point = |n| (0.05 * f64::from(n), 1.0 + 0.4 * (0.05 * f64::from(n) + shift).powi(2));
        Curve::new((0..=80).map(point).collect())
    }

    #[test]
    fn a_shift_in_time_is_found() {
        let (shift, rms) = parabola(0.0).best_shift(&parabola(0.2).between(0.5, 2.5));
        assert!(rms < 1e-3 && (shift - 0.2).abs() < 2e-3, "{rms} {shift}");
    }

    #[test]
    fn leaving_an_envelope_is_measured() {
        let (low, high) = (parabola(-0.1), parabola(0.1));
        // The parabolas cross near their feet.
        assert_eq!(parabola(0.0).between(0.2, 4.0).beyond(&[&low, &high]), 0.0);
        let by = parabola(0.2).between(1.0, 1.951).beyond(&[&low, &high]);
        assert!((by - 0.4 * (2.15_f64.powi(2) - 2.05_f64.powi(2))).abs() < 1e-3, "{by}");
        assert_eq!(low.at(100.0), None);
    }
}
