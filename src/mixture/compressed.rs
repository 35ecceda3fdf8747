//! What the sums over compressions read of a particle.

use super::Phase;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{Record, number, vector};

/// Record: x, volume, compression.
#[derive(Clone, Copy)]
pub(crate) struct Compressed<N: Copy, const D: usize> {
    pub(crate) x: Vector<N, D>,
    pub(crate) volume: N,
    pub(crate) compression: N,
}

impl<N: Num, const D: usize> Compressed<N, D> {
    /// Length of the record.
    pub(crate) const LENGTH: usize = D + 2;

    #[inline(always)]
    pub(crate) fn read(record: &Record<N>) -> Self {
        Self { x: vector(record, 0), volume: number(record, D), compression: number(record, D + 1) }
    }
}

/// Writes volume and compression of particle `i` behind its place.
pub(crate) fn write<T: Real, const D: usize, M: Material<T>>(
    record: &mut [T],
    phase: &Phase<T, D, M>,
    i: usize,
) {
    record[0] = phase.volume(i);
    record[1] = phase.compression(i);
}
