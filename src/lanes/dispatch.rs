//! Which instructions the processor has, and the one way into code compiled for them.

use super::{Lanes, Vectors};
use crate::real::Real;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Scalar,
    Sse2,
    Avx2,
    Avx512,
}

/// An instruction set this processor has; results do not depend on it, only speed does.
///
/// Values come from [`detect`](Self::detect) or [`at_most`](Self::at_most) alone, so holding one
/// proves that its instructions exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct InstructionSet(Level);

/// The name of an instruction set that does not exist.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownInstructionSet(pub String);

impl core::fmt::Display for UnknownInstructionSet {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "instruction set `{}` is none of: {}", self.0, InstructionSet::NAMES.join(", "))
    }
}

impl core::error::Error for UnknownInstructionSet {}

impl InstructionSet {
    /// All names, from narrow to wide.
    pub const NAMES: [&'static str; 4] = ["scalar", "sse2", "avx2", "avx512"];

    /// The widest this processor has.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            use std::arch::is_x86_feature_detected as has;
            let avx2 = has!("avx2")
                && has!("fma")
                && has!("bmi1")
                && has!("bmi2")
                && has!("popcnt")
                && has!("lzcnt");
            let avx512 = avx2
                && has!("avx512f")
                && has!("avx512vl")
                && has!("avx512dq")
                && has!("avx512bw")
                && has!("avx512cd");
            match (avx512, avx2) {
                (true, _) => Self(Level::Avx512),
                (false, true) => Self(Level::Avx2),
                (false, false) => Self(Level::Sse2),
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        Self(Level::Scalar)
    }

    /// The widest this processor has that is not wider than the named one: for comparing them.
    pub fn at_most(name: &str) -> Result<Self, UnknownInstructionSet> {
        let level = match name {
            "scalar" => Level::Scalar,
            "sse2" => Level::Sse2,
            "avx2" => Level::Avx2,
            "avx512" => Level::Avx512,
            _ => return Err(UnknownInstructionSet(name.to_owned())),
        };
        Ok(Self(level).min(Self::detect()))
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES[self.0 as usize]
    }
}

/// A piece of work that can be done in any lanes. `run` must be `#[inline(always)]`.
pub(crate) trait Work<T: Real> {
    type Out;
    fn run<L: Lanes<Scalar = T>>(self) -> Self::Out;
}

/// Does the work in the lanes of the instruction set. Called per leaf of a parallel loop, never
/// around one: threads would not inherit the instruction set.
#[cfg(target_arch = "x86_64")]
pub(crate) fn dispatch<T: Real, W: Work<T>>(set: InstructionSet, work: W) -> W::Out {
    match set.0 {
        Level::Scalar => work.run::<T>(),
        Level::Sse2 => work.run::<<T as Vectors>::Sse2>(),
        // SAFETY: an `InstructionSet` of this level is only made after detection.
        Level::Avx2 => unsafe { avx2::<T, W>(work) },
        // SAFETY: as above.
        Level::Avx512 => unsafe { avx512::<T, W>(work) },
    }
}

#[cfg(not(target_arch = "x86_64"))]
pub(crate) fn dispatch<T: Real, W: Work<T>>(_: InstructionSet, work: W) -> W::Out {
    work.run::<T>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt,lzcnt")]
fn avx2<T: Real, W: Work<T>>(work: W) -> W::Out {
    work.run::<<T as Vectors>::Avx2>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx512cd,avx2,fma,bmi1,bmi2,popcnt,lzcnt")]
fn avx512<T: Real, W: Work<T>>(work: W) -> W::Out {
    work.run::<<T as Vectors>::Avx512>()
}

/// Does the work in the lanes that every processor of this architecture has.
pub(crate) fn baseline<T: Real, W: Work<T>>(work: W) -> W::Out {
    #[cfg(target_arch = "x86_64")]
    return work.run::<<T as Vectors>::Sse2>();
    #[cfg(not(target_arch = "x86_64"))]
    work.run::<T>()
}
