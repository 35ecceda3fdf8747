//! Reading a particle's record.

use crate::real::Num;
use crate::space::Vector;

/// A particle's record, in one or several lanes.
pub(crate) type Record<N> = [[N; 4]; 4];

/// Number `k` of a record.
#[inline(always)]
pub(crate) fn number<N: Copy>(record: &Record<N>, k: usize) -> N {
    record[k / 4][k % 4]
}

/// The vector that begins at number `k`.
#[inline(always)]
pub(crate) fn vector<N: Num, const D: usize>(record: &Record<N>, k: usize) -> Vector<N, D> {
    let mut x = Vector::zero();
    for axis in 0..D {
        x.0[axis] = number(record, k + axis);
    }
    x
}

/// The rows of the symmetric tensor whose upper triangle begins at number `k`.
#[inline(always)]
pub(crate) fn symmetric<N: Num, const D: usize>(record: &Record<N>, mut k: usize) -> [Vector<N, D>; D] {
    let mut rows = [Vector::zero(); D];
    for a in 0..D {
        for b in a..D {
            rows[a].0[b] = number(record, k);
            rows[b].0[a] = number(record, k);
            k += 1;
        }
    }
    rows
}

/// Adds a vector to the sums that begin at `k`.
#[inline(always)]
pub(crate) fn add_vector<N: Num, const D: usize>(sums: &mut [N], k: usize, x: Vector<N, D>) {
    for axis in 0..D {
        sums[k + axis] += x.0[axis];
    }
}
