//! A simulation of the library as the program sees it.

mod constituent;

use crate::solver::{DamBreak, Parcels, Solver, Step, Stopped, View, quantity};
use alluvium::budget::{Account, Budget};
use alluvium::case::{Case, CaseSimulation, Field, Gauge, Quantity, Side, SoilLaw};
use alluvium::kernel::Kernel;
use alluvium::material::Water;
use alluvium::mixture::{Mixture, Phase, Probe};
use alluvium::output::{Component, Vtp};
use alluvium::time::Integrator;
use alluvium::verify::Parcel;
use alluvium::verify::dam_break::{self, Reference};
use alluvium::verify::sand_column::{Pile, Section};
use alluvium::{Real, Vector};
use constituent::{fastest, file, front, inner, mass, place, seen};

const AXES: [&str; 3] = ["x", "y", "z"];

/// A simulation and what its records are measured against.
pub struct Simulated<T: Real, const D: usize, K: Kernel<T, D>, I: Integrator<T>> {
    simulation: CaseSimulation<T, D, K, I>,
    start: Budget<D>,
    /// The wall on each side, in the library's order.
    sides: Vec<Side>,
    /// The lowest potential energy the particles could have in the case's boxes \[J\].
    ground: f64,
    up: usize,
}

impl<T: Real + Component, const D: usize, K: Kernel<T, D>, I: Integrator<T>> Simulated<T, D, K, I> {
    pub fn new(mut simulation: CaseSimulation<T, D, K, I>, case: &Case) -> Self {
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

    fn mixture(&self) -> &Mixture<T, D, K, SoilLaw<T>> {
        self.simulation.mixture()
    }

    fn soil(&self) -> &Phase<T, D, SoilLaw<T>> {
        self.mixture().soil()
    }

    fn water(&self) -> &Phase<T, D, Water<T>> {
        self.mixture().water()
    }

    /// The front of the water, or of the soil where there is no water \[m\].
    fn front(&self) -> f64 {
        if self.water().is_empty() { front(self.soil()) } else { front(self.water()) }
    }

    /// What both constituents exert on a wall \[N\].
    fn wall_force(&self, wall: usize) -> [f64; D] {
        let (soil, water) = (self.soil().wall_force(wall), self.water().wall_force(wall));
        core::array::from_fn(|k| soil[k] + water[k])
    }

    /// Means around a place: of the water, or of the soil where there is no water.
    fn probe(&self, place: &Vector<T, D>) -> Probe<T, D> {
        let mixture = self.mixture();
        if self.water().is_empty() { mixture.probe_soil(place) } else { mixture.probe(place) }
    }
}

/// Lowest potential energy per mass in the boxes of a case \[J/kg\].
fn lowest(case: &Case) -> f64 {
    let tank = case.tank.iter().map(|tank| (tank.low.clone(), tank.high.clone()));
    let at = |(low, high): (Vec<f64>, Vec<f64>)| -> f64 {
        (0..case.dimension).map(|k| (-case.gravity[k] * low[k]).min(-case.gravity[k] * high[k])).sum()
    };
    tank.chain(case.boxes()).map(at).fold(f64::INFINITY, f64::min)
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
        let (soil, water) = (self.soil(), self.water());
        (inner(soil).len() + inner(water).len(), soil.wall_particles() + water.wall_particles())
    }

    fn step(&mut self, until: f64) -> Result<Step, Stopped> {
        let step = self.simulation.step_at_most(until - self.simulation.time());
        step.map(|step| Step { length: step.length, limit: step.limit.name() })
            .map_err(|error| Stopped(error.to_string()))
    }

