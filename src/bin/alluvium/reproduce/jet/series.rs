//! The hole against the conductivity of the soil (Fig. 17) and against its volume fraction (Fig. 18).

use super::{Jet, Watch};
use crate::arguments::{OutputOptions, ReproduceOptions};
use crate::folder::RunFolder;
use crate::manifest::Manifest;
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use alluvium::output::TableWriter;
use alluvium::verify::jet::TANK;
use core::fmt::Write;
use std::path::PathBuf;

/// Down to what explicit drag can bear in reasonable time.
const CONDUCTIVITIES: [f64; 5] = [5e-2, 5e-3, 5e-4, 5e-5, 1e-5];
const FRACTIONS: [f64; 3] = [0.4, 0.5, 0.6];
/// When holes are compared \[s\].
const WHEN: [f64; 3] = [0.0, 0.005, 0.01];

/// Fig. 17.
pub fn conductivity(options: &ReproduceOptions) -> Result<(), Failure> {
    let count = if options.quick { 3 } else { CONDUCTIVITIES.len() };
    let jets = CONDUCTIVITIES[..count].iter().map(|&k| {
        let jet = Jet::of_the_paper(options);
        (k, Jet { name: format!("k_{k:e}"), conductivity: k, dumps: WHEN.to_vec(), ..jet })
    });
    compare(options, "conductivity [m/s]", jets.collect())
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
    compare(options, "soil_fraction [-]", jets.collect())
}

/// Runs each in a folder of its own; a table, a picture, a report.
fn compare(options: &ReproduceOptions, what: &str, jets: Vec<(f64, Jet)>) -> Result<(), Failure> {
    let path = options.output.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&options.name));
    let mut folder = RunFolder::create(&path, options.output.existing)?;
    let case = jets[0].1.case(options)?.0;
    let mut manifest = Manifest::new(&case, options.output.threads.unwrap_or(case.threads));
    manifest.write(&mut folder)?;
    let mut done = Vec::new();
    for (value, jet) in jets {
        let output = OutputOptions { out: Some(path.join(&jet.name)), ..options.output.clone() };
        done.push((value, jet.run(options, output)?));
    }
    let columns = [what, "depth [m]", "width_at_half_depth [m]", "roundness [-]"];
    let mut table = TableWriter::create(folder.file("holes.csv")?, &columns)?;
    let mut report = format!(
        "# {}\n\n| {what} | depth [mm] | width at half depth [mm] | over that at a tenth |\n|---|---|---|---|\n",
        options.name
    );
    let mut chart = Chart::new("The hole at 10 ms", "x [m]", "y [m]").y_range(0.05, TANK[1] + 0.05);
    for (value, watch) in &done {
        let Some(hole) = Watch::hole_at(watch, WHEN[2]).map(|look| &look.hole) else { continue };
        let (depth, width, roundness) = (hole.depth(), hole.width_at(0.5), hole.roundness());
        table.row(&[*value, depth, width, roundness].map(Into::into))?;
        writeln!(report, "| {value:e} | {:.1} | {:.0} | {roundness:.2} |", 1e3 * depth, 1e3 * width)
            .expect("a string");
        chart = chart.with(Series::line(&format!("{value:e}"), hole.floor.clone()));
    }
    folder.write("pictures/holes.svg", &chart.svg())?;
    folder.write("report.md", &report)?;
    println!("{report}");
    println!("picture in {}", folder.path().join("pictures").display());
    manifest.end("done".to_owned(), 0);
    manifest.write(&mut folder)
}
