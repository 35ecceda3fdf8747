//! Kernels: normalised (39), compact (41), with the slope of their value and the right second moment.

use alluvium::kernel::{CubicSpline, Kernel, QuinticSpline, WendlandC2, WendlandC4, WendlandC6};
use alluvium::{Num, Real};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use core::f64::consts::PI;

/// A smoothing length that no power of two divides.
const H: f64 = 0.13;

/// Calls a generic check on all five kernels in 2D and 3D, and the default one in 1D.
macro_rules! for_all_kernels {
    ($check:ident, $t:ty) => {
        for_all_kernels!($check, $t, 2, WendlandC2 WendlandC4 WendlandC6 CubicSpline QuinticSpline);
        for_all_kernels!($check, $t, 3, WendlandC2 WendlandC4 WendlandC6 CubicSpline QuinticSpline);
        for_all_kernels!($check, $t, 1, WendlandC2);
    };
    ($check:ident, $t:ty, $d:literal, $($kernel:ident)+) => {
        $($check(
            &$kernel::<$t, $d>::new(<$t>::of(H)).unwrap(),
            &format!("{} {} {}D", stringify!($kernel), <$t>::NAME, $d),
        );)+
    };
}

fn value<T: Real, const D: usize>(kernel: &impl Kernel<T, D>, r: f64) -> f64 {
    kernel.value(T::of(r * r)).as_f64()
}

fn slope<T: Real, const D: usize>(kernel: &impl Kernel<T, D>, r: f64) -> f64 {
    kernel.slope(T::of(r * r)).as_f64()
}

/// The ball's surface per r^(D−1).
fn sphere(dimension: usize) -> f64 {
    [2.0, 2.0 * PI, 4.0 * PI][dimension - 1]
}

/// Nodes and weights on [−1, 1], exact to degree 23: kernel pieces times r⁴ are of degree 15.
fn gauss() -> Vec<(f64, f64)> {
    let n = 12;
    let legendre = |x: f64| {
        let (mut last, mut p) = (1.0, x);
        for k in 2..=n {
            let k = k as f64;
            (last, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * last) / k);
        }
        (p, n as f64 * (x * p - last) / (x * x - 1.0))
    };
    let node = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        for _ in 0..8 {
            let (p, slope) = legendre(x);
            x -= p / slope;
        }
        let slope = legendre(x).1;
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

/// `∫ W rᵐ dV`, piece by piece between the knots at whole `r/h`.
fn moment<T: Real, const D: usize>(kernel: &impl Kernel<T, D>, m: i32) -> f64 {
    let h = kernel.smoothing_length().as_f64();
    let pieces = (kernel.support().as_f64() / h).round() as usize;
    let nodes = gauss();
    let integrand = |r: f64| value(kernel, r) * r.powi(m + D as i32 - 1);
    let piece = |k: usize| -> f64 {
        nodes.iter().map(|(x, weight)| 0.5 * h * weight * integrand(h * (k as f64 + 0.5 + 0.5 * x))).sum()
    };
    sphere(D) * (0..pieces).map(piece).sum::<f64>()
}

pub(crate) fn tolerance<T: Real>(double: f64, single: f64) -> f64 {
    if T::NAME == "f64" { double } else { single }
}

/// How far the integral over space is from one (39).
fn integral_error<T: Real, const D: usize>(kernel: &impl Kernel<T, D>) -> f64 {
    (moment(kernel, 0) - 1.0).abs()
}

#[test]
fn the_integral_over_space_is_one() {
    fn check<T: Real, const D: usize>(kernel: &impl Kernel<T, D>, name: &str) {
        let error = integral_error(kernel);
        assert!(error < tolerance::<T>(1e-12, 1e-6), "{name}: {error}");
    }
    for_all_kernels!(check, f64);
    for_all_kernels!(check, f32);
}

