//! Kernels: unit integral, slope, compact support, second moment (38)–(43), (47).

use crate::bench::Flawed;
use alluvium::Real;
use alluvium::kernel::{CubicSpline, Kernel, QuinticSpline, WendlandC2, WendlandC4, WendlandC6};
use alluvium::verify::{Conditions, Expected, Measured, Study};
use std::f64::consts::PI;

const H: f64 = 0.7;
const CONSTANT: &str = "kernel constant off by 1e-6";
const SLOPE: &str = "slope constant off by 1e-6";
const SHORT: &str = "support 1 % short";
const TENTH_MILLE: &str = "kernel constant off by 1e-4";

pub fn studies() -> Vec<Study> {
    vec![
        Study::new(
            "kernel/integral/f64",
            "every kernel has unit integral in 1, 2 and 3 dimensions",
            integrals::<f64>,
        )
        .equations(&["39"])
        .source("Gauss-Legendre quadrature, exact for the polynomial pieces")
        .expect(Expected::Bound { largest: 2e-14 })
        .mutant(CONSTANT)
        .mutant(SHORT),
        Study::new("kernel/integral/f32", "the same in single precision", integrals::<f32>)
            .equations(&["39"])
            .expect(Expected::Bound { largest: 1e-6 })
            .mutant(TENTH_MILLE)
            .mutant(SHORT),
        Study::new("kernel/slope", "the slope F = W'/r integrates to the value, relative to W(0)", slopes)
            .equations(&["47"])
            .source("W(r) = -integral of F r from r to the end of the support")
            .expect(Expected::Bound { largest: 1e-13 })
            .mutant(SLOPE)
            .mutant(CONSTANT),
        Study::new(
            "kernel/support",
            "W > 0 and F < 0 inside the support, both exactly zero outside",
            supports,
        )
        .equations(&["41"])
        .expect(Expected::Identical)
        .mutant(SHORT),
        Study::new("kernel/moment", "second moments of Wendland C2 are 2/7, 5/18, 4/15 h²", moments)
            .equations(&["43"])
            .source("closed-form integrals")
            .expect(Expected::Bound { largest: 1e-13 })
            .mutant(CONSTANT),
    ]
}

/// The kernel under the mutant in force.
fn flawed<K>(kernel: K, conditions: &Conditions) -> Flawed<K> {
    let mut flawed = Flawed::none(kernel);
    if conditions.is(CONSTANT) {
        flawed.value_factor = 1.0 + 1e-6;
    }
    if conditions.is(TENTH_MILLE) {
        flawed.value_factor = 1.0 + 1e-4;
    }
    if conditions.is(SLOPE) {
        flawed.slope_factor = 1.0 + 1e-6;
    }
    if conditions.is(SHORT) {
        flawed.stretch = 1.0 / 0.99;
    }
    flawed
}

/// Calls `$visit::<T, _, D>(name, &kernel)` for all kernels in 1, 2 and 3 dimensions and collects.
macro_rules! all_kernels {
    ($t:ty, $conditions:expr, $visit:ident) => {{
        let mut values: Vec<(String, f64)> = Vec::new();
        all_kernels!(@dimension $t, $conditions, $visit, values, 1);
        all_kernels!(@dimension $t, $conditions, $visit, values, 2);
        all_kernels!(@dimension $t, $conditions, $visit, values, 3);
        Measured::values(values)
    }};
    (@dimension $t:ty, $conditions:expr, $visit:ident, $values:ident, $d:literal) => {
        all_kernels!(@one $t, $conditions, $visit, $values, $d, CubicSpline);
        all_kernels!(@one $t, $conditions, $visit, $values, $d, QuinticSpline);
        all_kernels!(@one $t, $conditions, $visit, $values, $d, WendlandC2);
        all_kernels!(@one $t, $conditions, $visit, $values, $d, WendlandC4);
        all_kernels!(@one $t, $conditions, $visit, $values, $d, WendlandC6);
    };
    (@one $t:ty, $conditions:expr, $visit:ident, $values:ident, $d:literal, $kernel:ident) => {
        let kernel = flawed($kernel::<$t, $d>::new(<$t>::of(H)).expect("a length"), $conditions);
        $values.push((format!("{} {}D", stringify!($kernel), $d), $visit::<$t, _, $d>(&kernel)));
    };
}

