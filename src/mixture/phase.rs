//! One constituent: its law and every per-particle array.

use super::fields::{EvolvingFraction, Fields, Rates};
use super::hourglass::ElasticHold;
use super::opening::Inflow;
use super::wall::{Wall, WallKind};
use crate::material::{Material, Memory};
use crate::real::{Num, Real};
use crate::space::{SymTensor, Vector};
use crate::time::Moment;

/// The smallest volume fraction of water that limits the step \[-\].
pub(crate) const LEAST_PORES: f64 = 0.01;

/// Particles of one constituent, wall particles first.
///
/// `density` is the partial density ρ = φρ̃, mass per volume of mixture; `true_density` is ρ̃.
#[derive(Clone, Debug)]
pub struct Phase<T: Real, const D: usize, M: Material<T>> {
    pub(super) material: M,
    pub(super) walls: Vec<Wall<T, D>>,
    pub(super) wall_particles: usize,
    pub(super) inflows: Vec<Inflow<T, D>>,
    /// The number the next particle gets.
    pub(super) next_id: u32,
    pub(crate) id: Vec<u32>,
    /// Which wall a wall particle belongs to; unused for others.
    pub(crate) body: Vec<u16>,
    pub(crate) position: Vec<Vector<T, D>>,
    /// Whether somebody has put particles somewhere since rates were looked at.
    pub(super) placed: bool,
    pub(crate) mass: Vec<T>,
    /// φ \[-\]; of rigid grains, that of the start.
    pub(crate) volume_fraction: Vec<T>,
    pub(crate) now: Fields<T, D, M::Memory>,
    pub(crate) half: Fields<T, D, M::Memory>,
    pub(crate) rate: Rates<T, D, M::Memory>,
    /// Of water that shares its space with soil.
    pub(crate) evolving_fraction: Option<EvolvingFraction<T>>,
    /// What holds soil against motion its velocity gradient does not see.
    pub(crate) hold: ElasticHold<T, D>,
    pub(crate) pressure: Vec<T>,
    /// τ \[Pa\]; empty while the law has none.
    pub(crate) deviator: Vec<SymTensor<T>>,
    /// Acceleration of each wall particle, zero where nothing moves \[m/s²\].
    pub(crate) wall_acceleration: Vec<Vector<T, D>>,
}

impl<T: Real, const D: usize, M: Material<T>> Phase<T, D, M> {
    /// No particle yet.
    pub fn new(material: M) -> Self {
        Self {
            material,
            walls: Vec::new(),
            wall_particles: 0,
            inflows: Vec::new(),
            next_id: 0,
            id: Vec::new(),
            body: Vec::new(),
            position: Vec::new(),
            placed: true,
            mass: Vec::new(),
            volume_fraction: Vec::new(),
            now: Fields::none(),
            half: Fields::none(),
            rate: Rates::none(),
            evolving_fraction: None,
            hold: ElasticHold::default(),
            pressure: Vec::new(),
            deviator: Vec::new(),
            wall_acceleration: Vec::new(),
        }
    }

    /// How many particles there are, walls included.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is no particle.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// How many wall particles there are; they come first.
    pub fn wall_particles(&self) -> usize {
        self.wall_particles
    }

    /// The walls.
    pub fn walls(&self) -> &[Wall<T, D>] {
        &self.walls
    }

    /// The law.
    pub fn material(&self) -> &M {
        &self.material
    }

    /// The number each particle was given when it was added; the arrays are re-sorted now and then.
    pub fn ids(&self) -> &[u32] {
        &self.id
    }

    /// Whether the fields of wall particle `i` evolve, as those of a dynamic wall do.
    #[inline(always)]
    pub(crate) fn is_evolving(&self, i: usize) -> bool {
        i >= self.wall_particles || self.wall_kind(i) == WallKind::Dynamic
    }

    /// Of which kind the wall of wall particle `i` is.
    #[inline(always)]
    pub(super) fn wall_kind(&self, i: usize) -> WallKind {
        self.walls[usize::from(self.body[i])].kind()
    }

