//! Reading each lane's record and turning the numbers round in registers: result `[b][k]` holds
//! number `4 b + k` of every lane.
//!
//! One function per lane type, of the same name, with the same contract; the helpers read one block
//! of four numbers (or two blocks) `skip` numbers from the beginning of the records.
//!
//! What counts is the one port that shuffles. Inserts from memory are loads and blends and leave it
//! free.
//!
//! # Safety
//! `4 · blocks` scalars are readable at each of `at`, with `blocks ≤ 4`, and the processor has the
//! instructions of the lane type.
#![expect(non_snake_case, reason = "the functions carry the name of the lanes they serve")]

use core::arch::x86_64::*;

macro_rules! block_by_block {
    ($name:ident: $width:literal x $t:ident in $vector:ident, $zero:ident, $block:ident) => {
        #[inline(always)]
        pub(super) unsafe fn $name(at: &[*const $t; $width], blocks: usize) -> [[$vector; 4]; 4] {
            // SAFETY: the contract of the module.
            unsafe {
                let mut out = [[$zero(); 4]; 4];
                for b in 0..blocks {
                    out[b] = $block(at, 4 * b);
                }
                out
            }
        }
    };
}
block_by_block!(F32x4: 4 x f32 in __m128, _mm_setzero_ps, block_f32x4);
block_by_block!(F64x2: 2 x f64 in __m128d, _mm_setzero_pd, block_f64x2);
block_by_block!(F32x8: 8 x f32 in __m256, _mm256_setzero_ps, block_f32x8);
block_by_block!(F64x4: 4 x f64 in __m256d, _mm256_setzero_pd, block_f64x4);
block_by_block!(F64x8: 8 x f64 in __m512d, _mm512_setzero_pd, block_f64x8);

#[inline(always)]
pub(super) unsafe fn F32x16(at: &[*const f32; 16], blocks: usize) -> [[__m512; 4]; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let mut out = [[_mm512_setzero_ps(); 4]; 4];
        if blocks >= 2 {
            [out[0], out[1]] = two_blocks_f32x16(at, 0);
        }
        if blocks == 4 {
            [out[2], out[3]] = two_blocks_f32x16(at, 8);
        }
        if blocks % 2 == 1 {
            out[blocks - 1] = block_f32x16(at, 4 * (blocks - 1));
        }
        out
    }
}

/// Turns round the 4 × 4 blocks in which register `k` holds lane `k` (of four), separately in each
/// 128 bits.
macro_rules! turn {
    ($rows:ident, $low_ps:ident, $high_ps:ident, $low_pd:ident, $high_pd:ident, $as_pd:ident, $as_ps:ident) => {{
        let [a, b, c, d] = $rows;
        let (ab01, ab23) = ($as_pd($low_ps(a, b)), $as_pd($high_ps(a, b)));
        let (cd01, cd23) = ($as_pd($low_ps(c, d)), $as_pd($high_ps(c, d)));
        [
            $as_ps($low_pd(ab01, cd01)),
            $as_ps($high_pd(ab01, cd01)),
            $as_ps($low_pd(ab23, cd23)),
            $as_ps($high_pd(ab23, cd23)),
        ]
    }};
}

#[inline(always)]
unsafe fn block_f32x4(at: &[*const f32; 4], skip: usize) -> [__m128; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let mut rows = [_mm_setzero_ps(); 4];
        for k in 0..4 {
            rows[k] = _mm_loadu_ps(at[k].add(skip));
        }
        turn!(
            rows,
            _mm_unpacklo_ps,
            _mm_unpackhi_ps,
            _mm_unpacklo_pd,
            _mm_unpackhi_pd,
            _mm_castps_pd,
            _mm_castpd_ps
        )
    }
}

#[inline(always)]
unsafe fn block_f64x2(at: &[*const f64; 2], skip: usize) -> [__m128d; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let (a, b) = (at[0].add(skip), at[1].add(skip));
        let (a01, a23) = (_mm_loadu_pd(a), _mm_loadu_pd(a.add(2)));
        let (b01, b23) = (_mm_loadu_pd(b), _mm_loadu_pd(b.add(2)));
        [
            _mm_unpacklo_pd(a01, b01),
            _mm_unpackhi_pd(a01, b01),
            _mm_unpacklo_pd(a23, b23),
            _mm_unpackhi_pd(a23, b23),
        ]
    }
}

#[inline(always)]
unsafe fn block_f32x8(at: &[*const f32; 8], skip: usize) -> [__m256; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let mut rows = [_mm256_setzero_ps(); 4];
        for k in 0..4 {
            let low = _mm256_castps128_ps256(_mm_loadu_ps(at[k].add(skip)));
            rows[k] = _mm256_insertf128_ps::<1>(low, _mm_loadu_ps(at[k + 4].add(skip)));
        }
        turn!(
            rows,
            _mm256_unpacklo_ps,
            _mm256_unpackhi_ps,
            _mm256_unpacklo_pd,
            _mm256_unpackhi_pd,
            _mm256_castps_pd,
            _mm256_castpd_ps
        )
    }
}

