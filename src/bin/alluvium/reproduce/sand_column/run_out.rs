//! How far columns of other shapes run, over the laws of other experiments.

use super::{Column, FRICTION_ANGLE, Watch};
use crate::arguments::{OutputOptions, ReproduceOptions};
use crate::folder::RunFolder;
use crate::manifest::Manifest;
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::reproduce::head;
use crate::run::run_case;
use crate::screen;
use alluvium::output::TableWriter;
use alluvium::verify::sand_column::{Pile, RUN_OUT, ScalingLaw, run_out};
use core::fmt::Write;
use std::path::{Path, PathBuf};

/// Width of every column \[m\].
const WIDTH: f64 = 0.1;
/// Particles along it.
const PARTICLES: f64 = 40.0;
/// Aspect ratios a = H₀/L₀, and how long each is watched \[s\]: ten times √(H₀/g), and more.
const COLUMNS: [(f64, &str); 7] = [
    (0.5, "0.0, 0.8"),
    (0.7, "0.0, 0.9"),
    (1.0, "0.0, 1.1"),
    (1.5, "0.0, 1.3"),
    (2.0, "0.0, 1.5"),
    (3.0, "0.0, 1.8"),
    (4.0, "0.0, 2.1"),
];
/// Those of a quick run.
const QUICK: [f64; 3] = [0.5, 1.0, 2.0];

/// One column and where it came to lie.
struct Point {
    aspect_ratio: f64,
    pile: Pile,
    steps: u64,
    wall_clock: f64,
}

impl Point {
    fn run_out(&self) -> f64 {
        run_out(self.pile.front(), WIDTH)
    }

    fn final_height(&self) -> f64 {
        self.pile.surface(0.0) / WIDTH
    }
}

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let particles = if options.quick { 0.5 * PARTICLES } else { PARTICLES };
    let spacing = options.spacing.unwrap_or(WIDTH / particles);
    let columns = COLUMNS.iter().filter(|(ratio, _)| !options.quick || QUICK.contains(ratio));
    let columns: Vec<Column> =
        columns.map(|(ratio, dumps)| column(*ratio, dumps, spacing, options)).collect();
    let path = options.output.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(&options.name));
    let mut folder = RunFolder::create(&path, options.output.existing)?;
    let case = columns[0].case(options)?.0;
    let mut manifest = Manifest::new(&case, options.output.threads.map_or(case.threads, usize::from));
    manifest.write(&mut folder)?;
    let points = columns.iter().map(|column| run(column, options, &path)).collect::<Result<Vec<_>, _>>()?;
    present(&mut folder, &points, spacing)?;
    manifest.end("done".to_owned(), points.iter().map(|point| point.steps).sum());
    manifest.write(&mut folder)
}

fn column(ratio: f64, dumps: &'static str, spacing: f64, options: &ReproduceOptions) -> Column {
    let dilatancy = head::dilatancy(options.preset, FRICTION_ANGLE);
    let floor = WIDTH * (2.0 + 4.5 * ratio).ceil();
    Column {
        name: "column",
        width: WIDTH,
        height: ratio * WIDTH,
        floor,
        spacing,
        dilatancy,
        dumps,
        regularised: false,
    }
}

/// One column, in a folder of its own.
fn run(column: &Column, options: &ReproduceOptions, path: &Path) -> Result<Point, Failure> {
    let aspect_ratio = column.height / column.width;
    let (case, warnings) = column.case(options)?;
    let out = Some(path.join(format!("aspect_{aspect_ratio:.1}")));
    let output = OutputOptions { out, ..options.output.clone() };
    let mut watch = Watch::default();
    let finished = run_case(case, &warnings, &output, &mut |time, solver| watch.look(time, solver))?;
    let last = watch.piles.pop().map(|(_, pile)| pile);
    let pile = last.ok_or_else(|| Failure::Numerical("nothing was measured".to_owned()))?;
    Ok(Point { aspect_ratio, pile, steps: finished.steps, wall_clock: finished.wall_clock })
}

