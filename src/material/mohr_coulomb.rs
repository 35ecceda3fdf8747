//! The yield surface of Mohr and Coulomb, with its edges and its apex.

use super::Elasticity;
use super::yield_surface::{Flow, Place, Returned, YieldSurface};
use crate::error::ParameterError;
use crate::real::Real;
use crate::space::{Principal, SymTensor};

/// The six-sided pyramid of Mohr and Coulomb in principal stresses σ₁ ≥ σ₂ ≥ σ₃.
///
/// $$F = \tfrac12(\sigma_1-\sigma_3) + \tfrac12(\sigma_1+\sigma_3)\sin\theta - c\cos\theta,\qquad
/// H = \tfrac12(\sigma_1-\sigma_3) + \tfrac12(\sigma_1+\sigma_3)\sin\psi$$
///
/// The return goes to a face, to one of its two edges, or to the apex, each in closed form (de Souza
/// Neto, Perić & Owen 2008, section 8.2).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MohrCoulomb<T> {
    sin_friction: T,
    sin_dilatancy: T,
    strength: T,
    largest_tension: T,
}

impl<T: Real> MohrCoulomb<T> {
    /// From the friction angle θ and the dilatancy angle ψ \[rad\], without cohesion.
    ///
    /// # Errors
    /// θ is not in 0 < θ < π/2, or ψ not in 0 ≤ ψ ≤ θ.
    pub fn new(friction: T, dilatancy: T) -> Result<Self, ParameterError> {
        Self::cohesive(friction, dilatancy, T::ZERO)
    }

    /// From θ, ψ \[rad\] and the cohesion c \[Pa\].
    ///
    /// # Errors
    /// θ is not in 0 ≤ θ < π/2, ψ not in 0 ≤ ψ ≤ θ, c negative or not finite, or θ and c both zero.
    pub fn cohesive(friction: T, dilatancy: T, cohesion: T) -> Result<Self, ParameterError> {
        allowed_angles(friction, dilatancy)?;
        allowed_cohesion(cohesion, friction)?;
        let (sin_friction, strength) = (friction.sin(), cohesion * friction.cos());
        let largest_tension = if sin_friction > T::ZERO { strength / sin_friction } else { T::INFINITY };
        Ok(Self { sin_friction, sin_dilatancy: dilatancy.sin(), strength, largest_tension })
    }

    /// sin θ \[-\].
    pub fn sin_friction(&self) -> T {
        self.sin_friction
    }

    /// F \[Pa\] between a larger and a smaller principal stress.
    fn between(&self, larger: T, smaller: T) -> T {
        let half = T::of(0.5);
        half * (larger - smaller) + half * (larger + smaller) * self.sin_friction - self.strength
    }

    /// The larger principal stress that yields with a smaller one \[Pa\].
    fn partner(&self, smaller: T) -> T {
        let s = self.sin_friction;
        (smaller * (T::ONE - s) + T::of(2.0) * self.strength) / (T::ONE + s)
    }

    /// Principal stresses after the return to the face, or the trial's if that is not where it goes.
    fn face(&self, relief: &Relief<T>, trial: [T; 3]) -> Option<[T; 3]> {
        let multiplier = self.between(trial[0], trial[2]) / relief.own;
        let third = trial[2] + relief.smallest * multiplier;
        let stress = [self.partner(third), trial[1] - relief.middle * multiplier, third];
        (stress[0] >= stress[1] && stress[1] >= stress[2]).then_some(stress)
    }

    /// Principal stresses after the return to an edge, where σ₂ = σ₃ (`lower`) or σ₁ = σ₂.
    fn edge(&self, relief: &Relief<T>, trial: [T; 3], lower: bool) -> Option<[T; 3]> {
        let first = self.between(trial[0], trial[2]);
        let (second, cross) = match lower {
            true => (self.between(trial[0], trial[1]), relief.lower),
            false => (self.between(trial[1], trial[2]), relief.upper),
        };
        let determinant = relief.own * relief.own - cross * cross;
        let a = (first * relief.own - second * cross) / determinant;
        let b = (second * relief.own - first * cross) / determinant;
        let third = match lower {
            true => trial[2] + relief.smallest * a - relief.middle * b,
            false => trial[2] + relief.smallest * (a + b),
        };
        let largest = self.partner(third);
        let middle = if lower { third } else { largest };
        (largest >= third).then_some([largest, middle, third])
    }
}

