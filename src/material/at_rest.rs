//! The stress of soil that was laid down and left alone (75), (76).

use super::{DruckerPrager, Elasticity};
use crate::real::Real;

/// Lateral over vertical stress at rest, K₀ \[-\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LateralRatio<T> {
    /// As printed, ν/(1 − ν), Eq. (76).
    pub printed: T,
    /// The smallest a cone without cohesion bears, `(1 − √3 α_θ)/(1 + 2√3 α_θ)`.
    pub smallest: T,
}

impl<T: Real> LateralRatio<T> {
    /// Of an elastic skeleton on a cone. Cohesion, which bears more near the surface, is not counted on.
    pub fn new(elasticity: &Elasticity<T>, cone: &DruckerPrager<T>) -> Self {
        let a = T::of(3.0).sqrt() * cone.friction();
        let smallest = (T::ONE - a) / (T::ONE + a + a);
        Self { printed: elasticity.lateral_ratio(), smallest }
    }

    /// Whether (76) as printed lies inside the yield surface. If not, the first correction of the
    /// stress takes some of the soil's weight off.
    pub fn printed_is_admissible(&self) -> bool {
        self.printed >= self.smallest
    }

    /// The one to start from: that printed, but at least a thousandth more than the smallest.
    pub fn admissible(&self) -> T {
        self.printed.max(self.smallest * T::of(1.001))
    }
}
