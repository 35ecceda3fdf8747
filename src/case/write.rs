//! A case as a file: `case.used.toml`, every default resolved.

use super::choice::Choice;
use super::model::{Block, Case, Dumps, Gauge, Output, StepSize, Tank, Walls, Water};
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
        water(f, &self.water)?;
        if let Some(each) = &self.tank {
            tank(f, each)?;
        }
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

fn water(f: &mut fmt::Formatter<'_>, water: &Water) -> fmt::Result {
    writeln!(f, "\n[water]")?;
    writeln!(f, "reference_density_kg_per_m3 = {:?}", water.reference_density)?;
    writeln!(f, "sound_speed_m_per_s = {:?}", water.sound_speed)?;
    writeln!(f, "viscosity_pa_s = {:?}", water.viscosity)?;
    writeln!(f, "tait_exponent = {:?}", water.tait_exponent)?;
    writeln!(f, "\n[water.artificial_viscosity]")?;
    writeln!(f, "linear = {:?}", water.artificial_viscosity_linear)?;
    writeln!(f, "quadratic = {:?}", water.artificial_viscosity_quadratic)?;
    writeln!(f, "\n[water.density_diffusion]\nkind = \"{}\"", water.diffusion)?;
    if water.diffusion != super::choice::DiffusionKind::None {
        writeln!(f, "coefficient = {:?}", water.diffusion_coefficient)?;
    }
    writeln!(f, "\n[water.reinitialisation]\nevery_steps = {}", water.reinitialisation_every)?;
    water.blocks.iter().try_for_each(|each| block(f, each))
}

fn block(f: &mut fmt::Formatter<'_>, block: &Block) -> fmt::Result {
    writeln!(f, "\n[[water.block]]")?;
    writeln!(f, "low_m = {}\nhigh_m = {}", list(&block.low), list(&block.high))?;
    writeln!(f, "velocity_m_per_s = {}", list(&block.velocity))?;
    writeln!(f, "initial_pressure = \"{}\"", block.initial_pressure)?;
    writeln!(f, "surface_m = {:?}", block.surface)
}

fn tank(f: &mut fmt::Formatter<'_>, tank: &Tank) -> fmt::Result {
    writeln!(f, "\n[tank]\nlow_m = {}\nhigh_m = {}", list(&tank.low), list(&tank.high))?;
    writeln!(f, "open = {}", words(&tank.open))?;
    match tank.walls {
        Walls::Dynamic => writeln!(f, "walls = \"dynamic\"")?,
        Walls::Extrapolated(slip) => writeln!(f, "walls = \"extrapolated\"\nslip = \"{slip}\"")?,
    }
    writeln!(f, "layers = {}", tank.layers)?;
    for wall in &tank.moving {
        writeln!(f, "\n[[tank.moving]]\nside = \"{}\"", wall.side)?;
        writeln!(f, "velocity_m_per_s = {}", list(&wall.velocity))?;
    }
    Ok(())
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
