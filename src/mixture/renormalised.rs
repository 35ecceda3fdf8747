//! Density diffusion with the renormalised density gradient (Antuono et al. 2010).

use crate::kernel::Kernel;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, add_vector, number, vector};

/// First pass: `Σ V_j (e_j − e_i) ∇W` (numbers `0..D`) and `Σ V_j (x_j − x_i)⊗∇W` (then, `D + αD + β`);
/// record: x, volume, e.
pub(crate) struct CompressionGradient<K, const D: usize> {
    pub(crate) kernel: K,
}

/// Second pass: `Σ V_j [(e_i − e_j) − ½(∇e_i + ∇e_j)·x_ij] F`; record: x, volume, e, ∇e.
pub(crate) struct RenormalisedDiffusion<K, const D: usize> {
    pub(crate) kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Compressed<N: Copy, const D: usize> {
    x: Vector<N, D>,
    volume: N,
    compression: N,
    gradient: Vector<N, D>,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for CompressionGradient<K, D> {
    const BLOCKS: usize = (D + 2).div_ceil(4);
    const SUMS: usize = D + D * D;
    type At<N: Num<Scalar = T>> = Compressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Compressed<N, D> {
        Compressed {
            x: vector(record, 0),
            volume: number(record, D),
            compression: number(record, D + 1),
            gradient: Vector::zero(),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Compressed<N, D>, j: &Compressed<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let slope = x * (self.kernel.slope(x.norm2()) * j.volume);
        add_vector(sums, 0, slope * (j.compression - i.compression));
        for a in 0..D {
            for b in 0..D {
                sums[D + a * D + b] -= x.0[a] * slope.0[b];
            }
        }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for RenormalisedDiffusion<K, D> {
    const BLOCKS: usize = (2 * D + 2).div_ceil(4);
    const SUMS: usize = 1;
    type At<N: Num<Scalar = T>> = Compressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Compressed<N, D> {
        Compressed {
            x: vector(record, 0),
            volume: number(record, D),
            compression: number(record, D + 1),
            gradient: vector(record, D + 2),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Compressed<N, D>, j: &Compressed<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let explained = (i.gradient + j.gradient).dot(x) * N::lit(0.5);
        let unexplained = i.compression - j.compression - explained;
        sums[0] += j.volume * self.kernel.slope(x.norm2()) * unexplained;
    }
}
