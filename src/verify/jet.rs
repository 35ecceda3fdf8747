//! What is measured on the hole a jet of water digs into saturated soil.

use super::Parcel;
use crate::kernel::{Kernel, WendlandC2};
use core::ops::Range;

/// Inner width and height of the tank, which soil fills to the rim \[m\]: the paper's counts less its walls.
pub const TANK: [f64; 2] = [0.45, 0.175];
/// Width of the nozzle, in the middle \[m\].
pub const NOZZLE: f64 = 0.02;
/// Height of its mouth above the soil \[m\].
pub const FALL: f64 = 0.02;
/// Speed of the jet \[m/s\].
pub const SPEED: f64 = 25.0;

/// The hole at one instant: where the soil's volume fraction is below half of that at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// Its floor, x and y \[m\], column by column.
    pub floor: Vec<(f64, f64)>,
}

impl Hole {
    /// In this soil, of particles a `spacing` \[m\] apart and of volume fraction `fraction` \[-\] at the start.
    pub fn of(soil: &[Parcel], spacing: f64, fraction: f64) -> Self {
        let kernel = WendlandC2::<f64, 2>::new(1.5 * spacing).expect("a length");
        let (reach, step) = (kernel.support(), 0.2 * spacing);
        let count = (TANK[0] / (0.5 * spacing)).round() as usize;
        let column = |n: usize| {
            let x = (n as f64 + 0.5) * 0.5 * spacing;
            let near: Vec<&Parcel> = soil.iter().filter(|it| (it.place[0] - x).abs() < reach).collect();
            let filled = |y: f64| -> f64 {
                let part = |it: &&Parcel| {
                    it.matter * kernel.value::<f64>((it.place[0] - x).powi(2) + (it.place[1] - y).powi(2))
                };
                near.iter().map(part).sum()
            };
            // From a support above the floor of the tank on, whose walls are not counted.
            let steps = ((TANK[1] + 2.0 * reach) / step) as usize;
            let height = |n: usize| reach + n as f64 * step;
            let excess = |n: usize| filled(height(n)) - 0.5 * fraction;
            let end = (0..steps).find(|&n| excess(n) < 0.0).unwrap_or(steps);
            // Within the step the fraction is taken as linear.
            let back = end.checked_sub(1).map_or(0.0, |n| excess(end) / (excess(end) - excess(n)));
            (x, height(end) - back * step)
        };
        Self { floor: (0..count).map(column).collect() }
    }

    /// Depth \[m\] under the nozzle: below the surface of the start.
    pub fn depth(&self) -> f64 {
        let under = 0.5 * (TANK[0] - NOZZLE)..0.5 * (TANK[0] + NOZZLE);
        self.deepest(under)
    }

    fn deepest(&self, range: Range<f64>) -> f64 {
        let inside = self.floor.iter().filter(|(x, _)| range.contains(x));
        TANK[1] - inside.map(|(_, y)| *y).fold(TANK[1], f64::min)
    }

    /// Width \[m\] at this part of the depth: of a hole shaped like a U it is at half the depth nearly what it
    /// is at the rim, of one like a V half of it.
    pub fn width_at(&self, part: f64) -> f64 {
        let level = TANK[1] - part * self.depth();
        // What of the line between two columns is below the level.
        let below = |pair: &[(f64, f64)]| {
            let [a, b] = [level - pair[0].1, level - pair[1].1];
            (pair[1].0 - pair[0].0) * (a.max(0.0) + b.max(0.0)) / (a.abs() + b.abs()).max(f64::MIN_POSITIVE)
        };
        self.floor.windows(2).map(below).sum()
    }

    /// Width at half the depth over that at a tenth of it \[-\].
    pub fn roundness(&self) -> f64 {
        self.width_at(0.5) / self.width_at(0.1)
    }

