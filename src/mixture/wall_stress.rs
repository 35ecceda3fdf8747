//! The stress of extrapolated walls that hold soil: the soil's own beside them, as far as it is
//! admissible and as far as the wall's friction can bear it.

use super::constituent::Constituent;
use super::wall::Slip;
use crate::material::Material;
use crate::real::Real;
use crate::space::{SymTensor, Tensor, Vector};

/// Slower than this part of what friction stops at once, μσ_n/(ρ̃₀ c), soil counts as held. Held soil that
/// moves loads its own stress with the step: faster, it would be stopped and let go in turns.
const HELD: f64 = 0.25;

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Gives wall particle `i` the stress beside it, at this pressure; returns whether the wall holds what
    /// moves along it with `slip_velocity`. `normal` points into the wall.
    pub(super) fn set_wall_stress(
        &mut self,
        i: usize,
        pressure: T,
        slip: Slip,
        normal: Vector<T, D>,
        slip_velocity: Vector<T, D>,
    ) -> bool {
        let material = self.phase.material();
        let stress = self.stress_beside_wall(i) - SymTensor::isotropic(pressure);
        // A pressure cut off by the wall, or extrapolated beyond the soil's, may not bear that shear.
        let (memory, _) = material.admit(material.with_stress(M::Memory::default(), &stress));
        let (pressure, deviator) =
            (material.pressure(T::ZERO, &memory), material.deviator(&Tensor::zero(), &memory));
        let friction = match slip {
            Slip::NoSlip => None,
            Slip::FreeSlip => Some(T::ZERO),
            Slip::Friction(coefficient) => Some(T::of(coefficient)),
        };
        let impedance = material.reference_density() * material.fastest_wave();
        self.phase.pressure[i] = pressure;
        self.phase.deviator[i] = deviator;
        let Some(friction) = friction else { return true };
        let traction = (deviator - SymTensor::isotropic(pressure)).dot(normal);
        let shear = traction - normal * traction.dot(normal);
        let along = slip_velocity - normal * slip_velocity.dot(normal);
        let bearable = friction * (-traction.dot(normal)).max(T::ZERO);
        let (borne, holds) = coulomb(shear, along, bearable, T::of(HELD) * bearable / impedance);
        self.phase.deviator[i] = deviator - symmetric_product(shear - borne, normal);
        holds
    }
}

/// Shear traction \[Pa\] on soil that slides `along` a wall \[m/s\] which bears at most `bearable` (Coulomb),
/// and whether the wall holds the soil: while it is slower than `held` and needs no more than that.
fn coulomb<T: Real, const D: usize>(
    shear: Vector<T, D>,
    along: Vector<T, D>,
    bearable: T,
    held: T,
) -> (Vector<T, D>, bool) {
    let (speed, size) = (along.norm(), shear.norm());
    if speed > held {
        (along * (-bearable / speed), false)
    } else if size > bearable {
        (shear * (bearable / size), false)
    } else {
        (shear, bearable > T::ZERO)
    }
}

/// `a⊗n + n⊗a`: of `a` across `n`, the stress whose traction on the plane of `n` is `a`.
fn symmetric_product<T: Real, const D: usize>(a: Vector<T, D>, n: Vector<T, D>) -> SymTensor<T> {
    let mut out = SymTensor::zero();
    for k in 0..D {
        for l in k..D {
            out.0[SymTensor::<T>::index(k, l)] = a[k] * n[l] + n[k] * a[l];
        }
    }
    out
}
