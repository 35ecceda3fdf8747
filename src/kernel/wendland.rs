//! Wendland's compactly supported kernels C2 (43), C4 and C6, support 2h (Wendland 1995).

use super::{Kernel, checked, power};
use crate::error::ParameterError;
use crate::real::{Num, Real};
use core::f64::consts::PI;

macro_rules! wendland {
    ($(#[$doc:meta])* $name:ident, $one:expr, $two:expr, $three:expr, $value:expr, $slope:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<T, const D: usize> {
            h: T,
            half_inverse_h: T,
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
                    half_inverse_h: T::of(0.5 / length),
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
                self.h + self.h
            }
            #[inline(always)]
            fn value<N: Num<Scalar = T>>(&self, r2: N) -> N {
                let half_q = r2.sqrt() * N::splat(self.half_inverse_h);
                let t = (N::lit(1.0) - half_q).max(N::lit(0.0));
                N::splat(self.value_factor) * $value(half_q, t)
            }
            #[inline(always)]
            fn slope<N: Num<Scalar = T>>(&self, r2: N) -> N {
                let half_q = r2.sqrt() * N::splat(self.half_inverse_h);
                let t = (N::lit(1.0) - half_q).max(N::lit(0.0));
                N::splat(self.slope_factor) * $slope(half_q, t)
            }
        }
    };
}

// With s = q/2 = r/2h and t = max(0, 1 − s).

#[inline(always)]
fn c2_value<N: Num>(s: N, t: N) -> N {
    let t2 = t * t;
    t2 * t2 * (N::lit(4.0) * s + N::lit(1.0)) // (43)
}

#[inline(always)]
fn c2_slope<N: Num>(_: N, t: N) -> N {
    N::lit(-5.0) * (t * t * t)
}

#[inline(always)]
fn c4_value<N: Num>(s: N, t: N) -> N {
    let t2 = t * t;
    t2 * t2 * t2 * ((N::lit(35.0 / 3.0) * s + N::lit(6.0)) * s + N::lit(1.0))
}

#[inline(always)]
fn c4_slope<N: Num>(s: N, t: N) -> N {
    let t2 = t * t;
    t2 * t2 * t * (N::lit(-70.0 / 3.0) * s + N::lit(-14.0 / 3.0))
}

#[inline(always)]
fn c6_value<N: Num>(s: N, t: N) -> N {
    let t2 = t * t;
    let t4 = t2 * t2;
    t4 * t4 * (((N::lit(32.0) * s + N::lit(25.0)) * s + N::lit(8.0)) * s + N::lit(1.0))
}

#[inline(always)]
fn c6_slope<N: Num>(s: N, t: N) -> N {
    let t2 = t * t;
    let t4 = t2 * t2;
    t4 * t2 * t * ((N::lit(-88.0) * s + N::lit(-38.5)) * s + N::lit(-5.5))
}

wendland!(
    /// Wendland C2 (43): `W = α (1 − q/2)⁴ (2q + 1)`, `F = −5α/h² (1 − q/2)³`, `q = r/h < 2`;
    /// `α = 3/4h`, `7/4πh²`, `21/16πh³`.
    WendlandC2, 3.0 / 4.0, 7.0 / (4.0 * PI), 21.0 / (16.0 * PI), c2_value, c2_slope
);
wendland!(
    /// Wendland C4: `W = α (1 − q/2)⁶ (35q²/12 + 3q + 1)`, `F = −7α/3h² (1 − q/2)⁵ (5q + 2)`;
    /// `α = 27/32h` (from the unit integral), `9/4πh²`, `495/256πh³`.
    WendlandC4, 27.0 / 32.0, 9.0 / (4.0 * PI), 495.0 / (256.0 * PI), c4_value, c4_slope
);
wendland!(
    /// Wendland C6: `W = α (1 − q/2)⁸ (4q³ + 25q²/4 + 4q + 1)`,
    /// `F = −11α/4h² (1 − q/2)⁷ (8q² + 7q + 2)`; `α = 15/16h`, `39/14πh²`, `1365/512πh³`.
    WendlandC6, 15.0 / 16.0, 39.0 / (14.0 * PI), 1365.0 / (512.0 * PI), c6_value, c6_slope
);
