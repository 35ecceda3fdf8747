//! Where elasticity ends: a yield surface, and the two ways back to it.

use super::Elasticity;
use crate::real::Real;
use crate::space::SymTensor;
use core::fmt::Debug;

/// Where on a surface a stress was brought to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// It was not outside.
    Inside,
    /// A smooth part.
    Face,
    /// An edge between two smooth parts.
    Edge,
    /// The apex of a cone or a pyramid: nothing but tension is left.
    Apex,
    /// The limit of tension.
    CutOff,
}

/// An admissible stress, and where it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Returned<T> {
    /// The stress \[Pa\].
    pub stress: SymTensor<T>,
    /// Where it lies.
    pub place: Place,
}

impl<T: Real> Returned<T> {
    /// This stress needed no return.
    #[inline(always)]
    pub fn inside(stress: SymTensor<T>) -> Self {
        Self { stress, place: Place::Inside }
    }
    /// Isotropic tension \[Pa\] at the apex.
    pub fn apex(tension: T) -> Self {
        Self { stress: SymTensor::isotropic(tension), place: Place::Apex }
    }
}

/// The normals of a yield function F and of a plastic potential H, both without unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow<T> {
    /// ∂F/∂σ.
    pub normal: SymTensor<T>,
    /// ∂H/∂σ, the direction of plastic strain (24).
    pub direction: SymTensor<T>,
}

impl<T: Real> Flow<T> {
    /// `∂F/∂σ : C : ∂H/∂σ` \[Pa\], the denominator of the plastic multiplier, Eq. (26) with its
    /// indices put right: `2G F_mn H_mn + (K − 2G/3) F_mm H_nn`.
    #[inline(always)]
    pub fn stiffness(&self, elasticity: &Elasticity<T>) -> T {
        self.normal.double_dot(&elasticity.stress(&self.direction)) // (26)
    }

    /// The plastic multiplier λ̇ \[1/s\] that keeps a yielding stress on the surface (25) under a strain
    /// rate \[1/s\], Eq. (26). Never negative: unloading is elastic.
    #[inline(always)]
    pub fn multiplier(&self, elasticity: &Elasticity<T>, stretch: &SymTensor<T>) -> T {
        let stiffness = self.stiffness(elasticity);
        if stiffness > T::ZERO {
            (elasticity.stress(stretch).double_dot(&self.normal) / stiffness).max(T::ZERO) // (26)
        } else {
            T::ZERO
        }
    }
}

/// A yield surface F(σ) = 0 with a plastic potential H, for [`Soil`](super::Soil).
///
/// Stress is positive in tension. Three methods describe a surface; the ways back to it are then
/// found by iteration, and can be given in closed form.
pub trait YieldSurface<T: Real>: Clone + Debug + Send + Sync + 'static {
    /// F \[Pa\]: negative inside, zero on the surface.
    fn excess(&self, stress: &SymTensor<T>) -> T;
    /// ∂F/∂σ and ∂H/∂σ at a stress on the surface or beyond it.
    fn flow(&self, stress: &SymTensor<T>) -> Flow<T>;
    /// The largest isotropic tension allowed \[Pa\]; infinite if there is no limit.
    fn largest_tension(&self) -> T;

    /// Return mapping: the elastic `trial` \[Pa\] less a stress that plastic strain relaxes. Unless
    /// given in closed form, by cutting planes (Simo & Ortiz 1985).
    fn returned(&self, elasticity: &Elasticity<T>, trial: &SymTensor<T>) -> Returned<T> {
        let mut stress = *trial;
        let mut excess = self.excess(&stress);
        let outside = excess > T::ZERO;
        if !outside {
            return untorn(stress, self.largest_tension());
        }
        for _ in 0..CUTS {
            let flow = self.flow(&stress);
            let multiplier = excess / flow.stiffness(elasticity);
            stress = stress - elasticity.stress(&flow.direction) * multiplier;
            excess = self.excess(&stress);
            if excess.abs() <= round_off(&stress) {
                return Returned { stress, place: Place::Face };
            }
        }
        // The planes lead nowhere beyond an apex.
        self.scaled_back(trial)
    }

    /// The paper's correction: tension beyond the largest is removed with all shear, and other stress
    /// loses shear at its pressure. Exact where F grows linearly with the deviator.
    fn scaled_back(&self, stress: &SymTensor<T>) -> Returned<T> {
        let excess = self.excess(stress);
        let mean = stress.trace() * T::of(1.0 / 3.0);
        let sheared = excess > T::ZERO && mean <= self.largest_tension();
        if !sheared {
            return untorn(*stress, self.largest_tension());
        }
        let isotropic = SymTensor::isotropic(mean);
        // At an apex rounding may leave less than none.
        let room = (-self.excess(&isotropic)).max(T::ZERO);
        let scale = room / (room + excess);
        Returned { stress: isotropic + (*stress - isotropic) * scale, place: Place::Face }
    }
}

/// The stress, or the largest tension \[Pa\] if its mean is more than that.
fn untorn<T: Real>(stress: SymTensor<T>, largest_tension: T) -> Returned<T> {
    let torn = stress.trace() * T::of(1.0 / 3.0) > largest_tension;
    if torn { Returned::apex(largest_tension) } else { Returned::inside(stress) }
}

/// Cutting planes before the way back is given up.
const CUTS: usize = 50;

/// Rounding in F of a stress \[Pa\].
#[inline(always)]
fn round_off<T: Real>(stress: &SymTensor<T>) -> T {
    let mean = stress.trace() * T::of(1.0 / 3.0);
    T::of(256.0) * T::EPSILON * (stress.root_j2() + mean.abs())
}

/// No yield surface: soil that stays elastic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unyielding;

impl<T: Real> YieldSurface<T> for Unyielding {
    #[inline(always)]
    fn excess(&self, _: &SymTensor<T>) -> T {
        -T::INFINITY
    }
    fn flow(&self, _: &SymTensor<T>) -> Flow<T> {
        Flow { normal: SymTensor::zero(), direction: SymTensor::zero() }
    }
    fn largest_tension(&self) -> T {
        T::INFINITY
    }
}
