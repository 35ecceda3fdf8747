//! One lane: the numbers themselves. The path of every machine without wider lanes.

use super::{Lanes, Vectors};

macro_rules! scalar {
    ($t:ident, $slice:literal, $sse2:ident, $avx2:ident, $avx512:ident) => {
        impl Vectors for $t {
            const SLICE: usize = $slice;
            #[cfg(target_arch = "x86_64")]
            type Sse2 = super::x86::$sse2;
            #[cfg(target_arch = "x86_64")]
            type Avx2 = super::x86::$avx2;
            #[cfg(target_arch = "x86_64")]
            type Avx512 = super::x86::$avx512;
        }

        impl Lanes for $t {
            const WIDTH: usize = 1;
            #[inline(always)]
            unsafe fn load(p: *const $t) -> $t {
                // SAFETY: the caller's promise.
                unsafe { *p }
            }
            #[inline(always)]
            unsafe fn store(self, p: *mut $t) {
                // SAFETY: the caller's promise.
                unsafe { *p = self }
            }
            #[inline(always)]
            unsafe fn records(records: *const $t, index: *const u32, blocks: usize) -> [[$t; 4]; 4] {
                let mut out = [[0.0; 4]; 4];
                // SAFETY: the caller's promise.
                unsafe {
                    let record = records.add(*index as usize * 4 * blocks);
                    for b in 0..blocks {
                        for k in 0..4 {
                            out[b][k] = *record.add(4 * b + k);
                        }
                    }
                }
                out
            }
            #[inline(always)]
            fn less(self, other: $t) -> u32 {
                u32::from(self < other)
            }
            #[inline(always)]
            unsafe fn compress(first: u32, mask: u32, out: *mut u32) -> usize {
                // SAFETY: the caller's promise.
                unsafe { *out = first }
                (mask & 1) as usize
            }
        }
    };
}
scalar!(f32, 16, F32x4, F32x8, F32x16);
scalar!(f64, 8, F64x2, F64x4, F64x8);
