//! Operators on a smooth field: orders where there are orders, plateaus where there are plateaus.
//!
//! The field is f = 2 + Π (sin 2πx, cos 2πy, …) in a periodic unit box. The uncorrected forms do not
//! converge at a fixed h/Δx: their error stays at the lattice's own gain error, or grows like 1/Δx on
//! disordered particles. That is their nature and is asserted as such.

use crate::bench::Bench;
use alluvium::Real;
use alluvium::kernel::WendlandC2;
use alluvium::summation::{Cloud, Corrections, Form};
use alluvium::verify::{Arrangement, Conditions, Expected, Flawed, Level, Measured, Study, relative_l2};
use std::f64::consts::PI;

const SOURCE: &str = "an independent program; the gain error is the lattice sum of the kernel";
const SWAPPED: &str = "swapped index in the correction matrix";
const UNCORRECTED: &str = "correction left out";
const CONSTANT: &str = "kernel constant off by 1 %";
const HALF: &str = "factor 2 left out";
const DIFFERENCE: &str = "own value with the other sign";

/// 1 − ΣV x ∂W/∂x of the square lattice, Wendland C2, h/Δx = 1.3: what (50) and (51) converge to.
const GAIN_ERROR: f64 = 2.607_851_785_662_274e-2;

#[derive(Clone, Copy, PartialEq)]
pub enum Operator {
    Gradient(Form),
    Corrected,
    Laplacian,
    Normalised,
}

/// Arrangements of one study: h/Δx, jitter in spacings, particles along an edge.
#[derive(Clone, Copy)]
struct Series {
    ratio: f64,
    jitter: f64,
    sides: &'static [usize],
}

const FINE: &[usize] = &[25, 50, 100, 200];
const MIDDLE: &[usize] = &[25, 50, 100];
const SOLID: &[usize] = &[12, 24, 36];

pub fn studies() -> Vec<Study> {
    let mut studies = plateaus();
    studies.extend(lattice_orders());
    studies.extend(disordered());
    studies
}

fn study<T: Real, const D: usize>(name: &str, claim: &str, operator: Operator, series: Series) -> Study {
    Study::new(name, claim, move |conditions| errors::<T, D>(operator, series, conditions)).source(SOURCE)
}

fn plateaus() -> Vec<Study> {
    let series = Series { ratio: 1.3, jitter: 0.0, sides: FINE };
    let stays = Expected::Plateau { value: GAIN_ERROR, tolerance: 0.03 };
    let claim = "on a lattice the error stays at the gain error of the kernel";
    let forms: [(&'static [&'static str], Form); 3] =
        [(&["50"], Form::Difference), (&["51"], Form::Symmetric), (&["46"], Form::Plain)];
    let mut studies: Vec<_> = forms
        .into_iter()
        .map(|(equations, form)| {
            let name = format!("operators/plateau/{}", equations[0]);
            study::<f64, 2>(&name, claim, Operator::Gradient(form), series)
                .equations(equations)
                .expect(stays)
                .mutant(CONSTANT)
        })
        .collect();
    let f32_series = Series { sides: MIDDLE, ..series };
    studies.push(
        study::<f32, 2>("operators/plateau/50/f32", claim, Operator::Gradient(Form::Difference), f32_series)
            .equations(&["50"])
            .expect(Expected::Plateau { value: 0.027_891, tolerance: 0.01 })
            .mutant(CONSTANT),
    );
    studies.push(
        study::<f64, 2>("operators/plateau/laplacian", claim, Operator::Laplacian, series)
            .expect(stays)
            .mutant(CONSTANT)
            .mutant(HALF),
    );
    studies
}

fn lattice_orders() -> Vec<Study> {
    let claim = "the corrected gradient is of second order on a lattice";
    let (order, corrected) = (Expected::order(2.0, 0.1), Operator::Corrected);
    let series = |ratio, sides| Series { ratio, jitter: 0.0, sides };
    let studies = [
        study::<f64, 2>("operators/order/corrected/2d/1.3", claim, corrected, series(1.3, MIDDLE)),
        study::<f64, 2>("operators/order/corrected/2d/2.0", claim, corrected, series(2.0, MIDDLE)),
        study::<f32, 2>("operators/order/corrected/2d/f32", claim, corrected, series(1.3, MIDDLE)),
        study::<f64, 3>("operators/order/corrected/3d", claim, corrected, series(1.3, SOLID)),
        study::<f32, 3>("operators/order/corrected/3d/f32", claim, corrected, series(1.3, SOLID)),
        study::<f64, 2>("operators/order/corrected/2d/fine", claim, corrected, series(2.0, FINE))
            .level(Level::Full),
    ];
    let mut studies: Vec<_> =
        studies.into_iter().map(|study| study.expect(order).mutant(SWAPPED).mutant(UNCORRECTED)).collect();
    let claim = "the normalised value is of second order on a lattice";
    studies.push(
        study::<f64, 2>("operators/order/normalised", claim, Operator::Normalised, series(1.3, MIDDLE))
            .equations(&["44", "70"])
            .expect(order)
            .mutant(UNCORRECTED),
    );
    studies
}

