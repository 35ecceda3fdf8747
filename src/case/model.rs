//! What a case says, with every default resolved. SI units throughout.

mod drag;
mod mixing;
mod soil;

pub use drag::{Drag, Seepage};
pub use mixing::{Inflow, Mixing, Region};
pub use soil::{Frictional, Shape, Soil, SoilBody, Stiffness, Strength};
pub(super) use soil::{ROUNDING, upright};

use super::choice::{
    Axis, DiffusionKind, Field, InitialPressure, IntegratorChoice, KernelChoice, Precision, Quantity,
    SearchChoice, Side,
};
use crate::mixture::Slip;
use crate::preset::Preset;

/// A case of soil, of water or of both, complete: nothing in it is left to a default.
///
/// Coordinates are lists of [`Case::dimension`] numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Names the run and its folder.
    pub name: String,
    /// Where the defaults came from.
    pub preset: Preset,
    /// 2 or 3.
    pub dimension: usize,
    /// The numbers the run is computed in.
    pub precision: Precision,
    /// Threads; 0 means one per core.
    pub threads: usize,
    /// Where the run ends \[s\].
    pub end_time: f64,
    /// Gravity \[m/s²\].
    pub gravity: Vec<f64>,
    /// The soil, if there is any.
    pub soil: Option<Soil>,
    /// The water, if there is any.
    pub water: Option<Water>,
    /// What is between the two, if there are both.
    pub mixing: Option<Mixing>,
    /// The particles they are made of.
    pub particles: Particles,
    /// The tank around it, if there is one.
    pub tank: Option<Tank>,
    /// Boxes in which particles leave.
    pub outlets: Vec<Region>,
    /// The box a particle must not leave otherwise, if there is one.
    pub domain: Option<Region>,
    /// Directions in which the tank repeats instead of having walls.
    pub periodic: Vec<Axis>,
    /// Steps in time.
    pub time: Time,
    /// Neighbour search.
    pub neighbours: Neighbours,
    /// What is written, and when.
    pub output: Output,
    /// Gauges.
    pub gauges: Vec<Gauge>,
}

/// Water: its law, its dissipation, where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Water {
    /// Reference density ρ̃₀ \[kg/m³\].
    pub reference_density: f64,
    /// Speed of sound c \[m/s\].
    pub sound_speed: f64,
    /// Dynamic viscosity μ \[Pa s\].
    pub viscosity: f64,
    /// Exponent γ of the equation of state \[–\].
    pub tait_exponent: i32,
    /// Pressure at which it cavitates \[Pa\]; none where it bears any suction.
    pub cavitation_pressure: Option<f64>,
    /// Artificial viscosity, linear η₁ \[–\].
    pub artificial_viscosity_linear: f64,
    /// Artificial viscosity, quadratic η₂ \[–\].
    pub artificial_viscosity_quadratic: f64,
    /// What density diffusion acts on.
    pub diffusion: DiffusionKind,
    /// Coefficient δ of the density diffusion \[–\]; zero if there is none.
    pub diffusion_coefficient: f64,
    /// Steps between density reinitialisations (70); 0 is never.
    pub reinitialisation_every: u64,
    /// Where the water is at the start.
    pub blocks: Vec<Block>,
    /// Where water comes in.
    pub inflows: Vec<Inflow>,
}

/// A box of water at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Lowest corner \[m\].
    pub low: Vec<f64>,
    /// Highest corner \[m\].
    pub high: Vec<f64>,
    /// Velocity \[m/s\].
    pub velocity: Vec<f64>,
    /// Pressure at the start.
    pub initial_pressure: InitialPressure,
    /// Level of the surface under which pressure is hydrostatic, measured against gravity \[m\].
    pub surface: f64,
}

/// Size of particles and kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Particles {
    /// Initial spacing Δx \[m\].
    pub spacing: f64,
    /// Smoothing length over spacing, h/Δx \[–\].
    pub smoothing_ratio: f64,
    /// Kernel.
    pub kernel: KernelChoice,
    /// Whether gradients are made exact for linear fields.
    pub gradient_correction: bool,
    /// What is summed with between soil and water, where there are both.
    pub interphase: Option<InterphaseKernel>,
}

/// The kernel between soil and water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterphaseKernel {
    /// Smoothing length over spacing, h_c/Δx \[–\].
    pub smoothing_ratio: f64,
    /// Kernel.
    pub kernel: KernelChoice,
}

impl Particles {
    /// Largest support radius over spacing \[–\].
    pub fn support_ratio(&self) -> f64 {
        let own = self.kernel.support_ratio() * self.smoothing_ratio;
        let between = self.interphase.map_or(0.0, |it| it.kernel.support_ratio() * it.smoothing_ratio);
        own.max(between)
    }
}

