//! Gradients that are exact for linear fields wherever the particles are, and forces conjugate to them
//! (Bonet & Lok 1999).
//!
//! $$B_i = \Big[\sum_j w_j\,(\mathbf x_j - \mathbf x_i)\otimes\nabla W_{ij}\Big]^{-T},\qquad
//! \nabla\mathbf v_i = \sum_j w_j\,(\mathbf v_j - \mathbf v_i)\otimes B_i\nabla W_{ij},$$
//! $$m_i\,\mathbf a_i = \sum_j q_iq_j\,(\sigma_iB_i + \sigma_jB_j)\nabla W_{ij}$$
//!
//! Pair by pair equal and opposite, and its power is that of the stress on the corrected gradient. As printed,
//! q is the mass and σ is over ρ²; water that shares its space with soil has its volume for q, as its pressure has.

use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::own_pairs::sum;
use super::setting::Setting;
use super::{GradientWeight, Phase};
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel::{self, CHUNK};
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{ChunkSums, MOST, PairFormula, Record, number, vector};

/// `Σ q_j x_ji ⊗ ∇W`, sum number `αD + β`; record: x, q.
struct Moment<K, const D: usize> {
    kernel: K,
}

/// `Σ q_j (Q_i + Q_j) ∇W`; record: x, q, Q by rows.
struct Pull<K, const D: usize> {
    kernel: K,
}

#[derive(Clone, Copy)]
pub(crate) struct Placed<N: Copy, const D: usize> {
    x: Vector<N, D>,
    weight: N,
}

#[derive(Clone, Copy)]
pub(crate) struct Stressed<N: Copy, const D: usize> {
    x: Vector<N, D>,
    weight: N,
    stress: [Vector<N, D>; D],
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Moment<K, D> {
    const BLOCKS: usize = 1;
    const SUMS: usize = D * D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Placed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Placed<N, D> {
        Placed { x: vector(record, 0), weight: number(record, D) }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Placed<N, D>, j: &Placed<N, D>, sums: &mut [N; MOST]) {
        let x = j.x - i.x;
        let slope = x * -(self.kernel.slope(x.norm2()) * j.weight);
        for a in 0..D {
            for b in 0..D {
                sums[a * D + b] += x.0[a] * slope.0[b];
            }
        }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Pull<K, D> {
    const BLOCKS: usize = (D + 1 + D * D).div_ceil(4);
    const SUMS: usize = D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Stressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Stressed<N, D> {
        let mut stress = [Vector::zero(); D];
        for a in 0..D {
            stress[a] = vector(record, D + 1 + a * D);
        }
        Stressed { x: vector(record, 0), weight: number(record, D), stress }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Stressed<N, D>, j: &Stressed<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let slope = x * (self.kernel.slope(x.norm2()) * j.weight);
        for a in 0..D {
            sums[a] += (i.stress[a] + j.stress[a]).dot(slope);
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Which weight a neighbour has in the gradient to which the forces are conjugate.
    pub(super) fn effective_weight(&self) -> GradientWeight {
        if self.is_corrected && self.shares_pressure { GradientWeight::Printed } else { self.gradient_weight }
    }

    /// B of every particle; of walls that evolve nothing, the unit matrix.
    fn find_correction<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let (phase, weight) = (&self.phase, self.effective_weight());
        self.neighbourhood.pack::<Moment<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO],
            &|i, record: &mut [T]| record[0] = weight.of(phase, i),
        );
        let formula = Moment::<K, D> { kernel: setting.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let sums = &self.scratch.extra;
        let mut corrections = core::mem::take(&mut self.scratch.correction);
        corrections.resize(phase.len(), unit());
        parallel::for_each_part(&mut corrections, 1, CHUNK, &|first, part: &mut [[Vector<T, D>; D]]| {
            for (k, correction) in part.iter_mut().enumerate() {
                let i = first + k;
                let moment = core::array::from_fn(|a| vector_sum(sums, i, a * D) * weight.scale(phase, i));
                *correction = if phase.is_evolving(i) { correction_of(&moment) } else { unit() };
            }
        });
        self.scratch.correction = corrections;
    }

    /// Corrects the velocity gradient in the sums: `(∇v)^αβ = Σ_γ B^βγ (…)^αγ`.
    pub(super) fn correct_gradient_sums(&mut self) {
        let sums = &mut self.scratch.sums;
        for (i, correction) in self.scratch.correction.iter().enumerate() {
            for a in 0..D {
                let row: Vector<T, D> = vector_sum(sums, i, a * D);
                for (b, column) in correction.iter().enumerate() {
                    sums.set(i, a * D + b, column.dot(row));
                }
            }
        }
    }

    /// Keeps the expansion ∇·v of the corrected gradient in the sums \[1/s\].
    fn keep_expansion(&mut self) {
        let trace = |i: usize| {
            let gradient = self.velocity_gradient(i);
            (0..D).fold(T::ZERO, |sum, a| sum + gradient[a][a])
        };
        let expansion: Vec<T> = (0..self.phase.len()).map(trace).collect();
        self.scratch.expansion = expansion;
    }

    /// B, and ∇·v by it: of the velocities walls have, not those they show viscosity.
    pub(super) fn find_corrected_expansion<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        self.find_correction(setting);
        self.sum_velocity_gradient(setting, false);
        self.correct_gradient_sums();
        self.keep_expansion();
    }

    /// Puts the corrected expansion into the sums in place of that of the pairs: `Σ m_j v_ij·∇W = −ρ ∇·v` (52), (53).
    /// Of shared space the soil's part is the coupling's.
    pub(super) fn put_expansion(&self, sums: &mut ChunkSums<T>) {
        let (phase, shared) = (&self.phase, self.shares_pressure);
        let first = sums.first;
        let expansions = self.scratch.expansion.iter().skip(first);
        for ((l, compression), &expansion) in
            sums.all_mut(D + sum::COMPRESSION).iter_mut().enumerate().zip(expansions)
        {
            let i = first + l;
            // Walls that evolve nothing have no correction.
            if !phase.is_evolving(i) {
                continue;
            }
            let density = if shared { phase.true_density(i) } else { phase.density(i) };
            *compression = -density * expansion;
        }
    }

    /// Adds the corrected force of pressure and deviatoric stress, (55), (58), own part.
    pub(super) fn add_corrected_force<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let (phase, corrections, shared) = (&self.phase, &self.scratch.correction, self.shares_pressure);
        self.neighbourhood.pack::<Pull<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 10][..1 + D * D],
            &|i, record: &mut [T]| {
                record[0] = if shared { phase.volume(i) } else { phase.mass[i] };
                let density = phase.density(i);
                // The pressure of water that shares its space acts on all of it; the coupling takes the soil's part.
                let (deviator, pressure) = if shared {
                    (phase.volume_fraction(i), phase.pressure[i])
                } else {
                    let pull = phase.volume_fraction(i) / (density * density);
                    (pull, phase.pressure[i] * pull)
                };
                for a in 0..D {
                    let mut row = phase.deviator_row(i, a) * deviator;
                    row[a] -= pressure;
                    record[1 + a * D..1 + (a + 1) * D].copy_from_slice(&corrected(corrections.get(i), row).0);
                }
            },
        );
        let formula = Pull::<K, D> { kernel: setting.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        for i in 0..self.phase.len() {
            let scale = if shared { T::ONE / self.phase.density(i) } else { T::ONE };
            self.phase.rate.acceleration[i] += vector_sum(&self.scratch.extra, i, 0) * scale;
        }
    }
}

