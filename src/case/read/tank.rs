//! `[tank]`.

use super::{Context, FAR};
use crate::case::bounds::from_to;
use crate::case::choice::{Side, SlipChoice, WallKind};
use crate::case::model::{MovingWall, Particles, Tank, Walls};
use crate::case::section::Section;
use crate::mixture::Slip;

impl Context<'_, '_> {
    pub(super) fn tank(
        &self,
        section: &Section<'_, '_>,
        particles: &Particles,
        has_soil: bool,
        has_both: bool,
    ) -> Option<Tank> {
        if !section.is_given() {
            return None;
        }
        let d = self.dimension;
        let walls = self.walls(section, has_soil);
        let enough = self.defaults.preset.wall_layers(particles.support_ratio()) as u64;
        let tank = Tank {
            low: section.required_numbers("low_m", d, from_to(-FAR, FAR, "m")),
            high: section.required_numbers("high_m", d, from_to(-FAR, FAR, "m")),
            open: section.choices("open").unwrap_or_default(),
            water_slip: self.water_slip(section, walls, has_both),
            walls,
            obstacles: section.sections("obstacle").iter().map(|it| self.whole_region(it)).collect(),
            layers: section.count("layers", 1..=20).unwrap_or(enough),
            moving: section.sections("moving").iter().map(|wall| self.moving(wall)).collect(),
        };
        section.finish();
        Some(tank)
    }

    fn walls(&self, section: &Section<'_, '_>, has_soil: bool) -> Walls {
        let slip = section.choice("slip");
        let coefficient =
            section.number("friction_coefficient", from_to(0.0, 10.0, "shear over normal stress"));
        let is_rough = slip == Some(SlipChoice::Friction);
        if coefficient.is_some() && !is_rough {
            let why = "is for slip = \"friction\" alone";
            self.reader.error(
                &section.name("friction_coefficient"),
                why,
                "leave it out, or slip = \"friction\"",
            );
        }
        if section.choice("walls").unwrap_or(self.defaults.walls) == WallKind::Extrapolated {
            let usual = if has_soil { SlipChoice::NoSlip } else { SlipChoice::FreeSlip };
            return Walls::Extrapolated(match slip.unwrap_or(usual) {
                SlipChoice::NoSlip => Slip::NoSlip,
                SlipChoice::FreeSlip => Slip::FreeSlip,
                SlipChoice::Friction => self.friction(section, coefficient, has_soil),
            });
        }
        if slip.is_some() {
            let why = "has no effect: dynamic walls have no choice of slip";
            let allowed = "leave it out, or walls = \"extrapolated\"";
            self.reader.warning(&section.name("slip"), why, allowed);
        }
        Walls::Dynamic
    }

    /// Water glides along walls unless the case says that it sticks, whatever soil does.
    fn water_slip(&self, section: &Section<'_, '_>, walls: Walls, has_both: bool) -> Option<Slip> {
        let slip = section.choice("water_slip");
        if slip.is_some() && !has_both {
            let why = "is for water beside soil";
            self.reader.error(&section.name("water_slip"), why, "slip, where there is only one");
        }
        if slip == Some(SlipChoice::Friction) {
            let why = "is for soil: water has no friction";
            self.reader.error(&section.name("water_slip"), why, "\"no-slip\", \"free-slip\"");
        }
        let slip = if slip == Some(SlipChoice::NoSlip) { Slip::NoSlip } else { Slip::FreeSlip };
        (has_both && walls != Walls::Dynamic).then_some(slip)
    }

    fn friction(&self, section: &Section<'_, '_>, coefficient: Option<f64>, has_soil: bool) -> Slip {
        if !has_soil {
            let why = "is for soil: water has no friction";
            self.reader.error(&section.name("slip"), why, "\"no-slip\", \"free-slip\"");
        }
        if coefficient.is_none() && !self.reader.given(&section.name("friction_coefficient")) {
            let allowed = "a number from 0.0 to 10.0 [shear over normal stress]".to_owned();
            self.reader.missing("tank", "friction_coefficient", allowed);
        }
        Slip::Friction(coefficient.unwrap_or(0.0))
    }

    fn moving(&self, section: &Section<'_, '_>) -> MovingWall {
        let side = section.choice("side");
        if side.is_none() && !self.reader.given(&section.name("side")) {
            let table = section.name("").trim_end_matches('.').to_owned();
            self.reader.missing(&table, "side", "a side of the tank, as in \"+y\"".into());
        }
        let velocity =
            section.required_numbers("velocity_m_per_s", self.dimension, from_to(-1e5, 1e5, "m/s"));
        section.finish();
        MovingWall { side: side.unwrap_or(Side::LowX), velocity }
    }
}
