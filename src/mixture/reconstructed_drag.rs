//! Drag of velocities reconstructed between the particles of a pair, after Price & Laibe (2020).
//!
//! Drag between particles a distance apart takes the flow's own shear for slip and smooths what soil and water do
//! together. With the velocity gradient G of either constituent, the slip in the middle of a pair is
//!
//! $$\mathbf v^*_{ia} = \mathbf v_{ia} - \tfrac12(G_i + G_a)\,\mathbf x_{ia}.$$
//!
//! Drag is `−K v*` on the pair, and what is conjugate to the gradients: with `T_i = Σ_a K v*_{ia} ⊗ x_ia` the
//! particles of one constituent push each other by
//!
//! $$\mathbf F_{ij} = -\tfrac12\,(w_j T_i + w_i T_j)\,\nabla_i W_{ij},$$
//!
//! w the volumes the gradient is summed with. Everything is pairwise equal and opposite, and the rate at which drag takes energy is
//! Σ K |v*|²: never negative, whatever the velocities, without a limiter.

use super::across::Records;
use super::between::Pass;
use super::constituent::Constituent;
use super::coupling::Coupling;
use super::evaluation::vector_sum;
use super::velocity_gradient::VelocityGradient;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, Sums, add_vector, number, vector};
use crate::time::Moment;

/// `Σ q_j W (s_ij − κ v_ij)` with the reconstructed part s = v − v* of the slip, `Σ q_j W v*_ij ⊗ x_ij` by rows, then
/// `Σ q_j W` and `Σ q_j W v*_ij²`; record: x, v, ½G by rows, q, with q = V of soil and V C of water.
pub(super) struct Reconstructed<T, K, const D: usize> {
    pub(super) kernel: K,
    /// κ: 1 for the whole of drag, 0 for what reconstruction changes of it.
    pub(super) whole: T,
}