#[test]
fn the_second_moment_is_the_known_one() {
    // ∫ W x²/h² dV of Wendland C2, by hand.
    fn check<T: Real, const D: usize>(exact: f64) {
        let kernel = WendlandC2::<T, D>::new(T::of(H)).unwrap();
        let h = kernel.smoothing_length().as_f64();
        let found = moment(&kernel, 2) / (D as f64 * h * h);
        assert_relative_eq!(found, exact, max_relative = tolerance::<T>(1e-12, 1e-6));
    }
    check::<f64, 1>(2.0 / 7.0);
    check::<f64, 2>(5.0 / 18.0);
    check::<f64, 3>(4.0 / 15.0);
    check::<f32, 2>(5.0 / 18.0);
    check::<f32, 3>(4.0 / 15.0);
}

/// The largest difference of the slope from `W'/r`, relative, by finite differences extrapolated
/// twice (Richardson: error ∝ d⁶).
fn slope_error<const D: usize>(kernel: &impl Kernel<f64, D>) -> f64 {
    let h = kernel.smoothing_length();
    let pieces = (kernel.support() / h).round() as usize;
    let central = |r: f64, d: f64| (value(kernel, r + d) - value(kernel, r - d)) / (2.0 * d);
    let once = |r: f64, d: f64| (4.0 * central(r, d / 2.0) - central(r, d)) / 3.0;
    let twice = |r: f64, d: f64| (16.0 * once(r, d / 2.0) - once(r, d)) / 15.0;
    // Not across the knots at whole r/h, where higher derivatives jump, nor at the very end, where
    // the slope itself goes to nothing.
    let places = (0..pieces).flat_map(|k| (1..16).map(move |n| k as f64 + 0.05 + 0.9 * f64::from(n) / 16.0));
    places.fold(0.0, |worst: f64, q| {
        // The step goes with the distance to the end, near which high powers of it vary fast.
        let (r, d) = (q * h, 0.02 * h * (pieces as f64 - q).min(1.0));
        let exact = slope(kernel, r);
        worst.max((twice(r, d) / r - exact).abs() / exact.abs())
    })
}

#[test]
fn the_slope_is_that_of_the_value() {
    fn check<const D: usize>(kernel: &impl Kernel<f64, D>, name: &str) {
        let error = slope_error(kernel);
        assert!(error < 1e-8, "{name}: {error}");
    }
    for_all_kernels!(check, f64);
}

/// Finite differences say nothing in single precision: it is held against double.
#[test]
fn both_precisions_agree() {
    fn check<const D: usize>(single: &impl Kernel<f32, D>, double: &impl Kernel<f64, D>) {
        for n in 0..=320 {
            let r = H * f64::from(n) * 0.01;
            let (w, f) = (value(single, r), slope(single, r));
            assert_abs_diff_eq!(w, value(double, r), epsilon = 2e-6 * value(double, 0.0));
            assert_abs_diff_eq!(f, slope(double, r), epsilon = 2e-6 * slope(double, 0.0).abs());
        }
    }
    macro_rules! check {
        ($($kernel:ident)+) => {$(
            check(&$kernel::<f32, 2>::new(H as f32).unwrap(), &$kernel::<f64, 2>::new(H).unwrap());
            check(&$kernel::<f32, 3>::new(H as f32).unwrap(), &$kernel::<f64, 3>::new(H).unwrap());
        )+};
    }
    check!(WendlandC2 WendlandC4 WendlandC6 CubicSpline QuinticSpline);
}

#[test]
fn the_slope_at_the_centre_is_finite_and_its_limit() {
    fn check<T: Real, const D: usize>(kernel: &impl Kernel<T, D>, name: &str) {
        let centre = slope(kernel, 0.0);
        assert!(centre.is_finite() && centre < 0.0, "{name}: {centre}");
        // Two places on the way there, extrapolated: what is left is of second order.
        let q = tolerance::<T>(1e-4, 1e-2);
        let limit = 2.0 * slope(kernel, q * H) - slope(kernel, 2.0 * q * H);
        assert_relative_eq!(limit, centre, max_relative = tolerance::<T>(1e-7, 1e-3));
    }
    for_all_kernels!(check, f64);
    for_all_kernels!(check, f32);
}

