//! Whole files or none.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes a file so that a reader, at any moment, finds either the old one or the whole new one:
/// into a temporary file beside it, which then takes its name.
///
/// # Errors
/// The error of the file system or of `content`, with the path in its message.
pub fn write_whole(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".partial");
    let partial = path.with_file_name(name);
    let written = fill(&partial, content).and_then(|()| fs::rename(&partial, path));
    written.map_err(|error| {
        fs::remove_file(&partial).ok();
        naming(path, &error)
    })
}

fn fill(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    content(&mut file)?;
    file.into_inner().map_err(io::IntoInnerError::into_error)?.flush()
}

/// The same error, its message beginning with the path.
pub(super) fn naming(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("cannot write {}: {error}", path.display()))
}
