//! Forensics: a run that goes bad stops within the step and says who, what, where and when.

use super::Mixture;
use super::evaluation::vector_sum;
use super::own_pairs::sum;
use crate::budget::{Account, Exchange};
use crate::kernel::Kernel;
use crate::material::{Material, Memory};
use crate::parallel;
use crate::real::Real;
use crate::space::Vector;
use core::fmt;
use core::ops::Range;

/// The particle something is wrong with.
#[derive(Clone, Debug, PartialEq)]
pub struct Culprit {
    /// `"water"` or `"water wall"`.
    pub kind: &'static str,
    /// Its id.
    pub particle: u32,
    /// Where it is \[m\].
    pub position: Vec<f64>,
    /// Time \[s\].
    pub time: f64,
}

impl fmt::Display for Culprit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} particle {} at {:?} m, t = {:.6e} s",
            self.kind, self.particle, self.position, self.time
        )
    }
}

/// Why a step could not be done.
#[derive(Clone, Debug, PartialEq)]
pub enum StepError {
    /// A number is infinite or NaN.
    NotFinite {
        /// Whose.
        culprit: Culprit,
        /// Which field or rate.
        field: &'static str,
        /// The term of the equations it came from.
        term: &'static str,
    },
    /// A value no sound computation has.
    Absurd {
        /// Whose.
        culprit: Culprit,
        /// Which field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: String,
    },
    /// Two particles at the same place.
    Overlap {
        /// One of them.
        culprit: Culprit,
        /// The other's id.
        other: u32,
        /// How far apart \[m\].
        distance: f64,
        /// How far apart they have to be at least \[m\].
        allowed: f64,
    },
    /// A fixed step that no Courant number allows.
    StepTooLong {
        /// The step \[s\].
        step: f64,
        /// The longest allowed \[s\].
        allowed: f64,
        /// What limits it.
        limit: crate::time::Limit,
        /// Time \[s\].
        time: f64,
    },
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { culprit, field, term } => {
                write!(f, "{field} of {culprit} is not finite (term: {term})")
            }
            Self::Absurd { culprit, field, value, allowed } => {
                write!(f, "{field} of {culprit} is {value:.6e}: allowed is {allowed}")
            }
            Self::Overlap { culprit, other, distance, allowed } => write!(
                f,
                "{culprit} overlaps particle {other}: they are {distance:.3e} m apart, at least {allowed:.3e} m is allowed"
            ),
            Self::StepTooLong { step, allowed, limit, time } => write!(
                f,
                "time step {step:.3e} s at t = {time:.6e} s is too long: the {limit} limit allows at most {allowed:.3e} s"
            ),
        }
    }
}

impl core::error::Error for StepError {}

/// Particles nearer than this fraction of the smoothing length overlap.
const OVERLAP: f64 = 1e-4;
/// The true density must stay within this fraction of its reference.
const DENSITY_RANGE: f64 = 0.5;

