//! What stress between particles and an extrapolated wall takes beyond the particles' own `Vφτ:∇v`, of
//! which the law knows.

use super::constituent::Constituent;
use super::setting::Setting;
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::{SymTensor, Vector};
use crate::summation::{MOST, PairFormula, Record, number, symmetric, vector};

/// `Σ_i m_i F [T_i x·(ṽ_w − v_w) + T_w x·(v_i − v_w)]` for wall particle `w` over the fluid beside it, with
/// `T = τφ/ρ²` and `∇W = F x`; record: x, v, ṽ, m, T.
///
/// The wall shows viscosity another velocity `ṽ_w` than it has, and has the stress of the fluid; so the
/// fluid's `Vφτ:∇v` is not conjugate to the force between the two. This is the difference, pair by pair.
pub(crate) struct WallFriction<K, const D: usize> {
    pub(crate) kernel: K,
}

/// Length of a record.
pub(crate) const fn record_length(dimension: usize) -> usize {
    3 * dimension + 1 + dimension * (dimension + 1) / 2
}

/// Writes `v`, `ṽ`, `m` and `T = pull τ` behind the place.
pub(crate) fn write<T: Real, const D: usize>(
    record: &mut [T],
    velocities: [&Vector<T, D>; 2],
    mass: T,
    pull: T,
    stress: &SymTensor<T>,
) {
    for (k, v) in velocities.into_iter().enumerate() {
        record[k * D..(k + 1) * D].copy_from_slice(&v.0);
    }
    record[2 * D] = mass;
    let mut k = 2 * D + 1;
    for a in 0..D {
        for b in a..D {
            record[k] = stress.0[SymTensor::<T>::index(a, b)] * pull;
            k += 1;
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Sticky<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    shown: Vector<N, D>,
    mass: N,
    stress: [Vector<N, D>; D],
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for WallFriction<K, D> {
    const BLOCKS: usize = record_length(D).div_ceil(4);
    const SUMS: usize = 1;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Sticky<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Sticky<N, D> {
        let stress = symmetric(record, 3 * D + 1);
        Sticky {
            x: vector(record, 0),
            v: vector(record, D),
            shown: vector(record, 2 * D),
            mass: number(record, 3 * D),
            stress,
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Sticky<N, D>, j: &Sticky<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let mass_slope = j.mass * self.kernel.slope(x.norm2());
        let (lag, slip) = (i.shown - i.v, j.v - i.v);
        for a in 0..D {
            sums[0] += mass_slope * (j.stress[a].dot(x) * lag.0[a] + i.stress[a].dot(x) * slip.0[a]);
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Books what stress takes between particles and extrapolated walls: of water the deviatoric stress,
    /// as viscosity; of rigid grains, which store the work of all stress in their memory, all of it.
    pub(super) fn book_wall_friction<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let formula = WallFriction::<K, D> { kernel: setting.kernel.clone() };
        let (phase, shown) = (&self.phase, &self.scratch.wall_velocity);
        self.neighbourhood.pack::<WallFriction<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 13][..record_length(D) - D],
            &|i, record: &mut [T]| {
                let (v, density) = (&phase.now.velocity[i], phase.density(i));
                let pull = phase.volume_fraction(i) / (density * density);
                let velocities = [v, shown.get(i).unwrap_or(v)];
                let stress = if M::RIGID_GRAINS { phase.stress(i) } else { phase.deviator[i] };
                write(record, velocities, phase.mass[i], pull, &stress);
            },
        );
        let walls = phase.wall_particles();
        self.neighbourhood.sum_first(walls, &formula, &self.scratch.records, &mut self.scratch.extra);
        let friction = |i: usize| (phase.mass[i] * self.scratch.extra.get(i, 0)).as_f64();
        let extrapolated = (0..walls).filter(|&i| !phase.is_evolving(i));
        let account = if M::RIGID_GRAINS { Account::WallExtrapolation } else { Account::Viscosity };
        self.exchange_rate.taken[account] += extrapolated.map(friction).sum::<f64>();
    }
}
