//! Who drags whom, and how hard: the pair coefficients as a sparse matrix.

use super::bond::{Block, Bond};
use crate::material::Material;
use crate::mixture::Phase;
use crate::mixture::across::Across;
use crate::mixture::drag::Drag;
use crate::mixture::projected_drag::nothing;
use crate::parallel;
use crate::real::Real;
use crate::space::Vector;

/// Rows of a sparse matrix.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows<E> {
    /// Where each row ends; it begins where the one before ends.
    ends: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<E>,
}

impl<E: Copy + Default> Rows<E> {
    /// Columns and values of a row.
    #[inline(always)]
    pub(super) fn of(&self, row: usize) -> impl Iterator<Item = (usize, E)> {
        let start = if row > 0 { self.ends[row - 1] } else { 0 };
        let entries = start..self.ends[row];
        self.columns[entries.clone()].iter().map(|&j| j as usize).zip(self.values[entries].iter().copied())
    }

    /// How many rows there are.
    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The sum of a row.
    pub(super) fn sum<const D: usize>(&self, row: usize) -> E::Block
    where
        E: Bond<D>,
    {
        let mut sum = E::Block::zero();
        for (_, bond) in self.of(row) {
            sum += bond.block();
        }
        sum
    }

    /// Σ K P x(j) over the entries j of a row. Every other entry goes to a sum of its own: one addition need not wait
    /// for the last.
    #[inline(always)]
    pub(super) fn pulled<const D: usize>(
        &self,
        row: usize,
        x: impl Fn(usize) -> Vector<f64, D>,
    ) -> Vector<f64, D>
    where
        E: Bond<D>,
    {
        let start = if row > 0 { self.ends[row - 1] } else { 0 };
        let (columns, values) = (&self.columns[start..self.ends[row]], &self.values[start..self.ends[row]]);
        let mut sums = [Vector::zero(); 2];
        let (mut columns, mut values) = (columns.chunks_exact(2), values.chunks_exact(2));
        for (j, bond) in columns.by_ref().zip(values.by_ref()) {
            sums[0] += bond[0].pull(x(j[0] as usize));
            sums[1] += bond[1].pull(x(j[1] as usize));
        }
        for (j, bond) in columns.remainder().iter().zip(values.remainder()) {
            sums[0] += bond.pull(x(*j as usize));
        }
        sums[0] + sums[1]
    }

    fn push(&mut self, column: usize, value: E) {
        self.columns.push(column as u32);
        self.values.push(value);
    }

    fn end_row(&mut self) {
        self.ends.push(self.columns.len());
    }

    /// These rows, and the others below.
    fn above(mut self, others: &Self) -> Self {
        let before = self.columns.len();
        self.ends.extend(others.ends.iter().map(|end| before + end));
        self.columns.extend_from_slice(&others.columns);
        self.values.extend_from_slice(&others.values);
        self
    }

    /// The matrix of `columns` columns transposed, with the same bits.
    fn transposed(&self, columns: usize) -> Self {
        let mut starts = vec![0; columns + 1];
        for &j in &self.columns {
            starts[j as usize + 1] += 1;
        }
        for j in 0..columns {
            starts[j + 1] += starts[j];
        }
        let ends = starts[1..].to_vec();
        let mut turned = Self {
            ends,
            columns: vec![0; self.columns.len()],
            values: vec![E::default(); self.values.len()],
        };
        for row in 0..self.len() {
            for (j, value) in self.of(row) {
                turned.columns[starts[j]] = row as u32;
                turned.values[starts[j]] = value;
                starts[j] += 1;
            }
        }
        turned
    }
}

/// The drag of each pair of soil and water, K_ia = V_i V_a C_a W_ia \[kg/s\], by soil and by water.
#[derive(Clone, Debug)]
pub(super) struct Pairs<E> {
    pub(super) of_soil: Rows<E>,
    pub(super) of_water: Rows<E>,
}

/// Who may drag whom until the lists are made again: the soil listed for each water particle.
pub(super) fn listed<T: Real, const D: usize>(across: &Across<T, D>, soil: usize, water: usize) -> Rows<()> {
    let mut rows = Rows::default();
    for i in 0..soil {
        across.listed_water(i).for_each(|a| rows.push(a, ()));
        rows.end_row();
    }
    rows.transposed(water)
}

impl<E: Copy + Default + Send + Sync> Pairs<E> {
    /// With the neighbours listed last, the densities of now and C_a \[kg/m³/s\] at each water particle.
    pub(super) fn of<T: Real, const D: usize, S: Material<T>, F: Material<T>>(
        (across, drag): (&Across<T, D>, &Drag<T>),
        soil: &Phase<T, D, S>,
        water: &Phase<T, D, F>,
        coefficient: impl Fn(usize) -> T,
    ) -> Self
    where
        E: Bond<D>,
    {
        let nothing = nothing(across.kernel.length()).as_f64();
        // V_a C_a.
        let strengths: Vec<f64> =
            (0..water.len()).map(|a| (water.volume(a) * coefficient(a)).as_f64()).collect();
        let rows = |range: core::ops::Range<usize>| {
            let mut rows = Rows::default();
            for i in range {
                if !soil.is_apart(i) {
                    let volume = drag.soil_side(soil, i, || across.filled(water, i)).as_f64();
                    across.for_each_water_near(i, |a, away, r2| {
                        let coefficient = volume * strengths[a] * across.kernel.weight(r2).as_f64();
                        rows.push(a, E::new(coefficient, Vector(away.as_f64()), nothing));
                    });
                }
                rows.end_row();
            }
            rows
        };
        let of_soil = parallel::reduce(soil.len(), Rows::default(), rows, |above, below| above.above(&below));
        let of_water = of_soil.transposed(water.len());
        Self { of_soil, of_water }
    }

    /// With each pair times the factor of its water particle.
    pub(super) fn times<const D: usize>(&self, factors: &[f64]) -> Self
    where
        E: Bond<D>,
    {
        let mut pairs = self.clone();
        for (value, &a) in pairs.of_soil.values.iter_mut().zip(&pairs.of_soil.columns) {
            *value = value.times(factors[a as usize]);
        }
        let mut start = 0;
        for (&end, factor) in pairs.of_water.ends.iter().zip(factors) {
            pairs.of_water.values[start..end].iter_mut().for_each(|value| *value = value.times(*factor));
            start = end;
        }
        pairs
    }

    /// |v_a − Σ K_ia v_i/Σ K_ia| at each water particle \[m/s\], of velocities with the soil first.
    pub(super) fn slips<const D: usize>(&self, velocity: &[Vector<f64, D>]) -> Vec<f64>
    where
        E: Bond<D>,
    {
        let (soil, water) = velocity.split_at(self.of_soil.len());
        let slip = |(a, v): (usize, &Vector<f64, D>)| {
            let (mut slip, mut weight) = (Vector::zero(), 0.0);
            for (i, bond) in self.of_water.of(a) {
                slip += (*v - soil[i]) * bond.coefficient();
                weight += bond.coefficient();
            }
            if weight > 0.0 { slip.norm() / weight } else { 0.0 }
        };
        water.iter().enumerate().map(slip).collect()
    }
}