    /// Curvature \[1/m\] of the floor in the middle, of the parabola nearest to it over twice the nozzle's width:
    /// small for a U, large for a V.
    pub fn curvature(&self) -> f64 {
        let middle = 0.5 * TANK[0];
        let near = || self.floor.iter().map(|(x, y)| (x - middle, y)).filter(|(x, _)| x.abs() < NOZZLE);
        let count = near().count() as f64;
        let (square, height) = near().fold((0.0, 0.0), |(a, b), (x, y)| (a + x * x / count, b + y / count));
        let (above, below) = near().fold((0.0, 0.0), |(a, b), (x, y)| {
            let u = x * x - square;
            (a + u * (y - height), b + u * u)
        });
        2.0 * above / below
    }

    /// Section \[m²\] below the rim, voids in the soil with all above them.
    pub fn area(&self) -> f64 {
        let step = TANK[0] / self.floor.len().max(1) as f64;
        self.floor.iter().map(|(_, y)| (TANK[1] - y).max(0.0) * step).sum()
    }
}

/// Matter \[m²\] that was lifted above the rim, and the part of it that is outside the tank's width.
pub fn overflow(parcels: &[Parcel]) -> [f64; 2] {
    let matter =
        |out: fn(&Parcel) -> bool| parcels.iter().filter(|it| out(it)).fold(0.0, |sum, it| sum + it.matter);
    let beyond = |it: &Parcel| !(0.0..=TANK[0]).contains(&it.place[0]);
    [matter(|it| it.place[1] > TANK[1]), matter(beyond)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A saturated bed with this floor, as particles on a lattice.
    fn bed(spacing: f64, floor: impl Fn(f64) -> f64) -> Vec<Parcel> {
        let (columns, rows) = ((TANK[0] / spacing).round() as usize, (TANK[1] / spacing).round() as usize);
        let place = |n: usize| [(n % columns) as f64 + 0.5, (n / columns) as f64 + 0.5].map(|x| x * spacing);
        let parcel = |place| Parcel {
            place,
            velocity: [0.0; 2],
            volume: spacing * spacing,
            matter: 0.5 * spacing * spacing,
            fraction: 0.5,
            pressure: 0.0,
        };
        (0..columns * rows).map(place).filter(|x| x[1] < floor(x[0])).map(parcel).collect()
    }

    #[test]
    fn a_hole_is_measured_as_it_was_made() {
        let (spacing, depth, curvature) = (0.0025, 0.05, 40.0);
        let floor = |x: f64| TANK[1] - depth + 0.5 * curvature * (x - 0.5 * TANK[0]).powi(2);
        let hole = Hole::of(&bed(spacing, floor), spacing, 0.5);
        assert!((hole.depth() - depth).abs() < 0.5 * spacing, "{}", hole.depth());
        assert!((hole.curvature() / curvature - 1.0).abs() < 0.2, "{}", hole.curvature());
        let half_width = (2.0 * depth / curvature).sqrt();
        assert!((hole.area() / (4.0 / 3.0 * depth * half_width) - 1.0).abs() < 0.05, "{}", hole.area());
        assert!((hole.roundness() - (0.5_f64 / 0.9).sqrt()).abs() < 0.05, "{}", hole.roundness());
    }

    #[test]
    fn a_floor_between_two_steps_is_found_between_them() {
        let spacing = 0.005;
        let flat = |height: f64| Hole::of(&bed(spacing, |_| height), spacing, 0.5).floor[45].1;
        // A row of half the matter lifts the contour by less than a row.
        let mut topped = bed(spacing, |_| 0.1);
        topped.iter_mut().filter(|it| it.place[1] > 0.095).for_each(|it| it.matter *= 0.7);
        let between = Hole::of(&topped, spacing, 0.5).floor[45].1;
        assert!((flat(0.1) - 0.1).abs() < 1e-4, "{}", flat(0.1));
        assert!(between < flat(0.1) && between > flat(0.095), "{between}");
    }

    #[test]
    fn what_is_above_the_rim_and_beyond_it_is_counted() {
        let mut soil = bed(0.005, |_| TANK[1]);
        let piece = soil[0].matter;
        soil[0].place[1] = TANK[1] + 0.01;
        soil[1].place = [TANK[0] + 0.01, TANK[1] + 0.01];
        assert_eq!(overflow(&soil), [2.0 * piece, piece]);
    }
}
