//! Curves as points, and how far one is from another.

/// A curve `y(x)`, straight between its points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    points: Vec<(f64, f64)>,
}

impl Curve {
    /// A curve through points in ascending order of x.
    pub fn new(points: Vec<(f64, f64)>) -> Self {
        Self { points }
    }

    /// Adds a point behind the last.
    pub fn push(&mut self, x: f64, y: f64) {
        self.points.push((x, y));
    }

    /// Its points.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// Its value at `x`; `None` outside.
    pub fn at(&self, x: f64) -> Option<f64> {
        let after = self.points.partition_point(|p| p.0 < x);
        let right = *self.points.get(after)?;
        if right.0 == x {
            return Some(right.1);
        }
        let left = *self.points.get(after.checked_sub(1)?)?;
        Some(left.1 + (right.1 - left.1) * (x - left.0) / (right.0 - left.0))
    }

    /// The part of it between two `x`, ends included.
    pub fn between(&self, from: f64, to: f64) -> Self {
        Self::new(self.points.iter().copied().filter(|p| (from..=to).contains(&p.0)).collect())
    }

    /// How far its points leave the envelope of `others` at most: zero if it stays inside. Where only
    /// some of them are known, those make the envelope.
    pub fn beyond(&self, others: &[&Self]) -> f64 {
        let beyond = self.points.iter().map(|&(x, value)| {
            let known = || others.iter().filter_map(|other| other.at(x));
            let (low, high) =
                (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
            (low - value).max(value - high).max(0.0)
        });
        // Where nothing is known, nothing can be said.
        beyond.filter(|x| x.is_finite()).fold(0.0, f64::max)
    }

    /// Root mean square of its distance from `reference`'s points, each `shift` later, and how many
    /// points had a counterpart.
    pub fn distance(&self, reference: &Self, shift: f64) -> (f64, usize) {
        let errors: Vec<f64> =
            reference.points.iter().filter_map(|&(x, value)| Some(self.at(x + shift)? - value)).collect();
        let mean = errors.iter().map(|e| e * e).sum::<f64>() / errors.len().max(1) as f64;
        (mean.sqrt(), errors.len())
    }

    /// The shift of `reference` between −0.5 and 0.5 that fits best, with what then remains; at
    /// least nine tenths of the points must have a counterpart.
    pub fn best_shift(&self, reference: &Self) -> (f64, f64) {
        let enough = reference.points.len() * 9 / 10;
        (-500..=500)
            .map(|k| f64::from(k) * 1e-3)
            .map(|shift| (shift, self.distance(reference, shift)))
            .filter(|(_, (_, count))| *count >= enough)
            .map(|(shift, (rms, _))| (shift, rms))
            .fold((0.0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parabola(shift: f64) -> Curve {
        let point = |n| (0.05 * f64::from(n), 1.0 + 0.4 * (0.05 * f64::from(n) + shift).powi(2));
        Curve::new((0..=80).map(point).collect())
    }

    #[test]
    fn a_shift_is_found() {
        let (shift, rms) = parabola(0.0).best_shift(&parabola(0.2).between(0.5, 2.5));
        assert!(rms < 1e-3 && (shift - 0.2).abs() < 2e-3, "{rms} {shift}");
    }

    #[test]
    fn leaving_an_envelope_is_measured() {
        let (low, high) = (parabola(-0.1), parabola(0.1));
        // The parabolas cross near their feet.
        assert_eq!(parabola(0.0).between(0.2, 4.0).beyond(&[&low, &high]), 0.0);
        let by = parabola(0.2).between(1.0, 1.951).beyond(&[&low, &high]);
        assert!((by - 0.4 * (2.15_f64.powi(2) - 2.05_f64.powi(2))).abs() < 1e-3, "{by}");
        assert_eq!(low.at(100.0), None);
    }
}
