//! SSE2, AVX2 and AVX-512 lanes.
//!
//! The operators are safe functions that run vector instructions, so they are only sound where the
//! instructions exist. Three things see to that: the types stay inside the crate, code outside
//! [`super::dispatch`] cannot name them through [`crate::Real`], and dispatch picks lanes by an
//! [`InstructionSet`](super::InstructionSet), which is proof of detection. The `SAFETY` comments
//! below call this *the rule of dispatch*.
//!
//! There is no fused multiply-add: only the operations that a scalar rounds in the same way.

mod compress;
mod transpose;

use super::Lanes;
use crate::real::{Num, sealed::Sealed};
use core::arch::x86_64::*;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

macro_rules! operator {
    ($name:ident, $operator:ident, $method:ident, $instruction:ident $(, $assign:ident, $assign_method:ident)?) => {
        impl $operator for $name {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: the rule of dispatch.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
        $(impl $assign for $name {
            #[inline(always)]
            fn $assign_method(&mut self, other: Self) {
                *self = $operator::$method(*self, other);
            }
        })?
    };
}

macro_rules! lanes {
    (
        $(#[$doc:meta])*
        $name:ident = $width:literal x $t:ident in $vector:ident,
        load $load:ident, store $store:ident, splat $splat:ident,
        add $add:ident, sub $sub:ident, mul $mul:ident, div $div:ident, sqrt $sqrt:ident,
        max $max:ident, min $min:ident, xor $xor:ident, less $less:ident
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub(crate) struct $name($vector);

        impl Sealed for $name {}
        operator!($name, Add, add, $add, AddAssign, add_assign);
        operator!($name, Sub, sub, $sub, SubAssign, sub_assign);
        operator!($name, Mul, mul, $mul, MulAssign, mul_assign);
        operator!($name, Div, div, $div);

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: the rule of dispatch.
                Self(unsafe { $xor(self.0, $splat(-0.0)) })
            }
        }

        // `max` and `min` of the machine return the second operand unless the comparison holds, which
        // is what `Num` asks for.
        impl Num for $name {
            type Scalar = $t;
            #[inline(always)]
            fn splat(x: $t) -> Self {
                // SAFETY: the rule of dispatch.
                Self(unsafe { $splat(x) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: the rule of dispatch.
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // SAFETY: the rule of dispatch.
                Self(unsafe { $max(self.0, other.0) })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // SAFETY: the rule of dispatch.
                Self(unsafe { $min(self.0, other.0) })
            }
        }

        impl Lanes for $name {
            const WIDTH: usize = $width;
            #[inline(always)]
            unsafe fn load(p: *const $t) -> Self {
                // SAFETY: the caller's promise and the rule of dispatch.
                Self(unsafe { $load(p) })
            }
            #[inline(always)]
            unsafe fn store(self, p: *mut $t) {
                // SAFETY: the caller's promise and the rule of dispatch.
                unsafe { $store(p, self.0) }
            }
            #[inline(always)]
            unsafe fn records(records: *const $t, index: *const u32, blocks: usize) -> [[Self; 4]; 4] {
                let mut at = [records; $width];
                let mut out = [[Self::splat(0.0); 4]; 4];
                // SAFETY: the caller's promise, and for the vectors the rule of dispatch.
                unsafe {
                    for lane in 0..$width {
                        // Volatile, because the compiler would otherwise compute the addresses in
                        // vectors and take them out again, which costs half as much as everything else.
                        let record = index.add(lane).read_volatile() as usize;
                        at[lane] = records.add(record * (4 * blocks));
                    }
                    let columns = transpose::$name(&at, blocks);
                    for b in 0..blocks {
                        for k in 0..4 {
                            out[b][k] = Self(columns[b][k]);
                        }
                    }
                }
                out
            }
            #[inline(always)]
            fn less(self, other: Self) -> u32 {
                // SAFETY: the rule of dispatch.
                unsafe { $less(self.0, other.0) }
            }
            #[inline(always)]
            unsafe fn compress(first: u32, mask: u32, out: *mut u32) -> usize {
                // SAFETY: the caller's promise and the rule of dispatch.
                unsafe { compress::$name(first, mask, out) }
            }
        }
    };
}

#[inline(always)]
unsafe fn less_f32x4(a: __m128, b: __m128) -> u32 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_movemask_ps(_mm_cmplt_ps(a, b)) as u32 }
}
#[inline(always)]
unsafe fn less_f64x2(a: __m128d, b: __m128d) -> u32 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_movemask_pd(_mm_cmplt_pd(a, b)) as u32 }
}
#[inline(always)]
unsafe fn less_f32x8(a: __m256, b: __m256) -> u32 {
    // SAFETY: the rule of dispatch.
    unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(a, b)) as u32 }
}
#[inline(always)]
unsafe fn less_f64x4(a: __m256d, b: __m256d) -> u32 {
    // SAFETY: the rule of dispatch.
    unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(a, b)) as u32 }
}
#[inline(always)]
unsafe fn less_f32x16(a: __m512, b: __m512) -> u32 {
    // SAFETY: the rule of dispatch.
    u32::from(unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b) })
}
#[inline(always)]
unsafe fn less_f64x8(a: __m512d, b: __m512d) -> u32 {
    // SAFETY: the rule of dispatch.
    u32::from(unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b) })
}

