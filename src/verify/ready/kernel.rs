//! What every kernel must be (38)–(43), (47).

use super::{by_precision, worst};
use crate::kernel::Kernel;
use crate::neighbours::CellList;
use crate::real::Real;
use crate::space::Vector;
use crate::summation::{Cloud, Form, Neighbourhood};
use crate::verify::{Arrangement, Conditions, Expected, Flawed, Measured, Study, integrate};
use core::f64::consts::PI;

const SLOPE: [&str; 2] = ["slope constant off by 1e-6", "slope constant off by 1e-4"];
const CONSTANT: [&str; 2] = ["kernel constant off by 1e-6", "kernel constant off by 1e-4"];
const SHORT: &str = "support 1 % short";
const CENTRE: &str = "slope at the centre off by 1 %";
const PLAIN: &str = "gradient not corrected";

/// Studies of a kernel: those of its [shape](kernel_shape), and `linear`, on particles.
///
/// # Panics
/// `D` is not 2 or 3.
pub fn kernel<T: Real, const D: usize, K: Kernel<T, D>>(name: &str, kernel: K) -> Vec<Study> {
    assert!((2..=3).contains(&D), "particles exist in 2 and 3 dimensions");
    let mut studies = kernel_shape(name, kernel.clone());
    studies.push(
        Study::new(
            format!("{name}/linear"),
            "with it corrected gradients of linear fields are exact, at any disorder and at surfaces",
            move |conditions| linear_error::<T, K, D>(&kernel, conditions),
        )
        .source("construction of the correction (Bonet & Lok 1999)")
        .expect(Expected::Bound { largest: by_precision::<T, _>(1e-11, 1e-4) })
        .mutant(PLAIN),
    );
    studies
}

/// Studies of a kernel's value and slope as functions of the distance: `integral`, `slope`, `support` and
/// `centre`.
///
/// # Panics
/// `D` is not 1, 2 or 3.
pub fn kernel_shape<T: Real, const D: usize, K: Kernel<T, D>>(name: &str, kernel: K) -> Vec<Study> {
    assert!((1..=3).contains(&D), "kernels exist in 1 to 3 dimensions");
    let study = |what: &str, claim: &str, measure: fn(&Flawed<K>) -> Measured| {
        let kernel = kernel.clone();
        let run = move |conditions: &Conditions| measure(&flawed::<T, K>(&kernel, conditions));
        Study::new(format!("{name}/{what}"), claim, run)
    };
    let of_precision = |mutants: [&'static str; 2]| by_precision::<T, _>(mutants[0], mutants[1]);
    let (constant, slope) = (of_precision(CONSTANT), of_precision(SLOPE));
    let bar = Expected::Bound { largest: by_precision::<T, _>(1e-12, 2e-6) };
    vec![
        study("integral", "the integral of the kernel over space is one", |kernel| {
            Measured::value(integral_error::<T, K, D>(kernel))
        })
        .equations(&["39"])
        .source("Gauss-Legendre quadrature")
        .expect(bar)
        .mutant(constant)
        .mutant(SHORT),
        study("slope", "the slope F = W'/r integrates to the value, relative to W(0)", |kernel| {
            Measured::value(slope_error::<T, K, D>(kernel))
        })
        .equations(&["47"])
        .source("W(r) = -integral of F r from r to the end of the support")
        .expect(bar)
        .mutant(slope)
        .mutant(constant),
        study("support", "W > 0 and F < 0 inside the support, both exactly zero outside", |kernel| {
            Measured::value(support_errors::<T, K, D>(kernel))
        })
        .equations(&["41"])
        .source("definition of the support")
        .expect(Expected::Identical)
        .mutant(SHORT),
        Study::new(
            format!("{name}/centre"),
            "F at r = 0 is finite and the limit of F near it, relative to the largest F",
            move |conditions| Measured::value(centre_error::<T, K, D>(&kernel, conditions)),
        )
        .equations(&["47"])
        .source("two places near the centre, extrapolated")
        .expect(Expected::Bound { largest: by_precision::<T, _>(1e-6, 2e-3) })
        .mutant(CENTRE),
    ]
}

/// The kernel under the mutant in force.
fn flawed<T: Real, K: Clone>(kernel: &K, conditions: &Conditions) -> Flawed<K> {
    let mut flawed = Flawed::none(kernel.clone());
    let off = by_precision::<T, _>(1e-6, 1e-4);
    if CONSTANT.iter().any(|mutant| conditions.is(mutant)) {
        flawed.value_factor += off;
    }
    if SLOPE.iter().any(|mutant| conditions.is(mutant)) {
        flawed.slope_factor += off;
    }
    if conditions.is(SHORT) {
        flawed.stretch = 1.0 / 0.99;
    }
    flawed
}

/// `∫ W dV − 1`.
fn integral_error<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &Flawed<K>) -> f64 {
    let (sphere, support) = ([2.0, 2.0 * PI, 4.0 * PI][D - 1], kernel.support().as_f64());
    let shell = |r: f64| {
        let r = T::of(r);
        sphere * r.as_f64().powi(D as i32 - 1) * kernel.value(r * r).as_f64()
    };
    let largest = sphere * support.powi(D as i32 - 1) * kernel.value(T::ZERO).as_f64();
    integrate(0.0, support, T::EPSILON.as_f64() * largest, &shell) - 1.0
}

