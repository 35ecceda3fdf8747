//! Water that seeps through soil from one arm of a U-tube to the other.

mod report;

use super::results::Results;
use crate::arguments::{PresetName, ReproduceOptions};
use crate::outcome::Failure;
use crate::plots::{Panel, ParticlePicture};
use crate::run::{Finished, run_case};
use crate::solver::Solver;
use alluvium::case::Case;
use alluvium::output::TableWriter;
use alluvium::verify::u_tube::{
    ARMS, CHANNEL, HeadProfile, LEVELS, Levels, POROSITY, SPACING, WIDTH, exact_difference,
};
use core::fmt::Write;

/// Hydraulic conductivity k \[m/s\].
const CONDUCTIVITY: f64 = 0.01;
/// When it is over \[s\], and how often it is looked at.
const END: f64 = 200.0;
const QUICK_END: f64 = 3.0;
/// Layers of walls in the paper's counts.
const LAYERS: usize = 3;

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    if options.spacing.is_some() {
        let why = "the U-tube is told in spacings of 0.05 m: it has no other";
        return Err(Failure::Usage(why.to_owned()));
    }
    let (case, warnings) = Case::parse("u-tube", &text(options))?;
    let mut watch = Watch::default();
    let finished =
        run_case(case.clone(), &warnings, &options.output, &mut |time, solver| watch.look(time, solver))?;
    present(&case, finished, &watch)
}

/// The case as a file. Speed of sound 60 m/s, so that the water's own weight presses it together by a
/// millimetre only.
fn text(options: &ReproduceOptions) -> String {
    let (end, interval) = if options.quick { (QUICK_END, 0.5) } else { (END, 2.0) };
    let sizes = match options.preset {
        PresetName::Default => "smoothing_ratio = 2.25",
        PresetName::Paper => "",
    };
    let (preset, precision) = (options.preset.preset(), options.precision.name());
    let at = |n: usize| n as f64 * SPACING;
    let (tube, channel, top) = (at(WIDTH), at(CHANNEL), at(WIDTH + ARMS));
    let (begin, end_of_soil) = (WIDTH, CHANNEL - WIDTH);
    let mut text = format!(
        "name = \"u-tube\"\npreset = \"{preset}\"\nprecision = \"{precision}\"\nend_time_s = {end:?}\n\
         [particles]\nspacing_m = {SPACING:?}\n{sizes}\n\
         [soil]\nreference_density_kg_per_m3 = 2650.0\nvolume_fraction = {:?}\nbulk_modulus_pa = 0.7e6\n\
         poissons_ratio = 0.3\nyield_surface = \"elastic\"\n\
         [[soil.block]]\nlow_m = [{tube:?}, 0.0]\nhigh_m = [{:?}, {tube:?}]\nheld = true\n\
         [mixture]\nhydraulic_conductivity_m_per_s = {CONDUCTIVITY:?}\n\
         [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{channel:?}, {top:?}]\nopen = [\"+y\"]\n\
         [output]\ndump_interval_s = {interval:?}\nhistory_interval_s = 0.1\n\
         fields = [\"velocity\", \"pressure\", \"volume_fraction\"]\n\
         [water]\nsound_speed_m_per_s = 60.0\n",
        1.0 - POROSITY,
        at(end_of_soil),
    );
    // What stands between the arms. The paper's counts are those of its sides and bottom in three layers, without a lid.
    let [left, right, inner_left, inner_right] =
        [begin, end_of_soil, begin + LAYERS, end_of_soil - LAYERS].map(at);
    let (bottom, inner_bottom) = (tube, at(WIDTH + LAYERS));
    let boxes = match options.preset {
        PresetName::Default => vec![[left, bottom, right, top]],
        PresetName::Paper => vec![
            [left, bottom, inner_left, top],
            [inner_right, bottom, right, top],
            [inner_left, bottom, inner_right, inner_bottom],
        ],
    };
    for [left, low, right, high] in boxes {
        write!(text, "[[tank.obstacle]]\nlow_m = [{left:?}, {low:?}]\nhigh_m = [{right:?}, {high:?}]\n")
            .expect("a string");
    }
    let mut block = |columns: [usize; 2], height: usize, surface: f64| {
        let [low, high] = columns.map(at);
        write!(
            text,
            "[[water.block]]\nlow_m = [{low:?}, 0.0]\nhigh_m = [{high:?}, {:?}]\nsurface_m = {surface:?}\n",
            at(height)
        )
        .expect("a string");
    };
    let [left, right] = LEVELS.map(|level| WIDTH + level);
    block([0, begin], left, at(left));
    block([end_of_soil, CHANNEL], right, at(right));
    // Column by column through the soil: the head falls evenly from the start.
    for column in begin..end_of_soil {
        let part = (column as f64 + 0.5 - begin as f64) / (end_of_soil - begin) as f64;
        block([column, column + 1], WIDTH, at(left) + (at(right) - at(left)) * part);
    }
    text
}

