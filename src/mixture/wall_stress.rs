//! The stress of extrapolated walls that hold soil: the soil's own beside them, as far as it is
//! admissible and as far as the wall's friction can bear it.

use super::constituent::Constituent;
use super::wall::Slip;
use crate::material::Material;
use crate::real::Real;
use crate::space::{SymTensor, Tensor, Vector};

impl<T: Real, const D: usize, M: Material<T>> Constituent<T, D, M> {
    /// Gives wall particle `i` the stress beside it, at this pressure; returns whether the wall holds what
    /// moves along it. `normal` points into the wall.
    pub(super) fn set_wall_stress(
        &mut self,
        i: usize,
        pressure: T,
        slip: Slip,
        normal: Vector<T, D>,
    ) -> bool {
        let material = self.phase.material();
        let stress = self.stress_beside_wall(i) - SymTensor::isotropic(pressure);
        // A pressure cut off by the wall, or extrapolated beyond the soil's, may not bear that shear.
        let (memory, _) = material.admit(material.with_stress(M::Memory::default(), &stress));
        let (pressure, deviator) =
            (material.pressure(T::ZERO, &memory), material.deviator(&Tensor::zero(), &memory));
        let stress = deviator - SymTensor::isotropic(pressure);
        let friction = match slip {
            Slip::NoSlip => T::INFINITY,
            Slip::FreeSlip => T::ZERO,
            Slip::Friction(coefficient) => T::of(coefficient),
        };
        let too_much = shear_beyond_friction(&stress, normal, friction);
        self.phase.pressure[i] = pressure;
        self.phase.deviator[i] = deviator - symmetric_product(too_much, normal);
        slip == Slip::NoSlip || friction > T::ZERO && too_much.norm2() <= T::ZERO
    }
}

/// The part of the shear traction on the plane with this normal that exceeds `friction` times the normal
/// pressure \[Pa\] (Coulomb).
fn shear_beyond_friction<T: Real, const D: usize>(
    stress: &SymTensor<T>,
    normal: Vector<T, D>,
    friction: T,
) -> Vector<T, D> {
    if friction == T::INFINITY {
        return Vector::zero();
    }
    let traction = stress.dot(normal);
    let along_normal = traction.dot(normal);
    let shear = traction - normal * along_normal;
    let (size, bearable) = (shear.norm(), friction * (-along_normal).max(T::ZERO));
    if size > bearable { shear * (T::ONE - bearable / size) } else { Vector::zero() }
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