/// Largest `|W(r) + ∫_r F r' dr'| / W(0)`.
fn slope_error<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &Flawed<K>) -> f64 {
    let value = |r: f64| kernel.value(T::of(r * r)).as_f64();
    let (support, noise) = (kernel.support().as_f64(), T::EPSILON.as_f64() * value(0.0));
    let fall = |r: f64| r * kernel.slope(T::of(r * r)).as_f64();
    let error = |k: u32| {
        let r = f64::from(k) / 40.0 * support;
        (value(r) + integrate(r, support, noise / support, &fall)).abs() / value(0.0)
    };
    worst((0..40).map(error))
}

/// How often `W` or `F` has the wrong sign, or is not zero where it should be.
fn support_errors<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &Flawed<K>) -> f64 {
    let at = |part: f64| {
        let r = kernel.support() * T::of(part);
        (kernel.value(r * r), kernel.slope(r * r))
    };
    let inside = (0..200).map(|k| at(f64::from(k) / 200.0));
    let wrong_inside = inside.filter(|(value, slope)| !(*value > T::ZERO && *slope < T::ZERO)).count();
    // Not at the end itself: there rounding decides.
    let beyond = [1.0 + 8.0 * T::EPSILON.as_f64(), 1e3, 1e9].into_iter();
    let outside = beyond.chain((201..1000).map(|k| f64::from(k) / 200.0)).map(at);
    let wrong_outside = outside.filter(|(value, slope)| *value != T::ZERO || *slope != T::ZERO).count();
    (wrong_inside + wrong_outside) as f64
}

/// `F(0)` less its limit, over the largest `|F|`.
fn centre_error<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &K, conditions: &Conditions) -> f64 {
    let support = kernel.support();
    let slope = |part: f64| {
        let r = support * T::of(part);
        kernel.slope(r * r).as_f64()
    };
    let near = by_precision::<T, _>(1e-4, 3e-3);
    let limit = 2.0 * slope(near) - slope(2.0 * near);
    let largest = worst((0..=20).map(|k| slope(f64::from(k) / 20.0).abs()));
    let centre = slope(0.0) * if conditions.is(CENTRE) { 1.01 } else { 1.0 };
    (centre - limit) / largest
}

/// Largest error of the gradient of a linear field, relative to it, for several disorders.
fn linear_error<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &K, conditions: &Conditions) -> Measured {
    let side = if D == 2 { 20 } else { 9 };
    let exact: [f64; D] = core::array::from_fn(|k| 0.3 - 0.7 * k as f64);
    let largest = exact.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let error = |jitter: f64| {
        let arrangement = Arrangement::<D>::jittered(side, jitter, 7);
        // The unit box becomes as large as three spacings to the support make it.
        let unit = kernel.support().as_f64() / 3.0 / arrangement.spacing;
        let places: Vec<Vector<T, D>> =
            arrangement.positions.iter().map(|x| Vector::of(x.map(|x| x * unit))).collect();
        let mut neighbourhood =
            Neighbourhood::new(Box::<CellList<T, D>>::default(), kernel.support()).with_skin(T::ZERO);
        let order = neighbourhood.cell_order(&places, 0);
        let x: Vec<_> = order.iter().map(|&i| places[i as usize]).collect();
        neighbourhood.rebuild(&x, 0);
        let volume = T::of(arrangement.volume * unit.powi(D as i32));
        let (masses, densities) = (vec![volume; x.len()], vec![T::ONE; x.len()]);
        let cloud = Cloud::new(&neighbourhood, kernel, &x, &masses, &densities).expect("as it was built");
        // Made of the rounded places, so that the field is linear to the last digit but one.
        let value = |x: &Vector<T, D>| T::of((0..D).map(|k| exact[k] * x[k].as_f64() / unit).sum::<f64>());
        let values: Vec<T> = x.iter().map(value).collect();
        let gradients = match conditions.is(PLAIN) {
            true => cloud.gradient(Form::VolumeDifference, &values),
            false => cloud.corrected_gradient(&cloud.corrections(), &values),
        };
        let components =
            gradients.iter().flat_map(|g| (0..D).map(|k| (g[k].as_f64() * unit - exact[k]).abs()));
        (format!("jitter {jitter}"), worst(components) / largest)
    };
    Measured::values([0.0, 0.1, 0.3].map(error))
}
