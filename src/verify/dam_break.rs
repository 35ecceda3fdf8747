//! What is measured on the paper's water dam break: front, pressure noise, velocity error (78).

use crate::kernel::Kernel;
use crate::material::Material;
use crate::mixture::{Mixture, Phase};
use crate::real::{Num, Real};
use crate::space::Vector;
use std::collections::BTreeMap;

pub use super::Curve;

/// Width L of the water column \[m\]; it is twice as high.
pub const WIDTH: f64 = 0.1;
/// Height H of the water column \[m\].
pub const HEIGHT: f64 = 0.2;
/// Width of the tank \[m\].
pub const TANK: f64 = 0.4;
/// Gravity \[m/s²\].
pub const GRAVITY: f64 = 9.81;
/// The paper's particle spacing \[m\]: 12 800 particles.
pub const SPACING: f64 = 0.001_25;
/// The paper's time step \[s\] (Table 1).
pub const STEP: f64 = 1e-5;
/// Typical velocity in (78) \[m/s\].
pub const TYPICAL_VELOCITY: f64 = 2.5;

/// The paper's dimensionless time `T = t √(2g/L)`.
pub fn dimensionless_time(t: f64) -> f64 {
    t * (2.0 * GRAVITY / WIDTH).sqrt()
}

/// The paper's time step \[s\] at a particle spacing \[m\]: the printed one, and at finer spacings than the
/// paper's one of the same Courant number, 0.2.
pub fn step(spacing: f64) -> f64 {
    STEP * (spacing / SPACING).min(1.0)
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

/// How many particles went through the tank's walls, sideways or below, or over them: they are beyond the
/// first layer of wall particles, which is half a spacing behind the face.
pub fn leaked<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
    mixture: &Mixture<T, D, K, S, F>,
) -> usize {
    let layer = 0.5 * spacing(mixture.water());
    behind(mixture.water()).filter(|&depth| depth > layer).count()
}

/// How far the farthest particle is behind the face of the tank's walls, in spacings; zero where none is. Below
/// one half it is pressed against the wall, between the face and the wall's first layer.
pub fn deepest<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
    mixture: &Mixture<T, D, K, S, F>,
) -> f64 {
    behind(mixture.water()).fold(0.0, f64::max) / spacing(mixture.water())
}

/// How far each particle is behind the face of a wall \[m\]; negative inside the tank.
fn behind<T: Real, const D: usize, M: Material<T>>(water: &Phase<T, D, M>) -> impl Iterator<Item = f64> {
    let depth = |x: &Vector<T, D>| (-x[0].as_f64()).max(x[0].as_f64() - TANK).max(-x[1].as_f64());
    water.positions()[water.wall_particles()..].iter().map(depth)
}

/// The particles' spacing \[m\], that of the largest.
fn spacing<T: Real, const D: usize, M: Material<T>>(water: &Phase<T, D, M>) -> f64 {
    (0..water.len()).map(|i| water.volume(i)).fold(T::ZERO, Num::max).as_f64().powf(1.0 / D as f64)
}

/// How many particles hang at the left wall, two spacings or more above the surface beside it.
pub fn stuck<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
    mixture: &Mixture<T, D, K, S, F>,
) -> usize {
    let water = mixture.water();
    let spacing = spacing(water);
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
    use crate::kernel::WendlandC2;
    use crate::material::Water;

    #[test]
    fn a_particle_pressed_against_a_wall_is_not_through_it() {
        let spacing = 0.01;
        let mixture = |places: &[[f64; 2]]| {
            let mut phase = Phase::new(Water::new(1000.0, 25.0).expect("water"));
            let places: Vec<_> = places.iter().map(|&x| Vector(x)).collect();
            phase.add(&places, spacing * spacing, |_| 0.0).expect("particles");
            Mixture::<f64, 2>::of_water(WendlandC2::new(1.3 * spacing).expect("a length"), phase)
        };
        let pressed = mixture(&[[-0.4 * spacing, 0.1], [0.2, -0.3 * spacing], [0.2, 0.1]]);
        assert_eq!(leaked(&pressed), 0);
        assert!((deepest(&pressed) - 0.4).abs() < 1e-12);
        let through = mixture(&[[-0.6 * spacing, 0.1], [0.2, -0.7 * spacing], [TANK + 1.0, 2.0], [0.2, 0.1]]);
        assert_eq!(leaked(&through), 3);
        assert!((deepest(&through) - 100.0).abs() < 1e-9);
        assert_eq!(deepest(&mixture(&[[0.2, 0.1]])), 0.0);
    }
}
