//! A layer of soil laid as mud, whose weight the water bears at first, consolidates as the water drains.

use super::{GRAVITY, Look, WATER, closure_bar, dumps, mean, one_spacing_only, run, water_block};
use crate::arguments::ReproduceOptions;
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use crate::reproduce::results::Results;
use alluvium::material::Elasticity;
use alluvium::output::TableWriter;
use alluvium::verify::Parcel;
use alluvium::verify::consolidation::{Layer, remaining_of_weight, settled_of_weight};
use core::fmt::Write;

const SPACING: f64 = 0.02;
/// Height of the layer, and of the water over it \[m\].
const HEIGHT: f64 = 0.5;
const ABOVE: f64 = 0.1;
const ROWS_ACROSS: f64 = 12.0;
const GRAINS: f64 = 2700.0;
const FRACTION: f64 = 0.5;
const BULK: f64 = 1e6;
const POISSON: f64 = 0.3;
const CONDUCTIVITY: f64 = 2e-3;
const SOUND_SPEED: f64 = 60.0;
/// The last time over H²/c_v; there are dumps every 1/`PARTS` of one.
const END: f64 = 1.0;
const QUICK_END: f64 = 0.3;
const PARTS: f64 = 40.0;
/// Profiles are drawn and judged at these.
const TIMES: [f64; 5] = [0.05, 0.1, 0.2, 0.5, 1.0];

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    one_spacing_only(options)?;
    let end = if options.quick { QUICK_END } else { END };
    let watched = run(&options.name, &text(options, end), &options.output)?;
    let more = format!(
        " H = {HEIGHT} m, k = {CONDUCTIVITY} m/s, c_v = {:.4} m²/s; renormalised density diffusion: the usual one \
         would diffuse pore pressure beside the drainage.",
        layer().coefficient()
    );
    let head = head::of_report(
        "Consolidation of mud under its own weight",
        "soil and water",
        &watched.case,
        &watched.finished,
        &more,
    );
    let mut bars = Bars::default();
    measure(&mut bars, &watched.looks);
    let mut results = Results::of(watched.finished)?;
    let columns = ["T [-]", "settlement [m]", "exact [m]"];
    let mut table = TableWriter::create(results.folder.file("settlement.csv")?, &columns)?;
    for (time, settled) in settlements(&watched.looks) {
        table.row(&[time, settled, final_settlement() * settled_of_weight(time)].map(Into::into))?;
    }
    results.picture("pressure", &profiles(&watched.looks))?;
    results.picture("settlement", &settlement(&watched.looks))?;
    closure_bar(&mut bars, &results.ledger);
    results.energy("Consolidation")?;
    results.conclude(&(head + &bars.markdown()))
}

fn stiffness() -> f64 {
    let elasticity: Elasticity<f64> = Elasticity::from_bulk(BULK, POISSON).expect("moduli");
    FRACTION * elasticity.plane_wave_modulus()
}

fn layer() -> Layer {
    let storage = (1.0 - FRACTION) / (WATER * SOUND_SPEED * SOUND_SPEED);
    Layer { height: HEIGHT, conductivity: CONDUCTIVITY, stiffness: stiffness(), storage }
}

/// Weight of the soil under water \[N/m³\].
fn weight() -> f64 {
    FRACTION * (GRAINS - WATER) * GRAVITY
}

/// How far the surface sinks in the end \[m\].
fn final_settlement() -> f64 {
    0.5 * weight() * HEIGHT * HEIGHT / stiffness()
}

/// H²/c_v \[s\].
fn unit_of_time() -> f64 {
    HEIGHT * HEIGHT / layer().coefficient()
}

pub(super) fn text(options: &ReproduceOptions, end: f64) -> String {
    let dumps = dumps(end * unit_of_time(), (end * PARTS).round() as usize);
    let (width, level) = (ROWS_ACROSS * SPACING, HEIGHT + ABOVE);
    let mut text = head::of_case(&options.name, options, &dumps);
    write!(
        text,
        "[particles]\nspacing_m = {SPACING:?}\n\
         [soil]\nreference_density_kg_per_m3 = {GRAINS:?}\nvolume_fraction = {FRACTION:?}\n\
         bulk_modulus_pa = {BULK:?}\npoissons_ratio = {POISSON:?}\nyield_surface = \"elastic\"\n\
         [[soil.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {HEIGHT:?}]\ninitial_stress = \"zero\"\n\
         [mixture]\nhydraulic_conductivity_m_per_s = {CONDUCTIVITY:?}\n\
         [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {level:?}]\nopen = [\"+y\"]\n\
         [periodic]\naxes = [\"x\"]\n\
         [output]\ndump_times_s = [{dumps}]\nhistory_interval_s = {:?}\n\
         fields = [\"velocity\", \"pressure\", \"stress\"]\n\
         [water]\nsound_speed_m_per_s = {SOUND_SPEED:?}\n\
         [water.density_diffusion]\nkind = \"renormalised\"\n\
         [[water.block]]\nlow_m = [0.0, {HEIGHT:?}]\nhigh_m = [{width:?}, {level:?}]\n",
        unit_of_time() / 1000.0
    )
    .expect("a string");
    for row in 0..(HEIGHT / SPACING).round() as usize {
        let [low, high] = [row, row + 1].map(|n| n as f64 * SPACING);
        let y = 0.5 * (low + high);
        let pressure = WATER * GRAVITY * (level - y) + weight() * (HEIGHT - y);
        water_block(&mut text, [[0.0, low], [width, high]], [y, GRAVITY], pressure, [0.0, 0.0]);
    }
    text
}

