//! Clouds that are empty, undefined, coinciding, sparse, or sit on the boundaries of cells.

use super::{Cloud, Dice, cloud, compare, difference, oracle, periodic, searches};
use alluvium::neighbours::{CellList, NeighbourSearch, Pairs, Periodic};
use alluvium::{Real, Vector};
use proptest::prelude::*;
use std::ops::Range;

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    /// Many cells away from the origin, rounding of the cell number may not lose a pair just
    /// inside the radius.
    #[test]
    fn a_pair_just_inside_the_radius_is_found_far_from_the_corner(seed: u64, scale in 0.01..10.0) {
        just_inside::<f32>(seed, scale, 3e3);
        just_inside::<f64>(seed, scale, 1e4);
    }
}

fn just_inside<T: Real>(seed: u64, scale: f64, cells: f64) {
    let mut dice = Dice(seed);
    let radius: T = T::of(scale);
    let low: T = T::of(-scale * dice.roll());
    let mut points = vec![Vector([low, T::ZERO])];
    for _ in 0..1000 {
        // Near a cell boundary, so that its partner lies near the next but one; cells may be a hair
        // larger than the radius.
        let hair = 1.0 + (2.0 * dice.roll()).floor() * 16.0 * T::EPSILON.as_f64();
        let x: f64 = low.as_f64() + (cells * dice.roll()).floor() * hair * radius.as_f64();
        let x: T = T::of(x * (1.0 + 3.0 * (dice.roll() - 0.5) * T::EPSILON.as_f64()));
        let mut y: T = x + radius;
        while y - x >= radius {
            y -= y.abs() * T::EPSILON * T::of(0.5);
        }
        points.extend([Vector([x, T::ZERO]), Vector([y, T::ZERO])]);
    }
    // Enough points for cells of the size of the radius.
    points.resize(points.len() + cells as usize, points[0]);
    let mut search = CellList::default();
    search.rebuild(&points, radius);
    for pair in points[1..2001].chunks(2).enumerate() {
        let (mut ranges, i) = (Vec::new(), 1 + 2 * pair.0 as u32);
        search.candidates(&pair.1[0], &mut ranges);
        assert!(ranges.iter().any(|r| r.contains(&(i + 1))), "{} {:?} {radius}", T::NAME, pair.1);
        ranges.clear();
        search.candidates(&pair.1[1], &mut ranges);
        assert!(ranges.iter().any(|r| r.contains(&i)), "{} {:?} {radius}", T::NAME, pair.1);
    }
}

#[test]
fn empty_single_and_coinciding_points() {
    fn check<T: Real, const D: usize>() {
        for mut search in searches::<T, D>() {
            let mut find = |points: &[Vector<T, D>], radius: f64| {
                Pairs::find(&mut *search, points, T::of(radius), &Periodic::none()).count()
            };
            assert_eq!(find(&[], 1.0), 0);
            assert_eq!(find(&[Vector::splat(T::of(0.3))], 1.0), 0);
            assert_eq!(find(&[Vector::splat(T::of(0.3)); 500], 1.0), 500 * 499);
            assert_eq!(
                find(&[Vector::splat(T::of(0.3)); 500], 1e-30),
                if T::NAME == "f32" { 0 } else { 249_500 }
            );
            for radius in [0.0, -1.0, f64::NAN] {
                assert_eq!(find(&[Vector::zero(), Vector::splat(T::of(1e-3))], radius), 0, "radius {radius}");
            }
            assert_eq!(find(&[Vector::zero(), Vector::splat(T::of(1e3))], f64::INFINITY), 2);
        }
    }
    check::<f32, 2>();
    check::<f64, 2>();
    check::<f32, 3>();
    check::<f64, 3>();
}

#[test]
fn a_search_not_yet_built_proposes_nothing() {
    for search in searches::<f64, 2>() {
        let mut ranges = Vec::new();
        search.candidates(&Vector::zero(), &mut ranges);
        assert!(ranges.iter().all(Range::is_empty), "{}", search.name());
    }
}

#[test]
fn places_that_are_not_finite_have_no_neighbours() {
    fn check<T: Real, const D: usize>(axes: u8) {
        let (mut points, dx) = cloud::<T, D>(Cloud::Jittered, 200, 1);
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300];
        for (n, value) in bad.into_iter().enumerate() {
            points[7 * n + 3][n % D] = T::of(value);
        }
        let (radius, periodic) = (T::of(2.6 * dx), periodic(axes));
        let right = oracle(&points, radius, &periodic);
        assert!(right[3].is_empty() && right[10].is_empty() && right[17].is_empty());
        for mut search in searches() {
            assert_eq!(compare(&mut *search, &points, radius, &periodic, &right), None, "{} {D}D", T::NAME);
        }
    }
    check::<f32, 2>(0);
    check::<f64, 2>(0);
    check::<f32, 3>(0);
    check::<f64, 3>(0);
    check::<f32, 3>(5);
}

/// A simulation that has blown up must not keep the search busy before it is noticed.
#[test]
fn clouds_of_undefined_places_cost_nothing() {
    for value in [f64::NAN, f64::INFINITY] {
        let points = vec![Vector::splat(value); 50_000];
        let mut search = CellList::<f64, 3>::default();
        search.rebuild(&points, 0.1);
        let mut ranges = Vec::new();
        points.iter().for_each(|x| search.candidates(x, &mut ranges));
        assert!(ranges.is_empty());
    }
}

/// One particle that flew off must not make the cells as large as its flight was long.
#[test]
fn a_particle_far_away_does_not_spoil_the_cells() {
    fn check<T: Real, const D: usize>(far: f64) {
        let (mut points, dx) = cloud::<T, D>(Cloud::Lattice, 4096, 0);
        points[17] = Vector::splat(T::of(far));
        let mut search = CellList::default();
        search.rebuild(&points, T::of(2.6 * dx));
        // 3 cells of 2.6 spacings, and some for the last cell and the ones the spacing straddles.
        let most = 10usize.pow(D as u32);
        for x in &points {
            let mut ranges = Vec::new();
            search.candidates(x, &mut ranges);
            let count: usize = ranges.iter().map(Range::len).sum();
            assert!(count <= most, "{count} candidates, {} {D}D", T::NAME);
        }
        let wrong = difference(&mut search, &points[..600], T::of(2.6 * dx), &Periodic::none());
        assert_eq!(wrong, None);
    }
    check::<f32, 2>(1e12);
    check::<f64, 2>(-1e12);
    check::<f32, 3>(-1e30);
    check::<f64, 3>(1e300);
}

/// Points all over a space that has many more cells than points.
#[test]
fn sparse_clouds_are_found_too() {
    let mut dice = Dice(5);
    for scale in [1e3, 1e9, 1e300] {
        let mut points: Vec<Vector<f64, 3>> =
            (0..300).map(|_| Vector::of([(); 3].map(|()| scale * (dice.roll() - 0.5)))).collect();
        let shifted: Vec<_> = points.iter().map(|&x| x + Vector::of([0.0, 0.5, 0.0])).collect();
        points.extend(shifted);
        for mut search in searches() {
            assert_eq!(difference(&mut *search, &points, 1.0, &Periodic::none()), None, "{scale}");
        }
    }
}
