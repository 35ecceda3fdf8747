//! A jet of water that digs into saturated soil.

mod report;
pub(super) mod series;

use super::head;
use super::results::Results;
use crate::arguments::{OutputOptions, PresetName, ReproduceOptions};
use crate::outcome::Failure;
use crate::plots::{Panel, ParticlePicture};
use crate::run::{Finished, run_case};
use crate::solver::{Parcels, Solver};
use alluvium::case::{Case, Warnings};
use alluvium::verify::jet::{FALL, Hole, NOZZLE, SPEED, TANK};
use alluvium::verify::sand_column::{Grain, Pile, Section};

/// The paper's particle spacing \[m\].
const SPACING: f64 = 0.005;
/// Friction angle θ of the soil \[°\] (Table 3).
const FRICTION_ANGLE: f64 = 25.0;
/// Rows of water in the nozzle.
const ROWS: f64 = 8.0;
/// Instants that are looked at \[s\]; the last is the end.
const DUMPS: [f64; 6] = [0.0, 0.002, 0.005, 0.01, 0.015, 0.02];
const QUICK_DUMPS: [f64; 4] = [0.0, 0.002, 0.005, 0.01];

/// Runs, measures, draws.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    let jet = Jet::of_the_paper(options);
    let (case, warnings) = jet.case(options)?;
    let mut watch = Watch::new(&jet);
    let finished =
        run_case(case.clone(), &warnings, &options.output, &mut |time, solver| watch.look(time, solver))?;
    present(&case, finished, &watch)
}

/// A jet on a bed.
#[derive(Clone)]
struct Jet {
    name: String,
    spacing: f64,
    conductivity: f64,
    /// Volume fraction of the soil \[-\].
    fraction: f64,
    dilatancy: f64,
    dumps: Vec<f64>,
}

impl Jet {
    /// Table 3. The paper's flow rule is associated; the default flows at a constant volume.
    fn of_the_paper(options: &ReproduceOptions) -> Self {
        let dilatancy = head::dilatancy(options.preset, FRICTION_ANGLE);
        let dumps = if options.quick { QUICK_DUMPS.to_vec() } else { DUMPS.to_vec() };
        Self {
            name: "jet".to_owned(),
            spacing: options.spacing.unwrap_or(SPACING),
            conductivity: 5e-4,
            fraction: 0.5,
            dilatancy,
            dumps,
        }
    }

    fn text(&self, options: &ReproduceOptions) -> String {
        // Water boils at −1 atm (decision 25); as printed it bears any suction, and the paper counts five layers of walls.
        let (boils, layers) = match options.preset {
            PresetName::Default => ("cavitation_pressure_pa = -101325.0\n", ""),
            PresetName::Paper => ("", "layers = 5\n"),
        };
        let (preset, precision) = (options.preset.preset(), options.precision.name());
        let Self { name, spacing, conductivity, fraction, dilatancy, dumps } = self;
        let [width, height] = TANK;
        let (left, right, mouth) = (0.5 * (width - NOZZLE), 0.5 * (width + NOZZLE), height + FALL);
        let end = dumps.last().copied().unwrap_or(0.01);
        format!(
            "name = \"{name}\"\npreset = \"{preset}\"\nprecision = \"{precision}\"\nend_time_s = {end:?}\n\
             [particles]\nspacing_m = {spacing:?}\n\
             [soil]\nreference_density_kg_per_m3 = 2700.0\nvolume_fraction = {fraction:?}\n\
             bulk_modulus_pa = 125.0e6\npoissons_ratio = 0.3\nfriction_angle_deg = {FRICTION_ANGLE:?}\n\
             dilatancy_angle_deg = {dilatancy:?}\n\
             [[soil.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {height:?}]\n\
             [water]\nsound_speed_m_per_s = 250.0\n{boils}\
             [[water.block]]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {height:?}]\n\
             [[water.inflow]]\nlow_m = [{left:?}, {mouth:?}]\nhigh_m = [{right:?}, {:?}]\n\
             velocity_m_per_s = [0.0, {:?}]\n\
             [mixture]\nhydraulic_conductivity_m_per_s = {conductivity:?}\n\
             [tank]\nlow_m = [0.0, 0.0]\nhigh_m = [{width:?}, {height:?}]\nopen = [\"+y\"]\n{layers}\
             [domain]\nlow_m = [-5.0, -5.0]\nhigh_m = [5.0, 5.0]\n\
             [output]\ndump_times_s = {dumps:?}\nhistory_interval_s = 2.0e-5\n\
             fields = [\"velocity\", \"pressure\", \"volume_fraction\", \"equivalent_plastic_strain\"]\n",
            mouth + ROWS * spacing,
            -SPEED,
        )
    }

