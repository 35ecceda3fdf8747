//! Cavitating water: in the books until its cavities have closed, and beside walls.

use alluvium::kernel::WendlandC2;
use alluvium::material::{Elasticity, Material, Soil, Unyielding, Water};
use alluvium::mixture::{DensityDiffusion, Mixture, Phase, Slip, Wall, WallKind};
use alluvium::simulation::Simulation;
use alluvium::time::{Evolve, StepSize, VelocityVerlet};
use alluvium::{Vector, setup};

const SPACING: f64 = 0.05;
const H: f64 = 1.5 * SPACING;

/// What is seen of a drop that is torn apart until it cavitates and falls together again.
struct Torn {
    /// The lowest pressure \[Pa\].
    lowest: f64,
    /// Volume of the cavities \[m²\] when it is largest, and at the end.
    cavities: [f64; 2],
    /// The largest part of its kinetic energy nobody explains, on the way to the largest cavities and after them.
    unexplained: [f64; 2],
    /// What a law without cavities would claim for the largest ones, of the kinetic energy.
    claimed: f64,
}

/// Of 0.36 m², 1 m/s, until its cavities are a twentieth of what they were, or 0.5 s.
fn torn(least: f64, courant: f64) -> Torn {
    let places = setup::fill::<f64, 2>([-0.3; 2], [0.3; 2], SPACING);
    let free = Water::new(1000.0, 30.0).unwrap();
    let law = free.with_cavitation(least).unwrap();
    let mut water = Phase::new(law);
    water.add(&places, SPACING * SPACING, |_| 0.0).unwrap();
    water.set_velocity(|x| *x * 4.0);
    let mixture = Mixture::<f64, 2>::of_water(WendlandC2::new(H).unwrap(), water)
        .with_density_diffusion(DensityDiffusion::None)
        .unwrap();
    let mut run = Simulation::new(mixture, VelocityVerlet::new(), StepSize::courant(courant).unwrap());
    run.step().unwrap();
    let before = run.mixture().budget();
    let opens = law.compression(least);
    let mut seen = Torn { lowest: 0.0, cavities: [0.0; 2], unexplained: [0.0; 2], claimed: 0.0 };
    while run.time() < 0.5 {
        run.step().unwrap();
        let water = run.mixture().water();
        let sum = |of: &dyn Fn(f64) -> f64| -> f64 {
            (0..water.len()).map(|i| water.masses()[i] * of(water.compression(i))).sum()
        };
        let cavities = sum(&|e| (1.0 / (1.0 + e.min(opens)) - 1.0 / (1.0 + opens)) / 1000.0);
        let unexplained = run.mixture().budget().closure(&before).abs() / before.kinetic;
        seen.lowest = water.pressures().iter().copied().fold(seen.lowest, f64::min);
        seen.cavities[1] = cavities;
        if cavities > seen.cavities[0] {
            seen.cavities[0] = cavities;
            seen.unexplained[0] = seen.unexplained[0].max(seen.unexplained[1]).max(unexplained);
            seen.claimed = sum(&|e| free.stored_energy(e, &()) - law.stored_energy(e, &())) / before.kinetic;
        }
        seen.unexplained[1] = seen.unexplained[1].max(unexplained);
        if cavities < 0.05 * seen.cavities[0] {
            break;
        }
    }
    seen
}

#[test]
fn cavities_are_in_the_books_until_they_have_closed() {
    let [coarse, fine] = [0.05, 0.025].map(|courant| torn(-3e3, courant));
    assert_eq!(fine.lowest, -3e3);
    let [largest, last] = fine.cavities;
    assert!(largest > 0.03 && last < 0.05 * largest, "cavities of {largest} m², at the end {last}");
    let [opening, closing] = fine.unexplained;
    assert!(opening < 1e-4 && closing < 1e-4, "{opening:e}, {closing:e}");
    assert!(fine.claimed > 1.0, "{}", fine.claimed);
    // What is not explained is an error of the integration in time.
    assert!(coarse.unexplained[1] > 3.0 * closing, "{:e}, {closing:e}", coarse.unexplained[1]);
    let bears_it = torn(-1.2e5, 0.1);
    assert!(bears_it.lowest < -1e4, "without it suction is deep: {}", bears_it.lowest);
}

