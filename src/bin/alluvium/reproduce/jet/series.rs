//! The hole against the conductivity of the soil (Fig. 17) and against its volume fraction (Fig. 18).

use super::{Jet, Watch};
use crate::arguments::{OutputOptions, PresetName, ReproduceOptions};
use crate::folder::RunFolder;
use crate::manifest::Manifest;
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::screen;
use alluvium::output::TableWriter;
use alluvium::verify::jet::TANK;
use core::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

/// From gravel to clay. Drag is solved over the step where that is the faster way, from 1e-5 m/s down; the paper's
/// preset evaluates it, which at the last two would take steps below 0.1 µs.
const CONDUCTIVITIES: [f64; 7] = [5e-2, 5e-3, 5e-4, 5e-5, 1e-5, 1e-6, 1e-8];
const EVALUATED: usize = 5;
const QUICK: usize = 3;
const FRACTIONS: [f64; 3] = [0.4, 0.5, 0.6];
/// When holes are compared \[s\].
const WHEN: [f64; 3] = [0.0, 0.005, 0.01];

/// Fig. 17.
pub fn conductivity(options: &ReproduceOptions) -> Result<(), Failure> {
    let count = match (options.quick, options.preset) {
        (true, _) => QUICK,
        (false, PresetName::Paper) => EVALUATED,
        (false, PresetName::Default) => CONDUCTIVITIES.len(),
    };
    let jets = CONDUCTIVITIES[..count].iter().map(|&k| {
        let jet = Jet::of_the_paper(options);
        (k, Jet { name: format!("k_{k:e}"), conductivity: k, dumps: WHEN.to_vec(), ..jet })
    });
    compare(options, Axis { name: "conductivity [m/s]", is_logarithmic: true }, jets.collect())
}

/// Fig. 18.
pub fn fraction(options: &ReproduceOptions) -> Result<(), Failure> {
    let jets = FRACTIONS.iter().map(|&fraction| {
        let jet = Jet::of_the_paper(options);
        (
            fraction,
            Jet {
                name: format!("fraction_{fraction}").replace('.', "_"),
                fraction,
                dumps: WHEN.to_vec(),
                ..jet
            },
        )
    });
    compare(options, Axis { name: "soil_fraction [-]", is_logarithmic: false }, jets.collect())
}

/// What the jets of a series differ in.
struct Axis {
    name: &'static str,
    is_logarithmic: bool,
}

/// Runs each in a folder of its own; a table, pictures, a report.
fn compare(options: &ReproduceOptions, axis: Axis, jets: Vec<(f64, Jet)>) -> Result<(), Failure> {
    let what = axis.name;
    let path = options.output.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&options.name));
    let mut folder = RunFolder::create(&path, options.output.existing)?;
    let case = jets[0].1.case(options)?.0;
    let mut manifest = Manifest::new(&case, options.output.threads.map_or(case.threads, usize::from));
    manifest.write(&mut folder)?;
    let mut done = Vec::new();
    for (value, jet) in jets {
        let output = OutputOptions { out: Some(path.join(&jet.name)), ..options.output.clone() };
        let scheme = jet.case(options)?.0.drag_plan().map_or("none", |plan| plan.scheme.name());
        let clock = Instant::now();
        let watch = jet.run(options, output)?;
        done.push((value, watch, scheme, clock.elapsed().as_secs_f64()));
    }
    let columns = [what, "depth [m]", "width_at_half_depth [m]", "roundness [-]"];
    let mut table = TableWriter::create(folder.file("holes.csv")?, &columns)?;
    let mut report = format!(
        "# {}\n\n| {what} | depth [mm] | width at half depth [mm] | over that at a tenth | drag | run [s] |\n\
         |---|---|---|---|---|---|\n",
        options.name
    );
    let mut chart = Chart::new("The hole at 10 ms", "x [m]", "y [m]").y_range(0.05, TANK[1] + 0.05);
    let mut depths = Vec::new();
    for (value, watch, scheme, seconds) in &done {
        let Some(hole) = Watch::hole_at(watch, WHEN[2]).map(|look| &look.hole) else { continue };
        let (depth, width, roundness) = (hole.depth(), hole.width_at(0.5), hole.roundness());
        table.row(&[*value, depth, width, roundness].map(Into::into))?;
        writeln!(
            report,
            "| {value:e} | {:.1} | {:.0} | {roundness:.2} | {scheme} | {seconds:.0} |",
            1e3 * depth,
            1e3 * width
        )
        .expect("a string");
        chart = chart.with(Series::line(&format!("{value:e}"), hole.floor.clone()));
        depths.push((*value, depth));
    }
    let title = "Depth of the hole at 10 ms";
    let depth = Chart::new(title, what, "depth [m]").logarithmic(axis.is_logarithmic, false);
    folder.write("pictures/depths.svg", &depth.with(Series::points("depth", depths)).svg())?;
    folder.write("pictures/holes.svg", &chart.svg())?;
    folder.write("report.md", &report)?;
    screen::print(report)?;
    screen::print(format_args!("picture in {}", folder.path().join("pictures").display()))?;
    manifest.end("done".to_owned(), 0);
    manifest.write(&mut folder)
}
