//! Forensics: a run that goes bad stops within the step and says who, what, where and when.

use super::constituent::{Constituent, Role};
use super::evaluation::vector_sum;
use super::own_pairs::sum;
use super::setting::Setting;
use super::step_error::{Culprit, StepError};
use crate::budget::Exchange;
use crate::kernel::Kernel;
use crate::lanes::{Lanes, Work, dispatch};
use crate::material::{Material, Memory};
use crate::parallel;
use crate::real::{Num, Real};
use crate::space::Vector;
use core::ops::Range;

/// Particles nearer than this fraction of the smoothing length overlap.
const OVERLAP: f64 = 1e-4;
/// The true density must stay within this fraction of its reference.
const DENSITY_RANGE: f64 = 0.5;
/// The volume fraction of rigid grains must stay within this fraction of the one they began with.
const FRACTION_RANGE: f64 = 0.98;

/// What one look at all particles finds.
#[derive(Clone, Default)]
struct Survey<const D: usize> {
    acceleration2: f64,
    exchange_rate: Exchange<D>,
    suspect: Option<usize>,
}

/// A look at the rates of `range`, which begins with a slice.
struct Look<'a, T: Real, K, const D: usize, M: Material<T>> {
    constituent: &'a Constituent<T, D, M>,
    setting: &'a Setting<T, D, K>,
    range: Range<usize>,
    closest2: T,
}

