//! Writing `first + lane` for the lanes of a mask, side by side.
//!
//! One function per lane type, of the same name, with the same contract.
//!
//! # Safety
//! `out` points to as many writable integers as there are lanes, no bit of `mask` lies beyond the
//! lanes, and the processor has the instructions of the lane type.
#![expect(non_snake_case, reason = "the functions carry the name of the lanes they serve")]

use core::arch::x86_64::*;

/// For each mask of eight lanes, the lanes in it, ascending.
static LANES: [[u8; 8]; 256] = lanes_of_masks();

const fn lanes_of_masks() -> [[u8; 8]; 256] {
    let mut table = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut count) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                table[mask][count] = lane as u8;
                count += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
}

/// Bit by bit.
#[inline(always)]
unsafe fn one_by_one(first: u32, mut mask: u32, mut out: *mut u32) {
    while mask != 0 {
        // SAFETY: as many are written as the mask has bits, all within the lanes.
        unsafe {
            *out = first + mask.trailing_zeros();
            out = out.add(1);
        }
        mask &= mask - 1;
    }
}

#[inline(always)]
pub(super) unsafe fn F32x4(first: u32, mask: u32, out: *mut u32) {
    // SAFETY: the contract of the module.
    unsafe { one_by_one(first, mask, out) }
}

#[inline(always)]
pub(super) unsafe fn F64x2(first: u32, mask: u32, out: *mut u32) {
    // SAFETY: the contract of the module.
    unsafe { one_by_one(first, mask, out) }
}

#[inline(always)]
pub(super) unsafe fn F32x8(first: u32, mask: u32, out: *mut u32) {
    // SAFETY: the contract of the module; a table entry has the eight bytes read.
    unsafe {
        let lanes = _mm_loadl_epi64(LANES[mask as usize & 255].as_ptr().cast());
        let indices = _mm256_add_epi32(_mm256_cvtepu8_epi32(lanes), _mm256_set1_epi32(first as i32));
        _mm256_storeu_si256(out.cast(), indices);
    }
}

#[inline(always)]
pub(super) unsafe fn F64x4(first: u32, mask: u32, out: *mut u32) {
    // SAFETY: the contract of the module; a table entry has the eight bytes read.
    unsafe {
        let lanes = _mm_loadl_epi64(LANES[mask as usize & 15].as_ptr().cast());
        let indices = _mm_add_epi32(_mm_cvtepu8_epi32(lanes), _mm_set1_epi32(first as i32));
        _mm_storeu_si128(out.cast(), indices);
    }
}

#[inline(always)]
pub(super) unsafe fn F32x16(first: u32, mask: u32, out: *mut u32) {
    // SAFETY: the contract of the module.
    unsafe {
        let lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        let indices = _mm512_add_epi32(lanes, _mm512_set1_epi32(first as i32));
        // Compressing in a register and storing it whole beats the compressing store.
        _mm512_storeu_si512(out.cast(), _mm512_maskz_compress_epi32(mask as __mmask16, indices));
    }
}

#[inline(always)]
pub(super) unsafe fn F64x8(first: u32, mask: u32, out: *mut u32) {
    // SAFETY: the contract of the module.
    unsafe {
        let lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        let indices = _mm256_add_epi32(lanes, _mm256_set1_epi32(first as i32));
        _mm256_storeu_si256(out.cast(), _mm256_maskz_compress_epi32(mask as __mmask8, indices));
    }
}
