//! What is wrong with a case file, shown where it stands.

use core::fmt;
use core::ops::Range;

/// One thing that is wrong, or doubtful, in a case file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The key, with its tables, as in `water.block[1].low_m`; empty if the text is not TOML at all.
    pub key: String,
    /// The value as it stands in the file; empty if there is none.
    pub value: String,
    /// What is wrong.
    pub what: String,
    /// What is allowed.
    pub allowed: String,
    /// Line in the file, from 1.
    pub line: usize,
    /// Column, in characters, from 1.
    pub column: usize,
    /// The line itself.
    pub text: String,
    /// How many characters are underlined.
    pub width: usize,
}

impl Problem {
    /// A problem at the bytes `span` of `source`.
    pub(super) fn at(source: &str, span: Range<usize>, key: &str, what: String, allowed: String) -> Self {
        let start = floor(source, span.start);
        let end = floor(source, span.end).max(start);
        let from = source[..start].rfind('\n').map_or(0, |n| n + 1);
        let to = source[start..].find('\n').map_or(source.len(), |n| start + n);
        Self {
            key: key.to_owned(),
            value: String::new(),
            what,
            allowed,
            line: source[..from].matches('\n').count() + 1,
            column: source[from..start].chars().count() + 1,
            text: source[from..to].trim_end().replace('\t', " "),
            width: source[start..end.min(to).max(start)].chars().count().max(1),
        }
    }

    /// The same, with the value that stands there.
    pub(super) fn with_value(mut self, value: &str) -> Self {
        value.clone_into(&mut self.value);
        self
    }

    fn show(&self, f: &mut fmt::Formatter<'_>, file: &str, level: &str) -> fmt::Result {
        let Self { line, column, text, width, .. } = self;
        let number = line.to_string();
        let gutter = " ".repeat(number.len());
        writeln!(f, "{level}: {}", self.what)?;
        writeln!(f, "{gutter}--> {file}:{line}:{column}")?;
        writeln!(f, "{gutter} |\n{number} | {text}")?;
        let before = " ".repeat(column - 1);
        writeln!(f, "{gutter} | {before}{}", "^".repeat(*width))?;
        if !self.allowed.is_empty() {
            writeln!(f, "{gutter} = allowed: {}", self.allowed)?;
        }
        Ok(())
    }
}

/// The nearest character boundary at or before byte `at`.
fn floor(source: &str, at: usize) -> usize {
    let at = at.min(source.len());
    (0..=at).rev().find(|&n| source.is_char_boundary(n)).unwrap_or(0)
}

/// A case file that cannot be run: everything that is wrong with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseError {
    /// The file's name as it is shown.
    pub file: String,
    /// What is wrong, in the order of the file.
    pub problems: Vec<Problem>,
}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for problem in &self.problems {
            problem.show(f, &self.file, "error")?;
        }
        let count = self.problems.len();
        write!(f, "{}: {count} error{}", self.file, if count == 1 { "" } else { "s" })
    }
}

impl core::error::Error for CaseError {}

/// What is doubtful in a case that can be run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warnings {
    /// The file's name as it is shown.
    pub file: String,
    /// What is doubtful, in the order of the file.
    pub problems: Vec<Problem>,
}

impl fmt::Display for Warnings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.problems.iter().try_for_each(|problem| problem.show(f, &self.file, "warning"))
    }
}

/// The word among `known` nearest to `word`, if one is near.
pub(super) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = (word.chars().count() / 2).max(2);
    let score = |k: &str| if k.starts_with(word) || word.starts_with(k) { 1 } else { distance(word, k) };
    known.into_iter().map(|k| (score(k), k)).filter(|(d, _)| *d <= limit).min().map(|(_, k)| k)
}

/// Edits (insert, delete, replace, swap neighbours) that turn `a` into `b`.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(before[j - 2] + 1);
            }
            row.push(best);
        }
        before = core::mem::replace(&mut last, row);
    }
    last[b.len()]
}
