//! The stress of extrapolated walls that hold soil: the soil's own beside them, as far as it is admissible.

use super::constituent::Constituent;
use super::wall::Slip;
use super::wall_contact::Contact;
use crate::material::Material;
use crate::real::Real;
use crate::space::{SymTensor, Tensor, Vector};

/// Slower than this part of what friction stops at once, μσ_n/(ρ̃₀ c), soil counts as held. Held soil that
/// moves loads its own stress with the step: faster, it would be stopped and let go in turns.
const HELD: f64 = 0.25;

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Gives wall particle `i` the stress beside it, at this pressure; returns what it offers soil that
    /// glides along it with `slip_velocity`, none where it holds.
    pub(super) fn set_wall_stress(
        &mut self,
        i: usize,
        pressure: T,
        slip: Slip,
        slip_velocity: Vector<T, D>,
    ) -> Option<Contact<T, D>> {
        let material = self.phase.material();
        let stress = self.stress_beside_wall(i) - SymTensor::isotropic(pressure);
        // A pressure cut off by the wall, or extrapolated beyond the soil's, may not bear that shear.
        let (memory, _) = material.admit(material.with_stress(M::Memory::default(), &stress));
        let (pressure, deviator) =
            (material.pressure(T::ZERO, &memory), material.deviator(&Tensor::zero(), &memory));
        let impedance = material.reference_density() * material.fastest_wave();
        self.phase.pressure[i] = pressure;
        self.phase.deviator[i] = deviator;
        let coefficient = match slip {
            Slip::NoSlip => return None,
            Slip::FreeSlip => T::ZERO,
            Slip::Friction(coefficient) => T::of(coefficient),
        };
        let normal = self.scratch.wall_normal[i];
        let traction = (deviator - SymTensor::isotropic(pressure)).dot(normal);
        let pressing = (-traction.dot(normal)).max(T::ZERO);
        let shear = traction + normal * pressing;
        let along = slip_velocity - normal * slip_velocity.dot(normal);
        let held = T::of(HELD) * coefficient * pressing / impedance;
        let friction = coulomb(shear, along, coefficient, pressing, held)?;
        Some(Contact { normal, friction })
    }
}

/// Shear over normal traction \[-\] where soil slides `along` a wall \[m/s\], against it (Coulomb), which
/// the shear traction beside it shows where it is slower than `held`; none if it then needs no more than
/// the wall bears.
fn coulomb<T: Real, const D: usize>(
    shear: Vector<T, D>,
    along: Vector<T, D>,
    coefficient: T,
    pressing: T,
    held: T,
) -> Option<Vector<T, D>> {
    let (speed, size) = (along.norm(), shear.norm());
    if speed > held {
        Some(along * (coefficient / speed))
    } else if size > coefficient * pressing {
        Some(shear * -(coefficient / size))
    } else if pressing > T::ZERO && coefficient > T::ZERO {
        None
    } else {
        Some(Vector::zero())
    }
}
