//! What the two constituents see of each other: pore pressure and expansion of the water at the soil, and
//! the soil's volume fraction and its rate at the water (67)–(69).

use super::across::{Across, Records};
use super::between::Pass;
use super::constituent::Constituent;
use super::evaluation::vector_sum;
use super::extrapolation::borne;
use super::{Phase, WallKind};
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, Sums, add_vector, number, vector};

/// `Σ w_j W`, `Σ w_j p_j W`, `Σ w_j v_ij·∇W` and `Σ w_j x_ij W` over the other constituent; record: x, v, w, p, with
/// w = V of water and w = V φ of soil.
pub(super) struct Pore<K, const D: usize> {
    pub(super) kernel: K,
}

/// Places of the sums.
mod sum {
    pub(super) const WEIGHT: usize = 0;
    pub(super) const PRESSURE: usize = 1;
    pub(super) const APPROACH: usize = 2;
    pub(super) const LEVER: usize = 3;
}

#[derive(Clone, Copy)]
pub(super) struct Seen<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    weight: N,
    pressure: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Pore<K, D> {
    const BLOCKS: usize = (2 * D + 2).div_ceil(4);
    const SUMS: usize = 3 + D;
    type At<N: Num<Scalar = T>> = Seen<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Seen<N, D> {
        Seen {
            x: vector(record, 0),
            v: vector(record, D),
            weight: number(record, 2 * D),
            pressure: number(record, 2 * D + 1),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Seen<N, D>, j: &Seen<N, D>, sums: &mut [N; MOST]) {
        let x = i.x - j.x;
        let r2 = x.norm2();
        let weight = j.weight * self.kernel.value(r2);
        sums[sum::WEIGHT] += weight;
        sums[sum::PRESSURE] += weight * j.pressure;
        sums[sum::APPROACH] += j.weight * self.kernel.slope(r2) * (i.v - j.v).dot(x);
        add_vector(sums, sum::LEVER, x * weight);
    }
}

/// What each constituent sees of the other at one instant.
#[derive(Default)]
pub(super) struct Pores<T> {
    /// S_i = Σ V_a W \[-\]: how much of the soil's surroundings water fills.
    pub(super) saturation: Vec<T>,
    /// p_i = Σ V_a p_a W / S_i \[Pa\].
    pub(super) pressure: Vec<T>,
    /// D_i = Σ V_a v_ai·∇_aW / S_i \[1/s\]: how fast the water there is compressed.
    pub(super) compression: Vec<T>,
    /// φ_a by its sum (68) \[-\].
    pub(super) fraction: Vec<T>,
    /// Dφ_a/Dt (69) \[1/s\].
    pub(super) fraction_rate: Vec<T>,
    /// What extrapolating the pressure into walls gives to the particles \[W\].
    pub(super) extrapolation_power: f64,
    sums: Sums<T>,
}

/// Below this S_i soil is dry: there is no water to have a pressure.
const DRY: f64 = 1e-9;

impl<T: Real> Pores<T> {
    /// Looks from each constituent at the other. `fall` is ρ̃₀ g of the water, which presses it against walls.
    pub(super) fn look<const D: usize, S: Material<T>, F: Material<T>>(
        &mut self,
        across: &mut Across<T, D>,
        soil: &Phase<T, D, S>,
        water: &Constituent<T, D, F>,
        fall: Vector<T, D>,
    ) {
        let of_soil = |i: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&soil.now.velocity[i].0);
            record[D] = soil.grains(i);
        };
        let of_water = |a: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&water.phase.now.velocity[a].0);
            record[D] = water.pressing_volume(a);
            record[D + 1] = water.phase.pressure[a];
        };
        let records = Records { dummy: &[T::ZERO; 5][..D + 2], of_soil: &of_soil, of_water: &of_water };
        across.sum(Pass::Pores, &records, &mut self.sums);
        let sums = &self.sums;
        let over = |i: usize, k: usize| {
            let weight = sums.get(i, sum::WEIGHT);
            if weight > T::of(DRY) { sums.get(i, k) / weight } else { T::ZERO }
        };
        self.saturation = (0..soil.len()).map(|i| sums.get(i, sum::WEIGHT)).collect();
        self.pressure = (0..soil.len()).map(|i| over(i, sum::PRESSURE)).collect();
        // v_ai·∇_aW is v_ia·∇_iW.
        self.compression = (0..soil.len()).map(|i| over(i, sum::APPROACH)).collect();
        self.extrapolate(soil, fall, water.phase.material().least_pressure());
        let sums = &self.sums;
        let at = |a: usize, k: usize| sums.get(across.water(a), k);
        self.fraction = (0..water.phase.len()).map(|a| T::ONE - at(a, sum::WEIGHT)).collect(); // (68)
        self.fraction_rate = (0..water.phase.len()).map(|a| -at(a, sum::APPROACH)).collect(); // (69)
    }

    /// In a wall water is on one side only, and its mean pressure that of another place: what the water
    /// between weighs makes up for it, as in Adami et al. (2012), down to the least pressure the water has.
    fn extrapolate<const D: usize, S: Material<T>>(
        &mut self,
        soil: &Phase<T, D, S>,
        fall: Vector<T, D>,
        least: T,
    ) {
        self.extrapolation_power = 0.0;
        for i in 0..soil.wall_particles() {
            let weight = self.sums.get(i, sum::WEIGHT);
            if !matches!(soil.wall_kind(i), WallKind::Extrapolated { .. }) || weight <= T::of(DRY) {
                continue;
            }
            let lever: Vector<T, D> = vector_sum(&self.sums, i, sum::LEVER);
            let mean = self.pressure[i];
            self.pressure[i] = borne(mean + fall.dot(lever) / weight, least);
            let beyond = self.pressure[i] - mean;
            let work = soil.grains(i) * beyond * self.sums.get(i, sum::APPROACH);
            self.extrapolation_power += work.as_f64();
        }
    }
}
