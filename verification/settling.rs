//! Soil that sinks through water, and the pressure that bears it: how fast, and at which gradient.

use crate::seepage::Powered;
use crate::shared_runs::SharedRuns;
use crate::soil::along;
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{Mixture, Phase, Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, Vector, setup};

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
        settling::<f64, 2>("mixture/settling/2d/f64"),
        settling::<f32, 2>("mixture/settling/2d/f32"),
        settling::<f64, 3>("mixture/settling/3d/f64").level(Level::Full),
        settling::<f32, 3>("mixture/settling/3d/f32").level(Level::Full),
        quick_condition::<f64, 2>("mixture/quick condition/2d/f64"),
        quick_condition::<f32, 2>("mixture/quick condition/2d/f32"),
        quick_condition::<f64, 3>("mixture/quick condition/3d/f64").level(Level::Full),
        quick_condition::<f32, 3>("mixture/quick condition/3d/f32").level(Level::Full),
    ]
}

fn settling<T: Real, const D: usize>(name: &str) -> Study {
    Study::new(
        name,
        "soil without stress sinks through water at rest with a slip φ_s(ρ̃_s/ρ̃_f − 1)k/φ_f (value: measured over \
         that)",
        |c| over(fall::<T, D>(c).iter().map(|fall| fall.slip), steady_slip()),
    )
    .equations(&["37", "52", "53", "55", "58", "69"])
    .source("balance of soil and water in steady fall, no volume flowing through")
    .expect(Expected::Value { value: 1.0, tolerance: 0.01 })
    .mutant(TRUE_WEIGHT)
    .mutant(CUBED)
}

fn quick_condition<T: Real, const D: usize>(name: &str) -> Study {
    Study::new(
        name,
        "where water bears all of the soil, its pressure rises beyond hydrostatic by the critical gradient \
         φ_s(ρ̃_s/ρ̃_f − 1) (value: measured over that)",
        |c| over(fall::<T, D>(c).iter().map(|fall| fall.gradient), buoyant()),
    )
    .equations(&["37", "55", "58"])
    .source("Terzaghi's critical gradient: the weight of the soil less its uplift, over that of water")
    .expect(Expected::Value { value: 1.0, tolerance: 0.02 })
    .mutant(HELD)
}

