//! How particles get into a phase.

use super::fields::EvolvingFraction;
use super::phase::Phase;
use super::wall::Wall;
use crate::error::ParameterError;
use crate::material::Material;
use crate::real::Real;
use crate::space::{SymTensor, Vector};

impl<T: Real, const D: usize, M: Material<T>> Phase<T, D, M> {
    /// Adds particles at rest, each standing for `volume` \[m³, in 2D m²\], under the pressure
    /// `pressure(x)` \[Pa\]: density by (74), mass by (77).
    ///
    /// # Errors
    /// The volume is not positive, or a position or pressure is not finite.
    pub fn add(
        &mut self,
        positions: &[Vector<T, D>],
        volume: T,
        pressure: impl Fn(&Vector<T, D>) -> T,
    ) -> Result<(), ParameterError> {
        self.insert(self.len(), positions, 0, volume, &pressure)
    }

    /// Adds a wall of particles, filled with the same material under the same kind of pressure field.
    ///
    /// # Errors
    /// As for [`add`](Self::add).
    pub fn add_wall(
        &mut self,
        wall: Wall<T, D>,
        positions: &[Vector<T, D>],
        volume: T,
        pressure: impl Fn(&Vector<T, D>) -> T,
    ) -> Result<(), ParameterError> {
        let body = self.walls.len() as u16;
        self.insert(self.wall_particles, positions, body, volume, &pressure)?;
        for i in self.wall_particles..self.wall_particles + positions.len() {
            self.now.velocity[i] = wall.velocity(&self.position[i], 0.0);
            self.half.velocity[i] = self.now.velocity[i];
        }
        self.wall_particles += positions.len();
        self.wall_acceleration.resize(self.wall_particles, Vector::zero());
        self.walls.push(wall);
        Ok(())
    }

    fn insert(
        &mut self,
        at: usize,
        positions: &[Vector<T, D>],
        body: u16,
        volume: T,
        pressure: &dyn Fn(&Vector<T, D>) -> T,
    ) -> Result<(), ParameterError> {
        if !(volume > T::ZERO && volume.is_finite()) {
            return Err(ParameterError::new("volume", volume, "a positive volume [m^D]"));
        }
        for x in positions {
            if !x.is_finite() {
                return Err(ParameterError::new("position", format!("{:?}", x.0), "finite [m]"));
            }
            let p = pressure(x);
            if !p.is_finite() {
                return Err(ParameterError::new("pressure", p, "finite [Pa]"));
            }
        }
        self.placed = true;
        let first_id = self.next_id;
        self.next_id += positions.len() as u32;
        let excess = |x: &Vector<T, D>| self.material.compression(pressure(x));
        let reference = self.material.reference_density();
        let new_excess: Vec<T> = positions.iter().map(excess).collect(); // (74)
        let mass = new_excess.iter().map(|&e| reference * (T::ONE + e) * volume); // (77)
        let count = positions.len();
        splice(&mut self.id, at, first_id..first_id + count as u32);
        splice(&mut self.body, at, vec![body; count]);
        splice(&mut self.position, at, positions.iter().copied());
        splice(&mut self.mass, at, mass);
        splice(&mut self.volume_fraction, at, vec![T::ONE; count]);
        splice(&mut self.pressure, at, positions.iter().map(pressure));
        for fields in [&mut self.now, &mut self.half] {
            splice(&mut fields.velocity, at, vec![Vector::zero(); count]);
            splice(&mut fields.excess, at, new_excess.iter().copied());
            splice(&mut fields.memory, at, vec![M::Memory::default(); count]);
        }
        splice(&mut self.rate.acceleration, at, vec![Vector::zero(); count]);
        splice(&mut self.rate.excess, at, vec![T::ZERO; count]);
        splice(&mut self.rate.memory, at, vec![M::Memory::default(); count]);
        self.rate.excess_before.clear();
        Ok(())
    }

    /// Gives every particle that is not a wall the velocity `velocity(x)` \[m/s\].
    pub fn set_velocity(&mut self, velocity: impl Fn(&Vector<T, D>) -> Vector<T, D>) {
        for i in self.wall_particles..self.len() {
            self.now.velocity[i] = velocity(&self.position[i]);
            self.half.velocity[i] = self.now.velocity[i];
        }
    }

    /// Adds `change(x)` \[m/s\] to the velocity of every particle that is not a wall, at any time of a
    /// run.
    pub fn add_velocity(&mut self, change: impl Fn(&Vector<T, D>) -> Vector<T, D>) {
        for i in self.wall_particles..self.len() {
            let change = change(&self.position[i]);
            self.now.velocity[i] += change;
            self.half.velocity[i] += change;
        }
    }

    /// Gives every particle, walls included, the stress `stress(x)` \[Pa\], positive in tension, if the law
    /// remembers stress.
    pub fn set_stress(&mut self, stress: impl Fn(&Vector<T, D>) -> SymTensor<T>) {
        for i in 0..self.len() {
            let memory = self.material.with_stress(self.now.memory[i], &stress(&self.position[i]));
            self.now.memory[i] = memory;
            self.half.memory[i] = memory;
        }
    }

    /// Gives every particle its volume fraction, which from now on evolves (69), at unchanged true density
    /// and with the mass that belongs to it.
    pub(super) fn share(&mut self, fractions: &[T]) {
        for (i, &fraction) in fractions.iter().enumerate() {
            self.set_one_volume_fraction(i, fraction);
        }
        self.evolving_fraction =
            Some(EvolvingFraction { half: self.volume_fraction.clone(), rate: vec![T::ZERO; self.len()] });
    }

    pub(super) fn set_one_volume_fraction(&mut self, i: usize, fraction: T) {
        let factor = fraction / self.volume_fraction[i];
        self.volume_fraction[i] = fraction;
        self.mass[i] *= factor;
        self.now.excess[i] *= factor;
        self.half.excess[i] *= factor;
    }

    /// Gives every particle the volume fraction `fraction(x)` \[-\] at unchanged true density, with
    /// the mass that belongs to it.
    pub fn set_volume_fraction(&mut self, fraction: impl Fn(&Vector<T, D>) -> T) {
        for i in 0..self.len() {
            self.set_one_volume_fraction(i, fraction(&self.position[i]));
        }
    }
}

fn splice<X>(array: &mut Vec<X>, at: usize, new: impl IntoIterator<Item = X>) {
    array.splice(at..at, new);
}
