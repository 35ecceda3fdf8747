//! Corrections that make a discrete gradient exact for linear fields.

use super::formulas::{Formula, Moments};
use super::operators::{Cloud, Form};
use crate::kernel::Kernel;
use crate::real::Real;
use crate::space::Vector;

/// The inverse matrices of Bonet & Lok (1999), one for each particle:
/// `L_i = B_i⁻¹`, `B_i = Σ_j m_j/ρ_j (x_j − x_i) ⊗ ∇W_ij`.
#[derive(Clone, Debug)]
pub struct Corrections<T, const D: usize> {
    /// `L_i`; the unit matrix where it does not exist.
    pub matrices: Vec<[[T; D]; D]>,
    /// How many particles have too few neighbours, or all in one plane, and stay uncorrected.
    pub uncorrected: usize,
}

impl<T: Real, const D: usize> Corrections<T, D> {
    /// `L_i x`.
    pub fn apply(&self, i: usize, x: Vector<T, D>) -> Vector<T, D> {
        let rows = &self.matrices[i];
        Vector(core::array::from_fn(|a| (0..D).fold(T::ZERO, |sum, b| sum + rows[a][b] * x[b])))
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> Cloud<'_, T, K, D> {
    /// The matrices that correct gradients of the form [`VolumeDifference`](Form::VolumeDifference).
    pub fn corrections(&self) -> Corrections<T, D> {
        let formula = Formula::<Moments<D>, T, K>::new(self.kernel, T::ZERO);
        let sums = self.sum(&formula, &|j, record| record[0] = self.volume(j));
        let mut uncorrected = 0;
        let invert = |i| {
            let moments = core::array::from_fn(|a| core::array::from_fn(|b| sums.get(i, D * a + b)));
            regular_inverse(&moments).unwrap_or_else(|| {
                uncorrected += 1;
                core::array::from_fn(|a| core::array::from_fn(|b| if a == b { T::ONE } else { T::ZERO }))
            })
        };
        Corrections { matrices: (0..self.len()).map(invert).collect(), uncorrected }
    }

    /// The corrected gradient `L_i Σ_j m_j/ρ_j (f_j − f_i) ∇W_ij`: exact for linear fields at any
    /// arrangement of the particles, surfaces included; not conservative.
    pub fn corrected_gradient(&self, corrections: &Corrections<T, D>, values: &[T]) -> Vec<Vector<T, D>> {
        let gradients = self.gradient(Form::VolumeDifference, values).into_iter();
        gradients.enumerate().map(|(i, gradient)| corrections.apply(i, gradient)).collect()
    }

    /// The corrected gradient of a vector field, `out[α][β] = ⟨∂f^α/∂x^β⟩_i`.
    pub fn corrected_vector_gradient(
        &self,
        corrections: &Corrections<T, D>,
        vectors: &[Vector<T, D>],
    ) -> Vec<[[T; D]; D]> {
        let gradients = self.vector_gradient(Form::VolumeDifference, vectors).into_iter();
        gradients.enumerate().map(|(i, rows)| rows.map(|row| corrections.apply(i, Vector(row)).0)).collect()
    }
}

/// The inverse, unless it is so ill conditioned that half the digits would be lost.
fn regular_inverse<T: Real, const D: usize>(matrix: &[[T; D]; D]) -> Option<[[T; D]; D]> {
    let norm2 = |m: &[[T; D]; D]| m.iter().flatten().fold(T::ZERO, |sum, &x| sum + x * x);
    let inverse = T::inverse(matrix)?;
    let condition2 = norm2(matrix) * norm2(&inverse);
    (condition2 * T::EPSILON < T::ONE).then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::WendlandC2;
    use crate::neighbours::CellList;
    use crate::summation::Neighbourhood;

    fn corrections(x: &[Vector<f64, 2>]) -> Corrections<f64, 2> {
        let kernel = WendlandC2::new(1.3).unwrap();
        let mut hood = Neighbourhood::new(Box::<CellList<f64, 2>>::default(), kernel.support());
        hood.rebuild(x, 0);
        let ones = vec![1.0; x.len()];
        Cloud::new(&hood, &kernel, x, &ones, &ones).unwrap().corrections()
    }

    #[test]
    fn what_cannot_be_corrected_is_counted_and_left_alone() {
        // Alone; two in a row; three in a row, aslant; a triangle.
        assert_eq!(corrections(&[Vector([0.0, 0.0])]).uncorrected, 1);
        assert_eq!(corrections(&[Vector([0.0, 0.0]), Vector([1.0, 0.0])]).uncorrected, 2);
        let row: Vec<_> = (0..3).map(|k| Vector([0.3 * f64::from(k), 0.7 * f64::from(k)])).collect();
        let aslant = corrections(&row);
        assert_eq!((aslant.uncorrected, aslant.matrices[1]), (3, [[1.0, 0.0], [0.0, 1.0]]));
        let triangle = [Vector([0.0, 0.0]), Vector([1.0, 0.0]), Vector([0.0, 1.0])];
        assert_eq!(corrections(&triangle).uncorrected, 0);
    }
}
