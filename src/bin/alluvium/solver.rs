//! What the program asks of a simulation, whatever its precision and dimension.

use alluvium::case::{Field, Gauge};
use alluvium::output::Vtp;

/// One step that was taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Its length Δt \[s\].
    pub length: f64,
    /// What bounded it, as in `acoustic`, `viscous`, `force`, `fixed`, `output`.
    pub limit: &'static str,
}

/// A numerical failure: names particle, field, value, term and time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped(pub String);

/// Particles for a picture.
#[derive(Clone, Debug, Default)]
pub struct View {
    /// Where water particles are \[m\], and their pressure \[Pa\].
    pub water: Vec<([f64; 3], f64)>,
    /// Where wall particles are \[m\].
    pub walls: Vec<[f64; 3]>,
}

/// A simulation that can be stepped and looked at.
pub trait Solver {
    /// Where it is \[s\].
    fn time(&self) -> f64;

    /// Steps taken so far.
    fn steps(&self) -> u64;

    /// Particles of water and of walls.
    fn particles(&self) -> (usize, usize);

    /// One step that ends at `until` at the latest. After a failure the state is the one that failed, and
    /// can still be dumped.
    fn step(&mut self, until: f64) -> Result<Step, Stopped>;

    /// What is recorded in the history: always the same names, with units, as in `front [m]`, in the same
    /// order.
    fn quantities(&mut self) -> Vec<(&'static str, f64)>;

    /// The particles, one file per phase, with its name, as in `water`.
    fn files(&mut self, fields: &[Field]) -> Vec<(&'static str, Vtp)>;

    /// What a gauge measures: one column each, with unit.
    fn gauge(&mut self, gauge: &Gauge) -> Vec<(&'static str, f64)>;

    /// The particles for a picture.
    fn view(&mut self) -> View;
}

/// Names of recorded quantities that pictures are drawn from; a solver may record more.
pub mod quantity {
    /// Farthest place of the water along x.
    pub const FRONT: &str = "front [m]";
    /// Energies; per metre of depth in two dimensions.
    pub const KINETIC: &str = "kinetic_energy [J]";
    /// Above the energy of the lowest state the solver knows.
    pub const POTENTIAL: &str = "potential_energy [J]";
    /// Of compression.
    pub const COMPRESSIVE: &str = "compressive_energy [J]";
    /// Beginning of every column of energy that a term took, as in
    /// `dissipated_by_artificial_viscosity [J]`.
    pub const DISSIPATED: &str = "dissipated_by_";
}
