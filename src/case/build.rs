//! From a case to particles and a simulation of them.

use super::choice::{DiffusionKind, InitialPressure, SearchChoice, Side, Slip};
use super::model::{Block, Case, StepSize, Tank, Walls};
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::{Absent, Water};
use crate::mixture::{self, ArtificialViscosity, DensityDiffusion, Mixture, Phase, Wall};
use crate::neighbours::{BruteForce, CellList, NeighbourSearch, Periodic};
use crate::real::Real;
use crate::setup;
use crate::simulation::Simulation;
use crate::space::Vector;
use crate::time::{self, Integrator};
use core::fmt;

type SearchMaker<T, const D: usize> = fn() -> Box<dyn NeighbourSearch<T, D>>;

/// Why a case could not be built.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum BuildError {
    /// The case has another dimension than the types it was to be built of.
    Dimension {
        /// The case's.
        case: usize,
        /// That of the types.
        asked: usize,
    },
    /// The search is not part of this build.
    Search(SearchChoice),
    /// A value the library refuses, perhaps because of rounding to single precision.
    Parameter(ParameterError),
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dimension { case, asked } => {
                write!(f, "the case has {case} dimensions, a simulation in {asked} was asked for")
            }
            Self::Search(search) => {
                write!(f, "this build has no search \"{search}\": it needs the feature of that name")
            }
            Self::Parameter(error) => write!(f, "{error}"),
        }
    }
}

impl core::error::Error for BuildError {}

impl From<ParameterError> for BuildError {
    fn from(error: ParameterError) -> Self {
        Self::Parameter(error)
    }
}

