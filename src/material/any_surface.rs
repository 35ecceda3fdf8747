//! A yield surface chosen while a program runs, such as that of a case file.

use super::yield_surface::{Flow, Returned, Unyielding, YieldSurface};
use super::{DruckerPrager, Elasticity, MohrCoulomb};
use crate::real::Real;
use crate::space::SymTensor;

/// One of the library's yield surfaces. It costs a branch per particle, and spares compiling a simulation
/// for each surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AnySurface<T> {
    /// A circular cone.
    DruckerPrager(DruckerPrager<T>),
    /// A six-sided pyramid.
    MohrCoulomb(MohrCoulomb<T>),
    /// None: the soil stays elastic.
    Unyielding,
}

impl<T: Real> YieldSurface<T> for AnySurface<T> {
    #[inline(always)]
    fn excess(&self, stress: &SymTensor<T>) -> T {
        match self {
            Self::DruckerPrager(cone) => cone.excess(stress),
            Self::MohrCoulomb(pyramid) => pyramid.excess(stress),
            Self::Unyielding => Unyielding.excess(stress),
        }
    }

    #[inline(always)]
    fn flow(&self, stress: &SymTensor<T>) -> Flow<T> {
        match self {
            Self::DruckerPrager(cone) => cone.flow(stress),
            Self::MohrCoulomb(pyramid) => pyramid.flow(stress),
            Self::Unyielding => Unyielding.flow(stress),
        }
    }

    fn largest_tension(&self) -> T {
        match self {
            Self::DruckerPrager(cone) => cone.largest_tension(),
            Self::MohrCoulomb(pyramid) => pyramid.largest_tension(),
            Self::Unyielding => Unyielding.largest_tension(),
        }
    }

    #[inline(always)]
    fn returned(&self, elasticity: &Elasticity<T>, trial: &SymTensor<T>) -> Returned<T> {
        match self {
            Self::DruckerPrager(cone) => cone.returned(elasticity, trial),
            Self::MohrCoulomb(pyramid) => pyramid.returned(elasticity, trial),
            Self::Unyielding => Returned::inside(*trial),
        }
    }

    #[inline(always)]
    fn scaled_back(&self, stress: &SymTensor<T>) -> Returned<T> {
        match self {
            Self::DruckerPrager(cone) => cone.scaled_back(stress),
            Self::MohrCoulomb(pyramid) => pyramid.scaled_back(stress),
            Self::Unyielding => Returned::inside(*stress),
        }
    }
}
