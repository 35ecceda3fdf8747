//! A front in time, and how far it is from another.

/// Times and places, both without dimension, times ascending.
#[derive(Clone, Debug)]
pub struct Front(pub Vec<(f64, f64)>);

impl Front {
    /// Where the front is at `time`, between two known points; none outside them.
    pub fn at(&self, time: f64) -> Option<f64> {
        let next = self.0.iter().position(|p| p.0 >= time)?;
        let b = self.0[next];
        if b.0 == time || next == 0 {
            return (b.0 == time).then_some(b.1);
        }
        let a = self.0[next - 1];
        Some(a.1 + (b.1 - a.1) * (time - a.0) / (b.0 - a.0))
    }

    /// Root mean square of the difference to `other` at its points in `from..to`, this front moved in time
    /// by the one shift that makes it least; with the shift. Before its first point a front rests there.
    pub fn distance(&self, other: &Self, from: f64, to: f64) -> Option<(f64, f64)> {
        let start = *self.0.first()?;
        let shifts = (-500..=500).map(|n| f64::from(n) * 1e-3);
        let rms = |shift: f64| {
            let points = other.0.iter().filter(|p| p.0 >= from && p.0 <= to);
            let place = |time: f64| if time < start.0 { Some(start.1) } else { self.at(time) };
            let squares: Option<Vec<f64>> =
                points.map(|p| Some((place(p.0 + shift)? - p.1).powi(2))).collect();
            let squares = squares.filter(|squares| !squares.is_empty())?;
            Some(((squares.iter().sum::<f64>() / squares.len() as f64).sqrt(), shift))
        };
        shifts.filter_map(rms).min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// How far `front` leaves the envelope of `others` in `from..to`: zero if it stays inside.
pub fn outside(front: &Front, others: &[&Front], from: f64, to: f64) -> f64 {
    let points = front.0.iter().filter(|p| p.0 > from && p.0 < to);
    let beyond = points.map(|(time, place)| {
        let known: Vec<f64> = others.iter().filter_map(|other| other.at(*time)).collect();
        let low = known.iter().copied().fold(f64::INFINITY, f64::min);
        let high = known.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (low - place).max(place - high).max(0.0)
    });
    beyond.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parabola(shift: f64) -> Front {
        let point = |n| (0.05 * f64::from(n), 1.0 + 0.4 * (0.05 * f64::from(n) + shift).powi(2));
        Front((0..=80).map(point).collect())
    }

    #[test]
    fn a_shift_in_time_is_found() {
        let (rms, shift) = parabola(0.0).distance(&parabola(0.2), 0.5, 2.5).unwrap();
        assert!(rms < 1e-3 && (shift - 0.2).abs() < 2e-3, "{rms} {shift}");
    }

    #[test]
    fn leaving_an_envelope_is_measured() {
        let (low, high) = (parabola(-0.1), parabola(0.1));
        assert_eq!(outside(&parabola(0.0), &[&low, &high], 1.0, 2.9), 0.0);
        let by = outside(&parabola(0.2), &[&low, &high], 1.0, 2.0);
        assert!((by - 0.4 * (2.15_f64.powi(2) - 2.05_f64.powi(2))).abs() < 1e-3, "{by}");
        assert_eq!(low.at(100.0), None);
    }
}
