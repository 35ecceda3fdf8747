//! The pair terms of the momentum equations (55), (58): what `j` does to `i`, per unit mass of `j`
//! and per `∇ᵢWᵢⱼ`.

use crate::error::ParameterError;
use crate::real::{Num, Real};

/// Monaghan's artificial viscosity (59)–(61).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ArtificialViscosity<T> {
    /// η₁ \[-\], linear: damps oscillations; acts like a viscosity of about `η₁ h c/8` in 2D, `/10` in 3D.
    pub linear: T,
    /// η₂ \[-\], quadratic: keeps particles from passing through each other.
    pub quadratic: T,
}

impl<T: Real> ArtificialViscosity<T> {
    /// Itself, if both factors are usable.
    pub(super) fn checked(self) -> Result<Self, ParameterError> {
        for (name, value) in
            [("artificial_viscosity.linear", self.linear), ("artificial_viscosity.quadratic", self.quadratic)]
        {
            if !(value >= T::ZERO && value.is_finite()) {
                return Err(ParameterError::new(name, value, "zero or positive"));
            }
        }
        Ok(self)
    }
}

/// The constants of (59)–(61) for particles of one kind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Viscosity<T> {
    linear: T,
    quadratic: T,
    softening: T,
}

impl<T: Real> Viscosity<T> {
    pub(crate) fn new(factors: ArtificialViscosity<T>, h: T, sound_speed: T) -> Self {
        let two = T::of(2.0);
        Self {
            linear: two * factors.linear * sound_speed * h,
            quadratic: two * factors.quadratic * h * h,
            softening: T::of(0.01) * h * h,
        }
    }

    /// Π_ij (59), from [`approach`], `r²` and `ρ_i + ρ_j`: `(−η₁ c̄ μ + η₂ μ²)/ρ̄` with
    /// `μ = h v·x/(r² + 0.01 h²)`.
    #[inline(always)]
    pub(crate) fn pressure<N: Num<Scalar = T>>(&self, approach: N, r2: N, density_sum: N) -> N {
        let range = r2 + N::splat(self.softening);
        let ratio = approach / (range * density_sum); // the only division of a pair
        ratio * (N::splat(self.quadratic) * (ratio * density_sum) - N::splat(self.linear)) // (59)
    }
}

/// `v_ij·x_ij` while the two approach, else 0 (59).
#[inline(always)]
pub(crate) fn approach<N: Num>(v_dot_x: N) -> N {
    v_dot_x.min(N::lit(0.0))
}

/// The same, but 0 too if `grip` is negative.
#[inline(always)]
pub(crate) fn approach_with<N: Num>(v_dot_x: N, grip: N) -> N {
    // Any grip times this exceeds any v·x: the sign alone decides.
    approach(v_dot_x.max(N::lit(-1e20) * grip))
}

/// `p_i φ_i/ρ_i² + p_j φ_j/ρ_j² + Π_ij`: the isotropic part of (55), (58).
#[inline(always)]
pub(crate) fn isotropic<N: Num>(own: N, other: N, artificial: N) -> N {
    own + other + artificial
}
