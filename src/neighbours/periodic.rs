//! Periodic directions and their ghosts.
//!
//! A ghost is a copy of a particle somebody else owns, seen at a shifted place. Its owner computes;
//! a ghost is only read. Today ghosts are periodic images; another machine's particles fit the same
//! description.

use crate::error::ParameterError;
use crate::real::Real;
use crate::space::Vector;

/// An image of particle `owner`, at its place plus `shift` \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ghost<T, const D: usize> {
    /// Whose image it is.
    pub owner: u32,
    /// From the owner to the image \[m\].
    pub shift: Vector<T, D>,
}

/// A box that repeats itself along some axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Periodic<T, const D: usize> {
    low: Vector<T, D>,
    length: [Option<T>; D],
}

impl<T: Real, const D: usize> Default for Periodic<T, D> {
    fn default() -> Self {
        Self::none()
    }
}

impl<T: Real, const D: usize> Periodic<T, D> {
    /// Nothing repeats.
    pub fn none() -> Self {
        Self { low: Vector::zero(), length: [None; D] }
    }

    /// Space repeats along axis `k` with period `length[k]` \[m\], from `low[k]` on.
    ///
    /// # Errors
    /// A period is not positive and finite, or `low` is not finite along its axis.
    pub fn new(low: Vector<T, D>, length: [Option<T>; D]) -> Result<Self, ParameterError> {
        for (k, period) in length.into_iter().enumerate() {
            let Some(period) = period else { continue };
            if !low[k].is_finite() {
                return Err(ParameterError::new("periodic low", low[k], "a finite place [m]"));
            }
            if !(period > T::ZERO && period.is_finite()) {
                return Err(ParameterError::new("periodic length", period, "a positive length [m]"));
            }
        }
        Ok(Self { low, length })
    }

    /// Whether any axis repeats.
    pub fn is_any(&self) -> bool {
        self.length.iter().any(Option::is_some)
    }

    /// The period along each axis \[m\].
    pub fn length(&self) -> &[Option<T>; D] {
        &self.length
    }

    /// The place inside the box that is the same as `x`: `low ≤ x < low + length`.
    pub fn wrap(&self, mut x: Vector<T, D>) -> Vector<T, D> {
        for k in 0..D {
            if let Some(length) = self.length[k] {
                let turns = ((x[k] - self.low[k]) / length).floor();
                x[k] -= turns * length;
                // Rounding may miss the box by a hair on either side: both are its low end.
                if x[k] < self.low[k] || x[k] >= self.low[k] + length {
                    x[k] = self.low[k];
                }
            }
        }
        x
    }

    /// The shortest way from `b` to `a` \[m\].
    pub fn difference(&self, a: Vector<T, D>, b: Vector<T, D>) -> Vector<T, D> {
        let mut x = a - b;
        for k in 0..D {
            if let Some(length) = self.length[k] {
                let turns = (x[k] / length + T::of(0.5)).floor();
                x[k] -= turns * length;
            }
        }
        x
    }

    /// All images within `margin` \[m\] outside the box of `points` inside it, by owner, then shift.
    ///
    /// A box narrower than the margin shows several images of each point; a margin that is not
    /// positive and finite shows none.
    pub fn ghosts(&self, points: &[Vector<T, D>], margin: T) -> Vec<Ghost<T, D>> {
        let mut ghosts = Vec::new();
        if !(self.is_any() && margin > T::ZERO && margin.is_finite()) {
            return ghosts;
        }
        // Boxes away that an image can come from; more than one only if the box is narrow.
        let reach: [i32; D] = core::array::from_fn(|k| {
            self.length[k].map_or(0, |length| ((margin / length).as_f64() as i32).saturating_add(1))
        });
        for (owner, x) in points.iter().enumerate().filter(|(_, x)| x.is_finite()) {
            let mut turn = reach.map(|turns| -turns);
            loop {
                if turn.iter().any(|&t| t != 0)
                    && let Some(shift) = self.shift(x, &turn, margin)
                {
                    ghosts.push(Ghost { owner: owner as u32, shift });
                }
                if !advance(&mut turn, &reach) {
                    break;
                }
            }
        }
        ghosts
    }

    /// From `x` to its image `turn` boxes away, if that is within `margin` of the box.
    fn shift(&self, x: &Vector<T, D>, turn: &[i32; D], margin: T) -> Option<Vector<T, D>> {
        let mut shift = Vector::zero();
        for k in 0..D {
            if let Some(length) = self.length[k] {
                shift[k] = T::of(f64::from(turn[k])) * length;
                let image = x[k] + shift[k];
                if image < self.low[k] - margin || image > self.low[k] + length + margin {
                    return None;
                }
            }
        }
        Some(shift)
    }
}

/// The next of all turns in `-reach..=reach`, the first axis fastest; false after the last.
fn advance<const D: usize>(turn: &mut [i32; D], reach: &[i32; D]) -> bool {
    for k in 0..D {
        turn[k] += 1;
        if turn[k] <= reach[k] {
            return true;
        }
        turn[k] = -reach[k];
    }
    false
}
