//! Kernels: unit integral, slope, compact support, second moment (38)–(43), (47).

use crate::bench::measured;
use alluvium::Real;
use alluvium::kernel::{CubicSpline, Kernel, QuinticSpline, WendlandC2, WendlandC4, WendlandC6};
use alluvium::verify::{Conditions, Expected, Flawed, Measured, Study, integrate, ready};
use std::f64::consts::PI;

const H: f64 = 0.7;
const CONSTANT: &str = "kernel constant off by 1e-6";
const SLOPE: &str = "slope constant off by 1e-6";
const SHORT: &str = "support 1 % short";
const CENTRE: &str = "slope at the centre off by 1 %";
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
        Study::new("kernel/centre", "F at r = 0 is finite and the limit of F near it", centres)
            .equations(&["47"])
            .expect(Expected::Bound { largest: 1e-6 })
            .mutant(CENTRE),
        Study::new("kernel/moment", "second moments of Wendland C2 are 2/7, 5/18, 4/15 h²", moments)
            .equations(&["43"])
            .source("closed-form integrals")
            .expect(Expected::Bound { largest: 1e-13 })
            .mutant(CONSTANT),
    ]
}

/// One number of the ready-made studies of all kernels in 1, 2 and 3 dimensions.
macro_rules! all_kernels {
    ($t:ty, $what:expr, $conditions:expr) => {{
        let mut values: Vec<(String, f64)> = Vec::new();
        all_kernels!(@dimension $t, $what, $conditions, values, 1);
        all_kernels!(@dimension $t, $what, $conditions, values, 2);
        all_kernels!(@dimension $t, $what, $conditions, values, 3);
        Measured::values(values)
    }};
    (@dimension $t:ty, $what:expr, $conditions:expr, $values:ident, $d:literal) => {
        all_kernels!(@one $t, $what, $conditions, $values, $d, CubicSpline);
        all_kernels!(@one $t, $what, $conditions, $values, $d, QuinticSpline);
        all_kernels!(@one $t, $what, $conditions, $values, $d, WendlandC2);
        all_kernels!(@one $t, $what, $conditions, $values, $d, WendlandC4);
        all_kernels!(@one $t, $what, $conditions, $values, $d, WendlandC6);
    };
    (@one $t:ty, $what:expr, $conditions:expr, $values:ident, $d:literal, $kernel:ident) => {
        let name = format!("{} {}D", stringify!($kernel), $d);
        let studies = ready::kernel_shape(&name, $kernel::<$t, $d>::new(<$t>::of(H)).expect("a length"));
        let points = measured(&studies, $what, $conditions).points;
        $values.extend(points.into_iter().map(|point| (name.clone(), point.value)));
    };
}

fn integrals<T: Real>(conditions: &Conditions) -> Measured {
    all_kernels!(T, "integral", conditions)
}

fn slopes(conditions: &Conditions) -> Measured {
    all_kernels!(f64, "slope", conditions)
}

fn supports(conditions: &Conditions) -> Measured {
    all_kernels!(f64, "support", conditions)
}

fn centres(conditions: &Conditions) -> Measured {
    all_kernels!(f64, "centre", conditions)
}

fn moments(conditions: &Conditions) -> Measured {
    fn deviation<const D: usize>(conditions: &Conditions, exact: f64) -> (String, f64) {
        let kernel = WendlandC2::<f64, D>::new(H).expect("a length");
        let kernel = Flawed::scaled(kernel, if conditions.is(CONSTANT) { 1.0 + 1e-6 } else { 1.0 });
        let sphere = [2.0, 2.0 * PI, 4.0 * PI][D - 1];
        let shell = |r: f64| sphere * r.powi(D as i32 + 1) * kernel.value(r * r);
        let moment = integrate(0.0, kernel.support(), 1e-16, &shell) / (D as f64 * H * H);
        (format!("{D}D"), moment - exact)
    }
    let [one, two, three] = [2.0 / 7.0, 5.0 / 18.0, 4.0 / 15.0];
    Measured::values([
        deviation::<1>(conditions, one),
        deviation::<2>(conditions, two),
        deviation::<3>(conditions, three),
    ])
}
