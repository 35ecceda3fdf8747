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
            let end = (0..steps).find(|&n| filled(height(n)) < 0.5 * fraction).unwrap_or(steps);
            (x, height(end))
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
        let step = TANK[0] / self.floor.len().max(1) as f64;
        self.floor.iter().filter(|(_, y)| *y < level).count() as f64 * step
    }

    /// Width at half the depth over that at a tenth of it \[-\].
    pub fn roundness(&self) -> f64 {
        self.width_at(0.5) / self.width_at(0.1)
    }
}
