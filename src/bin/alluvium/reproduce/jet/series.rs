//! The hole against the conductivity of the soil (Fig. 17) and against its volume fraction (Fig. 18).

use super::{FRICTION_ANGLE, Jet, Watch};
use crate::arguments::{OutputOptions, PresetName, ReproduceOptions};
use crate::folder::RunFolder;
use crate::manifest::Manifest;
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
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

/// Fig. 17, with the paper's flow rule, and by default of soil that keeps its volume as well.
pub fn conductivity(options: &ReproduceOptions) -> Result<(), Failure> {
    let count = match (options.quick, options.preset) {
        (true, _) => QUICK,
        (false, PresetName::Paper) => EVALUATED,
        (false, PresetName::Default) => CONDUCTIVITIES.len(),
    };
    let jet = Jet::of_the_paper(options);
    let mut rules = vec![("", jet.dilatancy)];
    if jet.dilatancy < FRICTION_ANGLE {
        rules.push(("associated_", FRICTION_ANGLE));
    }
    let of_rule = |(rule, dilatancy): (&'static str, f64)| {
        let jet = jet.clone();
        CONDUCTIVITIES[..count].iter().map(move |&k| {
            let name = format!("{rule}k_{k:e}");
            (k, Jet { name, conductivity: k, dilatancy, dumps: WHEN.to_vec(), ..jet.clone() })
        })
    };
    let jets = rules.into_iter().flat_map(of_rule).collect();
    compare(options, Axis { name: "conductivity [m/s]", is_logarithmic: true, deepens: true }, jets)
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
    let axis = Axis { name: "soil_fraction [-]", is_logarithmic: false, deepens: false };
    compare(options, axis, jets.collect())
}

/// What the jets of a series differ in.
struct Axis {
    name: &'static str,
    is_logarithmic: bool,
    /// Whether more of it should dig deeper; if not, less deep.
    deepens: bool,
}

/// Runs each in a folder of its own; a table, pictures, a report.
fn compare(options: &ReproduceOptions, axis: Axis, jets: Vec<(f64, Jet)>) -> Result<(), Failure> {
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
    let report = Holes { axis: &axis, done: &done }.write(&mut folder, &options.name)?;
    screen::print(report)?;
    screen::print(format_args!("picture in {}", folder.path().join("pictures").display()))?;
    manifest.end("done".to_owned(), 0);
    manifest.write(&mut folder)
}

/// The runs of a series, with the value they differ in, how drag was taken and how long it took \[s\].
struct Holes<'a> {
    axis: &'a Axis,
    done: &'a [(f64, Watch, &'static str, f64)],
}

impl Holes<'_> {
    /// The table, as a file and as a report, and the charts.
    fn write(&self, folder: &mut RunFolder, title: &str) -> Result<String, Failure> {
        let what = self.axis.name;
        let columns = [
            "ψ [°]",
            what,
            "depth [m]",
            "width_at_half_depth [m]",
            "roundness [-]",
            "curvature [1/m]",
            "section [m²]",
        ];
        let mut table = TableWriter::create(folder.file("holes.csv")?, &columns)?;
        let mut report = format!(
            "# {title}\n\n| ψ [°] | {what} | depth [mm] | width at half depth [mm] | over that at a tenth | \
             curvature of the floor [1/m] | section [cm²] | drag | run [s] |\n|---|---|---|---|---|---|---|---|---|\n",
        );
        let mut floors = Chart::new("The hole at 10 ms", "x [m]", "y [m]").y_range(0.05, TANK[1] + 0.05);
        for (value, watch, scheme, seconds) in self.done {
            let Some(hole) = watch.hole_at(WHEN[2]).map(|look| &look.hole) else { continue };
            let (psi, depth, width, roundness) =
                (watch.jet.dilatancy, hole.depth(), hole.width_at(0.5), hole.roundness());
            let (curvature, section) = (hole.curvature(), hole.area());
            table.row(&[psi, *value, depth, width, roundness, curvature, section].map(Into::into))?;
            let [depth_mm, width_mm] = [depth, width].map(|it| 1e3 * it);
            writeln!(
                report,
                "| {psi} | {value:e} | {depth_mm:.1} | {width_mm:.0} | {roundness:.2} | {curvature:.1} | {:.1} | {scheme} | \
                 {seconds:.0} |",
                1e4 * section
            )
            .expect("a string");
            floors = floors.with(Series::line(&format!("ψ = {psi}°, {value:e}"), hole.floor.clone()));
        }
        let depths = self.depths();
        write!(report, "\n{}", self.bars(&depths).markdown()).expect("a string");
        let chart = Chart::new("Depth of the hole at 10 ms", what, "depth [m]")
            .logarithmic(self.axis.is_logarithmic, false);
        let chart = depths
            .into_iter()
            .fold(chart, |chart, (psi, points)| chart.with(Series::points(&format!("ψ = {psi}°"), points)));
        folder.write("pictures/depths.svg", &chart.svg())?;
        folder.write("pictures/holes.svg", &floors.svg())?;
        folder.write("report.md", &report)?;
        Ok(report)
    }

    /// For each ψ \[°\] the values, ascending, and the depths \[m\].
    fn depths(&self) -> Vec<(f64, Vec<(f64, f64)>)> {
        let of_rule = |done: &[(f64, Watch, &str, f64)]| {
            let depth = |watch: &Watch| Some(watch.hole_at(WHEN[2])?.hole.depth());
            let points = done.iter().filter_map(|(value, watch, ..)| Some((*value, depth(watch)?)));
            let mut points: Vec<_> = points.collect();
            points.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            (done[0].1.jet.dilatancy, points)
        };
        self.done.chunk_by(|a, b| a.1.jet.dilatancy == b.1.jet.dilatancy).map(of_rule).collect()
    }

    /// Each hole against the one before, from the least value on.
    fn bars(&self, depths: &[(f64, Vec<(f64, f64)>)]) -> Bars {
        let Axis { name, deepens, .. } = self.axis;
        let mut table = Bars::default();
        for (psi, points) in depths {
            // Only of soil that must swell to flow is depth a matter of conductivity (decision 25).
            let is_asked = !deepens || *psi == FRICTION_ANGLE;
            let bar = match (is_asked, deepens) {
                (false, _) => "none",
                (true, true) => "deeper than the one before",
                (true, false) => "shallower than the one before",
            };
            for pair in points.windows(2) {
                let [(_, before), (value, depth)] = [pair[0], pair[1]];
                let what = format!("depth at {name} {value:e}, ψ = {psi}°, and of the one before");
                let met = if *deepens { depth > before } else { depth < before };
                let found = format!("{:.1}, {:.1} mm", 1e3 * depth, 1e3 * before);
                table.add(&what, found, bar, is_asked.then_some(met));
            }
        }
        table
    }
}
