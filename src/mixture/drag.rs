//! Drag of soil and water on each other: the coefficient at each water particle, and the step explicit drag
//! bears.

use super::Phase;
use super::across::{Across, Records};
use super::between::Pass;
use super::evaluation::vector_sum;
use crate::kernel::Kernel;
use crate::material::{DragLaw, Material, NoDrag};
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, Sums, add_vector, number, vector};
use crate::time::Moment;
use std::sync::Arc;

/// `Σ V_j W v_ij`, then `Σ V_j W`; record: x, v, V.
pub(super) struct Slip<K, const D: usize> {
    pub(super) kernel: K,
}

#[derive(Clone, Copy)]
pub(super) struct Moving<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    volume: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Slip<K, D> {
    const BLOCKS: usize = (2 * D + 1).div_ceil(4);
    const SUMS: usize = D + 1;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Moving<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Moving<N, D> {
        Moving { x: vector(record, 0), v: vector(record, D), volume: number(record, 2 * D) }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Moving<N, D>, j: &Moving<N, D>, sums: &mut [N; MOST]) {
        let weight = j.volume * self.kernel.value((i.x - j.x).norm2());
        add_vector(sums, 0, (i.v - j.v) * weight);
        sums[D] += weight;
    }
}

/// How much faster than plain drag that of reconstructed velocities may act: slips of waves as short as the kernel are
/// larger than those of the particles. At most 1.07 of the plain limit's rate was measured on lattices and in disorder.
pub(crate) const RECONSTRUCTED_HASTE: f64 = 1.1;

/// How soil and water drag each other.
pub(super) struct Drag<T: Real> {
    pub(super) law: Arc<dyn DragLaw<T>>,
    /// Whether drag is among the forces, or solved over the step.
    pub(super) is_evaluated: bool,
    /// Whether the weights of the water around a soil particle are made to add up to one.
    pub(super) is_normalised: bool,
    /// Whether it acts along the line between the particles of a pair only.
    pub(super) is_projected: bool,
    /// Whether velocities are reconstructed between the particles of a pair.
    pub(super) is_reconstructed: bool,
    /// |v_a − Σ V_i W v_i/Σ V_i W| at each water particle \[m/s\]; empty where the law does not ask for it.
    slip: Vec<T>,
    /// How fast drag acts on each particle, soil first: `Σ_j K_ij/m_i` \[1/s\].
    pub(super) rate: Vec<T>,
    /// How fast the fastest pair is dragged, `Σ_b K_ib/m_i + Σ_j K_ja/m_a` \[1/s\].
    pub(super) fastest: T,
    sums: Sums<T>,
}

impl<T: Real> Default for Drag<T> {
    fn default() -> Self {
        Self {
            law: Arc::new(NoDrag),
            is_evaluated: true,
            is_normalised: false,
            is_projected: false,
            is_reconstructed: false,
            slip: Vec::new(),
            rate: Vec::new(),
            fastest: T::ZERO,
            sums: Sums::default(),
        }
    }
}

