//! Small cases of soil and water: what they share.

pub mod bank_erosion;
pub mod consolidation;
pub mod darcy_column;
pub mod saturated_rest;
pub mod settling;
pub mod submerged_collapse;
#[cfg(test)]
mod tests;

use super::bars::Bars;
use super::head;
use super::ledger::Ledger;
use super::results::Results;
use crate::arguments::{OutputOptions, ReproduceOptions};
use crate::outcome::Failure;
use crate::plots::{Chart, Panel, ParticlePicture, Series};
use crate::run::{Finished, run_case};
use crate::solver::{Parcels, quantity};
use alluvium::case::Case;
use alluvium::verify::Parcel;
use alluvium::verify::sand_column::{Pile, Section};
use core::fmt::Write;

/// Density of water \[kg/m³\] and g \[m/s²\].
const WATER: f64 = 1000.0;
const GRAVITY: f64 = 9.81;

/// One instant.
struct Look {
    time: f64,
    parcels: Parcels,
    pile: Pile,
}

/// A run and what was seen at every dump.
struct Watched {
    case: Case,
    finished: Finished,
    looks: Vec<Look>,
}

/// Runs a case told as a file.
fn run(name: &str, text: &str, output: &OutputOptions) -> Result<Watched, Failure> {
    let (case, warnings) = Case::parse(name, text)?;
    let mut looks = Vec::new();
    let finished = run_case(case.clone(), &warnings, output, &mut |time, solver| {
        looks.push(Look { time, parcels: solver.parcels(), pile: solver.pile(Section::FLAT) });
    })?;
    Ok(Watched { case, finished, looks })
}

/// `count` instants a step apart after the start, up to `end` \[s\], as a list in a case file.
fn dumps(end: f64, count: usize) -> String {
    let times: Vec<String> = (0..=count).map(|n| format!("{:?}", end * n as f64 / count as f64)).collect();
    times.join(", ")
}

/// Refuses another spacing than the case's own.
fn one_spacing_only(options: &ReproduceOptions) -> Result<(), Failure> {
    match options.spacing {
        None => Ok(()),
        Some(_) => {
            Err(Failure::Usage(format!("`{}` is told in its own spacing: it has no other", options.name)))
        }
    }
}

/// A block of water in a case file: row or column of one spacing whose centre is at the height, or place,
/// `centre` \[m\] measured against gravity of strength `gravity` \[m/s²\], under a pressure \[Pa\].
fn water_block(
    text: &mut String,
    [low, high]: [[f64; 2]; 2],
    [centre, gravity]: [f64; 2],
    pressure: f64,
    velocity: [f64; 2],
) {
    let surface = centre + pressure / (WATER * gravity);
    writeln!(
        text,
        "[[water.block]]\nlow_m = {low:?}\nhigh_m = {high:?}\nsurface_m = {surface:?}\nvelocity_m_per_s = \
         {velocity:?}"
    )
    .expect("a string");
}

/// The largest energy nobody explains.
fn closure_bar(bars: &mut Bars, ledger: &Ledger) {
    let largest = ledger.closure.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let what = "energy closure, the largest, over the potential energy at the start";
    bars.add(what, format!("{largest:.1e}"), "none", None);
}

/// The least and the largest of these.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::MAX, f64::MIN), |(least, most), x| (least.min(x), most.max(x)))
}

/// Root of the mean of the squared speeds \[m/s\].
fn rms_speed(parcels: &[Parcel]) -> f64 {
    (parcels.iter().map(|it| it.speed().powi(2)).sum::<f64>() / parcels.len().max(1) as f64).sqrt()
}

/// Mean of what is measured on particles; NaN of none.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    sum / count
}

/// Soil that water carries off or stands over: what is told and drawn of it.
struct Flow<'a> {
    title: &'a str,
    /// Of the set-up, behind the title.
    more: &'a str,
    /// In the titles of charts.
    name: &'a str,
    /// Upper right corner of the pictures \[m\].
    window: [f64; 2],
    spacing: f64,
    /// Numbers of the dumps that are drawn.
    drawn: &'a [usize],
    /// Speed at the end of the colours \[m/s\].
    fastest: f64,
}

