//! A column of sand collapses under water.

use super::{Flow, Look, dumps, range, run};
use crate::arguments::{PresetName, ReproduceOptions};
use crate::outcome::Failure;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;

const SPACING: f64 = 0.005;
/// Tank, water and column \[m\].
const TANK: [f64; 2] = [0.6, 0.2];
const LEVEL: f64 = 0.15;
const COLUMN: [f64; 2] = [0.1, 0.1];
const FRICTION_ANGLE: f64 = 25.0;
const FRACTION: f64 = 0.6;
/// When it is over \[s\], and dumps.
const END: f64 = 1.0;
const DUMPS: usize = 20;
/// Which of them are drawn.
const DRAWN: [usize; 4] = [2, 5, 10, 20];

/// Runs, measures, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let spacing = options.spacing.unwrap_or(if options.quick { 2.0 * SPACING } else { SPACING });
    let watched = run(&options.name, &text(options, spacing), &options.output)?;
    let more = format!(" Friction angle {FRICTION_ANGLE}°, k = 0.01 m/s.");
    let mut bars = Bars::default();
    measure(&mut bars, &watched.looks);
    let own = ("front", front(&watched.looks));
    let flow = Flow {
        title: "Collapse of a column of sand under water",
        more: &more,
        name: "Collapse under water",
        window: TANK,
        spacing,
        drawn: &DRAWN,
        fastest: 0.4,
    };
    flow.present(watched, bars, own)
}

pub(super) fn text(options: &ReproduceOptions, spacing: f64) -> String {
    let dumps = dumps(END, DUMPS);
    let dilatancy = match options.preset {
        PresetName::Default => 0.0,
        PresetName::Paper => FRICTION_ANGLE,
    };
    let ([length, height], [width, top]) = (TANK, COLUMN);
    head::of_case(&options.name, options, &dumps)
        + &format!(
            "[particles]\nspacing_m = {spacing:?}\nsmoothing_ratio = 1.9\n\
             [soil]\nreference_density_kg_per_m3 = 2650.0\nvolume_fraction = {FRACTION:?}\n\
             bulk_modulus_pa = 0.7e6\npoissons_ratio = 0.3\nfriction_angle_deg = {FRICTION_ANGLE:?}\n\
             dilatancy_angle_deg = {dilatancy:?}\n\
             [[soil.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {top:?}]\n\
             [water]\nsound_speed_m_per_s = 20.0\n\
             [[water.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{length:?}, {LEVEL:?}]\n\
             [mixture]\nhydraulic_conductivity_m_per_s = 0.01\n\
             [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{length:?}, {height:?}]\nopen = [\"+y\"]\n\
             [output]\ndump_times_s = [{dumps}]\nhistory_interval_s = 1.0e-3\n\
             fields = [\"velocity\", \"pressure\", \"volume_fraction\", \"equivalent_plastic_strain\"]\n"
        )
}

/// Where the surface of the soil is 1 cm high \[m\].
fn reach(look: &Look) -> f64 {
    look.pile.reach(0.1 * COLUMN[1]).unwrap_or(f64::NAN)
}

fn measure(bars: &mut Bars, looks: &[Look]) {
    let (Some(start), Some(end)) = (looks.first(), looks.last()) else { return };
    let when = format!("at {} s", end.time);
    bars.add(&format!("front at a tenth of the height {when}"), format!("{:.3} m", reach(end)), "none", None);
    let height = end.pile.surface(0.5 * end.pile.spacing());
    bars.add(&format!("height at the wall {when}"), format!("{height:.3} m"), "none", None);
    let speed = super::rms_speed(&end.parcels.soil);
    bars.add(&format!("rms speed of the soil {when}"), format!("{speed:.1e} m/s"), "none", None);
    let bulking = end.pile.volume() / start.pile.volume();
    bars.add("volume of the soil over that at the start", format!("{bulking:.3}"), "none", None);
    let (least, most) = range(looks.iter().flat_map(|look| &look.parcels.water).map(|it| it.fraction));
    let met = least >= -0.01 && most <= 1.01;
    let found = format!("{least:.4} to {most:.4}");
    bars.add("volume fraction of water at the dumps", found, "-0.01 to 1.01", Some(met));
    let (least, most) = range(looks.iter().flat_map(|look| &look.parcels.water).map(|it| it.pressure * 1e-3));
    bars.add("pressure at the dumps", format!("{least:.2} to {most:.2} kPa"), "none", None);
}

fn front(looks: &[Look]) -> String {
    let points = looks.iter().map(|look| (look.time, reach(look))).collect();
    Chart::new("Collapse under water: the front", "time [s]", "x where the soil is 1 cm high [m]")
        .with(Series::points("", points).coloured("#0072b2"))
        .svg()
}
