//! The driver: a mixture, an integrator and a step size, and who looks on.

use crate::budget::Budget;
use crate::kernel::{Kernel, WendlandC2};
use crate::material::{Absent, Material, Water};
use crate::mixture::{Mixture, StepError};
use crate::real::Real;
use crate::time::{Evolve, Integrator, LeapFrog, Limit, Limits, StepSize};
use core::ops::ControlFlow;

/// A run.
///
/// ```
/// use alluvium::{kernel::WendlandC2, material::Water, mixture::{Mixture, Phase}, setup, Vector};
/// use alluvium::{simulation::Simulation, time::{LeapFrog, StepSize}};
/// use std::ops::ControlFlow;
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let spacing = 0.01;
/// let mut water = Phase::new(Water::new(1000.0, 25.0)?);
/// water.add(&setup::fill([0.0, 0.0], [0.1, 0.1], spacing), spacing * spacing, |_| 0.0)?;
/// let mixture = Mixture::<f64, 2>::of_water(WendlandC2::new(1.3 * spacing)?, water)
///     .with_gravity(Vector([0.0, -9.81]));
/// let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(0.2)?);
/// let _ = run.run_until(0.01, |_| ControlFlow::Continue(()))?;
/// let now = run.budget();
/// assert!((now.momentum[1] / now.mass + 0.0981).abs() < 1e-9);
/// # Ok(()) }
/// ```
#[derive(Debug)]
pub struct Simulation<
    T: Real,
    const D: usize,
    K: Kernel<T, D> = WendlandC2<T, D>,
    S: Material<T> = Absent,
    F: Material<T> = Water<T>,
    I: Integrator<T> = LeapFrog<T>,
> {
    pub(crate) mixture: Mixture<T, D, K, S, F>,
    pub(crate) integrator: I,
    step_size: StepSize<T>,
    reinitialise_every: usize,
    regularise_every: usize,
    pub(crate) steps: u64,
    pub(crate) last: Step,
    pub(crate) started: bool,
}

/// A step that would leave less than this part of itself to go takes it along: rounding of the time
/// must not make a step of almost nothing.
const CRUMB: f64 = 1e-6;

/// One step that has been done.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Step {
    /// Its length \[s\].
    pub length: f64,
    /// What limited it.
    pub limit: Limit,
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>, I: Integrator<T>>
    Simulation<T, D, K, S, F, I>
{
    /// A run at the time of the mixture.
    pub fn new(mixture: Mixture<T, D, K, S, F>, integrator: I, step_size: StepSize<T>) -> Self {
        Self {
            mixture,
            integrator,
            step_size,
            reinitialise_every: 0,
            regularise_every: 0,
            steps: 0,
            last: Step { length: 0.0, limit: Limit::Fixed },
            started: false,
        }
    }

    /// Reinitialises the density of water (70) every so many steps; 0 means never.
    pub fn with_reinitialisation(mut self, every: usize) -> Self {
        self.reinitialise_every = every;
        self
    }

    /// Replaces stresses of the soil by their Shepard mean every so many steps; 0, the default, means
    /// never.
    pub fn with_stress_regularisation(mut self, every: usize) -> Self {
        self.regularise_every = every;
        self
    }

    /// One step, as long as the limits allow.
    ///
    /// # Errors
    /// The state or its rates are unusable; the mixture stays as far as the step got, for a look.
    pub fn step(&mut self) -> Result<Step, StepError> {
        self.step_at_most(f64::INFINITY)
    }

    /// One step of at most `longest` \[s\]; none if that is not positive.
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    pub fn step_at_most(&mut self, longest: f64) -> Result<Step, StepError> {
        self.start()?;
        let limits = self.mixture.limits();
        let (mut dt, mut limit) = self.step_size.choose(&limits);
        if limit == Limit::Fixed {
            self.refuse_too_long(dt, &limits)?;
        }
        let longest = T::of(longest);
        if longest.partial_cmp(&T::ZERO) != Some(core::cmp::Ordering::Greater) {
            return Ok(Step { length: 0.0, limit: Limit::End });
        }
        if dt > longest * T::of(1.0 - CRUMB) {
            limit = if dt > longest * T::of(1.0 + CRUMB) { Limit::End } else { limit };
            dt = longest;
        }
        self.integrator.step(&mut self.mixture, dt)?;
        self.steps += 1;
        if self.mixture.open()? {
            self.integrator.disturbed();
        }
        let is_due = |every: usize| every > 0 && self.steps.is_multiple_of(every as u64);
        if is_due(self.reinitialise_every) {
            self.mixture.reinitialise_density();
        }
        if is_due(self.regularise_every) {
            self.mixture.regularise_stress();
        }
        self.last = Step { length: dt.as_f64(), limit };
        Ok(self.last)
    }

    /// Evaluates the first rates, which the first step's length depends on.
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    pub fn start(&mut self) -> Result<(), StepError> {
        if !self.started {
            self.mixture.evaluate()?;
            self.started = true;
        }
        Ok(())
    }

    fn refuse_too_long(&self, dt: T, limits: &Limits<T>) -> Result<(), StepError> {
        let (allowed, limit) = limits.last();
        if dt <= allowed {
            return Ok(());
        }
        let (step, allowed, time) = (dt.as_f64(), allowed.as_f64(), self.mixture.time());
        Err(match limit {
            Limit::Drag => {
                StepError::DragTooStiff { step, allowed, law: self.mixture.drag_law().describe(), time }
            }
            limit => StepError::StepTooLong { step, allowed, limit, time },
        })
    }

    /// Steps until time `end` \[s\], but for rounding, or until the onlooker breaks; it is called before the
    /// first step and after each.
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    pub fn run_until(
        &mut self,
        end: f64,
        mut onlooker: impl FnMut(&mut Self) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, StepError> {
        self.start()?;
        let mut flow = onlooker(self);
        // Closer than a rounding of the time, or of the last step, is there.
        let rounding = 1e-12 * end.abs().max(1e-12);
        let near = |step: Step| rounding.max(2.0 * T::EPSILON.as_f64() * step.length);
        while flow.is_continue() && self.mixture.time() < end - near(self.last) {
            self.step_at_most(end - self.mixture.time())?;
            flow = onlooker(self);
        }
        Ok(flow)
    }

    /// The particles.
    pub fn mixture(&self) -> &Mixture<T, D, K, S, F> {
        &self.mixture
    }

    /// The mixture, without what drove it.
    pub fn into_mixture(self) -> Mixture<T, D, K, S, F> {
        self.mixture
    }

    /// The particles, to change them from outside.
    pub fn mixture_mut(&mut self) -> &mut Mixture<T, D, K, S, F> {
        &mut self.mixture
    }

    /// Time t \[s\].
    pub fn time(&self) -> f64 {
        self.mixture.time()
    }

    /// How many steps have been done.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The last step; of length zero before the first.
    pub fn last_step(&self) -> Step {
        self.last
    }

    /// Where mass, momentum and energy are now.
    pub fn budget(&self) -> Budget<D> {
        self.mixture.budget()
    }

    /// The integrator.
    pub fn integrator(&self) -> &I {
        &self.integrator
    }
}
