//! Rates and frequencies from time series.

use nalgebra::{Matrix4, Vector4};

/// A value over time.
pub type Series = Vec<(f64, f64)>;

/// The rate `r` of `y ∝ e^{rt}`, by least squares on the logarithm.
pub fn growth_rate(series: &[(f64, f64)]) -> f64 {
    let n = series.len() as f64;
    let (t, y) = series.iter().fold((0.0, 0.0), |(t, y), p| (t + p.0 / n, y + p.1.ln() / n));
    let (up, down) = series
        .iter()
        .fold((0.0, 0.0), |(up, down), p| (up + (p.0 - t) * (p.1.ln() - y), down + (p.0 - t) * (p.0 - t)));
    up / down
}

/// `e^{−γt} (a cos ωt + b sin ωt)`.
#[derive(Clone, Copy, Debug)]
pub struct Oscillation {
    pub frequency: f64,
    pub damping: f64,
}

/// Fits a damped oscillation by Gauss–Newton, from a guess of its frequency.
pub fn oscillation(series: &[(f64, f64)], frequency: f64) -> Oscillation {
    // a, b, ω, γ
    let mut p = Vector4::new(0.0, 0.0, frequency, 0.0);
    for round in 0..50 {
        let (mut normal, mut right) = (Matrix4::zeros(), Vector4::zeros());
        for &(t, y) in series {
            let (sin, cos) = (p[2] * t).sin_cos();
            let decay = (-p[3] * t).exp();
            let model = decay * (p[0] * cos + p[1] * sin);
            let turn = decay * t * (p[1] * cos - p[0] * sin);
            let row = Vector4::new(decay * cos, decay * sin, turn, -t * model);
            normal += row * row.transpose();
            right += row * (y - model);
        }
        if round == 0 {
            // The amplitudes first: without them nothing depends on the frequency.
            (normal[(2, 2)], normal[(3, 3)]) = (1.0, 1.0);
        }
        let Some(change) = normal.lu().solve(&right) else { break };
        p += change;
    }
    Oscillation { frequency: p[2].abs(), damping: p[3] }
}
