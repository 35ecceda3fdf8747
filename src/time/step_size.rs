//! How long a step may be: every limit by name, and which one binds (73).

use crate::error::ParameterError;
use crate::real::Real;
use core::fmt;

/// What can limit a time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Limit {
    /// Sound: `C h/c` (73).
    Acoustic,
    /// Viscosity: `h²/8ν`.
    Viscous,
    /// Acceleration: `¼ √(h/a)`.
    Force,
    /// Explicit drag between soil and water.
    Drag,
    /// Sound of water between grains, from particle to particle: `½ h φ/c`.
    Pores,
    /// The step was given.
    Fixed,
    /// The end of the run, or of an output interval.
    End,
}

impl Limit {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Acoustic => "acoustic",
            Self::Viscous => "viscous",
            Self::Force => "force",
            Self::Drag => "drag",
            Self::Pores => "pores",
            Self::Fixed => "fixed",
            Self::End => "end",
        }
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Every limit of the step \[s\] that a system has at the moment, at Courant number one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<T> {
    /// `h/c`.
    pub acoustic: T,
    /// `h²/8ν`; infinite without viscosity.
    pub viscous: T,
    /// `¼ √(h/a)` with the largest acceleration; infinite at rest.
    pub force: T,
    /// The step at which explicit drag between soil and water turns unstable; infinite without drag, and where it
    /// is solved over the step.
    pub drag: T,
    /// `h φ/c` with the smallest volume fraction of water that shares its space: from particle to particle, where the
    /// pressure the grains bear does not follow, the pores are as stiff as water of the sound speed c/φ. Infinite
    /// without soil, and where pressure acts as printed.
    pub pores: T,
}

impl<T: Real> Limits<T> {
    /// No limit.
    pub fn none() -> Self {
        let none = T::INFINITY;
        Self { acoustic: none, viscous: none, force: none, drag: none, pores: none }
    }
    /// The shorter of each pair.
    pub fn shorter(self, other: Self) -> Self {
        Self {
            acoustic: self.acoustic.min(other.acoustic),
            viscous: self.viscous.min(other.viscous),
            force: self.force.min(other.force),
            drag: self.drag.min(other.drag),
            pores: self.pores.min(other.pores),
        }
    }
    /// The shortest with its name; `courant` scales the acoustic one (73), and half of what drag and pores bear is
    /// taken.
    pub fn binding(&self, courant: T) -> (T, Limit) {
        self.shortest(courant, T::of(0.5))
    }
    /// The step beyond which nothing holds, with the name of what breaks.
    pub fn last(&self) -> (T, Limit) {
        self.shortest(T::ONE, T::ONE)
    }
    fn shortest(&self, courant: T, part: T) -> (T, Limit) {
        let mut best = (courant * self.acoustic, Limit::Acoustic);
        let others = [
            (self.viscous, Limit::Viscous),
            (self.force, Limit::Force),
            (part * self.drag, Limit::Drag),
            (part * self.pores, Limit::Pores),
        ];
        for (limit, name) in others {
            if limit < best.0 {
                best = (limit, name);
            }
        }
        best
    }
}

/// How the step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum StepSize<T> {
    /// As long as the limits allow, with this Courant number in (73).
    Courant(T),
    /// Always this long \[s\].
    Fixed(T),
}

impl<T: Real> StepSize<T> {
    /// As long as the limits allow; the paper takes `C = 0.3`, the library 0.2.
    ///
    /// # Errors
    /// The Courant number is not in (0, 1].
    pub fn courant(number: T) -> Result<Self, ParameterError> {
        if number > T::ZERO && number <= T::ONE {
            Ok(Self::Courant(number))
        } else {
            Err(ParameterError::new("courant", number, "above 0, up to 1"))
        }
    }

    /// Always `dt` \[s\]; a run stops if that is beyond what any Courant number allows, or explicit drag bears.
    ///
    /// # Errors
    /// `dt` is not positive and finite.
    pub fn fixed(dt: T) -> Result<Self, ParameterError> {
        if dt > T::ZERO && dt.is_finite() {
            Ok(Self::Fixed(dt))
        } else {
            Err(ParameterError::new("time_step", dt, "a positive time [s]"))
        }
    }

    /// The step and what it is limited by.
    pub fn choose(&self, limits: &Limits<T>) -> (T, Limit) {
        match *self {
            Self::Courant(number) => limits.binding(number),
            Self::Fixed(dt) => (dt, Limit::Fixed),
        }
    }
}
