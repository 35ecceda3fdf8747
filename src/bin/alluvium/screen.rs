//! What is printed. A pipe that nobody reads any more is no reason to lose a run.

use std::fmt::Display;
use std::io::{ErrorKind, Result, Write, stderr, stdout};

/// Prints a result.
///
/// # Errors
/// It cannot be written, but for a reader who has gone.
pub fn print(text: impl Display) -> Result<()> {
    match writeln!(stdout(), "{text}") {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error),
        _ => Ok(()),
    }
}

/// Says what goes on; nobody has to listen.
pub fn say(text: impl Display) {
    writeln!(stderr(), "{text}").ok();
}
