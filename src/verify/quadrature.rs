//! Integrals to the last digits, of functions with corners at unknown places.

use core::f64::consts::PI;

/// Nodes of a panel.
const NODES: usize = 16;

/// `∫ f dx` from `low` to `high` by Gauss's rule with 16 nodes, on panels that are halved until that changes
/// their mean by no more than `noise`, the rounding of f.
pub fn integrate(low: f64, high: f64, noise: f64, f: &dyn Fn(f64) -> f64) -> f64 {
    let rule = gauss();
    let panel = |low: f64, high: f64| {
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        half * rule.iter().map(|(x, weight)| weight * f(centre + half * x)).sum::<f64>()
    };
    refined(low, high, panel(low, high), noise, DEEPEST, &panel)
}

/// Halvings at most: a corner costs as many, and noise on every panel stays bearable.
const DEEPEST: u32 = 14;

fn refined(low: f64, high: f64, whole: f64, noise: f64, deeper: u32, panel: &dyn Fn(f64, f64) -> f64) -> f64 {
    let centre = 0.5 * (low + high);
    let (left, right) = (panel(low, centre), panel(centre, high));
    if deeper == 0 || (left + right - whole).abs() <= noise * (high - low) {
        return left + right;
    }
    refined(low, centre, left, noise, deeper - 1, panel)
        + refined(centre, high, right, noise, deeper - 1, panel)
}

/// Nodes and weights of Gauss's rule: zeros of a Legendre polynomial by Newton.
fn gauss() -> [(f64, f64); NODES] {
    core::array::from_fn(|k| {
        let mut x = (PI * (k as f64 + 0.75) / (NODES as f64 + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..8 {
            let (mut p, mut previous) = (x, 1.0);
            for n in 2..=NODES {
                let n = n as f64;
                (p, previous) = (((2.0 * n - 1.0) * x * p - (n - 1.0) * previous) / n, p);
            }
            slope = NODES as f64 * (x * p - previous) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_and_corners() {
        let power = integrate(0.0, 2.0, 1e-16, &|x| x.powi(15));
        assert!((power / 4096.0 - 1.0).abs() < 1e-15, "{power}");
        // A corner in the third derivative, at a place no halving meets.
        let corner = integrate(0.0, 1.0, 1e-16, &|x| (x - 1.0 / PI).max(0.0).powi(3));
        assert!((corner / (0.25 * (1.0 - 1.0 / PI).powi(4)) - 1.0).abs() < 1e-14, "{corner}");
    }
}