#[test]
fn nothing_from_the_support_on() {
    fn check<T: Real, const D: usize>(kernel: &impl Kernel<T, D>, name: &str) {
        let support = kernel.support();
        let hair = T::EPSILON.as_f64().powi(2);
        // At the support itself r/h may round to a hair less.
        let (w, f) = (kernel.value(support * support), kernel.slope(support * support));
        assert!(w.as_f64().abs() <= hair * value(kernel, 0.0), "{name}: {w}");
        assert!(f.as_f64().abs() <= 2.0 * hair * slope(kernel, 0.0).abs(), "{name}: {f}");
        for factor in [1.0 + 8.0 * T::EPSILON.as_f64(), 1.01, 2.0, 1e9] {
            let r = support.as_f64() * factor;
            assert_eq!((value(kernel, r), slope(kernel, r)), (0.0, 0.0), "{name} at {factor} supports");
        }
        let inside = 0.99 * support.as_f64();
        assert!(value(kernel, inside) > 0.0 && slope(kernel, inside) < 0.0, "{name}: support too large");
    }
    for_all_kernels!(check, f64);
    for_all_kernels!(check, f32);
}

#[test]
fn the_value_falls_with_the_distance() {
    fn check<T: Real, const D: usize>(kernel: &impl Kernel<T, D>, name: &str) {
        let support = kernel.support().as_f64();
        let mut last = f64::INFINITY;
        for n in 0..1000 {
            let r = support * f64::from(n) / 1000.0;
            let w = value(kernel, r);
            // In single precision the flat top has equal neighbours, and the splines' tail is a
            // difference of larger numbers.
            let slack = tolerance::<T>(0.0, 4e-7 * value(kernel, 0.0));
            assert!(w < last + slack, "{name}: {w} after {last} at {r}");
            assert!(slope(kernel, r) <= 0.0, "{name} at {r}");
            last = w;
        }
    }
    for_all_kernels!(check, f64);
    for_all_kernels!(check, f32);
}

/// A kernel of a user's own: another one with its value scaled.
#[derive(Clone, Debug)]
struct Scaled<K>(K, f64);

impl<T: Real, const D: usize, K: Kernel<T, D>> Kernel<T, D> for Scaled<K> {
    fn smoothing_length(&self) -> T {
        self.0.smoothing_length()
    }
    fn support(&self) -> T {
        self.0.support()
    }
    #[inline(always)]
    fn value<N: Num<Scalar = T>>(&self, r2: N) -> N {
        self.0.value(r2) * N::lit(self.1)
    }
    #[inline(always)]
    fn slope<N: Num<Scalar = T>>(&self, r2: N) -> N {
        self.0.slope(r2)
    }
}

/// The checks above can fail: they see a constant that is wrong by a millionth.
#[test]
fn a_wrong_constant_is_caught() {
    fn check<const D: usize>(kernel: &impl Kernel<f64, D>, name: &str) {
        let wrong = Scaled(kernel.clone(), 1.0 + 1e-6);
        assert!(integral_error(&wrong) > 0.9e-6, "{name}");
        assert!(slope_error(&wrong) > 0.9e-6, "{name}");
        let right = Scaled(kernel.clone(), 1.0);
        assert!(integral_error(&right) < 1e-12 && slope_error(&right) < 1e-8, "{name}");
    }
    for_all_kernels!(check, f64);
}

#[test]
fn impossible_smoothing_lengths_are_refused() {
    fn check<T: Real>() {
        for (h, text) in [(0.0, "0"), (-0.5, "-0.5"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
            let h = T::of(h);
            let errors = [
                WendlandC2::<T, 2>::new(h).unwrap_err(),
                WendlandC4::<T, 3>::new(h).unwrap_err(),
                WendlandC6::<T, 2>::new(h).unwrap_err(),
                CubicSpline::<T, 3>::new(h).unwrap_err(),
                QuinticSpline::<T, 2>::new(h).unwrap_err(),
            ];
            for error in errors {
                assert_eq!((error.name, error.value.as_str()), ("smoothing_length", text));
                let shown = error.to_string();
                assert!(shown.contains(&format!("smoothing_length = {text} ")), "{shown}");
                assert!(shown.contains("a positive length [m]"), "{shown}");
            }
        }
    }
    check::<f32>();
    check::<f64>();
}
