//! Reading four numbers of each lane's record and turning the block round in registers: result `k`
//! holds number `k` of every lane.
//!
//! One function per lane type, of the same name. Each takes the addresses of the records and how
//! many numbers to skip in them, and has the same contract.
//!
//! # Safety
//! Four scalars are readable `skip` numbers after each of `at`, and the processor has the
//! instructions of the lane type.
#![expect(non_snake_case, reason = "the functions carry the name of the lanes they serve")]

use core::arch::x86_64::*;

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
pub(super) unsafe fn F32x4(at: &[*const f32; 4], skip: usize) -> [__m128; 4] {
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
pub(super) unsafe fn F64x2(at: &[*const f64; 2], skip: usize) -> [__m128d; 4] {
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
pub(super) unsafe fn F32x8(at: &[*const f32; 8], skip: usize) -> [__m256; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let mut rows = [_mm256_setzero_ps(); 4];
        for k in 0..4 {
            // An insert from memory is a load and a blend: it leaves the shuffle port free.
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
pub(super) unsafe fn F64x4(at: &[*const f64; 4], skip: usize) -> [__m256d; 4] {
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
pub(super) unsafe fn F32x16(at: &[*const f32; 16], skip: usize) -> [__m512; 4] {
    // SAFETY: the contract of the module.
    unsafe {
        let mut rows = [_mm512_setzero_ps(); 4];
        for k in 0..4 {
            // Masked broadcasts from memory are loads and blends: they leave the shuffle port free.
            let mut row = _mm512_castps128_ps512(_mm_loadu_ps(at[k].add(skip)));
            row = _mm512_mask_broadcast_f32x4(row, 0x00f0, _mm_loadu_ps(at[k + 4].add(skip)));
            row = _mm512_mask_broadcast_f32x4(row, 0x0f00, _mm_loadu_ps(at[k + 8].add(skip)));
            row = _mm512_mask_broadcast_f32x4(row, 0xf000, _mm_loadu_ps(at[k + 12].add(skip)));
            rows[k] = row;
        }
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

/// Lanes `low` and `low + 2`, each with all its four numbers.
#[inline(always)]
unsafe fn two_records(at: &[*const f64; 8], skip: usize, low: usize) -> __m512d {
    // SAFETY: the contract of the module.
    unsafe {
        let row = _mm512_castpd256_pd512(_mm256_loadu_pd(at[low].add(skip)));
        _mm512_mask_broadcast_f64x4(row, 0xf0, _mm256_loadu_pd(at[low + 2].add(skip)))
    }
}

#[inline(always)]
pub(super) unsafe fn F64x8(at: &[*const f64; 8], skip: usize) -> [__m512d; 4] {
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