    /// Whether particle `i` is of a wall that does not hold what moves along it.
    #[inline(always)]
    pub(crate) fn is_gliding(&self, i: usize) -> bool {
        i < self.wall_particles && self.wall_kind(i).is_gliding()
    }

    /// Whether any wall is such.
    pub(crate) fn has_gliding_walls(&self) -> bool {
        self.walls.iter().any(|wall| wall.kind().is_gliding())
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        let per_particle =
            4 + 2 + 4 * size_of::<Vector<T, D>>() + 6 * size_of::<T>() + 3 * size_of::<M::Memory>();
        self.position.capacity() * per_particle + self.deviator.capacity() * size_of::<SymTensor<T>>()
    }

    /// Which wall each of the first [`wall_particles`](Self::wall_particles) belongs to.
    pub fn bodies(&self) -> &[u16] {
        &self.body[..self.wall_particles]
    }

    /// Positions \[m\].
    pub fn positions(&self) -> &[Vector<T, D>] {
        &self.position
    }

    /// Positions \[m\], to change them from outside.
    pub fn positions_mut(&mut self) -> &mut [Vector<T, D>] {
        self.placed = true;
        &mut self.position
    }

    /// Velocities \[m/s\].
    pub fn velocities(&self) -> &[Vector<T, D>] {
        &self.now.velocity
    }

    /// Velocities \[m/s\], to change them before the start. In the middle of a run leap-frog goes on from
    /// the velocities of the half step: use [`add_velocity`](Self::add_velocity) there.
    pub fn velocities_mut(&mut self) -> &mut [Vector<T, D>] {
        &mut self.now.velocity
    }

    /// Masses \[kg, in 2D per metre of depth\].
    pub fn masses(&self) -> &[T] {
        &self.mass
    }

    /// Volume fraction φ \[-\] of particle `i`.
    #[inline(always)]
    pub fn volume_fraction(&self, i: usize) -> T {
        if M::RIGID_GRAINS { self.volume_fraction[i] + self.now.excess[i] } else { self.volume_fraction[i] }
    }

    /// The smallest volume fraction \[-\], but no less than [`LEAST_PORES`]: a particle that has hardly any would stop
    /// the run.
    pub(super) fn least_fraction(&self) -> T {
        self.volume_fraction.iter().copied().fold(T::ONE, Num::min).max(T::of(LEAST_PORES))
    }

    /// Pressures p \[Pa\] at the last evaluation, positive in compression.
    pub fn pressures(&self) -> &[T] {
        &self.pressure
    }

    /// Accelerations \[m/s²\] at the last evaluation; for wall particles, what they resisted.
    pub fn accelerations(&self) -> &[Vector<T, D>] {
        &self.rate.acceleration
    }

    /// Rate of the partial density dρ/dt \[kg/m³/s\] of particle `i` at the last evaluation; what
    /// an extrapolated wall does not follow.
    pub fn density_rate(&self, i: usize) -> T {
        self.material.reference_density() * (self.rate.excess[i] + self.fraction_rate(i))
    }

    /// Deviatoric stress τ \[Pa\] of particle `i` at the last evaluation, positive in tension.
    pub fn deviator(&self, i: usize) -> SymTensor<T> {
        self.deviator.get(i).copied().unwrap_or_default()
    }

    /// Row `a` of the deviatoric stress \[Pa\], as far as it lies in the particles' space.
    pub(super) fn deviator_row(&self, i: usize, a: usize) -> Vector<T, D> {
        let tau = self.deviator(i);
        Vector(core::array::from_fn(|b| tau.0[SymTensor::<T>::index(a, b)]))
    }

    /// Stress σ = −p I + τ \[Pa\] of particle `i` at the last evaluation, positive in tension.
    pub fn stress(&self, i: usize) -> SymTensor<T> {
        self.deviator(i) - SymTensor::isotropic(self.pressure[i])
    }

    /// What the law remembers of particle `i`.
    pub fn memory(&self, i: usize) -> &M::Memory {
        &self.now.memory[i]
    }

    /// How fast what the law remembers of particle `i` changes, at the last evaluation and before it is
    /// made admissible.
    pub fn memory_rate(&self, i: usize) -> &M::Memory {
        &self.rate.memory[i]
    }

