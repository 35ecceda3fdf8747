//! Where soil glides along an extrapolated wall: what passes between the two is what a contact bears.
//!
//! A wall that holds is more soil: it shears what is beside it, and is sheared. One along which soil glides
//! is not. Across their contact the soil sees no shear strain and finds none of its own shear stress, but
//! Coulomb's friction under the very force with which the two press on each other. What other passes
//! summed of that is taken back here.

use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::setting::Setting;
use super::{Slip, WallKind};
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::{SymTensor, Vector};
use crate::summation::{MOST, PairFormula, Record, add_vector, number, symmetric, vector};

/// What a wall particle offers soil that glides along it; zeros where it holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact<T: Real, const D: usize> {
    /// Into the wall.
    pub(super) normal: Vector<T, D>,
    /// Shear traction over the normal one \[-\]: along the slip, at most as long as μ.
    pub(super) friction: Vector<T, D>,
}

impl<T: Real, const D: usize> Contact<T, D> {
    pub(super) fn none() -> Self {
        Self { normal: Vector::zero(), friction: Vector::zero() }
    }
}

/// `−Σ_j m_j F (n·x) u_a n_b` with `u` the part of `v_j − v_i` along the wall, sum number `aD + b`:
/// the shear across the contact, out of the velocity gradient; record: x, velocity shown, m, n.
struct Unsheared<K, const D: usize> {
    kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Gliding<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    mass: N,
    normal: Vector<N, D>,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Unsheared<K, D> {
    const BLOCKS: usize = (3 * D + 1).div_ceil(4);
    const SUMS: usize = D * D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Gliding<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Gliding<N, D> {
        Gliding {
            x: vector(record, 0),
            v: vector(record, D),
            mass: number(record, 2 * D),
            normal: vector(record, 2 * D + 1),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Gliding<N, D>, j: &Gliding<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (i.x - j.x, j.v - i.v);
        // Only one of the two is of a wall.
        let n = i.normal + j.normal;
        let across = n * (j.mass * self.kernel.slope(x.norm2()) * n.dot(x));
        let along = v - n * n.dot(v);
        for a in 0..D {
            for b in 0..D {
                sums[a * D + b] -= along.0[a] * across.0[b];
            }
        }
    }
}

/// `Σ_j m_j F (n·x) [q min(S_n, 0) − (S n − n S_n)]` with `S` the sum of both `σφ/ρ²` and `S_n = n·S n`:
/// friction `q` instead of shear stress; record: x, m, n, q, σφ/ρ².
struct Rubbing<K, const D: usize> {
    kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Pressed<N: Copy, const D: usize> {
    x: Vector<N, D>,
    mass: N,
    normal: Vector<N, D>,
    friction: Vector<N, D>,
    stress: [Vector<N, D>; D],
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Rubbing<K, D> {
    const BLOCKS: usize = (3 * D + 1 + D * (D + 1) / 2).div_ceil(4);
    const SUMS: usize = D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Pressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Pressed<N, D> {
        let stress = symmetric(record, 3 * D + 1);
        Pressed {
            x: vector(record, 0),
            mass: number(record, D),
            normal: vector(record, D + 1),
            friction: vector(record, 2 * D + 1),
            stress,
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Pressed<N, D>, j: &Pressed<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let n = i.normal + j.normal;
        let across = j.mass * self.kernel.slope(x.norm2()) * n.dot(x);
        let mut traction = Vector::zero();
        for a in 0..D {
            traction.0[a] = (i.stress[a] + j.stress[a]).dot(n);
        }
        let normal = traction.dot(n);
        let rubbing = (i.friction + j.friction) * normal.min(N::lit(0.0));
        add_vector(sums, 0, (rubbing - traction + n * normal) * across);
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Whether this is soil beside a wall along which it may glide.
    pub(super) fn may_glide(&self) -> bool {
        let glides = |kind| matches!(kind, WallKind::Extrapolated { slip, .. } if slip != Slip::NoSlip);
        M::RIGID_GRAINS && self.phase.walls().iter().any(|wall| glides(wall.kind()))
    }

    fn contact(&self, i: usize) -> Contact<T, D> {
        self.scratch.contacts.get(i).copied().unwrap_or(Contact::none())
    }

    /// Takes the shear across contacts out of the sums of the velocity gradient (65), (66).
    pub(super) fn take_contact_shear<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        if !self.may_glide() {
            return;
        }
        let formula = Unsheared::<K, D> { kernel: setting.kernel.clone() };
        let mut records = core::mem::take(&mut self.scratch.records);
        let (this, phase, shown) = (&*self, &self.phase, &self.scratch.wall_velocity);
        self.neighbourhood.pack::<Unsheared<K, D>>(
            &phase.position,
            &mut records,
            &[T::ZERO; 7][..2 * D + 1],
            &|i, record: &mut [T]| {
                record[..D].copy_from_slice(&shown.get(i).unwrap_or(&phase.now.velocity[i]).0);
                record[D] = phase.mass[i];
                record[D + 1..2 * D + 1].copy_from_slice(&this.contact(i).normal.0);
            },
        );
        self.neighbourhood.sum(&formula, &records, &mut self.scratch.extra);
        self.scratch.records = records;
        let mut stored = 0.0;
        for i in self.phase.wall_particles()..self.phase.len() {
            let stress = self.phase.stress(i);
            let mut work = T::ZERO;
            for k in 0..D * D {
                let taken = self.scratch.extra.get(i, k);
                work += stress.0[SymTensor::<T>::index(k / D, k % D)] * taken;
                self.scratch.sums.set(i, k, self.scratch.sums.get(i, k) + taken);
            }
            let density = self.phase.density(i);
            stored +=
                (work * self.phase.mass[i] * self.phase.volume_fraction(i) / (density * density)).as_f64();
        }
        self.exchange_rate.taken[Account::WallExtrapolation] -= stored;
    }

    /// Puts friction in the place of shear stress across contacts (55).
    pub(super) fn rub_contacts<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        if !self.may_glide() {
            return;
        }
        let formula = Rubbing::<K, D> { kernel: setting.kernel.clone() };
        let mut records = core::mem::take(&mut self.scratch.records);
        let (this, phase) = (&*self, &self.phase);
        self.neighbourhood.pack::<Rubbing<K, D>>(
            &phase.position,
            &mut records,
            &[T::ZERO; 13][..2 * D + 1 + D * (D + 1) / 2],
            &|i, record: &mut [T]| {
                let density = phase.density(i);
                let pull = phase.volume_fraction(i) / (density * density);
                let (contact, stress) = (this.contact(i), phase.stress(i));
                record[0] = phase.mass[i];
                record[1..=D].copy_from_slice(&contact.normal.0);
                record[D + 1..2 * D + 1].copy_from_slice(&contact.friction.0);
                let mut k = 2 * D + 1;
                for a in 0..D {
                    for b in a..D {
                        record[k] = stress.0[SymTensor::<T>::index(a, b)] * pull;
                        k += 1;
                    }
                }
            },
        );
        self.neighbourhood.sum(&formula, &records, &mut self.scratch.extra);
        self.scratch.records = records;
        let mut given = 0.0;
        for i in 0..self.phase.len() {
            let acceleration: Vector<T, D> = vector_sum(&self.scratch.extra, i, 0);
            self.phase.rate.acceleration[i] += acceleration;
            given += (self.phase.mass[i] * acceleration.dot(self.phase.now.velocity[i])).as_f64();
        }
        self.exchange_rate.taken[Account::WallExtrapolation] -= given;
    }
}
