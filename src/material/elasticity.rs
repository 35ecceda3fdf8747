//! Linear elasticity of a soil skeleton (21)–(23), turning with the material (33)–(35).

use crate::error::ParameterError;
use crate::real::Real;
use crate::space::{SymTensor, Tensor};

/// Isotropic linear elasticity in rate form.
///
/// $$\dot\sigma = 2G\dot e + K\,\dot\epsilon^{\gamma\gamma}I + \omega\sigma - \sigma\omega$$
///
/// with the deviatoric strain rate ė and the spin ω (35): the Jaumann rate (33), which leaves a stress
/// that only turns unchanged in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Elasticity<T> {
    bulk: T,
    shear: T,
}

impl<T: Real> Elasticity<T> {
    /// From Young's modulus E \[Pa\] and Poisson's ratio ν \[-\], Eq. (23).
    ///
    /// # Errors
    /// E is not positive and finite, or ν not in −1 < ν < ½.
    pub fn new(youngs_modulus: T, poissons_ratio: T) -> Result<Self, ParameterError> {
        let (e, nu) = (youngs_modulus, poissons_ratio);
        if !(e > T::ZERO && e.is_finite()) {
            return Err(ParameterError::new("youngs_modulus", e, "a positive modulus [Pa]"));
        }
        if !(nu > -T::ONE && nu < T::of(0.5)) {
            return Err(ParameterError::new("poissons_ratio", nu, "above −1 and below ½"));
        }
        let two = T::of(2.0);
        Ok(Self {
            bulk: e / (T::of(3.0) * (T::ONE - two * nu)), // (23)
            shear: e / (two * (T::ONE + nu)),             // (23)
        })
    }

    /// From bulk modulus K and Poisson's ratio ν, as the paper's tables give them: E = 3K(1 − 2ν).
    ///
    /// # Errors
    /// K is not positive and finite, or ν not in −1 < ν < ½.
    pub fn from_bulk(bulk_modulus: T, poissons_ratio: T) -> Result<Self, ParameterError> {
        if !(bulk_modulus > T::ZERO && bulk_modulus.is_finite()) {
            return Err(ParameterError::new("bulk_modulus", bulk_modulus, "a positive modulus [Pa]"));
        }
        // Poisson's ratio is looked at first: a modulus of its making would blame the wrong one.
        Self::new(T::ONE, poissons_ratio)?;
        let softness = T::of(3.0) * (T::ONE - T::of(2.0) * poissons_ratio);
        Self::new(bulk_modulus * softness, poissons_ratio)
    }

    /// Bulk modulus K \[Pa\].
    pub fn bulk(&self) -> T {
        self.bulk
    }

    /// Shear modulus G \[Pa\].
    pub fn shear(&self) -> T {
        self.shear
    }

    /// Young's modulus E = 9KG/(3K + G) \[Pa\].
    pub fn youngs_modulus(&self) -> T {
        T::of(9.0) * self.bulk * self.shear / (T::of(3.0) * self.bulk + self.shear)
    }

    /// Modulus of a plane compression wave, K + 4G/3 \[Pa\].
    pub fn plane_wave_modulus(&self) -> T {
        self.bulk + self.shear * T::of(4.0 / 3.0)
    }

    /// Lateral over vertical stress without lateral strain, `ν/(1 − ν) = (3K − 2G)/(3K + 4G)` \[-\],
    /// Eq. (76).
    pub fn lateral_ratio(&self) -> T {
        let (k, g) = (T::of(3.0) * self.bulk, self.shear);
        (k - T::of(2.0) * g) / (k + T::of(4.0) * g) // (76)
    }

    /// Stress \[Pa\] of a strain \[-\], `2G e + K ε^γγ I`; of a strain rate, a stress rate.
    #[inline(always)]
    pub fn stress(&self, strain: &SymTensor<T>) -> SymTensor<T> {
        let g2 = self.shear + self.shear;
        let volumetric = (self.bulk - g2 * T::of(1.0 / 3.0)) * strain.trace();
        *strain * g2 + SymTensor::isotropic(volumetric)
    }

    /// Strain \[-\] of a stress \[Pa\]: the inverse of [`stress`](Self::stress).
    #[inline(always)]
    pub fn strain(&self, stress: &SymTensor<T>) -> SymTensor<T> {
        let third = stress.trace() * T::of(1.0 / 3.0);
        let deviator = *stress - SymTensor::isotropic(third);
        let half = T::of(0.5);
        deviator * (half / self.shear) + SymTensor::isotropic(third / (T::of(3.0) * self.bulk))
    }

    /// Stress rate \[Pa/s\] under a velocity gradient \[1/s\] while nothing yields: Eq. (34), together
    /// with the pressure, which does not turn.
    #[inline(always)]
    pub fn stress_rate(&self, velocity_gradient: &Tensor<T>, stress: &SymTensor<T>) -> SymTensor<T> {
        let stretch = velocity_gradient.symmetric();
        stress.turning(&velocity_gradient.spin()) + self.stress(&stretch) // (34)
    }

    /// Stored energy \[J/m³\], `p²/2K + τ:τ/4G`, in double precision.
    pub fn energy(&self, stress: &SymTensor<T>) -> f64 {
        let p = stress.trace().as_f64() / 3.0;
        let tau = stress.root_j2().as_f64();
        0.5 * p * p / self.bulk.as_f64() + 0.5 * tau * tau / self.shear.as_f64()
    }
}
