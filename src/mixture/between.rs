//! The kernel of the sums between soil and water, which may be another than that within each of them.
//!
//! A mixture knows the type of its own kernel; of this one it knows what it does: which kernel it is, is asked once a
//! pass, and the pass over pairs is compiled for it as any other.

use super::across::{Across, Records};
use super::coupling::Exchange;
use super::drag::Slip;
use super::pore::Pore;
use super::projected_drag::ProjectedDrag;
use super::reconstructed_drag::Reconstructed;
use crate::kernel::Kernel;
use crate::real::Real;
use crate::summation::Sums;
use core::fmt::Debug;

/// What is summed over the pairs of soil and water.
#[derive(Clone, Copy, Debug)]
pub(super) enum Pass {
    /// What each sees of the other (67)–(69): [`Pore`].
    Pores,
    /// Pressure and drag (55), (58): [`Exchange`].
    Exchange,
    /// How fast they pass each other: [`Slip`].
    Slip,
    /// Drag along the line between them: [`ProjectedDrag`].
    ProjectedDrag,
    /// Drag of reconstructed velocities, whole or what reconstruction changes of it: [`Reconstructed`].
    ReconstructedDrag { whole: bool },
}

/// A kernel between soil and water, whatever its type.
pub(super) trait Between<T: Real, const D: usize>: Debug + Send + Sync {
    /// Its smoothing length h_c \[m\].
    fn length(&self) -> T;
    /// W \[m⁻ᴰ\] at a squared distance \[m²\].
    fn weight(&self, r2: T) -> T;
    /// Sums over the pairs of `across`.
    fn sum(&self, pass: Pass, across: &mut Across<T, D>, records: &Records<'_, T>, sums: &mut Sums<T>);
}

impl<T: Real, K: Kernel<T, D>, const D: usize> Between<T, D> for K {
    fn length(&self) -> T {
        self.smoothing_length()
    }

    fn weight(&self, r2: T) -> T {
        self.value(r2)
    }

    fn sum(&self, pass: Pass, across: &mut Across<T, D>, records: &Records<'_, T>, sums: &mut Sums<T>) {
        let kernel = self.clone();
        match pass {
            Pass::Pores => across.sum_with(&Pore::<K, D> { kernel }, records, sums),
            Pass::Exchange => across.sum_with(&Exchange::<K, D> { kernel }, records, sums),
            Pass::Slip => across.sum_with(&Slip::<K, D> { kernel }, records, sums),
            Pass::ProjectedDrag => {
                across.sum_with(&ProjectedDrag::<T, K, D>::new(&kernel), records, sums);
            }
            Pass::ReconstructedDrag { whole } => {
                let whole = if whole { T::ONE } else { T::ZERO };
                across.sum_with(&Reconstructed::<T, K, D> { kernel, whole }, records, sums);
            }
        }
    }
}
