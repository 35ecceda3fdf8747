//! The pass that gives extrapolated walls their pressure, velocity and stress (Adami et al. 2012).

use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::setting::Setting;
use super::wall_contact::Contact;
use super::{Slip, WallKind};
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

/// `Σ V W` and `Σ V τ W`; record: x, volume, τ.
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
    const SELDOM: bool = true;
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

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    pub(super) fn has_extrapolated_walls(&self) -> bool {
        self.phase.walls().iter().any(|wall| matches!(wall.kind(), WallKind::Extrapolated { .. }))
    }

    /// Pressure and velocity of extrapolated walls (Adami et al. 2012):
    /// `p_w = ⟨p⟩ + (g − a_w)·⟨ρ̃ (x_w − x)⟩`; viscosity sees `2v_w − ⟨v⟩`
    /// where the wall holds, and a wall gliding along with the material where not.
    pub(super) fn extrapolate_walls<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        if !self.has_extrapolated_walls() {
            return;
        }
        if self.may_glide() {
            self.find_wall_normals(setting);
        }
        let formula = Extrapolation::<K, D> { kernel: setting.kernel.clone() };
        let (phase, buoyancy) = (&self.phase, &self.buoyancy);
        let o = T::ZERO;
        let dummy: &[T] = &[o, o, o, o, o, o][..D + 3];
        self.neighbourhood.pack::<Extrapolation<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            dummy,
            &|i, record: &mut [T]| {
                record[..D].copy_from_slice(&phase.now.velocity[i].0);
                record[D] = phase.volume(i);
                record[D + 1] = phase.pressure[i];
                record[D + 2] = phase.true_density(i) - buoyancy.get(i).copied().unwrap_or(T::ZERO);
            },
        );
        self.neighbourhood.sum_first(
            phase.wall_particles(),
            &formula,
            &self.scratch.records,
            &mut self.scratch.sums,
        );
        if M::RIGID_GRAINS {
            self.sum_stress_beside_walls(setting);
        }
        self.scratch.wall_velocity.clear();
        self.scratch.contacts.clear();
        self.scratch.reached.clear();
        for i in 0..self.phase.wall_particles() {
            let shown = self.extrapolate_wall(setting, i);
            self.scratch.wall_velocity.push(shown);
            let is_given = !matches!(self.phase.wall_kind(i), WallKind::Extrapolated { .. });
            self.scratch
                .reached
                .push(is_given || self.scratch.sums.get(i, sum::WEIGHT) > T::of(OUT_OF_REACH));
        }
    }

    /// Sets pressure and density of wall particle `i`, of soil its stress and what it offers soil that
    /// glides along; returns the velocity it shows to viscosity.
    fn extrapolate_wall<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>, i: usize) -> Vector<T, D> {
        let v_wall = self.phase.now.velocity[i];
        let WallKind::Extrapolated { slip, suction } = self.phase.wall_kind(i) else {
            self.scratch.contacts.push(Contact::none());
            return v_wall;
        };
        let sums = &self.scratch.sums;
        let weight = sums.get(i, sum::WEIGHT);
        let (mut pressure, mut slip_velocity) = (T::ZERO, Vector::zero());
        // From the material into the wall.
        let lever: Vector<T, D> = vector_sum(sums, i, sum::LEVER);
        if weight > T::ZERO {
            let fall = setting.gravity - self.phase.wall_acceleration[i];
            let mean: Vector<T, D> = vector_sum(sums, i, sum::LEVER + D);
            pressure = (sums.get(i, sum::PRESSURE) + fall.dot(lever)) / weight;
            // No lower in a wall than in the material, which may cavitate.
            pressure = borne(pressure, self.phase.material().least_pressure());
            slip_velocity = mean * (T::ONE / weight) - v_wall;
        }
        if !suction {
            pressure = pressure.max(T::ZERO);
        }
        if M::RIGID_GRAINS {
            let contact = self.set_wall_stress(i, pressure, slip, slip_velocity);
            self.scratch.contacts.push(contact.unwrap_or(Contact::none()));
            return match contact {
                None => v_wall - slip_velocity,
                // Soil does not feel how far the wall is, only how fast it nears: the wall comes to meet it.
                Some(Contact { normal, .. }) => {
                    v_wall + slip_velocity - normal * (T::of(2.0) * normal.dot(slip_velocity))
                }
            };
        }
        let excess = self.phase.material().compression(pressure) * self.phase.volume_fraction[i];
        self.phase.pressure[i] = pressure;
        self.phase.now.excess[i] = excess;
        self.phase.half.excess[i] = excess;
        if slip == Slip::NoSlip {
            v_wall - slip_velocity
        } else {
            v_wall + slip_velocity - lever * (lever.dot(slip_velocity) / lever.norm2().max(tiny()))
        }
    }

    /// Deviatoric stress of extrapolated walls: the water's without slip, none where it glides.
    pub(super) fn extrapolate_viscous_stress<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        self.sum_stress_beside_walls(setting);
        for i in 0..self.phase.wall_particles() {
            match self.phase.wall_kind(i) {
                WallKind::Dynamic => {}
                WallKind::Extrapolated { slip: Slip::NoSlip, .. } => {
                    self.phase.deviator[i] = self.stress_beside_wall(i);
                }
                WallKind::Extrapolated { .. } | WallKind::Given => self.phase.deviator[i] = SymTensor::zero(),
            }
        }
    }

    /// The sums behind [`stress_beside_wall`](Self::stress_beside_wall).
    fn sum_stress_beside_walls<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let formula = StressExtrapolation::<K, D> { kernel: setting.kernel.clone() };
        let phase = &self.phase;
        self.neighbourhood.pack::<StressExtrapolation<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 7],
            &|i, record: &mut [T]| {
                record[0] = phase.volume(i);
                record[1..7].copy_from_slice(&phase.deviator[i].0);
            },
        );
        let walls = phase.wall_particles();
        self.neighbourhood.sum_first(walls, &formula, &self.scratch.records, &mut self.scratch.extra);
    }

    /// Mean deviatoric stress ⟨τ⟩ beside wall particle `i` \[Pa\].
    pub(super) fn stress_beside_wall(&self, i: usize) -> SymTensor<T> {
        let sums = &self.scratch.extra;
        let weight = sums.get(i, 0);
        let mut stress = SymTensor::zero();
        if weight > T::ZERO {
            for k in 0..6 {
                stress.0[k] = sums.get(i, 1 + k) / weight;
            }
        }
        stress
    }
}

/// Where material fills less of a wall particle's surroundings, rounding alone makes it near.
const OUT_OF_REACH: f64 = 1e-9;

/// The pressure, or the least the material has; what is not a number stays none.
pub(super) fn borne<T: Real>(pressure: T, least: T) -> T {
    if pressure < least { least } else { pressure }
}

/// Keeps `x/x` finite at `x = 0`.
fn tiny<T: Real>() -> T {
    T::of(1e-30)
}
