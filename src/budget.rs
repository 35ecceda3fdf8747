//! The ledger: where mass, momentum and energy are, and who took what. All in double precision.

use crate::material::Loss;
use crate::real::Real;
use crate::space::Vector;
use core::ops::{Add, Index, IndexMut, Mul};

/// Something that adds energy to the particles or takes it away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Account {
    /// Artificial viscosity (59).
    ArtificialViscosity,
    /// Density diffusion (52), (54).
    DensityDiffusion,
    /// Deviatoric stress that is not stored: viscosity (14).
    Viscosity,
    /// Density reinitialisation (70).
    Reinitialisation,
    /// Moving walls.
    WallWork,
    /// Pressure and stress of extrapolated walls, which are given, not evolved.
    WallExtrapolation,
    /// Body forces without potential.
    External,
    /// What came in: gives its energy.
    Inflow,
    /// What left: takes its energy.
    Outflow,
    /// Drag between soil and water (37).
    Drag,
    /// Relaxation of the density to the volume sum.
    Relaxation,
    /// Artificial stress under tension.
    ArtificialStress,
    /// Regularisation of the soil's stress.
    Regularisation,
    /// Plastic flow.
    Plastic,
    /// Scaling stress back to the yield surface.
    ScaleBack,
    /// Cutting off tension.
    CutOff,
    /// Volume fractions of water put to their sums (68).
    VolumeFraction,
    /// Forces against motion of soil that its velocity gradient does not see.
    HourglassControl,
}

impl Account {
    /// All accounts, in the order of the ledger's columns.
    pub const ALL: [Self; 18] = [
        Self::ArtificialViscosity,
        Self::DensityDiffusion,
        Self::Viscosity,
        Self::Reinitialisation,
        Self::WallWork,
        Self::WallExtrapolation,
        Self::External,
        Self::Inflow,
        Self::Outflow,
        Self::Drag,
        Self::Relaxation,
        Self::ArtificialStress,
        Self::Regularisation,
        Self::Plastic,
        Self::ScaleBack,
        Self::CutOff,
        Self::VolumeFraction,
        Self::HourglassControl,
    ];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::ArtificialViscosity => "artificial_viscosity",
            Self::DensityDiffusion => "density_diffusion",
            Self::Viscosity => "viscosity",
            Self::Reinitialisation => "reinitialisation",
            Self::WallWork => "wall_work",
            Self::WallExtrapolation => "wall_extrapolation",
            Self::External => "external",
            Self::Inflow => "inflow",
            Self::Outflow => "outflow",
            Self::Drag => "drag",
            Self::Relaxation => "relaxation",
            Self::ArtificialStress => "artificial_stress",
            Self::Regularisation => "regularisation",
            Self::Plastic => "plastic",
            Self::ScaleBack => "scale_back",
            Self::CutOff => "cut_off",
            Self::VolumeFraction => "volume_fraction",
            Self::HourglassControl => "hourglass_control",
        }
    }
}

/// An amount for each [`Account`]: energy taken from the particles \[J\], or power \[W\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Works([f64; Account::ALL.len()]);

impl Works {
    /// Sum over all accounts.
    pub fn total(&self) -> f64 {
        self.0.iter().sum()
    }

    /// Books what a law loses over `volume` \[m³\] of a constituent itself.
    pub(crate) fn book<T: Real>(&mut self, loss: &Loss<T>, volume: T) {
        self[Account::Viscosity] += (volume * loss.viscous).as_f64();
        self[Account::Plastic] += (volume * loss.plastic).as_f64();
        self[Account::ScaleBack] += (volume * loss.scale_back).as_f64();
        self[Account::CutOff] += (volume * loss.cut_off).as_f64();
    }
}

impl Index<Account> for Works {
    type Output = f64;
    fn index(&self, account: Account) -> &f64 {
        &self.0[account as usize]
    }
}

impl IndexMut<Account> for Works {
    fn index_mut(&mut self, account: Account) -> &mut f64 {
        &mut self.0[account as usize]
    }
}

impl Add for Works {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        for (a, b) in self.0.iter_mut().zip(other.0) {
            *a += b;
        }
        self
    }
}