impl<T: Real> Drag<T> {
    /// The slip at each water particle, with the velocities of `moment`, if the law asks.
    pub(super) fn find_slip<const D: usize, S: Material<T>, F: Material<T>>(
        &mut self,
        across: &mut Across<T, D>,
        (soil, water): (&Phase<T, D, S>, &Phase<T, D, F>),
        moment: Moment,
    ) {
        self.slip.clear();
        if !self.law.knows_slip() {
            return;
        }
        let of_soil = |i: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&soil.fields(moment).velocity[i].0);
            record[D] = if soil.is_apart(i) { T::ZERO } else { soil.volume(i) };
        };
        let of_water = |a: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&water.fields(moment).velocity[a].0);
            record[D] = T::ZERO;
        };
        let records = Records { dummy: &[T::ZERO; 4][..D + 1], of_soil: &of_soil, of_water: &of_water };
        across.sum(Pass::Slip, &records, &mut self.sums);
        self.slip.extend((0..water.len()).map(|a| {
            let at = across.water(a);
            let weight = self.sums.get(at, D);
            let slip: Vector<T, D> = vector_sum(&self.sums, at, 0);
            if weight > T::ZERO { slip.norm() / weight } else { T::ZERO }
        }));
    }

    /// What the pairs of a soil particle are weighted with, where the water fills S \[-\] of its surroundings:
    /// 1/S if weights are normalised, but for soil so dry, or so near a surface, that less than half is filled.
    pub(super) fn normalisation(&self, filled: T) -> T {
        if self.is_normalised && filled >= T::of(0.5) { T::ONE / filled } else { T::ONE }
    }

    /// The soil's side of K = V_i V_a C_a W/S_i: V_i/S_i \[m³, in 2D m²\] of particle `i`, V_i where weights are not
    /// normalised, nothing of walls that are apart. `filled` is S_i.
    ///
    /// S_i counts the water that drags. Explicit drag that is not reconstructed takes Σ V_a W of the pore pressure for
    /// it, which is summed anyway and leaves out water so deep in a wall that it has no pressure: soil that sees any of
    /// that is as a rule not half surrounded by water, so that its weights are not normalised.
    pub(super) fn soil_side<const D: usize, S: Material<T>>(
        &self,
        soil: &Phase<T, D, S>,
        i: usize,
        filled: impl FnOnce() -> T,
    ) -> T {
        if soil.is_apart(i) {
            return T::ZERO;
        }
        let filled = if self.is_normalised { filled() } else { T::ONE };
        soil.volume(i) * self.normalisation(filled)
    }

    /// How much faster than plain drag it may act.
    fn haste(&self) -> T {
        if self.is_reconstructed { T::of(RECONSTRUCTED_HASTE) } else { T::ONE }
    }

    /// Whether its sums are not those of the plain slip.
    pub(super) fn is_elsewhere(&self) -> bool {
        self.is_projected || self.is_reconstructed
    }

    /// C_d \[kg/m³/s\] at water particle `a`.
    #[inline(always)]
    pub(super) fn coefficient<const D: usize, F: Material<T>>(&self, water: &Phase<T, D, F>, a: usize) -> T {
        let slip = self.slip.get(a).copied().unwrap_or(T::ZERO);
        self.law.coefficient(water.volume_fraction(a), water.true_density(a), slip)
    }

    /// The step at which explicit drag turns unstable under leap-frog with its half-step approximation, and under
    /// velocity-Verlet:
    ///
    /// $$\Delta t < 1\Big/\max_{i,a}\Big(\sum_b\frac{K_{ib}}{m_i} + \sum_j\frac{K_{ja}}{m_a}\Big)$$
    ///
    /// over the pairs that see each other: the row sums of the matrix that takes the slips of all pairs to their
    /// rates. Where drag grows with the slip, it is the tangent that counts.
    pub(super) fn find_limit<const D: usize, F: Material<T>>(
        &mut self,
        across: &Across<T, D>,
        water: &Phase<T, D, F>,
    ) {
        let (soil, of_water) = self.rate.split_at(self.rate.len() - water.len());
        let most = of_water.iter().copied().fold(T::ZERO, Num::max);
        let mut fastest = T::ZERO;
        for (i, &rate) in soil.iter().enumerate() {
            // Most particles cannot be of the fastest pair, whoever is near them.
            if rate > T::ZERO && rate + most > fastest {
                across.for_each_water_near(i, |a, _, _| fastest = fastest.max(rate + of_water[a]));
            }
        }
        self.fastest = fastest * self.steepening(water) * self.haste();
    }

    /// The step \[s\] at which explicit drag turns unstable.
    pub(super) fn limit(&self) -> T {
        if self.fastest > T::ZERO { T::ONE / self.fastest } else { T::INFINITY }
    }

    /// How much steeper than C_d the drag is over the slip, at most.
    fn steepening<const D: usize, F: Material<T>>(&self, water: &Phase<T, D, F>) -> T {
        let mut most = T::ONE;
        for (a, &slip) in self.slip.iter().enumerate() {
            let (fraction, density) = (water.volume_fraction(a), water.true_density(a));
            let secant = self.law.coefficient(fraction, density, slip);
            if secant > T::ZERO {
                most = most.max(self.law.tangent(fraction, density, slip) / secant);
            }
        }
        most
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.sums.bytes() + (self.slip.capacity() + self.rate.capacity()) * size_of::<T>()
    }
}
