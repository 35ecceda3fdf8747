//! The neighbour list the pair loops walk: slices of particles side by side, one lane each.

use super::{NeighbourSearch, sorted_candidates};
use crate::lanes::{InstructionSet, Lanes, Work, dispatch};
use crate::parallel;
use crate::real::Real;
use crate::space::Vector;
use core::marker::PhantomData;
use core::ops::Range;

/// Particles in one part of the list; parts are built side by side.
const PART: usize = 4096;

/// For each slice of `SLICE` consecutive particles, rows of `SLICE` neighbour indices: row `r` holds
/// the `r`-th neighbour of each, ascending per particle. Short columns end in the dummy index.
#[derive(Clone, Debug)]
pub(crate) struct SlicedList<T, const D: usize> {
    parts: Vec<Part>,
    particles: usize,
    others: usize,
    precision: PhantomData<T>,
}

#[derive(Clone, Debug, Default)]
struct Part {
    /// Where each slice of the part begins in `rows`, and the end.
    starts: Vec<usize>,
    rows: Vec<u32>,
}

impl<T: Real, const D: usize> Default for SlicedList<T, D> {
    fn default() -> Self {
        Self { parts: Vec::new(), particles: 0, others: 0, precision: PhantomData }
    }
}

impl<T: Real, const D: usize> SlicedList<T, D> {
    /// Lists, for each of the first `particles` points, the other points at `r < radius`; particle
    /// `i` sees those in `allowed(i)`. The dummy index is `points.len()`.
    #[expect(clippy::too_many_arguments, reason = "one caller, and nothing in it belongs together")]
    pub(crate) fn build(
        &mut self,
        search: &dyn NeighbourSearch<T, D>,
        points: &[Vector<T, D>],
        particles: usize,
        radius: T,
        walls: usize,
        allowed: &[Vec<Range<u32>>; 2],
        set: InstructionSet,
    ) {
        assert!(particles <= points.len() && points.len() <= i32::MAX as usize);
        for window in allowed.iter().flatten() {
            assert!(window.end as usize <= points.len());
        }
        // A search is foreign code and may panic: the list is empty until it is complete.
        (self.particles, self.others) = (0, 0);
        // Lanes may read past the last point; what they find there is masked.
        let coordinates: [Vec<T>; D] = core::array::from_fn(|axis| {
            let padding = core::iter::repeat_n(T::ZERO, T::SLICE);
            points.iter().map(|x| x[axis]).chain(padding).collect()
        });
        self.parts.resize_with(particles.div_ceil(PART), Part::default);
        parallel::for_each_part(&mut self.parts, 1, 1, &|first, part: &mut [Part]| {
            let build = Build {
                search,
                points,
                coordinates: &coordinates,
                particles: first * PART..(first * PART + PART).min(particles),
                radius2: radius * radius,
                walls,
                allowed,
                part: &mut part[0],
            };
            dispatch(set, build);
        });
        (self.particles, self.others) = (particles, points.len());
    }

    /// How many particles have rows.
    pub(crate) fn particles(&self) -> usize {
        self.particles
    }

    /// How many points a row may name; the dummy index is this number.
    pub(crate) fn others(&self) -> usize {
        self.others
    }

    /// The rows of slice `s`, `SLICE` indices each, every one at most `others()`.
    #[inline(always)]
    pub(crate) fn rows(&self, s: usize) -> &[u32] {
        const { assert!(PART.is_multiple_of(T::SLICE)) };
        let per_part = PART / T::SLICE;
        let part = &self.parts[s / per_part];
        let slice = s % per_part;
        &part.rows[part.starts[slice]..part.starts[slice + 1]]
    }

    /// The listed neighbours of particle `i`, ascending.
    pub(crate) fn of(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        let dummy = self.others;
        self.rows(i / T::SLICE)
            .iter()
            .skip(i % T::SLICE)
            .step_by(T::SLICE)
            .map(|&j| j as usize)
            .take_while(move |&j| j < dummy)
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        self.parts.iter().map(|p| 4 * p.rows.capacity() + 8 * p.starts.capacity()).sum()
    }
}

/// The building of one part.
struct Build<'a, T, const D: usize> {
    search: &'a dyn NeighbourSearch<T, D>,
    points: &'a [Vector<T, D>],
    /// The points axis by axis, and a slice of padding.
    coordinates: &'a [Vec<T>; D],
    particles: Range<usize>,
    radius2: T,
    walls: usize,
    allowed: &'a [Vec<Range<u32>>; 2],
    part: &'a mut Part,
}

