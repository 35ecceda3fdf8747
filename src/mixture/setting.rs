//! What all constituents of a mixture share: kernel, gravity, body force, time.

use super::opening::Region;
use crate::real::Real;
use crate::space::Vector;
use std::sync::Arc;

type Field<T, const D: usize, V> = Arc<dyn Fn(&Vector<T, D>, f64) -> V + Send + Sync>;

/// A body force per mass, with its potential if it has one.
#[derive(Clone)]
pub(super) struct BodyForce<T, const D: usize> {
    pub(super) acceleration: Field<T, D, Vector<T, D>>,
    pub(super) potential: Option<Field<T, D, f64>>,
}

/// Everything outside the particles.
pub(super) struct Setting<T, const D: usize, K> {
    pub(super) kernel: K,
    pub(super) gravity: Vector<T, D>,
    pub(super) force: Option<BodyForce<T, D>>,
    /// Where particles leave.
    pub(super) outlets: Vec<Region<D>>,
    /// What they must not leave otherwise.
    pub(super) domain: Option<Region<D>>,
    /// t \[s\].
    pub(super) time: f64,
}

impl<T: Real, const D: usize, K> Setting<T, D, K> {
    pub(super) fn new(kernel: K) -> Self {
        Self { kernel, gravity: Vector::zero(), force: None, outlets: Vec::new(), domain: None, time: 0.0 }
    }
}