/// What is gathered at every dump.
#[derive(Default)]
struct Watch {
    levels: Vec<Levels>,
    heads: Vec<HeadProfile>,
    pictures: Vec<Panel>,
}

impl Watch {
    fn look(&mut self, time: f64, solver: &mut dyn Solver) {
        let water = solver.parcels().water;
        self.levels.push(Levels::of(time, &water));
        self.heads.push(HeadProfile::of(time, &water));
        let view = solver.view();
        let panel = Panel {
            caption: format!("t = {time:.1} s"),
            layers: vec![water.iter().map(|it| (it.place, it.pressure * 1e-3)).collect()],
            walls: view.walls.iter().map(|[x, y, _]| [*x, *y]).collect(),
            lines: Vec::new(),
        };
        // The start and the last.
        self.pictures.truncate(1);
        self.pictures.push(panel);
    }
}

/// Compares and draws a finished run.
fn present(case: &Case, finished: Finished, watch: &Watch) -> Result<(), Failure> {
    let head = report::head(case, &finished);
    let mut results = Results::of(finished)?;
    let columns = [
        "time [s]",
        "difference_exact [m]",
        "difference_by_mass [m]",
        "difference_by_surface [m]",
        "difference_by_head [m]",
        "darcy_velocity [m/s]",
    ];
    let mut rows = TableWriter::create(results.folder.file("levels.csv")?, &columns)?;
    for levels in &watch.levels {
        let Levels { time, surface, head, flow, .. } = *levels;
        let by_mass = levels.by_mass(&watch.levels[0]);
        rows.row(
            &[time, exact_difference(time, CONDUCTIVITY), by_mass, surface, head, flow].map(Into::into),
        )?;
    }
    results.picture("levels", &report::levels(&watch.levels))?;
    results.picture("errors", &report::errors(&watch.levels))?;
    results.picture("head", &report::heads(&watch.heads))?;
    results.picture("darcy_velocity", &report::flow(&watch.levels))?;
    results.picture("pressure", &pressure(&watch.pictures))?;
    let report = head + &report::bars(&watch.levels, &results.ledger);
    results.energy("U-tube")?;
    results.conclude(&report)
}

fn pressure(panels: &[Panel]) -> String {
    let side = 4.0 * SPACING;
    ParticlePicture {
        quantity: "pressure [kPa]",
        range: (0.0, 40.0),
        window: ([-side, -side], [CHANNEL as f64 * SPACING + side, (WIDTH + ARMS) as f64 * SPACING]),
        spacing: SPACING,
        axes: ["x [m]", "y [m]"],
        columns: 2,
    }
    .svg(panels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::{Existing, OutputOptions, PrecisionName};
    use alluvium::kernel::WendlandC2;

    /// 3 108 particles of water and 567 of soil in both presets, 1 158 of walls in the paper's.
    #[test]
    fn the_counts_are_the_papers() {
        for (preset, walls) in [(PresetName::Default, 2015), (PresetName::Paper, 1158)] {
            let output = OutputOptions { out: None, existing: Existing::Error, threads: None };
            let (name, precision) = ("u-tube".to_owned(), PrecisionName::F64);
            let options = ReproduceOptions { name, quick: true, preset, precision, spacing: None, output };
            let case = Case::parse("u-tube", &text(&options)).unwrap().0;
            let kernel = WendlandC2::new(case.smoothing_length()).unwrap();
            let mixture = case.mixture::<f64, 2, _>(kernel).unwrap();
            let (soil, water) = (mixture.soil(), mixture.water());
            assert_eq!((water.wall_particles(), water.len()), (walls, walls + 3108));
            assert_eq!(
                soil.positions()
                    .iter()
                    .filter(|x| x[0] > 1.05 && x[0] < 2.4 && x[1] > 0.0 && x[1] < 1.05)
                    .count(),
                567
            );
        }
    }
}
