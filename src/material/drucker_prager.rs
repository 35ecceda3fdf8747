//! The yield surface of Drucker and Prager (27)–(29).

use super::Elasticity;
use super::mohr_coulomb::{allowed_angles, allowed_cohesion};
use super::yield_surface::{Flow, Place, Returned, YieldSurface};
use crate::error::ParameterError;
use crate::real::Real;
use crate::space::SymTensor;

/// In which states the cone meets the pyramid of Mohr and Coulomb.
///
/// `α_θ` of (27) for a friction angle θ and a dilatancy angle ψ, and `k_c` for a cohesion c. The
/// dilatancy `α_ψ` follows from ψ by the same state's formula.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Cone {
    /// Plane strain at failure, for θ and ψ together: (29) if ψ = θ, `sin θ / 3` if ψ = 0.
    #[default]
    PlaneStrain,
    /// (29), as printed: plane strain *if* the flow is associated, ψ = θ.
    PlaneStrainAssociated,
    /// `α = sin θ / 3`, `k_c = c cos θ`: plane strain *if* ψ = 0.
    PlaneStrainNonDilatant,
    /// `α = 2 sin θ / √3(3 − sin θ)`: axial compression, for three dimensions.
    TriaxialCompression,
    /// `α = 2 sin θ / √3(3 + sin θ)`: axial extension.
    TriaxialExtension,
}

impl Cone {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::PlaneStrain,
        Self::PlaneStrainAssociated,
        Self::PlaneStrainNonDilatant,
        Self::TriaxialCompression,
        Self::TriaxialExtension,
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::PlaneStrain => "plane strain",
            Self::PlaneStrainAssociated => "plane strain, associated",
            Self::PlaneStrainNonDilatant => "plane strain, non-dilatant",
            Self::TriaxialCompression => "triaxial compression",
            Self::TriaxialExtension => "triaxial extension",
        }
    }

    /// `α_θ` and `k_c` per unit of cohesion, both without unit, at the angles θ and ψ \[rad\].
    pub fn constants(self, friction: f64, dilatancy: f64) -> (f64, f64) {
        let (sin, cos) = friction.sin_cos();
        let triaxial = |sign: f64| {
            let width = 3.0_f64.sqrt() * (3.0 - sign * sin);
            (2.0 * sin / width, 6.0 * cos / width)
        };
        match self {
            Self::PlaneStrain => {
                // ε̇_zz = 0 fixes τ_zz = −2 α_ψ √J₂; what is left in the plane obeys Mohr–Coulomb.
                let a = plane_strain(dilatancy);
                let width = (1.0 - 3.0 * a * a).sqrt() + a * sin;
                (sin / (3.0 * width), cos / width)
            }
            Self::PlaneStrainAssociated => {
                let width = (9.0 + 12.0 * friction.tan().powi(2)).sqrt();
                (plane_strain(friction), 3.0 / width)
            }
            Self::PlaneStrainNonDilatant => (sin / 3.0, cos),
            Self::TriaxialCompression => triaxial(1.0),
            Self::TriaxialExtension => triaxial(-1.0),
        }
    }

    /// `α_ψ` \[-\] of the plastic potential at the dilatancy angle ψ \[rad\].
    pub fn dilatancy(self, dilatancy: f64) -> f64 {
        match self {
            Self::TriaxialCompression | Self::TriaxialExtension => self.constants(dilatancy, dilatancy).0,
            _ => plane_strain(dilatancy),
        }
    }
}

/// `tan θ / √(9 + 12 tan² θ)`, Eq. (29).
fn plane_strain(angle: f64) -> f64 {
    angle.tan() / (9.0 + 12.0 * angle.tan().powi(2)).sqrt() // (29)
}

/// A circular cone about the hydrostatic axis, Eq. (27), and a potential of the same form.
///
/// $$F = \sqrt{J_2} + \alpha_\theta I_1 - k_c,\qquad H = \sqrt{J_2} + \alpha_\psi I_1$$
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DruckerPrager<T> {
    friction: T,
    dilatancy: T,
    cohesion: T,
    largest_tension: T,
}

