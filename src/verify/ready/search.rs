//! What every search must propose (41).

use crate::neighbours::{BruteForce, NeighbourSearch, Pairs, Periodic};
use crate::real::Real;
use crate::space::Vector;
use crate::verify::{Arrangement, Conditions, Expected, Measured, Random, ShortSighted, Study};

const SHORT: &str = "search 1 % short of the radius";

type Search<T, const D: usize> = Box<dyn NeighbourSearch<T, D>>;
type Cloud<T, const D: usize> = (Vec<Vector<T, D>>, T);

/// Studies of a search, made anew for each cloud by `make`: `pairs`, `pairs/periodic`, `radius` and
/// `undefined`.
///
/// # Panics
/// `D` is not 2 or 3.
pub fn search<T: Real, const D: usize>(
    name: &str,
    make: impl Fn() -> Search<T, D> + Clone + Send + Sync + 'static,
) -> Vec<Study> {
    assert!((2..=3).contains(&D), "searches exist in 2 and 3 dimensions");
    let study = |what: &str, claim: &str, measure: fn(&dyn Fn() -> Search<T, D>) -> Measured| {
        let make = make.clone();
        let run = move |conditions: &Conditions| {
            let short = conditions.is(SHORT);
            measure(&|| if short { Box::new(ShortSighted::new(make(), 0.99)) } else { make() })
        };
        Study::new(format!("{name}/{what}"), claim, run)
            .equations(&["41"])
            .source("comparison of all pairs")
            .expect(Expected::Identical)
            .mutant(SHORT)
    };
    vec![
        study("pairs", "with it every point has the neighbours that brute force finds", |make| {
            Measured::values(clouds::<T, D>().map(|(what, (points, radius))| {
                (what, differences(make, &points, radius, &Periodic::none()))
            }))
        }),
        study("pairs/periodic", "the same in a box that repeats itself, and in one that is narrow", |make| {
            Measured::values(clouds::<T, D>().map(|(what, cloud)| (what, repeated(make, cloud))))
        }),
        study("radius", "points exactly at the radius, and all nearer ones, are proposed", |make| {
            Measured::value(left_out(make))
        }),
        study(
            "undefined",
            "places that are not finite neither stop it nor change what others find",
            |make| Measured::value(undefined(make)),
        ),
    ]
}

/// Clouds with a radius that has some pairs in its last percent.
fn clouds<T: Real, const D: usize>() -> [(&'static str, Cloud<T, D>); 3] {
    let side = if D == 2 { 20 } else { 8 };
    let lattice = Arrangement::<D>::lattice(side);
    let jittered = Arrangement::<D>::jittered(side, 0.3, 17);
    let mut clustered = lattice.clone();
    let mut random = Random::new(23);
    let centres = [0.3, 0.5, 0.85];
    for (n, x) in clustered.positions.iter_mut().enumerate() {
        *x = x.map(|_| centres[n % 3] + lattice.spacing * random.between(-2.0, 2.0));
    }
    // Neighbours two spacings along an axis are 0.5 % inside.
    let radius = T::of(2.01 * lattice.spacing);
    [("lattice", &lattice), ("jittered", &jittered), ("clustered", &clustered)]
        .map(|(what, arrangement)| (what, (arrangement.positions(), radius)))
}

/// Of how many points the neighbours are others than brute force finds.
fn differences<T: Real, const D: usize>(
    make: &dyn Fn() -> Search<T, D>,
    points: &[Vector<T, D>],
    radius: T,
    periodic: &Periodic<T, D>,
) -> f64 {
    let right = Pairs::find(&mut BruteForce::default(), points, radius, periodic);
    let found = Pairs::find(&mut *make(), points, radius, periodic);
    (0..points.len()).filter(|&i| found.of(i) != right.of(i)).count() as f64
}

/// The differences in the unit box, and in one narrower than the radius.
fn repeated<T: Real, const D: usize>(make: &dyn Fn() -> Search<T, D>, cloud: Cloud<T, D>) -> f64 {
    let (points, radius) = cloud;
    let box_of = |period: T| {
        let mut length = [None; D];
        (length[0], length[1]) = (Some(T::ONE), Some(period));
        Periodic::new(Vector::zero(), length).expect("a box with an extent")
    };
    differences(make, &points, radius, &box_of(T::ONE))
        + differences(make, &points[..60], radius, &box_of(radius * T::of(0.8)))
}

/// How many points at `r ≤ radius` are not proposed, on a lattice whose distances have no rounding: the
/// ring of 3-4-5 lies at the radius.
fn left_out<T: Real, const D: usize>(make: &dyn Fn() -> Search<T, D>) -> f64 {
    let side = 11_usize;
    let points: Vec<Vector<T, D>> = (0..side.pow(D as u32))
        .map(|n| Vector::of(core::array::from_fn(|k| (n / side.pow(k as u32) % side) as f64 / 8.0)))
        .collect();
    let radius = T::of(0.625);
    let (mut search, mut missing) = (make(), 0);
    search.rebuild(&points, radius);
    for place in &points {
        let mut ranges = Vec::new();
        search.candidates(place, &mut ranges);
        let near = |x: &Vector<T, D>| (*x - *place).norm2() <= radius * radius;
        let proposed = |j: u32| ranges.iter().any(|range| range.contains(&j));
        missing += (0..).zip(&points).filter(|(j, x)| near(x) && !proposed(*j)).count();
    }
    missing as f64
}

/// The differences in a cloud with infinite, undefined and far places, with a radius of nothing, and
/// without points.
fn undefined<T: Real, const D: usize>(make: &dyn Fn() -> Search<T, D>) -> f64 {
    let [_, (_, (mut points, radius)), _] = clouds::<T, D>();
    for (n, value) in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e30, -1e30].into_iter().enumerate() {
        points[7 * n + 3][n % D] = T::of(value);
    }
    let none = Periodic::none();
    let nothing = [0.0, -1.0, f64::NAN].map(|radius| differences(make, &points[..40], T::of(radius), &none));
    differences(make, &points, radius, &none)
        + nothing.iter().sum::<f64>()
        + differences(make, &[], radius, &none)
}
