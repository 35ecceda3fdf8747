//! The schemes that take drag through a step, stage by stage.

use super::system::Unsolved;
use crate::mixture::DragScheme;
use crate::space::Vector;

/// γ of SDIRK2.
const GAMMA: f64 = 1.0 - core::f64::consts::FRAC_1_SQRT_2;

/// What one implicit stage is solved with; arrays have the soil first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stage<'a, const D: usize> {
    /// Accelerations without drag \[m/s²\].
    pub(super) without: &'a [Vector<f64, D>],
    /// \[kg\].
    pub(super) masses: &'a [f64],
    /// How many particles of soil there are.
    pub(super) soil: usize,
    /// How many particles of soil and of water are held; they come first.
    pub(super) held: [usize; 2],
    /// Its length \[s\].
    pub(super) step: f64,
}

type Accelerations<const D: usize> = Result<Vec<Vector<f64, D>>, Unsolved>;

impl<'a, const D: usize> Stage<'a, D> {
    /// The effective accelerations over the whole step from `velocity`, by stages that `solve` solves; the
    /// first begins at the accelerations `begin` of the water. All stages are of one length.
    pub(super) fn through(
        self,
        scheme: DragScheme,
        velocity: &[Vector<f64, D>],
        begin: &[Vector<f64, D>],
        mut solve: impl FnMut(Self, &[Vector<f64, D>], &[Vector<f64, D>]) -> Accelerations<D>,
    ) -> Accelerations<D> {
        match scheme {
            DragScheme::Explicit => Ok(self.without.to_vec()),
            DragScheme::BackwardEuler => solve(self, velocity, begin),
            DragScheme::SecondOrder => {
                let stage = Self { step: GAMMA * self.step, ..self };
                let first = solve(stage, velocity, begin)?;
                let there = stage.moved(velocity, &first, (1.0 - GAMMA) * self.step);
                let second = solve(stage, &there, &first[self.soil..])?;
                Ok(first.iter().zip(&second).map(|(&k, &l)| k * (1.0 - GAMMA) + l * GAMMA).collect())
            }
        }
    }

    /// The velocities after `time` \[s\] of these accelerations; those of held particles are given.
    pub(super) fn moved(
        &self,
        velocity: &[Vector<f64, D>],
        accelerations: &[Vector<f64, D>],
        time: f64,
    ) -> Vec<Vector<f64, D>> {
        let both = velocity.iter().zip(accelerations).enumerate();
        both.map(|(i, (&v, &k))| if self.is_held(i) { v } else { v + k * time }).collect()
    }

    /// Whether particle `i` is held.
    pub(super) fn is_held(&self, i: usize) -> bool {
        match i.checked_sub(self.soil) {
            None => i < self.held[0],
            Some(a) => a < self.held[1],
        }
    }

    /// The size of accelerations that would undo or double the velocities of the stage.
    pub(super) fn scale(&self, velocity: &[Vector<f64, D>]) -> f64 {
        let (mut mass, mut moving, mut pushed) = (0.0, 0.0, 0.0);
        for ((m, v), a) in self.masses.iter().zip(velocity).zip(self.without) {
            mass += m;
            moving += m * v.norm2();
            pushed += m * a.norm2();
        }
        ((moving / mass).sqrt() / self.step) + (pushed / mass).sqrt()
    }
}
