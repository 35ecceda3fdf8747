//! Paths through the space of strain and stress.

use crate::error::ParameterError;
use crate::real::Real;
use crate::space::SymTensor;

/// What is held of one component along a leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control<T> {
    /// The strain grows by this \[-\], evenly; positive in extension.
    Strain(T),
    /// The stress goes to this \[Pa\], evenly; positive in tension.
    Stress(T),
    /// The stress stays what it is.
    Held,
}

/// A straight piece of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg<T> {
    /// For xx, yy, zz, xy, yz, xz, in axes that do not turn.
    pub controls: [Control<T>; 6],
    /// Angles \[rad\] it turns by, evenly: the integrals of [`Tensor::spin`](crate::Tensor::spin), xy,
    /// yz, xz.
    pub rotation: [T; 3],
    /// How long it takes \[s\].
    pub duration: T,
}

impl<T: Real> Leg<T> {
    /// Strain alone \[-\], within a second.
    pub fn strain(strain: SymTensor<T>) -> Self {
        Self::mixed(strain.0.map(Control::Strain))
    }

    /// Some components of strain, some of stress, within a second.
    pub fn mixed(controls: [Control<T>; 6]) -> Self {
        Self { controls, rotation: [T::ZERO; 3], duration: T::ONE }
    }

    /// The same, while it turns \[rad\].
    pub fn turning(mut self, rotation: [T; 3]) -> Self {
        self.rotation = rotation;
        self
    }

    /// The same within another time \[s\], which matters to a viscous law only.
    ///
    /// # Errors
    /// It is not positive and finite.
    pub fn lasting(mut self, duration: T) -> Result<Self, ParameterError> {
        if !(duration > T::ZERO && duration.is_finite()) {
            return Err(ParameterError::new("duration", duration, "a positive time [s]"));
        }
        self.duration = duration;
        Ok(self)
    }

    /// What the `k`-th of `count` increments has to do, begun at the stress `start` \[Pa\].
    pub(super) fn target(&self, start: &SymTensor<T>, count: usize, k: usize) -> Target<T> {
        let count = T::of(count as f64);
        let done = T::of(k as f64) / count;
        let mut components = [Aim::Strain(T::ZERO); 6];
        for (index, component) in components.iter_mut().enumerate() {
            let from = start.0[index];
            *component = match self.controls[index] {
                Control::Strain(strain) => Aim::Strain(strain / count),
                Control::Stress(stress) => Aim::Stress(from + (stress - from) * done),
                Control::Held => Aim::Stress(from),
            };
        }
        Target { components, turn: self.rotation.map(|angle| angle / count), dt: self.duration / count }
    }
}

/// One component of an increment: its strain, or the stress at its end.
#[derive(Clone, Copy, Debug)]
pub(super) enum Aim<T> {
    Strain(T),
    Stress(T),
}

/// One increment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target<T> {
    pub(super) components: [Aim<T>; 6],
    pub(super) turn: [T; 3],
    pub(super) dt: T,
}

/// The tests of a soil laboratory, z axial, and two of mechanics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Equal normal strains; the amount is the volume lost \[-\].
    Isotropic,
    /// Axial strain alone; the amount is the shortening \[-\].
    Oedometer,
    /// Axial shortening under constant lateral stress.
    TriaxialCompression,
    /// Axial lengthening under constant lateral stress.
    TriaxialExtension,
    /// `v_x = γ̇ y`; the amount is γ \[-\]. It turns as it shears.
    SimpleShear,
    /// The same strain without turning.
    PureShear,
    /// Turning about z without strain; the amount is an angle \[rad\], positive from x towards y.
    Rotation,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Isotropic,
        Self::Oedometer,
        Self::TriaxialCompression,
        Self::TriaxialExtension,
        Self::SimpleShear,
        Self::PureShear,
        Self::Rotation,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Isotropic => "isotropic",
            Self::Oedometer => "oedometer",
            Self::TriaxialCompression => "triaxial-compression",
            Self::TriaxialExtension => "triaxial-extension",
            Self::SimpleShear => "simple-shear",
            Self::PureShear => "pure-shear",
            Self::Rotation => "rotation",
        }
    }

    /// The one of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// One way along it.
    fn leg<T: Real>(self, amount: T) -> Leg<T> {
        let (o, half, third) = (T::ZERO, T::of(0.5), T::of(1.0 / 3.0));
        let strain = |strain| Leg::strain(SymTensor(strain));
        let triaxial = |axial| {
            let (held, none) = (Control::Held, Control::Strain(o));
            Leg::mixed([held, held, Control::Strain(axial), none, none, none])
        };
        match self {
            Self::Isotropic => strain([-amount * third, -amount * third, -amount * third, o, o, o]),
            Self::Oedometer => strain([o, o, -amount, o, o, o]),
            Self::TriaxialCompression => triaxial(-amount),
            Self::TriaxialExtension => triaxial(amount),
            Self::SimpleShear => strain([o, o, o, amount * half, o, o]).turning([amount * half, o, o]),
            Self::PureShear => strain([o, o, o, amount * half, o, o]),
            Self::Rotation => strain([o; 6]).turning([-amount, o, o]),
        }
    }
}

/// A named path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path<T> {
    /// Which.
    pub kind: Kind,
    /// How far \[-\], or \[rad\]: see [`Kind`].
    pub amount: T,
    /// How often there, as far beyond the start, and back to it; 0 for one way only.
    pub cycles: usize,
}

impl<T: Real> Path<T> {
    /// One way.
    pub fn new(kind: Kind, amount: T) -> Self {
        Self { kind, amount, cycles: 0 }
    }

    /// There, as far the other way, and back, so many times.
    pub fn cyclic(mut self, cycles: usize) -> Self {
        self.cycles = cycles;
        self
    }

    /// Its straight pieces.
    pub fn legs(&self) -> Vec<Leg<T>> {
        let there = self.kind.leg(self.amount);
        if self.cycles == 0 {
            return vec![there];
        }
        let beyond = self.kind.leg(self.amount * T::of(-2.0));
        [there, beyond, there].repeat(self.cycles)
    }
}