/// How a multiplier of one relieves the principal stresses, and F of each plane \[Pa\].
struct Relief<T> {
    /// σ₂ falls by it.
    middle: T,
    /// σ₃ rises by it.
    smallest: T,
    /// F of the plane itself falls by it.
    own: T,
    /// F of the other plane falls by it at the edge σ₂ = σ₃.
    lower: T,
    /// The same at the edge σ₁ = σ₂.
    upper: T,
}

impl<T: Real> Relief<T> {
    fn of(surface: &MohrCoulomb<T>, elasticity: &Elasticity<T>) -> Self {
        let (k, g) = (elasticity.bulk(), elasticity.shear());
        let (s, d) = (surface.sin_friction, surface.sin_dilatancy);
        let (third, one) = (T::of(1.0 / 3.0), T::ONE);
        Self {
            middle: (k - T::of(2.0) * third * g) * d,
            smallest: g * (one - d * third) - k * d,
            own: g * (one + s * d * third) + k * s * d,
            lower: T::of(0.5) * g * (one + s + d - s * d * third) + k * s * d,
            upper: T::of(0.5) * g * (one - s - d - s * d * third) + k * s * d,
        }
    }
}

impl<T: Real> YieldSurface<T> for MohrCoulomb<T> {
    /// Not a number for a stress that is not finite.
    fn excess(&self, stress: &SymTensor<T>) -> T {
        match Principal::of(stress) {
            Some(principal) => self.between(principal.values[0], principal.values[2]),
            None => T::of(f64::NAN),
        }
    }

    /// Of the face; on an edge, of one of the two.
    fn flow(&self, stress: &SymTensor<T>) -> Flow<T> {
        let Some(principal) = Principal::of(stress) else {
            return Flow { normal: SymTensor::zero(), direction: SymTensor::zero() };
        };
        let half = T::of(0.5);
        let along = |sin: T| principal.with(&[half * (T::ONE + sin), T::ZERO, half * (sin - T::ONE)]);
        Flow { normal: along(self.sin_friction), direction: along(self.sin_dilatancy) }
    }

    fn largest_tension(&self) -> T {
        self.largest_tension
    }

    fn returned(&self, elasticity: &Elasticity<T>, trial: &SymTensor<T>) -> Returned<T> {
        let Some(principal) = Principal::of(trial) else { return Returned::inside(*trial) };
        let values = principal.values;
        let outside = self.between(values[0], values[2]) > T::ZERO;
        if !outside {
            return Returned::inside(*trial);
        }
        let relief = Relief::of(self, elasticity);
        if let Some(face) = self.face(&relief, values) {
            return Returned { stress: principal.with(&face), place: Place::Face };
        }
        let d = self.sin_dilatancy;
        let side = (T::ONE - d) * values[0] - T::of(2.0) * values[1] + (T::ONE + d) * values[2];
        match self.edge(&relief, values, side > T::ZERO) {
            Some(edge) => Returned { stress: principal.with(&edge), place: Place::Edge },
            None => Returned::apex(self.largest_tension),
        }
    }
}

/// Friction and dilatancy angles θ, ψ \[rad\] that make sense.
pub(super) fn allowed_angles<T: Real>(friction: T, dilatancy: T) -> Result<(), ParameterError> {
    if !(friction >= T::ZERO && friction < T::of(core::f64::consts::FRAC_PI_2)) {
        return Err(ParameterError::new("friction_angle", friction, "from 0 to below π/2 [rad]"));
    }
    if !(dilatancy >= T::ZERO && dilatancy <= friction) {
        return Err(ParameterError::new("dilatancy_angle", dilatancy, "from 0 to the friction angle [rad]"));
    }
    Ok(())
}

/// A cohesion c \[Pa\] that makes sense: there is some if there is no friction.
pub(super) fn allowed_cohesion<T: Real>(cohesion: T, friction: T) -> Result<(), ParameterError> {
    if !(cohesion >= T::ZERO && cohesion.is_finite()) {
        return Err(ParameterError::new("cohesion", cohesion, "zero or positive [Pa]"));
    }
    if cohesion == T::ZERO && friction == T::ZERO {
        return Err(ParameterError::new("cohesion", cohesion, "positive without friction [Pa]"));
    }
    Ok(())
}
