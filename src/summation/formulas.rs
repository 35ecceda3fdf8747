//! What one particle adds to another's value or derivative: the pair formulas of the operators.

use super::{MOST, PairFormula};
use crate::kernel::Kernel;
use crate::real::{Num, Real};
use crate::space::Vector;
use core::marker::PhantomData;

/// A formula of a kernel `W` and perhaps the sign of the own value in it; `Q` tells which one.
pub(super) struct Formula<Q, T, K> {
    pub(super) kernel: K,
    pub(super) sign: T,
    pub(super) which: PhantomData<fn() -> Q>,
}

impl<Q, T: Real, K: Clone> Formula<Q, T, K> {
    pub(super) fn new(kernel: &K, sign: T) -> Self {
        Self { kernel: kernel.clone(), sign, which: PhantomData }
    }
}

/// `Σ w_j W`, `Σ w_j f_j W`; record `x w f`.
pub(super) struct Interpolation<const D: usize>;
/// `Σ w_j (f_j + s f_i) ∇W`; record `x w f`.
pub(super) struct Gradient<const D: usize>;
/// `Σ w_j (f_j + s f_i) ⊗ ∇W` of a vector f; record `x w f`.
pub(super) struct VectorGradient<const D: usize>;
/// `Σ w_j (x_j − x_i) ⊗ ∇W`; record `x w`.
pub(super) struct Moments<const D: usize>;
/// `2 Σ w_j (f_i − f_j) F`; record `x w f`.
pub(super) struct Laplacian<const D: usize>;

/// Number `k` of a record.
#[inline(always)]
fn number<N: Num>(record: &[[N; 4]; 4], k: usize) -> N {
    record[k / 4][k % 4]
}

/// The `D` numbers of a record from number `first` on.
#[inline(always)]
fn vector<N: Num, const D: usize>(record: &[[N; 4]; 4], first: usize) -> Vector<N, D> {
    let mut x = Vector::zero();
    for k in 0..D {
        x.0[k] = number(record, first + k);
    }
    x
}

/// A place, a weight and a value there.
#[derive(Clone, Copy)]
pub(super) struct Valued<N, const D: usize> {
    x: Vector<N, D>,
    w: N,
    f: N,
}

/// A place, a weight and a vector there.
#[derive(Clone, Copy)]
pub(super) struct Directed<N, const D: usize> {
    x: Vector<N, D>,
    w: N,
    f: Vector<N, D>,
}

#[inline(always)]
fn valued<N: Num, const D: usize>(record: &[[N; 4]; 4]) -> Valued<N, D> {
    Valued { x: vector(record, 0), w: number(record, D), f: number(record, D + 1) }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Formula<Interpolation<D>, T, K> {
    const BLOCKS: usize = (D + 2).div_ceil(4);
    const SUMS: usize = 2;
    type At<N: Num<Scalar = T>> = Valued<N, D>;
    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &[[N; 4]; 4]) -> Valued<N, D> {
        valued(record)
    }
    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Valued<N, D>, j: &Valued<N, D>, sums: &mut [N; MOST]) {
        let weight = j.w * self.kernel.value((i.x - j.x).norm2());
        sums[0] += weight;
        sums[1] += weight * j.f; // (44)
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Formula<Gradient<D>, T, K> {
    const BLOCKS: usize = (D + 2).div_ceil(4);
    const SUMS: usize = D;
    type At<N: Num<Scalar = T>> = Valued<N, D>;
    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &[[N; 4]; 4]) -> Valued<N, D> {
        valued(record)
    }
    #[expect(clippy::needless_range_loop, reason = "only plain loops keep the instruction set")]
    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Valued<N, D>, j: &Valued<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let slope = self.kernel.slope(x.norm2());
        let factor = slope * j.w * (j.f + N::splat(self.sign) * i.f);
        for k in 0..D {
            sums[k] += x.0[k] * factor; // (46), (50), (51)
        }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Formula<VectorGradient<D>, T, K> {
    const BLOCKS: usize = (2 * D + 1).div_ceil(4);
    const SUMS: usize = D * D;
    type At<N: Num<Scalar = T>> = Directed<N, D>;
    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &[[N; 4]; 4]) -> Directed<N, D> {
        Directed { x: vector(record, 0), w: number(record, D), f: vector(record, D + 1) }
    }
    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Directed<N, D>, j: &Directed<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let gradient = x * (self.kernel.slope(x.norm2()) * j.w);
        let f = j.f + i.f * N::splat(self.sign);
        for a in 0..D {
            for b in 0..D {
                sums[D * a + b] += f.0[a] * gradient.0[b];
            }
        }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Formula<Moments<D>, T, K> {
    const BLOCKS: usize = (D + 1).div_ceil(4);
    const SUMS: usize = D * D;
    type At<N: Num<Scalar = T>> = (Vector<N, D>, N);
    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &[[N; 4]; 4]) -> (Vector<N, D>, N) {
        (vector(record, 0), number(record, D))
    }
    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(
        &self,
        i: &(Vector<N, D>, N),
        j: &(Vector<N, D>, N),
        sums: &mut [N; MOST],
    ) {
        let x = i.0 - j.0;
        let gradient = x * (self.kernel.slope(x.norm2()) * j.1);
        for a in 0..D {
            for b in 0..D {
                sums[D * a + b] -= x.0[a] * gradient.0[b];
            }
        }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Formula<Laplacian<D>, T, K> {
    const BLOCKS: usize = (D + 2).div_ceil(4);
    const SUMS: usize = 1;
    type At<N: Num<Scalar = T>> = Valued<N, D>;
    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &[[N; 4]; 4]) -> Valued<N, D> {
        valued(record)
    }
    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Valued<N, D>, j: &Valued<N, D>, sums: &mut [N; MOST]) {
        let slope = self.kernel.slope((i.x - j.x).norm2());
        sums[0] += N::lit(2.0) * j.w * (i.f - j.f) * slope;
    }
}
