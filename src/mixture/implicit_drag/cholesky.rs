//! A sparse Cholesky factor of the whole system: the only file that names faer.
//!
//! The matrix of soil and water is sparser than the Schur complement, and its factor solves that too: with nothing
//! on the soil's side, what the water gets is the complement's solution. faer is asked for one thread; its bits may
//! differ from machine to machine.

use super::conjugate_gradients::Precondition;
use super::pairs::{Pairs, Rows};
use super::scheme::Stage;
use crate::space::Vector;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{self, LltRef, SymbolicCholesky, SymmetricOrdering};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

/// Where the matrix may have entries, and the elimination that goes with it; of the upper triangle by columns, soil
/// first.
#[derive(Debug)]
pub(super) struct Pattern {
    starts: Vec<usize>,
    rows: Vec<usize>,
    soil: usize,
    symbolic: SymbolicCholesky<usize>,
    /// Of how many rebuilt lists it is.
    pub(super) rebuilds: u64,
}

impl Pattern {
    /// Of all pairs the lists name, by water; none if there are too many for the memory.
    pub(super) fn new(listed: &Rows, soil: usize, rebuilds: u64) -> Option<Self> {
        let mut starts: Vec<usize> = (0..=soil).collect();
        let mut rows: Vec<usize> = (0..soil).collect();
        for a in 0..listed.len() {
            let first = rows.len();
            rows.extend(listed.of(a).map(|(i, _)| i));
            rows[first..].sort_unstable();
            let kept = dedup(&mut rows[first..]);
            rows.truncate(first + kept);
            rows.push(soil + a);
            starts.push(rows.len());
        }
        let size = soil + listed.len();
        let matrix = SymbolicSparseColMatRef::new_checked(size, size, &starts, None, &rows);
        let symbolic = cholesky::factorize_symbolic_cholesky(
            matrix,
            Side::Upper,
            SymmetricOrdering::Amd,
            Default::default(),
        );
        symbolic.ok().map(|symbolic| Self { starts, rows, soil, symbolic, rebuilds })
    }
}

/// Moves the distinct numbers of an ascending list to its front; returns how many there are.
fn dedup(list: &mut [usize]) -> usize {
    let mut kept = 0;
    for n in 0..list.len() {
        if kept == 0 || list[n] != list[kept - 1] {
            list[kept] = list[n];
            kept += 1;
        }
    }
    kept
}

/// The factor of one stage.
pub(super) struct Factor<'a> {
    pattern: &'a Pattern,
    values: Vec<f64>,
    held: usize,
}

impl<'a> Factor<'a> {
    /// None, if rounding leaves the matrix not positive definite, or a pair is not in the pattern.
    pub(super) fn new<const D: usize>(
        pattern: &'a Pattern,
        pairs: &Pairs,
        stage: &Stage<'_, D>,
    ) -> Option<Self> {
        let size = pattern.starts.len() - 1;
        let mut entries = vec![0.0; pattern.rows.len()];
        for i in 0..pattern.soil {
            let drag = stage.step * pairs.of_soil.sum(i);
            entries[i] = if stage.is_held(i) { 1.0 } else { stage.masses[i] + drag };
        }
        for a in 0..pairs.of_water.len() {
            let column = pattern.starts[pattern.soil + a]..pattern.starts[pattern.soil + a + 1];
            let (last, is_held) = (column.end - 1, stage.is_held(pattern.soil + a));
            let drag = stage.step * pairs.of_water.sum(a);
            entries[last] = if is_held { 1.0 } else { stage.masses[pattern.soil + a] + drag };
            for (i, k) in pairs.of_water.of(a).filter(|(i, _)| !is_held && !stage.is_held(*i)) {
                let at = pattern.rows[column.clone()].binary_search(&i).ok()?;
                entries[column.start + at] -= stage.step * k;
            }
        }
        let matrix = SymbolicSparseColMatRef::new_checked(size, size, &pattern.starts, None, &pattern.rows);
        let matrix = SparseColMatRef::new(matrix, &entries);
        let symbolic = &pattern.symbolic;
        let mut values = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut buffer = MemBuffer::try_new(scratch).ok()?;
        let stack = MemStack::new(&mut buffer);
        let factor = symbolic.factorize_numeric_llt(
            &mut values,
            matrix,
            Side::Upper,
            Default::default(),
            Par::Seq,
            stack,
            Default::default(),
        );
        factor.ok()?;
        Some(Self { pattern, values, held: stage.held[1] })
    }
}

impl<const D: usize> Precondition<D> for Factor<'_> {
    fn apply(&self, residual: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        let (soil, size) = (self.pattern.soil, self.pattern.soil + residual.len());
        let mut sides = vec![0.0; size * D];
        for k in 0..D {
            for (a, r) in residual.iter().enumerate().skip(self.held) {
                sides[k * size + soil + a] = r[k];
            }
        }
        let symbolic = &self.pattern.symbolic;
        let mut buffer = MemBuffer::new(symbolic.solve_in_place_scratch::<f64>(D, Par::Seq));
        LltRef::new(symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut sides, size, D),
            Par::Seq,
            MemStack::new(&mut buffer),
        );
        for (a, out) in out.iter_mut().enumerate() {
            *out = Vector(core::array::from_fn(|k| sides[k * size + soil + a]));
        }
    }
}
