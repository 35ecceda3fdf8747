//! What is measured on water that seeps through soil at the bottom of a U-tube, and the exact course of its
//! levels.

use super::Parcel;
use crate::kernel::{Kernel, WendlandC2};
use core::ops::Range;

/// Particle spacing Δx \[m\] of the paper; the tube is told in spacings, so that its counts come out.
pub const SPACING: f64 = 0.05;
/// Width of arms and channel, in spacings.
pub const WIDTH: usize = 21;
/// Length of the channel, in spacings.
pub const CHANNEL: usize = 69;
/// Height of the arms above the channel, in spacings.
pub const ARMS: usize = 62;
/// Levels of water in the left and the right arm above the channel, in spacings: the figure is lost, these
/// give the paper's 3108 particles.
pub const LEVELS: [usize; 2] = [60, 19];
/// Porosity n of the soil \[-\].
pub const POROSITY: f64 = 0.45;
/// g \[m/s²\].
const GRAVITY: f64 = 9.81;

/// Where the soil begins and ends along the channel \[m\].
pub fn sample() -> [f64; 2] {
    [WIDTH as f64 * SPACING, (CHANNEL - WIDTH) as f64 * SPACING]
}

/// Difference of the levels at the start \[m\].
pub fn initial_difference() -> f64 {
    (LEVELS[0] as f64 - LEVELS[1] as f64) * SPACING
}

/// The difference of levels 2z \[m\] at time t \[s\] for a conductivity k \[m/s\]:
///
/// $$\Big(L_o + \frac Ln\Big)\ddot z + \frac{gL}{k}\dot z + 2 g z = 0,$$
///
/// with the length L of the soil and L_o of the open water. The paper's Eq. (80) is its slow root alone.
pub fn exact_difference(time: f64, conductivity: f64) -> f64 {
    let [begin, end] = sample();
    let length = end - begin;
    let open = (2 * WIDTH + LEVELS[0] + LEVELS[1]) as f64 * SPACING;
    let (a, b, c) = (open + length / POROSITY, GRAVITY * length / conductivity, 2.0 * GRAVITY);
    let root = (b * b - 4.0 * a * c).sqrt();
    // The slow root without a difference of nearly equal numbers.
    let (slow, fast) = (-2.0 * c / (b + root), -(b + root) / (2.0 * a));
    let course = fast * (slow * time).exp() - slow * (fast * time).exp();
    initial_difference() * course / (fast - slow)
}

/// Where the water is at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels {
    /// When \[s\].
    pub time: f64,
    /// Water beyond the soil \[m²\], that in the soil by the part of it that is behind: its rate is the flow
    /// averaged over the soil.
    pub beyond: f64,
    /// Difference of the free surfaces \[m\].
    pub surface: f64,
    /// Difference of the heads p/ρg + y at the ends of the soil \[m\].
    pub head: f64,
    /// Darcy velocity q = ⟨φ v⟩ in the soil \[m/s\].
    pub flow: f64,
}

impl Levels {
    /// Of this water of reference density 1000 kg/m³.
    pub fn of(time: f64, water: &[Parcel]) -> Self {
        let [begin, end] = sample();
        let width = WIDTH as f64 * SPACING;
        let behind = |x: f64| ((x - begin) / (end - begin)).clamp(0.0, 1.0);
        let seeping = water.iter().filter(|it| (begin..end).contains(&it.place[0]) && it.place[1] < width);
        let moved: f64 = seeping.map(|it| it.volume * it.fraction * it.velocity[0]).sum();
        let arm = |low: f64| surface(water, low + 0.2 * width, low + 0.8 * width);
        let [before, after] = heads_beside(water);
        Self {
            time,
            beyond: water.iter().map(|it| it.matter * behind(it.place[0])).sum(),
            surface: arm(0.0) - arm(end),
            head: before - after,
            flow: moved / ((end - begin) * width),
        }
    }

    /// Difference of levels \[m\] by the water that has come through since `start`.
    pub fn by_mass(&self, start: &Self) -> f64 {
        initial_difference() - 2.0 * (self.beyond - start.beyond) / (WIDTH as f64 * SPACING)
    }

    /// q L/(k Δh) \[-\]: one by Darcy's law.
    pub fn darcy_ratio(&self, conductivity: f64) -> f64 {
        let [begin, end] = sample();
        self.flow * (end - begin) / (conductivity * self.head)
    }
}

/// Columns of the soil whose heads are means: three spacings each, so that none is ever without water.
const SLICES: usize = 9;

