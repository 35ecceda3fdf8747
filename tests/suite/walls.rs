//! Walls: what they bear, that nothing gets lost between a wall and the fluid, and what a moving wall
//! does.

use alluvium::budget::Account;
use alluvium::kernel::WendlandC2;
use alluvium::material::Water;
use alluvium::mixture::{Mixture, Phase, Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize, VelocityVerlet};
use alluvium::{Vector, setup};
use core::f64::consts::PI;
use core::ops::ControlFlow;

const SPACING: f64 = 0.01;
const G: f64 = 9.81;
/// Width and depth of the water \[m\].
const SIZE: [f64; 2] = [0.3, 0.2];

fn kinds() -> [Wall<f64, 2>; 3] {
    [Wall::dynamic(), Wall::extrapolated(Slip::NoSlip), Wall::extrapolated(Slip::FreeSlip)]
}

/// Still water on a floor (body 0) between side walls (body 1).
fn still_tank(wall: &Wall<f64, 2>) -> Mixture<f64, 2> {
    let volume = SPACING * SPACING;
    let still = setup::hydrostatic(1000.0, G, 1, SIZE[1]);
    let top = [SIZE[0], SIZE[1] + 0.1];
    let walls = setup::tank::<f64, 2>([0.0; 2], top, SPACING, 3, [(true, true), (true, false)]);
    let (floor, sides): (Vec<_>, Vec<_>) = walls.into_iter().partition(|x| x[1] < 0.0);
    let mut phase = Phase::new(Water::new(1000.0, 10.0 * (G * SIZE[1]).sqrt()).unwrap());
    phase.add_wall(wall.clone(), &floor, volume, &still).unwrap();
    phase.add_wall(wall.clone(), &sides, volume, &still).unwrap();
    phase.add(&setup::fill([0.0; 2], SIZE, SPACING), volume, &still).unwrap();
    Mixture::of_water(WendlandC2::new(1.3 * SPACING).unwrap(), phase).with_gravity(Vector([0.0, -G]))
}

#[test]
fn the_floor_of_a_still_tank_bears_the_weight_of_the_water() {
    for wall in kinds() {
        let mixture = still_tank(&wall);
        let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(0.2).unwrap());
        let (mut mean, mut span) = ([0.0; 2], 0.0);
        let _ = run
            .run_until(1.0, |run| {
                if run.time() > 0.5 {
                    let (step, water) = (run.last_step().length, run.mixture().water());
                    let (floor, sides) = (water.wall_force(0), water.wall_force(1));
                    mean[0] += step * floor[1];
                    mean[1] += step * (floor[1] + sides[1]);
                    span += step;
                }
                ControlFlow::Continue(())
            })
            .unwrap();
        let weight = run.budget().mass * G;
        // The floor alone within 3 %: the corners belong to floor and sides both.
        assert!((mean[0] / span / weight + 1.0).abs() < 0.03, "{:?}: {}", wall.kind(), mean[0] / span);
        assert!((mean[1] / span / weight + 1.0).abs() < 0.01, "{:?}: {}", wall.kind(), mean[1] / span);
    }
}

#[test]
fn what_a_wall_bears_is_what_the_water_lacks() {
    for wall in kinds() {
        let mixture = still_tank(&wall);
        let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(0.2).unwrap());
        run.mixture_mut().water_mut().set_velocity(|x| Vector([x[1], -x[0]]));
        for _ in 0..50 {
            run.step().unwrap();
        }
        let water = run.mixture().water();
        let (floor, sides) = (water.wall_force(0), water.wall_force(1));
        let mut missing = [floor[0] + sides[0], floor[1] + sides[1]];
        let mut scale = 0.0;
        for i in water.wall_particles()..water.len() {
            let a = water.accelerations()[i] - run.mixture().gravity();
            for k in 0..2 {
                missing[k] += water.masses()[i] * a[k];
                scale += (water.masses()[i] * a[k]).abs();
            }
        }
        for force in missing {
            assert!(force.abs() < 1e-12 * scale, "{:?}: {force:e} of {scale:e}", wall.kind());
        }
    }
}

/// A closed box of water whose left wall (body 0) moves in by 3 mm within 0.1 s and stops; returns
/// unexplained, stored and given energy \[J/m\], and the work `∫F dx` seen from outside.
fn piston(wall: Wall<f64, 2>) -> [f64; 4] {
    let (volume, size) = (SPACING * SPACING, [0.3, 0.1]);
    let push = |t: f64| if t < 0.1 { 0.03 * (1.0 - (2.0 * PI * t / 0.1).cos()) } else { 0.0 };
    let walls = setup::tank::<f64, 2>([0.0; 2], size, SPACING, 3, [(true, true), (true, true)]);
    let (left, others): (Vec<_>, Vec<_>) = walls.into_iter().partition(|x| x[0] < 0.0);
    let mut phase = Phase::new(Water::new(1000.0, 20.0).unwrap());
    phase.add_wall(wall.clone().moving(move |_, t| Vector([push(t), 0.0])), &left, volume, |_| 0.0).unwrap();
    phase.add_wall(wall, &others, volume, |_| 0.0).unwrap();
    phase.add(&setup::fill([0.0; 2], size, SPACING), volume, |_| 0.0).unwrap();
    let mixture = Mixture::<f64, 2>::of_water(WendlandC2::new(1.3 * SPACING).unwrap(), phase);
    let mut run = Simulation::new(mixture, VelocityVerlet::new(), StepSize::courant(0.1).unwrap());
    run.start().unwrap();
    let (start, mut work) = (run.budget(), 0.0);
    while run.time() < 0.15 {
        let before = run.mixture().water().wall_force(0)[0] * push(run.time());
        let step = run.step().unwrap();
        let after = run.mixture().water().wall_force(0)[0] * push(run.time());
        work -= 0.5 * (before + after) * step.length;
    }
    let end = run.budget();
    [end.closure(&start), end.energy() - start.energy(), -end.taken[Account::WallWork], work]
}

#[test]
fn a_piston_does_work_and_the_ledger_books_it() {
    for wall in kinds() {
        let [unexplained, gained, given, work] = piston(wall.clone());
        let what = format!("{:?}: {unexplained:e} {gained:e} {given:e} {work:e}", wall.kind());
        // 1 % of compression at K = ρc² = 0.4 MPa in 0.03 m²: about 0.6 J/m.
        assert!((0.3..1.2).contains(&given), "{what}");
        assert!((work / given - 1.0).abs() < 1e-2, "force times way: {what}");
        assert!(unexplained.abs() < 1e-3 * given, "{what}");
        assert!(gained > 0.3 * given, "most of it is stored: {what}");
    }
}