fn disordered() -> Vec<Study> {
    let series = |ratio, sides| Series { ratio, jitter: 0.1, sides };
    let difference = Operator::Gradient(Form::Difference);
    let symmetric = Operator::Gradient(Form::Symmetric);
    let at_least_one = Expected::Order { at_least: 1.0, at_most: f64::INFINITY };
    vec![
        study::<f64, 2>(
            "operators/disorder/50",
            "on particles out of place by a tenth the error of (50) stays",
            difference,
            series(1.3, FINE),
        )
        .equations(&["50"])
        .expect(Expected::Plateau { value: 0.048_522, tolerance: 0.05 })
        .mutant(DIFFERENCE),
        study::<f64, 2>(
            "operators/disorder/51",
            "on particles out of place by a tenth the error of (51) grows like 1/Δx",
            symmetric,
            series(1.3, FINE),
        )
        .equations(&["51"])
        .expect(Expected::order(-1.0, 0.15))
        .mutant(DIFFERENCE),
        study::<f64, 2>(
            "operators/disorder/laplacian",
            "on particles out of place by a tenth the error of the Laplacian grows like 1/Δx",
            Operator::Laplacian,
            series(1.3, FINE),
        )
        .expect(Expected::order(-1.0, 0.15))
        .mutant(HALF),
        study::<f64, 2>(
            "operators/disorder/corrected/1.3",
            "the corrected gradient converges at fixed disorder",
            Operator::Corrected,
            series(1.3, FINE),
        )
        .expect(at_least_one)
        .mutant(SWAPPED)
        .mutant(UNCORRECTED),
        study::<f64, 3>(
            "operators/disorder/corrected/3d",
            "the corrected gradient converges at fixed disorder",
            Operator::Corrected,
            series(1.3, SOLID),
        )
        .expect(at_least_one)
        .mutant(SWAPPED)
        .mutant(UNCORRECTED),
    ]
}

/// Relative L2 errors over the series.
fn errors<T: Real, const D: usize>(operator: Operator, series: Series, conditions: &Conditions) -> Measured {
    Measured::errors(series.sides.iter().map(|&side| {
        let arrangement = Arrangement::<D>::jittered(side, series.jitter, 1 + side as u64);
        (arrangement.spacing, error::<T, D>(operator, &arrangement, series.ratio, conditions))
    }))
}

/// The relative L2 error of one operator on one arrangement.
pub fn error<T: Real, const D: usize>(
    operator: Operator,
    arrangement: &Arrangement<D>,
    ratio: f64,
    conditions: &Conditions,
) -> f64 {
    let factor = if conditions.is(CONSTANT) { 1.01 } else { 1.0 };
    let kernel = WendlandC2::<T, D>::new(T::of(ratio * arrangement.spacing)).expect("a length");
    let bench = Bench::new(arrangement, Flawed::scaled(kernel, factor), true);
    let (cloud, values) = (bench.cloud(), bench.field(value));
    let places = || bench.x.iter().map(|x| x.as_f64());
    match operator {
        Operator::Normalised => {
            let measured = match conditions.is(UNCORRECTED) {
                true => cloud.interpolate(&values),
                false => cloud.interpolate_normalised(&values),
            };
            let measured: Vec<f64> = measured.into_iter().map(T::as_f64).collect();
            relative_l2(&measured, &places().map(value).collect::<Vec<_>>())
        }
        Operator::Laplacian => {
            let factor = if conditions.is(HALF) { 0.5 } else { 1.0 };
            let measured: Vec<f64> = cloud.laplacian(&values).iter().map(|x| factor * x.as_f64()).collect();
            let exact = |x| -4.0 * PI * PI * D as f64 * (value(x) - 2.0);
            relative_l2(&measured, &places().map(exact).collect::<Vec<_>>())
        }
        Operator::Gradient(_) | Operator::Corrected => {
            let measured = match operator {
                Operator::Gradient(form) => cloud.gradient(mutated(form, conditions), &values),
                _ => corrected(&cloud, &values, conditions),
            };
            let measured: Vec<f64> = measured.iter().flat_map(|g| g.as_f64()).collect();
            relative_l2(&measured, &places().flat_map(gradient).collect::<Vec<_>>())
        }
    }
}

fn mutated(form: Form, conditions: &Conditions) -> Form {
    match (conditions.is(DIFFERENCE), form) {
        (false, form) => form,
        (true, Form::Symmetric) => Form::Difference,
        (true, _) => Form::Symmetric,
    }
}

type Gradients<T, const D: usize> = Vec<alluvium::Vector<T, D>>;

fn corrected<T: Real, const D: usize>(
    cloud: &Cloud<'_, T, Flawed<WendlandC2<T, D>>, D>,
    values: &[T],
    conditions: &Conditions,
) -> Gradients<T, D> {
    if conditions.is(UNCORRECTED) {
        return cloud.gradient(Form::VolumeDifference, values);
    }
    let mut corrections: Corrections<T, D> = cloud.corrections();
    if conditions.is(SWAPPED) {
        for matrix in &mut corrections.matrices {
            matrix.swap(0, 1);
        }
    }
    cloud.corrected_gradient(&corrections, values)
}

/// f = 2 + sin 2πx cos 2πy (cos 2πz).
fn value<const D: usize>(x: [f64; D]) -> f64 {
    2.0 + (1..D).fold((2.0 * PI * x[0]).sin(), |f, k| f * (2.0 * PI * x[k]).cos())
}

fn gradient<const D: usize>(x: [f64; D]) -> [f64; D] {
    core::array::from_fn(|axis| {
        let factor = |k: usize| {
            let (sin, cos) = (2.0 * PI * x[k]).sin_cos();
            match (k == 0, k == axis) {
                (true, false) => sin,
                (true, true) => 2.0 * PI * cos,
                (false, false) => cos,
                (false, true) => -2.0 * PI * sin,
            }
        };
        (0..D).map(factor).product()
    })
}
