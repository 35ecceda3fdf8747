//! One formula of the kind the library sums, by brute force in scalars and through the list in all
//! lanes on one to three threads: the same bits.
#![expect(clippy::single_range_in_vec_init, reason = "windows of the list are ranges")]

use super::{Aligned, MOST, PairFormula, Sums, pair_sum};
use crate::kernel::{Kernel, WendlandC2};
use crate::lanes::InstructionSet;
use crate::neighbours::{BruteForce, CellList, Grid, NeighbourSearch, SlicedList};
use crate::parallel::Threads;
use crate::real::{Num, Real};
use crate::space::Vector;

/// Water of one phase: momentum with artificial viscosity, continuity, density diffusion, a power,
/// and the closest neighbour.
struct Water<T, const D: usize> {
    kernel: WendlandC2<T, D>,
    eta2: T,
    linear: T,
    quadratic: T,
    compression: T,
    gravity: Vector<T, D>,
}

#[derive(Clone, Copy)]
struct At<N, const D: usize> {
    x: Vector<N, D>,
    v: Vector<N, D>,
    volume: N,
    density: N,
    pressure: N,
    excess: N,
}

impl<T: Real, const D: usize> PairFormula<T> for Water<T, D> {
    const BLOCKS: usize = (2 * D + 4).div_ceil(4);
    const SUMS: usize = D + 4;
    type At<N: Num<Scalar = T>> = At<N, D>;

    #[inline(always)]
    fn read<N: Num<Scalar = T>>(record: &[[N; 4]; 4]) -> At<N, D> {
        let mut flat = [N::lit(0.0); MOST];
        for k in 0..MOST {
            flat[k] = record[k / 4][k % 4];
        }
        let (mut x, mut v) = (Vector::zero(), Vector::zero());
        for k in 0..D {
            x[k] = flat[k];
            v[k] = flat[D + k];
        }
        let (volume, density) = (flat[2 * D], flat[2 * D + 1]);
        At { x, v, volume, density, pressure: flat[2 * D + 2], excess: flat[2 * D + 3] }
    }

    #[inline(always)]
    fn start<N: Num<Scalar = T>>(&self) -> [N; MOST] {
        let mut sums = [N::lit(0.0); MOST];
        let support = N::splat(self.kernel.support());
        sums[D + 3] = support * support;
        sums
    }

    #[inline(always)]
    fn add_pair<N: Num<Scalar = T>>(&self, i: &At<N, D>, j: &At<N, D>, sums: &mut [N; MOST]) {
        let (x, v) = (i.x - j.x, i.v - j.v);
        let (r2, vx) = (x.norm2(), v.dot(x));
        let slope = self.kernel.slope(r2);
        let mass_slope = j.volume * j.density * slope;
        let density_sum = i.density + j.density;
        let inverse = N::lit(1.0) / ((r2 + N::splat(self.eta2)) * density_sum);
        let mu = vx.min(N::lit(0.0)) * inverse;
        let viscous = mu * (N::splat(self.linear) + N::splat(self.quadratic) * mu * density_sum);
        let push = x * ((i.pressure + j.pressure + viscous) * mass_slope);
        for k in 0..D {
            sums[k] -= push[k];
        }
        sums[D] += mass_slope * vx;
        let weight = Vector::spread(&self.gravity).dot(x);
        let hydrostatic = weight * (N::lit(1.0) - N::splat(self.compression) * (i.excess + j.excess));
        sums[D + 1] += j.volume * slope * (i.excess - j.excess - hydrostatic);
        sums[D + 2] += mass_slope * viscous * vx;
        sums[D + 3] = sums[D + 3].min(r2);
    }
}

/// Reproducible numbers in −½..½.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }
}

