//! From quantities to places on an axis.

/// An axis' range, linear or logarithmic, and the places it maps to.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
    from: f64,
    to: f64,
}

impl Scale {
    /// The range `low..high` on the places `from..to`.
    pub fn linear((low, high): (f64, f64), (from, to): (f64, f64)) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        Self { low, high, logarithmic: false, from, to }
    }

    /// The same, in decades.
    pub fn logarithmic((low, high): (f64, f64), places: (f64, f64)) -> Self {
        let low = if low > 0.0 { low } else { 1e-300 };
        let high = if high > low { high } else { 10.0 * low };
        Self { logarithmic: true, ..Self::linear((low.log10(), high.log10()), places) }
    }

    /// Where `x` is.
    pub fn place(&self, x: f64) -> f64 {
        let x = if self.logarithmic { x.max(1e-300).log10() } else { x };
        self.from + (x - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Whether `x` is in the range, give or take a rounding error.
    pub fn contains(&self, x: f64) -> bool {
        let x = if self.logarithmic { x.max(1e-300).log10() } else { x };
        let slack = 1e-6 * (self.high - self.low);
        x >= self.low - slack && x <= self.high + slack
    }

    /// Round values in the range, about `count` of them, with their labels.
    pub fn ticks(&self, count: usize) -> Vec<(f64, String)> {
        if self.logarithmic { self.decades() } else { self.round_steps(count) }
    }

    fn round_steps(&self, count: usize) -> Vec<(f64, String)> {
        let rough = (self.high - self.low) / count.max(1) as f64;
        let decade = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 2.5, 5.0, 10.0].map(|m| m * decade).into_iter().find(|s| *s >= 0.999 * rough);
        let step = step.unwrap_or(10.0 * decade);
        let digits = (0..12).find(|d| is_round(step * 10f64.powi(*d))).unwrap_or(12) as usize;
        let (first, last) =
            ((self.low / step - 1e-6).ceil() as i64, (self.high / step + 1e-6).floor() as i64);
        (first..=last).map(|n| (n as f64 * step, label(n as f64 * step, digits))).collect()
    }

    fn decades(&self) -> Vec<(f64, String)> {
        let marks: &[f64] = match self.high - self.low {
            span if span > 4.0 => &[1.0],
            span if span > 1.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
        };
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let all = decades.flat_map(|n| marks.iter().map(move |m| m * 10f64.powi(n)));
        all.filter(|x| self.contains(*x)).map(|x| (x, scientific(x))).collect()
    }
}

fn is_round(x: f64) -> bool {
    (x - x.round()).abs() < 1e-6 * x.abs().max(1.0)
}

fn label(x: f64, digits: usize) -> String {
    let x = if x.abs() < 1e-12 { 0.0 } else { x };
    format!("{x:.digits$}").replace('-', "−")
}

/// Plain for handy numbers, else with a power of ten.
fn scientific(x: f64) -> String {
    if (1e-4..1e5).contains(&x) {
        return format!("{}", (x * 1e9).round() / 1e9);
    }
    let exponent = x.log10().floor() as i32;
    let raised: String = exponent.to_string().chars().map(raise).collect();
    let factor = (x / 10f64.powi(exponent) * 1e6).round() / 1e6;
    if factor == 1.0 { format!("10{raised}") } else { format!("{factor}·10{raised}") }
}

fn raise(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => char::from_u32(u32::from(other) - u32::from('0') + 0x2070).unwrap_or(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let labels = |low, high| {
            let ticks = Scale::linear((low, high), (0.0, 100.0)).ticks(5);
            ticks.into_iter().map(|(_, label)| label).collect::<Vec<_>>()
        };
        assert_eq!(labels(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(-0.3, 0.3), ["−0.2", "0.0", "0.2"]);
        assert_eq!(labels(0.0, 0.0125), ["0.0000", "0.0025", "0.0050", "0.0075", "0.0100", "0.0125"]);
        assert_eq!(labels(0.0, 4000.0), ["0", "1000", "2000", "3000", "4000"]);
    }

    #[test]
    fn decades_are_marked() {
        let ticks = Scale::logarithmic((1e-6, 1e-1), (0.0, 1.0)).ticks(5);
        let labels: Vec<_> = ticks.iter().map(|(_, label)| label.as_str()).collect();
        assert_eq!(labels, ["10⁻⁶", "10⁻⁵", "0.0001", "0.001", "0.01", "0.1"]);
    }
}
