//! The loop over pairs, once for all formulas.
#![expect(clippy::needless_range_loop, reason = "plain loops keep the instruction set, see `lanes`")]

use crate::lanes::{InstructionSet, Lanes, Work, baseline, dispatch};
use crate::neighbours::SlicedList;
use crate::parallel;
use crate::real::{Num, Real};
use core::ops::Range;

/// Longest record and longest list of sums, in numbers.
pub(crate) const MOST: usize = 16;

/// What one particle contributes to another, and the sum of it: `sum_i = Σ_j f(i, j)`.
///
/// A formula knows no loop, no index and no lane. Everything in it is `#[inline(always)]` and free
/// of closures (see [`crate::lanes`]).
pub(crate) trait PairFormula<T: Real>: Sync {
    /// Length of a particle's record in blocks of four numbers.
    const BLOCKS: usize;
    /// How many sums a particle has.
    const SUMS: usize;
    /// Whether the sum is taken so seldom, or over so few particles, that the lanes every processor has
    /// will do: each further set of lanes is another copy to compile.
    const SELDOM: bool = false;
    /// What a record says about a particle.
    type At<N: Num<Scalar = T>>: Copy;
    /// Reads a record.
    fn read<N: Num<Scalar = T>>(record: &[[N; 4]; 4]) -> Self::At<N>;
    /// What the sums begin with; zero unless a formula looks for an extreme.
    #[inline(always)]
    fn start<N: Num<Scalar = T>>(&self) -> [N; MOST] {
        [N::lit(0.0); MOST]
    }
    /// Adds what `j` contributes to `i`.
    fn add_pair<N: Num<Scalar = T>>(&self, i: &Self::At<N>, j: &Self::At<N>, sums: &mut [N; MOST]);
}

/// Numbers aligned to a cache line: the packed records of all particles, ghosts and the dummy.
#[derive(Clone, Debug, Default)]
pub(crate) struct Aligned<T> {
    data: Vec<T>,
    offset: usize,
    len: usize,
}

impl<T: Real> Aligned<T> {
    /// Makes room for `len` numbers; their values are whatever was there.
    pub(crate) fn resize(&mut self, len: usize) {
        const LINE: usize = 64;
        let slack = LINE / size_of::<T>();
        if self.data.len() < len + slack {
            self.data.resize(len + slack, T::ZERO);
            self.offset = self.data.as_ptr().align_offset(LINE).min(slack);
        }
        self.len = len;
    }
    pub(crate) fn as_slice(&self) -> &[T] {
        &self.data[self.offset..self.offset + self.len]
    }
    pub(crate) fn as_mut_slice(&mut self) -> &mut [T] {
        &mut self.data[self.offset..self.offset + self.len]
    }
    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        self.data.capacity() * size_of::<T>()
    }
}

/// Slices in one chunk.
const SLICES: usize = 128;

/// The sums of all particles: chunk by chunk, sum by sum, particle by particle, so that who reads one of
/// them reads on in memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sums<T> {
    data: Vec<T>,
    count: usize,
}

impl<T: Real> Sums<T> {
    /// Particles of one chunk, a task of the pair loop.
    pub(crate) const CHUNK: usize = SLICES * T::SLICE;

    #[inline(always)]
    fn place(&self, i: usize, k: usize) -> usize {
        (i / Self::CHUNK * self.count + k) * Self::CHUNK + i % Self::CHUNK
    }
    /// Sum number `k` of particle `i`.
    #[inline(always)]
    pub(crate) fn get(&self, i: usize, k: usize) -> T {
        self.data[self.place(i, k)]
    }
    /// Replaces sum number `k` of particle `i`.
    pub(crate) fn set(&mut self, i: usize, k: usize, value: T) {
        let place = self.place(i, k);
        self.data[place] = value;
    }
    /// Sum number `k` of the particles of slice `s`.
    #[inline(always)]
    pub(crate) fn lanes(&self, s: usize, k: usize) -> &[T] {
        &self.data[self.place(s * T::SLICE, k)..][..T::SLICE]
    }
    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        self.data.capacity() * size_of::<T>()
    }
}

/// The sums of one chunk, just found.
pub(crate) struct ChunkSums<'a, T> {
    /// Number of its first particle.
    pub(crate) first: usize,
    data: &'a mut [T],
}

