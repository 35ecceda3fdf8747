//! Smoothing kernels `W(r, h)` and their slopes (38)–(43), (47).
//!
//! A kernel is given by its value `W` and its slope `F = W'/r`, both as functions of `r²`, so that
//! `∇ᵢWᵢⱼ = F xᵢⱼ` (47) needs no division and stays finite at `r = 0`, where superimposed phases meet.
//! All are normalised to unit integral (39) and vanish from `r = κh` on (41).

mod b_spline;
mod wendland;

pub use b_spline::{CubicSpline, QuinticSpline};
pub use wendland::{WendlandC2, WendlandC4, WendlandC6};

use crate::error::ParameterError;
use crate::real::{Num, Real};

/// A smoothing kernel in `D` dimensions.
///
/// `value` and `slope` run in SIMD lanes: mark them `#[inline(always)]` and use no closure in them,
/// else they are compiled for the plain processor and are slow (never wrong).
pub trait Kernel<T: Real, const D: usize>: Clone + core::fmt::Debug + Send + Sync + 'static {
    /// Smoothing length h \[m\].
    fn smoothing_length(&self) -> T;
    /// Support κh \[m\]: `W = 0` for `r ≥ κh`.
    fn support(&self) -> T;
    /// `W` \[m⁻ᴰ\] at squared distance `r2` \[m²\].
    fn value<N: Num<Scalar = T>>(&self, r2: N) -> N;
    /// `F = W'/r` \[m⁻ᴰ⁻²\] at squared distance `r2` \[m²\]; not positive, finite at 0.
    fn slope<N: Num<Scalar = T>>(&self, r2: N) -> N;
}

/// m₂ \[-\] of the kernel: `∫ W x² dV = m₂ h²` along any axis x. By Simpson's rule, to eight digits or better.
pub fn second_moment<T: Real, const D: usize>(kernel: &impl Kernel<T, D>) -> f64 {
    const PANELS: u32 = 2000;
    let (h, support) = (kernel.smoothing_length().as_f64(), kernel.support().as_f64());
    let surface = [2.0, 2.0, 4.0][D - 1] * if D == 1 { 1.0 } else { core::f64::consts::PI };
    let step = support / f64::from(PANELS);
    let at = |n: u32| {
        let r = f64::from(n) * step;
        r.powi(D as i32 + 1) * kernel.value(T::of(r * r)).as_f64()
    };
    let inner: f64 = (1..PANELS).map(|n| at(n) * if n % 2 == 1 { 4.0 } else { 2.0 }).sum();
    surface * (at(0) + inner) * step / 3.0 / (D as f64 * h * h)
}

/// More than any kernel's slope times `h^{D+2}` \[-\].
const STEEPEST: f64 = 1e3;

/// `h` must be positive and finite, and `h^{−D−2}`, the unit of slopes, representable; `D` 1, 2 or 3.
fn checked<T: Real>(h: T, dimension: usize) -> Result<T, ParameterError> {
    let steepest = T::of(STEEPEST / power(h.as_f64(), dimension + 2));
    if !(h > T::ZERO && h.is_finite() && steepest.is_finite()) {
        return Err(ParameterError::new("smoothing_length", h, "a positive length [m]"));
    }
    assert!((1..=3).contains(&dimension), "kernels exist in 1 to 3 dimensions");
    Ok(h)
}

/// The shortest smoothing length \[m\] of kernels in numbers up to `largest`, with a hundredth to spare.
#[cfg(feature = "case")]
pub(crate) fn shortest(largest: f64, dimension: usize) -> f64 {
    1.01 * (STEEPEST / largest).powf(1.0 / (dimension as f64 + 2.0))
}

/// `hᴰ` in double precision.
fn power(h: f64, dimension: usize) -> f64 {
    h.powi(dimension as i32)
}