/// What one look at all particles finds.
#[derive(Clone, Default)]
struct Survey<const D: usize> {
    acceleration2: f64,
    exchange_rate: Exchange<D>,
    suspect: Option<usize>,
}

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    /// Fields before an evaluation: all finite, density and speed in range.
    pub(super) fn check_fields(&self) -> Result<(), StepError> {
        let water = &self.water;
        let walls = water.wall_particles();
        let c = water.material().sound_speed();
        let range_of_density = T::of(DENSITY_RANGE);
        let sound = |i: usize| {
            water.bad_field(i).is_none()
                && water.compression(i).abs() <= range_of_density
                && (i < walls || water.now.velocity[i].norm2() <= c * c)
        };
        let first_bad = |mut range: Range<usize>| {
            if self.is_plainly_sound(range.clone(), c * c, range_of_density) {
                return None;
            }
            range.find(|&i| !sound(i))
        };
        let first_bad = parallel::reduce(water.len(), None, first_bad, Option::or);
        let Some(i) = first_bad else { return Ok(()) };
        let culprit = self.culprit(i);
        if let Some(field) = water.bad_field(i) {
            return Err(StepError::NotFinite { culprit, field, term: "state before the evaluation" });
        }
        if water.compression(i).abs() > range_of_density {
            let reference = water.material().reference_density().as_f64();
            let allowed = format!(
                "{} to {} kg/m³",
                reference * (1.0 - DENSITY_RANGE),
                reference * (1.0 + DENSITY_RANGE)
            );
            let value = water.true_density(i).as_f64();
            return Err(StepError::Absurd { culprit, field: "true density", value, allowed });
        }
        let value = water.now.velocity[i].norm().as_f64();
        Err(StepError::Absurd {
            culprit,
            field: "speed",
            value,
            allowed: format!("up to the speed of sound, {c} m/s"),
        })
    }

    /// Whether nothing is wrong with the particles of `range`, by a quick look without branches that
    /// may have false alarms: for fast walls, and where a square overflows.
    fn is_plainly_sound(&self, range: Range<usize>, fastest2: T, density_range: T) -> bool {
        let (water, now) = (&self.water, &self.water.now);
        let mut sound = true;
        for x in &water.position[range.clone()] {
            sound &= x.norm2().is_finite();
        }
        for v in &now.velocity[range.clone()] {
            sound &= v.norm2() <= fastest2;
        }
        for (&excess, &fraction) in
            now.excess[range.clone()].iter().zip(&water.volume_fraction[range.clone()])
        {
            sound &= (excess / fraction).abs() <= density_range;
        }
        sound && now.memory[range].iter().all(Memory::is_finite)
    }

    /// Rates after an evaluation: all finite, nobody on top of another. Also finds the largest
    /// acceleration and the rates of the ledger.
    pub(super) fn check_rates(&mut self) -> Result<(), StepError> {
        let h = self.kernel.smoothing_length().as_f64();
        let closest2 = (OVERLAP * h) * (OVERLAP * h);
        let viscous = self.exchange_rate.taken[Account::Viscosity];
        let survey = parallel::reduce(
            self.water.len(),
            Survey::default(),
            |range| self.survey(range, closest2),
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
            return Err(self.explain(i, closest2.sqrt()));
        }
        self.fastest_acceleration = T::of(survey.acceleration2.sqrt());
        self.exchange_rate = survey.exchange_rate;
        self.exchange_rate.taken[Account::Viscosity] = viscous;
        Ok(())
    }

    fn survey(&self, range: Range<usize>, closest2: f64) -> Survey<D> {
        let water = &self.water;
        let (walls, sums) = (water.wall_particles(), &self.scratch.sums);
        let (mut acceleration2, mut suspect) = (0.0, None);
        for i in range.clone() {
            let a2 = water.rate.acceleration[i].norm2().as_f64();
            let near2 = sums.get(i, D + sum::CLOSEST).as_f64();
            if !(a2.is_finite() && water.rate.excess[i].is_finite() && near2 >= closest2) {
                suspect = suspect.or(Some(i));
            }
            if i >= walls && a2 > acceleration2 {
                acceleration2 = a2;
            }
        }
        Survey { acceleration2, suspect, exchange_rate: self.exchange(range) }
    }

    /// What is wrong with particle `i`.
    fn explain(&self, i: usize, allowed: f64) -> StepError {
        let water = &self.water;
        let culprit = self.culprit(i);
        let sums = &self.scratch.sums;
        let own: Vector<T, D> = vector_sum(sums, i, 0);
        let bad = |field, term| StepError::NotFinite { culprit: culprit.clone(), field, term };
        if !water.pressure[i].is_finite() {
            return bad("pressure", "equation of state (16)");
        }
        if !water.deviator(i).0.iter().all(|x| x.is_finite()) {
            return bad("deviatoric stress", "viscosity (14), (62)");
        }
        if !own.is_finite() {
            return bad("acceleration", "momentum (58)");
        }
        if !sums.get(i, D + sum::COMPRESSION).is_finite() {
            return bad("density rate", "continuity (52)");
        }
        if !water.rate.excess[i].is_finite() {
            return bad("density rate", "density diffusion (54)");
        }
        if !water.rate.acceleration[i].is_finite() {
            return bad("acceleration", "body force");
        }
        let mut nearest = (f64::INFINITY, i);
        self.neighbourhood.for_each_neighbour(&water.position, i, |j, _, r2: T| {
            if r2.as_f64() < nearest.0 {
                nearest = (r2.as_f64(), j);
            }
        });
        StepError::Overlap { culprit, other: water.id[nearest.1], distance: nearest.0.sqrt(), allowed }
    }

    fn culprit(&self, i: usize) -> Culprit {
        let water = &self.water;
        Culprit {
            kind: if i < water.wall_particles() { "water wall" } else { "water" },
            particle: water.id[i],
            position: water.position[i].as_f64().to_vec(),
            time: self.time,
        }
    }
}
