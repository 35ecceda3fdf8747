//! The numbers everything is written in: [`Num`], the alphabet of a formula (a number or its SIMD
//! lanes), and [`Real`], the two precisions `f32` and `f64`.

use core::fmt::{Debug, Display, LowerExp};
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};
use num_traits::Float;

pub(crate) mod sealed {
    /// Closes [`super::Num`] and [`super::Real`] to other crates, so that methods can be added.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A number, or several side by side in SIMD lanes: what a pair formula is written in.
///
/// `max` and `min` follow the rule of the machine instruction, `a > b ? a : b`, for scalars too, so
/// that lanes and scalars give the same bits.
pub trait Num:
    sealed::Sealed
    + Copy
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// The number in each lane.
    type Scalar: Real;
    /// The same number in every lane.
    fn splat(x: Self::Scalar) -> Self;
    /// Square root, exact to rounding.
    fn sqrt(self) -> Self;
    /// The larger of the two; the second one if they do not compare.
    fn max(self, other: Self) -> Self;
    /// The smaller of the two; the second one if they do not compare.
    fn min(self, other: Self) -> Self;
    /// A constant of a formula, rounded to the precision in use.
    #[inline(always)]
    fn lit(x: f64) -> Self {
        Self::splat(Self::Scalar::of(x))
    }
}

/// A floating-point precision: `f32` or `f64`. Sealed; the only source of float methods.
#[expect(
    private_bounds,
    reason = "lane types stay inside: naming them would let safe code reach instructions the processor may lack"
)]
pub trait Real:
    Num<Scalar = Self>
    + crate::lanes::Lanes
    + crate::lanes::Vectors
    + crate::space::Dense
    + num_traits::FromPrimitive
    + num_traits::ToPrimitive
    + PartialOrd
    + Default
    + Debug
    + Display
    + LowerExp
    + core::str::FromStr
{
    /// `"f32"` or `"f64"`.
    const NAME: &'static str;
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// Distance from one to the next number.
    const EPSILON: Self;
    /// Positive infinity.
    const INFINITY: Self;
    /// The nearest number to `x`.
    fn of(x: f64) -> Self;
    /// The same value in double precision.
    fn as_f64(self) -> f64;
    /// The bits, widened: for hashing a state and comparing it exactly.
    fn bits(self) -> u64;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self` to a real power.
    fn powf(self, exponent: Self) -> Self;
    /// `self` to an integer power.
    fn powi(self, exponent: i32) -> Self;
    /// `e^self`.
    fn exp(self) -> Self;
    /// `e^self − 1`, accurate near zero.
    fn exp_m1(self) -> Self;
    /// `ln(1 + self)`, accurate near zero.
    fn ln_1p(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Sine of an angle in radians.
    fn sin(self) -> Self;
    /// Cosine of an angle in radians.
    fn cos(self) -> Self;
    /// Tangent of an angle in radians.
    fn tan(self) -> Self;
    /// Largest integer not above `self`.
    fn floor(self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
}

macro_rules! real {
    ($t:ident) => {
        impl Num for $t {
            type Scalar = $t;
            #[inline(always)]
            fn splat(x: $t) -> $t {
                x
            }
            #[inline(always)]
            fn sqrt(self) -> $t {
                $t::sqrt(self)
            }
            #[inline(always)]
            fn max(self, other: $t) -> $t {
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn min(self, other: $t) -> $t {
                if self < other { self } else { other }
            }
        }

        impl Real for $t {
            const NAME: &'static str = stringify!($t);
            const ZERO: $t = 0.0;
            const ONE: $t = 1.0;
            const EPSILON: $t = $t::EPSILON;
            const INFINITY: $t = $t::INFINITY;
            #[inline(always)]
            fn of(x: f64) -> $t {
                x as $t
            }
            #[inline(always)]
            fn as_f64(self) -> f64 {
                f64::from(self)
            }
            fn bits(self) -> u64 {
                u64::from(self.to_bits())
            }
            #[inline(always)]
            fn abs(self) -> $t {
                Float::abs(self)
            }
            fn powf(self, exponent: $t) -> $t {
                Float::powf(self, exponent)
            }
            fn powi(self, exponent: i32) -> $t {
                Float::powi(self, exponent)
            }
            fn exp(self) -> $t {
                Float::exp(self)
            }
            fn exp_m1(self) -> $t {
                Float::exp_m1(self)
            }
            fn ln_1p(self) -> $t {
                Float::ln_1p(self)
            }
            fn ln(self) -> $t {
                Float::ln(self)
            }
            fn sin(self) -> $t {
                Float::sin(self)
            }
            fn cos(self) -> $t {
                Float::cos(self)
            }
            fn tan(self) -> $t {
                Float::tan(self)
            }
            #[inline(always)]
            fn floor(self) -> $t {
                Float::floor(self)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                Float::is_finite(self)
            }
        }
    };
}
real!(f32);
real!(f64);
