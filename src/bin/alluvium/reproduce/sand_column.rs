//! The collapse of a column of sand 0.2 m wide and 0.1 m high against a wall.

pub(super) mod in_space;
mod pictures;
mod report;
pub(super) mod run_out;
#[cfg(test)]
mod tests;

use super::results::Results;
use super::{bad_table, head};
use crate::arguments::{OutputOptions, PresetName, ReproduceOptions};
use crate::outcome::Failure;
use crate::published::{BUI_FAILURE_LINE, BUI_SURFACE, curve};
use crate::run::{Finished, run_case};
use crate::solver::Solver;
use alluvium::case::{Case, Warnings};
use alluvium::output::{TableError, TableWriter};
use alluvium::verify::Curve;
use alluvium::verify::sand_column::{FRICTION_ANGLE, FailureLine, HEIGHT, MOVED, Pile, Section, WIDTH};

/// The paper's particle spacing \[m\]: 12 800 particles.
const SPACING: f64 = 0.001_25;
/// Where the floor ends \[m\].
const FLOOR: f64 = 0.7;
/// When it is over \[s\], and the instants of pictures before.
const DUMPS: &str = "0.0, 0.1, 0.2, 0.3, 0.5, 1.0";

/// Steps between Shepard means of the stress, with the default preset: seldom enough that the ledger does not
/// feel it, often enough that no pressure alternates from row to row.
const REGULARISED_EVERY: u64 = 200;

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let spacing = options.spacing.unwrap_or(if options.quick { 4.0 * SPACING } else { SPACING });
    let published = Published::read().map_err(|error| bad_table("published data", &error))?;
    let column = Column { spacing, ..Column::of_the_paper(options) };
    let (case, warnings) = column.case(options)?;
    let mut watch = Watch::default();
    let finished =
        run_case(case.clone(), &warnings, &options.output, &mut |time, solver| watch.look(time, solver))?;
    // The paper's preset has the paper's flow rule anyway.
    let beside = match options.preset {
        PresetName::Default => Some(associated(&column, options, &finished)?),
        PresetName::Paper => None,
    };
    present(&case, finished, &Run::of(&watch), beside.as_ref(), &published)
}

/// The same with the flow rule of the paper, in a folder of its own.
fn associated(column: &Column, options: &ReproduceOptions, finished: &Finished) -> Result<Beside, Failure> {
    let column = Column { name: "sand-column-associated", dilatancy: FRICTION_ANGLE, ..*column };
    let (case, warnings) = column.case(options)?;
    let out = Some(finished.folder.path().join("associated"));
    let output = OutputOptions { out, ..options.output.clone() };
    let mut watch = Watch::default();
    let ended = run_case(case, &warnings, &output, &mut |time, solver| watch.look(time, solver));
    let stopped = match ended {
        Ok(_) => None,
        // That it fails is a result.
        Err(Failure::Numerical(what)) => Some(what),
        Err(other) => return Err(other),
    };
    Ok(Beside { run: Run::of(&watch), stopped })
}

/// A column against a wall.
#[derive(Clone, Copy)]
struct Column {
    name: &'static str,
    width: f64,
    height: f64,
    floor: f64,
    spacing: f64,
    dilatancy: f64,
    dumps: &'static str,
    /// Whether the default preset regularises the stress.
    regularised: bool,
}

impl Column {
    /// Table 2.
    fn of_the_paper(options: &ReproduceOptions) -> Self {
        let dilatancy = head::dilatancy(options.preset, FRICTION_ANGLE);
        let (name, dumps) = ("sand-column", DUMPS);
        Self {
            name,
            width: WIDTH,
            height: HEIGHT,
            floor: FLOOR,
            spacing: SPACING,
            dilatancy,
            dumps,
            regularised: true,
        }
    }

