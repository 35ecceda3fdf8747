//! Soil that sinks through water, and the pressure that bears it: how fast, and at which gradient.

use crate::seepage::Powered;
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{Mixture, Phase, Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::{Conditions, Expected, Measured, Study};
use alluvium::{Vector, setup};

const TRUE_WEIGHT: &str = "γ_w with the true density";
const CUBED: &str = "φ_f cubed";
const HELD: &str = "soil that is held";
const GRAVITY: f64 = 9.81;
/// Densities of grains and water \[kg/m³\], fraction of soil \[-\], conductivity \[m/s\].
const GRAINS: f64 = 2650.0;
const WATER: f64 = 1000.0;
const FRACTION: f64 = 0.55;
const CONDUCTIVITY: f64 = 0.01;
/// Spacing, height of the water, and where in it the soil begins and ends \[m\].
const SPACING: f64 = 0.01;
const HEIGHT: f64 = 0.6;
const SLAB: [f64; 2] = [0.2, 0.4];
const SOUND_SPEED: f64 = 100.0;
/// How often the column's longest sound wave comes and goes while it is looked at; the water has slipped by a
/// seventh of a spacing then, and its lattice still fits that of the soil.
const PERIODS: f64 = 3.0;
/// So long it is looked at once more, for the report.
const LATER: f64 = 9.0;

pub fn studies() -> Vec<Study> {
    vec![
        Study::new(
            "mixture/settling/2d/f64",
            "soil without stress sinks through water at rest with a slip φ_s(ρ̃_s/ρ̃_f − 1)k/φ_f (value: \
             measured over that)",
            |c| {
                let [early, late] = fall(c);
                Measured::value(early.slip / steady_slip()).note(format!(
                    "{:.4} between {PERIODS} and {LATER} periods, when the water stands beside the lattice of \
                     the soil",
                    late.slip / steady_slip()
                ))
            },
        )
        .equations(&["37", "52", "53", "55", "58", "69"])
        .source("balance of soil and water in steady fall, no volume flowing through")
        .expect(Expected::Value { value: 1.0, tolerance: 0.01 })
        .mutant(TRUE_WEIGHT)
        .mutant(CUBED),
        Study::new(
            "mixture/quick condition/2d/f64",
            "where water bears all of the soil, its pressure rises beyond hydrostatic by the critical \
             gradient φ_s(ρ̃_s/ρ̃_f − 1) (value: measured over that)",
            |c| {
                let [early, late] = fall(c);
                let note = format!("{:.4} between {PERIODS} and {LATER} periods", late.gradient / buoyant());
                Measured::value(early.gradient / buoyant()).note(note)
            },
        )
        .equations(&["37", "55", "58"])
        .source("Terzaghi's critical gradient: the weight of the soil less its uplift, over that of water")
        .expect(Expected::Value { value: 1.0, tolerance: 0.02 })
        .mutant(HELD),
    ]
}

/// φ_s(ρ̃_s/ρ̃_f − 1).
fn buoyant() -> f64 {
    FRACTION * (GRAINS / WATER - 1.0)
}

/// φ_s(ρ̃_s/ρ̃_f − 1)k/φ_f \[m/s\].
fn steady_slip() -> f64 {
    buoyant() * CONDUCTIVITY / (1.0 - FRACTION)
}

/// Means over time, in the middle third of the soil.
#[derive(Clone, Copy, Default)]
struct Fall {
    /// v_f − v_s, upwards \[m/s\].
    slip: f64,
    /// −dp/dy/ρ̃_f g − 1.
    gradient: f64,
}

/// A slab of very soft soil, so that what happens at its faces does not reach its middle, falls in a column of
/// water: at first, and later.
fn fall(conditions: &Conditions) -> [Fall; 2] {
    let (volume, h) = (SPACING * SPACING, 2.0 * SPACING);
    let width = 9.0 * SPACING;
    let elasticity = Elasticity::from_bulk(1e3, 0.3).expect("moduli");
    let mut soil = Phase::new(Soil::new(GRAINS, elasticity, Unyielding).expect("a soil"));
    let places = setup::fill([0.0, SLAB[0]], [width, SLAB[1]], SPACING);
    if conditions.is(HELD) {
        soil.add_wall(Wall::dynamic(), &places, volume, |_| 0.0).expect("soil");
    } else {
        soil.add(&places, volume, |_| 0.0).expect("soil");
    }
    soil.set_volume_fraction(|_| FRACTION);
    // The water bears the soil from the start.
    let weight = |x: &Vector<f64, 2>| {
        let soil_above = (SLAB[1] - x[1]).clamp(0.0, SLAB[1] - SLAB[0]);
        WATER * GRAVITY * (HEIGHT - x[1] + if conditions.is(HELD) { 0.0 } else { buoyant() * soil_above })
    };
    let mut water = Phase::new(Water::new(WATER, SOUND_SPEED).expect("water"));
    let floor = setup::tank([0.0; 2], [width, HEIGHT], SPACING, 4, [(false, false), (true, false)]);
    water.add_wall(Wall::extrapolated(Slip::FreeSlip), &floor, volume, weight).expect("a floor");
    water.add(&setup::fill([0.0; 2], [width, HEIGHT], SPACING), volume, weight).expect("water");
    if !conditions.is(HELD) {
        let through = |x: &Vector<f64, 2>| if (SLAB[0]..SLAB[1]).contains(&x[1]) { FRACTION } else { 0.0 };
        soil.set_velocity(|_| Vector([0.0, (FRACTION - 1.0) * steady_slip()]));
        water.set_velocity(|x| Vector([0.0, through(x) * steady_slip()]));
    }
    let right = Darcy::new(Conductivity::new(CONDUCTIVITY).expect("a conductivity"));
    let power = match (conditions.is(TRUE_WEIGHT), conditions.is(CUBED)) {
        (true, _) => 1,
        (_, true) => 3,
        _ => 2,
    };
    let mixture = Mixture::new(WendlandC2::new(h).expect("a length"), soil, water)
        .with_gravity(Vector([0.0, -GRAVITY]))
        .with_periodic(periodic([width, 0.0]))
        .with_drag(Powered { right, power });
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(0.2).expect("a number"));
    let period = 4.0 * HEIGHT / SOUND_SPEED;
    let ends = [PERIODS * period, LATER * period];
    ends.map(|end| {
        let begin = run.time();
        let mut mean = Fall::default();
        while run.time() < end {
            let part = run.step_at_most(end - run.time()).expect("a step").length / (end - begin);
            let now = middle(run.mixture());
            mean.slip += now.slip * part;
            mean.gradient += now.gradient * part;
        }
        mean
    })
}

