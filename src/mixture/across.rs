//! Who of one constituent is near whom of the other, and the sums between them.

use super::Phase;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::Real;
use crate::space::Vector;
use crate::summation::{Aligned, Neighbourhood, PairFormula, Sums};

/// The particles of soil and water in one cloud, soil first; each lists those of the other constituent.
pub(super) struct Across<T: Real, const D: usize> {
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

impl<T: Real, const D: usize> Across<T, D> {
    pub(super) fn new(neighbourhood: Neighbourhood<T, D>) -> Self {
        Self {
            neighbourhood,
            positions: Vec::new(),
            shifts: Vec::new(),
            soil: 0,
            sorted: [0; 2],
            records: Aligned::default(),
        }
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

    /// Sums a formula over both constituents; `of_soil(i, rest)` and `of_water(a, rest)` write what
    /// stands behind a particle's place.
    pub(super) fn sum<F: PairFormula<T>>(
        &mut self,
        formula: &F,
        dummy: &[T],
        of_soil: &(impl Fn(usize, &mut [T]) + Sync),
        of_water: &(impl Fn(usize, &mut [T]) + Sync),
        sums: &mut Sums<T>,
    ) {
        let soil = self.soil;
        let write = |i: usize, record: &mut [T]| match i.checked_sub(soil) {
            None => of_soil(i, record),
            Some(a) => of_water(a, record),
        };
        self.neighbourhood.pack::<F>(&self.positions, &mut self.records, dummy, &write);
        self.neighbourhood.sum(formula, &self.records, sums);
    }

    /// Calls `visit(a, xᵢ − x_a, r²)` for the water particles `a` near soil particle `i`.
    pub(super) fn for_each_water_near(&self, i: usize, mut visit: impl FnMut(usize, Vector<T, D>, T)) {
        self.neighbourhood.for_each_neighbour(&self.positions, i, |j, x, r2| visit(j - self.soil, x, r2));
    }

    /// S_i = Σ V_a W \[-\]: how much of the surroundings of soil particle `i` water fills.
    pub(super) fn filled<K: Kernel<T, D>, F: Material<T>>(
        &self,
        kernel: &K,
        water: &Phase<T, D, F>,
        i: usize,
    ) -> T {
        let mut filled = T::ZERO;
        self.for_each_water_near(i, |a, _, r2| filled += water.volume(a) * kernel.value(r2));
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