/// What is judged at first; later, where it was looked at, the water stands beside the lattice of the soil.
fn over(mut course: impl Iterator<Item = f64>, exact: f64) -> Measured {
    let measured = Measured::value(course.next().expect("a first mean") / exact);
    course.fold(measured, |measured, later| {
        measured.note(format!(
            "{:.4} between {PERIODS} and {LATER} periods, when the water stands beside the lattice of the soil",
            later / exact
        ))
    })
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

static FALLS: SharedRuns<Vec<Fall>> = SharedRuns::new();

/// A slab of very soft soil, so that what happens at its faces does not reach its middle, falls in a column of
/// water: at first, and in the plane later.
fn fall<T: Real, const D: usize>(conditions: &Conditions) -> Vec<Fall> {
    let step = StepSize::courant(T::of(0.2)).expect("a number");
    FALLS.get(format!("{D}d/{}: {:?}", T::NAME, conditions.mutant), || {
        let mut run = Simulation::new(slab::<T, D>(conditions), LeapFrog::new(), step);
        let times = if D == 2 { &[PERIODS, LATER][..] } else { &[PERIODS] };
        let mean_until = |periods: &f64| {
            let (begin, end) = (run.time(), periods * 4.0 * HEIGHT / SOUND_SPEED);
            let mut mean = Fall::default();
            while run.time() < end {
                let part = run.step_at_most(end - run.time()).expect("a step").length / (end - begin);
                let now = middle(run.mixture());
                mean.slip += now.slip * part;
                mean.gradient += now.gradient * part;
            }
            mean
        };
        times.iter().map(mean_until).collect()
    })
}

/// Soil and water at the start.
fn slab<T: Real, const D: usize>(conditions: &Conditions) -> Both<T, D> {
    let (volume, up, is_held) = (T::of(SPACING.powi(D as i32)), D - 1, conditions.is(HELD));
    let mut size = [9.0 * SPACING; D];
    let (mut low, mut high) = ([0.0; D], size);
    (low[up], high[up], size[up]) = (SLAB[0], SLAB[1], HEIGHT);
    let elasticity = Elasticity::from_bulk(T::of(1e3), T::of(0.3)).expect("moduli");
    let mut soil = Phase::new(Soil::new(T::of(GRAINS), elasticity, Unyielding).expect("a soil"));
    let places = setup::fill(low, high, SPACING);
    if is_held {
        soil.add_wall(Wall::dynamic(), &places, volume, |_| T::ZERO).expect("soil");
    } else {
        soil.add(&places, volume, |_| T::ZERO).expect("soil");
    }
    soil.set_volume_fraction(|_| T::of(FRACTION));
    // The water bears the soil from the start.
    let weight = |x: &Vector<T, D>| {
        let x = x[up].as_f64();
        let soil_above = if is_held { 0.0 } else { (SLAB[1] - x).clamp(0.0, SLAB[1] - SLAB[0]) };
        T::of(WATER * GRAVITY * (HEIGHT - x + buoyant() * soil_above))
    };
    let mut water = Phase::new(Water::new(T::of(WATER), T::of(SOUND_SPEED)).expect("water"));
    let mut sides = [(false, false); D];
    sides[up] = (true, false);
    let floor = setup::tank([0.0; D], size, SPACING, 4, sides);
    water.add_wall(Wall::extrapolated(Slip::FreeSlip), &floor, volume, weight).expect("a floor");
    water.add(&setup::fill([0.0; D], size, SPACING), volume, weight).expect("water");
    if !is_held {
        let inside = |x: &Vector<T, D>| (SLAB[0]..SLAB[1]).contains(&x[up].as_f64());
        let through = |x: &Vector<T, D>| if inside(x) { FRACTION } else { 0.0 };
        soil.set_velocity(|_| along(up, (FRACTION - 1.0) * steady_slip()));
        water.set_velocity(|x| along(up, through(x) * steady_slip()));
    }
    let right = Darcy::new(Conductivity::new(T::of(CONDUCTIVITY)).expect("a conductivity"));
    let power = match (conditions.is(TRUE_WEIGHT), conditions.is(CUBED)) {
        (true, _) => 1,
        (_, true) => 3,
        _ => 2,
    };
    let mut repeats = size;
    repeats[up] = 0.0;
    Mixture::new(WendlandC2::new(T::of(2.0 * SPACING)).expect("a length"), soil, water)
        .with_gravity(along(up, -GRAVITY))
        .with_periodic(periodic(repeats))
        .with_drag(Powered { right, power })
}

type Both<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>>;

/// What is in the middle third now.
fn middle<T: Real, const D: usize>(mixture: &Both<T, D>) -> Fall {
    let third = (SLAB[1] - SLAB[0]) / 3.0;
    let up = |x: &Vector<T, D>| x[D - 1].as_f64();
    let inside = |x: &Vector<T, D>| (SLAB[0] + third..SLAB[1] - third).contains(&up(x));
    let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
    let (soil, water) = (mixture.soil(), mixture.water());
    let of_soil = soil.positions().iter().zip(soil.velocities()).filter(|(x, _)| inside(x));
    let of_water: Vec<usize> = (0..water.len()).filter(|&a| inside(&water.positions()[a])).collect();
    let centre = mean(of_water.iter().map(|&a| up(&water.positions()[a])).collect());
    let lever = |a: usize| up(&water.positions()[a]) - centre;
    let moment: f64 = of_water.iter().map(|&a| lever(a) * water.pressures()[a].as_f64()).sum();
    let spread: f64 = of_water.iter().map(|&a| lever(a) * lever(a)).sum();
    Fall {
        slip: mean(of_water.iter().map(|&a| up(&water.velocities()[a])).collect())
            - mean(of_soil.map(|(_, v)| up(v)).collect()),
        gradient: -moment / spread / (WATER * GRAVITY) - 1.0,
    }
}
