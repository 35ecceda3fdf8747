//! Which way a wall lies, as the soil beside it sees it.
//!
//! From a wall particle below the end of a heap all soil lies to one side: the direction to it is tilted,
//! and a flat floor would push the heap along. From the soil the same floor is flat: it goes on beyond the
//! heap. So each particle of soil looks which way the wall is, and the wall takes their mean.

use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::setting::Setting;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, add_vector, number, vector};

/// `Σ V_j ∇W` over walls, which points at them; record: x, V.
struct Towards<K, const D: usize> {
    kernel: K,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Towards<K, D> {
    const BLOCKS: usize = 1;
    const SUMS: usize = D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = (Vector<N, D>, N);

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Self::At<N> {
        (vector(record, 0), number(record, D))
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Self::At<N>, j: &Self::At<N>, sums: &mut [N; MOST]) {
        let x = i.0 - j.0;
        add_vector(sums, 0, x * (j.1 * self.kernel.slope(x.norm2())));
    }
}

/// `Σ a_j W`; record: x, a.
struct Mean<K, const D: usize> {
    kernel: K,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Mean<K, D> {
    const BLOCKS: usize = (2 * D).div_ceil(4);
    const SUMS: usize = D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = (Vector<N, D>, Vector<N, D>);

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Self::At<N> {
        (vector(record, 0), vector(record, D))
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Self::At<N>, j: &Self::At<N>, sums: &mut [N; MOST]) {
        let x = i.0 - j.0;
        add_vector(sums, 0, j.1 * self.kernel.value(x.norm2()));
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Unit normal of each wall particle, into the wall; zero where no soil is in reach.
    pub(super) fn find_wall_normals<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let walls = self.phase.wall_particles();
        let scratch = &mut self.scratch;
        let (phase, kernel) = (&self.phase, &setting.kernel);
        let dummy = [T::ZERO; 3];
        let towards = Towards::<K, D> { kernel: kernel.clone() };
        self.neighbourhood.pack::<Towards<K, D>>(
            &phase.position,
            &mut scratch.records,
            &dummy[..1],
            &|i, record: &mut [T]| record[0] = if i < walls { phase.volume(i) } else { T::ZERO },
        );
        self.neighbourhood.sum(&towards, &scratch.records, &mut scratch.extra);
        let (mean, seen) = (Mean::<K, D> { kernel: kernel.clone() }, &scratch.extra);
        self.neighbourhood.pack::<Mean<K, D>>(
            &phase.position,
            &mut scratch.records,
            &dummy[..D],
            &|i, record: &mut [T]| record[..D].copy_from_slice(&vector_sum::<T, D>(seen, i, 0).0),
        );
        self.neighbourhood.sum_first(walls, &mean, &scratch.records, &mut scratch.sums);
        let unit = |x: Vector<T, D>| x * (T::ONE / x.norm().max(T::of(1e-30)));
        scratch.wall_normal.clear();
        scratch.wall_normal.extend((0..walls).map(|i| unit(vector_sum(&scratch.sums, i, 0))));
    }
}