impl GradientWeight {
    /// `m_j` or `m_j/ρ_j`.
    #[inline(always)]
    pub(super) fn of<T: Real, const D: usize, M: Material<T>>(self, phase: &Phase<T, D, M>, j: usize) -> T {
        match self {
            Self::Conjugate => phase.mass[j],
            Self::Printed => phase.volume(j),
        }
    }

    /// What a sum with these weights is still to be multiplied by: `1/ρ_i` or nothing.
    #[inline(always)]
    pub(super) fn scale<T: Real, const D: usize, M: Material<T>>(
        self,
        phase: &Phase<T, D, M>,
        i: usize,
    ) -> T {
        match self {
            Self::Conjugate => T::ONE / phase.density(i),
            Self::Printed => T::ONE,
        }
    }
}

/// A row of a stress times the correction of its particle, if there is one.
#[inline(always)]
pub(super) fn corrected<T: Real, const D: usize>(
    correction: Option<&[Vector<T, D>; D]>,
    row: Vector<T, D>,
) -> Vector<T, D> {
    let Some(correction) = correction else { return row };
    (0..D).fold(Vector::zero(), |sum, b| sum + correction[b] * row[b])
}

/// The transposed inverse of a moment; the unit matrix where the neighbours are too few, or too nearly on one line,
/// to tell, as in free flight.
pub(super) fn correction_of<T: Real, const D: usize>(moment: &[Vector<T, D>; D]) -> [Vector<T, D>; D] {
    let Some(inverse) = T::inverse(&moment.map(|row| row.0)) else { return unit() };
    let known = inverse.iter().flatten().all(|x| x.abs() < T::of(LARGEST));
    if known { core::array::from_fn(|a| Vector(core::array::from_fn(|b| inverse[b][a]))) } else { unit() }
}

/// Largest entry of a correction that is believed: about one in the bulk, two at a surface, four in a corner.
const LARGEST: f64 = 10.0;

fn unit<T: Real, const D: usize>() -> [Vector<T, D>; D] {
    core::array::from_fn(|a| Vector(core::array::from_fn(|b| if a == b { T::ONE } else { T::ZERO })))
}