/// What is in the middle third now.
fn middle(mixture: &Mixture<f64, 2, WendlandC2<f64, 2>, Soil<f64, Unyielding>, Water<f64>>) -> Fall {
    let third = (SLAB[1] - SLAB[0]) / 3.0;
    let inside = |x: &Vector<f64, 2>| (SLAB[0] + third..SLAB[1] - third).contains(&x[1]);
    let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
    let (soil, water) = (mixture.soil(), mixture.water());
    let of_soil = soil.positions().iter().zip(soil.velocities()).filter(|(x, _)| inside(x));
    let of_water: Vec<usize> = (0..water.len()).filter(|&a| inside(&water.positions()[a])).collect();
    let up = |a: &usize| water.positions()[*a][1];
    let centre = mean(of_water.iter().map(up).collect());
    let lever = |a: &usize| up(a) - centre;
    let moment: f64 = of_water.iter().map(|a| lever(a) * water.pressures()[*a]).sum();
    let spread: f64 = of_water.iter().map(|a| lever(a) * lever(a)).sum();
    Fall {
        slip: mean(of_water.iter().map(|a| water.velocities()[*a][1]).collect())
            - mean(of_soil.map(|(_, v)| v[1]).collect()),
        gradient: -moment / spread / (WATER * GRAVITY) - 1.0,
    }
}
