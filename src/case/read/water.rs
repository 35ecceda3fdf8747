//! `[water]`.

use super::{Context, FAR};
use crate::case::bounds::{from_to, positive};
use crate::case::choice::{DiffusionKind, InitialPressure};
use crate::case::model::{Block, Tank, Water};
use crate::case::section::Section;

impl Context<'_, '_> {
    pub(super) fn water(&self, section: &Section<'_, '_>, gravity: &[f64], tank: Option<&Tank>) -> Water {
        let viscosity = section.section("artificial_viscosity");
        let (linear, quadratic) = self.defaults.artificial_viscosity;
        let (diffusion, diffusion_coefficient) = self.diffusion(&section.section("density_diffusion"));
        let reinitialisation = section.section("reinitialisation");
        let every = reinitialisation.count("every_steps", 0..=1_000_000_000);
        let sound_speed = section.number("sound_speed_m_per_s", positive(1e5, "m/s"));
        let blocks: Vec<Block> =
            section.sections("block").iter().map(|block| self.block(block, gravity)).collect();
        let given = |key| self.reader.given(&section.name(key));
        if blocks.is_empty() && !given("block") && section.sections("inflow").is_empty() {
            self.reader.missing(
                "water",
                "block",
                "at least one [[water.block]] with low_m and high_m, or a [[water.inflow]]".into(),
            );
        }
        let water = Water {
            reference_density: section
                .number("reference_density_kg_per_m3", from_to(1.0, 1e5, "kg/m³"))
                .unwrap_or(1000.0),
            sound_speed: sound_speed.unwrap_or_else(|| self.sound_speed(&blocks, gravity, tank)),
            viscosity: section.number("viscosity_pa_s", from_to(0.0, 1e6, "Pa s")).unwrap_or(1e-3),
            tait_exponent: section.count("tait_exponent", 1..=20).unwrap_or(7) as i32,
            cavitation_pressure: section.number("cavitation_pressure_pa", from_to(-1e12, 0.0, "Pa")),
            artificial_viscosity_linear: viscosity.number("linear", from_to(0.0, 10.0, "")).unwrap_or(linear),
            artificial_viscosity_quadratic: viscosity
                .number("quadratic", from_to(0.0, 10.0, ""))
                .unwrap_or(quadratic),
            diffusion,
            diffusion_coefficient,
            reinitialisation_every: every.unwrap_or(self.defaults.reinitialisation_every),
            inflows: section.sections("inflow").iter().map(|inflow| self.inflow(inflow)).collect(),
            blocks,
        };
        [&viscosity, &reinitialisation, section].iter().for_each(|section| section.finish());
        water
    }

    fn diffusion(&self, section: &Section<'_, '_>) -> (DiffusionKind, f64) {
        let kind = section.choice("kind").unwrap_or(self.defaults.diffusion);
        let coefficient = section.number("coefficient", from_to(0.0, 1.0, ""));
        section.finish();
        if kind == DiffusionKind::None {
            if coefficient.is_some() {
                let name = section.name("coefficient");
                self.reader.warning(
                    &name,
                    "has no effect: kind is \"none\"",
                    "leave it out, or choose a kind",
                );
            }
            return (kind, 0.0);
        }
        (kind, coefficient.unwrap_or(self.defaults.diffusion_coefficient))
    }

    fn block(&self, section: &Section<'_, '_>, gravity: &[f64]) -> Block {
        let d = self.dimension;
        let low = section.required_numbers("low_m", d, from_to(-FAR, FAR, "m"));
        let high = section.required_numbers("high_m", d, from_to(-FAR, FAR, "m"));
        let velocity = section.numbers("velocity_m_per_s", Some(d), from_to(-1e5, 1e5, "m/s"));
        let weightless = gravity.iter().all(|g| *g == 0.0);
        let rest = if weightless { InitialPressure::Zero } else { InitialPressure::Hydrostatic };
        let initial_pressure = section.choice("initial_pressure").unwrap_or(rest);
        let surface = section.number("surface_m", from_to(-2.0 * FAR, 2.0 * FAR, "m"));
        section.finish();
        Block {
            surface: surface.unwrap_or_else(|| highest(&low, &high, gravity)),
            velocity: velocity.unwrap_or_else(|| vec![0.0; d]),
            low,
            high,
            initial_pressure,
        }
    }

    /// Ten times the fastest speed to expect: of the blocks, and of a fall from the highest water to the
    /// lowest point.
    fn sound_speed(&self, blocks: &[Block], gravity: &[f64], tank: Option<&Tank>) -> f64 {
        let speed = expected_speed(blocks, gravity, tank);
        if speed > 0.0 {
            return 10.0 * speed;
        }
        if !self.reader.has_errors() {
            let allowed = "a number above 0.0 [m/s], ten times the fastest speed to expect".to_owned();
            self.reader.missing("water", "sound_speed_m_per_s", allowed);
        }
        1.0
    }
}

/// Height of a box's highest corner, measured against gravity \[m\].
pub(super) fn highest(low: &[f64], high: &[f64], gravity: &[f64]) -> f64 {
    let strength = gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    if strength == 0.0 {
        return 0.0;
    }
    let along = |k: usize| (-gravity[k] / strength * low[k]).max(-gravity[k] / strength * high[k]);
    (0..gravity.len()).map(along).sum()
}

/// The fastest speed to expect \[m/s\]: of the blocks, and of a fall to the lowest point.
pub(in crate::case) fn expected_speed(blocks: &[Block], gravity: &[f64], tank: Option<&Tank>) -> f64 {
    let strength = gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let down: Vec<f64> = gravity.iter().map(|g| -g).collect();
    let top = blocks.iter().map(|b| highest(&b.low, &b.high, gravity)).fold(f64::MIN, f64::max);
    let boxes = blocks.iter().map(|b| (&b.low, &b.high)).chain(tank.map(|t| (&t.low, &t.high)));
    let bottom = boxes.map(|(low, high)| -highest(low, high, &down)).fold(f64::MAX, f64::min);
    let fall = (2.0 * strength * (top - bottom).max(0.0)).sqrt();
    let own = blocks.iter().map(|b| b.velocity.iter().map(|v| v * v).sum::<f64>().sqrt());
    own.fold(fall, f64::max)
}
