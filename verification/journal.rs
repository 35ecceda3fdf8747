//! What a long run has measured so far, line by line, so that it can go on where it was stopped.

use alluvium::verify::{Measured, Outcome, Point, Standing, Table};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::Path;

/// Outcomes of this very build: those found, and a file that takes further ones.
pub struct Journal {
    known: BTreeMap<(String, Option<String>), Outcome>,
    file: File,
}

impl Journal {
    /// Opens the file, or begins it. What another build has measured is dropped: it may no longer be so.
    pub fn open(path: &Path) -> io::Result<Self> {
        let head = format!("{{\"build\":\"{:016x}\"}}", fingerprint()?);
        let text = fs::read_to_string(path).unwrap_or_default();
        let mut lines = text.lines();
        if lines.next() != Some(&head) {
            if let Some(folder) = path.parent() {
                fs::create_dir_all(folder)?;
            }
            fs::write(path, head + "\n")?;
            return Ok(Self { known: BTreeMap::new(), file: OpenOptions::new().append(true).open(path)? });
        }
        // A run that was killed may have left half a line.
        let outcomes = lines.filter_map(|line| outcome(&serde_json::from_str(line).ok()?));
        let known =
            outcomes.map(|outcome| ((outcome.study.clone(), outcome.mutant.clone()), outcome)).collect();
        let mut file = OpenOptions::new().append(true).open(path)?;
        if !text.ends_with('\n') {
            writeln!(file)?;
        }
        Ok(Self { known, file })
    }

    /// How many outcomes it begins with.
    pub fn len(&self) -> usize {
        self.known.len()
    }

    /// The outcome of a study, if there is one.
    pub fn known(&self, study: &str, mutant: Option<&str>) -> Option<Outcome> {
        self.known.get(&(study.to_owned(), mutant.map(str::to_owned))).cloned()
    }

    /// Adds an outcome.
    pub fn add(&mut self, outcome: &Outcome) -> io::Result<()> {
        writeln!(self.file, "{}", outcome.json())?;
        self.file.flush()
    }
}

/// Of the program that runs.
fn fingerprint() -> io::Result<u64> {
    let mut hasher = DefaultHasher::new();
    fs::read(std::env::current_exe()?)?.hash(&mut hasher);
    Ok(hasher.finish())
}

fn outcome(line: &Value) -> Option<Outcome> {
    let text = |name: &str| Some(line.get(name)?.as_str()?.to_owned());
    fn texts(of: &Value) -> Option<Vec<String>> {
        of.as_array()?.iter().map(|text| Some(text.as_str()?.to_owned())).collect()
    }
    fn table(of: &Value) -> Option<Table> {
        of.as_array()?.iter().map(texts).collect()
    }
    let point = |point: &Value| {
        let number = |name: &str| Some(point.get(name)?.as_f64().unwrap_or(f64::NAN));
        let label = point.get("label")?.as_str()?.to_owned();
        Some(Point { label, spacing: number("spacing")?, value: number("value")? })
    };
    let measured = Measured {
        points: line.get("points")?.as_array()?.iter().map(point).collect::<Option<_>>()?,
        notes: texts(line.get("notes")?)?,
        tables: line.get("tables")?.as_array()?.iter().map(table).collect::<Option<_>>()?,
        pictures: texts(line.get("pictures")?)?,
    };
    let is = |name: &str| line.get(name)?.as_bool();
    let standing = match (is("met")?, is("falls short")?) {
        (true, _) => Standing::Met,
        (false, true) => Standing::FallsShort,
        (false, false) => Standing::Missed,
    };
    Some(Outcome {
        study: text("study")?,
        mutant: text("mutant"),
        measured: is("finished")?.then_some(measured),
        standing,
        sentence: text("sentence")?,
        seconds: line.get("seconds")?.as_f64()?,
    })
}
