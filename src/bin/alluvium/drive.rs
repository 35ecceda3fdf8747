//! `alluvium drive`: a law along a path of strain and stress, without particles.

mod law;
mod options;
mod own;
mod picture;

pub use options::{DriveOptions, PathName, SurfaceName};

use crate::arguments::{Existing, PrecisionName};
use crate::folder::RunFolder;
use crate::outcome::Failure;
use alluvium::Real;
use alluvium::driver::Row;
use alluvium::material::Memory;
use alluvium::output::{Cell, TableWriter};
use std::io::{self, ErrorKind, Write};

/// What the law answered: one row per increment, begun with the start.
pub struct Answer {
    /// The strain \[-\] or angle \[rad\] the path asked for since the start, less where it turned back; of an own
    /// path the legs gone \[-\].
    amounts: Vec<f64>,
    /// What the columns are called.
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Answer {
    fn of<T: Real, S: Memory<T>>(amounts: Vec<f64>, rows: &[Row<T, S>]) -> Self {
        Self { amounts, names: Row::<T, S>::names(), rows: rows.iter().map(Row::numbers).collect() }
    }

    fn columns(&self, path: PathName) -> Vec<String> {
        let amount = match path {
            PathName::Rotation => "amount [rad]",
            PathName::Own => "legs gone [-]",
            _ => "amount [-]",
        };
        core::iter::once(amount.to_owned()).chain(self.names.iter().cloned()).collect()
    }

    fn lines(&self) -> impl Iterator<Item = Vec<Cell<'static>>> {
        let line = |(amount, row): (&f64, &Vec<f64>)| {
            core::iter::once(*amount).chain(row.iter().copied()).map(Cell::from).collect()
        };
        self.amounts.iter().zip(&self.rows).map(line)
    }

    /// A column of stress in kPa; empty if there is none of this name.
    fn kilo(&self, name: &str) -> Vec<f64> {
        let at = self.names.iter().position(|other| other == name);
        at.map_or(Vec::new(), |at| self.rows.iter().map(|row| row[at] * 1e-3).collect())
    }
}

/// Drives, writes, draws.
pub fn drive(options: &DriveOptions) -> Result<(), Failure> {
    let answer = match options.precision {
        PrecisionName::F32 => law::drive::<f32>(options)?,
        PrecisionName::F64 => law::drive::<f64>(options)?,
    };
    let Some(path) = &options.out else { return print(&answer, options.path) };
    let mut folder = RunFolder::create(path, Existing::Error)?;
    let mut table = TableWriter::create(folder.file("path.csv")?, &answer.columns(options.path))?;
    answer.lines().try_for_each(|line| table.row(&line))?;
    folder.write("path.svg", &picture::svg(options, &answer))
}

/// To standard output; a reader that has read enough is no failure.
fn print(answer: &Answer, path: PathName) -> Result<(), Failure> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    let mut all = || -> io::Result<()> {
        writeln!(out, "{}", answer.columns(path).join(","))?;
        for line in answer.lines() {
            let cells: Vec<_> = line.iter().map(Cell::to_string).collect();
            writeln!(out, "{}", cells.join(","))?;
        }
        out.flush()
    };
    match all() {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}
