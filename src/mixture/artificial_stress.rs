//! Artificial stress against the clumping of particles under tension (Gray, Monaghan & Swift 2001).
//!
//! Particles under tension attract each other more the closer they are, and gather in clumps. A short-range
//! repulsion in the directions of tension keeps them apart:
//!
//! $$\left(\frac{D\mathbf v_i}{Dt}\right)_{art} = \sum_j m_j \left(\frac{W_{ij}}{W(\Delta x)}\right)^n
//! (\mathbf R_i + \mathbf R_j)\cdot\nabla_i W_{ij},\qquad
//! R' = -\epsilon\,\frac{\phi}{\rho^2}\,\max(\sigma', 0)$$
//!
//! in the frame of the principal stresses σ′.

use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::setting::Setting;
use crate::budget::Account;
use crate::error::ParameterError;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::{Principal, SymTensor, Vector};
use crate::summation::{MOST, PairFormula, Record, number, vector};

/// Strength and reach of the repulsion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ArtificialStress<T> {
    /// ε \[-\]: the part of the tension that is opposed at the initial spacing; usually 0.3, 0 for none.
    pub strength: T,
    /// n \[-\]: how fast it grows as particles come closer; usually 4.
    pub exponent: u32,
    /// Initial spacing Δx \[m\].
    pub spacing: T,
}

impl<T: Real> ArtificialStress<T> {
    /// Itself, if it is usable.
    pub(super) fn checked(self) -> Result<Self, ParameterError> {
        if !(self.strength >= T::ZERO && self.strength <= T::ONE) {
            return Err(ParameterError::new("artificial_stress.strength", self.strength, "from 0 to 1"));
        }
        if !(1..=10).contains(&self.exponent) {
            return Err(ParameterError::new("artificial_stress.exponent", self.exponent, "from 1 to 10"));
        }
        if !(self.spacing > T::ZERO && self.spacing.is_finite()) {
            return Err(ParameterError::new("artificial_stress.spacing", self.spacing, "positive [m]"));
        }
        Ok(self)
    }
}

/// `Σ m_j (W/W(Δx))ⁿ (R_i + R_j)·∇W`; record: x, m, R.
struct Repulsion<T, K, const D: usize> {
    kernel: K,
    /// `1/W(Δx)`.
    scale: T,
    exponent: u32,
}

#[derive(Clone, Copy)]
pub(crate) struct Tense<N: Copy, const D: usize> {
    x: Vector<N, D>,
    mass: N,
    stress: [Vector<N, D>; D],
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Repulsion<T, K, D> {
    const BLOCKS: usize = (D + 1 + D * (D + 1) / 2).div_ceil(4);
    const SUMS: usize = D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Tense<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Tense<N, D> {
        let mut stress = [Vector::zero(); D];
        let mut k = D + 1;
        for a in 0..D {
            for b in a..D {
                stress[a].0[b] = number(record, k);
                stress[b].0[a] = number(record, k);
                k += 1;
            }
        }
        Tense { x: vector(record, 0), mass: number(record, D), stress }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Tense<N, D>, j: &Tense<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let r2 = x.norm2();
        let nearness = self.kernel.value(r2) * N::splat(self.scale);
        let mut weight = j.mass * self.kernel.slope(r2);
        for _ in 0..self.exponent {
            weight *= nearness;
        }
        for a in 0..D {
            sums[a] += weight * (i.stress[a] + j.stress[a]).dot(x);
        }
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Adds the repulsion to the accelerations and books what it takes.
    pub(super) fn add_artificial_stress<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let Some(artificial) = self.artificial_stress.filter(|it| it.strength > T::ZERO) else { return };
        let phase = &self.phase;
        let kernel = setting.kernel.clone();
        let scale = T::ONE / kernel.value(artificial.spacing * artificial.spacing);
        let formula = Repulsion::<T, K, D> { kernel, scale, exponent: artificial.exponent };
        self.neighbourhood.pack::<Repulsion<T, K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO; 7][..1 + D * (D + 1) / 2],
            &|i, record: &mut [T]| {
                record[0] = phase.mass[i];
                let density = phase.density(i);
                let pull = phase.volume_fraction(i) / (density * density);
                let opposed = opposed::<T, D>(&phase.stress(i)) * (artificial.strength * pull);
                let mut k = 1;
                for a in 0..D {
                    for b in a..D {
                        record[k] = opposed.0[SymTensor::<T>::index(a, b)];
                        k += 1;
                    }
                }
            },
        );
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let mut taken = 0.0;
        for i in 0..self.phase.len() {
            let push: Vector<T, D> = vector_sum(&self.scratch.extra, i, 0);
            self.phase.rate.acceleration[i] += push;
            taken -= (self.phase.mass[i] * push.dot(self.phase.now.velocity[i])).as_f64();
        }
        self.exchange_rate.taken[Account::ArtificialStress] += taken;
    }
}

/// The tension in a stress, with the opposite sign: of the components that act in the particle space.
fn opposed<T: Real, const D: usize>(stress: &SymTensor<T>) -> SymTensor<T> {
    let mut acting = SymTensor::zero();
    for a in 0..D {
        for b in a..D {
            let k = SymTensor::<T>::index(a, b);
            acting.0[k] = stress.0[k];
        }
    }
    // What is not finite is found by the checks that follow.
    let Some(principal) = Principal::of(&acting) else { return acting };
    principal.with(&principal.values.map(|value| -value.max(T::ZERO)))
}
