//! Water in soil, in time: it seeps through as Darcy's law has it, and rests where it should.

use crate::soil::{along, elastic};
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{
    Conductivity, Cone, Darcy, DragLaw, DruckerPrager, Elasticity, LateralRatio, Soil, Water,
};
use alluvium::mixture::{DensityDiffusion, Mixture, Phase, Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, SymTensor, Vector, setup};

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
        rest::<f64>("mixture/saturated bed/quick", Bed { spacing: 0.00625, ..FLUSH }, 0.02),
        rest::<f32>("mixture/saturated bed/quick/f32", Bed { spacing: 0.00625, ..FLUSH }, 0.02),
        rest::<f64>("mixture/saturated bed/as in the paper", FLUSH, 0.5).level(Level::Full),
        rest::<f64>("mixture/saturated bed/under water", Bed { above: 0.05, ..FLUSH }, 0.5)
            .level(Level::Full),
        rest::<f64>("mixture/saturated bed/under water, no corners", WITHOUT_CORNERS, 0.1),
        rest::<f32>("mixture/saturated bed/under water, no corners/f32", WITHOUT_CORNERS, 0.1),
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
#[derive(Clone, Copy)]
struct Bed {
    spacing: f64,
    width: f64,
    /// Depth of the water over it \[m\].
    above: f64,
    /// Without what disturbs a surface of water also where there is no soil: side walls, and density
    /// diffusion.
    is_bare: bool,
}

const FLUSH: Bed = Bed { spacing: 0.005, width: 0.45, above: 0.0, is_bare: false };
const WITHOUT_CORNERS: Bed = Bed { spacing: 0.0125, width: 0.15, above: 0.05, is_bare: true };

fn rest<T: Real>(name: &str, bed: Bed, end: f64) -> Study {
    Study::new(
        name,
        "a saturated bed of soil laid under its buoyant weight rests (values: rms velocity in m/s)",
        move |conditions| Measured::values(velocities::<T>(bed, end, conditions)),
    )
    .equations(&["55", "58", "68", "75", "76"])
    .source("nothing drives it")
    .expect(Expected::Bound { largest: 1e-5 })
    .mutant(DRY)
}

type Saturated<T> = Mixture<T, 2, WendlandC2<T, 2>, Soil<T>, Water<T>>;

fn velocities<T: Real>(bed: Bed, end: f64, conditions: &Conditions) -> Vec<(String, f64)> {
    let step = StepSize::courant(T::of(0.2)).expect("a number");
    let mut run = Simulation::new(saturated::<T>(bed, conditions), LeapFrog::new(), step);
    while run.time() < end {
        if let Err(error) = run.step() {
            return vec![(error.to_string(), f64::INFINITY)];
        }
    }
    let rms = |velocities: &[Vector<T, 2>]| {
        (velocities.iter().map(|v| v.norm2().as_f64()).sum::<f64>() / velocities.len() as f64).sqrt()
    };
    let (soil, water) = (run.mixture().soil(), run.mixture().water());
    vec![
        ("soil".to_owned(), rms(&soil.velocities()[soil.wall_particles()..])),
        ("water".to_owned(), rms(&water.velocities()[water.wall_particles()..])),
    ]
}

/// At the start.
fn saturated<T: Real>(bed: Bed, conditions: &Conditions) -> Saturated<T> {
    let Bed { spacing, width, above, is_bare } = bed;
    let (height, volume) = (0.175, T::of(spacing * spacing));
    let level = height + (above / spacing).round() * spacing;
    let weight = if conditions.is(DRY) { 2700.0 } else { 1700.0 } * GRAVITY;
    let elasticity = Elasticity::from_bulk(T::of(125e6), T::of(0.3)).expect("moduli");
    let cone = DruckerPrager::new(Cone::PlaneStrain, T::of(25_f64.to_radians()), T::ZERO).expect("a cone");
    let ratio = LateralRatio::new(&elasticity, &cone).admissible();
    let walls: Vec<Vector<T, 2>> =
        setup::tank([0.0; 2], [width, level], spacing, 3, [(!is_bare, !is_bare), (true, false)]);
    let (beside, over): (Vec<_>, Vec<_>) = walls.iter().copied().partition(|x| x[1] < T::of(height));
    let mut soil = Phase::new(Soil::new(T::of(2700.0), elasticity, cone).expect("a soil"));
    let sticks = || Wall::extrapolated(Slip::NoSlip);
    soil.add_wall(sticks(), &beside, volume, |_| T::ZERO).expect("walls");
    soil.add_wall(sticks().apart(), &over, volume, |_| T::ZERO).expect("walls");
    soil.add(&setup::fill([0.0; 2], [width, height], spacing), volume, |_| T::ZERO).expect("soil");
    soil.set_volume_fraction(|_| T::of(0.5));
    soil.set_stress(|x| {
        let vertical = T::of(-weight * (height - x[1].as_f64()).max(0.0));
        let mut stress = SymTensor::isotropic(ratio * vertical);
        stress.0[SymTensor::<T>::index(1, 1)] = vertical;
        stress
    });
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(250.0)).expect("water"));
    let pressure = setup::hydrostatic(T::of(1000.0), T::of(GRAVITY), 1, T::of(level));
    water.add_wall(Wall::extrapolated(Slip::FreeSlip), &walls, volume, &pressure).expect("walls");
    water.add(&setup::fill([0.0; 2], [width, level], spacing), volume, &pressure).expect("water");
    let h = 1.5 * spacing;
    let mixture = Mixture::new(WendlandC2::new(T::of(h)).expect("a length"), soil, water)
        .with_gravity(along(1, -GRAVITY))
        .with_drag(Darcy::new(Conductivity::new(T::of(5e-4)).expect("a conductivity")))
        .with_density_relaxation(T::of(200.0 * h / 250.0))
        .expect("a time");
    if !is_bare {
        return mixture;
    }
    let undiffused = mixture.with_periodic(periodic([width, 0.0]));
    undiffused.with_density_diffusion(DensityDiffusion::None).expect("none")
}
