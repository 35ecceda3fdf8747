//! The law of a constituent that is not there.

use super::{Loss, Material};
use crate::real::Real;
use crate::space::{SymTensor, Tensor};

/// The law of a constituent that a mixture does without, such as the soil of water alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Absent;

impl<T: Real> Material<T> for Absent {
    type Memory = ();

    fn reference_density(&self) -> T {
        T::ONE
    }

    fn sound_speed(&self) -> T {
        T::ONE
    }

    fn pressure(&self, _: T, (): &()) -> T {
        T::ZERO
    }

    fn compression(&self, _: T) -> T {
        T::ZERO
    }

    fn hydrostatic_slope(&self) -> (T, T) {
        (T::ZERO, T::ZERO)
    }

    fn needs_velocity_gradient(&self) -> bool {
        false
    }

    fn deviator(&self, _: &Tensor<T>, (): &()) -> SymTensor<T> {
        SymTensor::zero()
    }

    fn rate(&self, _: &Tensor<T>, (): &()) {}

    fn admit(&self, (): ()) -> ((), Loss<T>) {
        ((), Loss::none())
    }

    fn kinematic_viscosity(&self) -> T {
        T::ZERO
    }

    fn stored_energy(&self, _: T, (): &()) -> f64 {
        0.0
    }
}
