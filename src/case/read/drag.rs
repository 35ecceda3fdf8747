//! The law of drag in `[mixture]`.

use super::Context;
use crate::case::bounds::{Bounds, from_to, positive};
use crate::case::choice::DragKind;
use crate::case::model::{Drag, Seepage, Soil};
use crate::case::section::Section;

const CONDUCTIVITY: &str = "hydraulic_conductivity_m_per_s";
const PERMEABILITY: &str = "intrinsic_permeability_m2";
const POROSITY: &str = "reference_porosity";
const DIAMETER: &str = "grain_diameter_m";
const COEFFICIENT: &str = "forchheimer_coefficient";

/// c_F of Ward (1964).
const WARD: f64 = 0.55;

/// The parameters there are, as far as they are given.
struct Given {
    conductivity: Option<f64>,
    permeability: Option<f64>,
    porosity: Option<f64>,
    diameter: Option<f64>,
    coefficient: Option<f64>,
}

impl Context<'_, '_> {
    pub(super) fn drag(&self, section: &Section<'_, '_>, soil: &Soil) -> Drag {
        let given = Given {
            conductivity: section.number(CONDUCTIVITY, conductivities()),
            permeability: section.number(PERMEABILITY, positive(1.0, "m²")),
            porosity: section.number(POROSITY, from_to(0.05, 0.95, "")),
            diameter: section.number(DIAMETER, diameters()),
            coefficient: section.number(COEFFICIENT, from_to(0.0, 1e9, "")),
        };
        let kind = section.choice("drag").unwrap_or(DragKind::Darcy);
        let by_grains = kind == DragKind::KozenyCarman && given.diameter.is_some();
        let seeps = !matches!(kind, DragKind::None | DragKind::Ergun) && !by_grains;
        self.refuse_strangers(section, kind, by_grains, &given);
        let seepage = if seeps { self.seepage(section, kind, &given) } else { Seepage::Conductivity(1.0) };
        match kind {
            DragKind::None => Drag::None,
            DragKind::Darcy => Drag::Darcy(seepage),
            DragKind::KozenyCarman => match given.diameter {
                Some(diameter) => Drag::GrainsOfCarman(diameter),
                None => {
                    let usual = (1.0 - soil.volume_fraction).clamp(0.05, 0.95);
                    Drag::KozenyCarman { seepage, porosity: given.porosity.unwrap_or(usual) }
                }
            },
            DragKind::Ergun => Drag::Ergun(given.diameter.unwrap_or_else(|| {
                self.reader.missing("mixture", DIAMETER, diameters().to_string());
                1.0
            })),
            DragKind::Forchheimer => {
                Drag::Forchheimer { seepage, coefficient: given.coefficient.unwrap_or(WARD) }
            }
        }
    }

    /// Conductivity or permeability: one of the two.
    fn seepage(&self, section: &Section<'_, '_>, kind: DragKind, given: &Given) -> Seepage {
        match (given.conductivity, given.permeability) {
            (Some(conductivity), None) => Seepage::Conductivity(conductivity),
            (None, Some(permeability)) => Seepage::Permeability(permeability),
            (Some(conductivity), Some(_)) => {
                let why = format!("says a second time what {CONDUCTIVITY} says");
                self.reader.error(&section.name(PERMEABILITY), &why, "one of the two");
                Seepage::Conductivity(conductivity)
            }
            (None, None) => {
                let or = match kind {
                    DragKind::KozenyCarman => format!("; or {PERMEABILITY}, or {DIAMETER}"),
                    _ => format!("; or {PERMEABILITY}"),
                };
                self.reader.missing("mixture", CONDUCTIVITY, format!("{}{or}", conductivities()));
                Seepage::Conductivity(1.0)
            }
        }
    }

    /// Parameters of another law are mistakes.
    fn refuse_strangers(&self, section: &Section<'_, '_>, kind: DragKind, by_grains: bool, given: &Given) {
        use DragKind::{Darcy, Ergun, Forchheimer, KozenyCarman};
        let seep: &[DragKind] =
            if by_grains { &[Darcy, Forchheimer] } else { &[Darcy, KozenyCarman, Forchheimer] };
        let keys: [(&str, Option<f64>, &[DragKind]); 5] = [
            (CONDUCTIVITY, given.conductivity, seep),
            (PERMEABILITY, given.permeability, seep),
            (POROSITY, given.porosity, if by_grains { &[] } else { &[KozenyCarman] }),
            (DIAMETER, given.diameter, &[KozenyCarman, Ergun]),
            (COEFFICIENT, given.coefficient, &[Forchheimer]),
        ];
        for (key, value, laws) in keys {
            if value.is_none() || laws.contains(&kind) {
                continue;
            }
            let why = match by_grains {
                true if key != COEFFICIENT => format!("contradicts {DIAMETER}"),
                _ => format!("contradicts drag = \"{kind}\""),
            };
            let words: Vec<String> = laws.iter().map(|law| format!("drag = \"{law}\"")).collect();
            let allowed = match words.is_empty() {
                true => "leave it out".to_owned(),
                false => format!("leave it out, or {}", words.join(", ")),
            };
            self.reader.error(&section.name(key), &why, allowed);
        }
    }
}

fn conductivities() -> Bounds {
    positive(1e6, "m/s")
}

fn diameters() -> Bounds {
    positive(10.0, "m")
}
