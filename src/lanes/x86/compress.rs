//! Writing `first + lane` for the lanes of a mask, side by side, and counting them.
//!
//! One function per lane type, of the same name, with the same contract.
//!
//! # Safety
//! `out` points to as many writable integers as there are lanes, no bit of `mask` lies beyond the
//! lanes, and the processor has the instructions of the lane type.
#![expect(non_snake_case, reason = "the functions carry the name of the lanes they serve")]

use core::arch::x86_64::*;

/// For each mask, the lanes in it, ascending.
macro_rules! lanes_of_masks {
    ($t:ident, $lanes:literal) => {{
        let mut table = [[0; $lanes]; 1 << $lanes];
        let mut mask = 0;
        while mask < 1 << $lanes {
            let (mut lane, mut count) = (0, 0);
            while lane < $lanes {
                if mask >> lane & 1 == 1 {
                    table[mask][count] = lane as $t;
                    count += 1;
                }
                lane += 1;
            }
            mask += 1;
        }
        table
    }};
}

static OF_FOUR: [[u32; 4]; 16] = lanes_of_masks!(u32, 4);
static OF_EIGHT: [[u8; 8]; 256] = lanes_of_masks!(u8, 8);

#[inline(always)]
pub(super) unsafe fn F32x4(first: u32, mask: u32, out: *mut u32) -> usize {
    // SAFETY: the contract of the module; a table entry has the four integers read.
    unsafe {
        let lanes = _mm_loadu_si128(OF_FOUR[mask as usize & 15].as_ptr().cast());
        _mm_storeu_si128(out.cast(), _mm_add_epi32(lanes, _mm_set1_epi32(first as i32)));
    }
    // Bits of a mask of four lanes, looked up in the hexadecimal digits: there is no instruction yet.
    (0x4332_3221_3221_2110_u64 >> (4 * mask) & 7) as usize
}

#[inline(always)]
pub(super) unsafe fn F64x2(first: u32, mask: u32, out: *mut u32) -> usize {
    // SAFETY: the contract of the module.
    unsafe {
        *out = first + u32::from(mask == 2);
        *out.add(1) = first + 1;
    }
    ((mask & 1) + (mask >> 1)) as usize
}

#[inline(always)]
pub(super) unsafe fn F32x8(first: u32, mask: u32, out: *mut u32) -> usize {
    // SAFETY: the contract of the module; a table entry has the eight bytes read.
    unsafe {
        let lanes = _mm_loadl_epi64(OF_EIGHT[mask as usize & 255].as_ptr().cast());
        let indices = _mm256_add_epi32(_mm256_cvtepu8_epi32(lanes), _mm256_set1_epi32(first as i32));
        _mm256_storeu_si256(out.cast(), indices);
    }
    mask.count_ones() as usize
}

#[inline(always)]
pub(super) unsafe fn F64x4(first: u32, mask: u32, out: *mut u32) -> usize {
    // SAFETY: the contract of the module; a table entry has the eight bytes read.
    unsafe {
        let lanes = _mm_loadl_epi64(OF_EIGHT[mask as usize & 15].as_ptr().cast());
        let indices = _mm_add_epi32(_mm_cvtepu8_epi32(lanes), _mm_set1_epi32(first as i32));
        _mm_storeu_si128(out.cast(), indices);
    }
    mask.count_ones() as usize
}

#[inline(always)]
pub(super) unsafe fn F32x16(first: u32, mask: u32, out: *mut u32) -> usize {
    // SAFETY: the contract of the module.
    unsafe {
        let lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        let indices = _mm512_add_epi32(lanes, _mm512_set1_epi32(first as i32));
        // Compressing in a register and storing it whole beats the compressing store.
        _mm512_storeu_si512(out.cast(), _mm512_maskz_compress_epi32(mask as __mmask16, indices));
    }
    mask.count_ones() as usize
}

#[inline(always)]
pub(super) unsafe fn F64x8(first: u32, mask: u32, out: *mut u32) -> usize {
    // SAFETY: the contract of the module.
    unsafe {
        let lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        let indices = _mm256_add_epi32(lanes, _mm256_set1_epi32(first as i32));
        _mm256_storeu_si256(out.cast(), _mm256_maskz_compress_epi32(mask as __mmask8, indices));
    }
    mask.count_ones() as usize
}
