//! Conjugate gradients on the Schur complement, with its diagonal as preconditioner.

use super::system::{System, Unsolved};
use crate::space::Vector;

/// Beyond this the iteration is lost.
const MOST_ITERATIONS: usize = 10_000;

/// Solves `S x = sides` from the `x` given, until ‖r‖ is at most `allowed`.
pub(super) fn solve<const D: usize>(
    system: &System<'_, D>,
    sides: &[Vector<f64, D>],
    x: &mut [Vector<f64, D>],
    allowed: f64,
) -> Result<(), Unsolved> {
    let mut residual = sides.to_vec();
    let mut applied = vec![Vector::zero(); x.len()];
    system.apply(x, &mut applied);
    for (r, s) in residual.iter_mut().zip(&applied) {
        *r -= *s;
    }
    let mut direction = vec![Vector::zero(); x.len()];
    let mut before = f64::INFINITY;
    for iterations in 0.. {
        let size = system.norm(&residual);
        if size <= allowed {
            break;
        }
        if iterations == MOST_ITERATIONS || !size.is_finite() {
            return Err(Unsolved::Iteration { residual: size, allowed, iterations });
        }
        let now: f64 = residual.iter().zip(&system.diagonal).map(|(r, d)| r.norm2() / d).sum();
        let kept = now / before;
        for ((p, r), d) in direction.iter_mut().zip(&residual).zip(&system.diagonal) {
            *p = *r * (1.0 / d) + *p * kept;
        }
        let far = now / system.apply(&direction, &mut applied);
        for ((x, r), (p, s)) in x.iter_mut().zip(&mut residual).zip(direction.iter().zip(&applied)) {
            *x += *p * far;
            *r -= *s * far;
        }
        before = now;
    }
    Ok(())
}
