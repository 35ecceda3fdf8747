//! Running a case: steps, history, gauges, dumps, until the end, a failure or a signal.

use crate::arguments::{OutputOptions, RunOptions};
use crate::case_file::CaseFile;
use crate::connect;
use crate::folder::RunFolder;
use crate::gallery::Gallery;
use crate::interrupt;
use crate::manifest::Manifest;
use crate::outcome::Failure;
use crate::preflight;
use crate::reporter::Reporter;
use crate::solver::{Solver, Step};
use alluvium::case::{Case, Warnings};
use alluvium::output::{Cell, Pvd, TableWriter};
use alluvium::parallel::Threads;
use alluvium::time::Limit;
use std::path::PathBuf;

/// A finished run.
pub struct Finished {
    /// Its folder, for what is drawn from it.
    pub folder: RunFolder,
    /// Steps it took.
    pub steps: u64,
    /// Particles that move, and of walls.
    pub particles: (usize, usize),
    /// How long it took \[s\].
    pub wall_clock: f64,
    /// Written again once pictures are in the folder.
    pub manifest: Manifest,
}

/// Looks on at every dump, at the time \[s\] given.
pub type Onlooker<'a> = dyn FnMut(f64, &mut dyn Solver) + Send + 'a;

/// `alluvium run CASE.toml`.
pub fn run_file(options: &RunOptions) -> Result<(), Failure> {
    let file = CaseFile::read(&options.case)?;
    let (case, warnings) = file.case()?;
    let mut gallery = Gallery::new(&case);
    let mut look = |time: f64, solver: &mut dyn Solver| gallery.look(time, solver);
    let Finished { mut folder, manifest, .. } = run_case(case.clone(), &warnings, &options.output, &mut look)
        .map_err(|failure| file.placed(failure))?;
    if let Some(picture) = gallery.svg() {
        folder.write("pictures/particles.svg", &picture)?;
    }
    manifest.write(&mut folder)
}

/// Runs a case in its folder; the onlooker gathers what pictures and reports need.
pub fn run_case(
    case: Case,
    warnings: &Warnings,
    options: &OutputOptions,
    onlooker: &mut Onlooker<'_>,
) -> Result<Finished, Failure> {
    run_with(connect::connect, case, warnings, options, onlooker)
}

/// The same, by a solver of one's own.
pub fn run_with(
    connect: impl FnOnce(&Case) -> Result<Box<dyn Solver + Send>, Failure> + Send,
    mut case: Case,
    warnings: &Warnings,
    options: &OutputOptions,
    onlooker: &mut Onlooker<'_>,
) -> Result<Finished, Failure> {
    case.threads = options.threads.map_or(case.threads, usize::from);
    let threads = Threads::new(case.threads).map_err(|error| Failure::Usage(error.to_string()))?;
    threads.install(|| {
        let mut solver = connect(&case)?;
        let path = options.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&case.name));
        let mut folder = RunFolder::create(&path, options.existing)?;
        folder.write("case.used.toml", &case.to_string())?;
        let mut manifest = Manifest::new(&case, threads.count());
        manifest.write(&mut folder)?;
        interrupt::listen();
        let mut run = Run::new(&case, folder, onlooker)?;
        run.introduce(warnings);
        let ended = run.go(solver.as_mut());
        run.conclude(&ended, &mut manifest, solver.as_ref())?;
        ended.map(|()| Finished {
            steps: solver.steps(),
            particles: solver.particles(),
            wall_clock: run.reporter.elapsed(),
            folder: run.folder,
            manifest,
        })
    })
}

struct Run<'a, 'b> {
    case: &'a Case,
    folder: RunFolder,
    reporter: Reporter,
    onlooker: &'a mut Onlooker<'b>,
    history: Option<TableWriter>,
    gauges: Vec<TableWriter>,
    series: Vec<(&'static str, Pvd)>,
    dumps: usize,
}

impl<'a, 'b> Run<'a, 'b> {
    fn new(case: &'a Case, mut folder: RunFolder, onlooker: &'a mut Onlooker<'b>) -> Result<Self, Failure> {
        Ok(Self {
            case,
            reporter: Reporter::new(&mut folder)?,
            folder,
            onlooker,
            history: None,
            gauges: Vec::new(),
            series: Vec::new(),
            dumps: 0,
        })
    }

    fn introduce(&mut self, warnings: &Warnings) {
        let shown = warnings.to_string();
        if !shown.is_empty() {
            self.reporter.say(shown.trim_end());
        }
        let folder = self.folder.path().display().to_string();
        self.reporter.say(&format!("{} in {folder}", self.case.name));
        self.reporter.note(&preflight::summary(self.case));
    }

    /// Steps from output to output.
    fn go(&mut self, solver: &mut dyn Solver) -> Result<(), Failure> {
        let end = self.case.end_time;
        let mut dumps = self.case.dump_times().into_iter().peekable();
        let mut step = Step { length: 0.0, limit: "none" };
        // The last that was not cut short to end at an instant of output.
        let mut whole = step;
        let mut records = Records::new(self.case.output.history_interval);
        // Adding up steps rounds: this close to an instant is there.
        let near = 1e-10 * end;
        loop {
            let time = solver.time() + near;
            if records.is_due(time) || time >= end {
                self.record(solver, step)?;
            }
            if dumps.next_if(|due| time >= *due).is_some() {
                self.dump(solver, whole)?;
            }
            if time >= end {
                return Ok(());
            }
            if let Some(code) = interrupt::asked() {
                self.dump(solver, whole)?;
                return Err(Failure::Interrupted { code });
            }
            let until = dumps.peek().map_or(end, |due| due.min(end));
            step = match solver.step(until) {
                Ok(step) => step,
                Err(stopped) => {
                    self.record(solver, step)?;
                    self.dump(solver, whole)?;
                    return Err(Failure::Numerical(stopped.0));
                }
            };
            if step.limit != Limit::End.name() || whole.length == 0.0 {
                whole = step;
            }
            self.reporter.progress(solver.time() / end, || {
                format!("t = {:.4} s, Δt = {:.2e} s ({})", solver.time(), step.length, step.limit)
            });
        }
    }