impl Case {
    /// The simulation this case describes, with a kernel and an integrator made by the caller: types are
    /// chosen where the program is compiled, so [`precision`](Self::precision),
    /// [`dimension`](Self::dimension), [`kernel`](super::Particles::kernel) and
    /// [`integrator`](super::Time::integrator) are the caller's to heed.
    ///
    /// ```
    /// use alluvium::{case::Case, kernel::WendlandC2, time::LeapFrog};
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let (case, _) = Case::parse("drop.toml", r#"
    ///     name = "drop"
    ///     end_time_s = 0.1
    ///     particles.spacing_m = 0.01
    ///     [[water.block]]
    ///     low_m = [0.0, 0.0]
    ///     high_m = [0.2, 0.2]
    /// "#)?;
    /// let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length())?;
    /// let mut run = case.simulation(kernel, LeapFrog::new())?;
    /// run.step()?;
    /// assert_eq!(run.mixture().water().len(), 400);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// The dimension is not the case's, or a part refuses its value.
    pub fn simulation<T: Real, const D: usize, K: Kernel<T, D>, I: Integrator<T>>(
        &self,
        kernel: K,
        integrator: I,
    ) -> Result<Simulation<T, D, K, Absent, Water<T>, I>, BuildError> {
        let mixture = self.mixture(kernel)?;
        let step_size = match self.time.step {
            StepSize::Courant(number) => time::StepSize::courant(T::of(number)),
            StepSize::Fixed(step) => time::StepSize::fixed(T::of(step)),
        }?;
        Ok(Simulation::new(mixture, integrator, step_size)
            .with_reinitialisation(self.water.reinitialisation_every as usize))
    }

    /// The particles of this case at the start, with its numerical choices.
    ///
    /// # Errors
    /// As for [`simulation`](Self::simulation).
    pub fn mixture<T: Real, const D: usize, K: Kernel<T, D>>(
        &self,
        kernel: K,
    ) -> Result<Mixture<T, D, K>, BuildError> {
        if self.dimension != D {
            return Err(BuildError::Dimension { case: self.dimension, asked: D });
        }
        let mut phase = Phase::new(self.law()?);
        if let Some(tank) = &self.tank {
            self.add_walls(tank, &mut phase)?;
        }
        for block in &self.water.blocks {
            self.add_block(block, &mut phase)?;
        }
        let water = &self.water;
        let viscosity = ArtificialViscosity {
            linear: T::of(water.artificial_viscosity_linear),
            quadratic: T::of(water.artificial_viscosity_quadratic),
        };
        let mixture = Mixture::of_water(kernel, phase)
            .with_gravity(vector(&self.gravity))
            .with_artificial_viscosity(viscosity)?
            .with_density_diffusion(self.diffusion())?
            .with_gradient_weight(self.preset.gradient_weight())
            .with_periodic(self.repetition()?)
            .with_skin(T::of(self.neighbours.skin_ratio * self.support()));
        Ok(mixture.with_search(self.search()?))
    }

    /// The sides of the tank that have a wall, in the order the walls have in
    /// [`Phase::walls`](crate::mixture::Phase::walls).
    pub fn wall_sides(&self) -> Vec<Side> {
        let Some(tank) = &self.tank else { return Vec::new() };
        let sides = super::Choice::ALL.iter().copied();
        sides.filter(|side: &Side| side.axis() < self.dimension && self.is_closed(tank, *side)).collect()
    }

    fn is_closed(&self, tank: &Tank, side: Side) -> bool {
        !tank.open.contains(&side) && !self.periodic.iter().any(|axis| *axis as usize == side.axis())
    }

    fn law<T: Real>(&self) -> Result<Water<T>, ParameterError> {
        let water = &self.water;
        Water::new(T::of(water.reference_density), T::of(water.sound_speed))?
            .with_viscosity(T::of(water.viscosity))?
            .with_exponent(water.tait_exponent)
    }

    fn diffusion<T: Real>(&self) -> DensityDiffusion<T> {
        let delta = T::of(self.water.diffusion_coefficient);
        match self.water.diffusion {
            DiffusionKind::None => DensityDiffusion::None,
            DiffusionKind::PartialDensity => DensityDiffusion::PartialDensity(delta),
            DiffusionKind::TrueDensity => DensityDiffusion::TrueDensity(delta),
            DiffusionKind::Hydrostatic => DensityDiffusion::Hydrostatic(delta),
            DiffusionKind::Renormalised => DensityDiffusion::Renormalised(delta),
        }
    }

    fn search<T: Real, const D: usize>(&self) -> Result<SearchMaker<T, D>, BuildError> {
        match self.neighbours.search {
            SearchChoice::CellList => Ok(|| Box::<CellList<T, D>>::default()),
            SearchChoice::BruteForce => Ok(|| Box::<BruteForce>::default()),
            #[cfg(feature = "kd-tree")]
            SearchChoice::KdTree => Ok(|| Box::<crate::neighbours::KdTree<T, D>>::default()),
            #[cfg(not(feature = "kd-tree"))]
            SearchChoice::KdTree => Err(BuildError::Search(SearchChoice::KdTree)),
        }
    }

    fn repetition<T: Real, const D: usize>(&self) -> Result<Periodic<T, D>, ParameterError> {
        let Some(tank) = &self.tank else { return Ok(Periodic::none()) };
        let repeats = |k: usize| self.periodic.iter().any(|axis| *axis as usize == k);
        let length = core::array::from_fn(|k| repeats(k).then(|| T::of(tank.high[k] - tank.low[k])));
        Periodic::new(vector(&tank.low), length)
    }

    fn volume<T: Real>(&self) -> T {
        T::of(self.particles.spacing.powi(self.dimension as i32))
    }

    fn add_block<T: Real, const D: usize>(
        &self,
        block: &Block,
        phase: &mut Phase<T, D, Water<T>>,
    ) -> Result<(), ParameterError> {
        let (low, high) = (array(&block.low), array(&block.high));
        let first = phase.len();
        let positions = setup::fill(low, high, self.particles.spacing);
        phase.add(&positions, self.volume(), |x| T::of(self.rest_pressure(block, x)))?;
        phase.velocities_mut()[first..].fill(vector(&block.velocity));
        Ok(())
    }

    /// The pressure \[Pa\] water of a block starts with at `x`.
    fn rest_pressure<T: Real, const D: usize>(&self, block: &Block, x: &Vector<T, D>) -> f64 {
        if block.initial_pressure == InitialPressure::Zero {
            return 0.0;
        }
        // ρ̃₀ g (surface − height), with the height measured against gravity.
        let strength = self.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        let fall: f64 = (0..D).map(|k| self.gravity[k] * x[k].as_f64()).sum();
        self.water.reference_density * (strength * block.surface + fall).max(0.0)
    }

    /// One wall for each closed side. What is outside several sides, as a corner is, belongs to the first
    /// that rests: a wall that moves would drag the corner through its neighbour.
    fn add_walls<T: Real, const D: usize>(
        &self,
        tank: &Tank,
        phase: &mut Phase<T, D, Water<T>>,
    ) -> Result<(), ParameterError> {
        let sides = self.wall_sides();
        let spacing = self.particles.spacing;
        let closed = core::array::from_fn(|k| {
            let has = |high| sides.iter().any(|side| side.axis() == k && side.is_high() == high);
            (has(false), has(true))
        });
        let (low, high) = (array::<D>(&tank.low), array::<D>(&tank.high));
        let all = setup::tank::<T, D>(low, high, spacing, tank.layers as usize, closed);
        let velocity = |side: Side| tank.moving.iter().find(|wall| wall.side == side);
        let is_outside = |x: &Vector<T, D>, side: Side| {
            let k = side.axis();
            let beyond = if side.is_high() {
                low[k] + ((high[k] - low[k]) / spacing).round() * spacing
            } else {
                low[k]
            };
            (x[k].as_f64() > beyond) == side.is_high()
        };
        let owner = |x: &Vector<T, D>| {
            let outside = || sides.iter().copied().filter(|side| is_outside(x, *side));
            outside().find(|side| velocity(*side).is_none()).or_else(|| outside().next())
        };
        for side in &sides {
            let own: Vec<Vector<T, D>> = all.iter().copied().filter(|x| owner(x) == Some(*side)).collect();
            let wall = velocity(*side).map_or_else(
                || wall(tank.walls),
                |moving| {
                    let velocity = vector(&moving.velocity);
                    wall(tank.walls).moving(move |_, _| velocity)
                },
            );
            phase.add_wall(wall, &own, self.volume(), |x| T::of(self.wall_pressure(x)))?;
        }
        Ok(())
    }

    /// A wall near a block carries its pressure from the start \[Pa\].
    fn wall_pressure<T: Real, const D: usize>(&self, x: &Vector<T, D>) -> f64 {
        let reach = self.support() + self.particles.spacing;
        let beside = |block: &&Block| {
            (0..D).all(|k| (block.low[k] - reach..=block.high[k] + reach).contains(&x[k].as_f64()))
        };
        let blocks = self.water.blocks.iter().filter(beside);
        blocks.map(|block| self.rest_pressure(block, x)).fold(0.0, f64::max)
    }
}

fn wall<T: Real, const D: usize>(walls: Walls) -> Wall<T, D> {
    match walls {
        Walls::Dynamic => Wall::dynamic(),
        Walls::Extrapolated(Slip::NoSlip) => Wall::extrapolated(mixture::Slip::NoSlip),
        Walls::Extrapolated(Slip::FreeSlip) => Wall::extrapolated(mixture::Slip::FreeSlip),
    }
}

fn array<const D: usize>(list: &[f64]) -> [f64; D] {
    core::array::from_fn(|k| list[k])
}

fn vector<T: Real, const D: usize>(list: &[f64]) -> Vector<T, D> {
    Vector::of(array(list))
}
