//! Water flows over a saturated bank and down its face, and takes sand along.

use super::{Flow, Look, dumps, range, run};
use crate::arguments::{PresetName, ReproduceOptions};
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use alluvium::verify::Parcel;
use core::fmt::Write;

const SPACING: f64 = 0.005;
/// Length of the sill before the bank; height and end of the crest, horizontal length of the face, where the
/// floor ends \[m\].
const SILL: f64 = 0.1;
const HEIGHT: f64 = 0.08;
const CREST: f64 = 0.3;
const FACE: f64 = 0.16;
const FLOOR: f64 = 0.8;
/// Depth \[m\] and speed \[m/s\] of the water on the crest.
const DEPTH: f64 = 0.06;
const SPEED: f64 = 1.2;
/// Length of the box it comes from \[m\].
const SOURCE: f64 = 0.05;
const FRICTION_ANGLE: f64 = 35.0;
const FRACTION: f64 = 0.5;
const CONDUCTIVITY: f64 = 0.01;
/// When it is over \[s\], and dumps.
const END: f64 = 1.0;
const DUMPS: usize = 20;
/// Which of them are drawn.
const DRAWN: [usize; 4] = [2, 6, 12, 20];

/// Runs, measures, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let spacing = options.spacing.unwrap_or(if options.quick { 2.0 * SPACING } else { SPACING });
    let watched = run(&options.name, &text(options, spacing), &options.output)?;
    let more =
        format!(" {SPEED} m/s, {DEPTH} m deep, over sand of {FRICTION_ANGLE}°, k = {CONDUCTIVITY} m/s.");
    let mut bars = Bars::default();
    measure(&mut bars, &watched.looks);
    let own = ("eroded", lost(&watched.looks));
    let flow = Flow {
        title: "Erosion of a bank by water that flows over it",
        more: &more,
        name: "Bank",
        window: [FLOOR, 0.2],
        spacing,
        drawn: &DRAWN,
        fastest: 1.6,
    };
    flow.present(watched, bars, own)
}

/// Height of the bank at x \[m\], in whole spacings.
fn bank(x: f64, spacing: f64) -> f64 {
    let height = HEIGHT * (1.0 - (x - CREST).max(0.0) / FACE).max(0.0);
    (height / spacing).round() * spacing
}

pub(super) fn text(options: &ReproduceOptions, spacing: f64) -> String {
    let dumps = dumps(END, DUMPS);
    let dilatancy = match options.preset {
        PresetName::Default => 0.0,
        PresetName::Paper => FRICTION_ANGLE,
    };
    let level = HEIGHT + DEPTH;
    let mut text = head::of_case(&options.name, options, &dumps);
    write!(
        text,
        "[particles]\nspacing_m = {spacing:?}\nsmoothing_ratio = 1.5\n\
         [mixture]\nhydraulic_conductivity_m_per_s = {CONDUCTIVITY:?}\n\
         [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{FLOOR:?}, 0.2]\nopen = [\"+x\", \"+y\"]\n\
         [[tank.obstacle]]\nlow_m = [0.0, 0.0]\nhigh_m = [{SILL:?}, {HEIGHT:?}]\n\
         [[outlet]]\nlow_m = [-1e6, -1e6]\nhigh_m = [1e6, -0.1]\n\
         [output]\ndump_times_s = [{dumps}]\nhistory_interval_s = 1.0e-3\n\
         fields = [\"velocity\", \"pressure\", \"volume_fraction\", \"equivalent_plastic_strain\"]\n\
         [water]\nsound_speed_m_per_s = 20.0\n\
         [[water.inflow]]\nlow_m = [0.0, {HEIGHT:?}]\nhigh_m = [{SOURCE:?}, {level:?}]\n\
         velocity_m_per_s = [{SPEED:?}, 0.0]\n\
         [[water.block]]\nlow_m = [{SOURCE:?}, {HEIGHT:?}]\nhigh_m = [{CREST:?}, {level:?}]\n\
         velocity_m_per_s = [{SPEED:?}, 0.0]\n\
         [[water.block]]\nlow_m = [{SILL:?}, 0.0]\nhigh_m = [{CREST:?}, {HEIGHT:?}]\nsurface_m = {level:?}\n\
         [soil]\nreference_density_kg_per_m3 = 2650.0\nvolume_fraction = {FRACTION:?}\n\
         bulk_modulus_pa = 1e6\npoissons_ratio = 0.3\nfriction_angle_deg = {FRICTION_ANGLE:?}\n\
         dilatancy_angle_deg = {dilatancy:?}\n\
         [[soil.block]]\nlow_m = [{SILL:?}, 0.0]\nhigh_m = [{CREST:?}, {HEIGHT:?}]\n"
    )
    .expect("a string");
    // The face, column by column, wet to its surface.
    for column in 0..(FACE / spacing).round() as usize {
        let [left, right] = [column, column + 1].map(|n| CREST + n as f64 * spacing);
        let height = bank(0.5 * (left + right), spacing);
        if height > 0.0 {
            for matter in ["soil", "water"] {
                writeln!(
                    text,
                    "[[{matter}.block]]\nlow_m = [{left:?}, 0.0]\nhigh_m = [{right:?}, {height:?}]"
                )
                .expect("a string");
            }
        }
    }
    text
}

/// Soil that is outside the bank of the start \[m²\], its pores left out, with what has left the floor.
fn eroded(look: &Look, start: &Look) -> f64 {
    let spacing = start.pile.spacing();
    let inside = |it: &&Parcel| it.place[1] < bank(it.place[0], spacing) + spacing;
    let all: f64 = start.parcels.soil.iter().map(|it| it.matter).sum();
    all - look.parcels.soil.iter().filter(inside).map(|it| it.matter).sum::<f64>()
}

fn measure(bars: &mut Bars, looks: &[Look]) {
    let (Some(start), Some(end)) = (looks.first(), looks.last()) else { return };
    let all: f64 = start.parcels.soil.iter().map(|it| it.matter).sum();
    let part = 1e2 * eroded(end, start) / all;
    bars.add(&format!("soil outside the first bank at {} s", end.time), format!("{part:.1} %"), "none", None);
    let edge = |look: &Look| look.pile.reach(0.5 * HEIGHT).unwrap_or(f64::NAN);
    let found = format!("{:.3} to {:.3} m", edge(start), edge(end));
    bars.add("face at half the height, start to end", found, "none", None);
    let crest = end.pile.surface(0.9 * CREST);
    bars.add("height of the bank at nine tenths of the crest", format!("{crest:.3} m"), "none", None);
    let (least, most) = range(looks.iter().flat_map(|look| &look.parcels.water).map(|it| it.fraction));
    let met = least >= -0.01 && most <= 1.01;
    let found = format!("{least:.4} to {most:.4}");
    bars.add("volume fraction of water at the dumps", found, "-0.01 to 1.01", Some(met));
    let (least, most) = range(looks.iter().flat_map(|look| &look.parcels.water).map(|it| it.pressure * 1e-3));
    bars.add("pressure at the dumps", format!("{least:.2} to {most:.2} kPa"), "none", None);
}

fn lost(looks: &[Look]) -> String {
    let Some(start) = looks.first() else { return String::new() };
    let points = looks.iter().map(|look| (look.time, 1e4 * eroded(look, start))).collect();
    Chart::new("Bank: soil outside the bank of the start", "time [s]", "grains [cm²]")
        .with(Series::points("", points).coloured("#d55e00"))
        .svg()
}