fn integrals<T: Real>(conditions: &Conditions) -> Measured {
    all_kernels!(T, conditions, integral_error)
}

fn slopes(conditions: &Conditions) -> Measured {
    all_kernels!(f64, conditions, slope_error)
}

fn supports(conditions: &Conditions) -> Measured {
    all_kernels!(f64, conditions, support_errors)
}

/// `∫ W dV − 1`.
fn integral_error<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &K) -> f64 {
    radial_integral::<T, K, D>(kernel, 0) - 1.0
}

/// `∫ W r^power dV`.
fn radial_integral<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &K, power: i32) -> f64 {
    let sphere = [2.0, 2.0 * PI, 4.0 * PI][D - 1];
    let integrand = |r: f64| {
        let r = T::of(r);
        sphere * r.as_f64().powi(D as i32 - 1 + power) * kernel.value(r * r).as_f64()
    };
    integrate(0.0, kernel.support().as_f64(), integrand)
}

/// Largest `|W(r) + ∫_r F r' dr'| / W(0)`.
fn slope_error<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &K) -> f64 {
    let value = |r: f64| kernel.value(T::of(r * r)).as_f64();
    let error = |k: i32| {
        let r = 0.05 * f64::from(k) * H;
        let integral = integrate(r, kernel.support().as_f64(), |s| s * kernel.slope(T::of(s * s)).as_f64());
        (value(r) + integral).abs() / value(0.0)
    };
    (0..60).map(error).fold(0.0, f64::max)
}

/// How often `W` or `F` has the wrong sign, or is not zero where it should be.
fn support_errors<T: Real, K: Kernel<T, D>, const D: usize>(kernel: &K) -> f64 {
    let end = kernel.support().as_f64();
    let wrong = |k: &i32| {
        let r2 = T::of((end * f64::from(*k) / 200.0).powi(2));
        let (value, slope) = (kernel.value(r2), kernel.slope(r2));
        if *k < 200 { value <= T::ZERO || slope >= T::ZERO } else { value != T::ZERO || slope != T::ZERO }
    };
    // Not the end itself: there rounding decides.
    (0..1000).filter(|&k| k != 200).filter(wrong).count() as f64
}

fn moments(conditions: &Conditions) -> Measured {
    fn deviation<const D: usize>(conditions: &Conditions, exact: f64) -> (String, f64) {
        let kernel = flawed(WendlandC2::<f64, D>::new(H).expect("a length"), conditions);
        let moment = radial_integral::<f64, _, D>(&kernel, 2) / (D as f64 * H * H);
        (format!("{D}D"), moment - exact)
    }
    let [one, two, three] = [2.0 / 7.0, 5.0 / 18.0, 4.0 / 15.0];
    Measured::values([
        deviation::<1>(conditions, one),
        deviation::<2>(conditions, two),
        deviation::<3>(conditions, three),
    ])
}

/// `∫ f dr` by Gauss's rule on each piece between multiples of h: exact for the polynomials there.
fn integrate(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    let mut begin = low;
    while high - begin > 1e-9 {
        // A hair beyond, so that a piece that ends at its knot is not repeated.
        let end = (((begin / H + 1e-9).floor() + 1.0) * H).min(high);
        let (centre, half) = (0.5 * (begin + end), 0.5 * (end - begin));
        sum += half * gauss().map(|(x, weight)| weight * f(centre + half * x)).sum::<f64>();
        begin = end;
    }
    sum
}

/// Nodes and weights of Gauss's rule with 16 nodes: zeros of a Legendre polynomial by Newton.
fn gauss() -> impl Iterator<Item = (f64, f64)> {
    const N: usize = 16;
    (0..N).map(|k| {
        let mut x = (PI * (k as f64 + 0.75) / (N as f64 + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..8 {
            let (mut p, mut previous) = (x, 1.0);
            for n in 2..=N {
                let n = n as f64;
                (p, previous) = (((2.0 * n - 1.0) * x * p - (n - 1.0) * previous) / n, p);
            }
            slope = N as f64 * (x * p - previous) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
}
