//! Where particles start.

use crate::real::Real;
use crate::space::Vector;

/// Cell centres of a lattice of spacing `spacing` \[m\] that fills the box from `low` to `high` \[m\];
/// the box holds the nearest whole number of cells along each axis.
pub fn fill<T: Real, const D: usize>(low: [f64; D], high: [f64; D], spacing: f64) -> Vec<Vector<T, D>> {
    let counts: [usize; D] = core::array::from_fn(|k| cells(high[k] - low[k], spacing));
    lattice(&counts.map(|n| 0..n as i64), &|_| true, low, spacing)
}

/// Cell centres of the walls of a box from `low` to `high` \[m\]: `layers` layers outside it, on the
/// lattice of [`fill`], along every side that `closed[axis]` (below, above) names.
pub fn tank<T: Real, const D: usize>(
    low: [f64; D],
    high: [f64; D],
    spacing: f64,
    layers: usize,
    closed: [(bool, bool); D],
) -> Vec<Vector<T, D>> {
    let counts: [i64; D] = core::array::from_fn(|k| cells(high[k] - low[k], spacing) as i64);
    let layers = layers as i64;
    let ranges = core::array::from_fn(|k| {
        let below = if closed[k].0 { -layers } else { 0 };
        let above = if closed[k].1 { layers } else { 0 };
        below..counts[k] + above
    });
    lattice(&ranges, &|cell| (0..D).any(|k| cell[k] < 0 || cell[k] >= counts[k]), low, spacing)
}

fn cells(length: f64, spacing: f64) -> usize {
    (length / spacing).round().max(0.0) as usize
}

fn lattice<T: Real, const D: usize>(
    ranges: &[core::ops::Range<i64>; D],
    keep: &dyn Fn(&[i64; D]) -> bool,
    low: [f64; D],
    spacing: f64,
) -> Vec<Vector<T, D>> {
    let mut positions = Vec::new();
    if ranges.iter().any(|range| range.is_empty()) {
        return positions;
    }
    let mut cell: [i64; D] = core::array::from_fn(|k| ranges[k].start);
    loop {
        if keep(&cell) {
            positions.push(Vector::of(core::array::from_fn(|k| low[k] + (cell[k] as f64 + 0.5) * spacing)));
        }
        let mut k = 0;
        loop {
            if k == D {
                return positions;
            }
            cell[k] += 1;
            if cell[k] < ranges[k].end {
                break;
            }
            cell[k] = ranges[k].start;
            k += 1;
        }
    }
}

/// Hydrostatic pressure `ρ̃₀ g (surface − x)` \[Pa\] below a level surface, zero above it (under (74)).
///
/// `up` is the axis gravity acts against, `gravity` its magnitude \[m/s²\].
pub fn hydrostatic<T: Real, const D: usize>(
    reference_density: T,
    gravity: T,
    up: usize,
    surface: T,
) -> impl Fn(&Vector<T, D>) -> T {
    move |x| reference_density * gravity * (surface - x[up]).max(T::ZERO)
}
