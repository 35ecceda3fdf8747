//! One table of a case file: typed access to its keys. What is wrong is recorded and a harmless value
//! returned, so that one reading finds every mistake.

use super::bounds::Bounds;
use super::choice::Choice;
use super::problem::nearest;
use super::reader::{Reader, join};
use core::ops::RangeInclusive;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// One table, or the absence of it.
pub(super) struct Section<'r, 's> {
    reader: &'r Reader<'s>,
    path: String,
    table: Option<&'r DeTable<'s>>,
}

type Entry<'r, 's> = &'r Spanned<DeValue<'s>>;

impl<'r, 's> Section<'r, 's> {
    pub(super) fn root<'a>(reader: &'a Reader<'s>, table: &'a DeTable<'s>) -> Section<'a, 's> {
        Section { reader, path: String::new(), table: Some(table) }
    }

    /// The key's full name.
    pub(super) fn name(&self, key: &str) -> String {
        join(&self.path, key)
    }

    /// Whether the table is in the file.
    pub(super) fn is_given(&self) -> bool {
        self.table.is_some()
    }

    fn entry(&self, key: &'static str) -> Option<Entry<'r, 's>> {
        let entry = self.table.and_then(|table| table.get(key));
        self.reader.ask(&self.path, key, entry.map(Spanned::span));
        entry
    }

    fn missing(&self, key: &str, allowed: impl ToString) {
        self.reader.missing(&self.path, key, allowed.to_string());
    }

    fn wrong_type(&self, path: &str, value: &DeValue<'_>, allowed: impl ToString) {
        let why = format!("is {}", kind(value));
        self.reader.error(path, &why, allowed.to_string());
    }

    /// A number, if it is given.
    pub(super) fn number(&self, key: &'static str, bounds: Bounds) -> Option<f64> {
        let entry = self.entry(key)?;
        Some(self.checked_number(&self.name(key), entry.get_ref(), bounds))
    }

    /// A number that must be given.
    pub(super) fn required_number(&self, key: &'static str, bounds: Bounds) -> f64 {
        self.number(key, bounds).unwrap_or_else(|| {
            self.missing(key, bounds);
            1.0
        })
    }

    fn checked_number(&self, path: &str, value: &DeValue<'_>, bounds: Bounds) -> f64 {
        let Some(x) = number(value) else {
            self.wrong_type(path, value, bounds);
            return 1.0;
        };
        if bounds.contains(x) {
            return x;
        }
        self.reader.error(path, "is out of range", bounds.to_string());
        1.0
    }

    /// A whole number, if it is given.
    pub(super) fn count(&self, key: &'static str, range: RangeInclusive<u64>) -> Option<u64> {
        let entry = self.entry(key)?;
        let allowed = format!("a whole number from {} to {}", range.start(), range.end());
        match entry.get_ref() {
            DeValue::Integer(n) => {
                let n = i128::from_str_radix(n.as_str(), n.radix()).unwrap_or(-1);
                let n = u64::try_from(n).ok().filter(|n| range.contains(n));
                if n.is_none() {
                    self.reader.error(&self.name(key), "is out of range", allowed);
                }
                n
            }
            other => {
                self.wrong_type(&self.name(key), other, allowed);
                None
            }
        }
    }

    /// Yes or no, if it is given.
    pub(super) fn flag(&self, key: &'static str) -> Option<bool> {
        let entry = self.entry(key)?;
        if let DeValue::Boolean(given) = entry.get_ref() {
            return Some(*given);
        }
        self.wrong_type(&self.name(key), entry.get_ref(), "true or false");
        None
    }

    /// A list of numbers, if it is given.
    pub(super) fn numbers(
        &self,
        key: &'static str,
        length: Option<usize>,
        bounds: Bounds,
    ) -> Option<Vec<f64>> {
        let entry = self.entry(key)?;
        let path = self.name(key);
        let size = length.map_or(String::new(), |n| format!("{n} numbers, one per dimension, each "));
        let allowed = format!("a list: {size}{bounds}");
        let fallback = Some(vec![1.0; length.unwrap_or(0)]);
        let DeValue::Array(list) = entry.get_ref() else {
            self.wrong_type(&path, entry.get_ref(), allowed);
            return fallback;
        };
        if length.is_some_and(|n| n != list.len()) {
            self.reader.error(&path, &format!("has {} entries", list.len()), allowed);
            return fallback;
        }
        let element = |(k, entry): (usize, Entry<'r, 's>)| {
            let path = format!("{path}[{}]", k + 1);
            self.reader.place(&path, entry.span());
            self.checked_number(&path, entry.get_ref(), bounds)
        };
        Some(list.iter().enumerate().map(element).collect())
    }

    /// A list of numbers that must be given.
    pub(super) fn required_numbers(&self, key: &'static str, length: usize, bounds: Bounds) -> Vec<f64> {
        self.numbers(key, Some(length), bounds).unwrap_or_else(|| {
            self.missing(key, format!("a list of {length} numbers, each {bounds}"));
            vec![1.0; length]
        })
    }

    /// A text, if it is given.
    pub(super) fn text(&self, key: &'static str, allowed: &str) -> Option<String> {
        let entry = self.entry(key)?;
        if let DeValue::String(text) = entry.get_ref() {
            return Some(text.to_string());
        }
        self.wrong_type(&self.name(key), entry.get_ref(), allowed);
        None
    }

    /// A text that must be given.
    pub(super) fn required_text(&self, key: &'static str, allowed: &str) -> String {
        let given = self.text(key, allowed);
        if given.is_none() && !self.reader.given(&self.name(key)) {
            self.missing(key, allowed);
        }
        given.unwrap_or_else(|| "none".to_owned())
    }

    /// A word of a choice, if it is given.
    pub(super) fn choice<C: Choice>(&self, key: &'static str) -> Option<C> {
        let entry = self.entry(key)?;
        self.word(&self.name(key), entry.get_ref())
    }

    /// A list of words of a choice, if it is given.
    pub(super) fn choices<C: Choice>(&self, key: &'static str) -> Option<Vec<C>> {
        let entry = self.entry(key)?;
        let path = self.name(key);
        let DeValue::Array(list) = entry.get_ref() else {
            self.wrong_type(&path, entry.get_ref(), format!("a list of {}", words::<C>()));
            return None;
        };
        let mut found: Vec<C> = Vec::new();
        for (k, entry) in list.iter().enumerate() {
            let path = format!("{path}[{}]", k + 1);
            self.reader.place(&path, entry.span());
            match self.word(&path, entry.get_ref()) {
                Some(word) if found.contains(&word) => {
                    self.reader.error(&path, "is listed twice", "each word once");
                }
                word => found.extend(word),
            }
        }
        Some(found)
    }

    fn word<C: Choice>(&self, path: &str, value: &DeValue<'_>) -> Option<C> {
        let DeValue::String(text) = value else {
            self.wrong_type(path, value, words::<C>());
            return None;
        };
        let found = C::ALL.iter().copied().find(|choice| choice.word() == text);
        if found.is_none() {
            let near = nearest(text, C::ALL.iter().map(|choice| choice.word()));
            let why = near.map_or("is not a choice".to_owned(), |near| {
                format!("is not a choice: did you mean \"{near}\"?")
            });
            self.reader.error(path, &why, words::<C>());
        }
        found
    }

    /// A table, perhaps absent.
    pub(super) fn section(&self, key: &'static str) -> Section<'r, 's> {
        let path = self.name(key);
        let table = self.entry(key).and_then(|entry| self.table_of(&path, entry.get_ref()));
        Section { reader: self.reader, path, table }
    }

    /// A list of tables, perhaps empty.
    pub(super) fn sections(&self, key: &'static str) -> Vec<Section<'r, 's>> {
        let path = self.name(key);
        let Some(entry) = self.entry(key) else { return Vec::new() };
        let DeValue::Array(list) = entry.get_ref() else {
            self.wrong_type(&path, entry.get_ref(), format!("a list of tables, [[{path}]]"));
            return Vec::new();
        };
        let section = |(k, entry): (usize, Entry<'r, 's>)| {
            let path = format!("{path}[{}]", k + 1);
            self.reader.place(&path, entry.span());
            let table = self.table_of(&path, entry.get_ref());
            Section { reader: self.reader, path, table }
        };
        list.iter().enumerate().map(section).collect()
    }

    fn table_of(&self, path: &str, value: &'r DeValue<'s>) -> Option<&'r DeTable<'s>> {
        let table = value.as_table();
        if table.is_none() {
            self.wrong_type(path, value, format!("a table, [{path}]"));
        }
        table
    }

    /// Records every key that nothing asked for.
    pub(super) fn finish(&self) {
        for (key, _) in self.table.into_iter().flatten() {
            if !self.reader.was_asked(&self.path, key.get_ref()) {
                self.reader.unknown(&self.path, key.get_ref(), key.span());
            }
        }
    }
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(x) => x.as_str().parse().ok(),
        DeValue::Integer(n) => i64::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
        _ => None,
    }
}

fn words<C: Choice>() -> String {
    let words: Vec<String> = C::ALL.iter().map(|choice| format!("\"{}\"", choice.word())).collect();
    words.join(", ")
}

fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "a true/false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}
