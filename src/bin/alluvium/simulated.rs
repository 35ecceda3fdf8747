//! A simulation of the library as the program sees it.

use crate::solver::{DamBreak, Seen, Solver, Step, Stopped, View, quantity};
use alluvium::budget::{Account, Budget};
use alluvium::case::{Case, Field, Gauge, Quantity, Side};
use alluvium::kernel::Kernel;
use alluvium::material::{Absent, Water};
use alluvium::mixture::{Mixture, Phase};
use alluvium::output::{Component, LengthError, Vtp};
use alluvium::simulation::Simulation;
use alluvium::time::Integrator;
use alluvium::verify::dam_break::{self, Reference};
use alluvium::{Real, Vector};

const AXES: [&str; 3] = ["x", "y", "z"];

/// A simulation and what its records are measured against.
pub struct Simulated<T: Real, const D: usize, K: Kernel<T, D>, I: Integrator<T>> {
    simulation: Simulation<T, D, K, Absent, Water<T>, I>,
    start: Budget<D>,
    /// The wall on each side, in the library's order.
    sides: Vec<Side>,
    /// The lowest potential energy water could have in the case's boxes \[J\].
    ground: f64,
    up: usize,
}

impl<T: Real + Component, const D: usize, K: Kernel<T, D>, I: Integrator<T>> Simulated<T, D, K, I> {
    pub fn new(mut simulation: Simulation<T, D, K, Absent, Water<T>, I>, case: &Case) -> Self {
        // What is wrong with the start is told by the first step, when there is a folder to dump it in.
        simulation.start().ok();
        let start = simulation.budget();
        let steepest = |a: &usize, b: &usize| case.gravity[*a].abs().total_cmp(&case.gravity[*b].abs());
        Self {
            start,
            sides: case.wall_sides(),
            ground: start.mass * lowest(case),
            up: (0..D).max_by(steepest).unwrap_or(1),
            simulation,
        }
    }

    fn mixture(&self) -> &Mixture<T, D, K> {
        self.simulation.mixture()
    }

    fn water(&self) -> &Phase<T, D, Water<T>> {
        self.mixture().water()
    }

    /// The particles that are not walls.
    fn inner(&self) -> core::ops::Range<usize> {
        self.water().wall_particles()..self.water().len()
    }

    fn front(&self) -> f64 {
        let water = self.water();
        let half = |i: usize| 0.5 * water.volume(i).as_f64().powf(1.0 / D as f64);
        self.inner().map(|i| water.positions()[i][0].as_f64() + half(i)).fold(f64::NEG_INFINITY, f64::max)
    }

    fn fastest(&self) -> f64 {
        self.inner().map(|i| self.water().velocities()[i].norm().as_f64()).fold(0.0, f64::max)
    }

    fn file(&self, fields: &[Field]) -> Result<Vtp, LengthError> {
        let water = self.water();
        let each = 0..water.len();
        let kind = |i| u8::from(i < water.wall_particles());
        let start = Vtp::new(self.simulation.time(), water.positions())
            .scalar("id", water.ids().iter().copied())?
            .scalar("kind", each.clone().map(kind))?;
        let add = |file: Vtp, field: &Field| {
            let name = field.to_string();
            match field {
                Field::Velocity => file.vector(&name, water.velocities().iter().copied()),
                Field::Pressure => file.scalar(&name, water.pressures().iter().copied()),
                Field::Density => file.scalar(&name, each.clone().map(|i| water.true_density(i))),
                Field::Mass => file.scalar(&name, water.masses().iter().copied()),
                Field::VolumeFraction => {
                    file.scalar(&name, (0..water.len()).map(|i| water.volume_fraction(i)))
                }
                Field::PartialDensity => file.scalar(&name, each.clone().map(|i| water.density(i))),
            }
        };
        fields.iter().try_fold(start, add)
    }
}

/// Lowest potential energy per mass in the boxes of a case \[J/kg\].
fn lowest(case: &Case) -> f64 {
    let blocks = case.water.blocks.iter().map(|block| (&block.low, &block.high));
    let boxes = case.tank.iter().map(|tank| (&tank.low, &tank.high)).chain(blocks);
    let at = |(low, high): (&Vec<f64>, &Vec<f64>)| -> f64 {
        (0..case.dimension).map(|k| (-case.gravity[k] * low[k]).min(-case.gravity[k] * high[k])).sum()
    };
    boxes.map(at).fold(f64::INFINITY, f64::min)
}

