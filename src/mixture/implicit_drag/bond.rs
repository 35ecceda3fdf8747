//! What a pair of soil and water does to its slip: drag along the slip, or along the line between the two.

use crate::space::{Dense, Vector};
use core::fmt::Debug;
use core::ops::AddAssign;

/// The drag K P of a pair, symmetric and positive: −K P v is what it does to the slip v.
pub(super) trait Bond<const D: usize>: Copy + Default + Debug + Send + Sync + 'static {
    /// Sums of K P.
    type Block: Block<D>;
    /// Equations a particle has: 1 if all directions obey the same.
    const UNKNOWNS: usize;
    /// Of the coefficient K \[kg/s\], for two particles `away` from each other; `nothing` \[m²\] is added to r².
    fn new(coefficient: f64, away: Vector<f64, D>, nothing: f64) -> Self;
    /// K \[kg/s\].
    fn coefficient(self) -> f64;
    /// With K times a factor.
    fn times(self, factor: f64) -> Self;
    /// K P x.
    fn pull(self, x: Vector<f64, D>) -> Vector<f64, D>;
    /// K P Y x.
    fn pull_through(self, yielding: &Self::Block, x: Vector<f64, D>) -> Vector<f64, D>;
    /// K P − K P Y K P, with Y of a particle that this pair is a part of: never below zero.
    fn left(self, yielding: &Self::Block) -> Self;
    /// Row `row` and column `column` of K P.
    fn entry(self, row: usize, column: usize) -> f64;
    /// K P.
    fn block(self) -> Self::Block;
}

/// A symmetric matrix of the directions.
pub(super) trait Block<const D: usize>: Copy + Debug + Send + Sync + AddAssign + 'static {
    fn zero() -> Self;
    /// The mass `mass` \[kg\] and this times the step \[s\].
    fn with_mass(self, mass: f64, step: f64) -> Self;
    /// Its inverse times `factor`; positive definite.
    fn inverse(self, factor: f64) -> Self;
    fn apply(&self, x: Vector<f64, D>) -> Vector<f64, D>;
    /// Σ of the squares of its entries, per direction.
    fn size2(&self) -> f64;
    fn entry(&self, row: usize, column: usize) -> f64;
}

/// Along the slip: P = 1.
impl<const D: usize> Bond<D> for f64 {
    type Block = f64;
    const UNKNOWNS: usize = 1;
    fn new(coefficient: f64, _: Vector<f64, D>, _: f64) -> f64 {
        coefficient
    }
    fn coefficient(self) -> f64 {
        self
    }
    fn times(self, factor: f64) -> f64 {
        self * factor
    }
    fn pull(self, x: Vector<f64, D>) -> Vector<f64, D> {
        x * self
    }
    fn pull_through(self, yielding: &f64, x: Vector<f64, D>) -> Vector<f64, D> {
        x * (self * yielding)
    }
    fn left(self, yielding: &f64) -> f64 {
        self * (1.0 - yielding * self)
    }
    fn entry(self, _: usize, _: usize) -> f64 {
        self
    }
    fn block(self) -> f64 {
        self
    }
}

impl<const D: usize> Block<D> for f64 {
    fn zero() -> f64 {
        0.0
    }
    fn with_mass(self, mass: f64, step: f64) -> f64 {
        mass + step * self
    }
    fn inverse(self, factor: f64) -> f64 {
        factor / self
    }
    fn apply(&self, x: Vector<f64, D>) -> Vector<f64, D> {
        x * *self
    }
    fn size2(&self) -> f64 {
        self * self
    }
    fn entry(&self, _: usize, _: usize) -> f64 {
        *self
    }
}

/// Along the line between the two: P = D r̂ r̂ᵀ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along<const D: usize> {
    coefficient: f64,
    /// √D r̂.
    line: Vector<f64, D>,
}

impl<const D: usize> Default for Along<D> {
    fn default() -> Self {
        Self { coefficient: 0.0, line: Vector::zero() }
    }
}

impl<const D: usize> Bond<D> for Along<D> {
    type Block = Square<D>;
    const UNKNOWNS: usize = D;
    fn new(coefficient: f64, away: Vector<f64, D>, nothing: f64) -> Self {
        Self { coefficient, line: away * (D as f64 / (away.norm2() + nothing)).sqrt() }
    }
    fn coefficient(self) -> f64 {
        self.coefficient
    }
    fn times(self, factor: f64) -> Self {
        Self { coefficient: self.coefficient * factor, ..self }
    }
    fn pull(self, x: Vector<f64, D>) -> Vector<f64, D> {
        self.line * (self.line.dot(x) * self.coefficient)
    }
    fn pull_through(self, yielding: &Self::Block, x: Vector<f64, D>) -> Vector<f64, D> {
        self.pull(Block::apply(yielding, x))
    }
    fn left(self, yielding: &Self::Block) -> Self {
        let yields = self.line.dot(Block::apply(yielding, self.line));
        self.times(1.0 - yields * self.coefficient)
    }
    fn entry(self, row: usize, column: usize) -> f64 {
        self.coefficient * (self.line[row] * self.line[column])
    }
    fn block(self) -> Self::Block {
        Square::of(|row, column| self.entry(row, column))
    }
}

