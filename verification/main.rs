//! The verification of the library: studies that know beforehand what has to come out.
//!
//! `cargo test --release --features verify --test verification -- [FILTER] [FLAGS]`
//!
//! Own flags, beside those of every test program:
//! `--full` also runs the studies of minutes; `--mutants` also shows that each study of the quick level fails under
//! each of its deliberate mistakes, `--all-mutants` that each study that runs does; `--report FILE` writes what was measured, as JSON or HTML if the name
//! ends so, else as Markdown (`-`: to the terminal); `--resume FILE` keeps every outcome in a file as soon as it
//! is there, and takes from it what this very build has measured before; with `--recorded` nothing else is run, for
//! a report of what a run that goes on, or was stopped, has so far. `cargo verify` is short for the command.
//!
//! A new topic is a file with `pub fn studies() -> Vec<Study>`, and a line in [`studies`].

mod balance;
mod bands;
mod bench;
mod bits;
#[cfg(feature = "case")]
mod budgets;
mod channel;
mod clouds;
mod consolidation;
mod coupled_waves;
mod dam_break;
mod dam_ledger;
mod dam_run;
mod driver;
mod driver_laws;
mod driver_turning;
mod drops;
mod extrapolation;
mod fits;
mod flags;
mod frames;
mod identity;
#[cfg(feature = "implicit")]
mod implicit_drag;
mod interphase;
mod invariance;
#[cfg(feature = "case")]
mod jet;
#[cfg(feature = "case")]
mod jet_3d;
#[cfg(feature = "case")]
mod jet_run;
mod journal;
mod kept_places;
mod kernels;
mod lattice_sums;
mod layers;
mod manufactured;
mod mistaken_motions;
mod mixture_rates;
#[cfg(feature = "case")]
mod momentum;
mod motions;
mod operators;
mod operators_exact;
mod pore_volumes;
mod powers;
mod precision;
mod precision_places;
mod ready;
mod rungs;
#[cfg(feature = "case")]
mod sand_column;
mod saturated_rock;
mod scene;
mod seepage;
mod settling;
mod shared_runs;
mod soil;
mod soil_at_rest;
mod soil_cut;
mod soil_plate;
mod soil_rates;
mod soil_walls;
mod soil_waves;
mod sound;
mod spinning;
mod still_tank;
mod tanks;
mod taylor_green;
#[cfg(feature = "case")]
mod u_tube;
#[cfg(all(feature = "case", feature = "implicit"))]
mod u_tube_of_silt;
mod water;

