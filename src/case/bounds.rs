//! The numbers a key allows.

use core::fmt;

/// An interval of numbers, with its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    low: f64,
    low_included: bool,
    high: f64,
    unit: &'static str,
}

/// Above zero, at most `high`.
pub(super) const fn positive(high: f64, unit: &'static str) -> Bounds {
    Bounds { low: 0.0, low_included: false, high, unit }
}

/// From `low` to `high`, both included.
pub(super) const fn from_to(low: f64, high: f64, unit: &'static str) -> Bounds {
    Bounds { low, low_included: true, high, unit }
}

impl Bounds {
    pub(super) fn contains(&self, x: f64) -> bool {
        x.is_finite() && x <= self.high && (x > self.low || (self.low_included && x == self.low))
    }
}

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { low, low_included, high, .. } = *self;
        let show = |x: f64| if x.abs() < 1e5 { format!("{x:?}") } else { format!("{x:e}") };
        let unit = if self.unit.is_empty() { String::new() } else { format!(" [{}]", self.unit) };
        match low_included {
            false => write!(f, "a number above {}, at most {}{unit}", show(low), show(high)),
            true => write!(f, "a number from {} to {}{unit}", show(low), show(high)),
        }
    }
}
