//! The library's own source, read as text, for the tests that keep its order.

use std::fs;
use std::path::{Path, PathBuf};

/// A file under `src/`.
pub struct Source {
    /// Path below `src/`, with `/`.
    pub path: String,
    /// What it says.
    pub text: String,
}

/// The top of the package.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Every file of the library, in order; the program in `src/bin` is not part of it.
pub fn library() -> Vec<Source> {
    let mut files = Vec::new();
    collect(&root().join("src"), "", &mut files);
    assert!(files.len() > 30, "the source was not found");
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files
}

fn collect(folder: &Path, prefix: &str, files: &mut Vec<Source>) {
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        let path = format!("{prefix}{name}");
        if entry.file_type().unwrap().is_dir() {
            if path != "bin" {
                collect(&entry.path(), &format!("{path}/"), files);
            }
        } else if name.ends_with(".rs") {
            files.push(Source { path, text: fs::read_to_string(entry.path()).unwrap() });
        }
    }
}

impl Source {
    /// The part of the library it belongs to: `kernel` for `kernel/mod.rs`, `real` for `real.rs`.
    pub fn part(&self) -> &str {
        self.path.split(['/', '.']).next().unwrap()
    }

    /// Whether it is all tests.
    pub fn is_test(&self) -> bool {
        self.path.ends_with("tests.rs") || self.path.contains("/tests/")
    }

    /// The code without comments, strings, character literals and unit tests.
    pub fn code(&self) -> String {
        let shipped = self.text.split("#[cfg(test)]").next().unwrap();
        if self.is_test() { String::new() } else { bare(shipped) }
    }
}

/// `text` without comments, strings and character literals.
fn bare(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let skip = match rest.strip_prefix('\'') {
            _ if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            _ if c == '"' => end_of_string(rest),
            // A character literal; a lifetime has no closing quote.
            Some(quoted) if quoted.starts_with('\\') => 3 + quoted[1..].find('\'').unwrap(),
            Some(quoted) if quoted.chars().nth(1) == Some('\'') => {
                2 + quoted.chars().next().unwrap().len_utf8()
            }
            _ => {
                out.push(c);
                c.len_utf8()
            }
        };
        rest = &rest[skip..];
    }
    out
}

fn end_of_string(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            '"' if !escaped => return at + 1,
            _ => escaped = c == '\\' && !escaped,
        }
    }
    text.len()
}

/// Whether `text` has the word `word` standing alone, as no part of a longer name.
pub fn has_word(text: &str, word: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + word.len()..].chars().next();
        !before.is_some_and(is_name) && !after.is_some_and(is_name)
    })
}
