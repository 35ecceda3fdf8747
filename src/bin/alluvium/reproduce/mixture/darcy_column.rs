//! Water that is driven through soil and round again: Darcy's flow over pore volumes.

use super::{GRAVITY, Look, WATER, dumps, mean, one_spacing_only, run, water_block};
use crate::arguments::ReproduceOptions;
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use crate::reproduce::results::Results;
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::verify::Parcel;
use core::fmt::Write;

const SPACING: f64 = 0.05;
/// Columns of soil, as many of water, and rows.
const COLUMNS: usize = 24;
const ROWS: usize = 9;
/// Volume fraction of the soil \[-\], its conductivity \[m/s\], the gradient of the head in it \[-\].
const FRACTION: f64 = 0.55;
const CONDUCTIVITY: f64 = 0.01;
const SLOPE: f64 = 4.0;
/// Mean pressure \[Pa\].
const PRESSURE: f64 = 3e4;
/// Dumps in a pore volume; flow and pressure are means over the last of them, a fifth.
const DUMPS: usize = 20;

/// Runs, compares, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    one_spacing_only(options)?;
    let volumes = if options.quick { 1 } else { 5 };
    let watched = run(&options.name, &text(options, volumes), &options.output)?;
    let more = format!(
        " k = {CONDUCTIVITY} m/s, i = {SLOPE}; one pore volume is {:.1} s. Water \
         that comes round again has lost the potential energy of the push: the energy is not drawn.",
        pore_volume()
    );
    let head = head::of_report("Darcy's column", "water", &watched.case, &watched.finished, &more);
    let h = watched.case.smoothing_length();
    let mut bars = Bars::default();
    for volume in [1, 2, 5].into_iter().filter(|&volume| volume <= volumes) {
        measure(&mut bars, volume, &watched.looks, h);
    }
    let mut results = Results::of(watched.finished)?;
    results.picture("flow", &flow(&watched.looks))?;
    results.picture("pressure", &pressures(&watched.looks, volumes))?;
    results.picture("space", &spaces(&watched.looks, volumes, h))?;
    results.conclude(&(head + &bars.markdown()))
}

/// q = k i \[m/s\].
fn darcy() -> f64 {
    CONDUCTIVITY * SLOPE
}

/// How long water takes through the soil \[s\].
fn pore_volume() -> f64 {
    COLUMNS as f64 * SPACING * (1.0 - FRACTION) / darcy()
}

/// The exact pressure \[Pa\]: the push on all water raises it where there is no soil.
fn pressure(x: f64) -> f64 {
    let soil = COLUMNS as f64 * SPACING;
    let fall = WATER * push();
    PRESSURE + fall * if x < soil { 0.5 * soil - x } else { x - 1.5 * soil }
}

/// Acceleration of all water \[m/s²\]: over the whole column it makes up for the head lost in the soil.
fn push() -> f64 {
    0.5 * SLOPE * GRAVITY
}

pub(super) fn text(options: &ReproduceOptions, volumes: usize) -> String {
    let dumps = dumps(volumes as f64 * pore_volume(), volumes * DUMPS);
    let at = |n: usize| n as f64 * SPACING;
    let (soil, length, width) = (at(COLUMNS), at(2 * COLUMNS), at(ROWS));
    let mut text = head::of_case(&options.name, options, &dumps);
    write!(
        text,
        "gravity_m_per_s2 = [{:?}, 0.0]\n\
         [particles]\nspacing_m = {SPACING:?}\n\
         [soil]\nreference_density_kg_per_m3 = 2650.0\nvolume_fraction = {FRACTION:?}\n\
         bulk_modulus_pa = 0.7e6\npoissons_ratio = 0.3\nyield_surface = \"elastic\"\n\
         [[soil.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{soil:?}, {width:?}]\nheld = true\n\
         [mixture]\nhydraulic_conductivity_m_per_s = {CONDUCTIVITY:?}\n\
         [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{length:?}, {width:?}]\n\
         [periodic]\naxes = [\"x\", \"y\"]\n\
         [output]\ndump_times_s = [{dumps}]\nhistory_interval_s = 0.05\n\
         fields = [\"velocity\", \"pressure\", \"volume_fraction\"]\n\
         [water]\nsound_speed_m_per_s = 30.0\n",
        push()
    )
    .expect("a string");
    for column in 0..2 * COLUMNS {
        let corners = [[at(column), 0.0], [at(column + 1), width]];
        let x = (column as f64 + 0.5) * SPACING;
        let speed = if column < COLUMNS { darcy() / (1.0 - FRACTION) } else { darcy() };
        // Heights are measured against what pushes.
        water_block(&mut text, corners, [-x, push()], pressure(x), [speed, 0.0]);
    }
    text
}

/// ⟨φ v⟩ in the soil \[m/s\].
fn seeping(look: &Look) -> f64 {
    let soil = COLUMNS as f64 * SPACING;
    let inside = look.parcels.water.iter().filter(|it| it.place[0] < soil);
    inside.map(|it| it.volume * it.fraction * it.velocity[0]).sum::<f64>() / (soil * ROWS as f64 * SPACING)
}

