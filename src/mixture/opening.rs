//! Where water comes in and where particles leave; all of it is in the books.

use super::constituent::Constituent;
use super::phase::Phase;
use super::setting::Setting;
use super::wall::{Wall, WallKind};
use super::{Mixture, StepError};
use crate::budget::{Account, Exchange};
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::Real;
use crate::setup;
use crate::space::Vector;
use crate::time::Moment;

/// A box \[m\]; sides may be infinitely far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Region<const D: usize> {
    low: [f64; D],
    high: [f64; D],
}

impl<const D: usize> Region<D> {
    pub(super) fn new(name: &'static str, low: [f64; D], high: [f64; D]) -> Result<Self, ParameterError> {
        if (0..D).all(|k| low[k] < high[k]) {
            Ok(Self { low, high })
        } else {
            Err(ParameterError::new(
                name,
                format!("{low:?} to {high:?}"),
                "low below high along each axis [m]",
            ))
        }
    }

    fn holds<T: Real>(&self, x: &Vector<T, D>) -> bool {
        (0..D).all(|k| (self.low[k]..=self.high[k]).contains(&x[k].as_f64()))
    }

    fn corners(&self) -> [Vec<f64>; 2] {
        [self.low.to_vec(), self.high.to_vec()]
    }
}

/// Water that comes in: a box of particles that move towards its mouth, where they are let go.
#[derive(Clone, Debug)]
pub(super) struct Inflow<T, const D: usize> {
    body: u16,
    axis: usize,
    /// Where the mouth is along the axis \[m\], and towards which end the water moves.
    mouth: T,
    rises: bool,
    length: T,
    mass: T,
    excess: T,
}

impl<T: Real, const D: usize, M: Material<T>> Phase<T, D, M> {
    /// Lets water come in: fills the box from `low` to `high` \[m\], which moves at `velocity` \[m/s\] along
    /// one of the axes, with particles a `spacing` \[m\] apart under no pressure. Whoever has passed the face
    /// it moves to, the mouth, is let go, and another follows a length of the box behind: rows stay a spacing
    /// apart whatever the step. Make the box at least as long as the support of the kernel.
    ///
    /// # Errors
    /// The velocity is not along one axis, or the box holds no particle.
    pub fn add_inflow(
        &mut self,
        low: [f64; D],
        high: [f64; D],
        spacing: f64,
        velocity: Vector<T, D>,
    ) -> Result<(), ParameterError> {
        let along: Vec<usize> = (0..D).filter(|&k| velocity[k] != T::ZERO).collect();
        let &[axis] = &along[..] else {
            let given = format!("{:?}", velocity.0);
            return Err(ParameterError::new("inflow velocity", given, "along one axis, not zero [m/s]"));
        };
        let positions = setup::fill::<T, D>(low, high, spacing);
        if positions.is_empty() {
            let given = format!("{low:?} to {high:?}");
            return Err(ParameterError::new("inflow", given, "a box of at least one spacing [m]"));
        }
        let rises = velocity[axis] > T::ZERO;
        let rows = ((high[axis] - low[axis]) / spacing).round();
        let mouth = if rises { low[axis] + rows * spacing } else { low[axis] };
        let body = self.walls.len() as u16;
        let wall = Wall::new(WallKind::Given).moving(move |_, _| velocity);
        self.add_wall(wall, &positions, T::of(spacing.powi(D as i32)), |_| T::ZERO)?;
        let first = self.wall_particles - positions.len();
        let (mass, excess) = (self.mass[first], self.now.excess[first]);
        let (mouth, length) = (T::of(mouth), T::of(rows * spacing));
        self.inflows.push(Inflow { body, axis, mouth, rises, length, mass, excess });
        Ok(())
    }

    /// Leaves to the water in each box what soil leaves of the space there (68): it comes in with the fraction
    /// of its place.
    pub(super) fn share_inflows(&mut self, fractions: &[T]) {
        for n in 0..self.inflows.len() {
            let body = self.inflows[n].body;
            for i in (0..self.wall_particles).filter(|&i| self.body[i] == body).collect::<Vec<_>>() {
                self.set_one_volume_fraction(i, fractions[i]);
                if let Some(fraction) = &mut self.evolving_fraction {
                    fraction.half[i] = fractions[i];
                }
            }
        }
    }

    /// Whether water comes in.
    pub(super) fn has_inflows(&self) -> bool {
        !self.inflows.is_empty()
    }

