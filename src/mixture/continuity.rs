//! The pair terms of the continuity equations (52), (53), and density diffusion (54).

use crate::error::ParameterError;
use crate::real::{Num, Real};
use crate::space::Vector;

/// What the diffusive term of (52) acts on.
///
/// The coefficient δ \[-\] is 0.1 in the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DensityDiffusion<T> {
    /// No diffusion.
    None,
    /// As printed (54): the partial density. Diffuses mass across every jump of the volume fraction.
    PartialDensity(T),
    /// The true density times the mean volume fraction (Molteni & Colagrossi 2009 for water alone).
    TrueDensity(T),
    /// The true density less its hydrostatic distribution (Fourtakas et al. 2019): leaves still
    /// water at rest. Water in free fall has no such distribution, and is pulled at a little at its
    /// surfaces: by some mm/s and Pa in a body of 0.1 m.
    Hydrostatic(T),
    /// The true density less its renormalised gradient (Antuono et al. 2010): acts on what a linear
    /// field cannot explain. Costs two more passes.
    Renormalised(T),
}

impl<T: Real> DensityDiffusion<T> {
    /// δ \[-\].
    pub fn coefficient(&self) -> T {
        match *self {
            Self::None => T::ZERO,
            Self::PartialDensity(d) | Self::TrueDensity(d) | Self::Hydrostatic(d) | Self::Renormalised(d) => {
                d
            }
        }
    }
}

impl<T: Real> DensityDiffusion<T> {
    /// Itself, if the coefficient is usable.
    pub(super) fn checked(self) -> Result<Self, ParameterError> {
        let delta = self.coefficient();
        if !(delta >= T::ZERO && delta <= T::ONE) {
            return Err(ParameterError::new("density_diffusion", delta, "from 0 to 1"));
        }
        Ok(self)
    }
}

/// `m_j v_ij · ∇W` with `∇W = F x` (52): `v_dot_x` is `v_ij·x_ij`.
#[inline(always)]
pub(crate) fn compression<N: Num>(mass_slope: N, v_dot_x: N) -> N {
    mass_slope * v_dot_x
}

/// The constants of the diffusion that does without a gradient pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairDiffusion<T, const D: usize> {
    /// Weight of a pair: `uniform + by_density (ρ_i + ρ_j)`: 1, or the mean volume fraction.
    uniform: T,
    by_density: T,
    /// Hydrostatic slope of the compression \[1/m\] at zero compression.
    slope: Vector<T, D>,
    /// Relative change of that slope per unit of the pair's mean compression.
    bend: T,
}

impl<T: Real, const D: usize> PairDiffusion<T, D> {
    pub(crate) fn new(
        kind: DensityDiffusion<T>,
        reference_density: T,
        hydrostatic: (T, T),
        gravity: Vector<T, D>,
    ) -> Self {
        let mean_fraction = T::of(0.5) / reference_density;
        let none = (T::ZERO, T::ZERO, Vector::zero(), T::ZERO);
        let (uniform, by_density, slope, bend) = match kind {
            DensityDiffusion::None | DensityDiffusion::Renormalised(_) => none,
            DensityDiffusion::PartialDensity(_) => (T::ONE, T::ZERO, Vector::zero(), T::ZERO),
            DensityDiffusion::TrueDensity(_) => (T::ZERO, mean_fraction, Vector::zero(), T::ZERO),
            DensityDiffusion::Hydrostatic(_) => {
                (T::ZERO, mean_fraction, gravity * hydrostatic.0, T::of(0.5) * hydrostatic.1)
            }
        };
        Self { uniform, by_density, slope, bend }
    }

    /// Whether a pair has a hydrostatic part at all.
    pub(crate) fn is_hydrostatic(&self) -> bool {
        self.slope != Vector::zero()
    }

    /// The part of `ε_i − ε_j` that gravity explains, from `ε_i + ε_j`.
    #[inline(always)]
    pub(crate) fn hydrostatic<N: Num<Scalar = T>>(&self, sum: N, x: Vector<N, D>) -> N {
        Vector::spread(&self.slope).dot(x) * (N::lit(1.0) + N::splat(self.bend) * sum)
    }

    /// `ψ_ij·∇W` of (54) over `2ρ̃₀`, per volume of `j`: since `ψ = 2(ρ_i − ρ_j) x/r²` and `∇W = F x`,
    /// that is `(ρ_i − ρ_j)/ρ̃₀ · F`, and `excess` is `(ρ_i − ρ_j)/ρ̃₀`, less what gravity explains.
    #[inline(always)]
    pub(crate) fn rate<N: Num<Scalar = T>>(&self, excess: N, slope: N, density_sum: N) -> N {
        let weight = N::splat(self.uniform) + N::splat(self.by_density) * density_sum;
        weight * slope * excess // (54)
    }
}
