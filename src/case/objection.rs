//! What whoever runs a case has against it.

use super::model::Case;
use super::problem::CaseError;
use super::read;
use super::reader::Reader;
use core::fmt;

/// Why a case that can be read cannot be run by somebody: the library allows more than a program may.
///
/// ```
/// use alluvium::case::Objection;
/// let text = "name = \"drop\"\nend_time_s = 0.1\nparticles.spacing_m = 0.01\n\
///     water.block = [{ low_m = [0.0, 0.0], high_m = [0.2, 0.2] }]\n";
/// let objection = Objection {
///     key: "particles.spacing_m".to_owned(),
///     why: "is finer than this machine bears".to_owned(),
///     allowed: "at least 0.02 m".to_owned(),
/// };
/// let shown = objection.shown_in("drop.toml", text).to_string();
/// assert!(shown.starts_with("error: `particles.spacing_m = 0.01` is finer than this machine bears\n"));
/// assert!(shown.contains("--> drop.toml:3:23"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objection {
    /// The key, with its tables, as in `particles.kernel`.
    pub key: String,
    /// Completes the sentence "`key = value` …".
    pub why: String,
    /// What is allowed instead.
    pub allowed: String,
}

impl Objection {
    /// The objection where the value stands in the case's `text`, or its table where it is left to a default;
    /// `file` is the name used in messages.
    pub fn shown_in(&self, file: &str, text: &str) -> CaseError {
        let reader = Reader::new(text);
        reader.with_root(|root| -> Case { read::case(&reader, root) });
        reader.error(&self.key, &self.why, self.allowed.clone());
        CaseError { file: file.to_owned(), problems: reader.finish().0 }
    }
}

impl fmt::Display for Objection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` {}; allowed: {}", self.key, self.why, self.allowed)
    }
}
