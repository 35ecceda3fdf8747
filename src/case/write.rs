//! A case as a file: `case.used.toml`, every default resolved.

mod mixing;
mod soil;
mod water;

use super::choice::Choice;
use super::model::{Case, Dumps, Gauge, Output, StepSize, Tank, Walls};
use crate::mixture::Slip;
use core::fmt::{self, Write};

/// Numbers as TOML, with as many digits as give them back exactly.
fn list(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
    format!("[{}]", numbers.join(", "))
}

fn words<C: Choice>(choices: &[C]) -> String {
    let words: Vec<String> = choices.iter().map(|choice| format!("\"{}\"", choice.word())).collect();
    format!("[{}]", words.join(", "))
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "name = \"{}\"", self.name)?;
        writeln!(f, "preset = \"{}\"", self.preset)?;
        writeln!(f, "dimension = {}", self.dimension)?;
        writeln!(f, "precision = \"{}\"", self.precision)?;
        writeln!(f, "threads = {}", self.threads)?;
        writeln!(f, "end_time_s = {:?}", self.end_time)?;
        writeln!(f, "gravity_m_per_s2 = {}", list(&self.gravity))?;
        writeln!(f, "\n[particles]")?;
        writeln!(f, "spacing_m = {:?}", self.particles.spacing)?;
        writeln!(f, "smoothing_ratio = {:?}", self.particles.smoothing_ratio)?;
        writeln!(f, "kernel = \"{}\"", self.particles.kernel)?;
        writeln!(f, "gradient_correction = {}", self.particles.gradient_correction)?;
        if let Some(between) = &self.particles.interphase {
            writeln!(f, "interphase_smoothing_ratio = {:?}", between.smoothing_ratio)?;
            writeln!(f, "interphase_kernel = \"{}\"", between.kernel)?;
        }
        self.soil.iter().try_for_each(|each| soil::soil(f, each))?;
        self.water.iter().try_for_each(|each| water::water(f, each))?;
        self.mixing.iter().try_for_each(|each| mixing::mixing(f, each))?;
        if let Some(each) = &self.tank {
            tank(f, each)?;
        }
        self.outlets.iter().try_for_each(|each| mixing::region(f, "[[outlet]]", each))?;
        self.domain.iter().try_for_each(|each| mixing::region(f, "[domain]", each))?;
        if !self.periodic.is_empty() {
            writeln!(f, "\n[periodic]\naxes = {}", words(&self.periodic))?;
        }
        writeln!(f, "\n[time]\nintegrator = \"{}\"", self.time.integrator)?;
        match self.time.step {
            StepSize::Courant(courant) => writeln!(f, "courant = {courant:?}")?,
            StepSize::Fixed(step) => writeln!(f, "time_step_s = {step:?}")?,
        }
        writeln!(f, "\n[neighbours]\nsearch = \"{}\"", self.neighbours.search)?;
        writeln!(f, "skin_ratio = {:?}", self.neighbours.skin_ratio)?;
        output(f, &self.output)?;
        self.gauges.iter().try_for_each(|each| gauge(f, each))
    }
}

fn tank(f: &mut fmt::Formatter<'_>, tank: &Tank) -> fmt::Result {
    writeln!(f, "\n[tank]\nlow_m = {}\nhigh_m = {}", list(&tank.low), list(&tank.high))?;
    writeln!(f, "open = {}", words(&tank.open))?;
    match tank.walls {
        Walls::Dynamic => writeln!(f, "walls = \"dynamic\"")?,
        Walls::Extrapolated(along) => {
            writeln!(f, "walls = \"extrapolated\"")?;
            slip(f, along)?;
        }
    }
    match tank.water_slip {
        Some(Slip::NoSlip) => writeln!(f, "water_slip = \"no-slip\"")?,
        Some(_) => writeln!(f, "water_slip = \"free-slip\"")?,
        None => {}
    }
    writeln!(f, "layers = {}", tank.layers)?;
    tank.obstacles.iter().try_for_each(|each| mixing::region(f, "[[tank.obstacle]]", each))?;
    for wall in &tank.moving {
        writeln!(f, "\n[[tank.moving]]\nside = \"{}\"", wall.side)?;
        writeln!(f, "velocity_m_per_s = {}", list(&wall.velocity))?;
    }
    Ok(())
}

fn slip(f: &mut fmt::Formatter<'_>, slip: Slip) -> fmt::Result {
    match slip {
        Slip::NoSlip => writeln!(f, "slip = \"no-slip\""),
        Slip::FreeSlip => writeln!(f, "slip = \"free-slip\""),
        Slip::Friction(coefficient) => {
            writeln!(f, "slip = \"friction\"\nfriction_coefficient = {coefficient:?}")
        }
    }
}

fn output(f: &mut fmt::Formatter<'_>, output: &Output) -> fmt::Result {
    writeln!(f, "\n[output]")?;
    match &output.dumps {
        Dumps::Every(interval) => writeln!(f, "dump_interval_s = {interval:?}")?,
        Dumps::At(times) => writeln!(f, "dump_times_s = {}", list(times))?,
    }
    writeln!(f, "history_interval_s = {:?}", output.history_interval)?;
    writeln!(f, "fields = {}", words(&output.fields))
}

fn gauge(f: &mut fmt::Formatter<'_>, gauge: &Gauge) -> fmt::Result {
    let mut text = String::from("\n[[gauge]]\n");
    writeln!(text, "name = \"{}\"\nposition_m = {}", gauge.name, list(&gauge.position))?;
    writeln!(text, "quantity = \"{}\"", gauge.quantity)?;
    f.write_str(&text)
}
