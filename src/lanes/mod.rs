//! SIMD lanes: the same formula on several particles at once.
//!
//! A lane is a particle. Each lane adds up its own neighbours in its own order, so the width of the
//! machine does not change a single bit of the result. Only `#[inline(always)] fn`s and plain `for`
//! loops may appear in code that runs in lanes: a closure loses the instruction set it is called for.
//!
//! Operators on lanes are safe, yet need instructions the processor may lack; so nobody outside can
//! name lanes, or an instruction set that was not detected. Each of these is refused, and stands below
//! its twin, which is taken and differs from it in one name:
//!
//! ```
//! fn narrow<T: alluvium::Real>(x: T::Scalar) {}
//! ```
//! ```compile_fail,E0624
//! fn wide<T: alluvium::Real>(x: T::Avx512) {}
//! ```
//! ```
//! type Narrow = <f32 as alluvium::real::Num>::Scalar;
//! ```
//! ```compile_fail,E0576
//! type Wide = <f32 as alluvium::real::Real>::Avx512;
//! ```
//! ```compile_fail,E0603
//! type Wide = <f32 as alluvium::lanes::Vectors>::Avx512;
//! ```
//! ```
//! let set = alluvium::InstructionSet::detect();
//! ```
//! ```compile_fail,E0423
//! let set = alluvium::InstructionSet(3);
//! ```

mod dispatch;
mod scalar;
#[cfg(test)]
mod tests;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use dispatch::{InstructionSet, UnknownInstructionSet};
pub(crate) use dispatch::{Work, baseline, dispatch};

use crate::real::Num;

/// The lane types of a precision.
pub(crate) trait Vectors: Sized {
    /// Particles in a slice of the neighbour list: the widest lanes, 512 bits.
    const SLICE: usize;
    #[cfg(target_arch = "x86_64")]
    type Sse2: Lanes<Scalar = Self>;
    #[cfg(target_arch = "x86_64")]
    type Avx2: Lanes<Scalar = Self>;
    #[cfg(target_arch = "x86_64")]
    type Avx512: Lanes<Scalar = Self>;
}

/// Numbers side by side, with the loads, stores and masks the pair loops need.
pub(crate) trait Lanes: Num {
    /// How many numbers.
    const WIDTH: usize;
    /// # Safety
    /// `p` points to `WIDTH` readable scalars.
    unsafe fn load(p: *const Self::Scalar) -> Self;
    /// # Safety
    /// `p` points to `WIDTH` writable scalars.
    unsafe fn store(self, p: *mut Self::Scalar);
    /// Reads the records of `WIDTH` particles and turns them round: `out[b][k]` holds component
    /// `4 b + k` of every particle, for `b < blocks`.
    ///
    /// # Safety
    /// `index` points to `WIDTH` indices, each of a record of `4 · blocks` readable scalars at
    /// `records + 4 · blocks · index`; `blocks ≤ 4`.
    unsafe fn records(records: *const Self::Scalar, index: *const u32, blocks: usize) -> [[Self; 4]; 4];
    /// Bit `l` tells whether lane `l` of `self` is below lane `l` of `other`.
    fn less(self, other: Self) -> u32;
    /// Writes `first + l` for each set bit `l < WIDTH` of `mask`, in ascending order; returns how many.
    ///
    /// # Safety
    /// `out` points to `WIDTH` writable integers (all may be written).
    unsafe fn compress(first: u32, mask: u32, out: *mut u32) -> usize;
}
