//! `[mixture]`, and where particles come and go: `[[water.inflow]]`, `[[outlet]]`, `[domain]`.

use super::{Context, FAR};
use crate::case::bounds::from_to;
use crate::case::choice::SchemeChoice;
use crate::case::model::{Inflow, Mixing, Particles, Region, Soil, Water};
use crate::case::section::Section;
use crate::mixture::CouplingForm;
use crate::preset::Preset;

/// Smoothing lengths that sound travels in the usual time of the density's relaxation.
const RELAXATION: f64 = 200.0;

impl Context<'_, '_> {
    /// What is between soil and water, where there are both.
    pub(super) fn mixing(
        &self,
        section: &Section<'_, '_>,
        particles: &Particles,
        soil: Option<&Soil>,
        water: Option<&Water>,
    ) -> Option<Mixing> {
        let (Some(soil), Some(water)) = (soil, water) else {
            if section.is_given() {
                let why = "has nothing to couple";
                self.reader.error("mixture", why, "[soil] and [water] beside it, or no [mixture]");
            }
            return None;
        };
        let is_paper = self.defaults.preset == Preset::Paper;
        let usual = if is_paper { CouplingForm::Printed } else { CouplingForm::PressureDifference };
        let coupling = section.choice("coupling").unwrap_or(usual);
        let time = section.number("density_relaxation_s", from_to(0.0, 1e9, "s; 0 is never"));
        let h = particles.smoothing_ratio * particles.spacing;
        let usual = if is_paper { 0.0 } else { RELAXATION * h / water.sound_speed };
        if coupling == CouplingForm::Printed && time.is_some_and(|time| time > 0.0) {
            let why = "has no effect: it acts where pressure acts by differences";
            self.reader.warning(&section.name("density_relaxation_s"), why, "0.0, or another coupling");
        }
        let relaxation_time = time.unwrap_or(usual);
        let drag = self.drag(section, soil);
        let usual = if is_paper { SchemeChoice::Explicit } else { SchemeChoice::Automatic };
        let drag_scheme = section.choice("drag_scheme").unwrap_or(usual);
        let mixing = Mixing {
            coupling,
            relaxation_time,
            fraction: section.choice("volume_fraction").unwrap_or_default(),
            drag,
            drag_scheme,
            normalised_drag: section.flag("normalised_drag").unwrap_or(false),
            projected_drag: section.flag("projected_drag").unwrap_or(false),
            reconstructed_drag: section.flag("reconstructed_drag").unwrap_or(false),
        };
        section.finish();
        Some(mixing)
    }

    pub(super) fn inflow(&self, section: &Section<'_, '_>) -> Inflow {
        let region = self.region(section);
        let velocity =
            section.required_numbers("velocity_m_per_s", self.dimension, from_to(-1e5, 1e5, "m/s"));
        if velocity.iter().filter(|v| **v != 0.0).count() != 1 {
            let why = "is not along one of the axes";
            self.reader.error(&section.name("velocity_m_per_s"), why, "one component that is not 0.0");
        }
        section.finish();
        Inflow { region, velocity }
    }

    pub(super) fn domain(&self, section: &Section<'_, '_>) -> Option<Region> {
        section.is_given().then(|| self.whole_region(section))
    }

    /// A box that is all there is in its table.
    pub(super) fn whole_region(&self, section: &Section<'_, '_>) -> Region {
        let region = self.region(section);
        section.finish();
        region
    }

    fn region(&self, section: &Section<'_, '_>) -> Region {
        let low = section.required_numbers("low_m", self.dimension, from_to(-FAR, FAR, "m"));
        let high = section.required_numbers("high_m", self.dimension, from_to(-FAR, FAR, "m"));
        for k in 0..self.dimension {
            if high[k] <= low[k] {
                let key = format!("{}[{}]", section.name("high_m"), k + 1);
                self.reader.error(&key, "is not above low_m", format!("a number above {:?} [m]", low[k]));
            }
        }
        Region { low, high }
    }
}
