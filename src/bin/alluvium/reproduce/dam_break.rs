//! The collapse of a column of water 0.1 m wide and 0.2 m high in a tank 0.4 m wide.

use super::front::{Front, outside};
use crate::arguments::{PrecisionName, PresetName, ReproduceOptions};
use crate::outcome::Failure;
use crate::plots::{Chart, Panel, ParticlePicture, Series};
use crate::published::{KOSHIZUKA_OKA, KOSHIZUKA_OKA_MPS, MARTIN_MOYCE, points};
use crate::run::{Finished, run_case};
use crate::solver::{View, quantity};
use alluvium::case::Case;
use alluvium::output::{Table, TableError};

/// Width of the column \[m\].
const WIDTH: f64 = 0.1;
const GRAVITY: f64 = 9.81;
/// Fronts at these times lie in these intervals in every computation that was compared.
const EXPECTED: [(f64, f64, f64); 3] = [(1.5, 1.98, 2.08), (2.0, 2.56, 2.70), (2.5, 3.20, 3.38)];

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let (case, warnings) = Case::parse("dam-break", &case_text(options))?;
    let spacing = case.particles.spacing;
    present(run_case(case, &warnings, &options.output, true)?, spacing)
}

/// Compares and draws a finished run.
fn present(finished: Finished, spacing: f64) -> Result<(), Failure> {
    let Finished { mut folder, views, manifest } = finished;
    let text = std::fs::read_to_string(folder.file("history.csv")?)?;
    let table = Table::parse(&text).map_err(|error| bad_table("history.csv", &error))?;
    let results = Results::read(&table).map_err(|error| bad_table("a table", &error))?;
    folder.write("pictures/front.svg", &results.front_picture(spacing))?;
    folder.write("pictures/energy.svg", &results.energy_picture())?;
    folder.write("pictures/time_step.svg", &results.step_picture())?;
    folder.write("pictures/particles.svg", &particles_picture(&views, spacing))?;
    let report = results.report();
    folder.write("report.md", &report)?;
    println!("{report}");
    println!("pictures in {}", folder.path().join("pictures").display());
    manifest.write(&mut folder)
}

fn bad_table(name: &str, error: &TableError) -> Failure {
    Failure::File(std::io::Error::other(format!("{name}: {error}")))
}

/// The case as a file: the paper's sizes, Table 1. The tank's walls are made high enough to keep what
/// splashes up the far side; the paper's end where the column does.
fn case_text(options: &ReproduceOptions) -> String {
    let spacing = options.spacing.unwrap_or(if options.quick { 0.0025 } else { 0.001_25 });
    let (end, times) = if options.quick {
        (0.25, "[0.0, 0.05, 0.1, 0.15, 0.2, 0.25]")
    } else {
        (0.5, "[0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5]")
    };
    let preset = match options.preset {
        PresetName::Default => "default",
        PresetName::Paper => "paper",
    };
    let precision = match options.precision {
        PrecisionName::F32 => "f32",
        PrecisionName::F64 => "f64",
    };
    format!(
        "name = \"dam-break\"\npreset = \"{preset}\"\nprecision = \"{precision}\"\nend_time_s = {end:?}\n\
         [water]\nsound_speed_m_per_s = 25.0\nviscosity_pa_s = 1.0e-3\n\
         [[water.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{WIDTH:?}, 0.2]\n\
         [particles]\nspacing_m = {spacing:?}\n\
         [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [0.4, 0.5]\nopen = [\"+y\"]\n\
         [output]\ndump_times_s = {times}\nhistory_interval_s = 5.0e-4\n"
    )
}

