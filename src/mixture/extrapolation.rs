//! The pass that gives extrapolated walls their pressure, velocity and stress (Adami et al. 2012).

use super::evaluation::vector_sum;
use super::{Mixture, Slip, WallKind};
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::SymTensor;
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, add_vector, number, vector};

/// What a wall particle gathers from the material beside it; record: x, v, volume, pressure, true
/// density.
pub(crate) struct Extrapolation<K, const D: usize> {
    pub(crate) kernel: K,
}

/// Places of the sums; `Σ V ρ̃ x_wf W` follows at [`sum::LEVER`], `Σ V v W` after it.
pub(crate) mod sum {
    /// `Σ V W`.
    pub(crate) const WEIGHT: usize = 0;
    /// `Σ V p W`.
    pub(crate) const PRESSURE: usize = 1;
    /// `Σ V ρ̃ (x_w − x_f) W`.
    pub(crate) const LEVER: usize = 2;
}

#[derive(Clone, Copy)]
pub(crate) struct Fluid<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    volume: N,
    pressure: N,
    true_density: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Extrapolation<K, D> {
    const BLOCKS: usize = (2 * D + 3).div_ceil(4);
    const SUMS: usize = 2 + 2 * D;
    type At<N: Num<Scalar = T>> = Fluid<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Fluid<N, D> {
        Fluid {
            x: vector(record, 0),
            v: vector(record, D),
            volume: number(record, 2 * D),
            pressure: number(record, 2 * D + 1),
            true_density: number(record, 2 * D + 2),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Fluid<N, D>, j: &Fluid<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let weight = j.volume * self.kernel.value(x.norm2());
        sums[sum::WEIGHT] += weight;
        sums[sum::PRESSURE] += weight * j.pressure;
        add_vector(sums, sum::LEVER, x * (weight * j.true_density));
        add_vector(sums, sum::LEVER + D, j.v * weight);
    }
}

/// `Σ V W` and `Σ V τ W` for wall particles; record: x, volume, τ.
pub(crate) struct StressExtrapolation<K, const D: usize> {
    pub(crate) kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Stressed<N: Copy, const D: usize> {
    x: Vector<N, D>,
    volume: N,
    stress: [N; 6],
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for StressExtrapolation<K, D> {
    const BLOCKS: usize = (D + 7).div_ceil(4);
    const SUMS: usize = 7;
    type At<N: Num<Scalar = T>> = Stressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Stressed<N, D> {
        let mut stress = [N::lit(0.0); 6];
        for k in 0..6 {
            stress[k] = number(record, D + 1 + k);
        }
        Stressed { x: vector(record, 0), volume: number(record, D), stress }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Stressed<N, D>, j: &Stressed<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let weight = j.volume * self.kernel.value(x.norm2());
        sums[0] += weight;
        for k in 0..6 {
            sums[1 + k] += weight * j.stress[k];
        }
    }
}

impl<T: Real, const D: usize, K: Kernel<T, D>, F: Material<T>> Mixture<T, D, K, F> {
    pub(super) fn has_extrapolated_walls(&self) -> bool {
        self.water.walls().iter().any(|wall| wall.kind() != WallKind::Dynamic)
    }

    /// Pressure and velocity of extrapolated walls (Adami et al. 2012):
    /// `p_w = ⟨p⟩ + (g − a_w)·⟨ρ̃ (x_w − x)⟩`; viscosity sees `2v_w − ⟨v⟩`
    /// without slip, and a wall gliding along with the fluid with free slip.
    pub(super) fn extrapolate_walls(&mut self) {
        if !self.has_extrapolated_walls() {
            return;
        }
        let formula = Extrapolation::<K, D> { kernel: self.kernel.clone() };
        let water = &self.water;
        let o = T::ZERO;
        let dummy: &[T] = &[o, o, o, o, o, o][..D + 3];
        self.neighbourhood.pack::<Extrapolation<K, D>>(
            &water.position,
            &mut self.scratch.records,
            dummy,
            &|i, record: &mut [T]| {
                record[..D].copy_from_slice(&water.now.velocity[i].0);
                record[D] = water.volume(i);
                record[D + 1] = water.pressure[i];
                record[D + 2] = water.true_density(i);
            },
        );
        self.neighbourhood.sum_first(
            water.wall_particles(),
            &formula,
            &self.scratch.records,
            &mut self.scratch.sums,
        );
        self.scratch.wall_velocity.clear();
        for i in 0..self.water.wall_particles() {
            let shown = self.extrapolate_wall(i);
            self.scratch.wall_velocity.push(shown);
        }
    }

    /// Sets pressure and density of wall particle `i`; returns the velocity it shows to viscosity.
    fn extrapolate_wall(&mut self, i: usize) -> Vector<T, D> {
        let v_wall = self.water.now.velocity[i];
        let WallKind::Extrapolated { slip, suction } =
            self.water.walls()[usize::from(self.water.body[i])].kind()
        else {
            return v_wall;
        };
        let sums = &self.scratch.sums;
        let weight = sums.get(i, sum::WEIGHT);
        let (mut pressure, mut shown) = (T::ZERO, v_wall);
        if weight > T::ZERO {
            let fall = self.gravity - self.water.wall_acceleration[i];
            let lever: Vector<T, D> = vector_sum(sums, i, sum::LEVER);
            let mean: Vector<T, D> = vector_sum(sums, i, sum::LEVER + D);
            pressure = (sums.get(i, sum::PRESSURE) + fall.dot(lever)) / weight;
            let slip_velocity = mean * (T::ONE / weight) - v_wall;
            shown = match slip {
                Slip::NoSlip => v_wall - slip_velocity,
                // The lever points from the fluid into the wall.
                Slip::FreeSlip => {
                    v_wall + slip_velocity - lever * (lever.dot(slip_velocity) / lever.norm2().max(tiny()))
                }
            };
        }
        if !suction {
            pressure = pressure.max(T::ZERO);
        }
        let excess = self.water.material().compression(pressure) * self.water.volume_fraction[i];
        self.water.pressure[i] = pressure;
        self.water.now.excess[i] = excess;
        self.water.half.excess[i] = excess;
        shown
    }

    /// Stress of extrapolated walls: the fluid's without slip, none where it glides.
    pub(super) fn extrapolate_stress(&mut self) {
        let formula = StressExtrapolation::<K, D> { kernel: self.kernel.clone() };
        let water = &self.water;
        self.neighbourhood.pack::<StressExtrapolation<K, D>>(
            &water.position,
            &mut self.scratch.records,
            &[T::ZERO; 7],
            &|i, record: &mut [T]| {
                record[0] = water.volume(i);
                record[1..7].copy_from_slice(&water.deviator[i].0);
            },
        );
        self.neighbourhood.sum_first(
            water.wall_particles(),
            &formula,
            &self.scratch.records,
            &mut self.scratch.extra,
        );
        let sums = &self.scratch.extra;
        for i in 0..self.water.wall_particles() {
            let WallKind::Extrapolated { slip, .. } =
                self.water.walls()[usize::from(self.water.body[i])].kind()
            else {
                continue;
            };
            let weight = sums.get(i, 0);
            let mut stress = SymTensor::zero();
            if slip == Slip::NoSlip && weight > T::ZERO {
                for k in 0..6 {
                    stress.0[k] = sums.get(i, 1 + k) / weight;
                }
            }
            self.water.deviator[i] = stress;
        }
    }
}

/// Keeps `x/x` finite at `x = 0`.
fn tiny<T: Real>() -> T {
    T::of(1e-30)
}