/// A jittered lattice of spacing 1, sorted by cell, and some stray points without neighbours.
fn cloud<T: Real, const D: usize>(counts: [usize; D], radius: f64, noise: &mut Noise) -> Vec<Vector<T, D>> {
    let n: usize = counts.iter().product();
    let mut points = Vec::new();
    for mut q in 0..n {
        let mut x = [0.0; D];
        for k in 0..D {
            x[k] = (q % counts[k]) as f64 + 0.6 * noise.next();
            q /= counts[k];
        }
        points.push(Vector::of(x));
    }
    points.push(Vector::of([-30.0; D]));
    points.push(Vector::of([counts[0] as f64 + 25.0; D]));
    let mut order = Vec::new();
    Grid::cover(&points, T::of(radius)).order(&points, 0..points.len(), &mut order);
    order.iter().map(|&i| points[i as usize]).collect()
}

fn records<T: Real, const D: usize>(points: &[Vector<T, D>], noise: &mut Noise) -> Aligned<T> {
    let stride = 4 * <Water<T, D> as PairFormula<T>>::BLOCKS;
    let mut records = Aligned::default();
    records.resize((points.len() + 1) * stride);
    for (i, record) in records.as_mut_slice().chunks_exact_mut(stride).enumerate() {
        record.fill(T::ZERO);
        for k in 0..D {
            // The dummy: far away, of no volume, finite throughout.
            record[k] = points.get(i).map_or(T::of(1e3), |x| x[k]);
            record[D + k] = T::of(noise.next());
        }
        record[2 * D] = T::of(if i < points.len() { 1.0 + 0.1 * noise.next() } else { 0.0 });
        for k in 1..4 {
            record[2 * D + k] = T::of(1.0 + 0.1 * noise.next());
        }
    }
    records
}

/// Every other point in ascending order, in scalars, without any list.
fn by_brute_force<T: Real, const D: usize>(water: &Water<T, D>, records: &[T]) -> Vec<u64> {
    let stride = 4 * <Water<T, D> as PairFormula<T>>::BLOCKS;
    let mut all = Vec::new();
    for record in records.chunks_exact(stride) {
        let mut blocks = [[T::ZERO; 4]; 4];
        for k in 0..stride {
            blocks[k / 4][k % 4] = record[k];
        }
        all.push(<Water<T, D> as PairFormula<T>>::read(&blocks));
    }
    all.pop();
    let mut bits = Vec::new();
    for i in 0..all.len() {
        let mut sums: [T; MOST] = water.start();
        for j in 0..all.len() {
            if j != i {
                water.add_pair(&all[i], &all[j], &mut sums);
            }
        }
        bits.extend(sums[..D + 4].iter().map(|x| x.bits()));
    }
    bits
}

fn bits_agree<T: Real, const D: usize>(counts: [usize; D], skin: f64) {
    let (mut noise, h) = (Noise(88_172_645_463_325_252), 1.1);
    let kernel = WendlandC2::<T, D>::new(T::of(h)).unwrap();
    let radius = kernel.support() + T::of(skin);
    let mut points = cloud::<T, D>(counts, radius.as_f64(), &mut noise);
    let listed = points.clone();
    for x in &mut points {
        for k in 0..D {
            // Half the skin is what a particle may move; rounding must not carry it further.
            x[k] += T::of(0.49 * skin / (D as f64).sqrt() * 2.0 * noise.next());
        }
    }
    let water = Water {
        kernel,
        eta2: T::of(0.01 * h * h),
        linear: T::of(0.3),
        quadratic: T::of(0.1),
        compression: T::of(0.05),
        gravity: Vector::of([0.5; D]),
    };
    let records = records(&points, &mut noise);
    let expected = by_brute_force(&water, records.as_slice());
    let mut search = CellList::default();
    search.rebuild(&listed, radius);
    let everything = [vec![0..listed.len() as u32], vec![0..listed.len() as u32]];
    for threads in 1..=3 {
        for name in InstructionSet::NAMES {
            let set = InstructionSet::at_most(name).unwrap();
            let (mut list, mut sums) = (SlicedList::default(), Sums::default());
            Threads::new(threads).unwrap().install(|| {
                list.build(&search, &listed, listed.len(), radius, 0, &everything, set);
                let nothing = core::iter::repeat(());
                pair_sum(
                    &water,
                    (&list, listed.len()),
                    records.as_slice(),
                    set,
                    &mut sums,
                    nothing,
                    &|_, ()| {},
                );
            });
            for (at, &bits) in expected.iter().enumerate() {
                let (i, k) = (at / (D + 4), at % (D + 4));
                assert_eq!(
                    sums.get(i, k).bits(),
                    bits,
                    "{} {D}D {name} {threads} threads: particle {i}, sum {k}",
                    T::NAME
                );
            }
        }
    }
}

