//! A solver that simulates nothing, to test what is around it: a column whose front moves as a parabola.

use crate::outcome::Failure;
use crate::solver::{DamBreak, Seen, Solver, Step, Stopped, View, quantity};
use alluvium::Vector;
use alluvium::case::{Case, Field, Gauge, Warnings};
use alluvium::output::Vtp;
use alluvium::verify::dam_break::{Reference, VelocityError};
use std::path::PathBuf;

/// A small case with three dumps and a gauge.
pub fn case() -> (Case, Warnings) {
    let text = r#"
        name = "stand-in"
        end_time_s = 0.25
        particles.spacing_m = 0.01
        output = { dump_times_s = [0.0, 0.1, 0.25], history_interval_s = 0.01 }
        [[water.block]]
        low_m = [0.0, 0.0]
        high_m = [0.1, 0.2]
        [[gauge]]
        name = "toe"
        position_m = [0.1, 0.0]
    "#;
    Case::parse("stand-in.toml", text).map_err(Failure::from).unwrap()
}

/// A path that does not exist yet.
pub fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("alluvium-{name}-{}", std::process::id()));
    std::fs::remove_dir_all(&path).ok();
    path
}

pub struct StandIn {
    time: f64,
    steps: u64,
    fails_at: f64,
}

impl StandIn {
    pub fn new(fails_at: f64) -> Self {
        Self { time: 0.0, steps: 0, fails_at }
    }

    fn front(&self) -> f64 {
        0.1 * (1.0 + 72.0 * self.time * self.time)
    }
}

impl Solver for StandIn {
    fn time(&self) -> f64 {
        self.time
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn particles(&self) -> (usize, usize) {
        (10, 0)
    }

    fn step(&mut self, until: f64) -> Result<Step, Stopped> {
        let is_cut = self.time + 0.003 >= until;
        let next = if is_cut { until } else { self.time + 0.003 };
        let step = Step { length: next - self.time, limit: if is_cut { "output" } else { "acoustic" } };
        (self.time, self.steps) = (next, self.steps + 1);
        if next >= self.fails_at {
            Err(Stopped(format!("particle 7 is not finite at {next} s")))
        } else {
            Ok(step)
        }
    }

    fn quantities(&mut self) -> Vec<(String, f64)> {
        let lost = 1.0 - 0.5 * self.time;
        let named = [
            (quantity::KINETIC, 1.0 - lost),
            (quantity::POTENTIAL, lost),
            (quantity::COMPRESSIVE, 0.0),
            ("taken_by_artificial_viscosity", 0.1 * self.time),
            (quantity::CLOSURE, 0.0),
        ];
        let energies = named.map(|(name, value)| (quantity::head(name, "J", 2), value));
        [(quantity::FRONT.to_owned(), self.front())].into_iter().chain(energies).collect()
    }

    fn files(&mut self, _: &[Field]) -> Vec<(&'static str, Vtp)> {
        vec![("water", Vtp::new(self.time, &[Vector([self.front(), 0.0])]))]
    }

    fn gauge(&mut self, _: &Gauge) -> Vec<(&'static str, f64)> {
        vec![("pressure [Pa]", self.time)]
    }

    fn view(&mut self) -> View {
        let seen = Seen {
            place: [self.front(), 0.0, 0.0],
            pressure: 500.0,
            speed: 1.0,
            equivalent_plastic_strain: 0.0,
        };
        View { soil: Vec::new(), water: vec![seen], walls: vec![[0.0, -0.01, 0.0]] }
    }

    fn dam_break(&self, _: &Reference) -> DamBreak {
        let velocity = VelocityError { l2: 0.1, compared: 10, left_out: 0 };
        DamBreak { noise: (0.01, 10), leaked: 0, stuck: 0, velocity }
    }
}
