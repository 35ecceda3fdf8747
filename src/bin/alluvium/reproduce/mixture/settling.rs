//! A slab of loose soil sinks through water.

use super::{GRAVITY, Look, WATER, closure_bar, dumps, mean, one_spacing_only, run, water_block};
use crate::arguments::ReproduceOptions;
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use crate::reproduce::results::Results;
use alluvium::verify::Parcel;
use core::fmt::Write;

const SPACING: f64 = 0.01;
const WIDTH: f64 = 0.12;
/// Height of the water, and where in it the soil begins and ends \[m\].
const HEIGHT: f64 = 0.6;
const SLAB: [f64; 2] = [0.2, 0.4];
const GRAINS: f64 = 2650.0;
const FRACTION: f64 = 0.55;
const CONDUCTIVITY: f64 = 0.01;
const SOUND_SPEED: f64 = 100.0;
/// When it is over \[s\]; there are dumps every third of the longest wave's period.
const END: f64 = 1.0;
const QUICK_END: f64 = 0.144;

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    one_spacing_only(options)?;
    let watched = run(&options.name, &text(options), &options.output)?;
    let more = format!(" k = {CONDUCTIVITY} m/s; the exact slip is {:.2} mm/s.", 1e3 * exact_slip());
    let head = head::of_report(
        "Soil that sinks through water",
        "soil and water",
        &watched.case,
        &watched.finished,
        &more,
    );
    let mut bars = Bars::default();
    measure(&mut bars, &watched.looks);
    let (pressure, fraction) = (pressures(&watched.looks), fractions(&watched.looks));
    let mut results = Results::of(watched.finished)?;
    results.picture("slip", &slips(&watched.looks))?;
    results.picture("pressure", &pressure)?;
    results.picture("soil_fraction", &fraction)?;
    closure_bar(&mut bars, &results.ledger);
    results.energy("Settling")?;
    results.conclude(&(head + &bars.markdown()))
}

/// φ_s(ρ̃_s/ρ̃_f − 1): the critical gradient.
fn buoyant() -> f64 {
    FRACTION * (GRAINS / WATER - 1.0)
}

/// φ_s(ρ̃_s/ρ̃_f − 1)k/φ_f \[m/s\].
fn exact_slip() -> f64 {
    buoyant() * CONDUCTIVITY / (1.0 - FRACTION)
}

/// Period of the column's longest wave of sound \[s\].
fn period() -> f64 {
    4.0 * HEIGHT / SOUND_SPEED
}

pub(super) fn text(options: &ReproduceOptions) -> String {
    let end = if options.quick { QUICK_END } else { END };
    let dumps = dumps(end, (24.0 * end / period()).round() as usize);
    let mut text = head::of_case(&options.name, options, &dumps);
    let slip = exact_slip();
    write!(
        text,
        "[particles]\nspacing_m = {SPACING:?}\nsmoothing_ratio = 2.0\n\
         [soil]\nreference_density_kg_per_m3 = {GRAINS:?}\nvolume_fraction = {FRACTION:?}\n\
         bulk_modulus_pa = 1e3\npoissons_ratio = 0.3\nyield_surface = \"elastic\"\n\
         [[soil.block]]\nlow_m = [0.0, {:?}]\nhigh_m = [{WIDTH:?}, {:?}]\ninitial_stress = \"zero\"\n\
         velocity_m_per_s = [0.0, {:?}]\n\
         [mixture]\nhydraulic_conductivity_m_per_s = {CONDUCTIVITY:?}\n\
         [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{WIDTH:?}, {HEIGHT:?}]\nopen = [\"+y\"]\n\
         [periodic]\naxes = [\"x\"]\n\
         [output]\ndump_times_s = [{dumps}]\nhistory_interval_s = 1e-3\n\
         fields = [\"velocity\", \"pressure\", \"volume_fraction\"]\n\
         [water]\nsound_speed_m_per_s = {SOUND_SPEED:?}\n",
        SLAB[0],
        SLAB[1],
        (FRACTION - 1.0) * slip
    )
    .expect("a string");
    // The water bears the soil from the start, and flows through it.
    for row in 0..(HEIGHT / SPACING).round() as usize {
        let [low, high] = [row, row + 1].map(|n| n as f64 * SPACING);
        let y = 0.5 * (low + high);
        let soil_above = (SLAB[1] - y).clamp(0.0, SLAB[1] - SLAB[0]);
        let pressure = WATER * GRAVITY * (HEIGHT - y + buoyant() * soil_above);
        let through = if (SLAB[0]..SLAB[1]).contains(&y) { FRACTION * slip } else { 0.0 };
        water_block(&mut text, [[0.0, low], [WIDTH, high]], [y, GRAVITY], pressure, [0.0, through]);
    }
    text
}

