//! Density diffusion with the renormalised density gradient (Antuono et al. 2010).

use super::DensityDiffusion;
use super::compressed::{self, Compressed};
use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::setting::Setting;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel::{self, CHUNK};
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, Sums, add_vector, vector};

/// First pass: `Σ V_j (e_j − e_i) ∇W` (numbers `0..D`) and `Σ V_j (x_j − x_i)⊗∇W` (then, `D + αD + β`);
/// record: x, volume, e.
pub(crate) struct CompressionGradient<K, const D: usize> {
    pub(crate) kernel: K,
}

/// Second pass: `Σ V_j [(e_i − e_j) − ½(∇e_i + ∇e_j)·x_ij] F`; record: x, volume, e, ∇e.
pub(crate) struct RenormalisedDiffusion<K, const D: usize> {
    pub(crate) kernel: K,
}

/// What the second pass reads.
#[derive(Clone, Copy)]
pub(crate) struct Sloping<N: Copy, const D: usize> {
    at: Compressed<N, D>,
    gradient: Vector<N, D>,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for CompressionGradient<K, D> {
    const BLOCKS: usize = Compressed::<T, D>::LENGTH.div_ceil(4);
    const SUMS: usize = D + D * D;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Compressed<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Compressed<N, D> {
        Compressed::read(record)
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Compressed<N, D>, j: &Compressed<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let slope = x * (self.kernel.slope(x.norm2()) * j.volume);
        add_vector(sums, 0, slope * (j.compression - i.compression));
        for a in 0..D {
            for b in 0..D {
                sums[D + a * D + b] -= x.0[a] * slope.0[b];
            }
        }
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for RenormalisedDiffusion<K, D> {
    const BLOCKS: usize = (Compressed::<T, D>::LENGTH + D).div_ceil(4);
    const SUMS: usize = 1;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Sloping<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Sloping<N, D> {
        Sloping { at: Compressed::read(record), gradient: vector(record, Compressed::<N, D>::LENGTH) }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Sloping<N, D>, j: &Sloping<N, D>, sums: &mut [N; MOST]) {
        let x = i.at.x - j.at.x;
        let explained = (i.gradient + j.gradient).dot(x) * N::lit(0.5);
        let unexplained = i.at.compression - j.at.compression - explained;
        sums[0] += j.at.volume * self.kernel.slope(x.norm2()) * unexplained;
    }
}

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// The diffusive sum of (52) with the renormalised density gradient.
    pub(super) fn add_renormalised_diffusion<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        if !matches!(self.diffusion, DensityDiffusion::Renormalised(_)) {
            return;
        }
        let gradients = self.compression_gradients(setting);
        let phase = &self.phase;
        self.neighbourhood.pack::<RenormalisedDiffusion<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO, T::ZERO],
            &|i, record: &mut [T]| {
                compressed::write(record, phase, i);
                record[2..2 + D].copy_from_slice(&gradients[i].0);
            },
        );
        let formula = RenormalisedDiffusion::<K, D> { kernel: setting.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let factor = self.diffusivity(setting);
        for (i, rate) in self.phase.rate.excess.iter_mut().enumerate() {
            *rate += factor * self.phase.volume_fraction[i] * self.scratch.extra.get(i, 0);
        }
    }

    /// The renormalised gradient of the compression at every particle \[1/m\].
    fn compression_gradients<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) -> Vec<Vector<T, D>> {
        let phase = &self.phase;
        self.neighbourhood.pack::<CompressionGradient<K, D>>(
            &phase.position,
            &mut self.scratch.records,
            &[T::ZERO, T::ZERO],
            &|i, record: &mut [T]| compressed::write(record, phase, i),
        );
        let formula = CompressionGradient::<K, D> { kernel: setting.kernel.clone() };
        self.neighbourhood.sum(&formula, &self.scratch.records, &mut self.scratch.extra);
        let sums = &self.scratch.extra;
        let mut gradients = vec![Vector::zero(); phase.len()];
        parallel::for_each_part(&mut gradients, 1, CHUNK, &|first, part: &mut [Vector<T, D>]| {
            for (k, gradient) in part.iter_mut().enumerate() {
                *gradient = renormalised(sums, first + k);
            }
        });
        gradients
    }
}

/// The gradient in the sums of [`CompressionGradient`]; none where too few neighbours are there to
/// know one, as in free flight.
fn renormalised<T: Real, const D: usize>(sums: &Sums<T>, i: usize) -> Vector<T, D> {
    let raw: Vector<T, D> = vector_sum(sums, i, 0);
    let rows: [Vector<T, D>; D] = core::array::from_fn(|a| vector_sum(sums, i, D + a * D));
    let Some(inverse) = T::inverse(&rows.map(|row| row.0)) else { return Vector::zero() };
    // The unit matrix in the bulk; nearly collinear neighbours would make a gradient of their noise.
    let known = inverse.iter().flatten().all(|x| x.abs() < T::of(10.0));
    if known { Vector(inverse.map(|row| Vector(row).dot(raw))) } else { Vector::zero() }
}
