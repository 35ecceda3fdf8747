//! The walls of a tank.

use super::{array, vector};
use crate::case::choice::Side;
use crate::case::model::{Case, Walls};
use crate::error::ParameterError;
use crate::material::Material;
use crate::mixture::{Phase, Wall};
use crate::real::Real;
use crate::setup;
use crate::space::Vector;

impl Case {
    /// One wall for each closed side. What is outside several sides, as a corner is, belongs to the first
    /// that rests: a wall that moves would drag the corner through its neighbour.
    pub(super) fn add_walls<T: Real, const D: usize, M: Material<T>>(
        &self,
        phase: &mut Phase<T, D, M>,
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
            let own: Vec<Vector<T, D>> = all.iter().copied().filter(|x| owner(x) == Some(*side)).collect();
            let wall = velocity(*side).map_or_else(
                || wall(tank.walls),
                |moving| {
                    let velocity = vector(&moving.velocity);
                    wall(tank.walls).moving(move |_, _| velocity)
                },
            );
            phase.add_wall(wall, &own, self.volume(), &pressure)?;
        }
        Ok(())
    }
}

fn wall<T: Real, const D: usize>(walls: Walls) -> Wall<T, D> {
    match walls {
        Walls::Dynamic => Wall::dynamic(),
        Walls::Extrapolated(slip) => Wall::extrapolated(slip),
    }
}
