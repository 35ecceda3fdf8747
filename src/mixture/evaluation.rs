//! The equations, one method each, in the order of a [`Constituent`]'s evaluation.

use super::constituent::Constituent;
use super::continuity::{DensityDiffusion, PairDiffusion};
use super::momentum::Viscosity;
use super::own_pairs::{OwnPairs, sum};
use super::setting::Setting;
use super::shared_pairs::SharedPairs;
use crate::kernel::Kernel;
use crate::material::Material;
use crate::parallel::{self, CHUNK};
use crate::real::Real;
use crate::space::{SymTensor, Tensor, Vector};
use crate::summation::{ChunkSums, PairFormula, Sums};

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Brings the neighbour lists up to date; now and then that re-sorts the particles.
    pub(super) fn find_neighbours(&mut self) {
        if self.neighbourhood.is_stale(&self.phase.position) {
            self.list_neighbours();
        }
    }

    /// Lists the neighbours anew, and sorts the particles for it.
    pub(super) fn list_neighbours(&mut self) {
        let periodic = *self.neighbourhood.periodic();
        if periodic.is_any() {
            for x in &mut self.phase.position {
                *x = periodic.wrap(*x);
            }
        }
        let walls = self.phase.wall_particles();
        let order = self.neighbourhood.cell_order(&self.phase.position, walls);
        self.phase.permute(&order);
        self.neighbourhood.rebuild(&self.phase.position, walls);
    }

    /// Pressure from density: (16), (20).
    pub(super) fn find_pressure(&mut self) {
        let mut pressures = core::mem::take(&mut self.phase.pressure);
        let phase = &self.phase;
        parallel::for_each_part(&mut pressures, 1, CHUNK, &|first, part: &mut [T]| {
            let (fractions, memories) = (&phase.volume_fraction[first..], &phase.now.memory[first..]);
            let fields = phase.now.excess[first..].iter().zip(fractions).zip(memories);
            for (p, ((&excess, &fraction), memory)) in part.iter_mut().zip(fields) {
                let compression = if M::RIGID_GRAINS { T::ZERO } else { excess / fraction };
                *p = phase.material().pressure(compression, memory);
            }
        });
        self.phase.pressure = pressures;
        if M::RIGID_GRAINS {
            self.find_stored_deviator();
        }
    }

    /// Deviatoric stress of a law that stores it: of particles that have their own.
    fn find_stored_deviator(&mut self) {
        let mut deviator = core::mem::take(&mut self.phase.deviator);
        deviator.resize(self.phase.len(), SymTensor::zero());
        let phase = &self.phase;
        parallel::for_each_part(&mut deviator, 1, CHUNK, &|first, part: &mut [SymTensor<T>]| {
            for (tau, memory) in part.iter_mut().zip(&phase.now.memory[first..]) {
                *tau = phase.material().deviator(&Tensor::zero(), memory);
            }
        });
        self.phase.deviator = deviator;
    }

    /// Continuity (52), (53) and the phase's own part of momentum (55), (58).
    pub(super) fn sum_own_pairs<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let stress = self.phase.material().needs_velocity_gradient() && !self.is_corrected;
        match (stress, self.shares_pressure) {
            (true, false) => self.sum_own_pairs_with::<true, K>(setting),
            (false, false) => self.sum_own_pairs_with::<false, K>(setting),
            (true, true) => self.sum_shared_pairs_with::<true, K>(setting),
            (false, true) => self.sum_shared_pairs_with::<false, K>(setting),
        }
        if self.is_corrected {
            self.add_corrected_force(setting);
        }
    }

    /// Whether this is water that shares its space with soil.
    pub(super) fn shares_space(&self) -> bool {
        self.phase.evolving_fraction.is_some()
    }

    fn sum_own_pairs_with<const STRESS: bool, K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let (kernel, (viscosity, diffusion)) = (setting.kernel.clone(), self.dissipation(setting));
        self.pack_own_pairs::<STRESS, K>();
        if diffusion.is_hydrostatic() || self.phase.has_gliding_walls() {
            self.sum_rates(&OwnPairs::<T, K, D, STRESS, false> { kernel, viscosity, diffusion }, setting);
        } else {
            self.sum_rates(&OwnPairs::<T, K, D, STRESS, true> { kernel, viscosity, diffusion }, setting);
        }
    }

    fn sum_shared_pairs_with<const STRESS: bool, K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let (kernel, (viscosity, diffusion)) = (setting.kernel.clone(), self.dissipation(setting));
        self.pack_own_pairs::<STRESS, K>();
        self.sum_rates(&SharedPairs::<T, K, D, STRESS> { kernel, viscosity, diffusion }, setting);
    }

    /// Sums, and turns the sums of each chunk into rates while they are in the cache.
    fn sum_rates<F: PairFormula<T>, K: Kernel<T, D>>(&mut self, formula: &F, setting: &Setting<T, D, K>) {
        let mut acceleration = core::mem::take(&mut self.phase.rate.acceleration);
        let mut excess = core::mem::take(&mut self.phase.rate.excess);
        let mut sums = core::mem::take(&mut self.scratch.sums);
        let this = &*self;
        let collect = |sums: &mut ChunkSums<'_, T>, rates: &mut (&mut [Vector<T, D>], &mut [T])| {
            if this.shares_pressure {
                this.weigh_shared_sums(sums);
            }
            if this.is_corrected {
                this.put_expansion(sums);
            }
            this.collect_rates(setting, sums, rates.0, rates.1);
        };
        let chunk = Sums::<T>::CHUNK;
        let rates = acceleration.chunks_mut(chunk).zip(excess.chunks_mut(chunk));
        this.neighbourhood.sum_and_then(formula, &this.scratch.records, &mut sums, rates, &collect);
        self.phase.rate.acceleration = acceleration;
        self.phase.rate.excess = excess;
        self.scratch.sums = sums;
    }

    /// Artificial viscosity and density diffusion of the pairs.
    fn dissipation<K: Kernel<T, D>>(
        &self,
        setting: &Setting<T, D, K>,
    ) -> (Viscosity<T>, PairDiffusion<T, D>) {
        let material = self.phase.material();
        let (c, reference) = (material.sound_speed(), material.reference_density());
        let slope = material.hydrostatic_slope();
        (
            Viscosity::new(self.viscosity, setting.kernel.smoothing_length(), c),
            PairDiffusion::new(self.diffusion, reference, slope, setting.gravity),
        )
    }

    /// Writes the records of [`OwnPairs`], or of [`SharedPairs`], which wants the pressure itself.
    fn pack_own_pairs<const STRESS: bool, K: Kernel<T, D>>(&mut self) {
        let shared = self.shares_pressure;
        let reference = self.phase.material().reference_density();
        let partial = matches!(self.diffusion, DensityDiffusion::PartialDensity(_));
        // Corrected, the force of the stress is a sum of its own.
        let (phase, corrected) = (&self.phase, self.is_corrected);
        let (o, one) = (T::ZERO, T::ONE);
        // Density one keeps the division of (59) finite; volume zero takes the dummy out.
        let dummy: &[T] = if D == 2 { &[o, o, o, one] } else { &[o, o, o, o, one] };
        self.neighbourhood.pack::<OwnPairs<T, K, D, STRESS, false>>(
            &phase.position,
            &mut self.scratch.records,
            dummy,
            &|i, record: &mut [T]| {
                let density = phase.density(i);
                let volume = phase.mass[i] / density;
                let pull = phase.volume_fraction(i) / (density * density);
                record[..D].copy_from_slice(&phase.now.velocity[i].0);
                record[D] = if phase.is_gliding(i) { -volume } else { volume };
                record[D + 1] = density;
                record[D + 2] = match (corrected, shared) {
                    (true, _) => T::ZERO,
                    (false, true) => phase.pressure[i],
                    (false, false) => phase.pressure[i] * pull,
                };
                record[D + 3] = if partial { density / reference } else { phase.compression(i) };
                if STRESS {
                    let mut k = D + 4;
                    for a in 0..D {
                        for b in a..D {
                            record[k] = phase.deviator[i].0[SymTensor::<T>::index(a, b)] * pull;
                            k += 1;
                        }
                    }
                }
            },
        );
    }

    /// Factor of `Σ V ψ·∇W/2ρ̃₀` in the rate of the excess: `2 δ h c`.
    pub(super) fn diffusivity<K: Kernel<T, D>>(&self, setting: &Setting<T, D, K>) -> T {
        let h = setting.kernel.smoothing_length();
        T::of(2.0) * self.diffusion.coefficient() * h * self.phase.material().sound_speed()
    }

    /// Turns the sums of a chunk into its rates.
    fn collect_rates<K: Kernel<T, D>>(
        &self,
        setting: &Setting<T, D, K>,
        sums: &ChunkSums<T>,
        acceleration: &mut [Vector<T, D>],
        excess: &mut [T],
    ) {
        let own: [&[T]; D] = core::array::from_fn(|axis| &sums.all(axis)[..acceleration.len()]);
        for (k, a) in acceleration.iter_mut().enumerate() {
            *a = Vector(own.map(|sum| sum[k]));
        }
        let walls = self.phase.wall_acceleration.len();
        for a in acceleration.iter_mut().skip(walls.saturating_sub(sums.first)) {
            *a += setting.gravity;
        }
        let factor = self.diffusivity(setting);
        let inverse_reference = T::ONE / self.phase.material().reference_density();
        let terms = sums.all(D + sum::COMPRESSION).iter().zip(sums.all(D + sum::DIFFUSION));
        for (e, (&compression, &diffusion)) in excess.iter_mut().zip(terms) {
            *e = compression * inverse_reference + factor * diffusion; // (52)
        }
    }

    /// Turns the sums of [`SharedPairs`], per volume, into what [`OwnPairs`] would have summed: acceleration
    /// and Dρ/Dt.
    fn weigh_shared_sums(&self, sums: &mut ChunkSums<T>) {
        let phase = &self.phase;
        let chunk = sums.first..phase.len().min(sums.first + Sums::<T>::CHUNK);
        for (l, a) in chunk.enumerate() {
            let inverse = T::ONE / phase.density(a);
            for k in 0..D {
                let pressure = sums.all(D + sum::COUNT + k)[l];
                let own = &mut sums.all_mut(k)[l];
                *own -= pressure * inverse;
            }
            let compression = &mut sums.all_mut(D + sum::COMPRESSION)[l];
            *compression = phase.true_density(a) * *compression;
        }
    }

    /// Adds `ρ̃ rate` to the rate of the partial density of particle `a`, by terms that conserve energy.
    pub(super) fn add_density_rate(&mut self, a: usize, rate: T) {
        let (reference, k) = (self.phase.material().reference_density(), D + sum::COMPRESSION);
        let change = self.phase.true_density(a) * rate;
        self.phase.rate.excess[a] += change / reference;
        let so_far = self.scratch.sums.get(a, k);
        self.scratch.sums.set(a, k, so_far + change);
    }

    /// Lets the volume fractions change (69) while the partial density keeps its rate.
    pub(super) fn add_fraction_rate(&mut self, rates: &[T]) {
        for (excess, rate) in self.phase.rate.excess.iter_mut().zip(rates) {
            *excess -= *rate;
        }
        if let Some(fraction) = &mut self.phase.evolving_fraction {
            fraction.rate.copy_from_slice(rates);
        }
    }

    /// The body force beside gravity.
    pub(super) fn add_body_forces<K: Kernel<T, D>>(&mut self, setting: &Setting<T, D, K>) {
        let Some(force) = &setting.force else { return };
        let walls = self.phase.wall_particles();
        let (time, positions) = (setting.time, &self.phase.position);
        let acceleration = &mut self.phase.rate.acceleration;
        parallel::for_each_part(acceleration, 1, CHUNK, &|first, part: &mut [Vector<T, D>]| {
            for (k, a) in part.iter_mut().enumerate().skip(walls.saturating_sub(first)) {
                *a += (force.acceleration)(&positions[first + k], time);
            }
        });
    }
}

/// The vector whose components are sums `k…` of particle `i`.
pub(super) fn vector_sum<T: Real, const D: usize>(sums: &Sums<T>, i: usize, k: usize) -> Vector<T, D> {
    let mut x = Vector::zero();
    for axis in 0..D {
        x[axis] = sums.get(i, k + axis);
    }
    x
}