/// The head p/ρg + y \[m\] along the soil at one instant: what stands in a pipe on the channel's floor.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadProfile {
    /// When \[s\].
    pub time: f64,
    /// Place x and head, both \[m\], where the soil begins and ends: those of the water before and behind it.
    /// Darcy's flow has a straight line between them.
    pub ends: [(f64, f64); 2],
    /// Mean place x and mean head, both \[m\], of the water in each column of the soil.
    pub columns: Vec<(f64, f64)>,
}

impl HeadProfile {
    /// Of this water of reference density 1000 kg/m³.
    pub fn of(time: f64, water: &[Parcel]) -> Self {
        let [begin, end] = sample();
        let [before, after] = heads_beside(water);
        let place = |n: usize| begin + (end - begin) * n as f64 / SLICES as f64;
        let column = |n: usize| mean_head(water, place(n)..place(n + 1));
        Self { time, ends: [(begin, before), (end, after)], columns: (0..SLICES).map(column).collect() }
    }
}

/// Places across an arm where its surface is looked for.
const COLUMNS: usize = 13;

/// Mean height of the free surface \[m\] between two places of an arm: where water fills half of a kernel.
fn surface(water: &[Parcel], low: f64, high: f64) -> f64 {
    let kernel = WendlandC2::<f64, 2>::new(1.3 * SPACING).expect("a length");
    let reach = kernel.support();
    let height = |x: f64| {
        let near: Vec<&Parcel> = water.iter().filter(|it| (it.place[0] - x).abs() < reach).collect();
        let filled = |y: f64| -> f64 {
            let part = |it: &&Parcel| {
                it.volume * kernel.value::<f64>((it.place[0] - x).powi(2) + (it.place[1] - y).powi(2))
            };
            near.iter().map(part).sum()
        };
        let top = near.iter().map(|it| it.place[1]).fold(0.0, f64::max);
        // Half filled lies between a place well inside and one well outside.
        let (mut inside, mut outside) = (top - 2.0 * SPACING, top + reach);
        for _ in 0..40 {
            let middle = 0.5 * (inside + outside);
            *(if filled(middle) < 0.5 { &mut outside } else { &mut inside }) = middle;
        }
        0.5 * (inside + outside)
    };
    let place = |n: usize| low + (high - low) * n as f64 / (COLUMNS - 1) as f64;
    (0..COLUMNS).map(|n| height(place(n))).sum::<f64>() / COLUMNS as f64
}

/// Mean heads \[m\] in the middle of the channel's open parts before and behind the soil, walls and soil left aside.
fn heads_beside(water: &[Parcel]) -> [f64; 2] {
    let width = WIDTH as f64 * SPACING;
    [0.0, sample()[1]].map(|low| mean_head(water, low + 0.2 * width..low + 0.8 * width).1)
}

/// Mean place x and mean head, both \[m\], of the water in a part of the channel, its floor and top left aside.
fn mean_head(water: &[Parcel], along: Range<f64>) -> (f64, f64) {
    let width = WIDTH as f64 * SPACING;
    let up = 0.2 * width..0.8 * width;
    let inside = water.iter().filter(|it| along.contains(&it.place[0]) && up.contains(&it.place[1]));
    let head = |it: &Parcel| it.pressure / (1000.0 * GRAVITY) + it.place[1];
    let (count, place, sum) =
        inside.fold((0, 0.0, 0.0), |(count, x, sum), it| (count + 1, x + it.place[0], sum + head(it)));
    let count = f64::from(count.max(1));
    (place / count, sum / count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Water whose head falls evenly along the channel from 3 m to 2 m.
    #[test]
    fn the_profile_of_a_head_that_falls_evenly_is_a_line() {
        let head = |x: f64| 3.0 - x / (CHANNEL as f64 * SPACING);
        let place = |n: usize| [n % CHANNEL, n / CHANNEL].map(|n| (n as f64 + 0.5) * SPACING);
        let parcel = |place: [f64; 2]| Parcel {
            place,
            velocity: [0.0; 2],
            volume: SPACING * SPACING,
            matter: SPACING * SPACING,
            fraction: 1.0,
            pressure: 1000.0 * GRAVITY * (head(place[0]) - place[1]),
        };
        let water: Vec<Parcel> = (0..CHANNEL * WIDTH).map(place).map(parcel).collect();
        let profile = HeadProfile::of(0.0, &water);
        for (x, value) in &profile.columns {
            assert!((value - head(*x)).abs() < 1e-12, "{value} at {x}");
        }
        assert_eq!(profile.columns.len(), SLICES);
        // The ends have the heads of the open parts, half of their width away.
        let half = 0.5 * WIDTH as f64 * SPACING;
        let [(begin, before), (end, after)] = profile.ends;
        assert!((before - head(begin - half)).abs() < 1e-12 && (after - head(end + half)).abs() < 1e-12);
    }
}
