//! How a command can fail, and the exit code of each way.

use alluvium::case::{CaseError, Objection};
use alluvium::error::ParameterError;
use core::fmt;
use std::io;

/// Why a command did not do what it was asked.
#[derive(Debug)]
pub enum Failure {
    /// A file could not be read or written.
    File(io::Error),
    /// The command cannot be carried out as given.
    Usage(String),
    /// The case cannot be run.
    Case(CaseError),
    /// No such law.
    Law(ParameterError),
    /// The case can be read, but not run by this program.
    Refused(Objection),
    /// The numbers went wrong; the message names what, where and when.
    Numerical(String),
    /// Ctrl-C or SIGTERM; the last state was written.
    Interrupted {
        /// The exit code of that signal.
        code: u8,
    },
}

impl Failure {
    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Self::File(_) => 1,
            Self::Usage(_) => 2,
            Self::Case(_) | Self::Law(_) | Self::Refused(_) => 3,
            Self::Numerical(_) => 4,
            Self::Interrupted { code } => *code,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(error) => write!(f, "error: {error}"),
            Self::Usage(what) => write!(f, "error: {what}"),
            Self::Refused(objection) => write!(f, "error: {objection}"),
            Self::Case(error) => write!(f, "{error}"),
            Self::Law(error) => write!(f, "error: {error}"),
            Self::Numerical(what) => write!(f, "error: the run stopped: {what}"),
            Self::Interrupted { .. } => f.write_str("interrupted"),
        }
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::File(error)
    }
}

impl From<CaseError> for Failure {
    fn from(error: CaseError) -> Self {
        Self::Case(error)
    }
}

impl From<ParameterError> for Failure {
    fn from(error: ParameterError) -> Self {
        Self::Law(error)
    }
}
