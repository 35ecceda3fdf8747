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
    coordinates: Vec<Vec<T>>,
    scalar: PhantomData<T>,
}

#[derive(Clone, Debug, Default)]
struct Part {
    /// Where each slice of the part begins in `rows`, and the end.
    starts: Vec<usize>,
    rows: Vec<u32>,
}

impl<T: Real, const D: usize> Default for SlicedList<T, D> {
    fn default() -> Self {
        Self {
            parts: Vec::new(),
            particles: 0,
            others: 0,
            coordinates: vec![Vec::new(); D],
            scalar: PhantomData,
        }
    }
}

impl<T: Real, const D: usize> SlicedList<T, D> {
    /// Lists, for each of the first `particles` points, the other points at `r < radius`; particle
    /// `i` sees those in `allowed(i)`. The dummy index is `points.len()`.
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
        assert!(particles <= points.len() && points.len() < u32::MAX as usize);
        self.particles = particles;
        self.others = points.len();
        for (axis, coordinates) in self.coordinates.iter_mut().enumerate() {
            coordinates.clear();
            coordinates.extend(points.iter().map(|x| x[axis]));
            // Lanes may read past the last point; what they find there is masked.
            coordinates.resize(points.len() + T::SLICE, T::ZERO);
        }
        self.parts.resize_with(particles.div_ceil(PART), Part::default);
        let coordinates = &self.coordinates;
        parallel::for_each_part(&mut self.parts, 1, 1, &|first, part: &mut [Part]| {
            let build = Build {
                search,
                points,
                coordinates,
                particles: first * PART..(first * PART + PART).min(particles),
                radius2: radius * radius,
                walls,
                allowed,
                part: &mut part[0],
            };
            dispatch(set, build);
        });
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
        const { assert!(PART % 16 == 0) };
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
        self.parts.iter().map(|p| 4 * p.rows.capacity() + 8 * p.starts.capacity()).sum::<usize>()
            + self.coordinates.iter().map(|c| c.capacity() * size_of::<T>()).sum::<usize>()
    }
}

/// The building of one part.
struct Build<'a, T, const D: usize> {
    search: &'a dyn NeighbourSearch<T, D>,
    points: &'a [Vector<T, D>],
    coordinates: &'a [Vec<T>],
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
        let dummy = self.points.len() as u32;
        let mut columns: Vec<Vec<u32>> = vec![Vec::new(); T::SLICE];
        let (mut raw, mut ranges) = (Vec::new(), Vec::new());
        self.part.starts.clear();
        self.part.rows.clear();
        for first in self.particles.clone().step_by(T::SLICE) {
            self.part.starts.push(self.part.rows.len());
            let mut longest = 0;
            for lane in 0..T::SLICE {
                let column = &mut columns[lane];
                column.clear();
                let i = first + lane;
                if i >= self.particles.end {
                    continue;
                }
                let allowed = &self.allowed[usize::from(i >= self.walls)];
                sorted_candidates(self.search, &self.points[i], allowed, &mut raw, &mut ranges);
                for range in &ranges {
                    near::<T, L, D>(&self.points[i], self.coordinates, self.radius2, range, i as u32, column);
                }
                longest = longest.max(column.len());
            }
            for row in 0..longest {
                for column in &columns {
                    self.part.rows.push(column.get(row).copied().unwrap_or(dummy));
                }
            }
        }
        self.part.starts.push(self.part.rows.len());
    }
}

/// Appends the indices `j ≠ i` in `range` with `|x − x_j|² < radius2`.
#[inline(always)]
fn near<T: Real, L: Lanes<Scalar = T>, const D: usize>(
    x: &Vector<T, D>,
    coordinates: &[Vec<T>],
    radius2: T,
    range: &Range<u32>,
    i: u32,
    column: &mut Vec<u32>,
) {
    let (limit, centre) = (L::splat(radius2), Vector::<L, D>::spread(x));
    let room = (range.end - range.start) as usize + L::WIDTH;
    column.reserve(room);
    let mut count = column.len();
    let mut j = range.start;
    while j < range.end {
        let mut r2 = L::lit(0.0);
        for k in 0..D {
            debug_assert!(j as usize + L::WIDTH <= coordinates[k].len());
            // SAFETY: j is below the number of points (ranges are clipped to it) and the
            // coordinates are padded by the widest lanes.
            let other = unsafe { L::load(coordinates[k].as_ptr().add(j as usize)) };
            let d = centre[k] - other;
            r2 += d * d;
        }
        let mut mask = r2.less(limit);
        let left = range.end - j;
        if (left as usize) < L::WIDTH {
            mask &= (1 << left) - 1;
        }
        if i >= j && i - j < L::WIDTH as u32 {
            mask &= !(1 << (i - j));
        }
        // SAFETY: `reserve` made room for the whole range and one more set of lanes.
        count += unsafe { L::compress(j, mask, column.as_mut_ptr().add(count)) };
        j += L::WIDTH as u32;
    }
    // SAFETY: `count` elements have been written.
    unsafe { column.set_len(count) };
}
