//! What a study expects, what it measured, and whether the one is the other.

use super::order::{fit_order, observed_orders};

/// What has to come out, decided before anything is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// The order between the two finest resolutions lies in this interval; it may be negative.
    Order {
        /// Smallest order accepted.
        at_least: f64,
        /// Largest order accepted.
        at_most: f64,
    },
    /// Every value is `value` within ± `tolerance`.
    Value {
        /// The value.
        value: f64,
        /// The largest deviation accepted.
        tolerance: f64,
    },
    /// Every magnitude is at most `largest`.
    Bound {
        /// The largest magnitude accepted.
        largest: f64,
    },
    /// The error stops falling: at the finest resolution it is `value` within the relative
    /// `tolerance`, and the last order is below one half either way.
    Plateau {
        /// The error that stays.
        value: f64,
        /// The largest relative deviation from it.
        tolerance: f64,
    },
    /// The error falls, if not in its asymptotic range: the order fitted over all resolutions lies in this
    /// interval, and at the finest the error is at most `largest`.
    Approach {
        /// Smallest fitted order accepted.
        at_least: f64,
        /// Largest fitted order accepted.
        at_most: f64,
        /// The largest error accepted at the finest resolution.
        largest: f64,
    },
    /// Nothing differs: every value, a number of differences, is zero.
    Identical,
}

/// One measured number.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What it belongs to.
    pub label: String,
    /// The resolution: a spacing or a time step; NaN where there is none.
    pub spacing: f64,
    /// The number.
    pub value: f64,
}

/// Rows of cells of text, the first of them the heading.
pub type Table = Vec<Vec<String>>;

/// What a study has measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// The numbers to be judged; errors from coarse to fine.
    pub points: Vec<Point>,
    /// Further findings, for the report only.
    pub notes: Vec<String>,
    /// Tables, for the report only.
    pub tables: Vec<Table>,
    /// Pictures (SVG), for the report only.
    pub pictures: Vec<String>,
}

impl Measured {
    /// Errors `(spacing, error)`, from coarse to fine.
    pub fn errors(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let point = |(spacing, value)| Point { label: String::new(), spacing, value };
        Self { points: points.into_iter().map(point).collect(), ..Self::default() }
    }
    /// Named values.
    pub fn values<L: Into<String>>(points: impl IntoIterator<Item = (L, f64)>) -> Self {
        let point = |(label, value): (L, f64)| Point { label: label.into(), spacing: f64::NAN, value };
        Self { points: points.into_iter().map(point).collect(), ..Self::default() }
    }
    /// One value.
    pub fn value(value: f64) -> Self {
        Self::values([("", value)])
    }
    /// Adds a finding for the report.
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }
    /// Adds a table for the report: its heading, and rows of as many cells.
    pub fn table<C: Into<String>, const N: usize>(
        mut self,
        heading: [C; N],
        rows: impl IntoIterator<Item = [String; N]>,
    ) -> Self {
        let heading: Vec<String> = heading.into_iter().map(Into::into).collect();
        self.tables.push(core::iter::once(heading).chain(rows.into_iter().map(Vec::from)).collect());
        self
    }
    /// Adds a picture for the report.
    pub fn picture(mut self, chart: &super::plot::Chart) -> Self {
        self.pictures.push(chart.svg());
        self
    }
    fn pairs(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|point| (point.spacing, point.value)).collect()
    }
    /// The observed orders between neighbouring resolutions; empty where there is no resolution.
    pub fn orders(&self) -> Vec<f64> {
        if self.points.iter().any(|point| point.spacing.is_nan()) {
            return Vec::new();
        }
        observed_orders(&self.pairs())
    }
}

impl Expected {
    /// An order within ± `tolerance`.
    pub fn order(order: f64, tolerance: f64) -> Self {
        Self::Order { at_least: order - tolerance, at_most: order + tolerance }
    }

    /// Whether the measured numbers are as expected, and a sentence about it. No number, or one
    /// that is not a number, is never as expected.
    pub fn judge(&self, measured: &Measured) -> (bool, String) {
        match *self {
            Self::Order { at_least, at_most } => {
                let last = measured.orders().last().copied().unwrap_or(f64::NAN);
                let fit = fit_order(&measured.pairs()).map_or(String::new(), |fit| {
                    format!(" (fit over {}: {:.3} ± {:.2})", measured.points.len(), fit.order, fit.half_width)
                });
                let sentence = format!("order {last:.3} between the two finest{fit}; {self}");
                ((at_least..=at_most).contains(&last), sentence)
            }
            Self::Plateau { value, tolerance } => {
                let error = measured.points.last().map_or(f64::NAN, |point| point.value);
                let order = measured.orders().last().copied().unwrap_or(f64::NAN);
                let met = (error - value).abs() <= tolerance * value.abs() && order.abs() < 0.5;
                (met, format!("error {error:.4e}, last order {order:.3}; {self}"))
            }
            Self::Approach { at_least, at_most, largest } => {
                let error = measured.points.last().map_or(f64::NAN, |point| point.value);
                let (order, half_width) = fit_order(&measured.pairs())
                    .map_or((f64::NAN, f64::NAN), |fit| (fit.order, fit.half_width));
                let met = (at_least..=at_most).contains(&order) && error <= largest;
                (met, format!("fitted order {order:.3} ± {half_width:.2}, error {error:.4e}; {self}"))
            }
            Self::Value { value, tolerance } => {
                let (worst, at) = farthest(measured, value);
                ((worst - value).abs() <= tolerance, format!("farthest value {worst:.10e}{at}; {self}"))
            }
            Self::Bound { largest } => {
                let (worst, at) = farthest(measured, 0.0);
                let worst = worst.abs();
                (worst <= largest, format!("largest magnitude {worst:.3e}{at}; {self}"))
            }
            Self::Identical => {
                let (worst, at) = farthest(measured, 0.0);
                let at = if worst == 0.0 { String::new() } else { at };
                (worst == 0.0, format!("{worst} differences{at}; {self}"))
            }
        }
    }
}

