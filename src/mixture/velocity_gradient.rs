//! The velocity gradient (62), (65), (66).

use crate::kernel::Kernel;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, number, vector};

/// `Σ_j w_j (v_j − v_i)^α ∂_βW`, sum number `αD + β`; record: x, v, w.
///
/// With `w_j = m_j`, divided by `ρ_i`, it is conjugate to the stress sums of (55), (58): the work of
/// stress is then exactly `Σ V φ τ:∇v`. With `w_j = m_j/ρ_j` it is (62), (65) as printed.
pub(crate) struct VelocityGradient<K, const D: usize> {
    pub(crate) kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Moving<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    weight: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for VelocityGradient<K, D> {
    const BLOCKS: usize = (2 * D + 1).div_ceil(4);
    const SUMS: usize = D * D;
    type At<N: Num<Scalar = T>> = Moving<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Moving<N, D> {
        Moving { x: vector(record, 0), v: vector(record, D), weight: number(record, 2 * D) }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Moving<N, D>, j: &Moving<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (i.x - j.x, j.v - i.v);
        let slope = x * (self.kernel.slope(x.norm2()) * j.weight);
        for a in 0..D {
            for b in 0..D {
                sums[a * D + b] += v.0[a] * slope.0[b];
            }
        }
    }
}
