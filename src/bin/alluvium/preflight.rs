//! What a case means before it is run: sizes, limits of the step, cost.

use crate::case_file::CaseFile;
use crate::connect;
use crate::outcome::Failure;
use crate::screen;
use alluvium::case::{Case, DragPlan, Soil, StepLimit, StepSize};
use std::path::Path;

/// `alluvium check CASE.toml`.
pub fn check_file(path: &Path) -> Result<(), Failure> {
    let file = CaseFile::read(path)?;
    let (case, warnings) = file.case()?;
    if !warnings.problems.is_empty() {
        screen::print(warnings.to_string().trim_end())?;
    }
    connect::offers(&case).map_err(|failure| file.placed(failure))?;
    screen::print(summary(&case))?;
    screen::print(format_args!("{}: valid", path.display()))?;
    Ok(())
}

/// The kernel between soil and water, where it is another.
fn interphase(case: &Case) -> Option<String> {
    let own = &case.particles;
    let other =
        own.interphase.filter(|it| it.kernel != own.kernel || it.smoothing_ratio != own.smoothing_ratio)?;
    let h = case.interphase_smoothing_length();
    Some(format!("between soil and water smoothing length {h:.6} m, {}", other.kernel))
}

/// The sizes, limits and cost of a case, one per line.
pub fn summary(case: &Case) -> String {
    let (spacing, h, support) = (case.particles.spacing, case.smoothing_length(), case.support());
    let neighbours = neighbours(case.dimension, support / spacing);
    let limits = case.step_limits();
    let bound = limits.iter().filter(|limit| limit.binds);
    let (name, shortest) =
        bound.fold(("", f64::INFINITY), |a, b| if b.step < a.1 { (b.name, b.step) } else { a });
    let step = if let StepSize::Fixed(step) = case.time.step { step } else { shortest };
    let steps = (case.end_time / step).ceil();
    let (soil, water) = (case.soil_particles(), case.water_particles());
    let work = steps * (soil + water) as f64;
    let matter = match (&case.soil, &case.water) {
        (Some(_), Some(_)) => format!("{soil} particles of soil and {water} of water"),
        (Some(_), None) => format!("{soil} particles of soil"),
        _ => format!("{water} particles of water"),
    };
    let mut lines = vec![
        format!("{matter} in {} dimensions, {}", case.dimension, case.precision),
        format!(
            "spacing {spacing} m, smoothing length {h:.6} m, {} with support {support:.6} m",
            case.particles.kernel
        ),
        format!("about {neighbours} neighbours of each inside"),
    ];
    lines.extend(interphase(case));
    if let Some(soil) = &case.soil {
        lines.push(speeds(soil));
    }
    for StepLimit { name, step, binds } in &limits {
        let note = if *binds { "" } else { ", not kept to" };
        lines.push(format!("step allowed by the {name} limit: {step:.3e} s{note}"));
    }
    lines.extend(case.drag_plan().iter().flat_map(drag));
    let binding = if step == shortest { format!("bound by the {name} limit") } else { "fixed".to_owned() };
    lines.push(format!("step {step:.3e} s, {binding}: about {steps} steps to {} s", case.end_time));
    lines.push(format!("about {:.3e} particle-steps, walls not counted", work));
    lines.join("\n")
}

fn speeds(soil: &Soil) -> String {
    let (wave, sound) = (soil.fastest_wave(), soil.sound_speed);
    format!("compression waves in the soil at {wave:.3} m/s, speed of sound {sound:.3} m/s")
}

/// How drag goes through a step, and what it does to motion that soil and water share.
fn drag(plan: &DragPlan) -> [String; 2] {
    let stiffness = plan.step / plan.stopping_time;
    let viscosity = format!("{:.3e} m²/s", plan.spurious_viscosity);
    let viscosity = match plan.is_reconstructed {
        true => format!("removed by reconstruction (else {viscosity})"),
        false => viscosity,
    };
    [
        format!(
            "drag by {}: t_s = {:.3e} s, Δt/t_s = {stiffness:.3e} without its limit; {} ({})",
            plan.law, plan.stopping_time, plan.scheme, plan.why
        ),
        format!("spurious viscosity of drag between particles: {viscosity}"),
    ]
}

/// Lattice points within a support of `ratio` spacings, without the centre.
fn neighbours(dimension: usize, ratio: f64) -> usize {
    let n = ratio.ceil() as i64;
    let depth = if dimension == 3 { n } else { 0 };
    let near = |i: i64, j: i64, k: i64| ((i * i + j * j + k * k) as f64) < ratio * ratio * (1.0 - 1e-12);
    let row = |i, j| (-depth..=depth).filter(|k| near(i, j, *k)).count();
    let all: usize = (-n..=n).map(|i| (-n..=n).map(|j| row(i, j)).sum::<usize>()).sum();
    all.saturating_sub(1)
}
