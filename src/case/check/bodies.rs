//! How blocks and cylinders fit the spacing, the tank, each other, and what else takes space at the start.

use crate::case::model::{Case, Region, Shape, Tank, upright};
use crate::case::reader::Reader;

/// A body of soil or water, with its name in the file.
struct Placed {
    path: String,
    shape: Shape,
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Placed {
    fn new(path: String, shape: Shape, gravity: &[f64]) -> Self {
        let (low, high) = shape.bounds(gravity);
        Self { path, shape, low, high }
    }

    fn of_box(path: String, low: &[f64], high: &[f64], gravity: &[f64]) -> Self {
        Self::new(path, Shape::Block { low: low.to_vec(), high: high.to_vec() }, gravity)
    }

    fn extent(&self, k: usize) -> f64 {
        self.high[k] - self.low[k]
    }

    /// The key that gives its end along axis `k`, high or low.
    fn key(&self, k: usize, is_high: bool, up: usize) -> String {
        match self.shape {
            Shape::Block { .. } => {
                format!("{}.{}[{}]", self.path, if is_high { "high_m" } else { "low_m" }, k + 1)
            }
            Shape::Cylinder { .. } => {
                format!("{}.{}", self.path, if k == up { "height_m" } else { "radius_m" })
            }
        }
    }
}

/// Obstacles stand in nothing, and water that comes in begins beside water that is there.
fn taken(reader: &Reader<'_>, case: &Case, soil: &[Placed], water: &[Placed], up: usize) {
    let placed = |name: &'static str, n: usize, region: &Region| {
        Placed::of_box(format!("{name}[{}]", n + 1), &region.low, &region.high, &case.gravity)
    };
    let inflows = case.water.iter().flat_map(|water| &water.inflows).enumerate();
    let inflows: Vec<_> = inflows.map(|(n, inflow)| placed("water.inflow", n, &inflow.region)).collect();
    let obstacles = case.tank.iter().flat_map(|tank| &tank.obstacles).enumerate();
    let obstacles: Vec<_> = obstacles.map(|(n, region)| placed("tank.obstacle", n, region)).collect();
    let apart = |one: &Placed, others: &[&[Placed]]| {
        if let Some(other) = others.iter().copied().flatten().find(|other| overlap(one, other, up)) {
            reader.error(&one.path, &format!("overlaps {}", other.path), "boxes that at most touch");
        }
    };
    for (n, inflow) in inflows.iter().enumerate() {
        apart(inflow, &[water, &inflows[..n]]);
    }
    for (n, obstacle) in obstacles.iter().enumerate() {
        apart(obstacle, &[soil, water, &inflows, &obstacles[..n]]);
    }
}

pub(super) fn bodies(reader: &Reader<'_>, case: &Case) {
    let up = upright(&case.gravity).0;
    let water = case.water.iter().flat_map(|water| &water.blocks).enumerate();
    let water: Vec<Placed> = water
        .map(|(n, block)| {
            Placed::of_box(format!("water.block[{}]", n + 1), &block.low, &block.high, &case.gravity)
        })
        .collect();
    let soil = case.soil.iter().flat_map(|soil| soil.named_bodies());
    let soil: Vec<Placed> =
        soil.map(|(path, body)| Placed::new(path, body.shape.clone(), &case.gravity)).collect();
    taken(reader, case, &soil, &water, up);
    for placed in [&water, &soil] {
        for (n, body) in placed.iter().enumerate() {
            for k in 0..case.dimension {
                size(reader, case, body, k, up);
                if let Some(tank) = &case.tank {
                    inside(reader, body, tank, k, up);
                }
            }
            if let Some(other) = placed[..n].iter().find(|other| overlap(body, other, up)) {
                let why = format!("overlaps {}", other.path);
                reader.error(&body.path, &why, "blocks that at most touch");
            }
        }
    }
}

fn size(reader: &Reader<'_>, case: &Case, body: &Placed, k: usize, up: usize) {
    let (spacing, extent) = (case.particles.spacing, body.extent(k));
    let key = body.key(k, true, up);
    if let Shape::Cylinder { radius, .. } = body.shape
        && k != up
    {
        if radius < spacing {
            reader.error(
                &key,
                "leaves no room for particles",
                format!("at least one spacing, {spacing:?} m"),
            );
        }
        return;
    }
    let (base, end) = match body.shape {
        Shape::Block { .. } => (body.low[k], "low_m"),
        Shape::Cylinder { .. } => (0.0, "base_m"),
    };
    if extent <= 0.0 {
        reader.error(&key, "is not above low_m", format!("a number above {base:?} [m]"));
    } else if extent < 0.999 * spacing {
        let allowed = format!("at least one spacing, {spacing:?} m, above {end}");
        reader.error(&key, "leaves no room for a particle", allowed);
    } else if (extent / spacing - (extent / spacing).round()).abs() > 1e-3 {
        let near = base + (extent / spacing).round() * spacing;
        let why = "does not hold a whole number of particles";
        reader.warning(&key, why, format!("{near:.6} [m] would, at a spacing of {spacing:?} m"));
    }
}

fn inside(reader: &Reader<'_>, body: &Placed, tank: &Tank, k: usize, up: usize) {
    let tolerance = 1e-9 * (tank.high[k] - tank.low[k]).abs();
    let range = format!("from {:?} to {:?} [m], inside the tank", tank.low[k], tank.high[k]);
    let is_open = |high| tank.open.iter().any(|side| side.axis() == k && side.is_high() == high);
    if body.low[k] < tank.low[k] - tolerance && !is_open(false) {
        reader.error(&body.key(k, false, up), "is outside the tank", range.clone());
    }
    if body.high[k] > tank.high[k] + tolerance && !is_open(true) {
        reader.error(&body.key(k, true, up), "is outside the tank", range);
    }
}

/// Whether two bodies share more than a boundary.
fn overlap(a: &Placed, b: &Placed, up: usize) -> bool {
    let shared = |k: usize| a.high[k].min(b.high[k]) - a.low[k].max(b.low[k]);
    let is_shared = |k: usize| shared(k) > 1e-9 * a.extent(k).min(b.extent(k));
    if !(0..a.low.len()).all(is_shared) {
        return false;
    }
    match (&a.shape, &b.shape) {
        (Shape::Block { .. }, Shape::Block { .. }) => true,
        (Shape::Cylinder { base, radius, .. }, _) => gap(base, b, up) < radius * (1.0 - 1e-9),
        (_, Shape::Cylinder { base, radius, .. }) => gap(base, a, up) < radius * (1.0 - 1e-9),
    }
}

/// From an upright axis to the nearest of a body, across \[m\].
fn gap(axis: &[f64], body: &Placed, up: usize) -> f64 {
    let across = |away: &dyn Fn(usize) -> f64| -> f64 {
        (0..axis.len()).filter(|k| *k != up).map(|k| away(k).powi(2)).sum::<f64>().sqrt()
    };
    match &body.shape {
        Shape::Block { low, high } => across(&|k| axis[k] - axis[k].clamp(low[k], high[k].max(low[k]))),
        Shape::Cylinder { base, radius, .. } => across(&|k| axis[k] - base[k]) - radius,
    }
}
