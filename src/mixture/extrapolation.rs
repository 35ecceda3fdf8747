//! The pass that gives extrapolated walls their pressure, velocity and stress (Adami et al. 2012).

use crate::kernel::Kernel;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, add_vector, number, vector};

/// What a wall particle gathers from the material beside it; record: x, v, volume, pressure, true
/// density.
pub(crate) struct Extrapolation<K, const D: usize> {
    pub(crate) kernel: K,
}

/// Places of the sums; `Σ V ρ̃ x_wf W` follows at [`sum::LEVER`], `Σ V v W` after it.
pub(crate) mod sum {
    /// `Σ V W`.
    pub(crate) const WEIGHT: usize = 0;
    /// `Σ V p W`.
    pub(crate) const PRESSURE: usize = 1;
    /// `Σ V ρ̃ (x_w − x_f) W`.
    pub(crate) const LEVER: usize = 2;
}

#[derive(Clone, Copy)]
pub(crate) struct Fluid<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    volume: N,
    pressure: N,
    true_density: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Extrapolation<K, D> {
    const BLOCKS: usize = (2 * D + 3).div_ceil(4);
    const SUMS: usize = 2 + 2 * D;
    type At<N: Num<Scalar = T>> = Fluid<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Fluid<N, D> {
        Fluid {
            x: vector(record, 0),
            v: vector(record, D),
            volume: number(record, 2 * D),
            pressure: number(record, 2 * D + 1),
            true_density: number(record, 2 * D + 2),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Fluid<N, D>, j: &Fluid<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let weight = j.volume * self.kernel.value(x.norm2());
        sums[sum::WEIGHT] += weight;
        sums[sum::PRESSURE] += weight * j.pressure;
        add_vector(sums, sum::LEVER, x * (weight * j.true_density));
        add_vector(sums, sum::LEVER + D, j.v * weight);
    }
}

/// `Σ V W` and `Σ V τ W` for wall particles; record: x, volume, τ.
pub(crate) struct StressExtrapolation<K, const D: usize> {
    pub(crate) kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Stressed<N: Copy, const D: usize> {
    x: Vector<N, D>,
    volume: N,
    stress: [N; 6],
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for StressExtrapolation<K, D> {
    const BLOCKS: usize = (D + 7).div_ceil(4);
    const SUMS: usize = 7;
    type At<N: Num<Scalar = T>> = Stressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Stressed<N, D> {
        let mut stress = [N::lit(0.0); 6];
        for k in 0..6 {
            stress[k] = number(record, D + 1 + k);
        }
        Stressed { x: vector(record, 0), volume: number(record, D), stress }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Stressed<N, D>, j: &Stressed<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let weight = j.volume * self.kernel.value(x.norm2());
        sums[0] += weight;
        for k in 0..6 {
            sums[1 + k] += weight * j.stress[k];
        }
    }
}
