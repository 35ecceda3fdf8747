//! A case file, kept to show what is wrong with it where it stands.

use crate::outcome::Failure;
use alluvium::case::{Case, Warnings};
use std::path::Path;

/// A case file as it was read.
pub struct CaseFile {
    name: String,
    text: String,
}

impl CaseFile {
    /// Its text.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let unreadable = |error| Failure::Usage(format!("cannot read {name}: {error}"));
        let text = std::fs::read_to_string(path).map_err(unreadable)?;
        Ok(Self { name, text })
    }

    /// The case in it.
    pub fn case(&self) -> Result<(Case, Warnings), Failure> {
        Ok(Case::parse(&self.name, &self.text)?)
    }

    /// The failure, with the line of what the case was refused for.
    pub fn placed(&self, failure: Failure) -> Failure {
        match failure {
            Failure::Refused(objection) => Failure::Case(objection.shown_in(&self.name, &self.text)),
            other => other,
        }
    }
}
