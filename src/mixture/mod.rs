//! Particles of one or more constituents and the equations they obey.
//!
//! [`Mixture::evaluate`](crate::time::Evolve::evaluate) reads as the list of equations.

mod checks;
mod continuity;
mod evaluation;
mod evolve;
mod extrapolation;
mod filling;
mod ledger;
mod momentum;
mod own_pairs;
mod phase;
mod probe;
mod reinitialisation;
mod renormalised;
mod state;
mod strain_control;
mod stress;
mod velocity_gradient;
mod wall;
mod wall_friction;

pub use checks::{Culprit, StepError};
pub use continuity::DensityDiffusion;
pub use momentum::ArtificialViscosity;
pub use phase::Phase;
pub use probe::Probe;
pub use state::MixtureState;
pub use wall::{Slip, Wall, WallKind};

use crate::budget::{Account, Exchange};
use crate::error::ParameterError;
use crate::kernel::{Kernel, WendlandC2};
use crate::lanes::InstructionSet;
use crate::material::{Material, Water};
use crate::neighbours::{CellList, NeighbourSearch, Periodic};
use crate::real::Real;
use crate::space::Vector;
use crate::summation::{Aligned, Neighbourhood, Sums};
use crate::time::{Evolve, Limits, Moment};
use core::fmt;
use std::sync::Arc;

type Field<T, const D: usize, V> = Arc<dyn Fn(&Vector<T, D>, f64) -> V + Send + Sync>;

/// A body force per mass, with its potential if it has one.
#[derive(Clone)]
struct BodyForce<T, const D: usize> {
    acceleration: Field<T, D, Vector<T, D>>,
    potential: Option<Field<T, D, f64>>,
}

/// Weight of a neighbour in the velocity gradient (62), (65).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum GradientWeight {
    /// `m_j/ρ_i`: conjugate to the stress sums, so that energy closes exactly.
    #[default]
    Conjugate,
    /// `m_j/ρ_j`, as printed.
    Printed,
}

/// A mixture in `D` dimensions at one instant.
///
/// ```
/// use alluvium::{kernel::WendlandC2, material::Water, mixture::{Mixture, Phase}, setup, Vector};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let spacing = 0.01;
/// let mut water = Phase::new(Water::new(1000.0, 25.0)?);
/// water.add(&setup::fill([0.0, 0.0], [0.1, 0.2], spacing), spacing * spacing, |_| 0.0)?;
/// let mixture = Mixture::<f64, 2>::new(WendlandC2::new(1.3 * spacing)?, water)
///     .with_gravity(Vector([0.0, -9.81]));
/// assert_eq!(mixture.water().len(), 200);
/// # Ok(()) }
/// ```
pub struct Mixture<T: Real, const D: usize, K: Kernel<T, D> = WendlandC2<T, D>, F: Material<T> = Water<T>> {
    kernel: K,
    water: Phase<T, D, F>,
    neighbourhood: Neighbourhood<T, D>,
    gravity: Vector<T, D>,
    force: Option<BodyForce<T, D>>,
    viscosity: ArtificialViscosity<T>,
    diffusion: DensityDiffusion<T>,
    gradient_weight: GradientWeight,
    strain_control: T,
    time: f64,
    exchanged: [Exchange<D>; 2],
    /// Exchange per time, at the last evaluation.
    exchange_rate: Exchange<D>,
    fastest_acceleration: T,
    scratch: Scratch<T, D>,
}

