//! Values and derivatives of a field known at the particles of one cloud (44)–(51), (70).

use super::formulas::{Formula, Gradient, Interpolation, Laplacian, VectorGradient};
use super::{Aligned, Neighbourhood, PairFormula, Sums};
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::real::Real;
use crate::space::Vector;

/// How the own value enters a discrete derivative. None is both exact for constants and
/// conservative: choose by what is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Eq. (46): `Σ_j m_j/ρ_j f_j ∇W_ij`. Neither exact for constants nor conservative.
    Plain,
    /// Eq. (50): `1/ρ_i Σ_j m_j (f_j − f_i) ∇W_ij`. Exact for constants; minus the adjoint of (51).
    Difference,
    /// `Σ_j m_j/ρ_j (f_j − f_i) ∇W_ij`, the weights of Eq. (65). Exact for constants; what
    /// [`Corrections`](super::Corrections) correct.
    VolumeDifference,
    /// Eq. (51): `ρ_i Σ_j m_j (f_i/ρ_i² + f_j/ρ_j²) ∇W_ij`. Conserves `Σ m_i/ρ_i ⟨∇f⟩_i`.
    Symmetric,
}

/// A cloud of particles with the kernel its sums are taken with.
///
/// ```
/// use alluvium::{Vector, kernel::WendlandC2, neighbours::{CellList, Periodic}};
/// use alluvium::summation::{Cloud, Form, Neighbourhood};
/// # fn main() -> Result<(), alluvium::error::ParameterError> {
/// let x: Vec<Vector<f64, 2>> = (0..100).map(|k| Vector([(k % 10) as f64, (k / 10) as f64])).collect();
/// let kernel = WendlandC2::new(1.5)?;
/// let mut neighbourhood = Neighbourhood::new(Box::<CellList<f64, 2>>::default(), 3.0);
/// neighbourhood.rebuild(&x, 0);
/// let (masses, densities) = (vec![1.0; 100], vec![1.0; 100]);
/// let cloud = Cloud::new(&neighbourhood, &kernel, &x, &masses, &densities)?;
/// let height: Vec<f64> = x.iter().map(|x| 2.0 * x[0] + 3.0 * x[1]).collect();
/// let slope = cloud.corrected_gradient(&cloud.corrections(), &height);
/// assert!((slope[0] - Vector([2.0, 3.0])).norm() < 1e-12);
/// let cheap = cloud.gradient(Form::Difference, &height);
/// assert!((cheap[55] - Vector([2.0, 3.0])).norm() < 0.02);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Cloud<'a, T: Real, K, const D: usize> {
    neighbourhood: &'a Neighbourhood<T, D>,
    pub(super) kernel: &'a K,
    positions: &'a [Vector<T, D>],
    masses: &'a [T],
    densities: &'a [T],
}

impl<'a, T: Real, K: Kernel<T, D>, const D: usize> Cloud<'a, T, K, D> {
    /// The cloud of particles at `positions` \[m\] with `masses` \[kg\] and `densities` \[kg m⁻³\];
    /// their volumes are `V_j = m_j/ρ_j`. The neighbourhood has been rebuilt for them without walls
    /// (wall particles miss each other in its sums).
    ///
    /// # Errors
    /// The lengths differ, the neighbourhood is stale, or its support is shorter than the kernel's.
    pub fn new(
        neighbourhood: &'a Neighbourhood<T, D>,
        kernel: &'a K,
        positions: &'a [Vector<T, D>],
        masses: &'a [T],
        densities: &'a [T],
    ) -> Result<Self, ParameterError> {
        let count = positions.len();
        if masses.len() != count {
            return Err(ParameterError::new("number of masses", masses.len(), "the number of positions"));
        }
        if densities.len() != count {
            let given = densities.len();
            return Err(ParameterError::new("number of densities", given, "the number of positions"));
        }
        if neighbourhood.is_stale(positions) {
            let given = neighbourhood.rebuilds();
            return Err(ParameterError::new("neighbourhood after rebuild", given, "up to date"));
        }
        if neighbourhood.support() < kernel.support() {
            let given = neighbourhood.support();
            return Err(ParameterError::new("neighbourhood support", given, "at least the kernel's"));
        }
        Ok(Self { neighbourhood, kernel, positions, masses, densities })
    }

    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there is no particle.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// `V_j = m_j/ρ_j` \[m³\] (\[m²\] in 2D).
    #[inline]
    pub fn volume(&self, j: usize) -> T {
        self.masses[j] / self.densities[j]
    }

    /// Packs `fields` and sums `formula` over all pairs.
    pub(super) fn sum<F: PairFormula<T>>(
        &self,
        formula: &F,
        fields: &(impl Fn(usize, &mut [T]) + Sync),
    ) -> Sums<T> {
        let (mut records, mut sums) = (Aligned::default(), Sums::default());
        // Fields of the dummy: weight and value zero.
        self.neighbourhood.pack::<F>(self.positions, &mut records, &[], fields);
        self.neighbourhood.sum(formula, &records, &mut sums);
        sums
    }

    fn interpolation(&self, values: &[T]) -> Sums<T> {
        assert_eq!(values.len(), self.len());
        let formula = Formula::<Interpolation<D>, T, K>::new(self.kernel, T::ZERO);
        self.sum(&formula, &|j, record| {
            record[0] = self.volume(j);
            record[1] = values[j];
        })
    }

