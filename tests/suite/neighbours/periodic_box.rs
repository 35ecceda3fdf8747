//! Images, and the box they repeat.

use super::{Cloud, Dice, SIDE, cloud, periodic, searches};
use alluvium::neighbours::{CellList, Pairs, Periodic};
use alluvium::{Real, Vector};

#[test]
fn a_box_narrower_than_the_radius_shows_several_images() {
    fn check<T: Real>() {
        let periodic = Periodic::new(Vector::of([-0.25, 0.0]), [Some(T::of(0.5)), None]).unwrap();
        // On the line: images of itself at ±0.5, ±1; of the other at 0.25 ± 0.5, ±1 and −1.25 no more.
        let points = [Vector::of([0.0, 0.0]), Vector::of([0.125, 0.5])];
        for mut search in searches() {
            let pairs = Pairs::find(&mut *search, &points, T::of(1.125), &periodic);
            // In the other: |0.125 + n/2|² + 0.25 < 1.265625 for n = −2, −1, 0, 1.
            assert_eq!(pairs.of(0), [1, 0, 0, 0, 0, 1, 1, 1], "{}", search.name());
            assert_eq!(pairs.of(1), [0, 0, 0, 0, 1, 1, 1, 1], "{}", search.name());
        }
    }
    check::<f32>();
    check::<f64>();
}

#[test]
fn points_outside_a_periodic_box_count_inside() {
    let (points, dx) = cloud::<f64, 2>(Cloud::Jittered, 150, 3);
    let moved: Vec<_> =
        points.iter().enumerate().map(|(i, &x)| x + Vector::of([SIDE * (i % 5) as f64, -SIDE])).collect();
    let mut search = CellList::default();
    let find =
        |search: &mut CellList<f64, 2>, points: &[_]| Pairs::find(search, points, 2.6 * dx, &periodic(3));
    assert_eq!(find(&mut search, &points).count(), find(&mut search, &moved).count());
}

#[test]
fn wrapping_ends_inside_the_box() {
    fn check<T: Real>() {
        let (low, length) = (T::of(0.1), T::of(0.7));
        let periodic = Periodic::new(Vector([low]), [Some(length)]).unwrap();
        let mut dice = Dice(9);
        for n in 0..2000 {
            let turn = T::of(f64::from(n % 41 - 20)) * length;
            let hair = T::of(1.0 + 4.0 * (dice.roll() - 0.5) * T::EPSILON.as_f64());
            let inside = if n < 1000 { T::ZERO } else { length * T::of(dice.roll()) };
            let x = periodic.wrap(Vector([(low + turn + inside) * hair]))[0];
            assert!(low <= x && x < low + length, "{x}");
            assert_eq!(periodic.wrap(Vector([x]))[0], x, "wrapping twice");
        }
        assert!(!periodic.wrap(Vector([T::INFINITY])).is_finite());
    }
    check::<f32>();
    check::<f64>();
}

#[test]
fn impossible_periods_are_refused() {
    for (length, text) in [(0.0, "0"), (-2.0, "-2"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let error = Periodic::new(Vector::<f64, 2>::zero(), [None, Some(length)]).unwrap_err().to_string();
        assert!(error.contains("periodic length") && error.contains(text), "{error}");
        assert!(error.contains("a positive length [m]"), "{error}");
    }
    let error = Periodic::new(Vector([f64::NAN, 0.0]), [Some(1.0), None]).unwrap_err();
    assert_eq!(error.name, "periodic low");
    assert!(Periodic::new(Vector([f64::NAN, 0.0]), [None, Some(1.0)]).is_ok());
}
