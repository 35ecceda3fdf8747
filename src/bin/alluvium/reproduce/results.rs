//! What a finished run left, on the way to its pictures and its report.

use super::bad_table;
use super::ledger::Ledger;
use crate::folder::RunFolder;
use crate::manifest::Manifest;
use crate::outcome::Failure;
use crate::run::Finished;
use crate::screen;
use alluvium::output::Table;

/// Folder and history of a run.
pub struct Results {
    pub folder: RunFolder,
    manifest: Manifest,
    /// `history.csv`.
    pub history: Table,
    pub ledger: Ledger,
}

impl Results {
    /// Of this run.
    pub fn of(finished: Finished) -> Result<Self, Failure> {
        let Finished { mut folder, manifest, .. } = finished;
        let text = std::fs::read_to_string(folder.file("history.csv")?)?;
        let history = Table::parse(&text).map_err(|error| bad_table("history.csv", &error))?;
        let ledger = Ledger::read(&history).map_err(|error| bad_table("history.csv", &error))?;
        Ok(Self { folder, manifest, history, ledger })
    }

    /// Adds a picture: `flow` is `pictures/flow.svg`.
    pub fn picture(&mut self, name: &str, svg: &str) -> Result<(), Failure> {
        self.folder.write(&format!("pictures/{name}.svg"), svg)
    }

    /// Adds the picture of the energy.
    pub fn energy(&mut self, name: &str) -> Result<(), Failure> {
        let energy = self.ledger.svg(&format!("{name}: where the energy is"));
        self.picture("energy", &energy)
    }

    /// Writes and prints the report.
    pub fn conclude(mut self, report: &str) -> Result<(), Failure> {
        self.folder.write("report.md", report)?;
        screen::print(report)?;
        screen::print(format_args!("pictures in {}", self.folder.path().join("pictures").display()))?;
        self.manifest.write(&mut self.folder)
    }
}
