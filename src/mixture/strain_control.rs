//! Viscosity between particles that move against each other unseen by the velocity gradient.
//!
//! The gradient (62) of a velocity that alternates from particle to particle is zero, and so is its
//! viscous force (58): such motion is neither damped nor held by a wall. The control adds, pair by
//! pair, the viscous force of what the mean gradient of the pair does not explain,
//!
//! $$\frac{2\xi\mu}{\rho_i} \sum_j V_j \left[v_{ij} - \tfrac12(\nabla v_i + \nabla v_j)\,x_{ij}\right] F_{ij},$$
//!
//! which for a smooth velocity is of the order h²∇⁴v: it vanishes with the resolution.

use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::setting::Setting;
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, add_vector, number, vector};

/// `Σ V_j W` and `Σ V_j ∇v_j W`, for walls; record: x, volume, ∇v by rows.
struct GradientExtrapolation<K, const D: usize> {
    kernel: K,
}

/// `Σ V_j [v_ij − ½(∇v_i + ∇v_j) x_ij] F`; record: x, volume, ∇v by rows, v.
struct UnseenMotion<K, const D: usize> {
    kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Sheared<N: Copy, const D: usize> {
    x: Vector<N, D>,
    volume: N,
    gradient: [Vector<N, D>; D],
    v: Vector<N, D>,
}

#[inline(always)]
fn read<N: Num, const D: usize>(record: &Record<N>, with_velocity: bool) -> Sheared<N, D> {
    let mut gradient = [Vector::zero(); D];
    for a in 0..D {
        gradient[a] = vector(record, D + 1 + a * D);
    }
    Sheared {
        x: vector(record, 0),
        volume: number(record, D),
        gradient,
        v: if with_velocity { vector(record, D + 1 + D * D) } else { Vector::zero() },
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for GradientExtrapolation<K, D> {
    const BLOCKS: usize = (D + 1 + D * D).div_ceil(4);
    const SUMS: usize = 1 + D * D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Sheared<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Sheared<N, D> {
        read(record, false)
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Sheared<N, D>, j: &Sheared<N, D>, sums: &mut [N; MOST]) {
        let weight = j.volume * self.kernel.value((i.x - j.x).norm2());
        sums[0] += weight;
        for a in 0..D {
            add_vector(sums, 1 + a * D, j.gradient[a] * weight);
        }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for UnseenMotion<K, D> {
    const BLOCKS: usize = (2 * D + 1 + D * D).div_ceil(4);
    const SUMS: usize = D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Sheared<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Sheared<N, D> {
        read(record, true)
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Sheared<N, D>, j: &Sheared<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (i.x - j.x, i.v - j.v);
        let weight = j.volume * self.kernel.slope(x.norm2());
        for a in 0..D {
            let explained = (i.gradient[a] + j.gradient[a]).dot(x) * N::lit(0.5);
            sums[a] += weight * (v.0[a] - explained);
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Adds the control to the accelerations and books what it takes as viscosity.
    pub(super) fn add_strain_control<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let viscosity =
            self.phase.material().kinematic_viscosity() * self.phase.material().reference_density();
        let strength = T::of(2.0) * self.strain_control * viscosity;
        if strength <= T::ZERO {
            return;
        }
        self.sum_unseen_motion(setting);
        let mut taken = 0.0;
        for i in 0..self.phase.len() {
            if self.phase.is_gliding(i) {
                continue;
            }
            let push: Vector<T, D> =
                vector_sum(&self.scratch.extra, i, 0) * (strength / self.phase.density(i));
            self.phase.rate.acceleration[i] += push;
            taken -= (self.phase.mass[i] * push.dot(self.phase.now.velocity[i])).as_f64();
        }
        self.exchange_rate.taken[Account::Viscosity] += taken;
    }

    /// `Σ V_j [v_ij − ½(∇v_i + ∇v_j) x_ij] F` of each particle, into the extra sums.
    pub(super) fn sum_unseen_motion<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        self.extrapolate_gradient(setting);
        let (phase, shown) = (&self.phase, &self.scratch.wall_velocity);
        let gradients = &self.scratch.velocity_gradient;
        self.neighbourhood.pack::<UnseenMotion<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 13][..1 + D * D + D],
            &|i, record: &mut [T]| {
                // What glides along does so without friction.
                record[0] = if phase.is_gliding(i) { T::ZERO } else { phase.volume(i) };
                write_rows(record, &gradients[i]);
                let v = shown.get(i).unwrap_or(&phase.now.velocity[i]);
                record[1 + D * D..1 + D * D + D].copy_from_slice(&v.0);
            },
        );
        let formula = UnseenMotion::<K, D> { kernel: setting.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
    }

    /// The velocity gradient of wall particles: the mean of the material's beside them. Soil that a wall's particles
    /// are made of has its own.
    fn extrapolate_gradient<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let walls = self.phase.wall_particles();
        if walls == 0 {
            return;
        }
        let (phase, gradients) = (&self.phase, &self.scratch.velocity_gradient);
        self.neighbourhood.pack::<GradientExtrapolation<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 10][..1 + D * D],
            &|i, record: &mut [T]| {
                record[0] = phase.volume(i);
                write_rows(record, &gradients[i]);
            },
        );
        let formula = GradientExtrapolation::<K, D> { kernel: setting.kernel.clone() };
        self.neighbourhood.sum_first(walls, &formula, &self.scratch.records, &mut self.scratch.extra);
        for i in 0..walls {
            if M::RIGID_GRAINS && self.phase.is_evolving(i) {
                continue;
            }
            let weight = self.scratch.extra.get(i, 0);
            let inverse = if weight > T::ZERO { T::ONE / weight } else { T::ZERO };
            for a in 0..D {
                self.scratch.velocity_gradient[i][a] =
                    vector_sum(&self.scratch.extra, i, 1 + a * D) * inverse;
            }
        }
    }
}

/// The rows of a gradient, behind the volume.
fn write_rows<T: Real, const D: usize>(record: &mut [T], rows: &[Vector<T, D>; D]) {
    for (a, row) in rows.iter().enumerate() {
        record[1 + a * D..1 + (a + 1) * D].copy_from_slice(&row.0);
    }
}
