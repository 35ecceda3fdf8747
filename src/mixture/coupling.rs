//! The coupling of soil and water: pore pressure and drag, pair by pair equal and opposite (55), (58).
//!
//! The default form acts on pressure *differences*: with w = V φ of a soil particle i and the pressure
//! p_i = Σ V_a p_a W / S_i of the water around it, water particle a feels
//!
//! $$\mathbf F_{ai} = V_a w_i (p_i - p_a)\nabla_a W_{ai},$$
//!
//! and i the opposite: nothing at uniform pressure, wherever the particles are. The rate of the water's
//! density that conserves energy with it is
//!
//! $$\frac{D\rho_a}{Dt} = \tilde\rho_a\Big[\sum_b V_b \mathbf v_{ab}\cdot\nabla_a W_{ab}
//! - \sum_i w_i W_{ai} D_i\Big],\qquad D_i = \frac1{S_i}\sum_a V_a\,\mathbf v_{ai}\cdot\nabla_a W_{ai}.$$

use super::Phase;
use super::across::{Across, Records};
use super::between::{Between, Pass};
use super::constituent::Constituent;
use super::drag::Drag;
use super::evaluation::vector_sum;
use super::pore::Pores;
use super::setting::Setting;
use crate::budget::Account;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, Neighbourhood, PairFormula, Record, Sums, add_vector, number, vector};
use crate::time::Moment;
use std::sync::Arc;

/// How the pore pressure acts between water and soil.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CouplingForm {
    /// By pressure differences: no force at uniform pressure, wherever the particles are.
    #[default]
    PressureDifference,
    /// As printed (55), (58): by the water particle's own pressure, `−V_a w_i p_a ∇W`. Grains on a lattice
    /// then hold water in place the harder the higher its absolute pressure.
    Printed,
}

/// Force, drag and what the water's density feels of the soil; record: x, v, w, V, p, D, C, s, with
/// s = 1 of water and −1 of soil, D zero of water and C zero of soil.
pub(super) struct Exchange<K, const D: usize> {
    pub(super) kernel: K,
}

/// Places of the sums: after the force `Σ w_j s_i (p_j − p_i) ∇W` and the drag `Σ V_j C W v_ji`.
mod sum {
    /// `Σ w_j D_j W`.
    pub(super) const COMPRESSION: usize = 0;
    /// `Σ V_j C W`.
    pub(super) const DRAG: usize = 1;
    /// `Σ V_j C W v_ij²`.
    pub(super) const DRAG_POWER: usize = 2;
    pub(super) const COUNT: usize = 3;
}

