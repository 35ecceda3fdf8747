//! Density reinitialisation (70), on the true density.

use super::Mixture;
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
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

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    /// Replaces densities by their Shepard mean (70), on the true density; the energy is booked.
    pub fn reinitialise_density(&mut self) {
        self.find_neighbours();
        let water = &self.water;
        self.neighbourhood.pack::<ShepardCompression<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[T::ZERO, T::ZERO],
            &|i, record: &mut [T]| {
                record[0] = water.volume(i);
                record[1] = water.compression(i);
            },
        );
        let formula = ShepardCompression::<K, D> { kernel: self.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let before = self.compressive_energy();
        let own = self.kernel.value(T::ZERO);
        for i in self.water.wall_particles()..self.water.len() {
            let (volume, e) = (self.water.volume(i), self.water.compression(i));
            let weight = self.scratch.extra.get(i, 0) + volume * own;
            let mean = (self.scratch.extra.get(i, 1) + volume * e * own) / weight; // (70)
            let shift = (mean - e) * self.water.volume_fraction[i];
            self.water.shift_excess(i, shift);
        }
        let lost = before - self.compressive_energy();
        for exchanged in &mut self.exchanged {
            exchanged.taken[Account::Reinitialisation] += lost;
        }
    }
}
