//! How every reproduction begins: the head of its case file, and of its report.

use crate::arguments::{PresetName, ReproduceOptions};
use crate::run::Finished;
use alluvium::case::{Case, StepSize};

/// The keys at the top of a case file that lasts until the last of `dumps`.
pub fn of_case(name: &str, options: &ReproduceOptions, dumps: &str) -> String {
    let (preset, precision) = (options.preset.preset(), options.precision.name());
    let end = dumps.rsplit(", ").next().unwrap_or(dumps);
    format!("name = \"{name}\"\npreset = \"{preset}\"\nprecision = \"{precision}\"\nend_time_s = {end}\n")
}

/// What was run, of particles of a `matter`; `more` is said at the end.
pub fn of_report(title: &str, matter: &str, case: &Case, finished: &Finished, more: &str) -> String {
    let (particles, walls) = finished.particles;
    let step = match case.time.step {
        StepSize::Courant(courant) => format!("Courant number {courant}"),
        StepSize::Fixed(step) => format!("fixed step {step:e} s"),
    };
    let rate = (particles + walls) as f64 * finished.steps as f64 / finished.wall_clock.max(1e-9) / 1e6;
    format!(
        "# {title}\n\nPreset `{}`, Δx = {} m, {}, {step}: {particles} particles of {matter} and {walls} of \
         walls, {} steps to {} s in {:.0} s ({rate:.1} M particle-steps/s).{more}\n\n",
        case.preset,
        case.particles.spacing,
        case.precision,
        finished.steps,
        case.end_time,
        finished.wall_clock
    )
}

/// Degrees of dilatancy: none for soil that flows at a constant volume; the paper's flow rule is associated.
pub fn dilatancy(preset: PresetName, friction_angle: f64) -> f64 {
    match preset {
        PresetName::Default => 0.0,
        PresetName::Paper => friction_angle,
    }
}
