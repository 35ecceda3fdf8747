//! Columns of the same sand in three dimensions: round, and in a channel that repeats itself sideways.

use super::FRICTION_ANGLE;
use crate::arguments::ReproduceOptions;
use crate::outcome::Failure;
use crate::plots::{Chart, Panel, ParticlePicture, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use crate::reproduce::results::Results;
use crate::run::run_case;
use alluvium::case::Case;
use alluvium::verify::sand_column::{Pile, Section, run_out};
use core::f64::consts::TAU;

/// Radius, or length, and height of a column \[m\].
const LENGTH: f64 = 0.1;
/// Width of the channel \[m\].
const WIDTH: f64 = 0.075;
/// How far the floor reaches around the round column's axis \[m\].
const FLOOR: f64 = 0.4;
const SPACING: f64 = 0.00625;
/// When it is over \[s\], and the instants of pictures before.
const DUMPS: &str = "0.0, 0.1, 0.2, 0.3, 0.6";

/// A column, and how it is looked at.
struct Column {
    title: &'static str,
    /// Body, tank and what repeats, as keys of a case file.
    scene: String,
    cone: &'static str,
    section: Section,
    /// Corners of the picture \[m\], and which coordinates of a place it shows.
    window: ([f64; 2], [f64; 2]),
    shown: [usize; 2],
}

/// A round column on a floor that holds it.
pub fn round(options: &ReproduceOptions) -> Result<(), Failure> {
    let column = Column {
        title: "Round column of sand",
        scene: format!(
            "[[soil.cylinder]]\nbase_m = [0.0, 0.0, 0.0]\nradius_m = {LENGTH:?}\nheight_m = {LENGTH:?}\n\
             [tank]\nlow_m = [-{FLOOR:?}, 0.0, -{FLOOR:?}]\nhigh_m = [{FLOOR:?}, 0.15, {FLOOR:?}]\n\
             open = [\"-x\", \"+x\", \"+y\", \"-z\", \"+z\"]\n"
        ),
        cone: "triaxial-compression",
        section: Section::Round { axis: [0.0, 0.0], angle: TAU },
        window: ([-FLOOR; 2], [FLOOR; 2]),
        shown: [0, 2],
    };
    reproduce(options, &column)
}

/// A column against a wall, in a channel whose sides it does not feel.
pub fn channel(options: &ReproduceOptions) -> Result<(), Failure> {
    let column = Column {
        title: "Column of sand in a channel",
        scene: format!(
            "[[soil.block]]\nlow_m = [0.0, 0.0, 0.0]\nhigh_m = [{LENGTH:?}, {LENGTH:?}, {WIDTH:?}]\n\
             [tank]\nlow_m = [0.0, 0.0, 0.0]\nhigh_m = [0.5, 0.15, {WIDTH:?}]\nopen = [\"+x\", \"+y\"]\n\
             [periodic]\naxes = [\"z\"]\n"
        ),
        cone: "plane-strain",
        section: Section::Plane { width: WIDTH },
        window: ([0.0, 0.0], [0.5, 0.12]),
        shown: [0, 1],
    };
    reproduce(options, &column)
}

fn text(column: &Column, spacing: f64, options: &ReproduceOptions) -> String {
    let Column { scene, cone, .. } = column;
    let dilatancy = head::dilatancy(options.preset, FRICTION_ANGLE);
    head::of_case(&options.name, options, DUMPS)
        + &format!(
            "dimension = 3\n[soil]\nreference_density_kg_per_m3 = 2650.0\nvolume_fraction = 1.0\n\
             bulk_modulus_pa = 0.7e6\npoissons_ratio = 0.3\nfriction_angle_deg = {FRICTION_ANGLE:?}\n\
             dilatancy_angle_deg = {dilatancy:?}\ncone = \"{cone}\"\n{scene}[particles]\nspacing_m = {spacing:?}\n\
             [output]\ndump_times_s = [{DUMPS}]\nhistory_interval_s = 1.0e-3\n\
             fields = [\"velocity\", \"pressure\", \"equivalent_plastic_strain\"]\n"
        )
}

/// Runs, measures, draws.
fn reproduce(options: &ReproduceOptions, column: &Column) -> Result<(), Failure> {
    let spacing = options.spacing.unwrap_or(if options.quick { 2.0 * SPACING } else { SPACING });
    let (case, warnings) = Case::parse(&options.name, &text(column, spacing, options))?;
    let (mut piles, mut panels) = (Vec::new(), Vec::new());
    let finished = run_case(case.clone(), &warnings, &options.output, &mut |time, solver| {
        piles.push((time, solver.pile(column.section)));
        let mut grains = solver.view().soil;
        // The highest, or nearest, is drawn last.
        let beyond = 3 - column.shown[0] - column.shown[1];
        grains.sort_by(|a, b| a.place[beyond].total_cmp(&b.place[beyond]));
        let place = |at: [f64; 3]| column.shown.map(|axis| at[axis]);
        let layer = grains.iter().map(|grain| (place(grain.place), grain.place[1])).collect();
        let caption = format!("t = {time:.1} s");
        panels.push(Panel { caption, layers: vec![layer], walls: Vec::new(), lines: Vec::new() });
    })?;
    let more = " Three dimensions. No bar: no law for such columns could be sourced with its data.";
    let head = head::of_report(column.title, "sand", &case, &finished, more);
    let mut results = Results::of(finished)?;
    let picture = ParticlePicture {
        quantity: "height [m]",
        range: (0.0, LENGTH),
        window: column.window,
        spacing,
        axes: ["x [m]", if column.shown[1] == 2 { "z [m]" } else { "y [m]" }],
        columns: 2,
    };
    results.picture("heap", &picture.svg(&panels))?;
    results.picture("surface", &surfaces(column, &piles))?;
    let report = head + &table(&piles, &results);
    results.energy(column.title)?;
    results.conclude(&report)
}

/// Surface of the section at every dump.
fn surfaces(column: &Column, piles: &[(f64, Pile)]) -> String {
    let axis = if column.shown[1] == 2 { "distance from the axis [m]" } else { "x [m]" };
    let chart = Chart::new(&format!("{}: surface", column.title), axis, "y [m]").y_range(0.0, 1.2 * LENGTH);
    let with = |chart: Chart, (time, pile): &(f64, Pile)| {
        chart.with(Series::line(&format!("{time:.1} s"), pile.profile().points().to_vec()))
    };
    piles.iter().fold(chart, with).svg()
}

fn table(piles: &[(f64, Pile)], results: &Results) -> String {
    let mut bars = Bars::default();
    if let Some((time, pile)) = piles.last() {
        let front = pile.front();
        let far = format!("{front:.3} m, (L∞ − L₀)/L₀ = {:.2}", run_out(front, LENGTH));
        bars.add("end of the heap", far, "none", None);
        bars.add("farthest grain", format!("{:.3} m", pile.farthest()), "none", None);
        let height = pile.profile().points().iter().map(|(_, y)| *y).fold(0.0, f64::max);
        bars.add("height of the heap", format!("{height:.3} m"), "none", None);
        let speed = format!("{:.1e} m/s", pile.rms_velocity());
        bars.add(&format!("rms velocity at {time} s"), speed, "none", None);
    }
    let largest = results.ledger.closure.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let what = "energy closure, the largest, over the potential energy at the start";
    bars.add(what, format!("{largest:.1e}"), "none", None);
    bars.markdown()
}
