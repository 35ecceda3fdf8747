//! B-splines: cubic (support 2h) and quintic (support 3h), written branch-free for SIMD lanes.

use super::{Kernel, checked, power};
use crate::error::ParameterError;
use crate::real::{Num, Real};
use core::f64::consts::PI;

macro_rules! spline {
    ($(#[$doc:meta])* $name:ident, $kappa:literal, $one:expr, $two:expr, $three:expr, $value:expr, $slope:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<T, const D: usize> {
            h: T,
            inverse_h: T,
            value_factor: T,
            slope_factor: T,
        }

        impl<T: Real, const D: usize> $name<T, D> {
            /// The kernel with smoothing length `h` \[m\].
            ///
            /// # Errors
            /// `h` is not positive and finite.
            pub fn new(h: T) -> Result<Self, ParameterError> {
                let length = checked(h, D)?.as_f64();
                let alpha = [$one, $two, $three][D - 1] / power(length, D);
                Ok(Self {
                    h,
                    inverse_h: T::of(1.0 / length),
                    value_factor: T::of(alpha),
                    slope_factor: T::of(alpha / (length * length)),
                })
            }
        }

        impl<T: Real, const D: usize> Kernel<T, D> for $name<T, D> {
            fn smoothing_length(&self) -> T {
                self.h
            }
            fn support(&self) -> T {
                self.h * T::of($kappa)
            }
            #[inline(always)]
            fn value<N: Num<Scalar = T>>(&self, r2: N) -> N {
                N::splat(self.value_factor) * $value(r2.sqrt() * N::splat(self.inverse_h))
            }
            #[inline(always)]
            fn slope<N: Num<Scalar = T>>(&self, r2: N) -> N {
                N::splat(self.slope_factor) * $slope(r2.sqrt() * N::splat(self.inverse_h))
            }
        }
    };
}

/// `max(0, a − q)`.
#[inline(always)]
fn above<N: Num>(a: f64, q: N) -> N {
    (N::lit(a) - q).max(N::lit(0.0))
}

#[inline(always)]
fn cubic_value<N: Num>(q: N) -> N {
    let (two, one) = (above(2.0, q), above(1.0, q));
    N::lit(0.25) * (two * two * two) - one * one * one
}

/// `¼ d/dq[(2−q)³₊ − 4(1−q)³₊] / q`; below `q = 1` the division is carried out: `−¾ (4 − 3q)`.
#[inline(always)]
fn cubic_slope<N: Num>(q: N) -> N {
    let (two, one) = (above(2.0, q.max(N::lit(1.0))), above(1.0, q));
    N::lit(-0.75) * (two * two / q.max(N::lit(1.0)) + N::lit(3.0) * one)
}

#[inline(always)]
fn quintic_value<N: Num>(q: N) -> N {
    let (three, two, one) = (above(3.0, q), above(2.0, q), above(1.0, q));
    let (three2, two2, one2) = (three * three, two * two, one * one);
    three2 * three2 * three - N::lit(6.0) * (two2 * two2 * two) + N::lit(15.0) * (one2 * one2 * one)
}

/// `d/dq[(3−q)⁵₊ − 6(2−q)⁵₊ + 15(1−q)⁵₊] / q`; below `q = 1` the division is carried out:
/// `−5 (24 − 24q² + 10q³)`.
#[inline(always)]
fn quintic_slope<N: Num>(q: N) -> N {
    let (outer, inner) = (q.max(N::lit(1.0)), q.min(N::lit(1.0)));
    let (three, two) = (above(3.0, outer), above(2.0, outer));
    let (three2, two2) = (three * three, two * two);
    let tail = (three2 * three2 - N::lit(6.0) * (two2 * two2)) / outer;
    let core = N::lit(14.0) + inner * inner * (N::lit(10.0) * inner - N::lit(24.0));
    N::lit(-5.0) * (tail + core)
}

spline!(
    /// Cubic B-spline M₄: `W = α [¼(2 − q)³₊ − (1 − q)³₊]`, `q = r/h < 2`;
    /// `α = 2/3h`, `10/7πh²`, `1/πh³`.
    CubicSpline, 2.0, 2.0 / 3.0, 10.0 / (7.0 * PI), 1.0 / PI, cubic_value, cubic_slope
);
spline!(
    /// Quintic B-spline M₆: `W = α [(3 − q)⁵₊ − 6(2 − q)⁵₊ + 15(1 − q)⁵₊]`, `q = r/h < 3`;
    /// `α = 1/120h`, `7/478πh²`, `1/120πh³`.
    QuinticSpline, 3.0, 1.0 / 120.0, 7.0 / (478.0 * PI), 1.0 / (120.0 * PI), quintic_value, quintic_slope
);