struct Results {
    time: Vec<f64>,
    step: Vec<f64>,
    front: Front,
    /// Names and energies, stored first, then what terms took.
    energies: Vec<(String, Vec<f64>)>,
    published: [(&'static str, Front); 3],
}

impl Results {
    fn read(history: &Table) -> Result<Self, TableError> {
        let time = history.column("time [s]")?;
        let unit = (2.0 * GRAVITY / WIDTH).sqrt();
        let front = history.column(quantity::FRONT)?;
        let front = time.iter().zip(front).map(|(t, x)| (t * unit, x / WIDTH)).collect();
        let stored = [quantity::POTENTIAL, quantity::KINETIC, quantity::COMPRESSIVE].map(str::to_owned);
        let taken = history.columns().iter().filter(|name| name.starts_with(quantity::DISSIPATED)).cloned();
        let energies = stored.into_iter().chain(taken);
        let energies = energies.map(|name| Ok((readable(&name), history.column(&name)?)));
        let published = |name, text, place| Ok((name, Front(points(&Table::parse(text)?, "T", place)?)));
        Ok(Self {
            step: history.column("time_step [s]")?,
            front: Front(front),
            energies: energies.collect::<Result<_, _>>()?,
            published: [
                published("Martin & Moyce 1952, n² = 2", MARTIN_MOYCE, "Z")?,
                published("Koshizuka & Oka 1996, experiment", KOSHIZUKA_OKA, "X")?,
                published("Koshizuka & Oka 1996, MPS", KOSHIZUKA_OKA_MPS, "X")?,
            ],
            time,
        })
    }

    fn front_picture(&self, spacing: f64) -> String {
        let name = format!("alluvium, Δx = {} mm", spacing * 1e3);
        let computed = self.front.0.iter().copied().filter(|p| p.0 <= 3.4).collect();
        let chart = Chart::new("Dam break: the front", "T = t √(2g/L)", "X = x/L")
            .x_range(0.0, 3.4)
            .y_range(0.8, 4.4)
            .with(Series::line(&name, computed));
        let series = |(name, front): &(&str, Front)| Series::points(name, front.0.clone());
        self.published.iter().map(series).fold(chart, Chart::with).svg()
    }

    fn energy_picture(&self) -> String {
        let whole: f64 = self.energies.iter().filter_map(|(_, e)| e.first()).sum();
        let shares = |e: &Vec<f64>| e.iter().map(|e| e / whole).collect::<Vec<_>>();
        let parts: Vec<_> = self.energies.iter().map(|(name, e)| (name.as_str(), shares(e))).collect();
        Chart::new("Where the energy is", "time [s]", "energy / energy at the start")
            .x_range(0.0, self.time.last().copied().unwrap_or(1.0))
            .y_range(0.0, 1.1)
            .with_all(Series::stack(&self.time, &parts))
            .svg()
    }

    fn step_picture(&self) -> String {
        let steps = self.time.iter().copied().zip(self.step.iter().copied()).skip(1).collect();
        Chart::new("Time step", "time [s]", "Δt [s]").with(Series::line("", steps)).svg()
    }

    /// Computed against expected and published, as a table.
    fn report(&self) -> String {
        let mut lines = vec!["| what | computed | expected | |".to_owned(), "|---|---|---|---|".to_owned()];
        let verdict = |good: bool| if good { "as expected" } else { "**not as expected**" };
        for (time, low, high) in EXPECTED {
            let what = format!("front X at T = {time}");
            lines.push(match self.front.at(time) {
                Some(x) => {
                    let good = (low..=high).contains(&x);
                    format!("| {what} | {x:.3} | {low:.2} to {high:.2} | {} |", verdict(good))
                }
                None => format!("| {what} | not reached | {low:.2} to {high:.2} | |"),
            });
        }
        let published: Vec<&Front> = self.published.iter().map(|(_, front)| front).collect();
        let beyond = outside(&self.front, &published, 1.0, 2.9);
        let what = "distance outside the published envelope, 1 < T < 2.9";
        lines.push(format!("| {what} | {beyond:.3} | at most 0.05 | {} |", verdict(beyond <= 0.05)));
        if let Some((rms, shift)) = self.front.distance(published[0], 0.0, 2.9) {
            let what = format!("rms distance to Martin & Moyce after a shift of {shift:.2} in T");
            lines.push(format!("| {what} | {rms:.3} | at most 0.2 | {} |", verdict(rms <= 0.2)));
        }
        "# Dam break\n\n".to_owned() + &lines.join("\n") + "\n"
    }
}

/// `dissipated_by_artificial_viscosity [J]` as words for a legend.
fn readable(column: &str) -> String {
    let name = column.split(" [").next().unwrap_or(column);
    name.replace(quantity::DISSIPATED, "taken by ").replace('_', " ").replace(" energy", "")
}

fn particles_picture(views: &[(f64, View)], spacing: f64) -> String {
    let picture = ParticlePicture {
        quantity: "pressure [kPa]",
        range: (0.0, 2.0),
        window: ([-0.01, -0.01], [0.41, 0.25]),
        spacing,
        axes: ["x [m]", "y [m]"],
        columns: 2,
    };
    let flat = |x: &[f64; 3]| [x[0], x[1]];
    let panel = |(time, view): &(f64, View)| Panel {
        caption: format!("t = {time:.2} s, T = {:.2}", time * (2.0 * GRAVITY / WIDTH).sqrt()),
        particles: view.water.iter().map(|(x, p)| (flat(x), p * 1e-3)).collect(),
        walls: view.walls.iter().map(flat).collect(),
    };
    let shown = views.iter().filter(|(time, _)| *time > 0.04 && *time < 0.35);
    picture.svg(&shown.map(panel).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::{Existing, OutputOptions};
    use crate::run::run_with;
    use crate::stand_in::{self, StandIn};

    fn options(preset: PresetName, quick: bool) -> ReproduceOptions {
        let output = OutputOptions { out: None, existing: Existing::Error, threads: None };
        let (name, precision) = ("dam-break".to_owned(), PrecisionName::F32);
        ReproduceOptions { name, quick, preset, precision, spacing: None, output }
    }

    #[test]
    fn the_case_is_the_papers() {
        for preset in [PresetName::Default, PresetName::Paper] {
            let (case, warnings) = Case::parse("dam-break", &case_text(&options(preset, false))).unwrap();
            assert_eq!(case.water_particles(), 12_800);
            assert_eq!(case.water.sound_speed, 25.0);
            assert_eq!(warnings.problems, []);
            let quick = Case::parse("dam-break", &case_text(&options(preset, true))).unwrap().0;
            assert_eq!(quick.water_particles(), 3_200);
        }
    }

    #[test]
    fn a_run_is_compared_and_drawn() {
        let path = stand_in::folder("dam-break");
        let output = OutputOptions { out: Some(path.clone()), existing: Existing::Error, threads: Some(1) };
        let (case, warnings) = stand_in::case();
        let solver = StandIn::new(f64::INFINITY);
        let finished = run_with(|_| Ok(Box::new(solver)), case, &warnings, &output, true).unwrap();
        present(finished, 0.01).unwrap();
        let report = std::fs::read_to_string(path.join("report.md")).unwrap();
        assert!(report.contains("T = 1.5 | 1.82"), "{report}");
        assert!(report.contains("**not as expected**") && report.contains("rms distance"), "{report}");
        for picture in ["front", "energy", "time_step", "particles"] {
            let svg = std::fs::read_to_string(path.join(format!("pictures/{picture}.svg"))).unwrap();
            assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"), "{picture}");
        }
        let manifest = std::fs::read_to_string(path.join("manifest.json")).unwrap();
        assert!(manifest.contains("pictures/front.svg") && manifest.contains("\"done\""));
        std::fs::remove_dir_all(&path).unwrap();
    }
}