/// The value farthest from `centre`, and in brackets what it belongs to; NaN if any is, or if there is none.
fn farthest(measured: &Measured, centre: f64) -> (f64, String) {
    let farther =
        |a: &Point, b: &Point| b.value.is_nan() || (b.value - centre).abs() > (a.value - centre).abs();
    let worst = measured.points.iter().reduce(|a, b| if farther(a, b) { b } else { a });
    let label = worst.map_or("", |point| point.label.as_str());
    let label = if label.is_empty() { String::new() } else { format!(" ({label})") };
    (worst.map_or(f64::NAN, |point| point.value), label)
}

impl core::fmt::Display for Expected {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Order { at_least, at_most } if at_most.is_infinite() => {
                write!(f, "expected an order of at least {at_least}")
            }
            Self::Order { at_least, at_most } => {
                let (order, tolerance) = (0.5 * (at_least + at_most), 0.5 * (at_most - at_least));
                write!(f, "expected {order:.3} ± {tolerance:.3}")
            }
            Self::Value { value, tolerance } => write!(f, "expected {value} ± {}", short(*tolerance)),
            Self::Bound { largest } => write!(f, "expected at most {}", short(*largest)),
            Self::Plateau { value, tolerance } => {
                write!(f, "expected to stay at {value:.4e} ± {} %", 100.0 * tolerance)
            }
            Self::Approach { at_least, at_most, largest } => {
                let largest = short(*largest);
                write!(
                    f,
                    "expected a fitted order of {at_least:.2} to {at_most:.2} and at last at most {largest}"
                )
            }
            Self::Identical => write!(f, "expected none"),
        }
    }
}

/// In powers of ten, with all digits of a round number and four of another.
fn short(x: f64) -> String {
    let all = format!("{x:e}");
    if all.len() > 9 { format!("{x:.3e}") } else { all }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn met(expected: Expected, measured: &Measured) -> bool {
        expected.judge(measured).0
    }

    #[test]
    fn each_expectation_can_be_met_and_missed() {
        let second = Measured::errors([(0.2, 0.04), (0.1, 0.01)]);
        assert!(met(Expected::order(2.0, 0.1), &second));
        assert!(!met(Expected::order(1.0, 0.5), &second));
        let flat = Measured::errors([(0.2, 0.031), (0.1, 0.03)]);
        assert!(met(Expected::Plateau { value: 0.03, tolerance: 0.01 }, &flat));
        assert!(!met(Expected::Plateau { value: 0.02, tolerance: 0.01 }, &flat));
        assert!(!met(Expected::Plateau { value: 0.01, tolerance: 0.01 }, &second));
        let slow = Expected::Approach { at_least: 0.3, at_most: 1.0, largest: 0.04 };
        assert!(met(slow, &Measured::errors([(0.4, 0.06), (0.2, 0.045), (0.1, 0.035)])));
        assert!(!met(slow, &Measured::errors([(0.4, 0.07), (0.2, 0.055), (0.1, 0.045)])));
        assert!(!met(slow, &flat) && !met(slow, &second));
        let two = Measured::values([("a", 1.0), ("b", -1.1)]);
        assert!(met(Expected::Bound { largest: 1.2 }, &two) && !met(Expected::Bound { largest: 1.05 }, &two));
        let one = Measured::value(1.0);
        assert!(met(Expected::Value { value: 1.1, tolerance: 0.2 }, &one));
        assert!(!met(Expected::Value { value: 1.1, tolerance: 0.2 }, &two));
        assert!(met(Expected::Identical, &Measured::value(0.0)) && !met(Expected::Identical, &one));
    }

    #[test]
    fn nothing_and_nan_meet_no_expectation() {
        let all = [
            Expected::order(2.0, 1e9),
            Expected::Value { value: 0.0, tolerance: 1e9 },
            Expected::Bound { largest: 1e9 },
            Expected::Plateau { value: 1.0, tolerance: 1e9 },
            Expected::Approach { at_least: -1e9, at_most: 1e9, largest: 1e9 },
            Expected::Identical,
        ];
        let nan = f64::NAN;
        for expected in all {
            assert!(!met(expected, &Measured::default()));
            assert!(!met(expected, &Measured::errors([(0.2, nan), (0.1, nan)])));
            assert!(!met(expected, &Measured::values([("", 0.0), ("", nan), ("", 0.0)])));
            assert!(!met(expected, &Measured::values([("", nan), ("", 0.0)])));
        }
    }
}