/// A table, a picture, a report.
fn present(folder: &mut RunFolder, points: &[Point], spacing: f64) -> Result<(), Failure> {
    let columns =
        ["aspect_ratio [-]", "run_out [-]", "final_height [-]", "rms_velocity [m/s]", "wall_clock [s]"];
    let mut table = TableWriter::create(folder.file("run_out.csv")?, &columns)?;
    for point in points {
        let speed = point.pile.rms_velocity();
        let row = [point.aspect_ratio, point.run_out(), point.final_height(), speed, point.wall_clock];
        table.row(&row.map(Into::into))?;
    }
    let computed: Vec<_> = points.iter().map(|point| (point.aspect_ratio, point.run_out())).collect();
    folder.write("pictures/run_out.svg", &picture(&computed, spacing))?;
    let report = report(points, spacing);
    folder.write("report.md", &report)?;
    screen::print(report)?;
    screen::print(format_args!("picture in {}", folder.path().join("pictures").display()))?;
    Ok(())
}

/// Aspect ratios that are drawn.
const DRAWN: (f64, f64) = (0.35, 5.0);

/// Run-out over the laws, log–log.
pub fn picture(computed: &[(f64, f64)], spacing: f64) -> String {
    let chart = Chart::new("Columns: how far they run", "a = H₀/L₀", "(L∞ − L₀)/L₀")
        .logarithmic(true, true)
        .x_range(DRAWN.0, DRAWN.1)
        .y_range(0.3, 16.0);
    let colours = ["#009e73", "#e69f00", "#999999", "#0072b2"];
    let chart = first_of_each_source().zip(colours).fold(chart, |chart, (first, colour)| {
        let laws = RUN_OUT.iter().filter(|law| law.source == first.source).map(sampled);
        let mut name = first.source;
        laws.filter(|curve| !curve.is_empty()).fold(chart, |chart, curve| {
            chart.with(Series::line(core::mem::take(&mut name), curve).coloured(colour))
        })
    });
    let name = format!("alluvium, θ = {FRICTION_ANGLE}°, Δx = {} mm", spacing * 1e3);
    chart.with(Series::points(&name, computed.to_vec()).coloured("#d55e00")).svg()
}

/// One law of each source.
fn first_of_each_source() -> impl Iterator<Item = &'static ScalingLaw> {
    let is_first = |n: usize| RUN_OUT[..n].iter().all(|before| before.source != RUN_OUT[n].source);
    RUN_OUT.iter().enumerate().filter(move |(n, _)| is_first(*n)).map(|(_, law)| law)
}

/// A law where it holds and is drawn.
fn sampled(law: &ScalingLaw) -> Vec<(f64, f64)> {
    let (low, high) = (law.range.0.max(DRAWN.0), law.range.1.min(DRAWN.1));
    let ratio = |n: i32| low * (high / low).powf(f64::from(n) / 8.0);
    let at = |n: i32| law.at(ratio(n).clamp(low, high)).map(|y| (ratio(n), y));
    if low < high { (0..=8).filter_map(at).collect() } else { Vec::new() }
}

fn report(points: &[Point], spacing: f64) -> String {
    let mut text = format!(
        "# Columns of other shapes\n\nColumns {WIDTH} m wide, θ = {FRICTION_ANGLE}°, Δx = {} mm: where the heap \
         ends, over the laws of other experiments. No bar: the laws differ among themselves by more than a \
         factor of two.\n\n| a | (L∞ − L₀)/L₀ | laws | height at the wall / L₀ | rms velocity [m/s] |\n\
         |---|---|---|---|---|\n",
        spacing * 1e3
    );
    for point in points {
        let laws = RUN_OUT.iter().filter_map(|law| Some((law, law.at(point.aspect_ratio)?)));
        let laws: Vec<_> = laws.map(|(law, x)| format!("{x:.2} {}", law.source)).collect();
        let (run_out, height, speed) = (point.run_out(), point.final_height(), point.pile.rms_velocity());
        let ratio = point.aspect_ratio;
        writeln!(text, "| {ratio:.1} | {run_out:.2} | {} | {height:.2} | {speed:.1e} |", laws.join("; "))
            .ok();
    }
    text += "\n";
    for law in first_of_each_source() {
        writeln!(text, "- {}: {}.", law.source, law.reliability).ok();
    }
    text
}