#[test]
fn sums_are_the_same_bits_in_two_dimensions() {
    for skin in [0.0, 0.22] {
        bits_agree::<f32, 2>([60, 75], skin);
        bits_agree::<f64, 2>([60, 75], skin);
    }
}

#[test]
fn sums_are_the_same_bits_in_three_dimensions() {
    for skin in [0.0, 0.22] {
        bits_agree::<f32, 3>([16, 17, 16], skin);
        bits_agree::<f64, 3>([16, 17, 16], skin);
    }
}

/// Rows against all pairs: ascending, strictly inside, nobody their own neighbour, walls and the
/// others each in their own windows, the last slice ragged.
fn rows_agree<T: Real, const D: usize>(counts: [usize; D], search: &mut dyn NeighbourSearch<T, D>) {
    let mut noise = Noise(1_181_783_497_276_652_981);
    let radius = T::of(2.3);
    let points = cloud::<T, D>(counts, 2.3, &mut noise);
    let n = points.len() as u32;
    let (walls, particles) = (101, points.len() - 37);
    let allowed = [vec![101..n - 50], vec![0..n / 2, n / 2..n - 60, n - 40..n]];
    search.rebuild(&points, radius);
    for name in InstructionSet::NAMES {
        let set = InstructionSet::at_most(name).unwrap();
        let mut list = SlicedList::default();
        list.build(search, &points, particles, radius, walls, &allowed, set);
        assert_eq!((list.particles(), list.others()), (particles, points.len()));
        for i in 0..particles {
            let windows = &allowed[usize::from(i >= walls)];
            let near: Vec<usize> = (0..points.len())
                .filter(|&j| j != i && windows.iter().any(|w| w.contains(&(j as u32))))
                .filter(|&j| (points[i] - points[j]).norm2() < radius * radius)
                .collect();
            assert_eq!(list.of(i).collect::<Vec<_>>(), near, "{} {D}D {name}: {i}", T::NAME);
        }
        for s in 0..list.particles().div_ceil(T::SLICE) {
            let rows = list.rows(s);
            assert_eq!(rows.len() % T::SLICE, 0);
            assert!(rows.iter().all(|&j| j as usize <= list.others()));
        }
    }
}

#[test]
fn rows_hold_the_neighbours_and_nobody_else() {
    rows_agree::<f32, 2>([31, 33], &mut CellList::default());
    rows_agree::<f64, 3>([11, 10, 9], &mut CellList::default());
    rows_agree::<f64, 2>([31, 33], &mut BruteForce::default());
}

/// A search that stops working while a list is being built.
#[derive(Debug)]
struct Broken;

impl NeighbourSearch<f64, 2> for Broken {
    fn name(&self) -> &'static str {
        "broken"
    }
    fn rebuild(&mut self, _: &[Vector<f64, 2>], _: f64) {}
    fn candidates(&self, _: &Vector<f64, 2>, _: &mut Vec<core::ops::Range<u32>>) {
        panic!("on purpose")
    }
}

#[test]
fn a_list_whose_building_failed_is_empty() {
    let points = cloud::<f64, 2>([20, 20], 2.3, &mut Noise(7));
    let set = InstructionSet::detect();
    let n = points.len() as u32;
    let allowed = [vec![0..n], vec![0..n]];
    let mut search = CellList::default();
    search.rebuild(&points, 2.3);
    let mut list = SlicedList::default();
    list.build(&search, &points, points.len(), 2.3, 0, &allowed, set);
    let few = &points[..20];
    let failed = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        list.build(&Broken, few, few.len(), 2.3, 0, &[vec![0..20], vec![0..20]], set);
    }));
    assert!(failed.is_err());
    assert_eq!((list.particles(), list.others()), (0, 0));
}