    /// The case as a file: 2650 kg/m³ is taken for the density of the bulk, as Table 2 gives no porosity.
    fn text(&self, options: &ReproduceOptions) -> String {
        let Self { name, width, height, floor, spacing, dilatancy, dumps, regularised } = *self;
        let regularisation = match (regularised, options.preset) {
            (true, PresetName::Default) => {
                format!("[soil.stress_regularisation]\nevery_steps = {REGULARISED_EVERY}\n")
            }
            _ => String::new(),
        };
        head::of_case(name, options, dumps)
            + &format!(
                "[soil]\nreference_density_kg_per_m3 = 2650.0\nvolume_fraction = 1.0\nbulk_modulus_pa = 0.7e6\n\
             poissons_ratio = 0.3\nfriction_angle_deg = {FRICTION_ANGLE:?}\n\
             dilatancy_angle_deg = {dilatancy:?}\n{regularisation}\
             [[soil.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {height:?}]\n\
             [particles]\nspacing_m = {spacing:?}\n\
             [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{floor:?}, {:?}]\nopen = [\"+x\", \"+y\"]\n\
             [output]\ndump_times_s = [{dumps}]\nhistory_interval_s = 1.0e-3\n\
             fields = [\"velocity\", \"pressure\", \"stress\", \"plastic_strain\", \
             \"equivalent_plastic_strain\"]\n",
                1.5 * height
            )
    }

    fn case(&self, options: &ReproduceOptions) -> Result<(Case, Warnings), Failure> {
        Ok(Case::parse(self.name, &self.text(options))?)
    }
}

/// What is gathered at every dump.
#[derive(Default)]
struct Watch {
    piles: Vec<(f64, Pile)>,
}

impl Watch {
    fn look(&mut self, time: f64, solver: &mut dyn Solver) {
        self.piles.push((time, solver.pile(Section::FLAT)));
    }
}

/// What came out of a run.
struct Run {
    piles: Vec<(f64, Pile)>,
    surface: Curve,
    failure: FailureLine,
}

impl Run {
    fn of(watch: &Watch) -> Self {
        let ends = watch.piles.first().zip(watch.piles.last());
        let (surface, failure) = ends.map_or_else(Default::default, |((_, start), (_, end))| {
            (end.profile(), FailureLine::between(start, end, MOVED))
        });
        Self { piles: watch.piles.clone(), surface, failure }
    }

    /// The last time looked at \[s\], and the soil then.
    fn end(&self) -> Option<&(f64, Pile)> {
        self.piles.last()
    }

    /// Volume below the surface and of the particles, over those at the start.
    fn bulking(&self) -> Option<(f64, f64)> {
        let ((_, start), (_, end)) = (self.piles.first()?, self.piles.last()?);
        Some((end.volume_below_surface() / start.volume_below_surface(), end.volume() / start.volume()))
    }
}

/// The run beside, and why it stopped, if it did.
struct Beside {
    run: Run,
    stopped: Option<String>,
}

/// The experiment.
struct Published {
    surface: Curve,
    failure: FailureLine,
}

impl Published {
    fn read() -> Result<Self, TableError> {
        let failure = curve(BUI_FAILURE_LINE, "x_m", "y_m")?;
        let failure = FailureLine::new(failure.points().to_vec());
        Ok(Self { surface: curve(BUI_SURFACE, "x_m", "y_m")?, failure })
    }
}

/// Compares and draws finished runs.
fn present(
    case: &Case,
    finished: Finished,
    run: &Run,
    beside: Option<&Beside>,
    published: &Published,
) -> Result<(), Failure> {
    let experiment = " Experiment: Bui et al. 2008, aluminium bars, digitised by others.";
    let report_head = head::of_report("Sand column", "sand", case, &finished, experiment);
    let mut results = Results::of(finished)?;
    write_curve(&mut results.folder, "surface.csv", run.surface.points())?;
    write_curve(&mut results.folder, "failure_line.csv", run.failure.points())?;
    results.picture("surface", &pictures::surface(run, beside, published, case))?;
    results.picture("plastic_strain", &pictures::plastic_strain(run))?;
    results.picture("plastic_shear", &pictures::plastic_shear(run))?;
    if let Some(beside) = beside {
        results.picture("plastic_strain_associated", &pictures::plastic_strain(&beside.run))?;
    }
    let report = report_head
        + &report::bars(run, &results.ledger, published)
        + &report::beside(run, beside, published);
    results.energy("Sand column")?;
    results.conclude(&report)
}

fn write_curve(
    folder: &mut crate::folder::RunFolder,
    name: &str,
    points: &[(f64, f64)],
) -> Result<(), Failure> {
    let mut table = TableWriter::create(folder.file(name)?, &["x [m]", "y [m]"])?;
    Ok(points.iter().try_for_each(|(x, y)| table.row(&[(*x).into(), (*y).into()]))?)
}
