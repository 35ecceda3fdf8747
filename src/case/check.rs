//! What no single key can know: how a case's parts fit together.

mod bodies;
mod mixing;
mod soil;
mod tank;

use super::choice::Precision;
use super::model::{Case, Dumps, StepSize, Water};
use super::read::expected_speed;
use super::reader::Reader;
use crate::kernel;
use crate::material::{self, Material};
use crate::preset::Preset;
use core::ops::Range;

const MOST_PARTICLES: f64 = 1e9;
const MOST_DUMPS: f64 = 1e5;

/// Records what does not fit, and what is doubtful.
pub(super) fn check(reader: &Reader<'_>, case: &Case) {
    particles(reader, case);
    kernel(reader, case);
    bodies::bodies(reader, case);
    if let Some(tank) = &case.tank {
        tank::tank(reader, case, tank);
    } else if !case.periodic.is_empty() {
        reader.error("periodic.axes", "needs a tank", "a [tank] whose low_m and high_m give the period");
    }
    if let Some(water) = &case.water {
        speeds(reader, case, water);
        cavitation(reader, water);
    }
    if let Some(soil) = &case.soil {
        soil::soil(reader, case, soil);
    }
    mixing::mixing(reader, case);
    fixed_step(reader, case);
    dumps(reader, case);
    fields(reader, case);
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
    let cells = |(low, high): &(Vec<f64>, Vec<f64>)| -> f64 {
        (0..case.dimension).map(|k| (high[k] - low[k]) / case.particles.spacing).product()
    };
    let count: f64 = case.boxes().iter().map(cells).sum();
    if count > MOST_PARTICLES {
        let what = match (&case.soil, &case.water) {
            (Some(_), Some(_)) => "",
            (Some(_), None) => "soil ",
            _ => "water ",
        };
        let why = format!("makes {count:.1e} {what}particles");
        reader.error("particles.spacing_m", &why, format!("at most {MOST_PARTICLES:e} particles"));
    }
}

/// A kernel's slope must be a number of the case's precision.
fn kernel(reader: &Reader<'_>, case: &Case) {
    let largest = match case.precision {
        Precision::F32 => f64::from(f32::MAX),
        Precision::F64 => f64::MAX,
    };
    let ratio =
        case.particles.smoothing_ratio.min(case.interphase_smoothing_length() / case.particles.spacing);
    let (h, shortest) = (ratio * case.particles.spacing, kernel::shortest(largest, case.dimension));
    if h < shortest {
        let why = format!("makes the smoothing length {h:.3e} m, too short for {} numbers", case.precision);
        let least = shortest / ratio;
        reader.error("particles.spacing_m", &why, format!("at least {least:.3e} [m]"));
    }
}

fn speeds(reader: &Reader<'_>, case: &Case, water: &Water) {
    let speed = expected_speed(&water.blocks, &case.gravity, case.tank.as_ref());
    let sound = water.sound_speed;
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
}

/// Where water cavitates it must have a density.
fn cavitation(reader: &Reader<'_>, water: &Water) {
    let law = material::Water::new(water.reference_density, water.sound_speed)
        .and_then(|law| law.with_exponent(water.tait_exponent));
    let Ok(law) = law else { return }; // values out of range have been told
    let empty = law.pressure(-1.0, &());
    if water.cavitation_pressure.is_some_and(|least| least <= empty) {
        let why = format!("is never reached: without density water has {empty:.4e} Pa");
        let allowed = format!("from above {empty:.4e} to 0.0 [Pa]");
        reader.error("water.cavitation_pressure_pa", &why, allowed);
    }
}

fn fixed_step(reader: &Reader<'_>, case: &Case) {
    if let StepSize::Fixed(step) = case.time.step {
        let sound = ("h/c", case.smoothing_length() / case.fastest_wave());
        let pores = case.pore_limit().map_or(sound, |pores| ("h φ/c of the water in the pores", pores));
        let (name, limit) = if pores.1 < sound.1 { pores } else { sound };
        if step > 0.5 * limit {
            let why = format!("is more than half of {name} = {limit:.3e} s: expect it to fail");
            reader.warning("time.time_step_s", &why, format!("about {:.1e}", 0.2 * limit));
        }
    }
}

fn fields(reader: &Reader<'_>, case: &Case) {
    let of_soil = case.output.fields.iter().enumerate().filter(|(_, field)| field.is_of_soil());
    for (n, field) in of_soil.filter(|_| case.soil.is_none()) {
        let path = format!("output.fields[{}]", n + 1);
        reader.error(&path, "is of soil, and there is none", format!("fields of water, without \"{field}\""));
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