/// The pressures \[Pa\] of a ceiling that may pull on water that hangs from it without pressure.
fn ceiling(law: Water<f64>) -> Vec<[f64; 2]> {
    let wall = setup::fill::<f64, 2>([-0.3, 0.0], [0.3, 0.15], SPACING);
    let hanging = setup::fill::<f64, 2>([-0.3, -0.6], [0.3, 0.0], SPACING);
    let mut water = Phase::new(law);
    let kind = WallKind::Extrapolated { slip: Slip::FreeSlip, suction: true };
    water.add_wall(Wall::new(kind), &wall, SPACING * SPACING, |_| 0.0).unwrap();
    water.add(&hanging, SPACING * SPACING, |_| 0.0).unwrap();
    let mut mixture =
        Mixture::<f64, 2>::of_water(WendlandC2::new(H).unwrap(), water).with_gravity(Vector([0.0, -9.81]));
    mixture.evaluate().unwrap();
    let water = mixture.water();
    let is_reached = |i: &usize| water.positions()[*i][1] < 2.0 * H - SPACING;
    let walls = (0..water.wall_particles()).filter(is_reached);
    walls.map(|i| [water.pressures()[i], law.pressure(water.compression(i), &())]).collect()
}

#[test]
fn a_wall_pulls_no_harder_than_the_water_bears() {
    let law = Water::new(1000.0, 30.0).unwrap();
    let lowest = |law| ceiling(law).iter().map(|[p, _]| *p).fold(0.0_f64, f64::min);
    assert!(lowest(law) < -900.0, "a law that bears it: {}", lowest(law));
    let cavitating = law.with_cavitation(-500.0).unwrap();
    assert_eq!(lowest(cavitating), -500.0);
    for [pressure, of_its_density] in ceiling(cavitating) {
        assert!((pressure - of_its_density).abs() < 1e-9 * pressure.abs(), "{pressure}, {of_its_density}");
    }
}

/// Largest acceleration \[m/s²\], but for gravity, of cavitating water under a wall of soil.
fn under_soil(law: Water<f64>) -> f64 {
    let fill = |low: f64, high: f64| setup::fill::<f64, 2>([-0.3, low], [0.3, high], SPACING);
    let volume = SPACING * SPACING;
    let elasticity = Elasticity::from_bulk(0.7e6, 0.3).unwrap();
    let accelerations = |gravity: Vector<f64, 2>| {
        let mut soil = Phase::new(Soil::new(2650.0, elasticity, Unyielding).unwrap());
        soil.add_wall(Wall::extrapolated(Slip::NoSlip), &fill(0.0, 0.15), volume, |_| 0.0).unwrap();
        soil.add(&fill(-0.3, 0.0), volume, |_| 0.0).unwrap();
        soil.set_volume_fraction(|_| 0.5);
        let mut water = Phase::new(law);
        water.add(&fill(-0.6, 0.0), volume, |_| -500.0).unwrap();
        let mut mixture = Mixture::new(WendlandC2::new(H).unwrap(), soil, water)
            .with_density_diffusion(DensityDiffusion::None)
            .unwrap()
            .with_gravity(gravity);
        mixture.evaluate().unwrap();
        mixture.water().accelerations().to_vec()
    };
    let gravity = Vector([0.0, -9.81]);
    let (with, without) = (accelerations(gravity), accelerations(Vector::zero()));
    with.iter().zip(&without).map(|(a, b)| (*a - *b - gravity).norm()).fold(0.0, f64::max)
}

#[test]
fn the_pores_of_a_wall_pull_no_harder_either() {
    let law = Water::new(1000.0, 30.0).unwrap();
    assert!(under_soil(law) > 1.0, "a law that bears it: {}", under_soil(law));
    let cavitating = under_soil(law.with_cavitation(-500.0).unwrap());
    assert!(cavitating < 1e-9, "{cavitating}");
}