/// A box with walls on its sides, outside the box.
#[derive(Clone, Debug, PartialEq)]
pub struct Tank {
    /// Lowest inner corner \[m\].
    pub low: Vec<f64>,
    /// Highest inner corner \[m\].
    pub high: Vec<f64>,
    /// Sides without a wall.
    pub open: Vec<Side>,
    /// How the walls are made.
    pub walls: Walls,
    /// Layers of wall particles.
    pub layers: u64,
    /// What water does along extrapolated walls, where there is soil too.
    pub water_slip: Option<Slip>,
    /// Boxes inside the tank whose sides are walls, inwards.
    pub obstacles: Vec<Region>,
    /// Walls that move.
    pub moving: Vec<MovingWall>,
}

/// How walls are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Walls {
    /// Dynamic particles.
    Dynamic,
    /// Extrapolated, with what soil or water does along them.
    Extrapolated(Slip),
}

/// A wall that moves at constant velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingWall {
    /// Which one.
    pub side: Side,
    /// Its velocity \[m/s\].
    pub velocity: Vec<f64>,
}

/// Steps in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    /// How time advances.
    pub integrator: IntegratorChoice,
    /// How long a step is.
    pub step: StepSize,
}

/// How long a step is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepSize {
    /// As every limit allows, times this Courant number \[–\].
    Courant(f64),
    /// Always this \[s\].
    Fixed(f64),
}

/// How neighbours are found.
#[derive(Clone, Debug, PartialEq)]
pub struct Neighbours {
    /// The method.
    pub search: SearchChoice,
    /// Thickness of the skin around the support, over the support radius \[–\].
    pub skin_ratio: f64,
}

/// What is written, and when.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Times of the particle dumps \[s\].
    pub dumps: Dumps,
    /// Between rows of the history \[s\]; 0 is every step.
    pub history_interval: f64,
    /// Arrays in the particle files.
    pub fields: Vec<Field>,
}

/// Times of the particle dumps.
#[derive(Clone, Debug, PartialEq)]
pub enum Dumps {
    /// At the start, after each interval \[s\] and at the end.
    Every(f64),
    /// At these times \[s\], ascending.
    At(Vec<f64>),
}

/// A point where something is recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Gauge {
    /// Names its file.
    pub name: String,
    /// Where \[m\].
    pub position: Vec<f64>,
    /// What is measured.
    pub quantity: Quantity,
}

impl Case {
    /// Smoothing length h \[m\].
    pub fn smoothing_length(&self) -> f64 {
        self.particles.smoothing_ratio * self.particles.spacing
    }

    /// Smoothing length h_c \[m\] between soil and water.
    pub fn interphase_smoothing_length(&self) -> f64 {
        let between = self.particles.interphase.map(|it| it.smoothing_ratio * self.particles.spacing);
        between.unwrap_or(self.smoothing_length())
    }

    /// Support radius κh \[m\], the larger of that within and that between soil and water.
    pub fn support(&self) -> f64 {
        self.particles.support_ratio() * self.particles.spacing
    }

    /// Speed of the fastest wave \[m/s\], which bounds the step.
    pub fn fastest_wave(&self) -> f64 {
        let water = self.water.as_ref().map_or(0.0, |water| water.sound_speed);
        self.soil.as_ref().map_or(water, |soil| soil.fastest_wave().max(water))
    }

    /// Number of water particles: each block filled with whole cells of one spacing.
    pub fn water_particles(&self) -> u64 {
        let cells = |block: &Block| block.cells(self.particles.spacing).product::<u64>();
        self.water.iter().flat_map(|water| &water.blocks).map(cells).sum()
    }

    /// Number of soil particles: each body filled with whole cells of one spacing.
    pub fn soil_particles(&self) -> u64 {
        let cells = |body: &SoilBody| body.shape.cells(self.particles.spacing);
        self.soil.iter().flat_map(|soil| &soil.bodies).map(cells).sum()
    }

    /// Lowest and highest corner of everything there is at the start \[m\]: each block, each body of soil.
    pub fn boxes(&self) -> Vec<(Vec<f64>, Vec<f64>)> {
        let blocks = self.water.iter().flat_map(|water| &water.blocks);
        let blocks = blocks.map(|block| (block.low.clone(), block.high.clone()));
        let bodies = self.soil.iter().flat_map(|soil| &soil.bodies);
        blocks.chain(bodies.map(|body| body.shape.bounds(&self.gravity))).collect()
    }

    /// The times of the dumps \[s\], ascending, the start and the end among them unless they are listed.
    pub fn dump_times(&self) -> Vec<f64> {
        match &self.output.dumps {
            Dumps::At(times) => times.clone(),
            Dumps::Every(interval) => {
                let count = (self.end_time / interval * (1.0 - 1e-9)).ceil() as u64;
                (0..count).map(|n| n as f64 * interval).chain([self.end_time]).collect()
            }
        }
    }
}

impl Block {
    /// Number of cells of one `spacing` along each axis.
    pub fn cells(&self, spacing: f64) -> impl Iterator<Item = u64> + '_ {
        cells(&self.low, &self.high, spacing)
    }
}

fn cells<'a>(low: &'a [f64], high: &'a [f64], spacing: f64) -> impl Iterator<Item = u64> + 'a {
    low.iter().zip(high).map(move |(low, high)| ((high - low) / spacing).round() as u64)
}
