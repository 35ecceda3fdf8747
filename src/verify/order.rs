//! Observed orders of convergence (Roache 1998; Roy 2005).

/// The order between two resolutions, `p = ln(e₁/e₂) / ln(s₁/s₂)`: errors `e` at spacings `s`.
pub fn observed_order(coarse: (f64, f64), fine: (f64, f64)) -> f64 {
    (coarse.1 / fine.1).ln() / (coarse.0 / fine.0).ln()
}

/// The order between each two neighbouring points `(spacing, error)`, from coarse to fine.
pub fn observed_orders(points: &[(f64, f64)]) -> Vec<f64> {
    points.windows(2).map(|pair| observed_order(pair[0], pair[1])).collect()
}

/// A line through `(ln spacing, ln error)` by least squares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrderFit {
    /// The slope: the order over all resolutions.
    pub order: f64,
    /// Half the width of its 95 % confidence interval (Student's t); infinite with two points.
    pub half_width: f64,
    /// The constant `C` of `error = C · spacing^order`.
    pub constant: f64,
}

/// Fits an order to two or more points `(spacing, error)` of positive numbers.
pub fn fit_order(points: &[(f64, f64)]) -> Option<OrderFit> {
    if points.len() < 2 || points.iter().any(|&(s, e)| !(s > 0.0 && e > 0.0 && e.is_finite())) {
        return None;
    }
    let count = points.len() as f64;
    let logs: Vec<_> = points.iter().map(|&(s, e)| (s.ln(), e.ln())).collect();
    let (mean_x, mean_y) = logs.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / count, b + y / count));
    let sxx: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    let sxy: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    if sxx == 0.0 {
        return None;
    }
    let order = sxy / sxx;
    let residual: f64 = logs.iter().map(|(x, y)| (y - mean_y - order * (x - mean_x)).powi(2)).sum();
    let free = points.len() - 2;
    let half_width =
        if free == 0 { f64::INFINITY } else { student_t(free) * (residual / free as f64 / sxx).sqrt() };
    Some(OrderFit { order, half_width, constant: (mean_y - order * mean_x).exp() })
}

/// The 97.5 % quantile of Student's t distribution.
fn student_t(free: usize) -> f64 {
    const TABLE: [f64; 10] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];
    // Beyond the table: the normal quantile and its first two corrections in 1/free.
    let n = free as f64;
    TABLE.get(free - 1).copied().unwrap_or(1.959_964 + 2.372_27 / n + 2.8225 / (n * n))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_gives_back_its_power() {
        let points: Vec<_> = [0.4, 0.2, 0.1, 0.03].map(|s: f64| (s, 7.0 * s.powf(1.7))).into();
        assert!(observed_orders(&points).iter().all(|p| (p - 1.7).abs() < 1e-13));
        let fit = fit_order(&points).unwrap();
        assert!((fit.order - 1.7).abs() < 1e-13 && fit.half_width < 1e-12);
        assert!((fit.constant - 7.0).abs() < 1e-11);
    }

    #[test]
    fn a_floor_shows_in_the_last_pair_and_in_the_interval() {
        let points: Vec<_> = [0.4, 0.2, 0.1, 0.05].map(|s: f64| (s, s * s + 0.01)).into();
        let orders = observed_orders(&points);
        assert!(orders.is_sorted_by(|a, b| a > b) && orders[2] < 0.7);
        // Errors .17, .05, .02, .0125: slope (1.5 ln(.17/.0125) + .5 ln(.05/.02)) / (5 ln 2).
        let slope = (1.5 * 13.6_f64.ln() + 0.5 * 2.5_f64.ln()) / (5.0 * 2.0_f64.ln());
        let fit = fit_order(&points).unwrap();
        assert!((fit.order - slope).abs() < 1e-12 && fit.half_width > 0.5);
    }

    #[test]
    fn the_interval_is_that_of_a_regression_by_hand() {
        // ln s = 0, 1, 2 and ln e = 0, 1, 3: slope 3/2, residual 1/6, s² = 1/6, sxx = 2.
        let e = core::f64::consts::E;
        let fit = fit_order(&[(1.0, 1.0), (e, e), (e * e, e * e * e)]).unwrap();
        assert!((fit.order - 1.5).abs() < 1e-12);
        assert!((fit.half_width - 12.706 * (1.0_f64 / 12.0).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn what_has_no_order_gets_none() {
        assert_eq!(fit_order(&[(0.1, 1.0)]), None);
        assert_eq!(fit_order(&[(0.1, 1.0), (0.1, 2.0)]), None);
        assert_eq!(fit_order(&[(0.1, 1.0), (0.2, f64::NAN)]), None);
        assert!(fit_order(&[(0.1, 1.0), (0.2, 2.0)]).unwrap().half_width.is_infinite());
        assert!((student_t(11) - 2.201).abs() < 3e-3 && (student_t(30) - 2.042).abs() < 1e-3);
    }
}
