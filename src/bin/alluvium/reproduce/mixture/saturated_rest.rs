//! The bed of the paper's jet (Table 3) without a jet: nothing moves it.

use super::{GRAVITY, Look, WATER, Watched, closure_bar, dumps, range, rms_speed, run};
use crate::arguments::{OutputOptions, ReproduceOptions};
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use crate::reproduce::results::Results;
use crate::solver::Parcels;
use alluvium::verify::Parcel;
use alluvium::verify::jet::TANK;

/// Depth of the water over the bed of the second run \[m\].
const ABOVE: f64 = 0.05;

/// Runs the flush bed, then one under water in a folder of its own.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let flush = run(&options.name, &text(&options.name, 0.0, options), &options.output)?;
    let name = format!("{}-under-water", options.name);
    let out = Some(flush.finished.folder.path().join("under-water"));
    let output = OutputOptions { out, ..options.output.clone() };
    let drowned = run(&name, &text(&name, ABOVE, options), &output)?;
    let mut bars = Bars::default();
    for (what, watched, level) in
        [("flush bed", &flush, TANK[1]), ("bed under 5 cm of water", &drowned, TANK[1] + ABOVE)]
    {
        measure(&mut bars, what, watched, level);
    }
    let more = " k = 5e-4 m/s; beside it the same bed under 5 cm of water.";
    let head =
        head::of_report("Saturated soil at rest", "soil and water", &flush.case, &flush.finished, more);
    let (speeds, pressures) = (speeds(&flush.looks, &drowned.looks), pressures(&flush, &drowned));
    let mut results = Results::of(flush.finished)?;
    results.picture("speed", &speeds)?;
    results.picture("pressure", &pressures)?;
    closure_bar(&mut bars, &results.ledger);
    results.energy("Saturated bed")?;
    results.conclude(&(head + &bars.markdown()))
}

pub(super) fn text(name: &str, above: f64, options: &ReproduceOptions) -> String {
    let (spacing, end, count) = if options.quick { (0.0125, 0.05, 20) } else { (0.005, 0.5, 50) };
    let spacing = options.spacing.unwrap_or(spacing);
    let ([width, height], dumps) = (TANK, dumps(end, count));
    let level = height + (above / spacing).round() * spacing;
    head::of_case(name, options, &dumps)
        + &format!(
            "[particles]\nspacing_m = {spacing:?}\nsmoothing_ratio = 1.5\n\
             [soil]\nreference_density_kg_per_m3 = 2700.0\nvolume_fraction = 0.5\nbulk_modulus_pa = 125.0e6\n\
             poissons_ratio = 0.3\nfriction_angle_deg = 25.0\n\
             [[soil.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {height:?}]\n\
             [water]\nsound_speed_m_per_s = 250.0\n\
             [[water.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {level:?}]\n\
             [mixture]\nhydraulic_conductivity_m_per_s = 5e-4\n\
             [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {level:?}]\nopen = [\"+y\"]\n\
             [output]\ndump_times_s = [{dumps}]\nhistory_interval_s = {:?}\n\
             fields = [\"velocity\", \"pressure\", \"volume_fraction\", \"stress\"]\n",
            0.002 * end
        )
}

/// Hydrostatic pressure \[Pa\].
fn hydrostatic(level: f64, y: f64) -> f64 {
    WATER * GRAVITY * (level - y)
}

fn measure(bars: &mut Bars, what: &str, watched: &Watched, level: f64) {
    let Some(end) = watched.looks.last() else { return };
    for (matter, parcels) in [("soil", &end.parcels.soil), ("water", &end.parcels.water)] {
        let speed = rms_speed(parcels);
        let what = format!("{what}: rms speed of the {matter} after {} s", end.time);
        bars.add(&what, format!("{speed:.1e} m/s"), "below 1e-5 m/s", Some(speed < 1e-5));
    }
    let water = || watched.looks.iter().flat_map(|look| &look.parcels.water);
    let (least, most) = range(water().map(|it| it.fraction));
    let within = least >= -0.01 && most <= 1.01;
    let found = format!("{least:.4} to {most:.4}");
    bars.add(&format!("{what}: volume fraction of water"), found, "-0.01 to 1.01", Some(within));
    let off = |it: &Parcel| it.pressure - hydrostatic(level, it.place[1]);
    let (least, most) = range(end.parcels.water.iter().map(off));
    let whole = hydrostatic(level, 0.0);
    let found = format!("{least:.0} to {most:.0} Pa of {whole:.0}");
    bars.add(&format!("{what}: pressure at the end less the hydrostatic"), found, "none", None);
}

fn speeds(flush: &[Look], drowned: &[Look]) -> String {
    let over = |looks: &[Look], of: &dyn Fn(&Parcels) -> f64| {
        looks.iter().skip(1).map(|look| (look.time, of(&look.parcels))).collect::<Vec<_>>()
    };
    let (soil, water) = (|all: &Parcels| rms_speed(&all.soil), |all: &Parcels| rms_speed(&all.water));
    Chart::new("Saturated bed: it rests", "time [s]", "rms speed [m/s]")
        .logarithmic(false, true)
        .with(Series::line("soil, flush", over(flush, &soil)).coloured("#8c510a"))
        .with(Series::line("water, flush", over(flush, &water)).coloured("#0072b2"))
        .with(Series::dashed("soil, under water", over(drowned, &soil)).coloured("#8c510a"))
        .with(Series::dashed("water, under water", over(drowned, &water)).coloured("#0072b2"))
        .svg()
}

fn pressures(flush: &Watched, drowned: &Watched) -> String {
    let level = TANK[1] + ABOVE;
    let points = |watched: &Watched| {
        let near = |it: &&Parcel| (it.place[0] - 0.5 * TANK[0]).abs() < 0.6 * watched.case.particles.spacing;
        let end = watched.looks.last().into_iter().flat_map(|look| &look.parcels.water);
        end.filter(near).map(|it| (it.pressure * 1e-3, it.place[1])).collect::<Vec<_>>()
    };
    let exact = |level: f64| vec![(hydrostatic(level, 0.0) * 1e-3, 0.0), (0.0, level)];
    Chart::new("Saturated bed: pressure in the middle, at the end", "pressure [kPa]", "y [m]")
        .with(Series::line("hydrostatic", exact(level)).coloured("#999999"))
        .with(Series::line("", exact(TANK[1])).coloured("#999999"))
        .with(Series::points("flush bed", points(flush)).coloured("#0072b2"))
        .with(Series::points("under 5 cm of water", points(drowned)).coloured("#d55e00"))
        .svg()
}