impl<T: Real> DruckerPrager<T> {
    /// From the friction angle θ and the dilatancy angle ψ \[rad\], without cohesion.
    ///
    /// # Errors
    /// θ is not in 0 < θ < π/2, or ψ not in 0 ≤ ψ ≤ θ.
    pub fn new(cone: Cone, friction: T, dilatancy: T) -> Result<Self, ParameterError> {
        Self::cohesive(cone, friction, dilatancy, T::ZERO)
    }

    /// From θ, ψ \[rad\] and the cohesion c \[Pa\] of Mohr and Coulomb.
    ///
    /// # Errors
    /// θ is not in 0 ≤ θ < π/2, ψ not in 0 ≤ ψ ≤ θ, c negative or not finite, or θ and c both zero.
    pub fn cohesive(cone: Cone, friction: T, dilatancy: T, c: T) -> Result<Self, ParameterError> {
        allowed_angles(friction, dilatancy)?;
        allowed_cohesion(c, friction)?;
        let (theta, psi) = (friction.as_f64(), dilatancy.as_f64());
        let (alpha, factor) = cone.constants(theta, psi);
        Self::from_constants(T::of(alpha), T::of(cone.dilatancy(psi)), T::of(factor) * c)
    }

    /// From `α_θ`, `α_ψ` \[-\] and `k_c` \[Pa\] of (27) themselves.
    ///
    /// # Errors
    /// One of them is negative or not finite, or `α_θ` and `k_c` are both zero.
    pub fn from_constants(friction: T, dilatancy: T, cohesion: T) -> Result<Self, ParameterError> {
        let given = [("friction", friction), ("dilatancy", dilatancy), ("cohesion", cohesion)];
        for (name, value) in given {
            if !(value >= T::ZERO && value.is_finite()) {
                return Err(ParameterError::new(name, value, "zero or positive"));
            }
        }
        if friction == T::ZERO && cohesion == T::ZERO {
            return Err(ParameterError::new("cohesion", cohesion, "positive without friction [Pa]"));
        }
        let apex = if friction > T::ZERO { cohesion / (T::of(3.0) * friction) } else { T::INFINITY };
        Ok(Self { friction, dilatancy, cohesion, largest_tension: apex })
    }

    /// The same cone, cut where the mean stress exceeds this tension \[Pa\].
    ///
    /// # Errors
    /// It is negative or not a number.
    pub fn with_tension_cut_off(mut self, tension: T) -> Result<Self, ParameterError> {
        let allowed = tension >= T::ZERO;
        if !allowed {
            return Err(ParameterError::new("tension_cut_off", tension, "zero or positive [Pa]"));
        }
        self.largest_tension = self.largest_tension.min(tension);
        Ok(self)
    }

    /// `α_θ` \[-\].
    pub fn friction(&self) -> T {
        self.friction
    }

    /// `α_ψ` \[-\].
    pub fn dilatancy(&self) -> T {
        self.dilatancy
    }

    /// `k_c` \[Pa\].
    pub fn cohesion(&self) -> T {
        self.cohesion
    }

    /// The largest `√J₂` \[Pa\] at a pressure \[Pa\].
    #[inline(always)]
    fn strength(&self, pressure: T) -> T {
        self.cohesion + T::of(3.0) * self.friction * pressure // (27)
    }

    /// Whether the limit of tension is the cone's own apex.
    fn ends_in_apex(&self) -> bool {
        self.strength(-self.largest_tension) <= T::of(16.0) * T::EPSILON * self.cohesion
    }

