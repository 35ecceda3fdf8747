//! Reading a TOML document key by key, remembering where everything stands and what is wrong.

use super::problem::{Problem, nearest};
use super::section::Section;
use core::cell::RefCell;
use core::ops::Range;
use std::collections::BTreeMap;
use toml::de::DeTable;

/// A key that nothing asked for.
struct Unknown {
    table: String,
    key: String,
    span: Range<usize>,
}

/// The document's text, what was asked of it, and what is wrong with it.
#[derive(Default)]
pub(super) struct Reader<'s> {
    source: &'s str,
    errors: RefCell<Vec<Problem>>,
    warnings: RefCell<Vec<Problem>>,
    spans: RefCell<BTreeMap<String, Range<usize>>>,
    asked: RefCell<Vec<(String, &'static str)>>,
    unknown: RefCell<Vec<Unknown>>,
}

impl<'s> Reader<'s> {
    pub(super) fn new(source: &'s str) -> Self {
        Self { source, ..Self::default() }
    }

    /// The document's root table, or the error that it is not TOML.
    pub(super) fn with_root<R>(&self, read: impl FnOnce(&Section<'_, 's>) -> R) -> Option<R> {
        match DeTable::parse(self.source) {
            Ok(root) => Some(read(&Section::root(self, root.get_ref()))),
            Err(error) => {
                let span = error.span().unwrap_or(0..0);
                let value = self.source.get(span.clone()).unwrap_or("").to_owned();
                let what = format!("not valid TOML: {}", error.message());
                let allowed = "TOML 1.1: `key = value` lines, [tables] and [[lists of tables]]".to_owned();
                self.errors
                    .borrow_mut()
                    .push(Problem::at(self.source, span, "", what, allowed).with_value(&value));
                None
            }
        }
    }

    /// The text of `span`.
    pub(super) fn text(&self, span: &Range<usize>) -> &'s str {
        self.source.get(span.clone()).unwrap_or("")
    }

    /// Remembers that `key` of `table` may be given, and where it stands if it is.
    pub(super) fn ask(&self, table: &str, key: &'static str, span: Option<Range<usize>>) {
        self.asked.borrow_mut().push((table.to_owned(), key));
        if let Some(span) = span {
            self.spans.borrow_mut().insert(join(table, key), span);
        }
    }

    /// Whether something asked for `key` of `table`.
    pub(super) fn was_asked(&self, table: &str, key: &str) -> bool {
        self.asked.borrow().iter().any(|(t, k)| t == table && *k == key)
    }

    /// Remembers where an element stands.
    pub(super) fn place(&self, path: &str, span: Range<usize>) {
        self.spans.borrow_mut().insert(path.to_owned(), span);
    }

    /// Remembers a key that nothing asked for.
    pub(super) fn unknown(&self, table: &str, key: &str, span: Range<usize>) {
        self.unknown.borrow_mut().push(Unknown { table: table.to_owned(), key: key.to_owned(), span });
    }

    /// Whether the key was given in the file.
    pub(super) fn given(&self, path: &str) -> bool {
        self.spans.borrow().contains_key(path)
    }

    pub(super) fn has_errors(&self) -> bool {
        !self.errors.borrow().is_empty()
    }

    /// The value of `path` cannot be: `why` completes the sentence "`key = value` …".
    pub(super) fn error(&self, path: &str, why: &str, allowed: impl Into<String>) {
        let problem = self.problem(path, why, allowed.into());
        self.errors.borrow_mut().push(problem);
    }

    /// The value of `path` is doubtful.
    pub(super) fn warning(&self, path: &str, why: &str, allowed: impl Into<String>) {
        let problem = self.problem(path, why, allowed.into());
        self.warnings.borrow_mut().push(problem);
    }

    /// A key that must be there is not: shown at its table.
    pub(super) fn missing(&self, table: &str, key: &str, allowed: String) {
        let span = self.spans.borrow().get(table).cloned().unwrap_or(0..0);
        let path = join(table, key);
        let problem = Problem::at(self.source, span, &path, format!("missing key `{path}`"), allowed);
        self.errors.borrow_mut().push(problem);
    }

    fn problem(&self, path: &str, why: &str, allowed: String) -> Problem {
        let spans = self.spans.borrow();
        let Some(span) = spans.get(path).cloned() else {
            let what = format!("`{path}` {why}");
            let table = path.rsplit_once('.').map_or("", |(table, _)| table);
            let span = spans.get(table).cloned().unwrap_or(0..0);
            return Problem::at(self.source, span, path, what, allowed);
        };
        let value = self.text(&span).lines().next().unwrap_or("");
        let what = format!("`{path} = {value}` {why}");
        Problem::at(self.source, span, path, what, allowed).with_value(value)
    }

    /// What is wrong and what is doubtful, in the order of the file.
    pub(super) fn finish(self) -> (Vec<Problem>, Vec<Problem>) {
        let unknown = self.unknown.take();
        let asked = self.asked.take();
        let (mut errors, mut warnings) = (self.errors.take(), self.warnings.take());
        errors.extend(unknown.iter().map(|unknown| unknown.problem(self.source, &asked)));
        for problems in [&mut errors, &mut warnings] {
            problems.sort_by_key(|problem| (problem.line, problem.column));
            problems.dedup();
        }
        (errors, warnings)
    }
}

impl Unknown {
    fn problem(&self, source: &str, asked: &[(String, &'static str)]) -> Problem {
        let Self { table, key, span } = self;
        let mut here: Vec<_> = asked.iter().filter(|(t, _)| t == table).map(|(_, k)| *k).collect();
        here.sort_unstable();
        here.dedup();
        let place = if table.is_empty() { "at the top".to_owned() } else { format!("in [{table}]") };
        let mut what = format!("unknown key `{key}` {place}");
        if let Some((other, _)) = asked.iter().find(|(t, k)| t != table && k == key) {
            let other =
                if other.is_empty() { "the top, before the first [table]" } else { &format!("[{other}]") };
            what += &format!(": it belongs to {other}");
        } else if let Some(near) = nearest(key, here.iter().copied()) {
            what += &format!(": did you mean `{near}`?");
        }
        let end = source[span.start..].find('\n').map_or(source.len(), |n| span.start + n);
        let value = source[span.end.min(end)..end].split_once('=').map_or("", |(_, value)| value.trim());
        Problem::at(source, span.clone(), &join(table, key), what, here.join(", ")).with_value(value)
    }
}

/// `table.key`, or `key` at the top.
pub(super) fn join(table: &str, key: &str) -> String {
    if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") }
}
