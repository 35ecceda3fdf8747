//! A run that goes bad stops within the step and says who, what, where and when.

use crate::tank::Dam;
use alluvium::Vector;
use alluvium::mixture::{Culprit, Mixture, Slip, StepError, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, Limit, StepSize};

type Run = Simulation<f64, 2>;

/// A dam that has run well for a while.
fn healthy(wall: Wall<f64, 2>) -> Run {
    let mut run = Run::new(Dam::SMALL.mixture(wall), LeapFrog::new(), StepSize::courant(0.2).unwrap());
    for _ in 0..20 {
        run.step().unwrap();
    }
    run
}

/// Place in the arrays of the particle with number `id`.
fn place(run: &Run, id: u32) -> usize {
    run.mixture().water().ids().iter().position(|&other| other == id).unwrap()
}

/// A water particle's number, from the middle of the column.
fn somebody(run: &Run) -> u32 {
    let water = run.mixture().water();
    let middle = Vector([0.05, 0.1]);
    let nearest = (water.wall_particles()..water.len())
        .min_by(|&i, &j| {
            let away = |k: usize| (water.positions()[k] - middle).norm2();
            away(i).total_cmp(&away(j))
        })
        .unwrap();
    water.ids()[nearest]
}

/// Positions in the order of the particles' numbers.
fn by_id(mixture: &Mixture<f64, 2>) -> Vec<Vector<f64, 2>> {
    let water = mixture.water();
    let mut positions = vec![Vector::zero(); water.len()];
    for (&id, x) in water.ids().iter().zip(water.positions()) {
        positions[id as usize] = *x;
    }
    positions
}

fn names(culprit: &Culprit, kind: &str, id: u32, time: f64) {
    assert_eq!((culprit.kind, culprit.particle, culprit.time), (kind, id, time));
}

#[test]
fn a_velocity_that_is_not_a_number() {
    let mut run = healthy(Wall::extrapolated(Slip::FreeSlip));
    let (id, time) = (somebody(&run), run.time());
    let i = place(&run, id);
    run.mixture_mut().water_mut().velocities_mut()[i][1] = f64::NAN;
    match run.step().unwrap_err() {
        StepError::NotFinite { culprit, field, term } => {
            names(&culprit, "water", id, time);
            assert_eq!((field, term), ("velocity", "state before the evaluation"));
        }
        other => panic!("{other}"),
    }
    assert_eq!(run.time(), time, "the clock stands still");
}

#[test]
fn a_position_of_a_wall_particle_that_is_infinite() {
    let mut run = healthy(Wall::dynamic());
    let (id, time) = (run.mixture().water().ids()[7], run.time());
    run.mixture_mut().water_mut().positions_mut()[7][0] = f64::INFINITY;
    match run.step().unwrap_err() {
        StepError::NotFinite { culprit, field, .. } => {
            names(&culprit, "water wall", id, time);
            assert_eq!(field, "position");
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_body_force_that_is_not_a_number_from_some_time_on() {
    let mixture = Dam::SMALL.mixture::<f64, 2>(Wall::dynamic()).with_force(|x, t| {
        let bad = t > 1e-3 && x[0] > 0.05;
        Vector([if bad { f64::NAN } else { 0.0 }, 0.0])
    });
    let mut run = Run::new(mixture, LeapFrog::new(), StepSize::fixed(2e-5).unwrap());
    let error = loop {
        if let Err(error) = run.step() {
            break error;
        }
        assert!(run.time() < 1e-3 + 2.1e-5, "went on with it until t = {}", run.time());
    };
    match error {
        StepError::NotFinite { culprit, field, term } => {
            assert_eq!((field, term), ("acceleration", "body force"));
            assert!(culprit.position[0] > 0.05 && culprit.kind == "water");
        }
        other => panic!("{other}"),
    }
}

#[test]
fn two_particles_at_one_place() {
    for wall in [Wall::dynamic(), Wall::extrapolated(Slip::NoSlip)] {
        let mut run = healthy(wall);
        let one = somebody(&run);
        let i = place(&run, one);
        let other = run.mixture().water().ids()[i + 40];
        let there = run.mixture().water().positions()[i];
        run.mixture_mut().water_mut().positions_mut()[i + 40] = there;
        let time = run.time();
        match run.step().unwrap_err() {
            StepError::Overlap { culprit, other: second, distance, allowed } => {
                let mut found = [culprit.particle, second];
                found.sort_unstable();
                let mut expected = [one, other];
                expected.sort_unstable();
                assert_eq!((found, culprit.time), (expected, time));
                assert!(distance < allowed);
            }
            other => panic!("{other}"),
        }
    }
}

#[test]
fn a_particle_faster_than_sound() {
    let mut run = healthy(Wall::dynamic());
    let id = somebody(&run);
    let i = place(&run, id);
    run.mixture_mut().water_mut().velocities_mut()[i] = Vector([0.0, 26.0]);
    match run.step().unwrap_err() {
        StepError::Absurd { culprit, field, value, allowed } => {
            names(&culprit, "water", id, run.time());
            assert_eq!((field, value), ("speed", 26.0));
            assert!(allowed.contains("25"), "{allowed}");
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_step_that_is_far_too_long_is_refused_before_it_is_done() {
    let mixture = Dam::SMALL.mixture::<f64, 2>(Wall::dynamic());
    let before = by_id(&mixture);
    let mut run = Run::new(mixture, LeapFrog::new(), StepSize::fixed(1e-3).unwrap());
    match run.step().unwrap_err() {
        StepError::StepTooLong { step, allowed, limit, time } => {
            assert_eq!((step, limit, time), (1e-3, Limit::Acoustic, 0.0));
            assert!((allowed - 1.3 * 0.004 / 25.0).abs() < 1e-12);
        }
        other => panic!("{other}"),
    }
    assert_eq!((run.steps(), run.time()), (0, 0.0));
    // In the order of their numbers: the first evaluation sorts the particles.
    assert_eq!(before, by_id(run.mixture()));
}

#[test]
fn every_message_names_particle_value_and_time() {
    let mut run = healthy(Wall::dynamic());
    let id = somebody(&run);
    let i = place(&run, id);
    run.mixture_mut().water_mut().velocities_mut()[i] = Vector([0.0, 26.0]);
    let message = run.step().unwrap_err().to_string();
    for part in [format!("particle {id}"), "speed".into(), "2.6".into(), "t = ".into(), "25 m/s".into()] {
        assert!(message.contains(&part), "`{part}` is missing in: {message}");
    }
}
