//! The pass over pairs of water that shares its space with soil: pressure, and the density rate that is
//! conjugate to it.
//!
//! Pressure acts on the whole space of a particle, `−V_a V_b (p_a + p_b) ∇W`; the coupling takes the part
//! that the soil's grains bear. Stress, artificial viscosity and diffusion are those of
//! [`OwnPairs`](super::own_pairs::OwnPairs).

use super::continuity::PairDiffusion;
use super::momentum::{self, Viscosity};
use super::own_pairs::{self, Own, OwnPairs, record_length, sum};
use crate::kernel::Kernel;
use crate::real::{Num, Real};
use crate::summation::{MOST, PairFormula, Record, add_vector};

/// The formula of the pass; reads what [`OwnPairs`] reads, but p for pφ/ρ².
pub(crate) struct SharedPairs<T, K, const D: usize, const STRESS: bool> {
    pub(crate) kernel: K,
    pub(crate) viscosity: Viscosity<T>,
    pub(crate) diffusion: PairDiffusion<T, D>,
}

/// Sums after those of [`OwnPairs`]: `Σ V_b (p_a + p_b) ∇W`, then these.
pub(crate) mod shared {
    /// `Σ V_b W`, without the particle's own.
    pub(crate) const SPACE: usize = 0;
    pub(crate) const COUNT: usize = 1;
}

impl<T: Real, K: Kernel<T, D>, const D: usize, const STRESS: bool> PairFormula<T>
    for SharedPairs<T, K, D, STRESS>
{
    const BLOCKS: usize = record_length(D, STRESS).div_ceil(4);
    const SUMS: usize = 2 * D + sum::COUNT + shared::COUNT;
    type At<N: Num<Scalar = T>> = Own<N, D>;

    #[inline(always)]
    fn start<N: Num<Scalar = T>>(&self) -> [N; MOST] {
        own_pairs::start::<T, N, D>()
    }

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Own<N, D> {
        <OwnPairs<T, K, D, STRESS, false> as PairFormula<T>>::read(record)
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, a: &Own<N, D>, b: &Own<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (a.x - b.x, a.v - b.v);
        let (r2, v_dot_x) = (x.norm2(), v.dot(x));
        let slope = self.kernel.slope(r2);
        let mass_slope = b.density * b.volume * slope;
        let density_sum = a.density + b.density;
        let approach = momentum::approach_with(v_dot_x, a.grip.min(b.grip));
        let artificial = self.viscosity.pressure(approach, r2, density_sum);
        add_vector(sums, 0, x * -(mass_slope * artificial));
        if STRESS {
            for k in 0..D {
                sums[k] += mass_slope * (a.stress[k] + b.stress[k]).dot(x);
            }
        }
        sums[D + sum::COMPRESSION] += b.volume * slope * v_dot_x;
        let hydrostatic = self.diffusion.hydrostatic(a.diffusing + b.diffusing, x);
        let excess = a.diffusing - b.diffusing - hydrostatic;
        sums[D + sum::DIFFUSION] += b.volume * self.diffusion.rate(excess, slope, density_sum);
        sums[D + sum::VISCOUS_LOSS] += artificial * mass_slope * v_dot_x;
        sums[D + sum::CLOSEST] = sums[D + sum::CLOSEST].min(r2);
        add_vector(sums, D + sum::COUNT, x * (b.volume * slope * (a.pressure + b.pressure)));
        sums[2 * D + sum::COUNT + shared::SPACE] += b.volume * self.kernel.value(r2);
    }
}
