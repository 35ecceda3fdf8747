//! The dam break at four resolutions against a finite-volume solution (paper, Fig. 5).

use super::bad_table;
use super::dam_break::{Watch, case_text};
use crate::arguments::{OutputOptions, ReproduceOptions};
use crate::folder::RunFolder;
use crate::manifest::Manifest;
use crate::outcome::Failure;
use crate::plots::convergence;
use crate::published::volume_of_fluid;
use crate::run::run_case;
use crate::screen;
use alluvium::case::Case;
use alluvium::output::TableWriter;
use alluvium::verify::OrderFit;
use alluvium::verify::dam_break::{Reference, SPACING, VelocityError};
use core::fmt::Write;
use std::path::{Path, PathBuf};

/// The instant of the comparison \[s\].
const TIME: &str = "0.2";

/// One resolution and its error.
struct Point {
    spacing: f64,
    error: VelocityError,
    steps: u64,
    wall_clock: f64,
}

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let finest = options.spacing.unwrap_or(if options.quick { 2.0 * SPACING } else { SPACING });
    let reference = volume_of_fluid().map_err(|error| bad_table("the finite-volume reference", &error))?;
    let path = options.output.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&options.name));
    let mut folder = RunFolder::create(&path, options.output.existing)?;
    let case = case_of(options, finest)?.0;
    let mut manifest = Manifest::new(&case, options.output.threads.map_or(case.threads, usize::from));
    manifest.write(&mut folder)?;
    let count = if options.quick { 3 } else { 4 };
    let mut points = Vec::new();
    for spacing in (0..count).rev().map(|n| finest * f64::from(1 << n)) {
        points.push(run(options, spacing, &reference, &path)?);
    }
    present(&mut folder, &case, &points)?;
    manifest.end("done".to_owned(), points.iter().map(|point| point.steps).sum());
    manifest.write(&mut folder)
}

fn case_of(options: &ReproduceOptions, spacing: f64) -> Result<(Case, alluvium::case::Warnings), Failure> {
    let text = case_text(&options.name, options, spacing, &format!("0.0, {TIME}"));
    Ok(Case::parse(&options.name, &text)?)
}

/// One resolution, in a folder of its own.
fn run(
    options: &ReproduceOptions,
    spacing: f64,
    reference: &Reference,
    path: &Path,
) -> Result<Point, Failure> {
    let (case, warnings) = case_of(options, spacing)?;
    let out = Some(path.join(format!("spacing_{:.3}mm", spacing * 1e3)));
    let output = OutputOptions { out, ..options.output.clone() };
    let mut watch = Watch::new(reference);
    let finished = run_case(case, &warnings, &output, &mut |time, solver| watch.look(time, solver))?;
    let measures = watch.measures.last().map(|(_, measures)| measures.velocity);
    let error = measures.ok_or_else(|| Failure::Numerical("nothing was measured".to_owned()))?;
    Ok(Point { spacing, error, steps: finished.steps, wall_clock: finished.wall_clock })
}

/// A table, a picture, a report.
fn present(folder: &mut RunFolder, case: &Case, points: &[Point]) -> Result<(), Failure> {
    let columns = ["spacing [m]", "error (78) [-]", "compared", "left_out", "steps", "wall_clock [s]"];
    let mut table = TableWriter::create(folder.file("errors.csv")?, &columns)?;
    for point in points {
        let error = point.error;
        let counts = [error.compared as u64, error.left_out as u64, point.steps];
        let numbers = [point.spacing.into(), error.l2.into()];
        let row = numbers.into_iter().chain(counts.map(Into::into)).chain([point.wall_clock.into()]);
        table.row(&row.collect::<Vec<_>>())?;
    }
    let errors: Vec<_> = points.iter().map(|point| (point.spacing, point.error.l2)).collect();
    let title = format!("Dam break: error against finite volumes at t = {TIME} s");
    let (svg, fit) = convergence(&title, "Δx [m]", "L₂ error (78) of the horizontal velocity", &errors, 1.0);
    folder.write("pictures/convergence.svg", &svg)?;
    let report = report(case, points, fit);
    folder.write("report.md", &report)?;
    screen::print(report)?;
    screen::print(format_args!("picture in {}", folder.path().join("pictures").display()))?;
    Ok(())
}

fn report(case: &Case, points: &[Point], fit: Option<OrderFit>) -> String {
    let mut text = format!(
        "# Dam break: convergence\n\nPreset `{}`, {}: L₂ error (78) of the horizontal velocity at t = {TIME} s \
         against a finite-volume solution on cells of 1.25 mm. Particles more than 1.5 cells from a cell of \
         water are left out.\n\n| Δx [m] | error | order | compared | left out | steps |\n|---|---|---|---|---|---|\n",
        case.preset, case.precision
    );
    for (n, point) in points.iter().enumerate() {
        let order = n.checked_sub(1).map(|m| &points[m]).map_or("–".to_owned(), |coarser| {
            let ratio = (coarser.error.l2 / point.error.l2).ln() / (coarser.spacing / point.spacing).ln();
            format!("{ratio:.2}")
        });
        let VelocityError { l2, compared, left_out } = point.error;
        writeln!(
            text,
            "| {} | {l2:.4} | {order} | {compared} | {left_out} | {} |",
            point.spacing, point.steps
        )
        .ok();
    }
    if let Some(OrderFit { order, half_width, .. }) = fit {
        let sentence =
            format!("Fitted order: {order:.2} ± {half_width:.2} (95 %; the paper found less than one).");
        writeln!(text, "\n{sentence}").ok();
    }
    text
}
