//! Water in soil, in time: it seeps through as Darcy's law has it, and rests where it should.

use crate::bands::{Band, WITHIN, measured, range};
use crate::shared_runs::SharedRuns;
use crate::soil::{along, elastic};
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{
    Conductivity, Cone, Darcy, DragLaw, DruckerPrager, Elasticity, LateralRatio, Soil, Water,
};
use alluvium::mixture::{DensityDiffusion, Mixture, Phase, Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::{Conditions, Expected, Level, Measured, Parcel, Study};
use alluvium::{Real, SymTensor, Vector, setup};
use std::ops::ControlFlow;

const TRUE_WEIGHT: &str = "γ_w with the true density";
const CUBED: &str = "φ_f cubed";
const DRY: &str = "soil laid under its dry weight";
const GRAVITY: f64 = 9.81;

pub fn studies() -> Vec<Study> {
    vec![
        darcy::<f64, 2>("mixture/darcy/2d/f64"),
        darcy::<f64, 3>("mixture/darcy/3d/f64"),
        darcy::<f32, 2>("mixture/darcy/2d/f32"),
        darcy::<f32, 3>("mixture/darcy/3d/f32"),
        rest::<f64>("mixture/saturated bed/quick", QUICK, 0.02),
        rest::<f32>("mixture/saturated bed/quick/f32", QUICK, 0.02),
        settled::<f64>("mixture/saturated bed/pressure/quick", QUICK, 0.02),
        settled::<f32>("mixture/saturated bed/pressure/quick/f32", QUICK, 0.02),
        rest::<f64>("mixture/saturated bed/as in the paper", FLUSH, 0.5).level(Level::Full),
        settled::<f64>("mixture/saturated bed/pressure/as in the paper", FLUSH, 0.5)
            .level(Level::Full)
            .falls_short(
                Expected::Bound { largest: 1.03 },
                "the water's mean pressure settles 25.1 Pa below the one it is laid with, for 24.5 Pa",
            ),
        settled::<f64>("mixture/saturated bed/pressure/under water", DROWNED, 0.5).level(Level::Full),
        rest::<f64>("mixture/saturated bed/under water", DROWNED, 0.5).level(Level::Full),
        rest::<f64>("mixture/saturated bed/under water, no corners", WITHOUT_CORNERS, 0.1),
        rest::<f32>("mixture/saturated bed/under water, no corners/f32", WITHOUT_CORNERS, 0.1),
        settled::<f64>("mixture/saturated bed/pressure/no corners", WITHOUT_CORNERS, 0.1),
        settled::<f32>("mixture/saturated bed/pressure/no corners/f32", WITHOUT_CORNERS, 0.1),
    ]
}

/// Darcy's law, or with another power of φ than its second.
#[derive(Debug)]
pub struct Powered<T> {
    pub right: Darcy<T>,
    pub power: i32,
}

impl<T: Real> DragLaw<T> for Powered<T> {
    fn coefficient(&self, fraction: T, true_density: T, slip: T) -> T {
        self.right.coefficient(fraction, true_density, slip) * fraction.powi(self.power - 2)
    }
}

/// Water that a slope drives through soil that is held, in a box that repeats itself.
fn darcy<T: Real, const D: usize>(name: &str) -> Study {
    Study::new(
        name,
        "through soil that is held, water driven by a slope i seeps at q = φ_f v = k i (value: q/(k i) less \
         one, the mean over a way of one spacing)",
        |conditions| {
            let power = match (conditions.is(TRUE_WEIGHT), conditions.is(CUBED)) {
                (true, _) => 1,
                (_, true) => 3,
                _ => 2,
            };
            Measured::value(seepage::<T, D>(power) - 1.0)
        },
    )
    .equations(&["37", "55", "58", "68"])
    .source("Darcy's law; the drag's kernel sum is one within 1 % wherever the water stands")
    .expect(Expected::Bound { largest: 0.01 })
    .mutant(TRUE_WEIGHT)
    .mutant(CUBED)
}

/// q/(k i).
fn seepage<T: Real, const D: usize>(power: i32) -> f64 {
    let (side, spacing, k, slope) = (if D == 2 { 1.0 } else { 0.5 }, 0.05, 0.05, 2.0);
    let (fraction, volume) = (0.55, T::of(f64::powi(spacing, D as i32)));
    let places = setup::fill::<T, D>([0.0; D], [side; D], spacing);
    let mut soil = Phase::new(elastic::<T>());
    soil.add_wall(Wall::dynamic(), &places, volume, |_| T::ZERO).expect("soil that is held");
    soil.set_volume_fraction(|_| T::of(fraction));
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(30.0)).expect("water"));
    water.add(&places, volume, |_| T::of(1e3)).expect("water");
    let speed = k * slope / (1.0 - fraction);
    let mut pull = Vector::zero();
    pull[0] = T::of(slope * GRAVITY);
    let mut start = Vector::zero();
    start[0] = T::of(speed);
    water.set_velocity(|_| start);
    let right = Darcy::new(Conductivity::new(T::of(k)).expect("a conductivity"));
    let mixture = Mixture::new(WendlandC2::new(T::of(1.5 * spacing)).expect("a length"), soil, water)
        .with_gravity(pull)
        .with_periodic(periodic([side; D]))
        .with_drag(Powered { right, power });
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.2)).expect("a number"));
    let (quiet, end) = (0.1, 0.1 + spacing / speed);
    let (mut flow, mut time) = (0.0, 0.0);
    while run.time() < end {
        let step = run.step().expect("a step");
        if run.time() > quiet {
            let water = run.mixture().water();
            let along = |a: usize| (water.volume_fraction(a) * water.velocities()[a][0]).as_f64();
            flow += step.length * (0..water.len()).map(along).sum::<f64>() / water.len() as f64;
            time += step.length;
        }
    }
    flow / time / (k * slope)
}

