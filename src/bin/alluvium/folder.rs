//! A run's folder: `case.used.toml`, `run.log`, `history.csv`, `manifest.json`, `data/`, `gauges/`,
//! `pictures/`.

use crate::arguments::Existing;
use crate::outcome::Failure;
use alluvium::output::write_whole;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

/// The folder, and the files the run has put there.
#[derive(Debug)]
pub struct RunFolder {
    path: PathBuf,
    files: Vec<String>,
}

impl RunFolder {
    /// Makes the folder; one that is not empty is dealt with as `existing` says.
    pub fn create(path: &Path, existing: Existing) -> Result<Self, Failure> {
        if path.exists() && !path.is_dir() {
            return Err(Failure::Usage(format!("{} is not a folder", path.display())));
        }
        if path.is_dir() && fs::read_dir(path)?.next().is_some() {
            match existing {
                Existing::Error => return Err(not_empty(path)),
                Existing::Overwrite => clear(path)?,
            }
        }
        fs::create_dir_all(path).map_err(|error| naming(path, &error))?;
        Ok(Self { path: path.to_owned(), files: Vec::new() })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where a file of the run goes, as in `data/water.pvd`; its folder is made.
    pub fn file(&mut self, name: &str) -> Result<PathBuf, Failure> {
        let path = self.path.join(name);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(|error| naming(folder, &error))?;
        }
        if !self.files.iter().any(|file| file == name) {
            self.files.push(name.to_owned());
        }
        Ok(path)
    }

    /// Writes a text file of the run.
    pub fn write(&mut self, name: &str, text: &str) -> Result<(), Failure> {
        let path = self.file(name)?;
        Ok(write_whole(&path, |out| out.write_all(text.as_bytes()))?)
    }

    /// The files of the run, in the order they were first asked for.
    pub fn files(&self) -> &[String] {
        &self.files
    }
}

fn not_empty(path: &Path) -> Failure {
    let path = path.display();
    Failure::Usage(format!(
        "the folder {path} is not empty: choose another with --out, or replace the run in it with \
         --existing overwrite"
    ))
}

/// Deletes the files a former run lists in its manifest. Others stay, and a folder without a manifest is
/// not a run's.
fn clear(path: &Path) -> Result<(), Failure> {
    let manifest = path.join("manifest.json");
    let text = fs::read_to_string(&manifest).map_err(|_| {
        let what = "is not empty and holds no manifest.json of a former run: nothing was deleted";
        Failure::Usage(format!("the folder {} {what}", path.display()))
    })?;
    let unreadable = |_| Failure::Usage(format!("{} is not a run's manifest", manifest.display()));
    let former: serde_json::Value = serde_json::from_str(&text).map_err(unreadable)?;
    let files = former["files"].as_array().into_iter().flatten();
    for name in files.filter_map(|file| file.as_str()).filter(|name| stays_inside(name)) {
        fs::remove_file(path.join(name)).ok();
    }
    fs::remove_file(&manifest).map_err(|error| naming(&manifest, &error).into())
}

fn stays_inside(name: &str) -> bool {
    Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

fn naming(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}
