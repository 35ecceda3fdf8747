//! Density reinitialisation (70), on the true density.

use super::compressed::{self, Compressed};
use super::constituent::Constituent;
use super::setting::Setting;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::summation::{MOST, PairFormula, Record};

/// `Σ V W` and `Σ V e W` over the neighbours, without the particle itself; record: x, volume, e.
pub(crate) struct ShepardCompression<K, const D: usize> {
    pub(crate) kernel: K,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for ShepardCompression<K, D> {
    const BLOCKS: usize = Compressed::<T, D>::LENGTH.div_ceil(4);
    const SUMS: usize = 2;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Compressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Compressed<N, D> {
        Compressed::read(record)
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Compressed<N, D>, j: &Compressed<N, D>, sums: &mut [N; MOST]) {
        let weight = j.volume * self.kernel.value((i.x - j.x).norm2());
        sums[0] += weight;
        sums[1] += weight * j.compression;
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Replaces densities by their Shepard mean (70), on the true density; returns the energy that took
    /// \[J\].
    pub(super) fn reinitialise_density<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) -> f64 {
        self.find_neighbours();
        let phase = &self.phase;
        self.neighbourhood.pack::<ShepardCompression<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO, T::ZERO],
            &|i, record: &mut [T]| compressed::write(record, phase, i),
        );
        let formula = ShepardCompression::<K, D> { kernel: setting.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let before = self.stored_energy();
        let own = setting.kernel.value(T::ZERO);
        for i in self.phase.wall_particles()..self.phase.len() {
            let (volume, e) = (self.phase.volume(i), self.phase.compression(i));
            let weight = self.scratch.extra.get(i, 0) + volume * own;
            let mean = (self.scratch.extra.get(i, 1) + volume * e * own) / weight; // (70)
            let shift = (mean - e) * self.phase.volume_fraction[i];
            self.phase.shift_excess(i, shift);
        }
        before - self.stored_energy()
    }
}
