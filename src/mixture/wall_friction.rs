//! What stress between particles and an extrapolated wall takes beyond the particles' own `Vφτ:∇v`, of
//! which the law knows.

use super::constituent::Constituent;
use super::corrected::corrected;
use super::evaluation::vector_sum;
use super::setting::Setting;
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, add_vector, number, vector};

/// `Σ_i m_i T_i ∇W` and `Σ_i m_i (v_i − v_w)⊗∇W` for wall particle `w` over the fluid beside it, with `T = τφ/ρ²`;
/// record: x, v, m, T by rows.
///
/// The wall shows viscosity another velocity `ṽ_w` than it has, and has the stress of the fluid; so the
/// fluid's `Vφτ:∇v` is not conjugate to the force between the two. The difference is the first sum times
/// `ṽ_w − v_w`, and `T_w` times the second.
pub(super) struct WallFriction<K, const D: usize> {
    kernel: K,
}

#[derive(Clone, Copy)]
pub(super) struct Sticky<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    mass: N,
    stress: [Vector<N, D>; D],
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for WallFriction<K, D> {
    const BLOCKS: usize = (2 * D + 1 + D * D).div_ceil(4);
    const SUMS: usize = D + D * D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Sticky<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Sticky<N, D> {
        let mut stress = [Vector::zero(); D];
        for a in 0..D {
            stress[a] = vector(record, 2 * D + 1 + a * D);
        }
        Sticky { x: vector(record, 0), v: vector(record, D), mass: number(record, 2 * D), stress }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Sticky<N, D>, j: &Sticky<N, D>, sums: &mut [N; MOST]) {
        let (x, slip) = (i.x - j.x, j.v - i.v);
        let slope = x * (j.mass * self.kernel.slope(x.norm2()));
        for a in 0..D {
            sums[a] += j.stress[a].dot(slope);
            add_vector(sums, D + a * D, slope * slip.0[a]);
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Books what stress takes between particles and extrapolated walls: of water the deviatoric stress,
    /// as viscosity; of rigid grains, which store the work of all stress in their memory, all of it.
    pub(super) fn book_wall_friction<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let formula = WallFriction::<K, D> { kernel: setting.kernel.clone() };
        let (phase, shown) = (&self.phase, &self.scratch.wall_velocity);
        let corrections = &self.scratch.correction;
        let stress = |i: usize, a: usize| {
            let density = phase.density(i);
            let pull = phase.volume_fraction(i) / (density * density);
            let mut row = phase.deviator_row(i, a);
            if M::RIGID_GRAINS {
                row[a] -= phase.pressure[i];
            }
            corrected(corrections.get(i), row * pull)
        };
        self.neighbourhood.pack::<WallFriction<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 13][..1 + D + D * D],
            &|i, record: &mut [T]| {
                record[..D].copy_from_slice(&phase.now.velocity[i].0);
                record[D] = phase.mass[i];
                for a in 0..D {
                    record[D + 1 + a * D..D + 1 + (a + 1) * D].copy_from_slice(&stress(i, a).0);
                }
            },
        );
        let walls = phase.wall_particles();
        self.neighbourhood.sum_first(walls, &formula, &self.scratch.records, &mut self.scratch.extra);
        let sums = &self.scratch.extra;
        let friction = |i: usize| {
            let v = phase.now.velocity[i];
            let lag = *shown.get(i).unwrap_or(&v) - v;
            let pulled = lag.dot(vector_sum(sums, i, 0));
            let slipped =
                (0..D).fold(T::ZERO, |sum, a| sum + stress(i, a).dot(vector_sum(sums, i, D + a * D)));
            (phase.mass[i] * (pulled + slipped)).as_f64()
        };
        let extrapolated = (0..walls).filter(|&i| !phase.is_evolving(i));
        let account = if M::RIGID_GRAINS { Account::WallExtrapolation } else { Account::Viscosity };
        self.exchange_rate.taken[account] += extrapolated.map(friction).sum::<f64>();
    }
}
