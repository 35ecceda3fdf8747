//! Particles of one or more constituents and the equations they obey.
//!
//! [`Mixture::evaluate`](crate::time::Evolve::evaluate) reads as the list of equations.

mod across;
mod artificial_stress;
mod between;
mod checks;
mod compressed;
mod constituent;
mod continuity;
mod corrected;
mod coupling;
mod drag;
mod drag_scheme;
mod evaluation;
mod evolve;
mod extrapolation;
mod fields;
mod filling;
mod hourglass;
#[cfg(feature = "implicit")]
mod implicit_drag;
mod ledger;
mod momentum;
mod numerics;
mod opening;
mod own_pairs;
mod phase;
mod pore;
mod probe;
mod projected_drag;
mod reconstructed_drag;
mod regularisation;
mod reinitialisation;
mod relaxation;
mod renormalised;
mod setting;
mod shared_pairs;
mod source;
mod state;
mod step_error;
mod strain_control;
mod stress;
mod summed_fraction;
mod velocity_gradient;
mod wall;
mod wall_contact;
mod wall_friction;
mod wall_normal;
mod wall_stress;

pub use artificial_stress::ArtificialStress;
pub use continuity::DensityDiffusion;
pub use coupling::CouplingForm;
pub use drag_scheme::DragScheme;
pub use hourglass::HourglassControl;
#[cfg(feature = "implicit")]
pub use implicit_drag::DragSolver;
pub use momentum::ArtificialViscosity;
pub use phase::Phase;
pub use probe::Probe;
pub use source::Source;
pub use state::MixtureState;
pub use step_error::{Culprit, StepError};
pub use summed_fraction::VolumeFraction;
pub use wall::{Slip, Wall, WallKind};
#[cfg(feature = "case")]
pub(crate) use {drag::RECONSTRUCTED_HASTE, phase::LEAST_PORES};

use crate::budget::{Account, Exchange, Works};
use crate::kernel::{Kernel, WendlandC2};
use crate::material::{Absent, DragLaw, Material, Water};
use crate::neighbours::CellList;
use crate::real::Real;
use crate::space::Vector;
use crate::summation::Neighbourhood;
use crate::time::{Evolve, Limits, Moment};
use constituent::{Constituent, Role};
use core::fmt;
use coupling::Coupling;
use relaxation::Relaxation;
use setting::Setting;
use std::sync::Arc;

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

/// A mixture in `D` dimensions at one instant: soil `S` and water `F`, of which one may be [`Absent`].
///
/// ```
/// use alluvium::{kernel::WendlandC2, material::Water, mixture::{Mixture, Phase}, setup, Vector};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let spacing = 0.01;
/// let mut water = Phase::new(Water::new(1000.0, 25.0)?);
/// water.add(&setup::fill([0.0, 0.0], [0.1, 0.2], spacing), spacing * spacing, |_| 0.0)?;
/// let mixture = Mixture::<f64, 2>::of_water(WendlandC2::new(1.3 * spacing)?, water)
///     .with_gravity(Vector([0.0, -9.81]));
/// assert_eq!(mixture.water().len(), 200);
/// # Ok(()) }
/// ```
pub struct Mixture<
    T: Real,
    const D: usize,
    K: Kernel<T, D> = WendlandC2<T, D>,
    S: Material<T> = Absent,
    F: Material<T> = Water<T>,
