//! How soil and water share their space, and whether openings and obstacles fit.

use crate::case::model::{Case, Drag, Inflow, Mixing, Region, Tank};
use crate::case::reader::Reader;

pub(super) fn mixing(reader: &Reader<'_>, case: &Case) {
    if let Some(soil) = case.soil.as_ref().filter(|soil| case.mixing.is_some() && soil.volume_fraction > 0.95)
    {
        let why = format!("leaves water {:.2} of the space", 1.0 - soil.volume_fraction);
        reader.error(
            "soil.volume_fraction",
            &why,
            "a number from 0.0 to 0.95 beside [water]; 0.5 to 0.7 is usual",
        );
    }
    let needs_viscosity = case.mixing.as_ref().is_some_and(|mixing| mixing.drag.needs_viscosity());
    if needs_viscosity && case.water.as_ref().is_some_and(|water| water.viscosity == 0.0) {
        let why = "leaves the law of drag without the viscosity it needs";
        reader.error("water.viscosity_pa_s", why, "a number above 0.0 [Pa s]; 0.001 is water");
    }
    if let Some(mixing) = &case.mixing {
        drag(reader, mixing);
    }
    if case.interphase_smoothing_length() < 0.5 * case.smoothing_length() {
        let least = (0.5 * case.particles.smoothing_ratio).max(1.0);
        let why = "is less than half of smoothing_ratio";
        reader.error("particles.interphase_smoothing_ratio", why, format!("from {least:?} to 4.0"));
    }
    for (n, inflow) in case.water.iter().flat_map(|water| &water.inflows).enumerate() {
        long_enough(reader, case, n, inflow);
    }
    for (n, obstacle) in case.tank.iter().flat_map(|tank| &tank.obstacles).enumerate() {
        let path = format!("tank.obstacle[{}]", n + 1);
        whole(reader, case, &path, obstacle);
        if let Some(tank) = &case.tank {
            inside(reader, case, &path, obstacle, tank);
        }
    }
}

/// What drag is to be, against its law and how it goes through a step.
fn drag(reader: &Reader<'_>, mixing: &Mixing) {
    let ways = [
        ("mixture.normalised_drag", mixing.normalised_drag),
        ("mixture.projected_drag", mixing.projected_drag),
        ("mixture.reconstructed_drag", mixing.reconstructed_drag),
    ];
    for (key, given) in ways {
        if given && mixing.drag == Drag::None {
            reader.error(key, "contradicts drag = \"none\"", "false, or another drag");
        }
    }
    if mixing.projected_drag && mixing.reconstructed_drag {
        let why = "contradicts projected_drag: drag is one or the other";
        reader.error("mixture.reconstructed_drag", why, "false, or projected_drag = false");
    }
}

/// Water beyond the mouth must not see where the box of an inflow begins.
fn long_enough(reader: &Reader<'_>, case: &Case, n: usize, inflow: &Inflow) {
    let path = format!("water.inflow[{}]", n + 1);
    whole(reader, case, &path, &inflow.region);
    let along = (0..case.dimension).find(|&k| inflow.velocity[k] != 0.0).unwrap_or(0);
    let length = inflow.region.high[along] - inflow.region.low[along];
    if length < case.support() {
        let key = format!("{path}.high_m[{}]", along + 1);
        let why = format!("makes the inflow {length:?} m long, shorter than the support of the kernel");
        reader.error(&key, &why, format!("at least {:?} m above low_m", case.support()));
    }
}

fn whole(reader: &Reader<'_>, case: &Case, path: &str, region: &Region) {
    let spacing = case.particles.spacing;
    for k in 0..case.dimension {
        let cells = (region.high[k] - region.low[k]) / spacing;
        if (cells - cells.round()).abs() > 1e-3 || cells < 0.999 {
            let near = region.low[k] + cells.round().max(1.0) * spacing;
            let key = format!("{path}.high_m[{}]", k + 1);
            let why = "does not hold a whole number of particles";
            reader.error(&key, why, format!("{near:.6} [m] would, at a spacing of {spacing:?} m"));
        }
    }
}

fn inside(reader: &Reader<'_>, case: &Case, path: &str, region: &Region, tank: &Tank) {
    for k in 0..case.dimension {
        let (low, high) = (tank.low[k], tank.high[k]);
        for (end, x) in [("low_m", region.low[k]), ("high_m", region.high[k])] {
            if !(low..=high).contains(&x) {
                let key = format!("{path}.{end}[{}]", k + 1);
                reader.error(
                    &key,
                    "is outside the tank",
                    format!("from {low:?} to {high:?} [m], inside the tank"),
                );
            }
        }
    }
}
