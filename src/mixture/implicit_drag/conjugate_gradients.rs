//! Conjugate gradients on the Schur complement, with a preconditioner: its diagonal, or a factor.

use super::bond::Bond;
use super::system::{System, Unsolved};
use crate::space::Vector;

/// Beyond this the iteration is lost.
const MOST_ITERATIONS: usize = 10_000;

/// Something near the inverse of the Schur complement, symmetric and positive definite.
pub(super) trait Precondition<const D: usize> {
    /// What it makes of a residual.
    fn apply(&self, residual: &[Vector<f64, D>], out: &mut [Vector<f64, D>]);
}

/// Solves `S x = sides` from the `x` given, until ‖r‖ is at most `allowed`. With an exact inverse as preconditioner
/// that is a direct solution and what refines it.
pub(super) fn solve<E: Bond<D>, const D: usize>(
    system: &System<'_, E, D>,
    precondition: &dyn Precondition<D>,
    sides: &[Vector<f64, D>],
    x: &mut [Vector<f64, D>],
    allowed: f64,
) -> Result<(), Unsolved> {
    let mut residual = sides.to_vec();
    let mut applied = vec![Vector::zero(); x.len()];
    system.complement(x, &mut applied);
    for (r, s) in residual.iter_mut().zip(&applied) {
        *r -= *s;
    }
    let mut direction = vec![Vector::zero(); x.len()];
    let mut steered = vec![Vector::zero(); x.len()];
    let mut before = f64::INFINITY;
    for iterations in 0.. {
        let size = system.norm(&residual);
        if size <= allowed {
            break;
        }
        if iterations == MOST_ITERATIONS || !size.is_finite() {
            return Err(Unsolved::Iteration { residual: size, allowed, iterations });
        }
        precondition.apply(&residual, &mut steered);
        let now: f64 = residual.iter().zip(&steered).map(|(r, z)| r.dot(*z)).sum();
        let kept = now / before;
        for (p, z) in direction.iter_mut().zip(&steered) {
            *p = *z + *p * kept;
        }
        let far = now / system.complement(&direction, &mut applied);
        for ((x, r), (p, s)) in x.iter_mut().zip(&mut residual).zip(direction.iter().zip(&applied)) {
            *x += *p * far;
            *r -= *s * far;
        }
        before = now;
    }
    Ok(())
}
