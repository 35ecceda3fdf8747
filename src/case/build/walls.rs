//! The walls of a tank.

use super::{array, vector};
use crate::case::choice::Side;
use crate::case::model::{Case, Region, Walls};
use crate::error::ParameterError;
use crate::material::Material;
use crate::mixture::{Phase, Slip, Wall};
use crate::real::Real;
use crate::setup;
use crate::space::Vector;

/// Which particles of the walls a constituent gets, and what it does along them.
pub(super) struct Kept<'a, T, const D: usize> {
    pub(super) filled: &'a dyn Fn(&Vector<T, D>) -> bool,
    /// Whether they take no space from the water.
    pub(super) apart: bool,
    pub(super) slip: Option<Slip>,
}

impl Case {
    /// One wall for each closed side, then one for each obstacle. What is outside several sides, as a corner is, belongs to the first
    /// that rests: a wall that moves would drag the corner through its neighbour.
    pub(super) fn add_walls<T: Real, const D: usize, M: Material<T>>(
        &self,
        phase: &mut Phase<T, D, M>,
        kept: Kept<'_, T, D>,
        pressure: impl Fn(&Vector<T, D>) -> T,
    ) -> Result<(), ParameterError> {
        let Some(tank) = &self.tank else { return Ok(()) };
        let sides = self.wall_sides();
        let spacing = self.particles.spacing;
        let closed = core::array::from_fn(|k| {
            let has = |high| sides.iter().any(|side| side.axis() == k && side.is_high() == high);
            (has(false), has(true))
        });
        let (low, high) = (array::<D>(&tank.low), array::<D>(&tank.high));
        let all = setup::tank::<T, D>(low, high, spacing, tank.layers as usize, closed);
        let velocity = |side: Side| tank.moving.iter().find(|wall| wall.side == side);
        let is_outside = |x: &Vector<T, D>, side: Side| {
            let k = side.axis();
            let beyond = if side.is_high() {
                low[k] + ((high[k] - low[k]) / spacing).round() * spacing
            } else {
                low[k]
            };
            (x[k].as_f64() > beyond) == side.is_high()
        };
        let owner = |x: &Vector<T, D>| {
            let outside = || sides.iter().copied().filter(|side| is_outside(x, *side));
            outside().find(|side| velocity(*side).is_none()).or_else(|| outside().next())
        };
        for side in &sides {
            let own = all.iter().copied().filter(|x| owner(x) == Some(*side) && (kept.filled)(x));
            let own: Vec<Vector<T, D>> = own.collect();
            let wall = velocity(*side).map_or_else(
                || kept.wall(tank.walls),
                |moving| {
                    let velocity = vector(&moving.velocity);
                    kept.wall(tank.walls).moving(move |_, _| velocity)
                },
            );
            phase.add_wall(wall, &own, self.volume(), &pressure)?;
        }
        for obstacle in &tank.obstacles {
            let shell = self.shell(obstacle, tank.layers).into_iter().filter(|x| (kept.filled)(x));
            let own: Vec<Vector<T, D>> = shell.collect();
            phase.add_wall(kept.wall(tank.walls), &own, self.volume(), &pressure)?;
        }
        Ok(())
    }

    /// Whether `x`, in a wall, is behind a side at which a box touches that wall: there it goes on as the box.
    pub(super) fn is_behind<T: Real, const D: usize>(
        &self,
        low: &[f64],
        high: &[f64],
        x: &Vector<T, D>,
    ) -> bool {
        let Some(tank) = &self.tank else { return false };
        let near = 1e-6 * self.particles.spacing;
        let inside =
            |region: &&Region| (0..D).all(|k| (region.low[k]..=region.high[k]).contains(&x[k].as_f64()));
        let obstacles: Vec<&Region> = tank.obstacles.iter().filter(inside).collect();
        (0..D).all(|k| {
            let at = x[k].as_f64();
            let touches = |face: f64, of_tank: f64, of_obstacle: fn(&Region, usize) -> f64| {
                let meets = |other: f64| (face - other).abs() < near;
                meets(of_tank) || obstacles.iter().any(|region| meets(of_obstacle(region, k)))
            };
            if at < low[k] {
                touches(low[k], tank.low[k], |region, k| region.high[k])
            } else if at > high[k] {
                touches(high[k], tank.high[k], |region, k| region.low[k])
            } else {
                true
            }
        })
    }

    /// The outermost `layers` of particles that fill a box.
    fn shell<T: Real, const D: usize>(&self, region: &Region, layers: u64) -> Vec<Vector<T, D>> {
        let (low, high) = (array::<D>(&region.low), array::<D>(&region.high));
        let deep = layers as f64 * self.particles.spacing;
        let near = |x: f64, k: usize| (x - low[k]).min(high[k] - x) < deep;
        let mut particles = setup::fill::<T, D>(low, high, self.particles.spacing);
        particles.retain(|x| (0..D).any(|k| near(x[k].as_f64(), k)));
        particles
    }
}

impl<T: Real, const D: usize> Kept<'_, T, D> {
    fn wall(&self, walls: Walls) -> Wall<T, D> {
        let wall = match walls {
            Walls::Dynamic => Wall::dynamic(),
            Walls::Extrapolated(slip) => Wall::extrapolated(self.slip.unwrap_or(slip)),
        };
        if self.apart { wall.apart() } else { wall }
    }
}
