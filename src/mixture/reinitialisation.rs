//! Density reinitialisation (70), on the true density.

use crate::kernel::Kernel;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, number, vector};

/// `Σ V W` and `Σ V e W` over the neighbours, without the particle itself; record: x, volume, e.
pub(crate) struct ShepardCompression<K, const D: usize> {
    pub(crate) kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Compressed<N: Copy, const D: usize> {
    x: Vector<N, D>,
    volume: N,
    compression: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for ShepardCompression<K, D> {
    const BLOCKS: usize = (D + 2).div_ceil(4);
    const SUMS: usize = 2;
    type At<N: Num<Scalar = T>> = Compressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Compressed<N, D> {
        Compressed { x: vector(record, 0), volume: number(record, D), compression: number(record, D + 1) }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Compressed<N, D>, j: &Compressed<N, D>, sums: &mut [N; MOST]) {
        let weight = j.volume * self.kernel.value((i.x - j.x).norm2());
        sums[0] += weight;
        sums[1] += weight * j.compression;
    }
}