> {
    setting: Setting<T, D, K>,
    soil: Constituent<T, D, S>,
    water: Constituent<T, D, F>,
    coupling: Coupling<T, D>,
    #[cfg(feature = "implicit")]
    implicit_drag: implicit_drag::ImplicitDrag<T, D>,
    relaxation: Option<Relaxation<T>>,
    fraction: VolumeFraction,
    exchanged: [Exchange<D>; 2],
    /// Whether the water's volume fractions are those of its place.
    started: bool,
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> fmt::Debug
    for Mixture<T, D, K, S, F>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mixture")
            .field("time", &self.setting.time)
            .field("kernel", &self.setting.kernel)
            .field("soil_particles", &self.soil.phase.len())
            .field("water_particles", &self.water.phase.len())
            .finish_non_exhaustive()
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, Absent, F> {
    /// Water alone, with the default numerics: cell list, artificial viscosity 0.01 and 1, hydrostatic
    /// density diffusion 0.1, no gravity.
    pub fn of_water(kernel: K, water: Phase<T, D, F>) -> Self {
        Self::put_together(kernel, Phase::new(Absent), water)
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>> Mixture<T, D, K, S, Absent> {
    /// Soil alone, with the default numerics: cell list, artificial viscosity 0.1 and 1, no gravity.
    pub fn of_soil(kernel: K, soil: Phase<T, D, S>) -> Self {
        Self::put_together(kernel, soil, Phase::new(Absent))
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// Soil and water, of which one may have no particles. Where both have, they share their space: the
    /// water's volume fraction becomes what the soil leaves of it (68), at unchanged true density.
    pub fn new(kernel: K, soil: Phase<T, D, S>, water: Phase<T, D, F>) -> Self {
        Self::put_together(kernel, soil, water)
    }

    fn put_together(kernel: K, soil: Phase<T, D, S>, water: Phase<T, D, F>) -> Self {
        let support = kernel.support();
        let neighbourhood = Neighbourhood::new(Box::new(CellList::default()), support);
        Self {
            coupling: Coupling::new(Arc::new(kernel.clone()), neighbourhood),
            setting: Setting::new(kernel),
            #[cfg(feature = "implicit")]
            implicit_drag: implicit_drag::ImplicitDrag::default(),
            soil: Constituent::new(Role::Soil, soil, support),
            water: Constituent::new(Role::Water, water, support),
            relaxation: None,
            fraction: VolumeFraction::default(),
            exchanged: [Exchange::default(); 2],
            started: false,
        }
    }

    /// Whether soil and water share space.
    fn is_shared(&self) -> bool {
        !self.soil.phase.is_empty() && !self.water.phase.is_empty()
    }

    /// Leaves to the water what the soil leaves of its space (68), before the first evaluation.
    fn share_space(&mut self) {
        if !self.started && self.is_shared() {
            self.coupling.look(&self.setting, &mut self.soil, &self.water);
            self.water.phase.share(&self.coupling.pores.fraction);
        }
        self.started = true;
        self.water.shares_pressure = self.coupling.form == CouplingForm::PressureDifference;
    }

    /// The soil.
    pub fn soil(&self) -> &Phase<T, D, S> {
        &self.soil.phase
    }

    /// The soil, to change it from outside.
    pub fn soil_mut(&mut self) -> &mut Phase<T, D, S> {
        &mut self.soil.phase
    }

    /// The water.
    pub fn water(&self) -> &Phase<T, D, F> {
        &self.water.phase
    }

    /// The water, to change it from outside.
    pub fn water_mut(&mut self) -> &mut Phase<T, D, F> {
        &mut self.water.phase
    }

    /// The kernel.
    pub fn kernel(&self) -> &K {
        &self.setting.kernel
    }

    /// Which soil is near which.
    pub fn soil_neighbourhood(&self) -> &Neighbourhood<T, D> {
        &self.soil.neighbourhood
    }

    /// Which water is near which.
    pub fn water_neighbourhood(&self) -> &Neighbourhood<T, D> {
        &self.water.neighbourhood
    }

    /// Gravity \[m/s²\].
    pub fn gravity(&self) -> Vector<T, D> {
        self.setting.gravity
    }

    /// Time t \[s\].
    pub fn time(&self) -> f64 {
        self.setting.time
    }

    /// Limits of the time step \[s\], from the last evaluation.
    pub fn limits(&self) -> Limits<T> {
        let h = self.setting.kernel.smoothing_length();
        let own = self.soil.limits(h).shorter(self.water.limits(h));
        if !self.is_shared() {
            return own;
        }
        let drag = if self.coupling.drag.is_evaluated { self.coupling.drag.limit() } else { T::INFINITY };
        let pores = match self.coupling.form {
            CouplingForm::PressureDifference => {
                h.min(self.coupling.across.kernel.length()) * self.water.phase.least_fraction()
                    / self.water.phase.material().sound_speed()
            }
            CouplingForm::Printed => T::INFINITY,
        };
        Limits { drag, pores, ..own }
    }

    /// The law of drag between soil and water.
    pub fn drag_law(&self) -> &dyn DragLaw<T> {
        &*self.coupling.drag.law
    }

    /// Energy taken by each account per time \[W\] and force on the particles \[N\] at the last evaluation,
    /// without drag where that is solved over the step.
    pub fn exchange_rate(&self) -> Exchange<D> {
        self.soil.exchange_rate + self.water.exchange_rate
    }

    /// The same with what implicit drag does over a step of `dt` \[s\] from the fields `base`.
    fn rate_of_exchange(&self, base: Moment, dt: T) -> Exchange<D> {
        #[cfg(feature = "implicit")]
        return self.exchange_rate() + self.drag_exchange(base, dt);
        #[cfg(not(feature = "implicit"))]
        {
            let _ = (base, dt);
            self.exchange_rate()
        }
    }

    /// Books at the moment `target` what was exchanged, and returned by laws, since the moment `base`.
    fn book(&mut self, target: Moment, base: Moment, exchanged: Exchange<D>, returned: Works) {
        let mut exchanged = self.exchanged[base as usize] + exchanged;
        exchanged.taken = exchanged.taken + returned;
        self.exchanged[target as usize] = exchanged;
    }

    /// Bytes held in particle arrays, lists and buffers.
    pub fn bytes(&self) -> usize {
        self.soil.bytes() + self.water.bytes() + self.coupling.bytes()
    }

    /// Replaces stresses of the soil by their Shepard mean; the energy is booked.
    pub fn regularise_stress(&mut self) {
        let lost = self.soil.regularise_stress(&self.setting);
        for (exchanged, lost) in self.exchanged.iter_mut().zip(lost) {
            exchanged.taken[Account::Regularisation] += lost;
        }
    }

    /// Replaces densities of the water by their Shepard mean (70), on the true density; the energy is
    /// booked.
    pub fn reinitialise_density(&mut self) {
        let lost = self.water.reinitialise_density(&self.setting);
        for exchanged in &mut self.exchanged {
            exchanged.taken[Account::Reinitialisation] += lost;
        }
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Evolve<T>
    for Mixture<T, D, K, S, F>
{
    type Error = StepError;

    fn evaluate(&mut self) -> Result<(), StepError> {
        if !self.is_shared() {
            self.soil.evaluate(&self.setting)?;
            return self.water.evaluate(&self.setting);
        }
        if self.coupling.drag.is_projected && self.coupling.drag.is_reconstructed {
            return Err(StepError::ProjectedDragReconstructed);
        }
        self.soil.settle(&self.setting)?;
        self.water.settle(&self.setting)?;
        #[cfg(feature = "implicit")]
        self.implicit_drag.keep_before(&self.water.phase.rate.acceleration);
        self.share_space(); // (68)
        if self.fraction == VolumeFraction::Sum {
            self.sum_fractions(); // (68)
        }
        let setting = &self.setting;
        self.water.find_state(setting); // (16), (20)
        self.coupling.look(setting, &mut self.soil, &self.water); // (67)–(69)
        self.water.phase.share_inflows(&self.coupling.pores.fraction);
        self.soil.find_state(setting);
        self.soil.act_on_itself(setting); // (53), (55), own part
        self.water.act_on_itself(setting); // (52), (58), own part
        self.coupling.exchange(setting, &mut self.soil, &mut self.water); // (55), (58), (69)
        if let Some(relaxation) = self.relaxation.as_ref().filter(|_| self.water.shares_pressure) {
            self.water.relax_density(setting, relaxation);
        }
        self.soil.conclude(setting)?;
        self.water.conclude(setting)?;
        #[cfg(feature = "implicit")]
        self.implicit_drag
            .keep_without([&self.soil.phase.rate.acceleration, &self.water.phase.rate.acceleration]);
        Ok(())
    }

    #[cfg(feature = "implicit")]
    fn complete(&mut self, base: Moment, dt: T) -> Result<(), StepError> {
        self.complete_with_drag(base, dt)
    }

    fn advance(&mut self, target: Moment, base: Moment, dt: T) {
        let rate = self.rate_of_exchange(base, dt);
        let returned = self.soil.phase.advance(target, base, dt) + self.water.phase.advance(target, base, dt);
        self.book(target, base, rate * dt.as_f64(), returned);
    }

    fn leap(&mut self, kick: T, dt: T, slope: T) {
        let half = T::of(0.5) * dt;
        let rate = self.rate_of_exchange(Moment::Half, kick);
        let time = self.setting.time;
        let [soil, water] =
            [self.soil.phase.leap(kick, dt, slope, time), self.water.phase.leap(kick, dt, slope, time)];
        self.setting.time += dt.as_f64();
        self.book(Moment::Half, Moment::Half, rate * kick.as_f64(), soil[0] + water[0]);
        let rate = self.rate_of_exchange(Moment::Half, half);
        self.book(Moment::Now, Moment::Half, rate * half.as_f64(), soil[1] + water[1]);
    }

    fn drift(&mut self, moment: Moment, dt: T) {
        self.soil.phase.drift(moment, dt, self.setting.time);
        self.water.phase.drift(moment, dt, self.setting.time);
        self.setting.time += dt.as_f64();
    }
}
