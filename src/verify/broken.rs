//! Studies run one after the other, for a test that is content or is not.

use super::{Outcome, Study};
use core::fmt;

/// Runs all studies as they are, without their mutants.
///
/// ```
/// use alluvium::{kernel::WendlandC2, verify};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// verify::all(verify::ready::kernel::<f64, 2, _>("Wendland C2", WendlandC2::new(0.013)?))?;
/// # Ok(()) }
/// ```
///
/// # Errors
/// At least one claim broke, or there was none.
pub fn all(studies: impl IntoIterator<Item = Study>) -> Result<(), Broken> {
    let (mut claims, mut count) = (Vec::new(), 0);
    for study in studies {
        count += 1;
        let outcome = study.run();
        if !outcome.passed() {
            claims.push((study.claim, outcome));
        }
    }
    if claims.is_empty() && count > 0 { Ok(()) } else { Err(Broken { claims, count }) }
}

/// Claims that do not hold, with what was measured instead.
#[derive(Clone)]
pub struct Broken {
    /// Each claim that broke, and its outcome.
    pub claims: Vec<(String, Outcome)>,
    /// How many studies there were.
    pub count: usize,
}

impl fmt::Display for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.count == 0 {
            return f.write_str("there was no study");
        }
        write!(f, "{} of {} claims broke", self.claims.len(), self.count)?;
        for (claim, outcome) in &self.claims {
            write!(f, "\n{}: {claim}: {}", outcome.study, outcome.sentence)?;
        }
        Ok(())
    }
}

/// The same text: it is what a test prints that returns it.
impl fmt::Debug for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl core::error::Error for Broken {}
