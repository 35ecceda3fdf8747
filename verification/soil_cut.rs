//! A vertical cut in cohesive soil: below its critical height it stands, above it falls.

use crate::soil::SoilMixture;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Cone, DruckerPrager, Elasticity, Soil};
use alluvium::mixture::{ArtificialStress, Mixture, Phase, Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, SymTensor, Vector, setup};
use core::f64::consts::FRAC_PI_4;
use std::ops::ControlFlow;

const SOURCE: &str = "critical height 3.83 c/(ρg) tan(45° + θ/2), by a slip circle (Taylor 1937; Chen 1975); a plane \
                      slip gives 4";
const WEAK: &str = "a third of the cohesion missing";
const STRONG: &str = "a third more cohesion";
const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 2000.0;
const FRICTION_ANGLE: f64 = 20.0;
const HEIGHT: f64 = 1.0;
const WIDTH: f64 = 2.0;
const SPACING: f64 = 0.05;
/// When it is looked at \[s\]: several times √(H/g), after which nothing that stands moves.
const LATE: f64 = 1.5;

pub fn studies() -> Vec<Study> {
    vec![
        stands::<f64>("soil/vertical cut/stands"),
        stands::<f32>("soil/vertical cut/stands/f32"),
        falls::<f64>("soil/vertical cut/falls"),
        falls::<f32>("soil/vertical cut/falls/f32"),
    ]
}

fn stands<T: Real>(name: &str) -> Study {
    Study::new(
        name,
        "a cut 0.85 times as high as the critical height stands (value: how far its crest has sunk, over the \
         height)",
        |conditions| Measured::value(1.0 - crest::<T>(0.85, conditions)),
    )
    .source(SOURCE)
    .level(Level::Full)
    .expect(Expected::Bound { largest: 0.02 })
    .mutant(WEAK)
}

fn falls<T: Real>(name: &str) -> Study {
    Study::new(
        name,
        "a cut 1.15 times as high as the critical height falls (value: where its crest is, over the height)",
        |conditions| Measured::value(crest::<T>(1.15, conditions)),
    )
    .source(SOURCE)
    .level(Level::Full)
    .expect(Expected::Bound { largest: 0.9 })
    .mutant(STRONG)
}

/// Height of the crest at the end over that at the start, of a cut `ratio` times as high as the critical
/// height: the height is the same, the cohesion is not.
fn crest<T: Real>(ratio: f64, conditions: &Conditions) -> f64 {
    let slope = (FRAC_PI_4 + 0.5 * FRICTION_ANGLE.to_radians()).tan();
    let mistake = match (conditions.is(WEAK), conditions.is(STRONG)) {
        (true, _) => 2.0 / 3.0,
        (_, true) => 4.0 / 3.0,
        _ => 1.0,
    };
    let cohesion = mistake * DENSITY * GRAVITY * HEIGHT / (3.83 * slope * ratio);
    let step = StepSize::courant(T::of(0.2)).expect("0.2");
    let mut run = Simulation::new(cut::<T>(cohesion), LeapFrog::new(), step);
    run.start().expect("a sound start");
    let soil = run.mixture().soil();
    let beyond = |x: &Vector<T, 2>| (*x - Vector::of([WIDTH, HEIGHT])).norm();
    let free = soil.wall_particles()..soil.len();
    let nearer = |a: &usize, b: &usize| {
        let [a, b] = [a, b].map(|&i| beyond(&soil.positions()[i]).as_f64());
        a.total_cmp(&b)
    };
    let id = soil.ids()[free.min_by(nearer).expect("particles")];
    let _: ControlFlow<()> = run.run_until(LATE, |_| ControlFlow::Continue(())).expect("a sound run");
    let soil = run.mixture().soil();
    let at = soil.ids().iter().position(|&other| other == id).expect("nobody leaves");
    (soil.positions()[at][1].as_f64() + 0.5 * SPACING) / HEIGHT
}

fn cut<T: Real>(cohesion: f64) -> SoilMixture<T, 2, Soil<T>> {
    let elasticity = Elasticity::new(T::of(2e6), T::of(0.3)).expect("moduli");
    let (friction, zero) = (T::of(FRICTION_ANGLE.to_radians()), T::ZERO);
    let cone = DruckerPrager::cohesive(Cone::PlaneStrainNonDilatant, friction, zero, T::of(cohesion))
        .expect("a cone");
    let lateral = elasticity.lateral_ratio().as_f64();
    let mut phase = Phase::new(Soil::new(T::of(DENSITY), elasticity, cone).expect("a soil"));
    let volume = T::of(SPACING * SPACING);
    let tank = setup::tank([0.0; 2], [2.0 * WIDTH, 1.5 * HEIGHT], SPACING, 3, [(true, false), (true, false)]);
    phase.add_wall(Wall::extrapolated(Slip::NoSlip), &tank, volume, |_| zero).expect("a wall");
    phase.add(&setup::fill([0.0; 2], [WIDTH, HEIGHT], SPACING), volume, |_| zero).expect("particles");
    phase.set_stress(|x| {
        let [x, y] = x.as_f64();
        let depth = if x < WIDTH { (HEIGHT - y).clamp(0.0, HEIGHT) } else { 0.0 };
        let vertical = -DENSITY * GRAVITY * depth;
        // Nothing presses on the face of the cut.
        let level = vertical * lateral * ((WIDTH - x) / (0.5 * HEIGHT)).clamp(0.0, 1.0);
        SymTensor([level, vertical, level, 0.0, 0.0, 0.0].map(T::of))
    });
    let kernel = WendlandC2::new(T::of(1.3 * SPACING)).expect("a length");
    Mixture::of_soil(kernel, phase)
        .with_gravity(Vector::of([0.0, -GRAVITY]))
        .with_artificial_stress(ArtificialStress {
            strength: T::of(0.3),
            exponent: 4,
            spacing: T::of(SPACING),
        })
        .expect("numerics")
}
