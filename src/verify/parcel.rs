//! Particles of an instant as plain numbers, for what is measured on soil and water together.

use crate::material::Material;
use crate::mixture::Phase;
use crate::real::Real;

/// One particle that is no wall's, in the plane x–y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parcel {
    /// Where it is \[m\].
    pub place: [f64; 2],
    /// Its velocity \[m/s\].
    pub velocity: [f64; 2],
    /// Volume m/ρ \[m²\] of mixture it stands for.
    pub volume: f64,
    /// Volume m/ρ̃₀ \[m²\] of its own matter at its reference density.
    pub matter: f64,
    /// Volume fraction φ \[-\].
    pub fraction: f64,
    /// Pressure \[Pa\].
    pub pressure: f64,
}

impl Parcel {
    /// All of a constituent, walls and what is held left out.
    pub fn of<T: Real, const D: usize, M: Material<T>>(phase: &Phase<T, D, M>) -> Vec<Self> {
        let parcel = |i: usize| {
            let (x, v) = (phase.positions()[i].as_f64(), phase.velocities()[i].as_f64());
            Self {
                place: [x[0], x[1]],
                velocity: [v[0], v[1]],
                volume: phase.volume(i).as_f64(),
                matter: phase.masses()[i].as_f64() / phase.material().reference_density().as_f64(),
                fraction: phase.volume_fraction(i).as_f64(),
                pressure: phase.pressures()[i].as_f64(),
            }
        };
        (phase.wall_particles()..phase.len()).map(parcel).collect()
    }

    /// Its speed \[m/s\].
    pub fn speed(&self) -> f64 {
        self.velocity[0].hypot(self.velocity[1])
    }
}