#[derive(Clone, Copy)]
pub(super) struct Sheared<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    gradient: [Vector<N, D>; D],
    weight: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Reconstructed<T, K, D> {
    const BLOCKS: usize = (2 * D + D * D + 1).div_ceil(4);
    const SUMS: usize = D + D * D + 2;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Sheared<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Sheared<N, D> {
        let mut gradient = [Vector::zero(); D];
        for k in 0..D {
            gradient[k] = vector(record, (2 + k) * D);
        }
        Sheared {
            x: vector(record, 0),
            v: vector(record, D),
            gradient,
            weight: number(record, 2 * D + D * D),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Sheared<N, D>, j: &Sheared<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (i.x - j.x, i.v - j.v);
        let weight = j.weight * self.kernel.value(x.norm2());
        let mut shear = Vector::zero();
        for k in 0..D {
            shear[k] = (i.gradient[k] + j.gradient[k]).dot(x);
        }
        let slip = v - shear;
        add_vector(sums, 0, (shear - v * N::splat(self.whole)) * weight);
        for k in 0..D {
            add_vector(sums, (1 + k) * D, x * (weight * slip[k]));
        }
        sums[D + D * D] += weight;
        sums[D + D * D + 1] += weight * slip.norm2();
    }
}

/// `Σ_j (w_j T_i + w_i T_j) ∇W`; record: x, w, T by rows.
struct Spread<K, const D: usize> {
    kernel: K,
}

#[derive(Clone, Copy)]
pub(super) struct Spreading<N: Copy, const D: usize> {
    x: Vector<N, D>,
    volume: N,
    moment: [Vector<N, D>; D],
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Spread<K, D> {
    const BLOCKS: usize = (D + 1 + D * D).div_ceil(4);
    const SUMS: usize = D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Spreading<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Spreading<N, D> {
        let mut moment = [Vector::zero(); D];
        for k in 0..D {
            moment[k] = vector(record, D + 1 + k * D);
        }
        Spreading { x: vector(record, 0), volume: number(record, D), moment }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Spreading<N, D>, j: &Spreading<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let slope = x * self.kernel.slope(x.norm2());
        for k in 0..D {
            sums[k] += (i.moment[k] * j.volume + j.moment[k] * i.volume).dot(slope);
        }
    }
}

/// What drag of reconstructed velocities does.
pub(super) struct Reconstruction<T, const D: usize> {
    /// Force per mass \[m/s²\] on soil and water: of drag, or what reconstruction changes of it.
    pub(super) acceleration: [Vec<Vector<T, D>>; 2],
    /// How fast drag acts on each particle, `Σ_j K_ij/m_i` \[1/s\], of soil and water.
    pub(super) rate: [Vec<T>; 2],
    /// What drag takes, `Σ K v*²` \[W\].
    pub(super) power: f64,
}

impl<T: Real, const D: usize> Coupling<T, D> {
    /// Drag of the velocities of `moment` reconstructed between the particles; if not the `whole` of it, what
    /// reconstruction changes. `kernel` is that within each constituent.
    pub(super) fn reconstruct_drag<K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
        &mut self,
        kernel: &K,
        soil: &mut Constituent<T, D, S>,
        water: &mut Constituent<T, D, F>,
        (moment, whole): (Moment, bool),
    ) -> Reconstruction<T, D> {
        let gradients = [soil.half_gradient(kernel, moment), water.half_gradient(kernel, moment)];
        self.drag.find_slip(&mut self.across, (&soil.phase, &water.phase), moment);
        // What of K = V_i V_a C W is the particle's own.
        let (across, drag) = (&self.across, &self.drag);
        let of_soil = |i: usize| drag.soil_side(&soil.phase, i, || across.filled(&water.phase, i));
        let of_water = |a: usize| water.phase.volume(a) * drag.coefficient(&water.phase, a);
        let own: [Vec<T>; 2] =
            [(0..soil.phase.len()).map(of_soil).collect(), (0..water.phase.len()).map(of_water).collect()];
        let velocities = [&soil.phase.fields(moment).velocity, &water.phase.fields(moment).velocity];
        let record = |n: usize, i: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&velocities[n][i].0);
            for (k, row) in gradients[n][i].iter().enumerate() {
                record[(1 + k) * D..(2 + k) * D].copy_from_slice(&row.0);
            }
            record[D + D * D] = own[n][i];
        };
        let mut sums = Sums::default();
        let records = Records {
            dummy: &[T::ZERO; MOST][..D + D * D + 1],
            of_soil: &|i, into| record(0, i, into),
            of_water: &|a, into| record(1, a, into),
        };
        self.across.sum(Pass::ReconstructedDrag { whole }, &records, &mut sums);
        let water_from = self.across.water(0);
        let [soil_own, water_own] = &own;
        let [on_soil, on_water] =
            [soil.pushed(kernel, soil_own, (&sums, 0)), water.pushed(kernel, water_own, (&sums, water_from))];
        let power = |(a, own): (usize, &T)| (*own * sums.get(water_from + a, D + D * D + 1)).as_f64();
        Reconstruction {
            acceleration: [on_soil.0, on_water.0],
            rate: [on_soil.1, on_water.1],
            power: water_own.iter().enumerate().map(power).sum(),
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Volume \[m³, in 2D m²\] of particle `i` in the sums over its own constituent: walls, which show no motion of
    /// their own, take no part.
    fn taking_part(&self, i: usize) -> T {
        if i < self.phase.wall_particles() { T::ZERO } else { self.phase.volume(i) }
    }

    /// ½G by rows \[1/s\], G = Σ V_j (v_j − v_i) ⊗ ∇W.
    fn half_gradient<K: Kernel<T, D>>(&mut self, kernel: &K, moment: Moment) -> Vec<[Vector<T, D>; D]> {
        let mut records = core::mem::take(&mut self.scratch.records);
        let velocity = &self.phase.fields(moment).velocity;
        self.neighbourhood.pack::<VelocityGradient<K, D>>(
            &self.phase.position,
            &mut records,
            &[T::ZERO; 4][..D + 1],
            &|i, record: &mut [T]| {
                record[..D].copy_from_slice(&velocity[i].0);
                record[D] = self.taking_part(i);
            },
        );
        let formula = VelocityGradient::<K, D> { kernel: kernel.clone() };
        self.neighbourhood.sum(&formula, &records, &mut self.scratch.extra);
        self.scratch.records = records;
        let (half, walls) = (T::of(0.5), self.phase.wall_particles());
        let rows = |i: usize| {
            core::array::from_fn(|k| match i < walls {
                true => Vector::zero(),
                false => vector_sum::<T, D>(&self.scratch.extra, i, k * D) * half,
            })
        };
        (0..self.phase.len()).map(rows).collect()
    }

    /// Accelerations by drag on the pairs, and by what is conjugate to the gradients; how fast drag acts. `sums` has
    /// this constituent from a row on.
    fn pushed<K: Kernel<T, D>>(
        &mut self,
        kernel: &K,
        own: &[T],
        (sums, first): (&Sums<T>, usize),
    ) -> (Vec<Vector<T, D>>, Vec<T>) {
        let mut records = core::mem::take(&mut self.scratch.records);
        let walls = self.phase.wall_particles();
        self.neighbourhood.pack::<Spread<K, D>>(
            &self.phase.position,
            &mut records,
            &[T::ZERO; MOST][..1 + D * D],
            &|i, record: &mut [T]| {
                record[0] = self.taking_part(i);
                for k in 0..D * D {
                    let moment = own[i] * sums.get(first + i, D + k);
                    record[1 + k] = if i < walls { T::ZERO } else { moment };
                }
            },
        );
        let formula = Spread::<K, D> { kernel: kernel.clone() };
        self.neighbourhood.sum(&formula, &records, &mut self.scratch.extra);
        self.scratch.records = records;
        let force = |i: usize| -> Vector<T, D> {
            let spread: Vector<T, D> = vector_sum(&self.scratch.extra, i, 0);
            vector_sum(sums, first + i, 0) * own[i] - spread * T::of(0.5)
        };
        let mass = &self.phase.mass;
        let all = 0..self.phase.len();
        let accelerations = all.clone().map(|i| force(i) * (T::ONE / mass[i])).collect();
        (accelerations, all.map(|i| own[i] * sums.get(first + i, D + D * D) / mass[i]).collect())
    }
}
