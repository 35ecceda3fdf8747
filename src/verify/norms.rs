//! How far apart two fields are.

/// `‖measured − exact‖₂ / ‖exact‖₂`; without a scale (all exact values zero) the root mean square
/// of the measured values. NaN if the lengths differ, so that no bar is met by accident.
pub fn relative_l2(measured: &[f64], exact: &[f64]) -> f64 {
    if measured.len() != exact.len() {
        return f64::NAN;
    }
    let (error, scale) = measured
        .iter()
        .zip(exact)
        .fold((0.0, 0.0), |(error, scale), (m, e)| (error + (m - e) * (m - e), scale + e * e));
    if scale > 0.0 { (error / scale).sqrt() } else { (error / measured.len() as f64).sqrt() }
}

/// `max |measured − exact|`. NaN if the lengths differ or anything is NaN.
pub fn l_infinity(measured: &[f64], exact: &[f64]) -> f64 {
    if measured.len() != exact.len() {
        return f64::NAN;
    }
    measured
        .iter()
        .zip(exact)
        .map(|(m, e)| (m - e).abs())
        .fold(0.0, |worst, error| if error.is_nan() || error > worst { error } else { worst })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_are_what_they_are_by_hand() {
        let (measured, exact) = ([1.0, 2.0, 3.0], [1.0, 0.0, 7.0]);
        assert_eq!(relative_l2(&measured, &exact), (20.0_f64 / 50.0).sqrt());
        assert_eq!(l_infinity(&measured, &exact), 4.0);
        assert_eq!(relative_l2(&[3.0, 4.0], &[0.0, 0.0]), (12.5_f64).sqrt());
    }

    #[test]
    fn nothing_wrong_looks_small() {
        assert!(relative_l2(&[1.0], &[1.0, 2.0]).is_nan() && l_infinity(&[], &[0.0]).is_nan());
        assert!(l_infinity(&[f64::NAN, 0.0], &[0.0; 2]).is_nan());
        assert!(l_infinity(&[0.0, f64::NAN, 1.0], &[0.0; 3]).is_nan());
        assert!(relative_l2(&[f64::NAN, 0.0], &[1.0; 2]).is_nan());
    }
}
