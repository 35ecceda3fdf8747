//! `[soil]`.

use super::water::highest;
use super::{Context, FAR};
use crate::case::bounds::{from_to, positive};
use crate::case::choice::{InitialStress, SurfaceKind};
use crate::case::model::{Frictional, Shape, Soil, SoilBody, Stiffness, Strength};
use crate::case::section::Section;
use crate::material::{Cone, Elasticity};

const ANGLE: &str = "°";

/// What a law of an unusable file is, to go on reading.
const SOME_RATIO: f64 = 0.5;

impl Context<'_, '_> {
    pub(super) fn soil(&self, section: &Section<'_, '_>, gravity: &[f64]) -> Soil {
        let soil = &self.defaults.soil;
        let (linear, quadratic) = soil.artificial_viscosity;
        let viscosity = section.section("artificial_viscosity");
        let diffusion = section.section("density_diffusion");
        let regularisation = section.section("stress_regularisation");
        let opposed = section.section("artificial_stress");
        let (stiffness, poissons_ratio) = self.stiffness(section);
        let reference_density =
            section.required_number("reference_density_kg_per_m3", from_to(1.0, 1e5, "kg/m³"));
        let number = |section: &Section<'_, '_>, key, high, usual| {
            section.number(key, from_to(0.0, high, "")).unwrap_or(usual)
        };
        let mut soil = Soil {
            reference_density,
            volume_fraction: section.number("volume_fraction", positive(1.0, "")).unwrap_or(1.0),
            stiffness,
            poissons_ratio,
            strength: self.strength(section),
            plasticity: section.choice("plasticity").unwrap_or(soil.plasticity),
            sound_speed: section
                .number("sound_speed_m_per_s", positive(1e5, "m/s"))
                .unwrap_or_else(|| (stiffness.bulk(poissons_ratio) / reference_density).sqrt()),
            artificial_viscosity_linear: number(&viscosity, "linear", 10.0, linear),
            artificial_viscosity_quadratic: number(&viscosity, "quadratic", 10.0, quadratic),
            diffusion_coefficient: number(&diffusion, "coefficient", 1.0, soil.diffusion_coefficient),
            regularisation_every: regularisation.count("every_steps", 0..=1_000_000_000).unwrap_or(0),
            artificial_stress_strength: number(&opposed, "strength", 1.0, 0.0),
            artificial_stress_exponent: opposed.count("exponent", 1..=10).unwrap_or(4) as u32,
            bodies: Vec::new(),
        };
        soil.bodies = self.bodies(section, &soil, gravity);
        [&viscosity, &diffusion, &regularisation, &opposed, section].iter().for_each(|it| it.finish());
        soil
    }

    /// One of two moduli, and Poisson's ratio.
    fn stiffness(&self, section: &Section<'_, '_>) -> (Stiffness, f64) {
        let bounds = positive(1e13, "Pa");
        let bulk = section.number("bulk_modulus_pa", bounds);
        let youngs = section.number("youngs_modulus_pa", bounds);
        let either = "either bulk_modulus_pa or youngs_modulus_pa";
        let stiffness = match (bulk, youngs) {
            (Some(_), Some(_)) => {
                self.reader.error(&section.name("youngs_modulus_pa"), "contradicts bulk_modulus_pa", either);
                Stiffness::Bulk(1.0)
            }
            (Some(modulus), None) => Stiffness::Bulk(modulus),
            (None, Some(modulus)) => Stiffness::Youngs(modulus),
            (None, None) => {
                self.reader.missing("soil", "bulk_modulus_pa", format!("{either}, {bounds}"));
                Stiffness::Bulk(1.0)
            }
        };
        // Where Poisson's ratio itself cannot be read, 1.0 would stand for it.
        let ratio = section.required_number("poissons_ratio", from_to(0.0, 0.499, ""));
        (stiffness, ratio.min(0.499))
    }

    fn strength(&self, section: &Section<'_, '_>) -> Strength {
        let kind = section.choice("yield_surface").unwrap_or(SurfaceKind::DruckerPrager);
        let angle = section.number("friction_angle_deg", from_to(0.0, 89.0, ANGLE));
        let dilatancy = section.number("dilatancy_angle_deg", from_to(0.0, 89.0, ANGLE));
        let cohesion = section.number("cohesion_pa", from_to(0.0, 1e12, "Pa"));
        let tension_cut_off = section.number("tension_cut_off_pa", from_to(0.0, 1e12, "Pa"));
        let cone = section.choice("cone");
        let of_others: &[&str] = match kind {
            SurfaceKind::DruckerPrager => &[],
            SurfaceKind::MohrCoulomb => &["tension_cut_off_pa", "cone"],
            SurfaceKind::Elastic => {
                &["friction_angle_deg", "dilatancy_angle_deg", "cohesion_pa", "tension_cut_off_pa", "cone"]
            }
        };
        for key in of_others.iter().filter(|key| self.reader.given(&section.name(key))) {
            let why = format!("does not belong to the yield surface \"{kind}\"");
            self.reader.error(&section.name(key), &why, "leave it out, or another yield_surface");
        }
        if kind == SurfaceKind::Elastic {
            return Strength::Elastic;
        }
        let frictional = self.frictional(section, angle, dilatancy, cohesion);
        match kind {
            SurfaceKind::MohrCoulomb => Strength::MohrCoulomb(frictional),
            _ => Strength::DruckerPrager {
                frictional,
                cone: cone.unwrap_or(if self.dimension == 3 {
                    Cone::TriaxialCompression
                } else {
                    self.defaults.soil.cone
                }),
                tension_cut_off,
            },
        }
    }