impl<T: Real + Component, const D: usize, K: Kernel<T, D>, I: Integrator<T>> Solver
    for Simulated<T, D, K, I>
{
    fn time(&self) -> f64 {
        self.simulation.time()
    }

    fn steps(&self) -> u64 {
        self.simulation.steps()
    }

    fn particles(&self) -> (usize, usize) {
        (self.inner().len(), self.water().wall_particles())
    }

    fn step(&mut self, until: f64) -> Result<Step, Stopped> {
        let step = self.simulation.step_at_most(until - self.simulation.time());
        step.map(|step| Step { length: step.length, limit: step.limit.name() })
            .map_err(|error| Stopped(error.to_string()))
    }

    fn quantities(&mut self) -> Vec<(String, f64)> {
        let budget = self.simulation.budget();
        let unit = if D == 2 { "N/m" } else { "N" };
        let mut all = vec![
            (quantity::FRONT.to_owned(), self.front()),
            ("max_speed [m/s]".to_owned(), self.fastest()),
            (quantity::KINETIC.to_owned(), budget.kinetic),
            (quantity::POTENTIAL.to_owned(), budget.potential - self.ground),
            (quantity::COMPRESSIVE.to_owned(), budget.compressive),
        ];
        let taken = |account: Account| format!("{}{} [J]", quantity::TAKEN, account.name());
        all.extend(Account::ALL.map(|account| (taken(account), budget.taken[account])));
        all.push((quantity::CLOSURE.to_owned(), budget.closure(&self.start)));
        let closure = budget.momentum_closure(&self.start);
        for (axis, momentum) in AXES.into_iter().zip(budget.momentum) {
            all.push((format!("momentum_{axis} [kg m/s]"), momentum));
        }
        for (axis, closure) in AXES.into_iter().zip(closure) {
            all.push((format!("impulse_closure_{axis} [kg m/s]"), closure));
        }
        for (n, side) in self.sides.iter().enumerate() {
            for (axis, force) in AXES.into_iter().zip(self.water().wall_force(n)) {
                all.push((format!("force_{axis}_on_wall_{side} [{unit}]"), force));
            }
        }
        all.push(("water_particles".to_owned(), self.inner().len() as f64));
        all
    }

    fn files(&mut self, fields: &[Field]) -> Vec<(&'static str, Vtp)> {
        // Every array is as long as the positions, so there is no error to pass on.
        self.file(fields).map(|file| ("water", file)).into_iter().collect()
    }

    fn gauge(&mut self, gauge: &Gauge) -> Vec<(&'static str, f64)> {
        let place = Vector::of(core::array::from_fn(|k| gauge.position[k]));
        match gauge.quantity {
            Quantity::Pressure => {
                let probe = self.mixture().probe(&place);
                vec![("pressure [Pa]", probe.pressure.as_f64()), ("support [-]", probe.support.as_f64())]
            }
            Quantity::Velocity => {
                let probe = self.mixture().probe(&place);
                let names = ["velocity_x [m/s]", "velocity_y [m/s]", "velocity_z [m/s]"];
                let values = probe.velocity.as_f64();
                let support = ("support [-]", probe.support.as_f64());
                names.into_iter().zip(values).chain([support]).collect()
            }
            Quantity::SurfaceElevation => {
                let surface = self.mixture().surface(&place, self.up);
                vec![("surface_elevation [m]", surface.map_or(f64::NAN, Real::as_f64))]
            }
        }
    }

    fn view(&mut self) -> View {
        let water = self.water();
        let place = |i: usize| {
            let x = water.positions()[i].as_f64();
            core::array::from_fn(|k| if k < D { x[k] } else { 0.0 })
        };
        let seen = |i: usize| Seen {
            place: place(i),
            pressure: water.pressures()[i].as_f64(),
            speed: water.velocities()[i].norm().as_f64(),
        };
        View {
            water: self.inner().map(seen).collect(),
            walls: (0..water.wall_particles()).map(place).collect(),
        }
    }

    fn dam_break(&self, reference: &Reference) -> DamBreak {
        let mixture = self.mixture();
        DamBreak {
            noise: dam_break::pressure_noise(mixture),
            leaked: dam_break::leaked(mixture),
            stuck: dam_break::stuck(mixture),
            velocity: reference.velocity_error(mixture),
        }
    }
}