/// The bed of the paper's jet (Table 3), without a jet.
#[derive(Clone, Copy, Debug)]
struct Bed {
    spacing: f64,
    width: f64,
    /// Depth of the water over it \[m\].
    above: f64,
    /// Without what disturbs a surface of water also where there is no soil: side walls, and density
    /// diffusion.
    is_bare: bool,
}

/// Height of the soil \[m\].
const HEIGHT: f64 = 0.175;
/// Densities \[kg/m³\] that lie on the grains, buoyant, and on the water.
const BUOYANT: f64 = 1700.0;
const WATER: f64 = 1000.0;
/// Bulk modulus K \[Pa\] and Poisson's ratio ν \[-\] of the soil, c of the water \[m/s\].
const BULK_MODULUS: f64 = 125e6;
const POISSON: f64 = 0.3;
const SOUND_SPEED: f64 = 250.0;

const FLUSH: Bed = Bed { spacing: 0.005, width: 0.45, above: 0.0, is_bare: false };
const QUICK: Bed = Bed { spacing: 0.00625, ..FLUSH };
const DROWNED: Bed = Bed { above: 0.05, ..FLUSH };
const WITHOUT_CORNERS: Bed = Bed { spacing: 0.0125, width: 0.15, above: 0.05, is_bare: true };

fn rest<T: Real>(name: &str, bed: Bed, end: f64) -> Study {
    Study::new(
        name,
        "a saturated bed of soil laid under its buoyant weight rests: rms velocities are below 1e-5 m/s, no fraction \
         of water is beyond −0.01 and 1.01 in any step, and over the run mean heights change by less than a layer's \
         surface sinks under its own weight (values: half widths from the middle of each band)",
        move |conditions| measured(rested::<T>(bed, end, conditions).others),
    )
    .equations(&["55", "58", "68", "75", "76"])
    .source("nothing drives it; γL²/2M, M = ρc² and the oedometric modulus")
    .expect(WITHIN)
    .mutant(DRY)
}

fn settled<T: Real>(name: &str, bed: Bed, end: f64) -> Study {
    Study::new(
        name,
        "over the run of a saturated bed mean pressures change by less than the weight of half a row (values: half \
         widths from the middle of each band)",
        move |conditions| measured(rested::<T>(bed, end, conditions).pressures),
    )
    .equations(&["55", "58", "68", "75", "76"])
    .source("surfaces are known to half a spacing")
    .expect(WITHIN)
    .mutant(DRY)
}

/// What was seen of a bed.
#[derive(Clone)]
struct Rested {
    pressures: Vec<Band>,
    others: Vec<Band>,
}

type Saturated<T> = Mixture<T, 2, WendlandC2<T, 2>, Soil<T>, Water<T>>;

fn rested<T: Real>(bed: Bed, end: f64, conditions: &Conditions) -> Rested {
    static RUNS: SharedRuns<Rested> = SharedRuns::new();
    let key = format!("{bed:?} {end} {} {}", conditions.is(DRY), core::any::type_name::<T>());
    RUNS.get(key, || follow::<T>(bed, end, conditions))
}