    /// A row of the history and of each gauge.
    fn record(&mut self, solver: &mut dyn Solver, step: Step) -> Result<(), Failure> {
        let time = solver.time();
        let quantities = solver.quantities();
        if self.history.is_none() {
            let own = ["time [s]", "steps", "time_step [s]", "limit", "wall_clock [s]"];
            let columns: Vec<&str> =
                own.into_iter().chain(quantities.iter().map(|(name, _)| name.as_str())).collect();
            self.history = Some(TableWriter::create(self.folder.file("history.csv")?, &columns)?);
        }
        let wall = (self.reporter.elapsed() * 1e3).round() / 1e3;
        let own: [Cell<'_>; 5] =
            [time.into(), solver.steps().into(), step.length.into(), step.limit.into(), wall.into()];
        let row: Vec<Cell<'_>> = own.into_iter().chain(quantities.iter().map(|(_, x)| (*x).into())).collect();
        if let Some(history) = &mut self.history {
            history.row(&row)?;
        }
        self.record_gauges(solver, time)
    }

    fn record_gauges(&mut self, solver: &mut dyn Solver, time: f64) -> Result<(), Failure> {
        for (n, gauge) in self.case.gauges.iter().enumerate() {
            let values = solver.gauge(gauge);
            if self.gauges.len() <= n {
                let file = self.folder.file(&format!("gauges/{}.csv", gauge.name))?;
                let columns: Vec<&str> =
                    ["time [s]"].into_iter().chain(values.iter().map(|(name, _)| *name)).collect();
                self.gauges.push(TableWriter::create(file, &columns)?);
            }
            let row: Vec<Cell<'_>> =
                [time].into_iter().chain(values.iter().map(|(_, x)| *x)).map(Cell::from).collect();
            self.gauges[n].row(&row)?;
        }
        Ok(())
    }

    /// One file per phase, the collections, and a row of the log.
    fn dump(&mut self, solver: &mut dyn Solver, step: Step) -> Result<(), Failure> {
        let time = solver.time();
        for (n, (phase, particles)) in solver.files(&self.case.output.fields).into_iter().enumerate() {
            let name = format!("{phase}_{:04}.vtp", self.dumps);
            particles.write(&self.folder.file(&format!("data/{name}"))?)?;
            if self.series.len() <= n {
                let collection = self.folder.file(&format!("data/{phase}.pvd"))?;
                self.series.push((phase, Pvd::new(collection)));
            }
            self.series[n].1.add(time, name)?;
        }
        (self.onlooker)(time, solver);
        let row = self.log_row(solver, step);
        self.reporter.say(&row);
        self.dumps += 1;
        Ok(())
    }

    fn log_row(&self, solver: &dyn Solver, step: Step) -> String {
        let (time, steps, part) = (solver.time(), solver.steps(), solver.time() / self.case.end_time);
        let (moving, walls) = solver.particles();
        let wall = self.reporter.elapsed();
        let start = format!("dump {:04}  t = {time:.5} s  step {steps}", self.dumps);
        if steps == 0 {
            return format!("{start}  {moving} + {walls} wall particles");
        }
        let speed = (moving + walls) as f64 * steps as f64 / wall.max(1e-9) / 1e6;
        format!(
            "{start}  Δt = {:.3e} s ({})  {speed:.1} M particle-steps/s  left {}",
            step.length,
            step.limit,
            self.reporter.left(part)
        )
    }

    /// The last line of the log and the manifest.
    fn conclude(
        &mut self,
        ended: &Result<(), Failure>,
        manifest: &mut Manifest,
        solver: &dyn Solver,
    ) -> Result<(), Failure> {
        self.reporter.end();
        let (time, steps) = (solver.time(), solver.steps());
        let outcome = match ended {
            Ok(()) => "done".to_owned(),
            Err(failure) => failure.to_string(),
        };
        let wall = self.reporter.elapsed();
        let line = format!("{outcome}: t = {time:.5} s after {steps} steps and {wall:.1} s");
        match ended {
            Err(Failure::Numerical(_)) => self.reporter.note(&line),
            _ => self.reporter.say(&line),
        }
        manifest.end(outcome, steps);
        manifest.write(&mut self.folder)
    }
}

/// When the next row of the history is due: at the first step on or after each multiple of the interval.
struct Records {
    interval: f64,
    next: f64,
}

impl Records {
    fn new(interval: f64) -> Self {
        Self { interval, next: 0.0 }
    }

    fn is_due(&mut self, time: f64) -> bool {
        if time < self.next {
            return false;
        }
        if self.interval > 0.0 {
            self.next = ((time / self.interval * (1.0 + 1e-12)).floor() + 1.0) * self.interval;
        }
        true
    }
}

#[cfg(test)]
mod tests;
