//! A kernel with a mistake.

use crate::kernel::Kernel;
use crate::real::{Num, Real};

/// A kernel with wrong constants, or with the support of another smoothing length.
#[derive(Clone, Debug)]
pub struct Flawed<K> {
    /// The kernel without the mistake.
    pub kernel: K,
    /// What its value is multiplied by \[-\].
    pub value_factor: f64,
    /// What its slope is multiplied by \[-\].
    pub slope_factor: f64,
    /// What the distance is multiplied by \[-\]; the support it tells of stays.
    pub stretch: f64,
}

impl<K> Flawed<K> {
    /// No mistake yet.
    pub fn none(kernel: K) -> Self {
        Self { kernel, value_factor: 1.0, slope_factor: 1.0, stretch: 1.0 }
    }
    /// Value and slope wrong by the same factor \[-\].
    pub fn scaled(kernel: K, factor: f64) -> Self {
        Self { value_factor: factor, slope_factor: factor, ..Self::none(kernel) }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> Kernel<T, D> for Flawed<K> {
    fn smoothing_length(&self) -> T {
        self.kernel.smoothing_length()
    }
    fn support(&self) -> T {
        self.kernel.support()
    }
    #[inline(always)]
    fn value<N: Num<Scalar = T>>(&self, r2: N) -> N {
        N::lit(self.value_factor) * self.kernel.value(r2 * N::lit(self.stretch * self.stretch))
    }
    #[inline(always)]
    fn slope<N: Num<Scalar = T>>(&self, r2: N) -> N {
        N::lit(self.slope_factor) * self.kernel.slope(r2 * N::lit(self.stretch * self.stretch))
    }
}
