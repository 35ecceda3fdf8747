//! The collapse of a column of water 0.1 m wide and 0.2 m high in a tank 0.4 m wide.

mod pictures;
mod report;

use super::ledger::Ledger;
use super::{bad_table, head};
use crate::arguments::ReproduceOptions;
use crate::outcome::Failure;
use crate::published::{KOSHIZUKA_OKA, KOSHIZUKA_OKA_MPS, MARTIN_MOYCE, curve, volume_of_fluid};
use crate::run::{Finished, run_case};
use crate::solver::{DamBreak, Solver, View, quantity};
use alluvium::Preset;
use alluvium::case::Case;
use alluvium::output::{Table, TableError};
use alluvium::verify::dam_break::{Curve, HEIGHT, Reference, SPACING, TANK, WIDTH, dimensionless_time, step};

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let spacing = options.spacing.unwrap_or(if options.quick { 2.0 * SPACING } else { SPACING });
    let dumps = "0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5";
    let (case, warnings) = Case::parse("dam-break", &case_text("dam-break", options, spacing, dumps))?;
    let reference = volume_of_fluid().map_err(|error| bad_table("the finite-volume reference", &error))?;
    let mut watch = Watch::new(&reference);
    let finished =
        run_case(case.clone(), &warnings, &options.output, &mut |time, solver| watch.look(time, solver))?;
    present(&case, finished, &watch)
}

/// What is gathered at every dump.
pub(super) struct Watch<'a> {
    reference: &'a Reference,
    views: Vec<(f64, View)>,
    pub(super) measures: Vec<(f64, DamBreak)>,
}

impl<'a> Watch<'a> {
    pub(super) fn new(reference: &'a Reference) -> Self {
        Self { reference, views: Vec::new(), measures: Vec::new() }
    }

    pub(super) fn look(&mut self, time: f64, solver: &mut dyn Solver) {
        self.views.push((time, solver.view()));
        self.measures.push((time, solver.dam_break(self.reference)));
    }

    /// The measures at the dump at `time`.
    fn at(&self, time: f64) -> Option<&DamBreak> {
        self.measures.iter().find(|(at, _)| (at - time).abs() < 1e-6).map(|(_, measures)| measures)
    }
}

/// Compares and draws a finished run.
fn present(case: &Case, finished: Finished, watch: &Watch<'_>) -> Result<(), Failure> {
    let report_head = head::of_report("Dam break", "water", case, &finished, "");
    let mut run = super::results::Results::of(finished)?;
    let results = Results::read(&run.history).map_err(|error| bad_table("a table", &error))?;
    let spacing = case.particles.spacing;
    run.picture("front", &pictures::front(&results, spacing))?;
    run.picture("time_step", &pictures::time_step(&results))?;
    run.picture("particles", &pictures::particles(&watch.views, spacing))?;
    let report = report_head + &report::bars(case, &results, watch);
    run.energy("Dam break")?;
    run.conclude(&report)
}

/// The case as a file: the paper's sizes, Table 1. The tank's walls are eight times as high as the column,
/// to keep all that shoots up the far side; the paper's end where the column does.
pub(super) fn case_text(name: &str, options: &ReproduceOptions, spacing: f64, dumps: &str) -> String {
    let time = match options.preset.preset() {
        Preset::Paper => format!("time_step_s = {:e}", step(spacing)),
        preset @ Preset::Default => format!("courant = {:?}", preset.courant()),
    };
    head::of_case(name, options, dumps)
        + &format!(
            "[water]\nsound_speed_m_per_s = 25.0\nviscosity_pa_s = 1.0e-3\n\
         [[water.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{WIDTH:?}, {HEIGHT:?}]\n\
         [particles]\nspacing_m = {spacing:?}\n\
         [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{TANK:?}, {:?}]\nopen = [\"+y\"]\n\
         [time]\n{time}\n\
         [output]\ndump_times_s = [{dumps}]\nhistory_interval_s = 5.0e-4\n",
            8.0 * HEIGHT
        )
}

/// What the history and the published data say.
pub(super) struct Results {
    time: Vec<f64>,
    /// Times, steps \[s\] and what bounded them, those cut short by an instant of output left out.
    steps: Vec<(f64, f64, String)>,
    front: Curve,
    ledger: Ledger,
    published: [(&'static str, Curve); 3],
}

impl Results {
    fn read(history: &Table) -> Result<Self, TableError> {
        let time = history.column("time [s]")?;
        let front = history.column(quantity::FRONT)?;
        let front = time.iter().zip(front).map(|(t, x)| (dimensionless_time(*t), x / WIDTH)).collect();
        let limits = history.text("limit")?;
        let steps = time.iter().copied().zip(history.column("time_step [s]")?).zip(limits);
        let steps = steps.filter(|(_, limit)| !["none", "end"].contains(limit));
        let steps = steps.map(|((time, step), limit)| (time, step, limit.to_owned()));
        Ok(Self {
            steps: steps.collect(),
            front: Curve::new(front),
            ledger: Ledger::read(history)?,
            published: [
                ("Martin & Moyce 1952, n² = 2", curve(MARTIN_MOYCE, "T", "Z")?),
                ("Koshizuka & Oka 1996, experiment", curve(KOSHIZUKA_OKA, "T", "X")?),
                ("Koshizuka & Oka 1996, MPS", curve(KOSHIZUKA_OKA_MPS, "T", "X")?),
            ],
            time,
        })
    }
}

#[cfg(test)]
mod tests;