#[inline(always)]
unsafe fn block_f64x4(at: &[*const f64; 4], skip: usize) -> [__m256d; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let mut out = [_mm256_setzero_pd(); 4];
        for half in 0..2 {
            let skip = skip + 2 * half;
            let low0 = _mm256_castpd128_pd256(_mm_loadu_pd(at[0].add(skip)));
            let low1 = _mm256_castpd128_pd256(_mm_loadu_pd(at[1].add(skip)));
            let rows02 = _mm256_insertf128_pd::<1>(low0, _mm_loadu_pd(at[2].add(skip)));
            let rows13 = _mm256_insertf128_pd::<1>(low1, _mm_loadu_pd(at[3].add(skip)));
            out[2 * half] = _mm256_unpacklo_pd(rows02, rows13);
            out[2 * half + 1] = _mm256_unpackhi_pd(rows02, rows13);
        }
        out
    }
}

#[inline(always)]
unsafe fn turn_512(rows: [__m512; 4]) -> [__m512; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        turn!(
            rows,
            _mm512_unpacklo_ps,
            _mm512_unpackhi_ps,
            _mm512_unpacklo_pd,
            _mm512_unpackhi_pd,
            _mm512_castps_pd,
            _mm512_castpd_ps
        )
    }
}

/// A mask whose value the compiler does not know: else it turns masked broadcasts from memory, which
/// are loads and blends, into inserts between registers, which are shuffles.
#[inline(always)]
fn opaque(mut mask: u32) -> u16 {
    // SAFETY: no instruction at all.
    unsafe {
        core::arch::asm!("/* {0:e} */", inout(reg) mask, options(pure, nomem, nostack, preserves_flags))
    };
    mask as u16
}

#[inline(always)]
unsafe fn block_f32x16(at: &[*const f32; 16], skip: usize) -> [__m512; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let mut rows = [_mm512_setzero_ps(); 4];
        for k in 0..4 {
            let mut row = _mm512_castps128_ps512(_mm_loadu_ps(at[k].add(skip)));
            row = _mm512_mask_broadcast_f32x4(row, opaque(0x00f0), _mm_loadu_ps(at[k + 4].add(skip)));
            row = _mm512_mask_broadcast_f32x4(row, opaque(0x0f00), _mm_loadu_ps(at[k + 8].add(skip)));
            row = _mm512_mask_broadcast_f32x4(row, opaque(0xf000), _mm_loadu_ps(at[k + 12].add(skip)));
            rows[k] = row;
        }
        turn_512(rows)
    }
}

/// Lanes `low..low + 8`, with numbers 0 to 3 in the first and third 128 bits and 4 to 7 in the second
/// and fourth.
#[inline(always)]
unsafe fn half_f32x16(at: &[*const f32; 16], skip: usize, low: usize) -> [__m512; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let mut rows = [_mm512_setzero_ps(); 4];
        for k in 0..4 {
            let row = _mm512_castps256_ps512(_mm256_loadu_ps(at[low + k].add(skip)));
            rows[k] = _mm512_insertf32x8::<1>(row, _mm256_loadu_ps(at[low + k + 4].add(skip)));
        }
        turn_512(rows)
    }
}

/// Two blocks at once: half the loads, for a few more shuffles.
#[inline(always)]
unsafe fn two_blocks_f32x16(at: &[*const f32; 16], skip: usize) -> [[__m512; 4]; 2] {
    // SAFETY: the contract of the module.
    unsafe {
        let (low, high) = (half_f32x16(at, skip, 0), half_f32x16(at, skip, 8));
        let mut out = [[_mm512_setzero_ps(); 4]; 2];
        for k in 0..4 {
            out[0][k] = _mm512_shuffle_f32x4::<0b10_00_10_00>(low[k], high[k]);
            out[1][k] = _mm512_shuffle_f32x4::<0b11_01_11_01>(low[k], high[k]);
        }
        out
    }
}

/// Lanes `low` and `low + 2`, each with all its four numbers.
#[inline(always)]
unsafe fn two_records(at: &[*const f64; 8], skip: usize, low: usize) -> __m512d {
    // SAFETY: the contract of the module.
    unsafe {
        let row = _mm512_castpd256_pd512(_mm256_loadu_pd(at[low].add(skip)));
        _mm512_insertf64x4::<1>(row, _mm256_loadu_pd(at[low + 2].add(skip)))
    }
}

#[inline(always)]
unsafe fn block_f64x8(at: &[*const f64; 8], skip: usize) -> [__m512d; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let (row0, row1) = (two_records(at, skip, 0), two_records(at, skip, 1));
        let (row4, row5) = (two_records(at, skip, 4), two_records(at, skip, 5));
        // Numbers 0 and 2 (1 and 3) of lanes 0..4 and of lanes 4..8, pair by pair.
        let (even0, even4) = (_mm512_unpacklo_pd(row0, row1), _mm512_unpacklo_pd(row4, row5));
        let (odd0, odd4) = (_mm512_unpackhi_pd(row0, row1), _mm512_unpackhi_pd(row4, row5));
        [
            _mm512_shuffle_f64x2::<0b10_00_10_00>(even0, even4),
            _mm512_shuffle_f64x2::<0b10_00_10_00>(odd0, odd4),
            _mm512_shuffle_f64x2::<0b11_01_11_01>(even0, even4),
            _mm512_shuffle_f64x2::<0b11_01_11_01>(odd0, odd4),
        ]
    }
}
