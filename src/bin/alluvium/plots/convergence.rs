//! Errors against resolution, with the fitted and an expected slope.

use super::chart::{Chart, Series};

/// A log–log chart of `errors`, pairs of resolution and error, the least-squares line through them and a
/// line of the `expected` order; returns the picture and the fitted order.
pub fn convergence(
    title: &str,
    x_label: &str,
    y_label: &str,
    errors: &[(f64, f64)],
    expected: f64,
) -> (String, f64) {
    let (order, factor) = fit(errors);
    let ends = errors.iter().fold((f64::MAX, f64::MIN), |(a, b), p| (a.min(p.0), b.max(p.0)));
    let line =
        |order: f64, factor: f64| vec![ends.0, ends.1].into_iter().map(move |x| (x, factor * x.powf(order)));
    let below = errors.iter().map(|p| p.1 / p.0.powf(expected)).fold(f64::MAX, f64::min) * 0.75;
    let chart = Chart::new(title, x_label, y_label)
        .logarithmic(true, true)
        .with(Series::line(&format!("fit: order {order:.2}"), line(order, factor).collect()))
        .with(
            Series::dashed(&format!("order {expected}"), line(expected, below).collect()).coloured("#777777"),
        )
        .with(Series::points("measured", errors.to_vec()).coloured("#0072b2"));
    (chart.svg(), order)
}

/// Order and factor of the least-squares line through the logarithms.
fn fit(errors: &[(f64, f64)]) -> (f64, f64) {
    let n = errors.len() as f64;
    let logs: Vec<_> = errors.iter().map(|(x, e)| (x.ln(), e.max(1e-300).ln())).collect();
    let mean = logs.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let spread: f64 = logs.iter().map(|p| (p.0 - mean.0).powi(2)).sum();
    let shared: f64 = logs.iter().map(|p| (p.0 - mean.0) * (p.1 - mean.1)).sum();
    let order = if spread > 0.0 { shared / spread } else { 0.0 };
    (order, (mean.1 - order * mean.0).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_a_power_is_found() {
        let errors: Vec<_> = [0.01, 0.005, 0.0025].iter().map(|x: &f64| (*x, 3.0 * x.powf(1.7))).collect();
        let (svg, order) = convergence("t", "x", "e", &errors, 2.0);
        assert!((order - 1.7).abs() < 1e-12);
        assert!(svg.contains("fit: order 1.70"));
    }
}
