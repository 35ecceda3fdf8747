//! Tables as text: a header with units, then rows.

use super::atomic::naming;
use core::fmt;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// One entry of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell<'a> {
    /// A quantity, written with as many digits as give it back exactly.
    Number(f64),
    /// A count.
    Count(u64),
    /// A word: no comma, no line break.
    Text(&'a str),
}

impl From<f64> for Cell<'_> {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<u64> for Cell<'_> {
    fn from(n: u64) -> Self {
        Self::Count(n)
    }
}

impl<'a> From<&'a str> for Cell<'a> {
    fn from(text: &'a str) -> Self {
        Self::Text(text)
    }
}

impl fmt::Display for Cell<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(x) => write!(f, "{x:?}"),
            Self::Count(n) => write!(f, "{n}"),
            Self::Text(text) => f.write_str(&text.replace([',', '\n', '\r'], ";")),
        }
    }
}

/// A growing `.csv` file: a header with units, as in `time [s]`, and rows that are on disk as soon as
/// they are written.
#[derive(Debug)]
pub struct TableWriter {
    path: PathBuf,
    file: File,
    columns: usize,
}

impl TableWriter {
    /// Starts the file, replacing one of the same name.
    ///
    /// # Errors
    /// The file system's.
    pub fn create(path: impl Into<PathBuf>, columns: &[impl AsRef<str>]) -> io::Result<Self> {
        let path = path.into();
        let names: Vec<&str> = columns.iter().map(AsRef::as_ref).collect();
        let file = File::create(&path)
            .and_then(|mut file| writeln!(file, "{}", names.join(",")).map(|()| file))
            .map_err(|error| naming(&path, &error))?;
        Ok(Self { path, file, columns: names.len() })
    }

    /// Where the table is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Appends a row, in one write.
    ///
    /// # Errors
    /// The file system's, or [`io::ErrorKind::InvalidInput`] if the row has another number of entries
    /// than the header.
    pub fn row(&mut self, cells: &[Cell<'_>]) -> io::Result<()> {
        if cells.len() != self.columns {
            let what = format!("{} entries for {} columns", cells.len(), self.columns);
            return Err(naming(&self.path, &io::Error::new(io::ErrorKind::InvalidInput, what)));
        }
        let mut line = cells.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
        line.push('\n');
        self.file.write_all(line.as_bytes()).map_err(|error| naming(&self.path, &error))
    }
}

/// What is wrong with a table that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TableError {
    /// There is no header line.
    NoHeader,
    /// A row has more or fewer entries than the header.
    Width {
        /// Line in the file, from 1.
        line: usize,
        /// Entries in the row.
        entries: usize,
        /// Columns in the header.
        columns: usize,
    },
    /// No column of this name.
    NoColumn {
        /// The name asked for.
        name: String,
        /// The names there are.
        columns: Vec<String>,
    },
    /// An entry that should be a number.
    NotANumber {
        /// Line in the file, from 1.
        line: usize,
        /// Its column.
        column: String,
        /// What stands there.
        value: String,
    },
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoHeader => f.write_str("the table has no header line"),
            Self::Width { line, entries, columns } => {
                write!(f, "line {line}: {entries} entries for {columns} columns")
            }
            Self::NoColumn { name, columns } => {
                write!(f, "no column `{name}`; there are {}", columns.join(", "))
            }
            Self::NotANumber { line, column, value } => {
                write!(f, "line {line}, column `{column}`: `{value}` is not a number")
            }
        }
    }
}

impl core::error::Error for TableError {}

/// A table read back: a run's history, or published data with `#` lines that name their source.
///
/// ```
/// let table = alluvium::output::Table::parse("# Table 2\nT,Z\n0,1\n0.41,1.11\n")?;
/// assert_eq!(table.column("Z")?, [1.0, 1.11]);
/// assert_eq!(table.comments(), ["Table 2"]);
/// # Ok::<(), alluvium::output::TableError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    comments: Vec<String>,
    columns: Vec<String>,
    rows: Vec<(usize, Vec<String>)>,
}

impl Table {
    /// Reads comma-separated text: `#` lines are comments, the first other line is the header.
    ///
    /// # Errors
    /// No header, or a row of another width.
    pub fn parse(text: &str) -> Result<Self, TableError> {
        let mut table = Self { comments: Vec::new(), columns: Vec::new(), rows: Vec::new() };
        for (line, text) in text.lines().enumerate().map(|(n, text)| (n + 1, text.trim())) {
            if let Some(comment) = text.strip_prefix('#') {
                table.comments.push(comment.trim().to_owned());
            } else if !text.is_empty() {
                let entries: Vec<String> = text.split(',').map(|entry| entry.trim().to_owned()).collect();
                table.push(line, entries)?;
            }
        }
        if table.columns.is_empty() { Err(TableError::NoHeader) } else { Ok(table) }
    }

    fn push(&mut self, line: usize, entries: Vec<String>) -> Result<(), TableError> {
        if self.columns.is_empty() {
            self.columns = entries;
        } else if entries.len() == self.columns.len() {
            self.rows.push((line, entries));
        } else {
            let columns = self.columns.len();
            return Err(TableError::Width { line, entries: entries.len(), columns });
        }
        Ok(())
    }

    /// The comment lines, without their `#`.
    pub fn comments(&self) -> &[String] {
        &self.comments
    }

    /// The names in the header, units included.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// The entries of a column as they stand.
    ///
    /// # Errors
    /// No such column.
    pub fn text(&self, name: &str) -> Result<Vec<&str>, TableError> {
        let k = self.index(name)?;
        Ok(self.rows.iter().map(|(_, row)| row[k].as_str()).collect())
    }

    /// The numbers of a column.
    ///
    /// # Errors
    /// No such column, or an entry that is not a number.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, TableError> {
        let k = self.index(name)?;
        let number = |(line, row): &(usize, Vec<String>)| {
            let value = &row[k];
            value.parse().map_err(|_| TableError::NotANumber {
                line: *line,
                column: name.to_owned(),
                value: value.clone(),
            })
        };
        self.rows.iter().map(number).collect()
    }

    fn index(&self, name: &str) -> Result<usize, TableError> {
        let found = self.columns.iter().position(|column| column == name);
        found.ok_or_else(|| TableError::NoColumn { name: name.to_owned(), columns: self.columns.clone() })
    }
}