    /// Lets go who has passed a mouth, behind all others; another particle takes the place in the wall.
    fn let_go(&mut self) {
        for n in 0..self.inflows.len() {
            let Inflow { body, axis, mouth, rises, length, mass, excess } = self.inflows[n];
            let beyond = |x: &Vector<T, D>| if rises { x[axis] >= mouth } else { x[axis] <= mouth };
            let passed = |i: &usize| self.body[*i] == body && beyond(&self.position[*i]);
            let passed: Vec<usize> = (0..self.wall_particles).filter(passed).collect();
            if passed.is_empty() {
                continue;
            }
            // Who is let go stands behind all others, and once more in the wall.
            let order: Vec<u32> = (0..self.len()).chain(passed.iter().copied()).map(|i| i as u32).collect();
            self.permute(&order);
            for i in passed {
                self.position[i][axis] += if rises { -length } else { length };
                (self.mass[i], self.volume_fraction[i]) = (mass, T::ONE);
                (self.now.excess[i], self.half.excess[i]) = (excess, excess);
                if let Some(fraction) = &mut self.evolving_fraction {
                    fraction.half[i] = T::ONE;
                }
                self.id[i] = self.next_id;
                self.next_id += 1;
            }
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Lets particles in and out; returns what they brought at each instant, if any passed.
    fn open<K: Kernel<T, D>>(
        &mut self,
        setting: &Setting<T, D, K>,
    ) -> Result<Option<[Exchange<D>; 2]>, StepError> {
        let before = self.phase.len();
        self.phase.let_go();
        let came: Vec<usize> = (before..self.phase.len()).collect();
        let gone = self.leaving(setting)?;
        if came.is_empty() && gone.is_empty() {
            return Ok(None);
        }
        let brought = [Moment::Now, Moment::Half].map(|moment| {
            let taken = self.brought(setting, &gone, Account::Outflow, moment) * -1.0;
            self.brought(setting, &came, Account::Inflow, moment) + taken
        });
        if !gone.is_empty() {
            // What moves to the end keeps its order among the others.
            let mut leaves = vec![false; self.phase.len()];
            gone.iter().for_each(|&i| leaves[i] = true);
            let staying: Vec<u32> = (0..leaves.len() as u32).filter(|&i| !leaves[i as usize]).collect();
            self.phase.permute(&staying);
        }
        self.neighbourhood.forget();
        Ok(Some(brought))
    }

    /// Who is in an outlet. Whoever is beyond the domain and in no outlet is an error.
    fn leaving<K: Kernel<T, D>>(&self, setting: &Setting<T, D, K>) -> Result<Vec<usize>, StepError> {
        let (phase, mut leaving) = (&self.phase, Vec::new());
        if setting.outlets.is_empty() && setting.domain.is_none() {
            return Ok(leaving);
        }
        for i in phase.wall_particles()..phase.len() {
            let x = &phase.position[i];
            if setting.outlets.iter().any(|outlet| outlet.holds(x)) {
                leaving.push(i);
            } else if let Some(domain) = setting.domain.filter(|domain| !domain.holds(x)) {
                return Err(StepError::Escaped {
                    culprit: self.culprit(setting, i),
                    domain: domain.corners(),
                });
            }
        }
        Ok(leaving)
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, S: Material<T>, F: Material<T>> Mixture<T, D, K, S, F> {
    /// Lets particles leave where they get into the box from `low` to `high` \[m\], whose sides may be
    /// infinitely far; mass, momentum and energy they take along are booked.
    ///
    /// # Errors
    /// A corner is not below the other.
    pub fn with_outlet(mut self, low: [f64; D], high: [f64; D]) -> Result<Self, ParameterError> {
        self.setting.outlets.push(Region::new("outlet", low, high)?);
        Ok(self)
    }

    /// Ends a run in which a particle gets out of the box from `low` to `high` \[m\] otherwise than through an
    /// outlet.
    ///
    /// # Errors
    /// A corner is not below the other.
    pub fn with_domain(mut self, low: [f64; D], high: [f64; D]) -> Result<Self, ParameterError> {
        self.setting.domain = Some(Region::new("domain", low, high)?);
        Ok(self)
    }

    /// Lets particles in and out between two steps; whether any passed.
    ///
    /// # Errors
    /// One has left the domain.
    pub(crate) fn open(&mut self) -> Result<bool, StepError> {
        let passed = [self.soil.open(&self.setting)?, self.water.open(&self.setting)?];
        let changed = passed.iter().any(Option::is_some);
        for brought in passed.into_iter().flatten() {
            for (exchanged, brought) in self.exchanged.iter_mut().zip(brought) {
                *exchanged = *exchanged + brought;
            }
        }
        if changed {
            self.coupling.across.neighbourhood.forget();
        }
        Ok(changed)
    }
}