use alluvium::verify::{Environment, Level, Outcome, Report, Study};
use flags::Flags;
use journal::Journal;
use libtest_mimic::{Arguments, Failed, Trial};
use std::path::Path;
use std::process::ExitCode;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// All studies, topic by topic.
fn studies() -> Vec<Study> {
    [
        dam_break::studies(),
        dam_ledger::studies(),
        kernels::studies(),
        lattice_sums::studies(),
        extrapolation::studies(),
        identity::studies(),
        ready::studies(),
        operators::studies(),
        operators_exact::studies(),
        still_tank::studies(),
        powers::studies(),
        mixture_rates::studies(),
        interphase::studies(),
        seepage::studies(),
        #[cfg(feature = "implicit")]
        implicit_drag::studies(),
        manufactured::studies(),
        invariance::studies(),
        spinning::studies(),
        bits::studies(),
        layers::studies(),
        precision::studies(),
        precision_places::studies(),
        pore_volumes::studies(),
        settling::studies(),
        consolidation::studies(),
        coupled_waves::studies(),
        sound::studies(),
        taylor_green::studies(),
        channel::studies(),
        tanks::studies(),
        drops::studies(),
        soil_at_rest::studies(),
        soil_rates::studies(),
        soil_cut::studies(),
        soil_plate::studies(),
        soil_walls::studies(),
        soil_waves::studies(),
        driver::studies(),
        driver_turning::studies(),
        #[cfg(feature = "case")]
        budgets::studies(),
        #[cfg(feature = "case")]
        momentum::studies(),
        #[cfg(feature = "case")]
        sand_column::studies(),
        #[cfg(feature = "case")]
        u_tube::studies(),
        #[cfg(all(feature = "case", feature = "implicit"))]
        u_tube_of_silt::studies(),
        #[cfg(feature = "case")]
        jet::studies(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// What has been measured, and where it is kept.
#[derive(Default)]
struct Record {
    outcomes: Vec<Outcome>,
    journal: Option<Journal>,
}

type Shared = Arc<Mutex<Record>>;

fn lock(record: &Shared) -> MutexGuard<'_, Record> {
    record.lock().unwrap_or_else(PoisonError::into_inner)
}

fn main() -> ExitCode {
    let (flags, others) = match Flags::split(std::env::args()) {
        Ok(split) => split,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    let arguments = Arguments::from_iter(others);
    let studies = Arc::new(studies());
    assert_unique(&studies);
    let record = Shared::default();
    if let Some(file) = flags.resume.as_ref().filter(|_| !arguments.list) {
        match Journal::open(Path::new(file)) {
            Ok(journal) => {
                eprintln!("{file}: {} outcomes of this build", journal.len());
                lock(&record).journal = Some(journal);
            }
            Err(error) => {
                eprintln!("{file} cannot be resumed from: {error}");
                return ExitCode::from(2);
            }
        }
    }
    let conclusion = libtest_mimic::run(&arguments, trials(&studies, &record, &flags));
    if let (false, Err(error)) = (arguments.list, write_reports(&flags, &studies, &lock(&record).outcomes)) {
        eprintln!("the report could not be written: {error}");
        return ExitCode::FAILURE;
    }
    conclusion.exit_code()
}

/// One trial for each study, and one for each of its mutants. What is not asked for is ignored, so
/// that `--ignored` and `--include-ignored` find it.
fn trials(studies: &Arc<Vec<Study>>, record: &Shared, flags: &Flags) -> Vec<Trial> {
    let mut trials = Vec::new();
    let unrecorded = |study: &Study, mutant| {
        let is_known = |journal: &Journal| journal.known(&study.name, mutant).is_some();
        flags.recorded && !lock(record).journal.as_ref().is_some_and(is_known)
    };
    for (index, study) in studies.iter().enumerate() {
        let too_long = study.level == Level::Full && !flags.full;
        let mistakes = flags.all_mutants || (flags.mutants && study.level == Level::Quick);
        let skip = too_long || unrecorded(study, None);
        trials.push(trial(study.name.clone(), studies, index, None, record).with_ignored_flag(skip));
        for &mutant in &study.mutants {
            let name = format!("{}: {mutant}", study.name);
            let skip = too_long || !mistakes || unrecorded(study, Some(mutant));
            let trial = trial(name, studies, index, Some(mutant), record).with_kind("mutant");
            trials.push(trial.with_ignored_flag(skip));
        }
    }
    trials
}

fn trial(
    name: String,
    studies: &Arc<Vec<Study>>,
    index: usize,
    mutant: Option<&'static str>,
    record: &Shared,
) -> Trial {
    let (studies, record) = (Arc::clone(studies), Arc::clone(record));
    Trial::test(name, move || {
        let study = &studies[index];
        let known = lock(&record).journal.as_ref().and_then(|journal| journal.known(&study.name, mutant));
        let is_new = known.is_none();
        let run = || mutant.map_or_else(|| study.run(), |mutant| study.run_mutant(mutant));
        let outcome = known.unwrap_or_else(run);
        let (good, sentence) = (outcome.is_good(), outcome.sentence.clone());
        let mut record = lock(&record);
        if let Some(journal) = record.journal.as_mut().filter(|_| is_new) {
            journal
                .add(&outcome)
                .map_err(|error| Failed::from(format!("the outcome was not kept: {error}")))?;
        }
        record.outcomes.push(outcome);
        match (good, mutant) {
            (true, _) => Ok(()),
            (false, None) => Err(Failed::from(format!("{}: {sentence}", study.claim))),
            (false, Some(_)) => Err(Failed::from(format!("the mutant was not noticed: {sentence}"))),
        }
    })
}

/// Writes what was asked for; nothing where nothing was.
fn write_reports(flags: &Flags, studies: &[Study], outcomes: &[Outcome]) -> std::io::Result<()> {
    // Before anything is written: a report that git knows would make the next one say it was changed.
    let environment = Environment::detect();
    for file in &flags.reports {
        let report = Report::new(environment.clone(), studies, outcomes);
        match file.as_str() {
            "-" => print!("{}", report.markdown()),
            name if name.ends_with(".json") => std::fs::write(name, report.json())?,
            name if name.ends_with(".html") => std::fs::write(name, report.html())?,
            name => std::fs::write(name, report.markdown())?,
        }
    }
    Ok(())
}

/// Outcomes find their study by name.
fn assert_unique(studies: &[Study]) {
    let mut names: Vec<_> = studies.iter().map(|study| &study.name).collect();
    names.sort_unstable();
    for pair in names.windows(2) {
        assert_ne!(pair[0], pair[1], "two studies have the same name");
    }
}