impl<T: Real, const D: usize> Work<T> for Build<'_, T, D> {
    type Out = ();
    #[inline(always)]
    fn run<L: Lanes<Scalar = T>>(self) {
        let (mut candidates, mut column) = (Candidates::default(), Vec::new());
        let mut rows = 0;
        self.part.starts.clear();
        self.part.rows.clear();
        for first in self.particles.clone().step_by(T::SLICE) {
            // As long as the slice before, which is nearly right.
            let begin = self.part.open::<T>(rows, self.points.len() as u32);
            rows = 0;
            for i in first..self.particles.end.min(first + T::SLICE) {
                candidates.find(&self, i);
                column.clear();
                for range in &candidates.ranges {
                    self.near::<L>(i as u32, range, &mut column);
                }
                self.part.put::<T>(begin, i - first, &column, self.points.len() as u32);
                rows = rows.max(column.len());
            }
            self.part.rows.truncate(begin + rows * T::SLICE);
        }
        self.part.starts.push(self.part.rows.len());
        // A vector that had to grow has doubled: room for an eighth more is enough.
        let length = self.part.rows.len();
        self.part.rows.shrink_to(length + length / 8);
    }
}

/// The candidates of a particle, and of those after it in the same cell.
#[derive(Default)]
struct Candidates {
    cell: Option<usize>,
    is_wall: bool,
    raw: Vec<Range<u32>>,
    ranges: Vec<Range<u32>>,
}

impl Candidates {
    #[inline(always)]
    fn find<T: Real, const D: usize>(&mut self, build: &Build<'_, T, D>, i: usize) {
        let (place, is_wall) = (&build.points[i], i < build.walls);
        let cell = build.search.cell(place);
        if cell.is_none() || cell != self.cell || is_wall != self.is_wall {
            let allowed = &build.allowed[usize::from(!is_wall)];
            sorted_candidates(build.search, place, allowed, &mut self.raw, &mut self.ranges);
            (self.cell, self.is_wall) = (cell, is_wall);
        }
    }
}

impl<T: Real, const D: usize> Build<'_, T, D> {
    /// Appends the indices `j ≠ i` in `range` with `|x_i − x_j|² < radius2`.
    #[inline(always)]
    fn near<L: Lanes<Scalar = T>>(&self, i: u32, range: &Range<u32>, column: &mut Vec<u32>) {
        let (limit, centre) = (L::splat(self.radius2), Vector::<L, D>::spread(&self.points[i as usize]));
        column.reserve((range.end - range.start) as usize + L::WIDTH);
        let mut count = column.len();
        let mut j = range.start;
        while j < range.end {
            // SAFETY: `sorted_candidates` clips the ranges to `allowed` and `build` has checked that
            // those end with the points, so j is a point; the coordinates go on for a slice more.
            let r2 = (centre - unsafe { self.places::<L>(j as usize) }).norm2();
            let within = (1u32 << (range.end - j).min(L::WIDTH as u32)) - 1;
            let other = !(1u32.checked_shl(i.wrapping_sub(j)).unwrap_or(0));
            // SAFETY: `reserve` made room for the whole range and one more set of lanes.
            count +=
                unsafe { L::compress(j, r2.less(limit) & within & other, column.as_mut_ptr().add(count)) };
            j += L::WIDTH as u32;
        }
        // SAFETY: `count` elements have been written.
        unsafe { column.set_len(count) };
    }

    /// The places of points `j..j + WIDTH`.
    ///
    /// # Safety
    /// `j` is a point, or at most `SLICE − WIDTH` beyond the last.
    #[inline(always)]
    unsafe fn places<L: Lanes<Scalar = T>>(&self, j: usize) -> Vector<L, D> {
        let mut x = Vector::zero();
        for k in 0..D {
            debug_assert!(j + L::WIDTH <= self.coordinates[k].len());
            // SAFETY: the caller's promise.
            x[k] = unsafe { L::load(self.coordinates[k].as_ptr().add(j)) };
        }
        x
    }
}

impl Part {
    /// Begins a slice of empty rows and returns where.
    #[inline(always)]
    fn open<T: Real>(&mut self, rows: usize, dummy: u32) -> usize {
        let begin = self.rows.len();
        self.starts.push(begin);
        self.rows.resize(begin + rows * T::SLICE, dummy);
        begin
    }

    /// Puts a column of neighbours into lane `lane` of the slice that begins at `begin` and is the
    /// last so far.
    #[inline(always)]
    fn put<T: Real>(&mut self, begin: usize, lane: usize, column: &[u32], dummy: u32) {
        let end = begin + column.len() * T::SLICE;
        if self.rows.len() < end {
            self.rows.resize(end, dummy);
        }
        for (row, j) in self.rows[begin..].chunks_exact_mut(T::SLICE).zip(column) {
            // SAFETY: a reference may be read. Volatile, because the compiler would otherwise read
            // several at once, which has to wait for the overlapping writes of `compress`.
            row[lane] = unsafe { core::ptr::from_ref(j).read_volatile() };
        }
    }
}
