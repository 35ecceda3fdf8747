//! Drag solved over a step instead of evaluated: any conductivity at the step sound allows.
//!
//! With the pair coefficients `K_ia = V_i V_a C_a W_ia` \[kg/s\], drag is `−L v` with the Laplacian L of the
//! graph of pairs, and its step from the velocities `v` with the other accelerations `a` is
//!
//! $$(M + \Delta t\,L)\,v' = M\,(v + \Delta t\,a).$$
//!
//! What the integrator gets is the *effective* acceleration `(v' − v)/Δt`, so that its own predictions hold
//! drag as well.

mod bond;
mod cholesky;
mod conjugate_gradients;
mod pairs;
mod scheme;
mod sweeps;
mod system;

use super::across::Across;
use super::phase::Phase;
use super::{DragScheme, Mixture, StepError};
use crate::budget::{Account, Exchange};
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel;
use crate::real::Real;
use crate::space::Vector;
use crate::time::Moment;
use bond::{Along, Bond};
use cholesky::Pattern;
use pairs::Pairs;
use scheme::Stage;
use sweeps::Sweeps;
use system::{System, Unsolved};

/// How the linear systems of implicit drag are solved; both end at the same tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DragSolver {
    /// Conjugate gradients: never slower in a run, up to the 20 000 particles measured.
    #[default]
    Iterative,
    /// With a sparse Cholesky factor, at the same cost however stiff. The same bits for any number of threads, but
    /// perhaps not on another machine.
    Direct,
}

/// What implicit drag keeps between an evaluation and the kicks that follow.
pub(super) struct ImplicitDrag<T: Real, const D: usize> {
    scheme: DragScheme,
    solver: DragSolver,
    /// Of the direct solver, as long as the lists are the same.
    pattern: Option<Pattern>,
    /// Accelerations of soil and water without drag, at the last evaluation.
    pub(super) without: [Vec<Vector<T, D>>; 2],
    /// The water's accelerations before that evaluation: the solve begins there.
    before: Option<Vec<Vector<T, D>>>,
}

impl<T: Real, const D: usize> Default for ImplicitDrag<T, D> {
    fn default() -> Self {
        Self {
            scheme: DragScheme::Explicit,
            solver: DragSolver::default(),
            pattern: None,
            without: [Vec::new(), Vec::new()],
            before: None,
        }
    }
}

impl<T: Real, const D: usize> ImplicitDrag<T, D> {
    fn is_on(&self) -> bool {
        self.scheme != DragScheme::Explicit
    }

    /// Before an evaluation, which writes over the water's accelerations.
    pub(super) fn keep_before(&mut self, water: &[Vector<T, D>]) {
        if self.is_on() {
            self.before = Some(water.to_vec());
        }
    }

    /// After an evaluation.
    pub(super) fn keep_without(&mut self, accelerations: [&[Vector<T, D>]; 2]) {
        if self.is_on() {
            self.without = accelerations.map(<[_]>::to_vec);
        }
    }

    /// The pattern to factor the systems of a step in, if that is the way to solve them.
    fn pattern<E: Bond<D>>(&mut self, across: &Across<T, D>, [soil, water]: [usize; 2]) -> Option<&Pattern> {
        if self.solver == DragSolver::Iterative {
            return None;
        }
        let rebuilds = across.neighbourhood.rebuilds();
        if self.pattern.as_ref().is_none_or(|pattern| pattern.rebuilds != rebuilds) {
            let listed = pairs::listed(across, soil, water);
            self.pattern = Pattern::new(&listed, soil, E::UNKNOWNS, rebuilds);
        }
        self.pattern.as_ref()
    }