#[derive(Clone, Copy)]
pub(super) struct Coupled<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    weight: N,
    volume: N,
    pressure: N,
    compression: N,
    drag: N,
    sign: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for Exchange<K, D> {
    const BLOCKS: usize = (2 * D + 6).div_ceil(4);
    const SUMS: usize = 2 * D + sum::COUNT;
    type At<N: Num<Scalar = T>> = Coupled<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Coupled<N, D> {
        Coupled {
            x: vector(record, 0),
            v: vector(record, D),
            weight: number(record, 2 * D),
            volume: number(record, 2 * D + 1),
            pressure: number(record, 2 * D + 2),
            compression: number(record, 2 * D + 3),
            drag: number(record, 2 * D + 4),
            sign: number(record, 2 * D + 5),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Coupled<N, D>, j: &Coupled<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (i.x - j.x, i.v - j.v);
        let r2 = x.norm2();
        let (value, slope) = (self.kernel.value(r2), self.kernel.slope(r2));
        add_vector(sums, 0, x * (slope * j.weight * (i.sign * (j.pressure - i.pressure))));
        let drag = j.volume * (i.drag + j.drag) * value;
        add_vector(sums, D, -(v * drag));
        sums[2 * D + sum::COMPRESSION] += j.weight * j.compression * value;
        sums[2 * D + sum::DRAG] += drag;
        sums[2 * D + sum::DRAG_POWER] += drag * v.norm2();
    }
}

/// All there is between soil and water.
pub(super) struct Coupling<T: Real, const D: usize> {
    pub(super) across: Across<T, D>,
    pub(super) pores: Pores<T>,
    pub(super) form: CouplingForm,
    pub(super) drag: Drag<T>,
    sums: Sums<T>,
}

impl<T: Real, const D: usize> Coupling<T, D> {
    pub(super) fn new(kernel: Arc<dyn Between<T, D>>, neighbourhood: Neighbourhood<T, D>) -> Self {
        Self {
            across: Across::new(kernel, neighbourhood),
            pores: Pores::default(),
            form: CouplingForm::default(),
            drag: Drag::default(),
            sums: Sums::default(),
        }
    }

    /// What each constituent sees of the other, with the pressures and velocities of now.
    pub(super) fn look<K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
        &mut self,
        setting: &Setting<T, D, K>,
        soil: &mut Constituent<T, D, S>,
        water: &Constituent<T, D, F>,
    ) {
        let sorted = [soil.neighbourhood.rebuilds(), water.neighbourhood.rebuilds()];
        self.across.find_neighbours(&soil.phase.position, &water.phase.position, sorted);
        let density = water.phase.material().reference_density();
        let fall = setting.gravity * density;
        self.pores.look(&mut self.across, &soil.phase, water, fall);
        if self.form == CouplingForm::Printed {
            self.pores.pressure.fill(T::ZERO);
            self.pores.compression.fill(T::ZERO);
            self.pores.extrapolation_power = 0.0;
        }
        soil.buoyancy.clear();
        soil.buoyancy.extend(self.pores.saturation.iter().map(|s| density * s.min(T::ONE)));
    }

    /// Adds forces to the accelerations, and to the water's density rate what it feels of the soil.
    pub(super) fn exchange<K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
        &mut self,
        setting: &Setting<T, D, K>,
        soil: &mut Constituent<T, D, S>,
        water: &mut Constituent<T, D, F>,
    ) {
        if self.drag.is_evaluated && !self.drag.is_reconstructed {
            let phases = (&soil.phase, &water.phase);
            self.drag.find_slip(&mut self.across, phases, Moment::Now);
        }
        self.sum_exchange(soil, water);
        if self.drag.is_projected {
            self.project_drag(&soil.phase, &water.phase);
        }
        self.drag.rate.clear();
        self.push_soil(soil);
        self.push_water(water);
        if self.drag.is_reconstructed && self.drag.is_evaluated {
            self.push_reconstructed(&setting.kernel, soil, water);
        }
        if self.drag.is_evaluated {
            self.drag.find_limit(&self.across, &water.phase);
        }
        water.add_fraction_rate(&self.pores.fraction_rate);
    }

    fn sum_exchange<S: Material<T>, F: Material<T>>(
        &mut self,
        soil: &Constituent<T, D, S>,
        water: &Constituent<T, D, F>,
    ) {
        let seen = |a: usize| water.pressing_volume(a);
        let (soil, water) = (&soil.phase, &water.phase);
        let (pores, drag) = (&self.pores, &self.drag);
        let of_soil = |i: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&soil.now.velocity[i].0);
            record[D] = soil.grains(i);
            record[D + 1] = drag.soil_side(soil, i, || pores.saturation[i]);
            record[D + 2] = pores.pressure[i];
            record[D + 3] = pores.compression[i];
            record[D + 4] = T::ZERO;
            record[D + 5] = -T::ONE;
        };
        let of_water = |a: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&water.now.velocity[a].0);
            record[D] = seen(a);
            record[D + 1] = water.volume(a);
            record[D + 2] = water.pressure[a];
            record[D + 3] = T::ZERO;
            record[D + 4] = if drag.is_elsewhere() { T::ZERO } else { drag.coefficient(water, a) };
            record[D + 5] = T::ONE;
        };
        let records = Records { dummy: &[T::ZERO; 9][..D + 6], of_soil: &of_soil, of_water: &of_water };
        self.across.sum(Pass::Exchange, &records, &mut self.sums);
    }

    /// Puts drag along the line between particles where drag stands in the sums.
    fn project_drag<S: Material<T>, F: Material<T>>(
        &mut self,
        soil: &Phase<T, D, S>,
        water: &Phase<T, D, F>,
    ) {
        let (pores, drag) = (&self.pores, &self.drag);
        let of_soil = |i: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&soil.now.velocity[i].0);
            record[D] = drag.soil_side(soil, i, || pores.saturation[i]);
            record[D + 1] = T::ZERO;
        };
        let of_water = |a: usize, record: &mut [T]| {
            record[..D].copy_from_slice(&water.now.velocity[a].0);
            record[D] = water.volume(a);
            record[D + 1] = drag.coefficient(water, a);
        };
        let mut projected = Sums::default();
        let records = Records { dummy: &[T::ZERO; 5][..D + 2], of_soil: &of_soil, of_water: &of_water };
        self.across.sum(Pass::ProjectedDrag, &records, &mut projected);
        for i in 0..soil.len() + water.len() {
            for k in 0..D {
                self.sums.set(i, D + k, projected.get(i, k));
            }
            self.sums.set(i, 2 * D + sum::DRAG, projected.get(i, D));
            self.sums.set(i, 2 * D + sum::DRAG_POWER, projected.get(i, D + 1));
        }
    }

    fn push_soil<S: Material<T>>(&mut self, soil: &mut Constituent<T, D, S>) {
        let walls = soil.phase.wall_particles();
        let mut buoyancy = 0.0;
        for i in 0..soil.phase.len() {
            if soil.phase.is_apart(i) {
                self.drag.rate.push(T::ZERO);
                continue;
            }
            let grains = soil.phase.grains(i);
            // V/m of drag: the normalised weight is that of the pair.
            let density = soil.phase.density(i) / self.drag.normalisation(self.pores.saturation[i]);
            let (push, rate) = self.push(i, grains / soil.phase.mass[i], density);
            soil.phase.rate.acceleration[i] += push;
            self.drag.rate.push(rate);
            if i >= walls {
                let force: Vector<T, D> = vector_sum(&self.sums, i, 0);
                buoyancy += (grains * force.dot(soil.phase.now.velocity[i])).as_f64();
            }
        }
        soil.exchange_rate.buoyancy = buoyancy;
    }

    fn push_water<F: Material<T>>(&mut self, water: &mut Constituent<T, D, F>) {
        let mut power = 0.0;
        for a in 0..water.phase.len() {
            let at = self.across.water(a);
            let density = water.phase.density(a);
            // Where it has no pressure, deep in a wall, soil is not pushed by it, and does not push it.
            let presses = water.pressing_volume(a) > T::ZERO;
            let weight = if presses { T::ONE / density } else { T::ZERO };
            let (push, rate) = self.push(at, weight, density);
            water.phase.rate.acceleration[a] += push;
            // K_ia v_ia² summed over the pairs of a, each once: V_a V_i C W v².
            let drag_power = self.sums.get(at, 2 * D + sum::DRAG_POWER);
            power += (water.phase.volume(a) * drag_power).as_f64();
            self.drag.rate.push(rate);
            water.add_density_rate(a, -self.sums.get(at, 2 * D + sum::COMPRESSION));
        }
        if self.drag.is_evaluated {
            water.exchange_rate.taken[Account::Drag] += power;
        }
        water.exchange_rate.taken[Account::WallExtrapolation] -= self.pores.extrapolation_power;
    }

    /// Drag of reconstructed velocities.
    fn push_reconstructed<K: Kernel<T, D>, S: Material<T>, F: Material<T>>(
        &mut self,
        kernel: &K,
        soil: &mut Constituent<T, D, S>,
        water: &mut Constituent<T, D, F>,
    ) {
        let drag = self.reconstruct_drag(kernel, soil, water, (Moment::Now, true));
        let [on_soil, on_water] = drag.acceleration;
        add_all(&mut soil.phase.rate.acceleration, &on_soil);
        add_all(&mut water.phase.rate.acceleration, &on_water);
        self.drag.rate = drag.rate.concat();
        water.exchange_rate.taken[Account::Drag] += drag.power;
    }

    /// Acceleration \[m/s²\] of the particle in row `i` by the other constituent, and how fast drag acts on it
    /// \[1/s\]. `weight` is w/m, `density` partial: V/m = 1/ρ.
    fn push(&self, i: usize, weight: T, density: T) -> (Vector<T, D>, T) {
        let force: Vector<T, D> = vector_sum(&self.sums, i, 0);
        let drag: Vector<T, D> = vector_sum(&self.sums, i, D);
        let inverse = T::ONE / density;
        let push = if self.drag.is_evaluated { force * weight + drag * inverse } else { force * weight };
        (push, self.sums.get(i, 2 * D + sum::DRAG) * inverse)
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        self.across.bytes() + self.sums.bytes() + self.drag.bytes()
    }
}

fn add_all<T: Real, const D: usize>(into: &mut [Vector<T, D>], terms: &[Vector<T, D>]) {
    for (sum, term) in into.iter_mut().zip(terms) {
        *sum += *term;
    }
}