impl<T: Real> ChunkSums<'_, T> {
    /// Sum number `k` of its particles, and numbers that mean nothing behind the last particle of all.
    #[inline(always)]
    pub(crate) fn all(&self, k: usize) -> &[T] {
        &self.data[k * Sums::<T>::CHUNK..][..Sums::<T>::CHUNK]
    }
    /// The same, to be changed.
    pub(crate) fn all_mut(&mut self, k: usize) -> &mut [T] {
        &mut self.data[k * Sums::<T>::CHUNK..][..Sums::<T>::CHUNK]
    }
}

/// What is done with the sums of a chunk while they are in the cache, and with what belongs to it.
pub(crate) type Then<'a, T, X> = &'a (dyn Fn(&mut ChunkSums<'_, T>, &mut X) + Sync);

/// Evaluates `formula` for the first `particles` of the list, whole slices of them, and calls `then` for
/// each chunk with its part of `beside`, which has one for each.
///
/// # Panics
/// `records` is shorter than the list needs: every point and the dummy.
pub(crate) fn pair_sum<T: Real, F: PairFormula<T>, X: Send, const D: usize>(
    formula: &F,
    (list, particles): (&SlicedList<T, D>, usize),
    records: &[T],
    set: InstructionSet,
    sums: &mut Sums<T>,
    beside: impl Iterator<Item = X>,
    then: Then<T, X>,
) {
    const { assert!(F::BLOCKS <= 4 && F::SUMS <= MOST && T::SLICE <= 16) };
    assert!(records.len() >= (list.others() + 1) * 4 * F::BLOCKS);
    sums.count = F::SUMS;
    let slices = particles.min(list.particles()).div_ceil(T::SLICE);
    let length = F::SUMS * Sums::<T>::CHUNK;
    sums.data.resize(slices.div_ceil(SLICES) * length, T::ZERO);
    let mut chunks: Vec<_> = sums.data.chunks_mut(length).zip(beside).collect();
    parallel::for_each_part(&mut chunks, 1, 1, &|chunk, part: &mut [(&mut [T], X)]| {
        let (out, beside) = &mut part[0];
        let first = chunk * SLICES;
        let task = Task { formula, list, records, slices: first..slices.min(first + SLICES), out };
        if F::SELDOM {
            baseline(task);
        } else {
            dispatch(set, task);
        }
        then(&mut ChunkSums { first: first * T::SLICE, data: out }, beside);
    });
}

/// The sums of some slices of a chunk, into `out`, that of the chunk; the list has them all, and `records`
/// as many records as `pair_sum` asks for.
struct Task<'a, T, F, const D: usize> {
    formula: &'a F,
    list: &'a SlicedList<T, D>,
    records: &'a [T],
    slices: Range<usize>,
    out: &'a mut [T],
}

impl<T: Real, F: PairFormula<T>, const D: usize> Work<T> for Task<'_, T, F, D> {
    type Out = ();
    #[inline(always)]
    fn run<L: Lanes<Scalar = T>>(self) {
        for s in 0..self.slices.end - self.slices.start {
            let slice = self.slices.start + s;
            let rows = self.list.rows(slice);
            for lane in (0..T::SLICE).step_by(L::WIDTH) {
                let sums = self.sum::<L>(slice * T::SLICE + lane, lane, rows);
                for k in 0..F::SUMS {
                    let out = &mut self.out[k * Sums::<T>::CHUNK + s * T::SLICE + lane..][..L::WIDTH];
                    // SAFETY: `out` holds `WIDTH` numbers.
                    unsafe { sums[k].store(out.as_mut_ptr()) };
                }
            }
        }
    }
}

impl<T: Real, F: PairFormula<T>, const D: usize> Task<'_, T, F, D> {
    /// The sums of `WIDTH` particles from `first` on, whose columns begin at `lane` of the rows.
    #[inline(always)]
    fn sum<L: Lanes<Scalar = T>>(&self, first: usize, lane: usize, rows: &[u32]) -> [L; MOST] {
        let records = self.records.as_ptr();
        let mut own = [0; 16];
        for l in 0..L::WIDTH {
            // Lanes beyond the last particle add up nothing, whoever they are.
            own[l] = (first + l).min(self.list.others()) as u32;
        }
        let mut sums = self.formula.start();
        // SAFETY: `own` and, by the invariant of the list, the rows hold indices up to `others()`, and
        // `pair_sum` has checked that so many records are there. A row has `SLICE` indices, and
        // `lane + WIDTH` is at most that.
        unsafe {
            let i = F::read(&L::records(records, own.as_ptr(), F::BLOCKS));
            for row in rows.chunks_exact(T::SLICE) {
                let j = F::read(&L::records(records, row.as_ptr().add(lane), F::BLOCKS));
                self.formula.add_pair(&i, &j, &mut sums);
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests;
