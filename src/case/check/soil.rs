//! Whether soil can stand as it is laid, before a step is taken.

use crate::case::build::at_rest;
use crate::case::choice::InitialStress;
use crate::case::model::{Case, Soil, SoilBody, Stiffness, Strength, Walls, upright};
use crate::case::reader::Reader;
use crate::material::{Elasticity, YieldSurface};
use crate::mixture::Slip;
use crate::space::Vector;

/// A settlement by more than this part of its height is doubtful.
const MOST_SETTLEMENT: f64 = 0.05;

pub(super) fn soil(reader: &Reader<'_>, case: &Case, soil: &Soil) {
    let (Ok(elasticity), Ok(surface)) = (soil.elasticity::<f64>(), soil.strength.surface::<f64>()) else {
        return; // values out of range have been told
    };
    settlement(reader, case, soil, &elasticity);
    if case.particles.gradient_correction && soil.strength == Strength::Elastic && case.water.is_none() {
        let why = "lets free bodies of soil that does not yield lose their corners";
        reader.warning(
            "particles.gradient_correction",
            why,
            "false, but for bodies that are held all around",
        );
    }
    let rests = |body: &SoilBody| body.initial_stress == InitialStress::Geostatic;
    for (path, body) in soil.named_bodies().filter(|(_, body)| rests(body)) {
        lateral(reader, case, soil, &surface, &path, body);
    }
    if case.tank.as_ref().is_some_and(|tank| tank.walls == Walls::Extrapolated(Slip::FreeSlip)) {
        let why = "lets soil slide along the floor without friction";
        reader.warning("tank.slip", why, "\"no-slip\" is usual, or \"friction\"");
    }
}

/// Soil that its own weight compresses much is softer than meant.
fn settlement(reader: &Reader<'_>, case: &Case, soil: &Soil, elasticity: &Elasticity<f64>) {
    let deepest = soil.bodies.iter().map(|body| depth(case, body)).fold(0.0, f64::max);
    let strain = soil.reference_density * deepest / elasticity.plane_wave_modulus();
    if strain > MOST_SETTLEMENT {
        let key = match soil.stiffness {
            Stiffness::Bulk(_) => "soil.bulk_modulus_pa",
            Stiffness::Youngs(_) => "soil.youngs_modulus_pa",
        };
        let why = format!("lets the soil's own weight compress it by {:.0} %", 1e2 * strain);
        reader.warning(
            key,
            &why,
            format!("a stiffness under which that is below {:.0} %", 1e2 * MOST_SETTLEMENT),
        );
    }
}

/// Gravity times the depth of a body's lowest point under its surface \[m²/s²\].
fn depth(case: &Case, body: &SoilBody) -> f64 {
    let strength = case.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let (low, high) = body.shape.bounds(&case.gravity);
    let fall = |k: usize| (case.gravity[k] * low[k]).max(case.gravity[k] * high[k]);
    (strength * body.surface + (0..case.dimension).map(fall).sum::<f64>()).max(0.0)
}

/// A stress at rest that yields loses some of the soil's weight in the first step, row 13 of the errata.
fn lateral(
    reader: &Reader<'_>,
    case: &Case,
    soil: &Soil,
    surface: &impl YieldSurface<f64>,
    path: &str,
    body: &SoilBody,
) {
    let vertical = -soil.reference_density * depth(case, body);
    let up = upright(&case.gravity).0;
    let along = Vector::<f64, 3>::of(core::array::from_fn(|k| f64::from(k == up)));
    let stress = at_rest(vertical, body.lateral_ratio, along);
    let excess = surface.excess(&stress);
    if excess > 1e-9 * vertical.abs() {
        let left = surface.scaled_back(&stress).stress.0[up];
        let ratio = body.lateral_ratio;
        let why = format!(
            "gives K₀ = {ratio:.4}, outside the yield surface by {excess:.3} Pa at the bottom: coming back \
             to it takes {:.1} % off the vertical stress there",
            1e2 * (1.0 - left / vertical)
        );
        reader.warning(&format!("{path}.lateral_stress_ratio"), &why, bearable(soil));
    }
}

/// What K₀ a surface bears, in words.
fn bearable(soil: &Soil) -> String {
    let ratios = soil.elasticity().and_then(|elasticity| soil.strength.lateral_ratios(&elasticity));
    ratios.map_or(String::new(), |(_, admissible)| {
        format!("about {admissible:.4}, which the yield surface bears without cohesion")
    })
}