/// Buffers that live from one evaluation to the next.
#[derive(Default)]
struct Scratch<T: Real, const D: usize> {
    records: Aligned<T>,
    sums: Sums<T>,
    extra: Sums<T>,
    /// The velocity viscosity sees at each wall particle \[m/s\]; empty where no wall extrapolates.
    wall_velocity: Vec<Vector<T, D>>,
    /// ∇v by rows \[1/s\]; empty without strain control.
    velocity_gradient: Vec<[Vector<T, D>; D]>,
}

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> fmt::Debug for Mixture<T, D, K, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mixture")
            .field("time", &self.time)
            .field("kernel", &self.kernel)
            .field("water_particles", &self.water.len())
            .finish_non_exhaustive()
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    /// Water alone, with the default numerics: cell list, artificial viscosity 0.01 and 1, hydrostatic
    /// density diffusion 0.1, no gravity.
    pub fn new(kernel: K, water: Phase<T, D, F>) -> Self {
        let neighbourhood = Neighbourhood::new(Box::new(CellList::default()), kernel.support());
        Self {
            kernel,
            water,
            neighbourhood,
            gravity: Vector::zero(),
            force: None,
            viscosity: ArtificialViscosity { linear: T::of(0.01), quadratic: T::ONE },
            diffusion: DensityDiffusion::Hydrostatic(T::of(0.1)),
            gradient_weight: GradientWeight::default(),
            strain_control: T::ZERO,
            time: 0.0,
            exchanged: [Exchange::default(); 2],
            exchange_rate: Exchange::default(),
            fastest_acceleration: T::ZERO,
            scratch: Scratch::default(),
        }
    }

    /// Gravity g \[m/s²\].
    pub fn with_gravity(mut self, gravity: Vector<T, D>) -> Self {
        self.gravity = gravity;
        self
    }

    /// A body force per mass, `acceleration(x, t)` \[m/s²\], beside gravity; its work is booked as
    /// external. Extrapolated walls and hydrostatic diffusion know gravity alone: use
    /// [`with_gravity`](Self::with_gravity) for what presses the water against a wall.
    pub fn with_force(
        mut self,
        acceleration: impl Fn(&Vector<T, D>, f64) -> Vector<T, D> + Send + Sync + 'static,
    ) -> Self {
        self.force = Some(BodyForce { acceleration: Arc::new(acceleration), potential: None });
        self
    }

    /// A body force per mass with the potential `potential(x, t)` \[J/kg\] it derives from. The ledger
    /// closes if the potential does not change in time.
    pub fn with_conservative_force(
        mut self,
        acceleration: impl Fn(&Vector<T, D>, f64) -> Vector<T, D> + Send + Sync + 'static,
        potential: impl Fn(&Vector<T, D>, f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        self.force =
            Some(BodyForce { acceleration: Arc::new(acceleration), potential: Some(Arc::new(potential)) });
        self
    }

    /// Artificial viscosity (59).
    ///
    /// # Errors
    /// A factor is negative or not finite.
    pub fn with_artificial_viscosity(
        mut self,
        factors: ArtificialViscosity<T>,
    ) -> Result<Self, ParameterError> {
        for (name, value) in [
            ("artificial_viscosity.linear", factors.linear),
            ("artificial_viscosity.quadratic", factors.quadratic),
        ] {
            if !(value >= T::ZERO && value.is_finite()) {
                return Err(ParameterError::new(name, value, "zero or positive"));
            }
        }
        self.viscosity = factors;
        Ok(self)
    }

    /// Density diffusion (52), (54).
    ///
    /// # Errors
    /// The coefficient is not in [0, 1].
    pub fn with_density_diffusion(mut self, diffusion: DensityDiffusion<T>) -> Result<Self, ParameterError> {
        let delta = diffusion.coefficient();
        if !(delta >= T::ZERO && delta <= T::ONE) {
            return Err(ParameterError::new("density_diffusion", delta, "from 0 to 1"));
        }
        self.diffusion = diffusion;
        Ok(self)
    }

    /// Weight of a neighbour in the velocity gradient.
    pub fn with_gradient_weight(mut self, weight: GradientWeight) -> Self {
        self.gradient_weight = weight;
        self
    }

    /// Viscosity of motion that the velocity gradient (62) does not see, of strength ξ \[-\]; 0, the
    /// default, is none, 1 is as viscous as the gradient's own.
    ///
    /// The gradient of a velocity that alternates from particle to particle is zero, so (58) with (62)
    /// neither damps it nor holds it at a wall: flows in which viscosity leads need the control.
    ///
    /// # Errors
    /// The strength is not in [0, 2].
    pub fn with_strain_control(mut self, strength: T) -> Result<Self, ParameterError> {
        if !(strength >= T::ZERO && strength <= T::of(2.0)) {
            return Err(ParameterError::new("strain_control", strength, "from 0 to 2"));
        }
        self.strain_control = strength;
        Ok(self)
    }

    /// Another neighbour search; results do not depend on it.
    pub fn with_search(mut self, search: Box<dyn NeighbourSearch<T, D>>) -> Self {
        let old = &self.neighbourhood;
        self.neighbourhood = Neighbourhood::new(search, self.kernel.support())
            .with_skin(old.skin())
            .with_periodic(*old.periodic())
            .with_instruction_set(old.instruction_set());
        self
    }

    /// Lists neighbours this much beyond the support \[m\]: a matter of speed, and of the moments at which
    /// particles are re-sorted.
    pub fn with_skin(mut self, skin: T) -> Self {
        self.neighbourhood = self.neighbourhood.with_skin(skin);
        self
    }

    /// Lets space repeat itself.
    pub fn with_periodic(mut self, periodic: Periodic<T, D>) -> Self {
        self.neighbourhood = self.neighbourhood.with_periodic(periodic);
        self
    }

    /// Uses these instructions; results do not depend on them.
    pub fn with_instruction_set(mut self, set: InstructionSet) -> Self {
        self.neighbourhood = self.neighbourhood.with_instruction_set(set);
        self
    }

    /// The water.
    pub fn water(&self) -> &Phase<T, D, F> {
        &self.water
    }

    /// The water, to change it from outside.
    pub fn water_mut(&mut self) -> &mut Phase<T, D, F> {
        &mut self.water
    }

    /// The kernel.
    pub fn kernel(&self) -> &K {
        &self.kernel
    }

    /// Who is near whom.
    pub fn neighbourhood(&self) -> &Neighbourhood<T, D> {
        &self.neighbourhood
    }

    /// Gravity \[m/s²\].
    pub fn gravity(&self) -> Vector<T, D> {
        self.gravity
    }

    /// Time t \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Limits of the time step \[s\], from the last evaluation.
    pub fn limits(&self) -> Limits<T> {
        let h = self.kernel.smoothing_length();
        let nu = self.water.material().kinematic_viscosity();
        let a = self.fastest_acceleration;
        let or_infinite = |positive: bool, limit: T| if positive { limit } else { T::INFINITY };
        Limits {
            acoustic: h / self.water.material().sound_speed(),
            viscous: or_infinite(nu > T::ZERO, T::of(0.125) * h * h / nu),
            force: or_infinite(a > T::ZERO, T::of(0.25) * (h / a).sqrt()),
        }
    }

    /// Energy taken by each account per time \[W\] and force on the particles \[N\] at the last evaluation.
    pub fn exchange_rate(&self) -> &Exchange<D> {
        &self.exchange_rate
    }

    /// Bytes held in particle arrays, lists and buffers.
    pub fn bytes(&self) -> usize {
        let scratch = &self.scratch;
        self.water.bytes()
            + self.neighbourhood.bytes()
            + scratch.records.bytes()
            + scratch.sums.bytes()
            + scratch.extra.bytes()
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Evolve<T> for Mixture<T, D, K, F> {
    type Error = StepError;

    fn evaluate(&mut self) -> Result<(), StepError> {
        self.check_fields()?;
        self.find_neighbours();
        self.find_pressure(); // (16), (20)
        self.extrapolate_walls();
        self.find_stress(); // (62), (14), (15)
        self.sum_own_pairs(); // (52), (58)
        self.add_renormalised_diffusion(); // (52), second sum, in the form of Antuono et al.
        self.add_strain_control();
        self.add_body_forces();
        self.check_rates()
    }

    fn advance(&mut self, target: Moment, base: Moment, dt: T) {
        let returned = self.water.advance(target, base, dt);
        let mut exchanged = self.exchanged[base as usize] + self.exchange_rate * dt.as_f64();
        exchanged.taken[Account::Admission] += returned;
        self.exchanged[target as usize] = exchanged;
    }

    fn drift(&mut self, moment: Moment, dt: T) {
        self.water.drift(moment, dt, self.time);
        self.time += dt.as_f64();
    }
}
