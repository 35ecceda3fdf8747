//! Water: a weakly compressible Newtonian fluid (14)–(20).

use super::{Loss, Material};
use crate::error::ParameterError;
use crate::real::Real;
use crate::space::{SymTensor, Tensor};

/// Tait's equation of state (16) with Newtonian viscosity (14).
///
/// $$p = B\left[(\tilde\rho/\tilde\rho_0)^\chi - 1\right],\qquad B = \tilde\rho_0 c^2/\chi,\qquad
/// \tau^{\alpha\beta} = \mu\,\varepsilon^{\alpha\beta}$$
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water<T> {
    reference_density: T,
    sound_speed: T,
    viscosity: T,
    exponent: i32,
    stiffness: T,
    /// The lowest pressure \[Pa\]; −∞ where water bears any suction.
    least: T,
}

impl<T: Real> Water<T> {
    /// Inviscid water with the exponent χ = 7.
    ///
    /// `reference_density` ρ̃₀ \[kg/m³\]; `sound_speed` c \[m/s\], at least ten times the fastest flow,
    /// so that the density varies by about 1 % (18), (19).
    ///
    /// # Errors
    /// A value is not positive and finite.
    pub fn new(reference_density: T, sound_speed: T) -> Result<Self, ParameterError> {
        positive("reference_density", reference_density, "a positive density [kg/m³]")?;
        positive("sound_speed", sound_speed, "a positive speed [m/s]")?;
        let mut water = Self {
            reference_density,
            sound_speed,
            viscosity: T::ZERO,
            exponent: 7,
            stiffness: T::ZERO,
            least: -T::INFINITY,
        };
        water.stiffness = water.tait_stiffness();
        Ok(water)
    }

    /// The same water with dynamic viscosity μ \[Pa·s\].
    ///
    /// # Errors
    /// μ is negative or not finite.
    pub fn with_viscosity(mut self, viscosity: T) -> Result<Self, ParameterError> {
        if !(viscosity >= T::ZERO && viscosity.is_finite()) {
            return Err(ParameterError::new("viscosity", viscosity, "zero or positive [Pa·s]"));
        }
        self.viscosity = viscosity;
        Ok(self)
    }

    /// The same water with exponent χ \[-\] in (16); 1 is a linear equation of state.
    ///
    /// # Errors
    /// χ is not in 1 … 20, or leaves no density at the pressure at which the water cavitates.
    pub fn with_exponent(mut self, exponent: i32) -> Result<Self, ParameterError> {
        if !(1..=20).contains(&exponent) {
            return Err(ParameterError::new("tait_exponent", exponent, "a whole number from 1 to 20"));
        }
        self.exponent = exponent;
        self.stiffness = self.tait_stiffness();
        if self.least.is_finite() { self.with_cavitation(self.least) } else { Ok(self) }
    }

    /// The same water, which cavitates at the pressure `least` \[Pa\] above the air's: −101 325 where water boils
    /// in a vacuum, 0 where it bears no suction. By default it bears any.
    ///
    /// Thinner water keeps that pressure: it is two-phase and has no sound. Filling the cavity takes back the
    /// work against it, so that nothing is lost: the energy is among the compressive.
    ///
    /// # Errors
    /// The pressure is positive, or not above −B (17), which no density has.
    pub fn with_cavitation(mut self, least: T) -> Result<Self, ParameterError> {
        if !(least <= T::ZERO && least > -self.stiffness) {
            let allowed = "above −ρ̃₀c²/χ, up to 0 [Pa]";
            return Err(ParameterError::new("cavitation_pressure", least, allowed));
        }
        self.least = least;
        Ok(self)
    }

    /// The pressure \[Pa\] at which it cavitates; −∞ if it bears any suction.
    pub fn cavitation(&self) -> T {
        self.least
    }

    /// B = ρ̃₀ c²/χ \[Pa\] (17).
    fn tait_stiffness(&self) -> T {
        self.reference_density * self.sound_speed * self.sound_speed / T::of(f64::from(self.exponent))
    }

    /// Dynamic viscosity μ \[Pa·s\].
    pub fn viscosity(&self) -> T {
        self.viscosity
    }

    /// The exponent χ \[-\].
    pub fn exponent(&self) -> i32 {
        self.exponent
    }

