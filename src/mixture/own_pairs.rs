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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::WendlandC2;
    use crate::mixture::continuity::DensityDiffusion;
    use crate::mixture::momentum::ArtificialViscosity;

    /// The sums of a pair of random records.
    fn summed<T: Real, const D: usize, const PLAIN: bool>(seed: u64, slope: f64, glides: bool) -> Vec<u64> {
        let mut state = seed;
        let mut random = |low: f64, high: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            T::of(low + (high - low) * (state >> 11) as f64 / (1_u64 << 53) as f64)
        };
        let mut particle = |sign: f64| {
            let mut record = [[T::ZERO; 4]; 4];
            let mut put = |k: usize, value: T| record[k / 4][k % 4] = value;
            for axis in 0..D {
                put(axis, random(-0.5, 0.5));
                put(D + axis, random(-2.0, 2.0));
            }
            put(2 * D, T::of(sign) * random(0.5, 1.5));
            put(2 * D + 1, random(900.0, 1100.0));
            put(2 * D + 2, random(-1.0, 1.0));
            put(2 * D + 3, random(-0.01, 0.01));
            <OwnPairs<T, WendlandC2<T, D>, D, false, PLAIN> as PairFormula<T>>::read(&record)
        };
        let (i, j) = (particle(1.0), particle(if glides { -1.0 } else { 1.0 }));
        let factors = ArtificialViscosity { linear: T::of(0.1), quadratic: T::of(0.2) };
        let mut gravity = Vector::zero();
        gravity[D - 1] = T::of(-9.81);
        let diffusion = DensityDiffusion::Hydrostatic(T::of(0.1));
        let formula = OwnPairs::<T, WendlandC2<T, D>, D, false, PLAIN> {
            kernel: WendlandC2::new(T::ONE).expect("a length"),
            viscosity: Viscosity::new(factors, T::ONE, T::of(20.0)),
            diffusion: PairDiffusion::new(diffusion, T::of(1000.0), (T::of(slope), T::ZERO), gravity),
        };
        let mut sums = formula.start();
        formula.add_pair(&i, &j, &mut sums);
        sums.iter().map(|sum| sum.bits()).collect()
    }

    fn same<T: Real, const D: usize>() {
        let differ = |slope: f64, glides: bool| {
            let differs = |&seed: &u64| {
                summed::<T, D, true>(seed, slope, glides) != summed::<T, D, false>(seed, slope, glides)
            };
            (1..200).filter(differs).count()
        };
        assert_eq!(differ(0.0, false), 0);
        // What is left out counts where there is such a wall, or such a slope.
        assert!(differ(0.0, true) > 100 && differ(0.01, false) > 100);
    }

    #[test]
    fn what_is_left_out_changes_no_bit() {
        same::<f64, 2>();
        same::<f64, 3>();
        same::<f32, 2>();
        same::<f32, 3>();
    }
}
