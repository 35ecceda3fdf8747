//! From a case to particles and a simulation of them.

mod mixing;
mod soil;
mod walls;
mod water;

pub(super) use soil::at_rest;

use super::choice::{SearchChoice, Side};
use super::model::{Case, StepSize, Tank};
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::{AnySurface, Soil, Water};
use crate::mixture::{DragScheme, Mixture};
use crate::neighbours::{BruteForce, CellList, NeighbourSearch, Periodic};
use crate::real::Real;
use crate::simulation::Simulation;
use crate::space::Vector;
use crate::time::{self, Integrator};
use core::fmt;

/// The law of a case's soil: one type whatever its yield surface, and also where there is no soil.
pub type SoilLaw<T> = Soil<T, AnySurface<T>>;

/// The simulation of a case.
pub type CaseSimulation<T, const D: usize, K, I> = Simulation<T, D, K, SoilLaw<T>, Water<T>, I>;

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
    /// Implicit drag is not part of this build.
    DragScheme(DragScheme),
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
            Self::DragScheme(scheme) => {
                write!(f, "this build has no drag scheme \"{scheme}\": it needs the feature `implicit`")
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
    ) -> Result<CaseSimulation<T, D, K, I>, BuildError> {
        let mixture = self.mixture(kernel)?;
        let step_size = match self.time.step {
            StepSize::Courant(number) => time::StepSize::courant(T::of(number)),
            StepSize::Fixed(step) => time::StepSize::fixed(T::of(step)),
        }?;
        let reinitialise = self.water.as_ref().map_or(0, |water| water.reinitialisation_every);
        let regularise = self.soil.as_ref().map_or(0, |soil| soil.regularisation_every);
        Ok(Simulation::new(mixture, integrator, step_size)
            .with_reinitialisation(reinitialise as usize)
            .with_stress_regularisation(regularise as usize))
    }

    /// The particles of this case at the start, with its numerical choices.
    ///
    /// # Errors
    /// As for [`simulation`](Self::simulation).
    pub fn mixture<T: Real, const D: usize, K: Kernel<T, D>>(
        &self,
        kernel: K,
    ) -> Result<Mixture<T, D, K, SoilLaw<T>>, BuildError> {
        if self.dimension != D {
            return Err(BuildError::Dimension { case: self.dimension, asked: D });
        }
        let mut mixture = Mixture::new(kernel, self.soil_phase()?, self.water_phase()?);
        if let Some(soil) = &self.soil {
            mixture = soil.apply(mixture, self.particles.spacing)?;
        }
        if let Some(water) = &self.water {
            mixture = water.apply(mixture)?;
        }
        if let (Some(mixing), Some(water)) = (&self.mixing, &self.water) {
            mixture = mixing.apply(mixture, self, water)?;
        }
        for outlet in &self.outlets {
            mixture = mixture.with_outlet(array(&outlet.low), array(&outlet.high))?;
        }
        if let Some(domain) = &self.domain {
            mixture = mixture.with_domain(array(&domain.low), array(&domain.high))?;
        }
        if self.particles.gradient_correction {
            mixture = mixture.with_gradient_correction();
        }
        let mixture = mixture
            .with_gravity(vector(&self.gravity))
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

    /// Gravity times the depth of `x` under a level measured against gravity \[m²/s²\]; 0 above it.
    fn fall<T: Real, const D: usize>(&self, surface: f64, x: &Vector<T, D>) -> f64 {
        let strength = self.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        let fall: f64 = (0..D).map(|k| self.gravity[k] * x[k].as_f64()).sum();
        (strength * surface + fall).max(0.0)
    }

    /// Whether `x` is in a box, or so near that a wall there belongs to it.
    fn is_beside<T: Real, const D: usize>(&self, low: &[f64], high: &[f64], x: &Vector<T, D>) -> bool {
        let reach = self.support() + self.particles.spacing;
        (0..D).all(|k| (low[k] - reach..=high[k] + reach).contains(&x[k].as_f64()))
    }
}

fn array<const D: usize>(list: &[f64]) -> [f64; D] {
    core::array::from_fn(|k| list[k])
}

fn vector<T: Real, const D: usize>(list: &[f64]) -> Vector<T, D> {
    Vector::of(array(list))
}
