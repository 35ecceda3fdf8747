//! Packing the particles' records and summing over them.

use super::Neighbourhood;
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::Vector;
use crate::summation::{Aligned, PairFormula, Sums, Then, pair_sum};

impl<T: Real, const D: usize> Neighbourhood<T, D> {
    /// Writes the records of all particles, ghosts and the dummy as formula `F` reads them: the position, then what `fields(i, rest)` writes. A ghost has its owner's fields; the dummy has
    /// `dummy`, and zeros behind it. The dummy stands where kernels vanish; choose its fields so that
    /// the formula stays finite there (mass zero, density one).
    ///
    /// # Panics
    /// The number of positions is not that of the last rebuild, or a record is too short.
    pub(crate) fn pack<F: PairFormula<T>>(
        &self,
        positions: &[Vector<T, D>],
        records: &mut Aligned<T>,
        dummy: &[T],
        fields: &(impl Fn(usize, &mut [T]) + Sync),
    ) {
        assert_eq!(positions.len(), self.particles);
        let length = const { 4 * F::BLOCKS };
        records.resize((self.points.len() + 1) * length);
        let (own, rest) = records.as_mut_slice().split_at_mut(self.particles * length);
        let (images, last) = rest.split_at_mut(self.ghosts.len() * length);
        parallel::for_each_part(own, length, CHUNK, &|first, part: &mut [T]| {
            // A constant length inside the loop saves every check of an index.
            for (offset, record) in part.chunks_exact_mut(const { 4 * F::BLOCKS }).enumerate() {
                record[..D].copy_from_slice(&positions[first + offset].0);
                fields(first + offset, &mut record[D..]);
            }
        });
        let own = &*own;
        parallel::for_each_part(images, length, CHUNK, &|first, part: &mut [T]| {
            for (record, ghost) in part.chunks_exact_mut(length).zip(&self.ghosts[first..]) {
                let owner = ghost.owner as usize;
                record.copy_from_slice(&own[owner * length..(owner + 1) * length]);
                record[..D].copy_from_slice(&(positions[owner] + ghost.shift).0);
            }
        });
        last[..D].fill(self.far);
        last[D..].fill(T::ZERO);
        last[D..D + dummy.len()].copy_from_slice(dummy);
    }

    /// Evaluates a formula for every particle, from the records [`pack`](Self::pack) has written.
    pub(crate) fn sum<F: PairFormula<T>>(&self, formula: &F, records: &Aligned<T>, sums: &mut Sums<T>) {
        self.sum_first(self.particles, formula, records, sums);
    }

    /// The same for the first `count` particles at least, such as the walls.
    pub(crate) fn sum_first<F: PairFormula<T>>(
        &self,
        count: usize,
        formula: &F,
        records: &Aligned<T>,
        sums: &mut Sums<T>,
    ) {
        let nothing = core::iter::repeat(());
        pair_sum(formula, (&self.list, count), records.as_slice(), self.set, sums, nothing, &|_, ()| {});
    }

    /// The same for all, and calls `then` with the sums of each chunk of [`Sums::CHUNK`] particles while they
    /// are in the cache, and with its part of `beside`.
    pub(crate) fn sum_and_then<F: PairFormula<T>, X: Send>(
        &self,
        formula: &F,
        records: &Aligned<T>,
        sums: &mut Sums<T>,
        beside: impl Iterator<Item = X>,
        then: Then<T, X>,
    ) {
        pair_sum(formula, (&self.list, self.particles), records.as_slice(), self.set, sums, beside, then);
    }
}
