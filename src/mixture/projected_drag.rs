//! Drag along the line between the particles of a pair: it conserves angular momentum too.

use crate::kernel::Kernel;
use crate::real::{Num, Real};
use crate::space::Vector;
use crate::summation::{MOST, PairFormula, Record, add_vector, number, vector};

/// `Σ D V_j C W (v_ji·r̂) r̂`, then `Σ D V_j C W` and `Σ D V_j C W (v_ij·r̂)²`; record: x, v, V, C, with C zero of
/// soil. D makes up for the directions that are left out.
pub(super) struct ProjectedDrag<T, K, const D: usize> {
    kernel: K,
    nothing: T,
}

/// What is added to r² \[m²\] at a smoothing length `h` \[m\]: so small against h² that it only keeps pairs without distance, which have no line, from
/// being divided by nothing.
pub(super) fn nothing<T: Real>(h: T) -> T {
    T::of(1e-6) * h * h
}

#[derive(Clone, Copy)]
pub(super) struct Dragged<N: Copy, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    volume: N,
    drag: N,
}

impl<T: Real, K: Kernel<T, D>, const D: usize> PairFormula<T> for ProjectedDrag<T, K, D> {
    const BLOCKS: usize = (2 * D + 2).div_ceil(4);
    const SUMS: usize = D + 2;
    const SELDOM: bool = true;
    type At<N: Num<Scalar = T>> = Dragged<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &Record<N>) -> Dragged<N, D> {
        Dragged {
            x: vector(record, 0),
            v: vector(record, D),
            volume: number(record, 2 * D),
            drag: number(record, 2 * D + 1),
        }
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Dragged<N, D>, j: &Dragged<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (i.x - j.x, i.v - j.v);
        let r2 = x.norm2();
        let drag = j.volume * (i.drag + j.drag) * self.kernel.value(r2) * N::lit(D as f64);
        let away = v.dot(x);
        let along = away / (r2 + N::splat(self.nothing));
        add_vector(sums, 0, -(x * (along * drag)));
        sums[D] += drag;
        sums[D + 1] += drag * along * away;
    }
}

impl<T: Real, K: Kernel<T, D>, const D: usize> ProjectedDrag<T, K, D> {
    pub(super) fn new(kernel: &K) -> Self {
        Self { kernel: kernel.clone(), nothing: nothing(kernel.smoothing_length()) }
    }
}