    fn frictional(
        &self,
        section: &Section<'_, '_>,
        angle: Option<f64>,
        dilatancy: Option<f64>,
        cohesion: Option<f64>,
    ) -> Frictional {
        let friction_angle = angle.unwrap_or_else(|| {
            self.reader.missing("soil", "friction_angle_deg", from_to(0.0, 89.0, ANGLE).to_string());
            30.0
        });
        let usual = if self.defaults.soil.associated { friction_angle } else { 0.0 };
        let dilatancy_angle = dilatancy.unwrap_or(usual);
        if dilatancy_angle > friction_angle {
            let allowed = format!("a number from 0.0 to the friction angle, {friction_angle:?} [{ANGLE}]");
            self.reader.error(&section.name("dilatancy_angle_deg"), "exceeds the friction angle", allowed);
        }
        let cohesion = cohesion.unwrap_or(0.0);
        if friction_angle == 0.0 && cohesion == 0.0 {
            let why = "leaves soil without friction or cohesion no strength at all";
            self.reader.error(&section.name("cohesion_pa"), why, "a number above 0.0 [Pa] without friction");
        }
        Frictional { friction_angle, dilatancy_angle, cohesion }
    }

    fn bodies(&self, section: &Section<'_, '_>, soil: &Soil, gravity: &[f64]) -> Vec<SoilBody> {
        let ratio = self.lateral_ratio(soil);
        let (blocks, cylinders) = (section.sections("block"), section.sections("cylinder"));
        if blocks.is_empty() && cylinders.is_empty() && !self.reader.given(&section.name("block")) {
            let of_three = if self.dimension == 3 { ", or a [[soil.cylinder]]" } else { "" };
            let allowed = format!("at least one [[soil.block]] with low_m and high_m{of_three}");
            self.reader.missing("soil", "block", allowed);
        }
        let blocks = blocks.iter().map(|block| self.body(block, self.block_shape(block), ratio, gravity));
        let blocks: Vec<SoilBody> = blocks.collect();
        let body = |it| self.body(it, self.cylinder_shape(it, gravity), ratio, gravity);
        blocks.into_iter().chain(cylinders.iter().map(body)).collect()
    }

    /// K₀ by the preset: as printed (76), or one the yield surface bears.
    fn lateral_ratio(&self, soil: &Soil) -> f64 {
        let Ok(elasticity) = soil.elasticity::<f64>() else { return SOME_RATIO };
        let Ok((printed, admissible)) = soil.strength.lateral_ratios(&elasticity) else { return SOME_RATIO };
        if self.defaults.soil.printed_lateral_ratio { printed } else { admissible }
    }

    fn block_shape(&self, section: &Section<'_, '_>) -> Shape {
        Shape::Block {
            low: section.required_numbers("low_m", self.dimension, from_to(-FAR, FAR, "m")),
            high: section.required_numbers("high_m", self.dimension, from_to(-FAR, FAR, "m")),
        }
    }

    fn cylinder_shape(&self, section: &Section<'_, '_>, gravity: &[f64]) -> Shape {
        let path = section.name("").trim_end_matches('.').to_owned();
        if self.dimension != 3 {
            self.reader.error(&path, "does not exist in two dimensions", "[[soil.block]], or dimension = 3");
        } else if gravity.iter().filter(|g| **g != 0.0).count() != 1 {
            let why = "stands upright, but gravity is not along an axis";
            self.reader.error(
                &path,
                why,
                "gravity_m_per_s2 with one component that is not 0, or [[soil.block]]",
            );
        }
        Shape::Cylinder {
            base: section.required_numbers("base_m", self.dimension, from_to(-FAR, FAR, "m")),
            radius: section.required_number("radius_m", positive(FAR, "m")),
            height: section.required_number("height_m", positive(FAR, "m")),
        }
    }

    fn body(&self, section: &Section<'_, '_>, shape: Shape, ratio: f64, gravity: &[f64]) -> SoilBody {
        let velocity = section.numbers("velocity_m_per_s", Some(self.dimension), from_to(-1e5, 1e5, "m/s"));
        let weightless = gravity.iter().all(|g| *g == 0.0);
        let rest = if weightless { InitialStress::Zero } else { InitialStress::Geostatic };
        let (low, high) = shape.bounds(gravity);
        let body = SoilBody {
            velocity: velocity.unwrap_or_else(|| vec![0.0; self.dimension]),
            initial_stress: section.choice("initial_stress").unwrap_or(rest),
            surface: section
                .number("surface_m", from_to(-2.0 * FAR, 2.0 * FAR, "m"))
                .unwrap_or_else(|| highest(&low, &high, gravity)),
            held: section.flag("held").unwrap_or(false),
            lateral_ratio: section
                .number("lateral_stress_ratio", from_to(0.0, 10.0, "lateral over vertical stress"))
                .unwrap_or(ratio),
            shape,
        };
        section.finish();
        body
    }
}

impl Stiffness {
    /// The bulk modulus \[Pa\] with this Poisson's ratio.
    fn bulk(self, poissons_ratio: f64) -> f64 {
        match self {
            Self::Bulk(modulus) => modulus,
            Self::Youngs(modulus) => {
                Elasticity::new(modulus, poissons_ratio).map_or(1.0, |elasticity| elasticity.bulk())
            }
        }
    }
}