/// Slip \[m/s\] and gradient of the pressure beyond hydrostatic \[-\] in the middle third of the soil.
fn middle(look: &Look) -> (f64, f64) {
    let (low, high) = super::range(look.parcels.soil.iter().map(|it| it.place[1]));
    let inside = |it: &&Parcel| (low + (high - low) / 3.0..high - (high - low) / 3.0).contains(&it.place[1]);
    let water: Vec<&Parcel> = look.parcels.water.iter().filter(inside).collect();
    let rising = mean(water.iter().map(|it| it.velocity[1]));
    let sinking = mean(look.parcels.soil.iter().filter(inside).map(|it| it.velocity[1]));
    let centre = mean(water.iter().map(|it| it.place[1]));
    let moment = mean(water.iter().map(|it| (it.place[1] - centre) * it.pressure));
    let spread = mean(water.iter().map(|it| (it.place[1] - centre).powi(2)));
    (rising - sinking, -moment / spread / (WATER * GRAVITY) - 1.0)
}

fn measure(bars: &mut Bars, looks: &[Look]) {
    // Three periods, in which the lattices of soil and water still coincide, and all.
    let all = looks.last().map_or(0.0, |look| look.time);
    for (what, until, is_asked) in [("in the first 3 periods", 3.0 * period(), true), ("of all", all, false)]
    {
        let during = || looks.iter().skip(1).filter(|look| look.time < until * (1.0 + 1e-6)).map(middle);
        let slip = mean(during().map(|(slip, _)| slip)) / exact_slip();
        let met = is_asked.then_some((slip - 1.0).abs() < 0.01);
        let bar = if is_asked { "1 ± 0.01" } else { "none" };
        bars.add(&format!("mean slip {what} over the exact"), format!("{slip:.4}"), bar, met);
        let gradient = mean(during().map(|(_, gradient)| gradient)) / buoyant();
        let met = is_asked.then_some((gradient - 1.0).abs() < 0.02);
        let bar = if is_asked { "1 ± 0.02" } else { "none" };
        let what = format!("mean gradient {what} over the critical");
        bars.add(&what, format!("{gradient:.4}"), bar, met);
    }
}

fn slips(looks: &[Look]) -> String {
    let over = |of: fn((f64, f64)) -> f64| {
        looks.iter().skip(1).map(|look| (look.time, of(middle(look)))).collect::<Vec<_>>()
    };
    let end = looks.last().map_or(1.0, |look| look.time);
    Chart::new("Settling: slip and gradient in the middle of the soil", "time [s]", "over the exact [-]")
        .y_range(0.8, 1.2)
        .with(Series::line("exact", vec![(0.0, 1.0), (end, 1.0)]).coloured("#999999"))
        .with(Series::line("slip", over(|(slip, _)| slip / exact_slip())).coloured("#0072b2"))
        .with(Series::line("gradient", over(|(_, gradient)| gradient / buoyant())).coloured("#d55e00"))
        .svg()
}

/// Pressure beyond hydrostatic at the start, which is the exact one of soil in that place, and at the end.
fn pressures(looks: &[Look]) -> String {
    let beyond = |it: &Parcel| 1e-3 * (it.pressure - WATER * GRAVITY * (HEIGHT - it.place[1]));
    let [start, end] = along_height(looks, beyond);
    Chart::new("Settling: pressure beyond hydrostatic", "pressure [kPa]", "y [m]")
        .with(Series::line("at the start", start).coloured("#999999"))
        .with(Series::points("at the end", end).coloured("#0072b2"))
        .svg()
}

fn fractions(looks: &[Look]) -> String {
    let [start, end] = along_height(looks, |it| 1.0 - it.fraction);
    Chart::new("Settling: where the soil is", "volume fraction of soil [-]", "y [m]")
        .with(Series::line("at the start", start).coloured("#999999"))
        .with(Series::points("at the end", end).coloured("#d55e00"))
        .svg()
}

/// What is told of the water in one column, upwards, at the start and at the end.
fn along_height(looks: &[Look], of: impl Fn(&Parcel) -> f64) -> [Vec<(f64, f64)>; 2] {
    [looks.first(), looks.last()].map(|look| {
        let near = |it: &&Parcel| (it.place[0] - 0.5 * (WIDTH + SPACING)).abs() < 0.5 * SPACING;
        let water = look.into_iter().flat_map(|look| &look.parcels.water);
        let mut points: Vec<_> = water.filter(near).map(|it| (of(it), it.place[1])).collect();
        points.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
        points
    })
}