lanes!(
    /// Four of `f32` in SSE2.
    F32x4 = 4 x f32 in __m128,
    load _mm_loadu_ps, store _mm_storeu_ps, splat _mm_set1_ps,
    add _mm_add_ps, sub _mm_sub_ps, mul _mm_mul_ps, div _mm_div_ps, sqrt _mm_sqrt_ps,
    max _mm_max_ps, min _mm_min_ps, xor _mm_xor_ps, less less_f32x4
);
lanes!(
    /// Two of `f64` in SSE2.
    F64x2 = 2 x f64 in __m128d,
    load _mm_loadu_pd, store _mm_storeu_pd, splat _mm_set1_pd,
    add _mm_add_pd, sub _mm_sub_pd, mul _mm_mul_pd, div _mm_div_pd, sqrt _mm_sqrt_pd,
    max _mm_max_pd, min _mm_min_pd, xor _mm_xor_pd, less less_f64x2
);
lanes!(
    /// Eight of `f32` in AVX2.
    F32x8 = 8 x f32 in __m256,
    load _mm256_loadu_ps, store _mm256_storeu_ps, splat _mm256_set1_ps,
    add _mm256_add_ps, sub _mm256_sub_ps, mul _mm256_mul_ps, div _mm256_div_ps, sqrt _mm256_sqrt_ps,
    max _mm256_max_ps, min _mm256_min_ps, xor _mm256_xor_ps, less less_f32x8
);
lanes!(
    /// Four of `f64` in AVX2.
    F64x4 = 4 x f64 in __m256d,
    load _mm256_loadu_pd, store _mm256_storeu_pd, splat _mm256_set1_pd,
    add _mm256_add_pd, sub _mm256_sub_pd, mul _mm256_mul_pd, div _mm256_div_pd, sqrt _mm256_sqrt_pd,
    max _mm256_max_pd, min _mm256_min_pd, xor _mm256_xor_pd, less less_f64x4
);
lanes!(
    /// Sixteen of `f32` in AVX-512.
    F32x16 = 16 x f32 in __m512,
    load _mm512_loadu_ps, store _mm512_storeu_ps, splat _mm512_set1_ps,
    add _mm512_add_ps, sub _mm512_sub_ps, mul _mm512_mul_ps, div _mm512_div_ps, sqrt _mm512_sqrt_ps,
    max _mm512_max_ps, min _mm512_min_ps, xor _mm512_xor_ps, less less_f32x16
);
lanes!(
    /// Eight of `f64` in AVX-512.
    F64x8 = 8 x f64 in __m512d,
    load _mm512_loadu_pd, store _mm512_storeu_pd, splat _mm512_set1_pd,
    add _mm512_add_pd, sub _mm512_sub_pd, mul _mm512_mul_pd, div _mm512_div_pd, sqrt _mm512_sqrt_pd,
    max _mm512_max_pd, min _mm512_min_pd, xor _mm512_xor_pd, less less_f64x8
);
