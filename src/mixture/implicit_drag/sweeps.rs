//! Drag that grows with the slip: linear systems with the coefficients of the last slips, until these settle.

use super::bond::Bond;
use super::cholesky::Pattern;
use super::pairs::Pairs;
use super::scheme::Stage;
use super::system::{System, Unsolved};
use crate::space::Vector;

/// How far the slips a solution was made with may be from those it has, relative.
const TOLERANCE: f64 = 1e-8;
/// And against the velocities of the step: the linear solution is not better.
const FLOOR: f64 = 1e-9;
/// Beyond this they do not settle.
const MOST_SWEEPS: usize = 60;
/// Drag that grows like slip⁴ answers a larger slip no harder than by this.
const STEEPEST: f64 = -4.0;

/// Pairs with a coefficient that depends on the slip.
pub(super) struct Sweeps<'a, E> {
    /// V_i V_a W_ia of each pair.
    pub(super) seen: &'a Pairs<E>,
    /// C_a \[kg/m³/s\] of water particle a at a slip \[m/s\].
    pub(super) coefficient: &'a dyn Fn(usize, f64) -> f64,
    pub(super) pattern: Option<&'a Pattern>,
}

impl<E: Copy + Default + Send + Sync> Sweeps<'_, E> {
    fn with<const D: usize>(&self, slips: &[f64]) -> Pairs<E>
    where
        E: Bond<D>,
    {
        let factors: Vec<f64> = slips.iter().enumerate().map(|(a, &s)| (self.coefficient)(a, s)).collect();
        self.seen.times(&factors)
    }

    /// As [`System::accelerations`], with the coefficients of the slips at the end of the stage.
    pub(super) fn solve<const D: usize>(
        &self,
        stage: Stage<'_, D>,
        velocity: &[Vector<f64, D>],
        begin: &[Vector<f64, D>],
    ) -> Result<Vec<Vector<f64, D>>, Unsolved>
    where
        E: Bond<D>,
    {
        let floor = FLOOR * stage.scale(velocity) * stage.step;
        let masses = &stage.masses[stage.soil..];
        let mut begin = begin.to_vec();
        let mut slips = self.seen.slips(velocity);
        let mut before: Option<[Vec<f64>; 2]> = None;
        let mut sweeps = 0;
        loop {
            let pairs = self.with(&slips);
            let accelerations = System::new(&pairs, stage, self.pattern).accelerations(velocity, &begin)?;
            let found = self.seen.slips(&stage.moved(velocity, &accelerations, stage.step));
            sweeps += 1;
            let (change, allowed) = distance(masses, &slips, &found, floor);
            if change <= allowed {
                return Ok(accelerations);
            }
            if sweeps == MOST_SWEEPS || !change.is_finite() {
                return Err(Unsolved::Sweeps { change, allowed, sweeps });
            }
            let next = settled(&slips, &found, before.as_ref());
            before = Some([core::mem::replace(&mut slips, next), found]);
            begin.copy_from_slice(&accelerations[stage.soil..]);
        }
    }
}

/// How far apart two lists of slips are, and how far they may be; weighted by mass, as the linear solution is.
fn distance(masses: &[f64], slips: &[f64], found: &[f64], floor: f64) -> (f64, f64) {
    let (mut mass, mut apart, mut large) = (0.0, 0.0, 0.0);
    for ((m, s), f) in masses.iter().zip(slips).zip(found) {
        mass += m;
        apart += m * (f - s) * (f - s);
        large += m * f * f;
    }
    ((apart / mass).sqrt(), TOLERANCE * (large / mass).sqrt() + floor)
}

/// The slips to try next: where a secant through the last two, particle by particle, crosses found = slip. Less
/// slip is found the more is assumed, so that its slope is negative; at first it is taken for −1, as of quadratic
/// drag that rules.
fn settled(slips: &[f64], found: &[f64], before: Option<&[Vec<f64>; 2]>) -> Vec<f64> {
    let slope = |a: usize| match before {
        Some([slips_before, found_before]) if slips[a] != slips_before[a] => {
            ((found[a] - found_before[a]) / (slips[a] - slips_before[a])).clamp(STEEPEST, 0.0)
        }
        _ => -1.0,
    };
    (0..slips.len()).map(|a| slips[a] + (found[a] - slips[a]) / (1.0 - slope(a))).collect()
}
