//! Who of one constituent is near whom of the other, and the sums between them.

use super::Phase;
use super::between::{Between, Pass};
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::Real;
use crate::space::Vector;
use crate::summation::{Aligned, Neighbourhood, PairFormula, Sums};
use std::sync::Arc;

/// The particles of soil and water in one cloud, soil first; each lists those of the other constituent.
pub(super) struct Across<T: Real, const D: usize> {
    /// The kernel of all sums between soil and water.
    pub(super) kernel: Arc<dyn Between<T, D>>,
    pub(super) neighbourhood: Neighbourhood<T, D>,
    positions: Vec<Vector<T, D>>,
    /// What takes each particle into the periodic box it was listed in: the constituents are taken there
    /// at other moments.
    shifts: Vec<Vector<T, D>>,
    soil: usize,
    /// How often each constituent had been re-sorted when the lists were made.
    sorted: [u64; 2],
    records: Aligned<T>,
}

/// What the records of a pass say of each particle behind its place.
pub(super) struct Records<'a, T> {
    /// What they say of nobody.
    pub(super) dummy: &'a [T],
    pub(super) of_soil: &'a (dyn Fn(usize, &mut [T]) + Sync),
    pub(super) of_water: &'a (dyn Fn(usize, &mut [T]) + Sync),
}

impl<T: Real, const D: usize> Across<T, D> {
    pub(super) fn new(kernel: Arc<dyn Between<T, D>>, neighbourhood: Neighbourhood<T, D>) -> Self {
        Self {
            kernel,
            neighbourhood,
            positions: Vec::new(),
            shifts: Vec::new(),
            soil: 0,
            sorted: [0; 2],
            records: Aligned::default(),
        }
    }

    /// Takes another kernel, and lists as far as that reaches.
    pub(super) fn take_kernel<K: Kernel<T, D>>(&mut self, kernel: K) {
        self.neighbourhood.set_support(kernel.support());
        self.kernel = Arc::new(kernel);
    }

    /// Brings the lists up to date. `sorted` tells how often each constituent has been re-sorted.
    pub(super) fn find_neighbours(
        &mut self,
        soil: &[Vector<T, D>],
        water: &[Vector<T, D>],
        sorted: [u64; 2],
    ) {
        self.positions.clear();
        self.positions.extend_from_slice(soil);
        self.positions.extend_from_slice(water);
        self.soil = soil.len();
        if self.sorted == sorted {
            self.shift();
        }
        if self.sorted != sorted || self.neighbourhood.is_stale(&self.positions) {
            self.positions.clear();
            self.positions.extend_from_slice(soil);
            self.positions.extend_from_slice(water);
            let periodic = *self.neighbourhood.periodic();
            self.shifts = self.positions.iter().map(|x| periodic.wrap(*x) - *x).collect();
            self.shift();
            self.neighbourhood.rebuild_across(&self.positions, self.soil);
            self.sorted = sorted;
        }
    }

    fn shift(&mut self) {
        for (x, shift) in self.positions.iter_mut().zip(&self.shifts) {
            *x += *shift;
        }
    }

    /// What the lists follow from: where the particles were, and what took them there.
    pub(super) fn listed(&self) -> (Vec<Vector<T, D>>, Vec<Vector<T, D>>) {
        (self.neighbourhood.reference_positions().to_vec(), self.shifts.clone())
    }

    /// Makes the lists of another time again, for `soil` particles of soil.
    pub(super) fn list_again(
        &mut self,
        (positions, shifts): (Vec<Vector<T, D>>, Vec<Vector<T, D>>),
        soil: usize,
        sorted: [u64; 2],
    ) {
        if !positions.is_empty() && positions.len() == shifts.len() {
            self.neighbourhood.rebuild_across(&positions, soil);
            (self.shifts, self.soil, self.sorted) = (shifts, soil, sorted);
        }
    }

    /// Sums over both constituents.
    pub(super) fn sum(&mut self, pass: Pass, records: &Records<'_, T>, sums: &mut Sums<T>) {
        let kernel = Arc::clone(&self.kernel);
        kernel.sum(pass, self, records, sums);
    }

    /// Sums a formula over both constituents.
    pub(super) fn sum_with<F: PairFormula<T>>(
        &mut self,
        formula: &F,
        records: &Records<'_, T>,
        sums: &mut Sums<T>,
    ) {
        let soil = self.soil;
        let write = |i: usize, record: &mut [T]| match i.checked_sub(soil) {
            None => (records.of_soil)(i, record),
            Some(a) => (records.of_water)(a, record),
        };
        self.neighbourhood.pack::<F>(&self.positions, &mut self.records, records.dummy, &write);
        self.neighbourhood.sum(formula, &self.records, sums);
    }

    /// Calls `visit(a, xᵢ − x_a, r²)` for the water particles `a` near soil particle `i`.
    pub(super) fn for_each_water_near(&self, i: usize, mut visit: impl FnMut(usize, Vector<T, D>, T)) {
        self.neighbourhood.for_each_neighbour(&self.positions, i, |j, x, r2| visit(j - self.soil, x, r2));
    }

    /// S_i = Σ V_a W \[-\]: how much of the surroundings of soil particle `i` water fills.
    pub(super) fn filled<F: Material<T>>(&self, water: &Phase<T, D, F>, i: usize) -> T {
        let mut filled = T::ZERO;
        self.for_each_water_near(i, |a, _, r2| filled += water.volume(a) * self.kernel.weight(r2));
        filled
    }

    /// The water particles listed for soil particle `i`, near or a little farther.
    #[cfg(feature = "implicit")]
    pub(super) fn listed_water(&self, i: usize) -> impl Iterator<Item = usize> {
        self.neighbourhood.listed(i).map(|j| j - self.soil)
    }

    /// Where the sums of water particle `a` stand.
    #[inline(always)]
    pub(super) fn water(&self, a: usize) -> usize {
        self.soil + a
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.neighbourhood.bytes()
            + self.records.bytes()
            + self.positions.capacity() * size_of::<Vector<T, D>>()
    }
}