impl<T: Real, K: Kernel<T, D>, const D: usize, M: Material<T>> Work<T> for Look<'_, T, K, D, M> {
    type Out = Survey<D>;
    #[inline(always)]
    fn run<L: Lanes<Scalar = T>>(self) -> Survey<D> {
        self.constituent.survey(self.setting, self.range, self.closest2)
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Fields before an evaluation: all finite, density and speed in range. A list of neighbours that still
    /// serves, `are_listed`, is a proof that every position is finite.
    pub(super) fn check_fields<K: Kernel<T, D>>(
        &self,
        setting: &Setting<T, D, K>,
        are_listed: bool,
    ) -> Result<(), StepError> {
        let phase = &self.phase;
        let walls = phase.wall_particles();
        let c = phase.material().sound_speed();
        let range_of_density = T::of(if M::RIGID_GRAINS { FRACTION_RANGE } else { DENSITY_RANGE });
        let strain = |i: usize| (phase.now.excess[i] / phase.volume_fraction[i]).abs();
        let sound = |i: usize| {
            phase.bad_field(i).is_none()
                && strain(i) <= range_of_density
                && (i < walls || phase.now.velocity[i].norm2() <= c * c)
        };
        let first_bad = |mut range: Range<usize>| {
            let is_somewhere = are_listed || self.is_plainly_somewhere(range.clone());
            if is_somewhere && self.is_plainly_sound(range.clone(), c * c, range_of_density) {
                return None;
            }
            range.find(|&i| !sound(i))
        };
        let first_bad = parallel::reduce(phase.len(), None, first_bad, Option::or);
        let Some(i) = first_bad else { return Ok(()) };
        let culprit = self.culprit(setting, i);
        if let Some(field) = phase.bad_field(i) {
            return Err(StepError::NotFinite { culprit, field, term: "state before the evaluation" });
        }
        if strain(i) > range_of_density {
            let range = range_of_density.as_f64();
            let (field, value, usual, unit) = if M::RIGID_GRAINS {
                let fraction = phase.volume_fraction(i);
                ("volume fraction", fraction, phase.volume_fraction[i].as_f64(), "")
            } else {
                let reference = phase.material().reference_density();
                ("true density", phase.true_density(i), reference.as_f64(), " kg/m³")
            };
            let allowed = format!("{} to {}{unit}", usual * (1.0 - range), usual * (1.0 + range));
            return Err(StepError::Absurd { culprit, field, value: value.as_f64(), allowed });
        }
        let value = phase.now.velocity[i].norm().as_f64();
        Err(StepError::Absurd {
            culprit,
            field: "speed",
            value,
            allowed: format!("up to the speed of sound, {c} m/s"),
        })
    }

    /// Whether nothing but perhaps the place is wrong with the particles of `range`, by a quick look without branches that
    /// may have false alarms: for fast walls, and where a square overflows.
    fn is_plainly_sound(&self, range: Range<usize>, fastest2: T, density_range: T) -> bool {
        let (phase, now) = (&self.phase, &self.phase.now);
        let mut sound = true;
        for v in &now.velocity[range.clone()] {
            sound &= v.norm2() <= fastest2;
        }
        for (&excess, &fraction) in
            now.excess[range.clone()].iter().zip(&phase.volume_fraction[range.clone()])
        {
            sound &= (excess / fraction).abs() <= density_range;
        }
        sound && now.memory[range].iter().all(Memory::is_finite)
    }

    /// Whether the positions of `range` are finite, by the same kind of look.
    fn is_plainly_somewhere(&self, range: Range<usize>) -> bool {
        self.phase.position[range].iter().fold(true, |finite, x| finite & x.norm2().is_finite())
    }

    /// Rates after an evaluation: all finite, nobody on top of another. Also finds the largest
    /// acceleration and the rates of the ledger.
    pub(super) fn check_rates<K: Kernel<T, D>>(
        &mut self,
        setting: &Setting<T, D, K>,
    ) -> Result<(), StepError> {
        let h = setting.kernel.smoothing_length().as_f64();
        // Nobody is placed on top of another; but two particles of spray may pass through each other,
        // which the kernels, finite at r = 0, do not mind.
        let closest = if self.phase.placed { OVERLAP * h } else { 0.0 };
        let closest2 = closest * closest;
        let Exchange { taken: lost, buoyancy, .. } = self.exchange_rate;
        let survey = parallel::reduce(
            self.phase.len(),
            Survey::default(),
            |range| {
                let look = Look { constituent: self, setting, range, closest2: T::of(closest2) };
                dispatch(self.neighbourhood.instruction_set(), look)
            },
            |a, b| Survey {
                acceleration2: if b.acceleration2 > a.acceleration2 {
                    b.acceleration2
                } else {
                    a.acceleration2
                },
                exchange_rate: a.exchange_rate + b.exchange_rate,
                suspect: a.suspect.or(b.suspect),
            },
        );
        if let Some(i) = survey.suspect {
            return Err(self.explain(setting, i, closest2.sqrt()));
        }
        self.phase.placed = false;
        self.fastest_acceleration = T::of(survey.acceleration2.sqrt());
        self.exchange_rate = Exchange { buoyancy, ..survey.exchange_rate };
        self.exchange_rate.taken = self.exchange_rate.taken + lost;
        Ok(())
    }

    /// `range` begins with a slice.
    #[inline(always)]
    fn survey<K: Kernel<T, D>>(
        &self,
        setting: &Setting<T, D, K>,
        range: Range<usize>,
        closest2: T,
    ) -> Survey<D> {
        let (rate, sums) = (&self.phase.rate, &self.scratch.sums);
        let (mut sound, mut most) = (true, [T::ZERO; 16]);
        for first in range.clone().step_by(T::SLICE) {
            // A whole slice is told apart, so that it becomes vector code.
            sound &= if first + T::SLICE <= range.end {
                self.survey_slice(first, T::SLICE, closest2, &mut most)
            } else {
                self.survey_slice(first, range.end - first, closest2, &mut most)
            };
        }
        let is_sound = |&i: &usize| {
            let near2 = sums.get(i, D + sum::CLOSEST);
            rate.acceleration[i].norm2().is_finite() && rate.excess[i].is_finite() && near2 >= closest2
        };
        // The slice in which walls end is looked at particle by particle.
        let walls = self.phase.wall_particles().clamp(range.start, range.end);
        let mixed = walls..walls.next_multiple_of(T::SLICE).min(range.end);
        let others = mixed.map(|i| rate.acceleration[i].norm2());
        Survey {
            acceleration2: others.chain(most).fold(T::ZERO, Num::max).as_f64(),
            suspect: if sound { None } else { range.clone().find(|i| !is_sound(i)) },
            exchange_rate: self.exchange(setting, range),
        }
    }

    /// Whether the rates of a slice, or of its first `count` particles, are sound; also finds the squares of
    /// the largest accelerations, lane by lane.
    #[inline(always)]
    fn survey_slice(&self, first: usize, count: usize, closest2: T, most: &mut [T; 16]) -> bool {
        let rate = &self.phase.rate;
        let (accelerations, excesses) =
            (&rate.acceleration[first..][..count], &rate.excess[first..][..count]);
        let near2 = &self.scratch.sums.lanes(first / T::SLICE, D + sum::CLOSEST)[..count];
        let falls = first >= self.phase.wall_particles();
        let mut sound = true;
        for k in 0..count {
            let a2 = accelerations[k].norm2();
            sound &= a2.is_finite() & excesses[k].is_finite() & (near2[k] >= closest2);
            most[k] = most[k].max(if falls { a2 } else { T::ZERO });
        }
        sound
    }

    /// What is wrong with particle `i`.
    fn explain<K: Kernel<T, D>>(&self, setting: &Setting<T, D, K>, i: usize, allowed: f64) -> StepError {
        let phase = &self.phase;
        let culprit = self.culprit(setting, i);
        let sums = &self.scratch.sums;
        let own: Vector<T, D> = vector_sum(sums, i, 0);
        let bad = |field, term| StepError::NotFinite { culprit: culprit.clone(), field, term };
        if !phase.pressure[i].is_finite() {
            return bad("pressure", self.term("equation of state (16)", "stress (33)"));
        }
        if !phase.deviator(i).0.iter().all(|x| x.is_finite()) {
            return bad("deviatoric stress", self.term("viscosity (14), (62)", "stress (33), (65)"));
        }
        if !own.is_finite() {
            return bad("acceleration", self.term("momentum (58)", "momentum (55)"));
        }
        if !sums.get(i, D + sum::COMPRESSION).is_finite() {
            return bad("density rate", self.term("continuity (52)", "continuity (53)"));
        }
        if !phase.rate.excess[i].is_finite() {
            return bad("density rate", "density diffusion (54)");
        }
        if !phase.rate.acceleration[i].is_finite() {
            return bad("acceleration", self.added_term(setting, i));
        }
        // Each component may be a number where the square, which the limit of forces needs, is none.
        if !phase.rate.acceleration[i].norm2().is_finite() {
            let value = phase.rate.acceleration[i].as_f64().iter().fold(0.0, |a: f64, x| a.hypot(*x));
            let allowed = format!("less, its square is no number of {}", T::NAME);
            return StepError::Absurd { culprit, field: "acceleration", value, allowed };
        }
        let mut nearest = (f64::INFINITY, i);
        self.neighbourhood.for_each_neighbour(&phase.position, i, |j, _, r2: T| {
            if r2.as_f64() < nearest.0 {
                nearest = (r2.as_f64(), j);
            }
        });
        StepError::Overlap { culprit, other: phase.id[nearest.1], distance: nearest.0.sqrt(), allowed }
    }

    /// The term that made an acceleration no number, of those added to the sums over one's own pairs.
    fn added_term<K: Kernel<T, D>>(&self, setting: &Setting<T, D, K>, i: usize) -> &'static str {
        let force = setting.force.as_ref().filter(|_| i >= self.phase.wall_particles());
        let force = force.map(|force| (force.acceleration)(&self.phase.position[i], setting.time));
        if force.is_some_and(|a| !a.is_finite()) {
            return "body force";
        }
        let control = match (self.artificial_stress, self.strain_control > T::ZERO) {
            (Some(_), _) => Some("artificial stress"),
            (None, true) => Some("strain control"),
            (None, false) => None,
        };
        // Both leave what they added behind.
        let added = control.filter(|_| !vector_sum::<T, D>(&self.scratch.extra, i, 0).is_finite());
        added.unwrap_or(self.term("coupling (58)", "coupling (55)"))
    }

    /// The name of a term, as it is for each constituent.
    fn term(&self, of_water: &'static str, of_soil: &'static str) -> &'static str {
        match self.role {
            Role::Soil => of_soil,
            Role::Water => of_water,
        }
    }

    pub(super) fn culprit<K: Kernel<T, D>>(&self, setting: &Setting<T, D, K>, i: usize) -> Culprit {
        let phase = &self.phase;
        Culprit {
            kind: match (self.role, i < phase.wall_particles()) {
                (Role::Soil, true) => "soil wall",
                (Role::Soil, false) => "soil",
                (Role::Water, true) => "water wall",
                (Role::Water, false) => "water",
            },
            particle: phase.id[i],
            position: phase.position[i].as_f64().to_vec(),
            time: setting.time,
        }
    }
}
