//! How the tank fits its periods, openings and moving walls.

use crate::case::choice::{Axis, Side};
use crate::case::model::{Case, Tank};
use crate::case::reader::Reader;

pub(super) fn tank(reader: &Reader<'_>, case: &Case, tank: &Tank) {
    sides(reader, case, tank);
    extent(reader, case, tank);
}

fn sides(reader: &Reader<'_>, case: &Case, tank: &Tank) {
    let is_periodic = |axis: usize| case.periodic.iter().any(|a| *a as usize == axis);
    for (n, side) in tank.open.iter().enumerate() {
        let path = format!("tank.open[{}]", n + 1);
        side_exists(reader, &path, *side, case.dimension);
        if is_periodic(side.axis()) {
            let why = "has no effect: that direction is periodic";
            reader.error(&path, why, "sides of directions that are not in periodic.axes");
        }
    }
    for (n, axis) in case.periodic.iter().enumerate() {
        if *axis == Axis::Z && case.dimension == 2 {
            let path = format!("periodic.axes[{}]", n + 1);
            reader.error(&path, "does not exist in two dimensions", "\"x\", \"y\"");
        }
    }
    for (n, wall) in tank.moving.iter().enumerate() {
        let path = format!("tank.moving[{}].side", n + 1);
        side_exists(reader, &path, wall.side, case.dimension);
        if tank.open.contains(&wall.side) || is_periodic(wall.side.axis()) {
            reader.error(&path, "has no wall to move", "a side that is neither open nor periodic");
        }
        if tank.moving[..n].iter().any(|other| other.side == wall.side) {
            reader.error(&path, "is listed twice", "each side once");
        }
    }
}

fn side_exists(reader: &Reader<'_>, path: &str, side: Side, dimension: usize) {
    if side.axis() >= dimension {
        let allowed = "\"-x\", \"+x\", \"-y\", \"+y\"";
        reader.error(path, "does not exist in two dimensions", allowed);
    }
}

fn extent(reader: &Reader<'_>, case: &Case, tank: &Tank) {
    for k in 0..case.dimension {
        let extent = tank.high[k] - tank.low[k];
        let path = format!("tank.high_m[{}]", k + 1);
        if extent <= 0.0 {
            reader.error(&path, "is not above low_m", format!("a number above {:?} [m]", tank.low[k]));
        } else if case.periodic.iter().any(|a| *a as usize == k) {
            period(reader, case, &path, extent);
        } else if (extent / case.particles.spacing - (extent / case.particles.spacing).round()).abs() > 1e-3 {
            let spacing = case.particles.spacing;
            let near = tank.low[k] + (extent / spacing).round() * spacing;
            let why = "does not hold a whole number of particles: the wall will stand at the nearest";
            reader.warning(&path, why, format!("{near:.6} [m] would, at a spacing of {spacing:?} m"));
        }
    }
}

fn period(reader: &Reader<'_>, case: &Case, path: &str, extent: f64) {
    let least = 2.0 * case.support();
    let cells = extent / case.particles.spacing;
    if extent < least {
        let why = "makes a period shorter than two supports";
        reader.error(path, why, format!("at least {least:?} m above low_m"));
    } else if (cells - cells.round()).abs() > 1e-6 * cells {
        let spacing = case.particles.spacing;
        let why = "makes a period that is not a whole number of spacings";
        reader.error(path, why, format!("a multiple of {spacing:?} m above low_m"));
    }
}
