//! `manifest.json`: what was run, with what, on what, and what it left.

use crate::folder::RunFolder;
use crate::outcome::Failure;
use alluvium::case::Case;
use serde_json::{Value, json};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

/// Facts known when the run starts.
pub struct Manifest {
    started: SystemTime,
    clock: Instant,
    threads: usize,
    case: Value,
    outcome: String,
    steps: u64,
    wall_clock: f64,
}

impl Manifest {
    /// Of a run of `case` on so many threads, starting now.
    pub fn new(case: &Case, threads: usize) -> Self {
        let case = json!({
            "name": case.name,
            "preset": case.preset.to_string(),
            "dimension": case.dimension,
            "precision": case.precision.to_string(),
            "soil_particles": case.soil_particles(),
            "water_particles": case.water_particles(),
        });
        Self {
            started: SystemTime::now(),
            clock: Instant::now(),
            threads,
            case,
            outcome: "running".to_owned(),
            steps: 0,
            wall_clock: 0.0,
        }
    }

    /// The run is over: `done`, `interrupted`, or what went wrong.
    pub fn end(&mut self, outcome: String, steps: u64) {
        self.wall_clock = (self.clock.elapsed().as_secs_f64() * 1e3).round() / 1e3;
        (self.outcome, self.steps) = (outcome, steps);
    }

    /// Writes the file, with what is in the folder by now.
    pub fn write(&self, folder: &mut RunFolder) -> Result<(), Failure> {
        folder.file("manifest.json")?;
        let files: Vec<&String> = folder.files().iter().filter(|name| *name != "manifest.json").collect();
        let known = |text: Option<&'static str>| text.filter(|text| !text.is_empty());
        let manifest = json!({
            "program": "alluvium",
            "version": env!("CARGO_PKG_VERSION"),
            "commit": known(option_env!("ALLUVIUM_COMMIT")),
            "compiler": known(option_env!("ALLUVIUM_COMPILER")),
            "target": known(option_env!("ALLUVIUM_TARGET")),
            "profile": known(option_env!("ALLUVIUM_PROFILE")),
            "arguments": std::env::args().skip(1).collect::<Vec<_>>(),
            "case": self.case,
            "machine": { "cpu": cpu_model(), "cores": cores(), "system": std::env::consts::OS },
            "threads": self.threads,
            "started": utc(self.started),
            "wall_clock_s": self.wall_clock,
            "steps": self.steps,
            "outcome": self.outcome,
            "files": files,
        });
        let text = serde_json::to_string_pretty(&manifest).map_err(std::io::Error::from)?;
        folder.write("manifest.json", &(text + "\n"))
    }
}

/// Cores this process may use.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The processor's name, where the system tells.
pub fn cpu_model() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// A time as `2026-01-31T12:00:00Z`.
fn utc(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (day, rest) = ((seconds / 86_400) as i64, seconds % 86_400);
    let (year, month, day) = date(day);
    let (hour, minute, second) = (rest / 3600, rest / 60 % 60, rest % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// The Gregorian date of a day counted from 1970-01-01, in years that begin in March.
fn date(day: i64) -> (i64, i64, i64) {
    let day = day + 719_468;
    let era = day.div_euclid(146_097);
    let of_era = day.rem_euclid(146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let from_march = (5 * of_year + 2) / 153;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    (year + era * 400 + i64::from(month <= 2), month, of_year - (153 * from_march + 2) / 5 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn times_are_utc() {
        let at = |seconds| utc(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01T00:00:00Z");
        assert_eq!(at(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(at(1_767_225_599), "2025-12-31T23:59:59Z");
    }
}
