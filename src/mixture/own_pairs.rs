//! The pass over pairs of one phase: continuity (52) and the phase's own part of momentum (55), (58).

use super::continuity::{self, PairDiffusion};
use super::momentum::{self, Viscosity};
use crate::kernel::Kernel;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, add_vector, number, symmetric, vector};

/// The formula of the pass. `STRESS` adds the deviatoric part. `PLAIN` leaves out what would change no bit,
/// since no wall glides and diffusion knows no hydrostatic slope.
pub(crate) struct OwnPairs<T, K, const D: usize, const STRESS: bool, const PLAIN: bool> {
    pub(crate) kernel: K,
    pub(crate) viscosity: Viscosity<T>,
    pub(crate) diffusion: PairDiffusion<T, D>,
}

/// What a record says: x, v, then these, then τφ/ρ² if there is stress.
#[derive(Clone, Copy)]
pub(crate) struct Own<N: Copy, const D: usize> {
    pub(super) x: Vector<N, D>,
    pub(super) v: Vector<N, D>,
    /// m/ρ \[m³\].
    pub(super) volume: N,
    /// The same, but negative for a wall that artificial viscosity does not see.
    pub(super) grip: N,
    /// Partial density ρ.
    pub(super) density: N,
    /// pφ/ρ².
    pub(super) pressure: N,
    /// What diffuses: true compression, or partial density over its reference.
    pub(super) diffusing: N,
    /// τφ/ρ², rows of the particle space.
    pub(super) stress: [Vector<N, D>; D],
}

/// Sums after the acceleration (numbers `0..D`).
pub(crate) mod sum {
    /// `Σ m_j v_ij·∇W` \[kg/m³/s\].
    pub(crate) const COMPRESSION: usize = 0;
    /// `Σ V_j ψ·∇W/2ρ̃₀` \[1/m²\].
    pub(crate) const DIFFUSION: usize = 1;
    /// `Σ m_j Π v_ij·∇W` \[W/kg\], twice the particle's share of the loss.
    pub(crate) const VISCOUS_LOSS: usize = 2;
    /// Smallest r² \[m²\].
    pub(crate) const CLOSEST: usize = 3;
    /// How many.
    pub(crate) const COUNT: usize = 4;
}

/// Length of a record without and with stress.
pub(crate) const fn record_length(dimension: usize, stress: bool) -> usize {
    2 * dimension + 4 + if stress { dimension * (dimension + 1) / 2 } else { 0 }
}

impl<T: Real, K: Kernel<T, D>, const D: usize, const STRESS: bool, const PLAIN: bool> PairFormula<T>
    for OwnPairs<T, K, D, STRESS, PLAIN>
{
    const BLOCKS: usize = record_length(D, STRESS).div_ceil(4);
    const SUMS: usize = D + sum::COUNT;
    type At<N: Num<Scalar = T>> = Own<N, D>;

    #[inline(always)]
    fn start<N: Num<Scalar = T>>(&self) -> [N; MOST] {
        start::<T, N, D>()
    }

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Own<N, D> {
        let stress = if STRESS { symmetric(record, 2 * D + 4) } else { [Vector::zero(); D] };
        Own {
            x: vector(record, 0),
            v: vector(record, D),
            volume: if PLAIN { number(record, 2 * D) } else { magnitude(number(record, 2 * D)) },
            grip: number(record, 2 * D),
            density: number(record, 2 * D + 1),
            pressure: number(record, 2 * D + 2),
            diffusing: number(record, 2 * D + 3),
            stress,
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Own<N, D>, j: &Own<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (i.x - j.x, i.v - j.v);
        let (r2, v_dot_x) = (x.norm2(), v.dot(x));
        let slope = self.kernel.slope(r2); // ∇W = F x (47)
        let mass_slope = j.density * j.volume * slope;
        let density_sum = i.density + j.density;
        let approach = if PLAIN {
            momentum::approach(v_dot_x)
        } else {
            momentum::approach_with(v_dot_x, i.grip.min(j.grip))
        };
        let artificial = self.viscosity.pressure(approach, r2, density_sum); // (59)
        let pressure = momentum::isotropic(i.pressure, j.pressure, artificial);
        let mut acceleration = x * -(pressure * mass_slope); // (58), first sum
        if STRESS {
            for a in 0..D {
                acceleration.0[a] += (i.stress[a] + j.stress[a]).dot(x) * mass_slope; // (58), second sum
            }
        }
        add_vector(sums, 0, acceleration);
        let compression = continuity::compression(mass_slope, v_dot_x);
        sums[D + sum::COMPRESSION] += compression; // (52), first sum
        let mut excess = i.diffusing - j.diffusing;
        if !PLAIN {
            excess -= self.diffusion.hydrostatic(i.diffusing + j.diffusing, x);
        }
        sums[D + sum::DIFFUSION] += j.volume * self.diffusion.rate(excess, slope, density_sum); // (52), second sum
        sums[D + sum::VISCOUS_LOSS] += artificial * compression;
        sums[D + sum::CLOSEST] = sums[D + sum::CLOSEST].min(r2);
    }
}

/// Zeros, and nobody near yet.
#[inline(always)]
pub(super) fn start<T: Real, N: Num<Scalar = T>, const D: usize>() -> [N; MOST] {
    let mut sums = [N::lit(0.0); MOST];
    sums[D + sum::CLOSEST] = N::splat(T::INFINITY);
    sums
}

#[inline(always)]
fn magnitude<N: Num>(x: N) -> N {
    x.max(-x)
}
