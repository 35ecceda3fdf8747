//! Errors against resolution, with the fitted and an expected slope.

use super::chart::{Chart, Series};
use crate::verify::{OrderFit, fit_order};

/// A log–log chart of `errors`, pairs of resolution and error, the least-squares line through them and a
/// line of the `expected` order, if one is; returns the chart and the fit, if there is one.
pub fn convergence_chart(
    labels: [&str; 3],
    errors: &[(f64, f64)],
    expected: Option<f64>,
) -> (Chart, Option<OrderFit>) {
    let fit = fit_order(errors);
    let ends = errors.iter().fold((f64::MAX, f64::MIN), |(a, b), p| (a.min(p.0), b.max(p.0)));
    let line = |order: f64, factor: f64| [ends.0, ends.1].map(|x| (x, factor * x.powf(order))).to_vec();
    let [title, x_label, y_label] = labels;
    let mut chart = Chart::new(title, x_label, y_label).logarithmic(true, true);
    if let Some(OrderFit { order, constant, .. }) = fit {
        chart = chart.with(Series::line(&format!("fit: order {order:.2}"), line(order, constant)));
    }
    if let Some(order) = expected {
        let below = errors.iter().map(|p| p.1 / p.0.powf(order)).fold(f64::MAX, f64::min) * 0.75;
        chart = chart.with(Series::dashed(&format!("order {order}"), line(order, below)).coloured("#777777"));
    }
    (chart.with(Series::points("measured", errors.to_vec()).coloured("#0072b2")), fit)
}

/// The same as a picture, against one order.
pub fn convergence(
    title: &str,
    x_label: &str,
    y_label: &str,
    errors: &[(f64, f64)],
    expected: f64,
) -> (String, Option<OrderFit>) {
    let (chart, fit) = convergence_chart([title, x_label, y_label], errors, Some(expected));
    (chart.svg(), fit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_a_power_is_found() {
        let errors: Vec<_> = [0.01, 0.005, 0.0025].iter().map(|x: &f64| (*x, 3.0 * x.powf(1.7))).collect();
        let (svg, fit) = convergence("t", "x", "e", &errors, 2.0);
        assert!((fit.unwrap().order - 1.7).abs() < 1e-12);
        assert!(svg.contains("fit: order 1.70"));
    }
}