    /// B \[Pa\] of (16).
    pub fn stiffness(&self) -> T {
        self.stiffness
    }
}

fn positive<T: Real>(name: &'static str, value: T, allowed: &'static str) -> Result<(), ParameterError> {
    if value > T::ZERO && value.is_finite() { Ok(()) } else { Err(ParameterError::new(name, value, allowed)) }
}

/// `(1 + e)^exponent − 1`.
#[inline(always)]
fn power<T: Real>(e: T, exponent: i32) -> T {
    let mut excess = e;
    for _ in 1..exponent {
        excess = excess * (T::ONE + e) + e;
    }
    excess
}

impl<T: Real> Material<T> for Water<T> {
    type Memory = ();

    fn reference_density(&self) -> T {
        self.reference_density
    }

    fn sound_speed(&self) -> T {
        self.sound_speed
    }

    /// (16), (20), written as `B [(1 + e)^χ − 1]` with `(1 + e)^{k+1} − 1 = ((1 + e)^k − 1)(1 + e) + e`:
    /// exact near `e = 0`, where `f32` would lose the pressure in the power.
    #[inline(always)]
    fn pressure(&self, compression: T, (): &()) -> T {
        // The usual exponent is told apart, so that loops over particles become vector code.
        let excess =
            if self.exponent == 7 { power(compression, 7) } else { power(compression, self.exponent) };
        let p = self.stiffness * excess; // (16)
        // What is not a number stays none.
        if p < self.least { self.least } else { p }
    }

    fn least_pressure(&self) -> T {
        self.least
    }

    /// `(p/B + 1)^{1/χ} − 1`, the compression in (74).
    fn compression(&self, pressure: T) -> T {
        // Suction beyond −B has no density; the emptiest state is full expansion.
        let ratio = (pressure / self.stiffness).max(T::of(-1.0) + T::EPSILON);
        (ratio.ln_1p() / T::of(f64::from(self.exponent))).exp_m1()
    }

    /// From `dp = ρ̃ d(g·x)` and `dp/dρ̃ = c² (ρ̃/ρ̃₀)^{χ−1}`: `d(ρ̃/ρ̃₀)/d(g·x) = (1 + e)^{2−χ}/c²`.
    fn hydrostatic_slope(&self) -> (T, T) {
        (T::ONE / (self.sound_speed * self.sound_speed), T::of(f64::from(2 - self.exponent)))
    }

    fn needs_velocity_gradient(&self) -> bool {
        self.viscosity > T::ZERO
    }

    /// (14), (15): `τ = μ ε`, `ε = ∂v^β/∂x^α + ∂v^α/∂x^β − ⅔ ∂v^γ/∂x^γ δ`, which is twice the
    /// deviatoric strain rate.
    fn deviator(&self, velocity_gradient: &Tensor<T>, (): &()) -> SymTensor<T> {
        velocity_gradient.symmetric().deviator() * (T::of(2.0) * self.viscosity)
    }

    fn rate(&self, _: &Tensor<T>, (): &()) {}

    fn admit(&self, (): ()) -> ((), Loss<T>) {
        ((), Loss::none())
    }

    fn kinematic_viscosity(&self) -> T {
        self.viscosity / self.reference_density
    }

    /// `∫ p/ρ̃² dρ̃ = (B/ρ̃₀) [(X^{χ−1} − 1)/(χ − 1) + 1/X − 1]`, `X = ρ̃/ρ̃₀`; of cavitating water what it stores where
    /// that begins, at X_c, and `(p_c/ρ̃₀) (1/X_c − 1/X)`.
    fn stored_energy(&self, compression: T, (): &()) -> f64 {
        let at_least = if self.least.is_finite() { self.compression(self.least) } else { compression };
        let dense = if compression < at_least { at_least } else { compression };
        let x = 1.0 + dense.as_f64();
        let opened = if compression < at_least {
            self.least.as_f64() / self.reference_density.as_f64()
                * (1.0 / x - 1.0 / (1.0 + compression.as_f64()))
        } else {
            0.0
        };
        let n = self.exponent - 1;
        let work = if n == 0 { x.ln() } else { (x.powi(n) - 1.0) / f64::from(n) };
        self.stiffness.as_f64() / self.reference_density.as_f64() * (work + 1.0 / x - 1.0) + opened
    }
}
