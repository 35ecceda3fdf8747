//! The tools that judge convergence, on what is known exactly: the order's confidence interval, Richardson
//! extrapolation, the grid convergence index.

use alluvium::verify::{
    Conditions, Expected, Measured, Random, Richardson, Study, fit_order, gci_of_two, observed_order,
};

const NORMAL: &str = "quantile of the normal distribution for Student's";
const FIRST: &str = "extrapolated as if of first order";
const NO_SAFETY: &str = "index without its factor of safety";
const SWAPPED: &str = "coarse and fine exchanged in the order";

pub fn studies() -> Vec<Study> {
    vec![confidence(), order(), extrapolated(), index()]
}

/// Draws of each number of resolutions.
const DRAWS: usize = 20_000;

fn confidence() -> Study {
    Study::new(
        "verify/order/confidence",
        "the 95 % interval of an order holds the true one in 95 of 100 cases, where errors are of that order but \
         for scatter (values: part of 20 000 draws, by resolutions)",
        |conditions| {
            Measured::values([3, 4, 5, 8].map(|count| (format!("{count}"), coverage(count, conditions))))
        },
    )
    .source("Student's t for a regression with normal scatter; bar: five standard deviations of the count")
    .expect(Expected::Value { value: 0.95, tolerance: 5.0 * (0.95 * 0.05 / DRAWS as f64).sqrt() })
    .mutant(NORMAL)
}

/// How often the interval of `count` resolutions holds the order.
fn coverage(count: usize, conditions: &Conditions) -> f64 {
    const ORDER: f64 = 1.7;
    const SCATTER: f64 = 0.1;
    // 97.5 % quantiles of Student's t at 1, 2, 3, 6 degrees of freedom.
    let student = match count {
        3 => 12.706,
        4 => 4.303,
        5 => 3.182,
        _ => 2.447,
    };
    let narrower = if conditions.is(NORMAL) { 1.96 / student } else { 1.0 };
    let mut random = Random::new(71);
    let mut normal = || {
        let (u, v) = (1.0 - random.between(0.0, 1.0), random.between(0.0, core::f64::consts::TAU));
        (-2.0 * u.ln()).sqrt() * v.cos() // Box & Muller
    };
    let holds = |_: &usize| {
        let point = |k: usize| {
            let spacing = 0.5_f64.powi(k as i32);
            (spacing, spacing.powf(ORDER) * (SCATTER * normal()).exp())
        };
        let points: Vec<_> = (0..count).map(point).collect();
        let fit = fit_order(&points).expect("positive errors");
        (fit.order - ORDER).abs() <= narrower * fit.half_width
    };
    (0..DRAWS).filter(holds).count() as f64 / DRAWS as f64
}

/// The integral of eˣ over 0…1 by trapezoids of this width: of second order, the next term of fourth.
fn trapezoids(width: f64) -> f64 {
    let count = (1.0 / width).round() as usize;
    let inner: f64 = (1..count).map(|k| (k as f64 * width).exp()).sum();
    width * (inner + 0.5 * (1.0 + 1_f64.exp()))
}

const EXACT: f64 = core::f64::consts::E - 1.0;
const WIDTHS: [f64; 4] = [1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0];

/// Of three widths each twice the one before, the finest first.
fn three(finest: f64) -> Richardson {
    Richardson::new([finest, 2.0 * finest, 4.0 * finest].map(trapezoids), 2.0, 2.0)
}

fn order() -> Study {
    Study::new(
        "verify/order/observed",
        "the order of trapezoids is two, from errors and, no solution known, from three widths (values: orders)",
        |conditions| {
            let error = |width: f64| (width, trapezoids(width) - EXACT);
            let [coarse, fine] = [WIDTHS[2], WIDTHS[3]].map(error);
            let of_errors = match conditions.is(SWAPPED) {
                true => observed_order((coarse.0, fine.1), (fine.0, coarse.1)),
                false => observed_order(coarse, fine),
            };
            Measured::values([("errors", of_errors), ("three widths", three(WIDTHS[3]).observed_order)])
        },
    )
    .source("Euler and Maclaurin: error = h²(e − 1)/12 − h⁴(e − 1)/720 + …; at h = 1/64 the second is 4e-6 of the first")
    .expect(Expected::Value { value: 2.0, tolerance: 1e-4 })
    .mutant(SWAPPED)
}

fn extrapolated() -> Study {
    Study::new(
        "verify/richardson/limit",
        "what trapezoids are extrapolated to is of fourth order",
        |conditions| {
            Measured::errors(WIDTHS.map(|width| {
                let [fine, coarse] = [width, 2.0 * width].map(trapezoids);
                let limit = match conditions.is(FIRST) {
                    true => fine + (fine - coarse),
                    false => three(width).extrapolated,
                };
                (width, (limit - EXACT).abs())
            }))
        },
    )
    .source("Richardson 1911: the term of second order cancels")
    .expect(Expected::order(4.0, 0.1))
    .mutant(FIRST)
}

fn index() -> Study {
    Study::new(
        "verify/richardson/index",
        "the grid convergence index is the factor of safety times the relative error it bounds, 1.25 with three \
         widths and 3 with two (values: index over error, over the factor)",
        |conditions| {
            let safety = if conditions.is(NO_SAFETY) { [1.25, 3.0] } else { [1.0, 1.0] };
            let finest = WIDTHS[3];
            let error = (trapezoids(finest) / EXACT - 1.0).abs();
            let of_two = gci_of_two(trapezoids(finest), trapezoids(2.0 * finest), 2.0, 2.0);
            let of_three = three(finest);
            Measured::values([
                ("three widths", of_three.gci_fine / error / 1.25 / safety[0]),
                ("two widths", of_two / error / 3.0 / safety[1]),
                ("asymptotic ratio", of_three.asymptotic_ratio),
            ])
        },
    )
    .source("Roache 1994; at these widths the next term of the error is below 1e-4 of the first")
    .expect(Expected::Value { value: 1.0, tolerance: 2e-3 })
    .mutant(NO_SAFETY)
}