/// Rows of a matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Square<const D: usize>([[f64; D]; D]);

impl<const D: usize> Square<D> {
    fn of(entry: impl Fn(usize, usize) -> f64) -> Self {
        Self(core::array::from_fn(|row| core::array::from_fn(|column| entry(row, column))))
    }
}

impl<const D: usize> AddAssign for Square<D> {
    fn add_assign(&mut self, other: Self) {
        *self = Self::of(|row, column| self.0[row][column] + other.0[row][column]);
    }
}

impl<const D: usize> Block<D> for Square<D> {
    fn zero() -> Self {
        Self([[0.0; D]; D])
    }
    fn with_mass(self, mass: f64, step: f64) -> Self {
        Self::of(|row, column| step * self.0[row][column] + if row == column { mass } else { 0.0 })
    }
    fn inverse(self, factor: f64) -> Self {
        // Positive definite, unless its entries are not numbers: then the solution is none either, and is refused.
        let inverse = Dense::inverse(&self.0).unwrap_or([[f64::NAN; D]; D]);
        Self::of(|row, column| factor * inverse[row][column])
    }
    fn apply(&self, x: Vector<f64, D>) -> Vector<f64, D> {
        Vector(core::array::from_fn(|row| Vector(self.0[row]).dot(x)))
    }
    fn size2(&self) -> f64 {
        self.0.as_flattened().iter().map(|entry| entry * entry).sum::<f64>() / D as f64
    }
    fn entry(&self, row: usize, column: usize) -> f64 {
        self.0[row][column]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K P, Y and what is left of the pair, entry by entry, against the products of matrices.
    fn agrees<E: Bond<D>, const D: usize>() {
        let vector = |shift: f64| Vector(core::array::from_fn(|k| (1.0 + shift + k as f64).sin()));
        let square = |of: &dyn Fn(usize, usize) -> f64| -> [[f64; D]; D] {
            core::array::from_fn(|row| core::array::from_fn(|column| of(row, column)))
        };
        let [first, second] = [0.0, 2.0].map(|shift| E::new(3.0, vector(shift), 1e-9));
        let mut drag = first.block();
        drag += second.block();
        let step = 0.7;
        let yielding = drag.with_mass(2.0, step).inverse(step);
        // D^-1 D = 1.
        for k in 0..D {
            let mut unit = Vector::zero();
            unit[k] = 1.0;
            let back = yielding.apply(drag.with_mass(2.0, step).apply(unit)) * (1.0 / step);
            assert!((back - unit).norm() < 1e-14, "{back:?}");
        }
        let x = vector(5.0);
        let full = |row: usize, column: usize| {
            if E::UNKNOWNS == 1 && row != column { 0.0 } else { first.entry(row, column) }
        };
        let matrix = square(&full);
        let product: [f64; D] = core::array::from_fn(|row| Vector(matrix[row]).dot(x));
        assert!((first.pull(x) - Vector(product)).norm() < 1e-14);
        assert!((first.block().apply(x) - first.pull(x)).norm() < 1e-14);
        assert!((first.pull_through(&yielding, x) - first.pull(yielding.apply(x))).norm() < 1e-14);
        let left = first.pull(x) - first.pull(yielding.apply(first.pull(x)));
        assert!((first.left(&yielding).pull(x) - left).norm() < 1e-13);
        assert!(first.left(&yielding).pull(x).dot(x) >= 0.0);
        assert!((first.times(2.0).pull(x) - first.pull(x) * 2.0).norm() < 1e-14);
    }

    #[test]
    fn a_bond_is_the_matrix_it_stands_for() {
        agrees::<f64, 2>();
        agrees::<f64, 3>();
        agrees::<Along<2>, 2>();
        agrees::<Along<3>, 3>();
    }

    #[test]
    fn along_the_line_nothing_pulls_across_it_and_all_lines_together_pull_as_the_slip() {
        let away = Vector([0.3, -0.4, 0.0]);
        let bond = Along::<3>::new(2.0, away, 0.0);
        assert!(bond.pull(Vector([0.4, 0.3, 1.0])).norm() < 1e-15);
        // D r̂ r̂ᵀ over the axes is D times their mean: 1 each.
        let axes = (0..3).map(|k| {
            let mut away = Vector::zero();
            away[k] = 0.1;
            Along::<3>::new(2.0, away, 0.0).pull(Vector([1.0, 2.0, 3.0])) * (1.0 / 3.0)
        });
        let sum = axes.fold(Vector::zero(), |sum, pull| sum + pull);
        assert!((sum - Vector([2.0, 4.0, 6.0])).norm() < 1e-14, "{sum:?}");
    }
}
