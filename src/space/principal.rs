//! A symmetric tensor along its own axes.

use super::SymTensor;
use crate::real::Real;

/// Principal values, largest first, and their directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Principal<T> {
    pub(crate) values: [T; 3],
    directions: [[T; 3]; 3],
}

impl<T: Real> Principal<T> {
    /// Of a tensor; `None` if it holds a number that is not finite.
    pub(crate) fn of(tensor: &SymTensor<T>) -> Option<Self> {
        let (values, directions) = T::eigen(&tensor.square())?;
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| values[b].partial_cmp(&values[a]).unwrap_or(core::cmp::Ordering::Equal));
        Some(Self { values: order.map(|k| values[k]), directions: order.map(|k| directions[k]) })
    }
    /// The tensor with these values along the same directions.
    pub(crate) fn with(&self, values: &[T; 3]) -> SymTensor<T> {
        let mut out = SymTensor::zero();
        for (n, &value) in self.directions.iter().zip(values) {
            let [x, y, z] = *n;
            out = out + SymTensor([x * x, y * y, z * z, x * y, y * z, x * z]) * value;
        }
        out
    }
}
