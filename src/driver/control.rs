//! Finds the strain under which the stress becomes what is asked for.

use super::path::{Aim, Target};
use super::{Driver, State};
use crate::material::{Material, Memory};
use crate::real::Real;
use crate::space::SymTensor;
use core::fmt;

/// A law could not be driven on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DriveError {
    /// No strain was found that gives the stress asked for: it may be more than the law bears.
    StressNotFound {
        /// Increment of the leg, from 1.
        increment: usize,
        /// The smallest miss \[Pa\].
        missed_by: f64,
    },
    /// The law answered with a number that is infinite or none.
    NotFinite {
        /// Increment of the leg, from 1.
        increment: usize,
    },
}

impl DriveError {
    pub(super) fn at(mut self, k: usize) -> Self {
        match &mut self {
            Self::StressNotFound { increment, .. } | Self::NotFinite { increment } => *increment = k,
        }
        self
    }
}

impl fmt::Display for DriveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::StressNotFound { increment, missed_by } => write!(
                f,
                "increment {increment}: no strain gives the stress asked for (missed by {missed_by:.3e} Pa): it may be more than the law bears"
            ),
            Self::NotFinite { increment } => {
                write!(f, "increment {increment}: the law's answer is infinite or not a number")
            }
        }
    }
}

impl core::error::Error for DriveError {}

/// Steps of Newton's method before it is given up.
const ITERATIONS: usize = 60;

impl<T: Real, M: Material<T>> Driver<T, M> {
    /// The state after one increment; `guess` is the strain of the one before, and becomes its own.
    pub(super) fn increment(
        &self,
        target: &Target<T>,
        guess: &mut SymTensor<T>,
    ) -> Result<State<T, M::Memory>, DriveError> {
        let stiffness = self.stiffness();
        for (strain, aim) in guess.0.iter_mut().zip(&target.components) {
            if let Aim::Strain(given) = aim {
                *strain = *given;
            }
        }
        let mut best: Option<(T, State<T, M::Memory>, SymTensor<T>)> = None;
        let mut strain = *guess;
        for _ in 0..ITERATIONS {
            let state = self.strained(&strain, &target.turn, target.dt);
            if !(state.memory.is_finite() && state.stress.0.iter().all(|x| x.is_finite())) {
                break;
            }
            let miss = missed(target, &state.stress);
            let size = largest(&miss);
            if best.as_ref().is_none_or(|best| size < best.0) {
                best = Some((size, state, strain));
            }
            // Rounding of a stress this large, and of the strain that makes it.
            let rounding = T::EPSILON * (largest(&state.stress) + stiffness * largest(&strain));
            if size <= rounding {
                break;
            }
            match self.correction(target, &strain, &state.stress, &miss) {
                Some(correction) => strain = strain - correction,
                None => break,
            }
        }
        let (miss, state, strain) = best.ok_or(DriveError::NotFinite { increment: 0 })?;
        let tolerated = T::of(64.0) * T::EPSILON * (largest(&state.stress) + stiffness * largest(&strain));
        if miss > tolerated {
            return Err(DriveError::StressNotFound { increment: 0, missed_by: miss.as_f64() });
        }
        *guess = strain;
        Ok(state)
    }

    /// `ρ̃₀ c²` \[Pa\].
    fn stiffness(&self) -> T {
        let c = self.material.sound_speed();
        self.material.reference_density() * c * c
    }

    /// Newton's correction of the strain, with differences for derivatives; none if there is no
    /// strain that changes the stress as needed.
    fn correction(
        &self,
        target: &Target<T>,
        strain: &SymTensor<T>,
        stress: &SymTensor<T>,
        miss: &SymTensor<T>,
    ) -> Option<SymTensor<T>> {
        let stiffness = self.stiffness();
        let scale = largest(strain).max(largest(miss) / stiffness);
        let step = scale.max(T::EPSILON.sqrt() * largest(stress) / stiffness) * T::EPSILON.powf(T::of(0.25));
        let mut matrix = [[T::ZERO; 6]; 6];
        for (column, aim) in target.components.iter().enumerate() {
            matrix[column][column] = T::ONE;
            if let Aim::Stress(_) = aim {
                let mut moved = *strain;
                moved.0[column] += step;
                let answer = self.strained(&moved, &target.turn, target.dt).stress;
                for (row, aim) in target.components.iter().enumerate() {
                    if let Aim::Stress(_) = aim {
                        matrix[row][column] = (answer.0[row] - stress.0[row]) / (step * stiffness);
                    }
                }
            }
        }
        let inverse = T::inverse(&matrix)?;
        let mut correction = SymTensor::zero();
        for (value, row) in correction.0.iter_mut().zip(&inverse) {
            for (&factor, &miss) in row.iter().zip(&miss.0) {
                *value += factor * (miss / stiffness);
            }
        }
        Some(correction)
    }
}

/// Stress less what is asked for \[Pa\]; zero where strain is given.
fn missed<T: Real>(target: &Target<T>, stress: &SymTensor<T>) -> SymTensor<T> {
    let mut miss = SymTensor::zero();
    for (k, aim) in target.components.iter().enumerate() {
        if let Aim::Stress(asked) = aim {
            miss.0[k] = stress.0[k] - *asked;
        }
    }
    miss
}

fn largest<T: Real>(tensor: &SymTensor<T>) -> T {
    tensor.0.iter().fold(T::ZERO, |most, x| most.max(x.abs()))
}
