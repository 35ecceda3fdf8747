//! What the user sees while a run goes on, and `run.log`: a bar with the time left on a terminal, plain
//! lines elsewhere.

use crate::folder::RunFolder;
use crate::outcome::Failure;
use crate::screen;
use indicatif::{ProgressBar, ProgressStyle};
use std::fs::File;
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

const PARTS: u64 = 10_000;

/// Speaks to the terminal and to the log.
pub struct Reporter {
    log: File,
    bar: Option<ProgressBar>,
    clock: Instant,
    shown: Instant,
}

impl Reporter {
    /// Starts `run.log`.
    pub fn new(folder: &mut RunFolder) -> Result<Self, Failure> {
        let log = File::create(folder.file("run.log")?)?;
        let bar = std::io::stderr().is_terminal().then(|| {
            let template = "{bar:32} {percent:>3} %  {msg}  elapsed {elapsed}, left {eta}";
            let style =
                ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(PARTS).with_style(style)
        });
        let now = Instant::now();
        Ok(Self { log, bar, clock: now, shown: now })
    }

    /// A line for the log and the screen.
    pub fn say(&mut self, line: &str) {
        self.note(line);
        match &self.bar {
            Some(bar) => bar.suspend(|| screen::say(line)),
            None => screen::say(line),
        }
    }

    /// A line for the log alone.
    pub fn note(&mut self, line: &str) {
        for line in line.lines() {
            writeln!(self.log, "{:>10.2} s  {line}", self.clock.elapsed().as_secs_f64()).ok();
        }
    }

    /// How far the run is: the part that is done, and a few words. Cheap enough for every step.
    pub fn progress(&mut self, part: f64, words: impl FnOnce() -> String) {
        if self.shown.elapsed() < Duration::from_millis(100) || self.bar.is_none() {
            return;
        }
        self.shown = Instant::now();
        if let Some(bar) = &self.bar {
            bar.set_position((part.clamp(0.0, 1.0) * PARTS as f64) as u64);
            bar.set_message(words());
        }
    }

    /// The time left if the rest is as fast as the part that is done, as text.
    pub fn left(&self, part: f64) -> String {
        if part <= 0.0 {
            return "?".to_owned();
        }
        let seconds = (self.clock.elapsed().as_secs_f64() * (1.0 / part.min(1.0) - 1.0)).round();
        match seconds {
            s if s < 90.0 => format!("{s:.0} s"),
            s if s < 5400.0 => format!("{:.0} min", s / 60.0),
            s => format!("{:.1} h", s / 3600.0),
        }
    }

    /// Seconds since the start.
    pub fn elapsed(&self) -> f64 {
        self.clock.elapsed().as_secs_f64()
    }

    /// Takes the bar away.
    pub fn end(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}
