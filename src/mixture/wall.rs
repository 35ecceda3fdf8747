//! Walls of particles: dynamic (the paper's) and extrapolated (Adami, Hu & Adams 2012).

use crate::real::Real;
use crate::space::Vector;
use core::fmt;
use std::sync::Arc;

/// How material moves along an extrapolated wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Slip {
    /// It sticks: viscosity sees the mirrored velocity `2v_w − ⟨v⟩`.
    #[default]
    NoSlip,
    /// It glides: viscosity sees a wall that moves along, without shear stress, and artificial
    /// viscosity does not see the wall.
    FreeSlip,
    /// Soil sticks until the shear stress reaches the coefficient μ \[-\] times the normal one (Coulomb),
    /// and glides along under that stress; water glides.
    Friction(f64),
}

/// Where the fields of wall particles come from.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum WallKind {
    /// They evolve like those of any particle, except position and velocity (the paper's).
    Dynamic,
    /// Pressure and velocity are extrapolated from the fluid beside them.
    Extrapolated {
        /// Whether the fluid sticks.
        slip: Slip,
        /// Whether the wall may pull: keeps negative extrapolated pressure. A wall that cannot pull
        /// lets the fluid go, as a free surface flow needs.
        suction: bool,
    },
    /// Density and velocity are given, as they are of what has not come in yet (see
    /// [`Phase::add_inflow`](super::Phase::add_inflow)).
    Given,
}

impl WallKind {
    /// Whether it does not hold what moves along it.
    pub(super) fn is_gliding(self) -> bool {
        matches!(self, Self::Extrapolated { slip: Slip::FreeSlip | Slip::Friction(_), .. })
    }
}

type Motion<T, const D: usize> = Arc<dyn Fn(&Vector<T, D>, f64) -> Vector<T, D> + Send + Sync>;

/// A wall: its kind and, if it moves, how.
#[derive(Clone)]
pub struct Wall<T, const D: usize> {
    kind: WallKind,
    motion: Option<Motion<T, D>>,
    apart: bool,
}

impl<T, const D: usize> fmt::Debug for Wall<T, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Wall").field("kind", &self.kind).field("moves", &self.motion.is_some()).finish()
    }
}

impl<T: Real, const D: usize> Wall<T, D> {
    /// A fixed wall.
    pub fn new(kind: WallKind) -> Self {
        Self { kind, motion: None, apart: false }
    }

    /// The paper's wall: particles that evolve but stay.
    pub fn dynamic() -> Self {
        Self::new(WallKind::Dynamic)
    }

    /// A fixed extrapolated wall that cannot pull.
    pub fn extrapolated(slip: Slip) -> Self {
        Self::new(WallKind::Extrapolated { slip, suction: false })
    }

    /// The same wall, moving with the velocity `velocity(x, t)` \[m/s\] of a place x \[m\] on it at
    /// time t \[s\].
    pub fn moving(
        mut self,
        velocity: impl Fn(&Vector<T, D>, f64) -> Vector<T, D> + Send + Sync + 'static,
    ) -> Self {
        self.motion = Some(Arc::new(velocity));
        self
    }

    /// The same wall of soil, which takes no space from the water: where there is no soil beside it. Else
    /// the soil in a wall goes on as that beside it, and the water there has its share of the space only.
    pub fn apart(mut self) -> Self {
        self.apart = true;
        self
    }

    /// Whether it takes no space from the water.
    pub fn is_apart(&self) -> bool {
        self.apart
    }

    /// Its kind.
    pub fn kind(&self) -> WallKind {
        self.kind
    }

    /// Whether it moves.
    pub fn moves(&self) -> bool {
        self.motion.is_some()
    }

    /// Its velocity at place `x` \[m\] and time `t` \[s\].
    pub fn velocity(&self, x: &Vector<T, D>, t: f64) -> Vector<T, D> {
        self.motion.as_ref().map_or_else(Vector::zero, |motion| motion(x, t))
    }
}