/// T, and the pressure beyond hydrostatic over its largest at the start, of the water in the soil, over
/// height.
fn excess(look: &Look) -> (f64, Vec<(f64, f64)>) {
    let over = |it: &Parcel| {
        let hydrostatic = WATER * GRAVITY * (HEIGHT + ABOVE - it.place[1]);
        (it.place[1], (it.pressure - hydrostatic) / (weight() * HEIGHT))
    };
    let inside = look.parcels.water.iter().filter(|it| it.place[1] < HEIGHT);
    (look.time / unit_of_time(), inside.map(over).collect())
}

fn exact(y: f64, time: f64) -> f64 {
    remaining_of_weight(1.0 - y / HEIGHT, time)
}

/// T and how far the uppermost row has sunk \[m\].
fn settlements(looks: &[Look]) -> Vec<(f64, f64)> {
    let count = ROWS_ACROSS as usize;
    let top = |look: &Look| {
        let mut heights: Vec<f64> = look.parcels.soil.iter().map(|it| it.place[1]).collect();
        heights.sort_unstable_by(|a, b| b.total_cmp(a));
        mean(heights.into_iter().take(count))
    };
    let start = looks.first().map_or(0.0, top);
    looks.iter().map(|look| (look.time / unit_of_time(), start - top(look))).collect()
}

/// The look nearest to each of [`TIMES`] that was reached.
fn judged(looks: &[Look]) -> Vec<&Look> {
    let reached = |time: &&f64| looks.last().is_some_and(|look| look.time > (**time - 1e-6) * unit_of_time());
    let near = |time: &f64| {
        let far = |look: &&Look| (look.time - time * unit_of_time()).abs();
        looks.iter().min_by(|a, b| far(a).total_cmp(&far(b)))
    };
    TIMES.iter().filter(reached).filter_map(near).collect()
}

fn measure(bars: &mut Bars, looks: &[Look]) {
    for look in judged(looks) {
        let (time, found) = excess(look);
        let square = mean(found.iter().map(|(y, value)| (value - exact(*y, time)).powi(2)));
        let rms = square.sqrt();
        let what = format!("pressure at T = {time:.2} against the series, rms over the largest at the start");
        bars.add(&what, format!("{:.2} %", 1e2 * rms), "below 2 %", Some(rms < 0.02));
    }
    let whole = final_settlement();
    let off = |(time, settled): (f64, f64)| (settled / whole - settled_of_weight(time)).abs();
    let worst = settlements(looks).into_iter().map(off).fold(0.0, f64::max);
    let found = format!("{:.2} %", 1e2 * worst);
    let what = "settlement against the series, the largest difference over that of the end";
    bars.add(what, found, "below 2 %", Some(worst < 0.02));
}

fn profiles(looks: &[Look]) -> String {
    const COLOURS: [&str; 5] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"];
    let chart = Chart::new("Consolidation: pressure beyond hydrostatic", "p / γ′H [-]", "y [m]");
    let with = |chart: Chart, (look, colour): (&Look, &'static str)| {
        let (time, found) = excess(look);
        let fine = (0..=100).map(|n| HEIGHT * f64::from(n) / 100.0);
        let line = fine.map(|y| (exact(y, time), y)).collect();
        chart
            .with(Series::line("", line).coloured(colour))
            .with(Series::points(&format!("T = {time:.2}"), flipped(found)).coloured(colour))
    };
    judged(looks).into_iter().zip(COLOURS).fold(chart, with).svg()
}

/// One of each row, value first.
fn flipped(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let mut points: Vec<_> = points.into_iter().map(|(y, value)| (value, y)).collect();
    points.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
    points.into_iter().step_by(ROWS_ACROSS as usize).collect()
}

fn settlement(looks: &[Look]) -> String {
    let found = settlements(looks);
    let end = found.last().map_or(1.0, |(time, _)| *time);
    let fine = (0..=200).map(|n| end * f64::from(n) / 200.0);
    let exact = fine.map(|time| (time, 1e3 * final_settlement() * settled_of_weight(time))).collect();
    let found = found.into_iter().map(|(time, settled)| (time, 1e3 * settled)).collect();
    Chart::new("Consolidation: the surface sinks", "T = c_v t/H² [-]", "settlement [mm]")
        .with(Series::line("Terzaghi's series", exact).coloured("#999999"))
        .with(Series::points("uppermost row of soil", found).coloured("#d55e00"))
        .svg()
}
