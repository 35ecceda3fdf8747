//! Weak relaxation of the density to the volume the particles take (`Σ V W = 1` but for the lattice's own
//! excess).
//!
//! Water that enters soil is stretched along its flow, and density integrated by continuity drifts from the
//! spacing of the particles. Where no surface is near, this pulls it back:
//!
//! $$\frac{D\ln\rho_a}{Dt} \mathrel{+}= \frac{\operatorname{clamp}(S_a - 1 - s_0, \pm 0.05)}{\tau},\qquad
//! S_a = \sum_b V_b W_{ab},$$
//!
//! with the excess s₀ of a perfect lattice of spacing V^{1/D}.

use super::constituent::Constituent;
use super::own_pairs::sum;
use super::setting::Setting;
use super::shared_pairs::shared;
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, number, vector};

/// S below this is a surface \[-\].
const SURFACE: f64 = 0.93;
/// The largest error that is acted on \[-\].
const LARGEST: f64 = 0.05;

/// How fast, and towards what.
pub(super) struct Relaxation<T> {
    /// τ \[s\].
    pub(super) time: T,
    pub(super) lattice: LatticeExcess,
}

/// `Σ V W − 1` on perfect square or cubic lattices, over the smoothing length in spacings.
pub(super) struct LatticeExcess {
    excess: Vec<f64>,
}

impl LatticeExcess {
    const FIRST: f64 = 0.8;
    const LAST: f64 = 3.0;
    const POINTS: usize = 1100;

    /// Of this kernel.
    pub(super) fn of<T: Real, const D: usize, K: Kernel<T, D>>(kernel: &K) -> Self {
        let width = (Self::LAST - Self::FIRST) / Self::POINTS as f64;
        let ratios = (0..=Self::POINTS).map(|n| Self::FIRST + n as f64 * width);
        Self { excess: ratios.map(|ratio| lattice_sum(kernel, ratio) - 1.0).collect() }
    }

    /// At h/Δx = `ratio`, between the tabulated ones.
    pub(super) fn at(&self, ratio: f64) -> f64 {
        let width = (Self::LAST - Self::FIRST) / Self::POINTS as f64;
        let place = ((ratio - Self::FIRST) / width).clamp(0.0, Self::POINTS as f64 - 1e-9);
        let (n, part) = (place as usize, place.fract());
        self.excess[n] * (1.0 - part) + self.excess[n + 1] * part
    }
}

/// `Σ V W` on a lattice with h = `ratio` spacings.
fn lattice_sum<T: Real, const D: usize, K: Kernel<T, D>>(kernel: &K, ratio: f64) -> f64 {
    let spacing = kernel.smoothing_length().as_f64() / ratio;
    let reach = (kernel.support().as_f64() / spacing).ceil() as i64;
    let mut cell = [-reach; D];
    let mut sum = 0.0;
    loop {
        let r2 = cell.iter().map(|n| (n * n) as f64).sum::<f64>() * spacing * spacing;
        if r2.sqrt() < kernel.support().as_f64() {
            sum += kernel.value(T::of(r2)).as_f64();
        }
        let Some(k) = cell.iter().position(|n| *n < reach) else { break };
        cell[..k].fill(-reach);
        cell[k] += 1;
    }
    sum * spacing.powi(D as i32)
}

/// `Σ f_j W`: record: x, f. Where it is positive, a particle with a flag is near.
struct NearFlag<K, const D: usize> {
    kernel: K,
}

#[derive(Clone, Copy)]
pub(super) struct Flagged<N: Copy, const D: usize> {
    x: Vector<N, D>,
    flag: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for NearFlag<K, D> {
    const BLOCKS: usize = 1;
    const SUMS: usize = 1;
    type At<N: Num<Scalar = T>> = Flagged<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Flagged<N, D> {
        Flagged { x: vector(record, 0), flag: number(record, D) }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Flagged<N, D>, j: &Flagged<N, D>, sums: &mut [N; MOST]) {
        sums[0] += j.flag * self.kernel.value((i.x - j.x).norm2());
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Adds the relaxation to the density rates of particles that are no wall's and books what it takes.
    pub(super) fn relax_density<K: Kernel<T, D>>(
        &mut self,
        setting: &Setting<T, D, K>,
        relaxation: &Relaxation<T>,
    ) {
        let space = self.space_taken(&setting.kernel);
        let formula = NearFlag::<K, D> { kernel: setting.kernel.clone() };
        let flag = |i: usize| if space[i] < T::of(SURFACE) { T::ONE } else { T::ZERO };
        self.neighbourhood.pack::<NearFlag<K, D>>(
            &self.phase.position,
            &mut self.scratch.records,
            &[T::ZERO],
            &|i, record: &mut [T]| record[0] = flag(i),
        );
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let h = setting.kernel.smoothing_length().as_f64();
        let (reference, mut taken) = (self.phase.material().reference_density(), 0.0);
        for a in self.phase.wall_particles()..self.phase.len() {
            if flag(a) + self.scratch.extra.get(a, 0) > T::ZERO {
                continue;
            }
            let spacing = self.phase.volume(a).as_f64().powf(1.0 / D as f64);
            let error = space[a].as_f64() - 1.0 - relaxation.lattice.at(h / spacing);
            let rate = T::of(error.clamp(-LARGEST, LARGEST)) / relaxation.time;
            let density = self.phase.density(a);
            self.phase.rate.excess[a] += density / reference * rate;
            let stores = self.phase.pressure[a] * self.phase.volume_fraction[a] / density;
            taken -= (self.phase.mass[a] * stores * rate).as_f64();
        }
        self.exchange_rate.taken[Account::Relaxation] += taken;
        // What the rates hold beyond compression is found there as diffusion.
        self.exchange_rate.taken[Account::DensityDiffusion] -= taken;
    }

    /// S = Σ V W, own share included, after the pass of [`SharedPairs`](super::shared_pairs::SharedPairs).
    fn space_taken<K: Kernel<T, D>>(&self, kernel: &K) -> Vec<T> {
        let (own, place) = (kernel.value(T::ZERO), 2 * D + sum::COUNT + shared::SPACE);
        let others = |a: usize| self.scratch.sums.get(a, place);
        (0..self.phase.len()).map(|a| others(a) + self.phase.volume(a) * own).collect()
    }
}
