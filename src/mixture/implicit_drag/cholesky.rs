//! A sparse Cholesky factor of the whole system: the only file that names faer.
//!
//! The matrix of soil and water is sparser than the Schur complement, and its factor solves that too: with nothing
//! on the soil's side, what the water gets is the complement's solution. faer is asked for one thread; its bits may
//! differ from machine to machine.

use super::bond::{Block, Bond};
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
    /// Equations a particle has.
    unknowns: usize,
    symbolic: SymbolicCholesky<usize>,
    /// Of how many rebuilt lists it is.
    pub(super) rebuilds: u64,
}

impl Pattern {
    /// Of all pairs the lists name, by water, with so many equations for a particle; none if there are too many for
    /// the memory.
    pub(super) fn new(listed: &Rows<()>, soil: usize, unknowns: usize, rebuilds: u64) -> Option<Self> {
        let (mut starts, mut rows) = (vec![0], Vec::new());
        let mut column = |pulled: &[usize], particle: usize, direction: usize| {
            rows.extend(pulled.iter().flat_map(|i| i * unknowns..(i + 1) * unknowns));
            rows.extend(particle * unknowns..=particle * unknowns + direction);
            starts.push(rows.len());
        };
        for i in 0..soil {
            (0..unknowns).for_each(|direction| column(&[], i, direction));
        }
        for a in 0..listed.len() {
            let mut pulled: Vec<usize> = listed.of(a).map(|(i, ())| i).collect();
            pulled.sort_unstable();
            pulled.dedup();
            (0..unknowns).for_each(|direction| column(&pulled, soil + a, direction));
        }
        let size = (soil + listed.len()) * unknowns;
        let matrix = SymbolicSparseColMatRef::new_checked(size, size, &starts, None, &rows);
        let symbolic = cholesky::factorize_symbolic_cholesky(
            matrix,
            Side::Upper,
            SymmetricOrdering::Amd,
            Default::default(),
        );
        symbolic.ok().map(|symbolic| Self { starts, rows, soil, unknowns, symbolic, rebuilds })
    }
}

impl Pattern {
    /// Where the entry of row `row` stands, in the column of a direction of a particle.
    fn place(&self, particle: usize, direction: usize, row: usize) -> Option<usize> {
        let column = particle * self.unknowns + direction;
        let column = self.starts[column]..self.starts[column + 1];
        self.rows[column.clone()].binary_search(&row).ok().map(|at| column.start + at)
    }

    /// Writes M + Δt ΣK of a particle; 1 if it is held.
    fn put_diagonal<B: Block<D>, const D: usize>(
        &self,
        entries: &mut [f64],
        particle: usize,
        stage: &Stage<'_, D>,
        drag: B,
    ) {
        let block = drag.with_mass(stage.masses[particle], stage.step);
        for direction in 0..self.unknowns {
            let last = self.starts[particle * self.unknowns + direction + 1] - 1;
            for row in 0..=direction {
                let held = f64::from(u8::from(row == direction));
                let is_held = stage.is_held(particle);
                entries[last + row - direction] = if is_held { held } else { block.entry(row, direction) };
            }
        }
    }
}

/// The factor of one stage.
pub(super) struct Factor<'a> {
    pattern: &'a Pattern,
    values: Vec<f64>,
    held: usize,
}

impl<'a> Factor<'a> {
    /// None, if rounding leaves the matrix not positive definite, or a pair is not in the pattern.
    pub(super) fn new<E: Bond<D>, const D: usize>(
        pattern: &'a Pattern,
        pairs: &Pairs<E>,
        stage: &Stage<'_, D>,
    ) -> Option<Self> {
        let size = pattern.starts.len() - 1;
        let mut entries = vec![0.0; pattern.rows.len()];
        for i in 0..pattern.soil {
            pattern.put_diagonal(&mut entries, i, stage, pairs.of_soil.sum(i));
        }
        for a in 0..pairs.of_water.len() {
            let particle = pattern.soil + a;
            pattern.put_diagonal(&mut entries, particle, stage, pairs.of_water.sum(a));
            if stage.is_held(particle) {
                continue;
            }
            for (i, bond) in pairs.of_water.of(a).filter(|(i, _)| !stage.is_held(*i)) {
                for direction in 0..E::UNKNOWNS {
                    let first = pattern.place(particle, direction, i * E::UNKNOWNS)?;
                    for row in 0..E::UNKNOWNS {
                        entries[first + row] -= stage.step * bond.entry(row, direction);
                    }
                }
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
        let Pattern { soil, unknowns, symbolic, .. } = self.pattern;
        let size = (soil + residual.len()) * unknowns;
        // With an equation for each direction there is one right-hand side, else one for each direction.
        let at = |a: usize, k: usize| (soil + a) * unknowns + if *unknowns == D { k } else { k * size };
        let mut sides = vec![0.0; (soil + residual.len()) * D];
        for (a, r) in residual.iter().enumerate().skip(self.held) {
            for k in 0..D {
                sides[at(a, k)] = r[k];
            }
        }
        let columns = D / unknowns;
        let mut buffer = MemBuffer::new(symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq));
        LltRef::new(symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut sides, size, columns),
            Par::Seq,
            MemStack::new(&mut buffer),
        );
        for (a, out) in out.iter_mut().enumerate() {
            *out = Vector(core::array::from_fn(|k| sides[at(a, k)]));
        }
    }
}