impl Flow<'_> {
    /// Writes the report, with these bars, and the pictures, with one of its own and its file's name.
    fn present(&self, watched: Watched, mut bars: Bars, (file, own): (&str, String)) -> Result<(), Failure> {
        let head = head::of_report(self.title, "soil and water", &watched.case, &watched.finished, self.more);
        let looks: Vec<&Look> = self.drawn.iter().filter_map(|&n| watched.looks.get(n)).collect();
        let scene = Scene { looks, window: ([0.0, 0.0], self.window), spacing: self.spacing };
        let flow = scene.water("speed of the water [m/s]", (0.0, self.fastest), Parcel::speed);
        let fraction = scene.water("volume fraction of soil [-]", (0.0, 0.65), |it| 1.0 - it.fraction);
        let (strain, surface) =
            (scene.plastic_strain(), scene.surfaces(&format!("{}: the surface of the soil", self.name)));
        let mut results = Results::of(watched.finished)?;
        let column = quantity::column(&results.history, quantity::INFLOW);
        let came = column.ok().and_then(|column| column.last().copied()).filter(|came| *came != 0.0);
        if let Some(came) = came {
            bars.add("energy the inflow brought", format!("{:.2} J/m", -came), "none", None);
        }
        results.picture("flow", &flow)?;
        results.picture("soil_fraction", &fraction)?;
        results.picture("plastic_strain", &strain)?;
        results.picture("surface", &surface)?;
        results.picture(file, &own)?;
        closure_bar(&mut bars, &results.ledger);
        results.energy(self.name)?;
        results.conclude(&(head + &bars.markdown()))
    }
}

/// Pictures of a window at some instants.
struct Scene<'a> {
    looks: Vec<&'a Look>,
    window: ([f64; 2], [f64; 2]),
    spacing: f64,
}

impl Scene<'_> {
    fn picture<'q>(&self, quantity: &'q str, range: (f64, f64)) -> ParticlePicture<'q> {
        ParticlePicture {
            quantity,
            range,
            window: self.window,
            spacing: self.spacing,
            axes: ["x [m]", "y [m]"],
            columns: 2,
        }
    }

    fn panels(&self, layer: impl Fn(&Look) -> Vec<([f64; 2], f64)>) -> Vec<Panel> {
        let panel = |look: &&Look| Panel {
            caption: format!("t = {:.2} s", look.time),
            layers: vec![layer(look)],
            walls: Vec::new(),
            lines: Vec::new(),
        };
        self.looks.iter().map(panel).collect()
    }

    /// What is told of the water.
    fn water(&self, quantity: &str, range: (f64, f64), of: impl Fn(&Parcel) -> f64) -> String {
        let layer = |look: &Look| look.parcels.water.iter().map(|it| (it.place, of(it))).collect();
        self.picture(quantity, range).svg(&self.panels(layer))
    }

    /// Equivalent plastic strain of the soil.
    fn plastic_strain(&self) -> String {
        let layer = |look: &Look| look.pile.grains().iter().map(|it| (it.place, it.plastic_strain)).collect();
        self.picture("equivalent plastic strain [-]", (0.01, 2.0)).svg_logarithmic(&self.panels(layer))
    }

    /// The surface of the soil, one line for each instant.
    fn surfaces(&self, title: &str) -> String {
        let ([left, _], [right, top]) = self.window;
        let chart = Chart::new(title, "x [m]", "y [m]").x_range(left, right).y_range(0.0, top);
        let with = |chart: Chart, look: &&Look| {
            let profile = look.pile.profile().points().to_vec();
            chart.with(Series::line(&format!("{:.2} s", look.time), profile))
        };
        self.looks.iter().fold(chart, with).svg()
    }
}