impl Mul<f64> for Works {
    type Output = Self;
    fn mul(mut self, factor: f64) -> Self {
        for a in &mut self.0 {
            *a *= factor;
        }
        self
    }
}

/// What has been exchanged with the particles, or is per time: energy and momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Exchange<const D: usize> {
    /// Energy taken \[J\], or power \[W\].
    pub taken: Works,
    /// Momentum given by gravity, body forces and walls \[kg m/s\], or force \[N\].
    pub impulse: Vector<f64, D>,
    /// Mass that came in, less what left \[kg\], or per time \[kg/s\].
    pub entered: f64,
    /// Work of the pores' pressure on soil that moves, buoyancy and seepage together \[J\], or its power \[W\]: it passes
    /// from the water to the soil, so that it is in no account.
    pub buoyancy: f64,
}

impl<const D: usize> Default for Exchange<D> {
    fn default() -> Self {
        Self { taken: Works::default(), impulse: Vector::zero(), entered: 0.0, buoyancy: 0.0 }
    }
}

impl<const D: usize> Add for Exchange<D> {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        self.taken = self.taken + other.taken;
        self.impulse += other.impulse;
        self.entered += other.entered;
        self.buoyancy += other.buoyancy;
        self
    }
}

impl<const D: usize> Mul<f64> for Exchange<D> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self {
            taken: self.taken * factor,
            impulse: self.impulse * factor,
            entered: self.entered * factor,
            buoyancy: self.buoyancy * factor,
        }
    }
}

/// Mass, momentum and energy at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget<const D: usize> {
    /// Time \[s\].
    pub time: f64,
    /// Mass of the particles, without walls \[kg\] (in 2D per metre of depth, as everything here).
    pub mass: f64,
    /// Momentum \[kg m/s\].
    pub momentum: [f64; D],
    /// Angular momentum about the origin, the components yz, zx, xy \[kg m²/s\].
    pub angular_momentum: [f64; 3],
    /// Kinetic energy \[J\].
    pub kinetic: f64,
    /// Potential energy in gravity and other potentials, zero at the origin \[J\].
    pub potential: f64,
    /// Energy stored by compression of the water, that of evolving walls included \[J\].
    pub compressive: f64,
    /// Energy stored by the soil's skeleton, that of evolving walls included \[J\].
    pub elastic: f64,
    /// What each account has taken since the start \[J\]; negative if it gave.
    pub taken: Works,
    /// Momentum that gravity, body forces and walls have given since the start, and what came in less what
    /// left \[kg m/s\].
    pub impulse: [f64; D],
    /// Mass that came in since the start, less what left \[kg\].
    pub entered: f64,
    /// Work of the pores' pressure on the soil since the start \[J\], which the water did: in no account.
    pub buoyancy: f64,
}

impl<const D: usize> Budget<D> {
    /// Of nothing, at this time \[s\].
    pub(crate) fn empty(time: f64) -> Self {
        Self {
            time,
            mass: 0.0,
            momentum: [0.0; D],
            angular_momentum: [0.0; 3],
            kinetic: 0.0,
            potential: 0.0,
            compressive: 0.0,
            elastic: 0.0,
            taken: Works::default(),
            impulse: [0.0; D],
            entered: 0.0,
            buoyancy: 0.0,
        }
    }

    /// Kinetic, potential and stored energy \[J\].
    pub fn energy(&self) -> f64 {
        self.kinetic + self.potential + self.compressive + self.elastic
    }

    /// Energy that no account explains, since `start` \[J\]; zero up to the time integration's error.
    pub fn closure(&self, start: &Self) -> f64 {
        self.energy() + self.taken.total() - start.energy() - start.taken.total()
    }

    /// Mass that came from nowhere since `start` \[kg\]; zero up to rounding.
    pub fn mass_closure(&self, start: &Self) -> f64 {
        self.mass - self.entered - (start.mass - start.entered)
    }

    /// Momentum that no force explains, since `start` \[kg m/s\]; zero up to rounding.
    pub fn momentum_closure(&self, start: &Self) -> [f64; D] {
        core::array::from_fn(|k| self.momentum[k] - self.impulse[k] - (start.momentum[k] - start.impulse[k]))
    }
}