    fn quantities(&mut self) -> Vec<(String, f64)> {
        let budget = self.simulation.budget();
        let energy = |name: &str| quantity::head(name, "J", D);
        let mut all = vec![
            (quantity::FRONT.to_owned(), self.front()),
            ("max_speed [m/s]".to_owned(), fastest(self.soil()).max(fastest(self.water()))),
            (energy(quantity::KINETIC), budget.kinetic),
            (energy(quantity::POTENTIAL), budget.potential - self.ground),
            (energy(quantity::COMPRESSIVE), budget.compressive),
            (energy(quantity::ELASTIC), budget.elastic),
        ];
        let taken = |account: Account| energy(&format!("{}{}", quantity::TAKEN, account.name()));
        all.extend(Account::ALL.map(|account| (taken(account), budget.taken[account])));
        all.push((energy(quantity::CLOSURE), budget.closure(&self.start)));
        let closure = budget.momentum_closure(&self.start);
        for (axis, momentum) in AXES.into_iter().zip(budget.momentum) {
            all.push((quantity::head(&format!("momentum_{axis}"), "N s", D), momentum));
        }
        for (axis, closure) in AXES.into_iter().zip(closure) {
            all.push((quantity::head(&format!("impulse_closure_{axis}"), "N s", D), closure));
        }
        for (n, side) in self.sides.iter().enumerate() {
            for (axis, force) in AXES.into_iter().zip(self.wall_force(n)) {
                all.push((quantity::head(&format!("force_{axis}_on_wall_{side}"), "N", D), force));
            }
        }
        all.push((quantity::head("angular_momentum_xy", "N m s", D), budget.angular_momentum[2]));
        if D == 3 {
            all.push((quantity::head("angular_momentum_yz", "N m s", D), budget.angular_momentum[0]));
            all.push((quantity::head("angular_momentum_zx", "N m s", D), budget.angular_momentum[1]));
        }
        all.push((quantity::head("buoyancy_work", "J", D), budget.buoyancy));
        all.push((quantity::head("soil_mass", "kg", D), mass(self.soil())));
        all.push((quantity::head("water_mass", "kg", D), mass(self.water())));
        all.push((quantity::head("mass_closure", "kg", D), budget.mass_closure(&self.start)));
        all.push(("soil_particles".to_owned(), inner(self.soil()).len() as f64));
        all.push(("water_particles".to_owned(), inner(self.water()).len() as f64));
        all
    }

    fn files(&mut self, fields: &[Field]) -> Vec<(&'static str, Vtp)> {
        let (time, soil, water) = (self.time(), self.soil(), self.water());
        // Every array is as long as the positions, so there is no error to pass on.
        let soil = (!soil.is_empty()).then(|| file(time, soil, fields).ok()).flatten();
        let water = (!water.is_empty()).then(|| file(time, water, fields).ok()).flatten();
        let named = [("soil", soil), ("water", water)].into_iter();
        named.filter_map(|(name, file)| Some((name, file?))).collect()
    }

    fn gauge(&mut self, gauge: &Gauge) -> Vec<(&'static str, f64)> {
        let place = Vector::of(core::array::from_fn(|k| gauge.position[k]));
        match gauge.quantity {
            Quantity::Pressure => {
                let probe = self.probe(&place);
                vec![("pressure [Pa]", probe.pressure.as_f64()), ("support [-]", probe.support.as_f64())]
            }
            Quantity::Velocity => {
                let probe = self.probe(&place);
                let names = ["velocity_x [m/s]", "velocity_y [m/s]", "velocity_z [m/s]"];
                let values = probe.velocity.as_f64();
                let support = ("support [-]", probe.support.as_f64());
                names.into_iter().zip(values).chain([support]).collect()
            }
            Quantity::SurfaceElevation => {
                let (mixture, up) = (self.mixture(), self.up);
                let surface = match self.water().is_empty() {
                    true => mixture.soil_surface(&place, up),
                    false => mixture.surface(&place, up),
                };
                vec![("surface_elevation [m]", surface.map_or(f64::NAN, Real::as_f64))]
            }
        }
    }

    fn view(&mut self) -> View {
        let (soil, water) = (self.soil(), self.water());
        let soil_walls = soil.positions()[..soil.wall_particles()].iter();
        let water_walls = water.positions()[..water.wall_particles()].iter();
        View {
            soil: seen(soil),
            water: seen(water),
            walls: soil_walls.chain(water_walls).map(|x| place(*x)).collect(),
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

    fn parcels(&self) -> Parcels {
        Parcels { soil: Parcel::of(self.soil()), water: Parcel::of(self.water()) }
    }

    fn pile(&self, section: Section) -> Pile {
        Pile::of(self.mixture(), section)
    }
}
