//! What the program asks of a simulation, whatever its precision and dimension.

use alluvium::case::{Field, Gauge};
use alluvium::output::Vtp;
use alluvium::verify::Parcel;
use alluvium::verify::dam_break::{Reference, VelocityError};
use alluvium::verify::sand_column::{Pile, Section};

/// One step that was taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Its length Δt \[s\].
    pub length: f64,
    /// What bounded it, as in `acoustic`, `viscous`, `force`, `fixed`, `end`.
    pub limit: &'static str,
}

/// A numerical failure: names particle, field, value, term and time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped(pub String);

/// A particle of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Where it is \[m\].
    pub place: [f64; 3],
    /// Its pressure \[Pa\].
    pub pressure: f64,
    /// Its speed \[m/s\].
    pub speed: f64,
    /// Its equivalent plastic strain \[-\]; 0 of water.
    pub equivalent_plastic_strain: f64,
}

/// Particles for a picture.
#[derive(Clone, Debug, Default)]
pub struct View {
    /// The soil.
    pub soil: Vec<Seen>,
    /// The water.
    pub water: Vec<Seen>,
    /// Where wall particles are \[m\].
    pub walls: Vec<[f64; 3]>,
}

/// A simulation that can be stepped and looked at.
pub trait Solver {
    /// Where it is \[s\].
    fn time(&self) -> f64;

    /// Steps taken so far.
    fn steps(&self) -> u64;

    /// Particles that move, of soil and water, and of walls.
    fn particles(&self) -> (usize, usize);

    /// One step that ends at `until` at the latest. After a failure the state is the one that failed, and
    /// can still be dumped.
    fn step(&mut self, until: f64) -> Result<Step, Stopped>;

    /// What is recorded in the history: always the same names, with units, as in `front [m]`, in the same
    /// order.
    fn quantities(&mut self) -> Vec<(String, f64)>;

    /// The particles, one file per phase there is, with its name, as in `water`.
    fn files(&mut self, fields: &[Field]) -> Vec<(&'static str, Vtp)>;

    /// What a gauge measures: one column each, with unit.
    fn gauge(&mut self, gauge: &Gauge) -> Vec<(&'static str, f64)>;

    /// The particles for a picture.
    fn view(&mut self) -> View;

    /// What is measured on a dam break, against a finite-volume solution of it.
    fn dam_break(&self, reference: &Reference) -> DamBreak;

    /// Soil and water as plain numbers; none unless a solver has both.
    fn parcels(&self) -> Parcels {
        Parcels::default()
    }

    /// The soil in a section, for what is measured on a column of sand; none unless a solver has soil.
    fn pile(&self, section: Section) -> Pile {
        Pile::new(section, 0.0, Vec::new())
    }
}

/// Soil and water of one instant.
#[derive(Clone, Debug, Default)]
pub struct Parcels {
    pub soil: Vec<Parcel>,
    pub water: Vec<Parcel>,
}

/// Measures of a dam break at one instant.
#[derive(Clone, Copy, Debug)]
pub struct DamBreak {
    /// Pressure noise over ρgH, and how many particles it is taken over.
    pub noise: (f64, usize),
    /// Particles that went through a wall.
    pub leaked: usize,
    /// Particles left hanging at the left wall.
    pub stuck: usize,
    /// Error of the horizontal velocity (78).
    pub velocity: VelocityError,
}

/// Recorded quantities that pictures are drawn from, and the units of all; a solver may record more.
pub mod quantity {
    use alluvium::output::{Table, TableError};

    /// Farthest place of the water along x, or of the soil where there is no water: the foremost particle and half its spacing.
    pub const FRONT: &str = "front [m]";
    /// Energies.
    pub const KINETIC: &str = "kinetic_energy";
    /// Above the energy of the lowest state the solver knows.
    pub const POTENTIAL: &str = "potential_energy";
    /// Of compression.
    pub const COMPRESSIVE: &str = "compressive_energy";
    /// Of the soil's skeleton.
    pub const ELASTIC: &str = "elastic_energy";
    /// Beginning of every column of energy that a term took, as in `taken_by_artificial_viscosity`; negative
    /// if it gave.
    pub const TAKEN: &str = "taken_by_";
    /// Energy the jet and other inflows took, which is less than none.
    pub const INFLOW: &str = "taken_by_inflow";
    /// Energy no account explains.
    pub const CLOSURE: &str = "energy_closure";

    /// The unit of what grows with the size of a body, energy, force or momentum: in two dimensions all is of
    /// one metre of depth.
    pub fn unit(unit: &str, dimension: usize) -> String {
        if dimension == 2 { format!("{unit}/m") } else { unit.to_owned() }
    }

    /// The head of a column of such a quantity, as in `kinetic_energy [J/m]`.
    pub fn head(name: &str, of: &str, dimension: usize) -> String {
        format!("{name} [{}]", unit(of, dimension))
    }

    /// A column's name without its unit.
    pub fn name(head: &str) -> &str {
        head.split(" [").next().unwrap_or(head)
    }

    /// The numbers of a column, found by its name without unit.
    pub fn column(history: &Table, wanted: &str) -> Result<Vec<f64>, TableError> {
        let heads = history.columns();
        let head = heads.iter().find(|head| name(head) == wanted);
        history.column(head.map_or(wanted, String::as_str))
    }
}