fn mean_pressure(look: &Look) -> f64 {
    mean(look.parcels.water.iter().map(|it| it.pressure))
}

fn measure(bars: &mut Bars, volume: usize, looks: &[Look], h: f64) {
    let last = &looks[volume * DUMPS - DUMPS / 5..=volume * DUMPS];
    let when = format!("after {volume} pore volumes");
    let ratio = mean(last.iter().map(seeping)) / darcy();
    bars.add(&format!("q/(k i) {when}"), format!("{ratio:.3}"), "1 ± 0.05", Some((ratio - 1.0).abs() < 0.05));
    let pressure = mean(last.iter().map(mean_pressure)) / PRESSURE - 1.0;
    let found = format!("{:+.1} %", 1e2 * pressure);
    bars.add(&format!("mean pressure against the start {when}"), found, "± 20 %", Some(pressure.abs() < 0.2));
    let spaces = excess_of_space(&looks[volume * DUMPS], h);
    let (least, most) = super::range(spaces.into_iter().map(|(_, value)| value));
    let found = format!("{least:.4} to {most:.4}");
    let met = most.max(-least) < 0.02;
    bars.add(&format!("Σ V W − 1 − s₀ of the columns {when}"), found, "± 0.02", Some(met));
}

/// Σ V W of the water less what it is on its perfect lattice, the mean of each column.
fn excess_of_space(look: &Look, h: f64) -> Vec<(f64, f64)> {
    let kernel = WendlandC2::<f64, 2>::new(h).expect("a length");
    let size = [2.0 * COLUMNS as f64 * SPACING, ROWS as f64 * SPACING];
    let water = &look.parcels.water;
    let space = |place: [f64; 2]| -> f64 {
        let part = |it: &Parcel| {
            let apart: f64 = (0..2)
                .map(|k| {
                    let d = it.place[k] - place[k];
                    (d - size[k] * (d / size[k]).round()).powi(2)
                })
                .sum();
            if apart < kernel.support().powi(2) { it.volume * kernel.value::<f64>(apart) } else { 0.0 }
        };
        water.iter().map(part).sum()
    };
    let columns = 0..2 * COLUMNS;
    let of_column = |n: usize| {
        let (begin, end) = (n as f64 * SPACING, (n + 1) as f64 * SPACING);
        let inside = water.iter().filter(|it| (begin..end).contains(&it.place[0]));
        let excess = |it: &Parcel| space(it.place) - lattice_sum(&kernel, it.volume.sqrt());
        (0.5 * (begin + end), mean(inside.map(excess)))
    };
    columns.map(of_column).collect()
}

/// Σ V W on a square lattice.
fn lattice_sum(kernel: &WendlandC2<f64, 2>, spacing: f64) -> f64 {
    let reach = (kernel.support() / spacing) as i32 + 1;
    let cells = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| f64::from(i * i + j * j)));
    let near = cells.map(|r2| r2 * spacing * spacing).filter(|r2| *r2 < kernel.support().powi(2));
    near.map(|r2| kernel.value::<f64>(r2)).sum::<f64>() * spacing * spacing
}

fn flow(looks: &[Look]) -> String {
    let series = looks.iter().map(|look| (look.time / pore_volume(), seeping(look) / darcy())).collect();
    let end = looks.last().map_or(1.0, |look| look.time / pore_volume());
    Chart::new("Darcy column: flow through the soil", "pore volumes", "q / k i [-]")
        .y_range(0.8, 1.2)
        .with(Series::line("Darcy", vec![(0.0, 1.0), (end, 1.0)]).coloured("#999999"))
        .with(Series::points("⟨φ v⟩ in the soil", series).coloured("#0072b2"))
        .svg()
}

fn pressures(looks: &[Look], volumes: usize) -> String {
    let length = 2.0 * COLUMNS as f64 * SPACING;
    let fine = (0..=200).map(|n| length * f64::from(n) / 200.0);
    let exact = fine.map(|x| (x, 1e-3 * pressure(x))).collect();
    let chart = Chart::new("Darcy column: pressure along it", "x [m]", "pressure [kPa]")
        .with(Series::line("exact", exact).coloured("#999999"));
    let with = |chart: Chart, volume: usize| {
        let points = |it: &Parcel| (it.place[0], 1e-3 * it.pressure);
        let water = looks[volume * DUMPS].parcels.water.iter();
        chart.with(Series::points(&format!("after {volume} pore volumes"), water.map(points).collect()))
    };
    [1, volumes].into_iter().take(if volumes > 1 { 2 } else { 1 }).fold(chart, with).svg()
}

fn spaces(looks: &[Look], volumes: usize, h: f64) -> String {
    let chart = Chart::new("Darcy column: crowding", "x [m]", "Σ V W − 1 − s₀ [-]").y_range(-0.04, 0.04);
    let with = |chart: Chart, volume: usize| {
        let line = excess_of_space(&looks[volume * DUMPS], h);
        chart.with(Series::line(&format!("after {volume} pore volumes"), line))
    };
    [1, volumes].into_iter().take(if volumes > 1 { 2 } else { 1 }).fold(chart, with).svg()
}