    fn case(&self, options: &ReproduceOptions) -> Result<(Case, Warnings), Failure> {
        Ok(Case::parse(&self.name, &self.text(options))?)
    }

    /// Runs it in a folder of its own.
    fn run(&self, options: &ReproduceOptions, output: OutputOptions) -> Result<Watch, Failure> {
        let (case, warnings) = self.case(options)?;
        let mut watch = Watch::new(self);
        run_case(case, &warnings, &output, &mut |time, solver| watch.look(time, solver))?;
        Ok(watch)
    }
}

/// One instant.
struct Look {
    time: f64,
    hole: Hole,
    parcels: Parcels,
    pile: Pile,
}

/// What is gathered at every dump.
struct Watch {
    jet: Jet,
    looks: Vec<Look>,
}

impl Watch {
    fn new(jet: &Jet) -> Self {
        Self { jet: jet.clone(), looks: Vec::new() }
    }

    fn look(&mut self, time: f64, solver: &mut dyn Solver) {
        let parcels = solver.parcels();
        let hole = Hole::of(&parcels.soil, self.jet.spacing, self.jet.fraction);
        self.looks.push(Look { time, hole, parcels, pile: solver.pile(Section::FLAT) });
    }

    /// The hole at the instant nearest to `time` \[s\].
    fn hole_at(&self, time: f64) -> Option<&Look> {
        self.looks.iter().min_by(|a, b| (a.time - time).abs().total_cmp(&(b.time - time).abs()))
    }
}

/// Measures and draws a finished run.
fn present(case: &Case, finished: Finished, watch: &Watch) -> Result<(), Failure> {
    let head = report::head(case, &finished, &watch.jet);
    let mut results = Results::of(finished)?;
    results.picture("flow", &flow(watch))?;
    results.picture("soil_fraction", &soil_fraction(watch))?;
    results.picture("effective_pressure", &effective_pressure(watch))?;
    results.picture("plastic_strain", &plastic_strain(watch))?;
    results.picture("hole", &report::floors(watch))?;
    let report = head + &report::bars(watch, &results.history, &results.ledger);
    results.energy("Jet")?;
    results.conclude(&report)
}

fn picture<'a>(watch: &Watch, quantity: &'a str, range: (f64, f64)) -> ParticlePicture<'a> {
    ParticlePicture {
        quantity,
        range,
        window: ([0.0, 0.0], [TANK[0], TANK[1] + 0.075]),
        spacing: watch.jet.spacing,
        axes: ["x [m]", "y [m]"],
        columns: 2,
    }
}

fn panels(watch: &Watch, layers: impl Fn(&Look) -> Vec<Vec<([f64; 2], f64)>>) -> Vec<Panel> {
    let panel = |look: &Look| Panel {
        caption: format!("t = {:.0} ms", 1e3 * look.time),
        layers: layers(look),
        walls: Vec::new(),
        lines: Vec::new(),
    };
    watch.looks.iter().skip(1).map(panel).collect()
}

/// Speed of the water (Fig. 12).
fn flow(watch: &Watch) -> String {
    let layers = |look: &Look| vec![look.parcels.water.iter().map(|it| (it.place, it.speed())).collect()];
    picture(watch, "speed of the water [m/s]", (0.0, SPEED)).svg(&panels(watch, layers))
}

/// Volume fraction of soil the water sees (Fig. 14).
fn soil_fraction(watch: &Watch) -> String {
    let layers =
        |look: &Look| vec![look.parcels.water.iter().map(|it| (it.place, 1.0 - it.fraction)).collect()];
    picture(watch, "volume fraction of soil [-]", (0.0, 0.6)).svg(&panels(watch, layers))
}

/// Effective pressure of the soil, per area of the grains (Fig. 15): in decades, from the weight of a few rows to the
/// blow of the jet.
fn effective_pressure(watch: &Watch) -> String {
    soil(watch, "effective pressure [kPa]", (0.1, 1000.0), |grain| 1e-3 * grain.pressure)
}

/// Equivalent plastic strain (Fig. 16).
fn plastic_strain(watch: &Watch) -> String {
    soil(watch, "equivalent plastic strain [-]", (0.01, 2.0), |grain| grain.plastic_strain)
}

fn soil(watch: &Watch, quantity: &str, range: (f64, f64), of: fn(&Grain) -> f64) -> String {
    let grains = |look: &Look| look.pile.grains().iter().map(|grain| (grain.place, of(grain))).collect();
    picture(watch, quantity, range).svg_logarithmic(&panels(watch, |look| vec![grains(look)]))
}
