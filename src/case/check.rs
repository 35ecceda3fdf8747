//! What no single key can know: how a case's parts fit together.

use super::choice::{Axis, Side};
use super::model::{Block, Case, Dumps, StepSize, Tank};
use super::read::expected_speed;
use super::reader::Reader;
use crate::preset::Preset;
use core::ops::Range;

const MOST_PARTICLES: f64 = 1e9;
const MOST_DUMPS: f64 = 1e5;

/// Records what does not fit, and what is doubtful.
pub(super) fn check(reader: &Reader<'_>, case: &Case) {
    particles(reader, case);
    blocks(reader, case);
    if let Some(tank) = &case.tank {
        sides(reader, case, tank);
        extent(reader, case, tank);
    } else if !case.periodic.is_empty() {
        reader.error("periodic.axes", "needs a tank", "a [tank] whose low_m and high_m give the period");
    }
    speeds(reader, case);
    dumps(reader, case);
    gauges(reader, case);
}

fn particles(reader: &Reader<'_>, case: &Case) {
    let ratio = case.particles.smoothing_ratio;
    if ratio < 1.2 && case.preset != Preset::Paper {
        let why = "leaves few neighbours: expect noise";
        reader.warning(
            "particles.smoothing_ratio",
            why,
            "at least 1.2 is advised (the paper's 1.0 is its preset)",
        );
    }
    let cells = |block: &Block| -> f64 {
        (0..case.dimension).map(|k| extents(block, k) / case.particles.spacing).product()
    };
    let count: f64 = case.water.blocks.iter().map(cells).sum();
    if count > MOST_PARTICLES {
        let why = format!("makes {count:.1e} water particles");
        reader.error("particles.spacing_m", &why, format!("at most {MOST_PARTICLES:e} particles"));
    }
}

fn extents(block: &Block, k: usize) -> f64 {
    block.high[k] - block.low[k]
}

fn blocks(reader: &Reader<'_>, case: &Case) {
    let spacing = case.particles.spacing;
    for (n, block) in case.water.blocks.iter().enumerate() {
        let path = format!("water.block[{}]", n + 1);
        for k in 0..case.dimension {
            let extent = extents(block, k);
            let high = format!("{path}.high_m[{}]", k + 1);
            if extent <= 0.0 {
                reader.error(&high, "is not above low_m", format!("a number above {:?} [m]", block.low[k]));
            } else if extent < 0.999 * spacing {
                let allowed = format!("at least one spacing, {spacing:?} m, above low_m");
                reader.error(&high, "leaves no room for a particle", allowed);
            } else if (extent / spacing - (extent / spacing).round()).abs() > 1e-3 {
                let near = block.low[k] + (extent / spacing).round() * spacing;
                let why = "does not hold a whole number of particles";
                reader.warning(&high, why, format!("{near:.6} [m] would, at a spacing of {spacing:?} m"));
            }
            if let Some(tank) = &case.tank {
                inside(reader, &path, block, tank, k);
            }
        }
        if let Some(other) = case.water.blocks[..n].iter().position(|other| overlap(block, other)) {
            let why = format!("overlaps water.block[{}]", other + 1);
            reader.error(&path, &why, "blocks that at most touch");
        }
    }
}

fn inside(reader: &Reader<'_>, path: &str, block: &Block, tank: &Tank, k: usize) {
    let tolerance = 1e-9 * (tank.high[k] - tank.low[k]).abs();
    let range = format!("from {:?} to {:?} [m], inside the tank", tank.low[k], tank.high[k]);
    let is_open = |high| tank.open.iter().any(|side| side.axis() == k && side.is_high() == high);
    if block.low[k] < tank.low[k] - tolerance && !is_open(false) {
        reader.error(&format!("{path}.low_m[{}]", k + 1), "is outside the tank", range.clone());
    }
    if block.high[k] > tank.high[k] + tolerance && !is_open(true) {
        reader.error(&format!("{path}.high_m[{}]", k + 1), "is outside the tank", range);
    }
}

fn overlap(a: &Block, b: &Block) -> bool {
    let shared = |k: usize| a.high[k].min(b.high[k]) - a.low[k].max(b.low[k]);
    (0..a.low.len()).all(|k| shared(k) > 1e-9 * extents(a, k).min(extents(b, k)))
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

fn speeds(reader: &Reader<'_>, case: &Case) {
    let speed = expected_speed(&case.water.blocks, &case.gravity, case.tank.as_ref());
    let sound = case.water.sound_speed;
    if sound < speed {
        let why = format!("is below the fastest speed to expect, {speed:.3} m/s");
        reader.error(
            "water.sound_speed_m_per_s",
            &why,
            format!("at least {speed:.3}; ten times that is usual"),
        );
    } else if sound < 5.0 * speed {
        let why =
            format!("is below five times the fastest speed to expect, {speed:.3} m/s: density will vary");
        reader.warning("water.sound_speed_m_per_s", &why, format!("{:.3} is usual", 10.0 * speed));
    }
    if let StepSize::Fixed(step) = case.time.step {
        let limit = case.smoothing_length() / sound;
        if step > 0.5 * limit {
            let why = format!("is more than half of h/c = {limit:.3e} s: expect it to fail");
            reader.warning("time.time_step_s", &why, format!("about {:.1e}", 0.2 * limit));
        }
    }
}

fn dumps(reader: &Reader<'_>, case: &Case) {
    match &case.output.dumps {
        Dumps::Every(interval) if case.end_time / interval > MOST_DUMPS => {
            let allowed = format!("at least {:e} [s]", case.end_time / MOST_DUMPS);
            reader.error("output.dump_interval_s", "makes too many dumps", allowed);
        }
        Dumps::Every(_) => {}
        Dumps::At(times) => ascending(reader, times, 0.0..case.end_time),
    }
}

fn ascending(reader: &Reader<'_>, times: &[f64], range: Range<f64>) {
    for (n, time) in times.iter().enumerate() {
        let path = format!("output.dump_times_s[{}]", n + 1);
        if *time > range.end {
            reader.error(&path, "is after the end", format!("from 0 to end_time_s = {:?} [s]", range.end));
        } else if n > 0 && *time <= times[n - 1] {
            reader.error(&path, "is not after the time before it", "ascending times [s]");
        }
    }
}

fn gauges(reader: &Reader<'_>, case: &Case) {
    for (n, gauge) in case.gauges.iter().enumerate() {
        let path = format!("gauge[{}]", n + 1);
        if case.gauges[..n].iter().any(|other| other.name == gauge.name) {
            reader.error(&format!("{path}.name"), "is taken", "a name no other gauge has");
        }
        let Some(tank) = &case.tank else { continue };
        for k in 0..case.dimension {
            let (low, high) = (tank.low[k], tank.high[k]);
            if !(low..=high).contains(&gauge.position[k]) {
                let allowed = format!("from {low:?} to {high:?} [m], inside the tank");
                reader.error(&format!("{path}.position_m[{}]", k + 1), "is outside the tank", allowed);
            }
        }
    }
}