    /// What is left where tension ends: the shear the cone bears there, at most `shear` \[Pa\].
    fn cut(&self, deviator: &SymTensor<T>, shear: T) -> Returned<T> {
        let tension = self.largest_tension;
        if self.ends_in_apex() {
            return Returned::apex(tension);
        }
        let limit = self.strength(-tension);
        let scale = if shear > limit { limit / shear } else { T::ONE };
        Returned { stress: *deviator * scale + SymTensor::isotropic(tension), place: Place::CutOff }
    }
}

impl<T: Real> YieldSurface<T> for DruckerPrager<T> {
    /// (27), or by how much the mean stress exceeds the largest tension.
    #[inline(always)]
    fn excess(&self, stress: &SymTensor<T>) -> T {
        let mean = stress.trace() * T::of(1.0 / 3.0);
        let cone = stress.root_j2() - self.strength(-mean); // (27)
        cone.max(mean - self.largest_tension)
    }

    /// Of the cone: `∂F/∂σ = α_θ I + τ/2√J₂`, without its last term where there is no shear: what rounding
    /// leaves of it at the apex has no direction.
    #[inline(always)]
    fn flow(&self, stress: &SymTensor<T>) -> Flow<T> {
        let (tau, shear) = (stress.deviator(), stress.root_j2());
        let none = T::of(4.0) * T::EPSILON * stress.trace().abs();
        let along = if shear > none { tau * (T::of(0.5) / shear) } else { SymTensor::zero() };
        Flow {
            normal: along + SymTensor::isotropic(self.friction),
            direction: along + SymTensor::isotropic(self.dilatancy),
        }
    }

    fn largest_tension(&self) -> T {
        self.largest_tension
    }

    /// Radial return, in closed form: `Δλ = F/(G + 9 α_θ α_ψ K)`, the pressure rises by
    /// `3 α_ψ K Δλ`, the deviator shrinks by `G Δλ` to what the cone bears there; beyond, the apex.
    #[inline(always)]
    fn returned(&self, elasticity: &Elasticity<T>, trial: &SymTensor<T>) -> Returned<T> {
        let (k, g) = (elasticity.bulk(), elasticity.shear());
        let mean = trial.trace() * T::of(1.0 / 3.0);
        let deviator = *trial - SymTensor::isotropic(mean);
        let shear = (deviator.double_dot(&deviator) * T::of(0.5)).sqrt(); // (28)
        let excess = shear - self.strength(-mean); // (27)
        let outside = excess > T::ZERO;
        if !outside {
            let torn = mean > self.largest_tension;
            return if torn { self.cut(&deviator, shear) } else { Returned::inside(*trial) };
        }
        let multiplier = excess / (g + T::of(9.0) * self.friction * self.dilatancy * k); // (36)
        let pressure = T::of(3.0) * self.dilatancy * k * multiplier - mean; // (31)
        // Without shear only rounding at the apex is outside.
        if -pressure > self.largest_tension || shear == T::ZERO {
            return self.cut(&deviator, shear);
        }
        // √J₂ − G Δλ, from the cone itself: a trial far outside leaves no rounding behind.
        let scale = self.strength(pressure).max(T::ZERO) / shear; // (32)
        Returned { stress: deviator * scale - SymTensor::isotropic(pressure), place: Place::Face }
    }

    /// Tension cracking, then `r = (k_c − α_θ I₁)/√J₂` times the deviator.
    #[inline(always)]
    fn scaled_back(&self, stress: &SymTensor<T>) -> Returned<T> {
        let mean = stress.trace() * T::of(1.0 / 3.0);
        let deviator = *stress - SymTensor::isotropic(mean);
        let shear = (deviator.double_dot(&deviator) * T::of(0.5)).sqrt(); // (28)
        if mean > self.largest_tension {
            return self.cut(&deviator, shear);
        }
        let strength = self.strength(-mean).max(T::ZERO);
        let outside = shear > strength;
        if !outside {
            return Returned::inside(*stress);
        }
        let stress = deviator * (strength / shear) + SymTensor::isotropic(mean);
        Returned { stress, place: Place::Face }
    }
}