    /// Goes back to what another evaluation left.
    pub(super) fn restore(&mut self, without: [Vec<Vector<T, D>>; 2]) {
        (self.without, self.before, self.pattern) = (without, None, None);
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// How drag goes through a step: evaluated explicitly by default; to be chosen before the first
    /// evaluation.
    pub fn with_drag_scheme(mut self, scheme: DragScheme) -> Self {
        self.implicit_drag.scheme = scheme;
        self.coupling.drag.is_evaluated = scheme == DragScheme::Explicit;
        self
    }

    /// How the systems of implicit drag are solved.
    pub fn with_drag_solver(mut self, solver: DragSolver) -> Self {
        self.implicit_drag.solver = solver;
        self
    }

    /// Adds to the accelerations the drag over a step of `dt` \[s\] from the velocities `base`.
    pub(super) fn complete_with_drag(&mut self, base: Moment, dt: T) -> Result<(), StepError> {
        if !self.implicit_drag.is_on() || !self.is_shared() {
            return Ok(());
        }
        let (soil, water) = (&self.soil.phase, &self.water.phase);
        let sorted = [self.soil.neighbourhood.rebuilds(), self.water.neighbourhood.rebuilds()];
        self.coupling.across.find_neighbours(&soil.position, &water.position, sorted);
        let reconstruction = self.reconstruction(base);
        let (soil, water) = (&self.soil.phase, &self.water.phase);
        let begin = self.implicit_drag.before.take();
        let begin = begin.as_deref().unwrap_or(&water.rate.acceleration);
        let begin: Vec<_> = begin.iter().map(in_double).collect();
        let velocity = joined([&soil.fields(base).velocity, &water.fields(base).velocity]);
        let [of_soil, of_water] = &self.implicit_drag.without;
        let mut without = joined([of_soil, of_water]);
        for (acceleration, change) in without.iter_mut().zip(reconstruction) {
            *acceleration += change;
        }
        let stage = Stage {
            without: &without,
            masses: &soil.mass.iter().chain(&water.mass).map(|m| m.as_f64()).collect::<Vec<_>>(),
            soil: soil.len(),
            held: [soil.wall_particles(), water.wall_particles()],
            step: dt.as_f64(),
        };
        let count = soil.len();
        let effective = if self.coupling.drag.is_projected {
            self.effective::<Along<D>>(stage, &velocity, &begin)
        } else {
            self.effective::<f64>(stage, &velocity, &begin)
        };
        let effective = effective.map_err(|unsolved| self.unsolved(unsolved))?;
        let (of_soil, of_water) = effective.split_at(count);
        put(&mut self.soil.phase, of_soil);
        put(&mut self.water.phase, of_water);
        Ok(())
    }

    /// Effective accelerations of soil and water over the step of a stage, from these velocities; the first system
    /// begins at `begin`.
    fn effective<E: Bond<D>>(
        &mut self,
        stage: Stage<'_, D>,
        velocity: &[Vector<f64, D>],
        begin: &[Vector<f64, D>],
    ) -> Result<Vec<Vector<f64, D>>, Unsolved> {
        let (soil, water) = (&self.soil.phase, &self.water.phase);
        let drag = &self.coupling.drag;
        let law = &*drag.law;
        let coefficient = |a: usize, slip: f64| {
            law.coefficient(water.volume_fraction(a), water.true_density(a), T::of(slip))
        };
        let across = &self.coupling.across;
        let scheme = self.implicit_drag.scheme;
        if law.knows_slip() {
            let seen = Pairs::<E>::of((across, drag), soil, water, |_| T::ONE);
            let coefficient = |a: usize, slip: f64| coefficient(a, slip).as_f64();
            let pattern = self.implicit_drag.pattern::<E>(across, [soil.len(), water.len()]);
            let sweeps = Sweeps { seen: &seen, coefficient: &coefficient, pattern };
            stage.through(scheme, velocity, begin, |stage, velocity, begin| {
                sweeps.solve(stage, velocity, begin)
            })
        } else {
            let pairs = Pairs::<E>::of((across, drag), soil, water, |a| coefficient(a, 0.0));
            let pattern = self.implicit_drag.pattern::<E>(across, [soil.len(), water.len()]);
            let mut system = None;
            stage.through(scheme, velocity, begin, |stage, velocity, begin| {
                let system = system.get_or_insert_with(|| System::new(&pairs, stage, pattern));
                system.accelerations(velocity, begin)
            })
        }
    }

    fn unsolved(&self, unsolved: Unsolved) -> StepError {
        let time = self.setting.time;
        match unsolved {
            Unsolved::Iteration { residual, allowed, iterations } => {
                StepError::DragUnsolved { residual, allowed, iterations, time }
            }
            Unsolved::Sweeps { change, allowed, sweeps } => {
                let law = self.coupling.drag.law.describe();
                StepError::DragUnsettled { change, allowed, sweeps, law, time }
            }
        }
    }

    /// What reconstructing the velocities `base` changes of the accelerations by drag; nothing if they are not.
    fn reconstruction(&mut self, base: Moment) -> Vec<Vector<f64, D>> {
        if !self.coupling.drag.is_reconstructed {
            return Vec::new();
        }
        let (soil, water) = (&mut self.soil, &mut self.water);
        let [on_soil, on_water] =
            self.coupling.reconstruct_drag(&self.setting.kernel, soil, water, (base, false)).acceleration;
        joined([&on_soil, &on_water])
    }

    /// What drag takes and gives per time over a step of `dt` \[s\] from the fields `base`: the work of the
    /// effective accelerations less those without drag, at the mean of the velocities before and after.
    pub(super) fn drag_exchange(&self, base: Moment, dt: T) -> Exchange<D> {
        if !self.implicit_drag.is_on() || !self.is_shared() {
            return Exchange::default();
        }
        let [soil, water] = &self.implicit_drag.without;
        work(&self.soil.phase, soil, base, dt) + work(&self.water.phase, water, base, dt)
    }
}

fn in_double<T: Real, const D: usize>(x: &Vector<T, D>) -> Vector<f64, D> {
    Vector(x.as_f64())
}

fn joined<T: Real, const D: usize>(parts: [&Vec<Vector<T, D>>; 2]) -> Vec<Vector<f64, D>> {
    parts.into_iter().flatten().map(in_double).collect()
}

fn put<T: Real, const D: usize, M: Material<T>>(phase: &mut Phase<T, D, M>, values: &[Vector<f64, D>]) {
    for (a, value) in phase.rate.acceleration.iter_mut().zip(values) {
        *a = Vector::of(value.0);
    }
}

/// A phase's part of [`Mixture::drag_exchange`].
fn work<T: Real, const D: usize, M: Material<T>>(
    phase: &Phase<T, D, M>,
    without: &[Vector<T, D>],
    base: Moment,
    dt: T,
) -> Exchange<D> {
    let walls = phase.wall_particles();
    let of = |range: core::ops::Range<usize>| {
        let mut sum = Exchange::default();
        for i in range {
            let acceleration = in_double(&phase.rate.acceleration[i]);
            let force = (acceleration - in_double(&without[i])) * phase.mass[i].as_f64();
            let mut velocity = in_double(&phase.fields(base).velocity[i]);
            if i < walls {
                sum.taken[Account::WallWork] += force.dot(velocity);
                sum.impulse -= force;
            } else {
                velocity += acceleration * (0.5 * dt.as_f64());
            }
            sum.taken[Account::Drag] -= force.dot(velocity);
        }
        sum
    };
    parallel::reduce(phase.len(), Exchange::default(), of, |a, b| a + b)
}