    /// Dφ/Dt \[1/s\] of particle `i` at the last evaluation: zero unless it shares its space (69).
    #[inline(always)]
    pub fn fraction_rate(&self, i: usize) -> T {
        self.evolving_fraction.as_ref().map_or(T::ZERO, |fraction| fraction.rate[i])
    }

    /// Compression ρ̃/ρ̃₀ − 1 \[-\] of particle `i`.
    #[inline(always)]
    pub fn compression(&self, i: usize) -> T {
        if M::RIGID_GRAINS { T::ZERO } else { self.now.excess[i] / self.volume_fraction[i] }
    }

    /// The same at either instant.
    pub(super) fn compression_at(&self, i: usize, moment: Moment) -> T {
        match (moment, &self.evolving_fraction) {
            _ if M::RIGID_GRAINS => T::ZERO,
            (Moment::Half, Some(fraction)) => self.half.excess[i] / fraction.half[i],
            _ => self.fields(moment).excess[i] / self.volume_fraction[i],
        }
    }

    /// Partial density ρ \[kg/m³\] of particle `i`.
    #[inline(always)]
    pub fn density(&self, i: usize) -> T {
        self.material.reference_density() * (self.volume_fraction[i] + self.now.excess[i])
    }

    /// True density ρ̃ \[kg/m³\] of particle `i`.
    pub fn true_density(&self, i: usize) -> T {
        self.material.reference_density() * (T::ONE + self.compression(i))
    }

    /// Volume m/ρ \[m³, in 2D m²\] of particle `i`: the space of mixture it stands for.
    #[inline(always)]
    pub fn volume(&self, i: usize) -> T {
        self.mass[i] / self.density(i)
    }

    /// Volume m/ρ̃₀ \[m³, in 2D m²\] of the matter of particle `i` itself at its reference density; of rigid
    /// grains w = Vφ, the space they fill.
    #[inline(always)]
    pub(crate) fn matter(&self, i: usize) -> T {
        self.mass[i] / self.material.reference_density()
    }

    /// Whether particle `i` is of a wall of soil that takes no space from the water.
    #[inline(always)]
    pub(super) fn is_apart(&self, i: usize) -> bool {
        i < self.wall_particles && self.walls[usize::from(self.body[i])].is_apart()
    }

    /// Space \[m³, in 2D m²\] that particle `i` of soil takes from the water, w = Vφ.
    #[inline(always)]
    pub(super) fn grains(&self, i: usize) -> T {
        if self.is_apart(i) { T::ZERO } else { self.matter(i) }
    }

    /// Changes the excess of particle `i` at both instants, keeping its mass.
    pub(crate) fn shift_excess(&mut self, i: usize, by: T) {
        self.now.excess[i] += by;
        self.half.excess[i] += by;
    }

    /// Force of this phase on wall number `body` \[N, in 2D N/m\], from the last evaluation.
    pub fn wall_force(&self, body: usize) -> [f64; D] {
        let mut force = [0.0; D];
        for i in (0..self.wall_particles).filter(|&i| usize::from(self.body[i]) == body) {
            for (k, f) in force.iter_mut().enumerate() {
                *f += self.mass[i].as_f64() * self.rate.acceleration[i][k].as_f64();
            }
        }
        force
    }

    pub(crate) fn fields(&self, moment: Moment) -> &Fields<T, D, M::Memory> {
        match moment {
            Moment::Now => &self.now,
            Moment::Half => &self.half,
        }
    }

    pub(crate) fn fields_mut(&mut self, moment: Moment) -> &mut Fields<T, D, M::Memory> {
        match moment {
            Moment::Now => &mut self.now,
            Moment::Half => &mut self.half,
        }
    }

    /// Whether every number an integrator advances is finite, for particle `i`: else the field's name.
    pub(crate) fn bad_field(&self, i: usize) -> Option<&'static str> {
        if !self.position[i].is_finite() {
            Some("position")
        } else if !self.now.velocity[i].is_finite() {
            Some("velocity")
        } else if !self.now.excess[i].is_finite() {
            Some("density")
        } else if !self.now.memory[i].is_finite() {
            Some("memory")
        } else {
            None
        }
    }
}