    /// Eq. (44): `⟨f⟩_i = Σ_j m_j/ρ_j f_j W_ij`, the own contribution with `W(0)` included.
    ///
    /// # Panics
    /// `values` (and so in all operators) has another length than the cloud.
    pub fn interpolate(&self, values: &[T]) -> Vec<T> {
        let sums = self.interpolation(values);
        let peak = self.kernel.value(T::ZERO);
        (0..self.len()).map(|i| sums.get(i, 1) + self.volume(i) * peak * values[i]).collect()
    }

    /// Shepard's sum `S_i = Σ_j m_j/ρ_j W_ij`: one deep inside, about one half at a plane surface.
    pub fn shepard(&self) -> Vec<T> {
        self.interpolate(&vec![T::ONE; self.len()])
    }

    /// The normalised value `⟨f⟩_i / S_i`, exact for constants; of the density it is Eq. (70):
    /// `ρ_i = Σ_j m_j W_ij / Σ_j (m_j/ρ_j) W_ij`.
    pub fn interpolate_normalised(&self, values: &[T]) -> Vec<T> {
        let sums = self.interpolation(values);
        let peak = self.kernel.value(T::ZERO);
        let at = |i| {
            let own = self.volume(i) * peak;
            (sums.get(i, 1) + own * values[i]) / (sums.get(i, 0) + own)
        };
        (0..self.len()).map(at).collect()
    }

    /// Weight `w_j` and `f_j`'s factor in `Σ_j w_j (g_j + s g_i) ∇W`, `g = factor · f`.
    fn weight(&self, form: Form, j: usize) -> (T, T) {
        let (mass, density) = (self.masses[j], self.densities[j]);
        match form {
            Form::Plain | Form::VolumeDifference => (mass / density, T::ONE),
            Form::Difference => (mass, T::ONE),
            Form::Symmetric => (mass, T::ONE / (density * density)),
        }
    }

    /// What stands before the sum.
    fn prefactor(&self, form: Form, i: usize) -> T {
        match form {
            Form::Plain | Form::VolumeDifference => T::ONE,
            Form::Difference => T::ONE / self.densities[i],
            Form::Symmetric => self.densities[i],
        }
    }

    /// The gradient `⟨∇f⟩_i` in one of the forms (46), (50), (51).
    pub fn gradient(&self, form: Form, values: &[T]) -> Vec<Vector<T, D>> {
        assert_eq!(values.len(), self.len());
        let formula = Formula::<Gradient<D>, T, K>::new(self.kernel, form.sign());
        let sums = self.sum(&formula, &|j, record| {
            let (weight, factor) = self.weight(form, j);
            record[0] = weight;
            record[1] = factor * values[j];
        });
        let at = |i| Vector(core::array::from_fn(|k| sums.get(i, k))) * self.prefactor(form, i);
        (0..self.len()).map(at).collect()
    }

    /// The gradient of a vector field, `out[α][β] = ⟨∂f^α/∂x^β⟩_i`, in one of the forms. Of the
    /// velocity in the form [`Difference`](Form::Difference) (weights `m_j/ρ_i`) it makes strain rate
    /// and density rate conjugate to the forces of (51); with
    /// [`VolumeDifference`](Form::VolumeDifference) (weights `m_j/ρ_j`) it is that of Eq. (65).
    pub fn vector_gradient(&self, form: Form, vectors: &[Vector<T, D>]) -> Vec<[[T; D]; D]> {
        assert_eq!(vectors.len(), self.len());
        let formula = Formula::<VectorGradient<D>, T, K>::new(self.kernel, form.sign());
        let sums = self.sum(&formula, &|j, record| {
            let (weight, factor) = self.weight(form, j);
            record[0] = weight;
            record[1..=D].copy_from_slice(&(vectors[j] * factor).0);
        });
        let at = |i| {
            let factor = self.prefactor(form, i);
            core::array::from_fn(|a| core::array::from_fn(|b| factor * sums.get(i, D * a + b)))
        };
        (0..self.len()).map(at).collect()
    }

    /// The divergence `⟨∇·f⟩_i`: the trace of the [vector gradient](Self::vector_gradient).
    pub fn divergence(&self, form: Form, vectors: &[Vector<T, D>]) -> Vec<T> {
        let trace = |t: [[T; D]; D]| (1..D).fold(t[0][0], |sum, k| sum + t[k][k]);
        self.vector_gradient(form, vectors).into_iter().map(trace).collect()
    }

    /// The Laplacian after Morris, Fox & Zhu (1997):
    /// `⟨∇²f⟩_i = 2 Σ_j m_j/ρ_j (f_i − f_j) x_ij·∇W_ij / r²  = 2 Σ_j m_j/ρ_j (f_i − f_j) F_ij`.
    pub fn laplacian(&self, values: &[T]) -> Vec<T> {
        assert_eq!(values.len(), self.len());
        let formula = Formula::<Laplacian<D>, T, K>::new(self.kernel, T::ZERO);
        let sums = self.sum(&formula, &|j, record| {
            record[0] = self.volume(j);
            record[1] = values[j];
        });
        (0..self.len()).map(|i| sums.get(i, 0)).collect()
    }
}

impl Form {
    /// The sign of the own value.
    fn sign<T: Real>(self) -> T {
        match self {
            Self::Plain => T::ZERO,
            Self::Difference | Self::VolumeDifference => -T::ONE,
            Self::Symmetric => T::ONE,
        }
    }
}
