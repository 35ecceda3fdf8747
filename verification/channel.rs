//! Flow between walls without slip: the transients of Poiseuille and Couette.
//!
//! With the strain control: the printed double sum (58), (62) does not see a velocity that alternates
//! from row to row, which the start of the motion and the walls excite. Without the control the error
//! at 20 particles across is 10 to 30 % and grows with time; that is one of the mutants.

use crate::water::{WaterMixture, bare, periodic, water};
use alluvium::mixture::{Phase, Slip, Wall, WallKind};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study, relative_l2};
use alluvium::{Real, Vector, setup};
use std::f64::consts::PI;
use std::ops::ControlFlow;

const SOURCE: &str = "series solutions of ∂v/∂t = F + ν ∂²v/∂y² for height, viscosity and force one";
const DOUBLE: &str = "viscosity twice as large";
const SLIPPERY: &str = "walls with free slip";
const PRINTED: &str = "viscosity by the printed double sum alone";
const SHORT: &str = "the first term of the series alone";

#[derive(Clone, Copy, Debug, PartialEq)]
enum Flow {
    /// Driven by the force one between resting walls.
    Poiseuille,
    /// Driven by the upper wall with velocity one.
    Couette,
}

impl Flow {
    /// When it is looked at: on the way, and nearly steady.
    fn times(self) -> [f64; 2] {
        match self {
            Self::Poiseuille => [0.1, 0.6],
            Self::Couette => [0.05, 0.4],
        }
    }

    /// Ten times the fastest flow.
    fn sound_speed(self) -> f64 {
        match self {
            Self::Poiseuille => 1.25,
            Self::Couette => 10.0,
        }
    }

    /// The velocity along the channel at height `y`.
    fn exact(self, y: f64, t: f64) -> f64 {
        self.series(80, y, t)
    }

    /// The same by so many terms.
    fn series(self, terms: i32, y: f64, t: f64) -> f64 {
        match self {
            Self::Poiseuille => {
                let term = |n: i32| {
                    let m = PI * f64::from(2 * n + 1);
                    4.0 / m.powi(3) * (m * y).sin() * (-m * m * t).exp()
                };
                0.5 * y * (1.0 - y) - (0..terms).map(term).sum::<f64>()
            }
            Self::Couette => {
                let term = |n: i32| {
                    let m = PI * f64::from(n);
                    let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
                    2.0 * sign / m * (m * y).sin() * (-m * m * t).exp()
                };
                y + (1..=terms).map(term).sum::<f64>()
            }
        }
    }
}

pub fn studies() -> Vec<Study> {
    let mut studies = vec![solutions()];
    for (name, flow) in [("poiseuille", Flow::Poiseuille), ("couette", Flow::Couette)] {
        studies.push(study::<f64, 2>(&format!("channel/{name}/2d/f64"), flow, &[20]));
        studies.push(study::<f32, 2>(&format!("channel/{name}/2d/f32"), flow, &[20]));
        studies.push(study::<f64, 3>(&format!("channel/{name}/3d/f64"), flow, &[20]).level(Level::Full));
        studies.push(study::<f32, 3>(&format!("channel/{name}/3d/f32"), flow, &[20]).level(Level::Full));
        let order = study::<f64, 2>(&format!("channel/{name}/order"), flow, &[10, 20, 40]);
        // Gradients, control and walls are each of second order on rows of particles.
        studies.push(order.level(Level::Full).expect(Expected::order(2.0, 0.4)));
    }
    studies
}

/// The series are what another program computed.
fn solutions() -> Study {
    Study::new("channel/series", "the series solutions have their known values", |conditions| {
        let middle = |flow: Flow, time| match conditions.is(SHORT) {
            true => flow.series(1, 0.5, time),
            false => flow.exact(0.5, time),
        };
        Measured::values([
            ("Poiseuille v(.5, .1)", middle(Flow::Poiseuille, 0.1) - 0.076_919_1),
            ("Poiseuille v(.5, ∞)", middle(Flow::Poiseuille, 9.0) - 0.125),
            ("Couette v(.5, .05)", middle(Flow::Couette, 0.05) - 0.113_844_2),
        ])
    })
    .source("verified numbers of the exact solutions")
    .expect(Expected::Bound { largest: 1e-7 })
    .mutant(SHORT)
}

fn study<T: Real, const D: usize>(name: &str, flow: Flow, counts: &'static [usize]) -> Study {
    let claim = match flow {
        Flow::Poiseuille => "flow between walls without slip develops as Poiseuille's",
        Flow::Couette => "flow dragged along by a wall without slip develops as Couette's",
    };
    Study::new(name, claim, move |conditions| {
        Measured::errors(counts.iter().map(|&count| {
            let errors = run::<T, D>(flow, count, conditions);
            (1.0 / count as f64, errors[0].max(errors[1]))
        }))
    })
    .equations(&["14", "15", "58", "62"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 0.01 })
    .mutant(DOUBLE)
    .mutant(SLIPPERY)
    .mutant(PRINTED)
}

fn setting<T: Real, const D: usize>(flow: Flow, count: usize, conditions: &Conditions) -> WaterMixture<T, D> {
    let spacing = 1.0 / count as f64;
    let viscosity = if conditions.is(DOUBLE) { 2.0 } else { 1.0 };
    let slip = if conditions.is(SLIPPERY) { Slip::FreeSlip } else { Slip::NoSlip };
    let mut size = [8.0 * spacing; D];
    size[1] = 1.0;
    let (mut phase, volume) =
        (Phase::new(water::<T>(flow.sound_speed(), viscosity)), T::of(spacing.powi(D as i32)));
    let mut closed = [(false, false); D];
    for (below, above) in [(true, false), (false, true)] {
        closed[1] = (below, above);
        let places = setup::tank([0.0; D], size, spacing, 4, closed);
        let wall = Wall::new(WallKind::Extrapolated { slip, suction: true });
        let wall = match flow == Flow::Couette && above {
            true => wall.moving(|_, _| along(T::ONE)),
            false => wall,
        };
        phase.add_wall(wall, &places, volume, |_| T::ZERO).expect("a wall");
    }
    phase.add(&setup::fill([0.0; D], size, spacing), volume, |_| T::ZERO).expect("particles");
    let mut lengths = size;
    lengths[1] = 0.0;
    let control = if conditions.is(PRINTED) { T::ZERO } else { T::ONE };
    let mixture = bare(2.0 * spacing, phase).with_periodic(periodic(lengths));
    let mixture = mixture.with_strain_control(control).expect("a strength");
    match flow {
        Flow::Poiseuille => mixture.with_force(|_, _| along(T::ONE)),
        Flow::Couette => mixture,
    }
}

fn along<T: Real, const D: usize>(speed: T) -> Vector<T, D> {
    let mut v = Vector::zero();
    v[0] = speed;
    v
}

/// Relative L2 errors of the velocity along the channel at the two times.
fn run<T: Real, const D: usize>(flow: Flow, count: usize, conditions: &Conditions) -> [f64; 2] {
    let mixture = setting::<T, D>(flow, count, conditions);
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.2)).expect("0.2"));
    flow.times().map(|time| {
        let _ = run.run_until(time, |_| ControlFlow::<()>::Continue(())).expect("a run");
        let water = run.mixture().water();
        let free = water.wall_particles()..water.len();
        let measured: Vec<f64> = free.clone().map(|i| water.velocities()[i][0].as_f64()).collect();
        let exact: Vec<f64> = free.map(|i| flow.exact(water.positions()[i][1].as_f64(), time)).collect();
        relative_l2(&measured, &exact)
    })
}
