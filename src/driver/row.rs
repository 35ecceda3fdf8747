//! One line of what a law answered.

use crate::material::{Loss, Memory};
use crate::real::Real;
use crate::space::SymTensor;

/// Where a piece of matter is on its path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<T, S> {
    /// Strain \[-\] since the start, the integral of the strain rate; positive in extension.
    pub strain: SymTensor<T>,
    /// Stress σ \[Pa\], positive in tension.
    pub stress: SymTensor<T>,
    /// Work done on it since the start \[J/m³\].
    pub work: T,
    /// Energy lost since the start \[J/m³\].
    pub lost: Loss<T>,
    /// What the law remembers.
    pub memory: S,
}

impl<T: Real, S: Memory<T>> Row<T, S> {
    /// Pressure p = −σ^γγ/3 \[Pa\], positive in compression.
    pub fn pressure(&self) -> T {
        self.stress.trace() * T::of(-1.0 / 3.0)
    }

    /// √J₂ \[Pa\].
    pub fn root_j2(&self) -> T {
        self.stress.root_j2()
    }

    /// q = √(3J₂) \[Pa\]: the difference of axial and lateral stress in a triaxial test.
    pub fn shear_stress(&self) -> T {
        self.root_j2() * T::of(3.0).sqrt()
    }

    /// What the numbers of a row are called, with their units.
    pub fn names() -> Vec<String> {
        let six = |name: &str, unit: &str| {
            ["xx", "yy", "zz", "xy", "yz", "xz"].map(|at| format!("{name}_{at} [{unit}]"))
        };
        let mut names = Vec::from(six("strain", "-"));
        names.extend(six("stress", "Pa"));
        names.extend(["pressure [Pa]", "root_j2 [Pa]", "work [J/m3]", "lost [J/m3]"].map(str::to_owned));
        for &(name, components) in S::SHOWN {
            match components {
                // The stress is already there.
                6 if name == "stress" => names.extend(six("remembered_stress", "Pa")),
                6 => names.extend(six(name, "-")),
                1 => names.push(name.to_owned()),
                _ => names.extend((0..components).map(|k| format!("{name}_{k}"))),
            }
        }
        names
    }

    /// Its numbers, in the order of [`names`](Self::names).
    pub fn numbers(&self) -> Vec<f64> {
        let mut numbers: Vec<f64> = self.strain.0.iter().chain(&self.stress.0).map(|x| x.as_f64()).collect();
        let others = [self.pressure(), self.root_j2(), self.work, self.lost.total()];
        numbers.extend(others.map(T::as_f64));
        self.memory.show(&mut numbers);
        numbers
    }
}
