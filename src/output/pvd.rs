//! The collection that makes ParaView show a series of files as one thing that moves.

use super::write_whole;
use std::io;
use std::path::{Path, PathBuf};

/// A `.pvd` collection, rewritten whole at each dump: a running or killed run opens.
#[derive(Clone, Debug)]
pub struct Pvd {
    path: PathBuf,
    entries: Vec<(f64, String)>,
}

impl Pvd {
    /// An empty collection that will be written to `path`.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), entries: Vec::new() }
    }

    /// Where the collection is written.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds the dump `file` (named relative to the collection) at `time` \[s\] and rewrites the
    /// collection.
    ///
    /// # Errors
    /// The file system's.
    pub fn add(&mut self, time: f64, file: impl Into<String>) -> io::Result<()> {
        self.entries.push((time, file.into()));
        write_whole(&self.path, |out| {
            writeln!(out, r#"<?xml version="1.0"?>"#)?;
            writeln!(out, r#"<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">"#)?;
            writeln!(out, "  <Collection>")?;
            for (time, file) in &self.entries {
                let file = escaped(file);
                writeln!(out, r#"    <DataSet timestep="{time:?}" part="0" file="{file}"/>"#)?;
            }
            writeln!(out, "  </Collection>\n</VTKFile>")
        })
    }
}

/// `text` as it may stand in an XML attribute.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_dump_leaves_a_whole_collection() {
        let folder = std::env::temp_dir().join(format!("alluvium-pvd-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let mut series = Pvd::new(folder.join("water.pvd"));
        for n in 0..3 {
            series.add(0.1 * f64::from(n), format!("water_{n}.vtp")).unwrap();
            let text = std::fs::read_to_string(series.path()).unwrap();
            assert_eq!(text.matches("<DataSet").count(), n as usize + 1);
            assert!(text.trim_end().ends_with("</VTKFile>"));
        }
        let left: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
        assert_eq!(left, ["water.pvd"], "no temporary file is left");
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
