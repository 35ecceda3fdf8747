//! How far particles may move before their neighbours have to be found again.

use crate::parallel;
use crate::real::Real;
use crate::space::Vector;
use core::ops::Range;

/// Whether two of the particles, at `starts` when their neighbours were listed, may have approached
/// each other by more than `skin` \[m\], or one is not a number. `starts` may be longer.
pub(super) fn have_strayed<T: Real, const D: usize>(
    positions: &[Vector<T, D>],
    starts: &[Vector<T, D>],
    skin: T,
) -> bool {
    // Two particles, each within half the skin, have not approached by more than that. The second look
    // costs more, and is worth it: it makes lists last up to twice as long.
    !have_stayed(positions, starts, skin * T::of(0.5))
        && Spread::of(positions, starts).diagonal2() > almost_squared(skin)
}

/// Whether no particle is farther than `reach` \[m\] from where it was when it was listed.
pub(super) fn have_stayed<T: Real, const D: usize>(
    positions: &[Vector<T, D>],
    starts: &[Vector<T, D>],
    reach: T,
) -> bool {
    let limit = almost_squared(reach);
    let near = |range: Range<usize>| {
        let mut near = true;
        for (x, start) in positions[range.clone()].iter().zip(&starts[range]) {
            // Written so that NaN counts as far, and without a branch.
            near &= (*x - *start).norm2() <= limit;
        }
        near
    };
    parallel::reduce(positions.len(), true, near, |a, b| a && b)
}

/// A hair less than the square, so that rounding loses no pair.
fn almost_squared<T: Real>(x: T) -> T {
    x * x * T::of(0.998)
}

/// The box of all displacements: no two particles have approached by more than its diagonal. Where
/// all flow one way, past walls at rest, that is half of twice the largest displacement.
#[derive(Clone, Copy)]
struct Spread<T, const D: usize> {
    least: Vector<T, D>,
    most: Vector<T, D>,
    finite: bool,
}

impl<T: Real, const D: usize> Spread<T, D> {
    fn of(positions: &[Vector<T, D>], starts: &[Vector<T, D>]) -> Self {
        let none =
            Self { least: Vector::splat(T::INFINITY), most: Vector::splat(-T::INFINITY), finite: true };
        let spread = |range: Range<usize>| {
            let mut spread = none;
            for (x, start) in positions[range.clone()].iter().zip(&starts[range]) {
                let moved = *x - *start;
                spread = spread.joined(Self { least: moved, most: moved, finite: moved.is_finite() });
            }
            spread
        };
        parallel::reduce(positions.len(), none, spread, Self::joined)
    }

    #[inline(always)]
    fn joined(mut self, other: Self) -> Self {
        for k in 0..D {
            self.least[k] = self.least[k].min(other.least[k]);
            self.most[k] = self.most[k].max(other.most[k]);
        }
        self.finite &= other.finite;
        self
    }

    fn diagonal2(&self) -> T {
        if self.finite { (self.most - self.least).norm2() } else { T::INFINITY }
    }
}