fn follow<T: Real>(bed: Bed, end: f64, conditions: &Conditions) -> Rested {
    let step = StepSize::courant(T::of(0.2)).expect("a number");
    let mut run = Simulation::new(saturated::<T>(bed, conditions), LeapFrog::new(), step);
    run.start().expect("a start");
    let parcels = |mixture: &Saturated<T>| [Parcel::of(mixture.soil()), Parcel::of(mixture.water())];
    let start = parcels(run.mixture());
    let mut fractions = Vec::new();
    let followed = run.run_until(end, |run| {
        let water = run.mixture().water();
        let inner = water.wall_particles()..water.len();
        fractions.extend(range(inner.map(|a| water.volume_fraction(a).as_f64())));
        ControlFlow::<()>::Continue(())
    });
    if let Err(error) = followed {
        let stopped = vec![Band::new(error.to_string(), None, (-1.0, 1.0))];
        return Rested { pressures: stopped.clone(), others: stopped };
    }
    let [least, most] = range(fractions);
    let mut pressures = Vec::new();
    let mut others = vec![
        Band::new("least φ_f", Some(least), (-0.01, 1.01)),
        Band::new("largest φ_f", Some(most), (-0.01, 1.01)),
    ];
    let oedometric = 3.0 * BULK_MODULUS * (1.0 - POISSON) / (1.0 + POISSON);
    let layers = [
        ("soil", BUOYANT * GRAVITY, HEIGHT, oedometric),
        ("water", WATER * GRAVITY, HEIGHT + bed.above, WATER * SOUND_SPEED.powi(2)),
    ];
    let end = parcels(run.mixture());
    for (n, (name, weight, depth, modulus)) in layers.into_iter().enumerate() {
        let change = |of: fn(&Parcel) -> f64| mean(&end[n], of) - mean(&start[n], of);
        let rms = mean(&end[n], |it| it.speed().powi(2)).sqrt();
        let band = |what, value, most: f64| Band::new(format!("{name}: {what}"), Some(value), (-most, most));
        let half_a_row = 0.5 * weight * bed.spacing;
        pressures.push(band("change of mean pressure [Pa]", change(|it| it.pressure), half_a_row));
        others.push(band("rms velocity [m/s]", rms, 1e-5));
        let sinks = 0.5 * weight * depth.powi(2) / modulus;
        others.push(band("change of mean height [m]", change(|it| it.place[1]), sinks));
    }
    Rested { pressures, others }
}

fn mean(parcels: &[Parcel], of: fn(&Parcel) -> f64) -> f64 {
    parcels.iter().map(of).sum::<f64>() / parcels.len() as f64
}

/// At the start.
fn saturated<T: Real>(bed: Bed, conditions: &Conditions) -> Saturated<T> {
    let Bed { spacing, width, above, is_bare } = bed;
    let volume = T::of(spacing * spacing);
    let level = HEIGHT + (above / spacing).round() * spacing;
    let weight = if conditions.is(DRY) { BUOYANT + WATER } else { BUOYANT } * GRAVITY;
    let elasticity = Elasticity::from_bulk(T::of(BULK_MODULUS), T::of(POISSON)).expect("moduli");
    let cone = DruckerPrager::new(Cone::PlaneStrain, T::of(25_f64.to_radians()), T::ZERO).expect("a cone");
    let ratio = LateralRatio::new(&elasticity, &cone).admissible();
    let walls: Vec<Vector<T, 2>> =
        setup::tank([0.0; 2], [width, level], spacing, 3, [(!is_bare, !is_bare), (true, false)]);
    let (beside, over): (Vec<_>, Vec<_>) = walls.iter().copied().partition(|x| x[1] < T::of(HEIGHT));
    let mut soil = Phase::new(Soil::new(T::of(BUOYANT + WATER), elasticity, cone).expect("a soil"));
    let sticks = || Wall::extrapolated(Slip::NoSlip);
    soil.add_wall(sticks(), &beside, volume, |_| T::ZERO).expect("walls");
    soil.add_wall(sticks().apart(), &over, volume, |_| T::ZERO).expect("walls");
    soil.add(&setup::fill([0.0; 2], [width, HEIGHT], spacing), volume, |_| T::ZERO).expect("soil");
    soil.set_volume_fraction(|_| T::of(0.5));
    soil.set_stress(|x| {
        let vertical = T::of(-weight * (HEIGHT - x[1].as_f64()).max(0.0));
        let mut stress = SymTensor::isotropic(ratio * vertical);
        stress.0[SymTensor::<T>::index(1, 1)] = vertical;
        stress
    });
    let mut water = Phase::new(Water::new(T::of(WATER), T::of(SOUND_SPEED)).expect("water"));
    let pressure = setup::hydrostatic(T::of(WATER), T::of(GRAVITY), 1, T::of(level));
    water.add_wall(Wall::extrapolated(Slip::FreeSlip), &walls, volume, &pressure).expect("walls");
    water.add(&setup::fill([0.0; 2], [width, level], spacing), volume, &pressure).expect("water");
    let h = 1.5 * spacing;
    let mixture = Mixture::new(WendlandC2::new(T::of(h)).expect("a length"), soil, water)
        .with_gravity(along(1, -GRAVITY))
        .with_drag(Darcy::new(Conductivity::new(T::of(5e-4)).expect("a conductivity")))
        .with_density_relaxation(T::of(200.0 * h / SOUND_SPEED))
        .expect("a time");
    if !is_bare {
        return mixture;
    }
    let undiffused = mixture.with_periodic(periodic([width, 0.0]));
    undiffused.with_density_diffusion(DensityDiffusion::None).expect("none")
}
