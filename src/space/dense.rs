//! Dense linear algebra.

use nalgebra::SMatrix;

/// Dense linear algebra on `D × D` matrices, done by nalgebra: the one place its bounds appear.
pub(crate) trait Dense: Sized {
    /// The inverse, or `None` for a singular matrix.
    fn inverse<const D: usize>(m: &[[Self; D]; D]) -> Option<[[Self; D]; D]>;
    /// Eigenvalues of a symmetric matrix with their directions, each of length one; `None` if they
    /// are not found, as for numbers that are not finite.
    fn eigen(m: &[[Self; 3]; 3]) -> Option<([Self; 3], [[Self; 3]; 3])>;
}

macro_rules! dense {
    ($t:ident) => {
        impl Dense for $t {
            fn inverse<const D: usize>(m: &[[$t; D]; D]) -> Option<[[$t; D]; D]> {
                let m = SMatrix::<$t, D, D>::from_fn(|row, column| m[row][column]);
                let inverse = m.try_inverse()?;
                let mut out = [[0.0; D]; D];
                for (row, values) in out.iter_mut().enumerate() {
                    for (column, value) in values.iter_mut().enumerate() {
                        *value = inverse[(row, column)];
                    }
                }
                Some(out)
            }
            fn eigen(m: &[[$t; 3]; 3]) -> Option<([$t; 3], [[$t; 3]; 3])> {
                let m = SMatrix::<$t, 3, 3>::from_fn(|row, column| m[row][column]);
                let found = nalgebra::SymmetricEigen::try_new(m, $t::EPSILON, 100)?;
                let direction = |k: usize| core::array::from_fn(|axis| found.eigenvectors[(axis, k)]);
                let all_finite = found.eigenvalues.iter().all(|value| value.is_finite());
                all_finite.then(|| (found.eigenvalues.into(), core::array::from_fn(direction)))
            }
        }
    };
}
dense!(f32);
dense!(f64);
