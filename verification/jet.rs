//! The paper's jet on saturated soil against acceptance values (Figs. 12 to 18): the experiment's own are lost.

use crate::bands::{Band, WITHIN, measured, range};
use crate::shared_runs::SharedRuns;
use alluvium::Preset;
use alluvium::budget::Account;
use alluvium::case::Case;
use alluvium::kernel::WendlandC2;
use alluvium::parallel::Threads;
use alluvium::verify::jet::Hole;
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::{Conditions, Level, Measured, Parcel, Study};
use std::ops::ControlFlow;

const CASE: &str = include_str!("cases/jet.toml");
const SOURCE: &str = "Table 3; depth of another program's run of the same case, unpublished; stagnation pressure ½ρv² = 0.31 MPa";
const SLOW: &str = "jet of 20 m/s";
const SWAPPED: &str = "the most and the least permeable soil exchanged";
const SPACING: f64 = 0.005;
const FRACTION: f64 = 0.5;
const CONDUCTIVITY: f64 = 5e-4;
/// Instants that are looked at \[s\].
const TIMES: [f64; 3] = [0.002, 0.005, 0.01];

pub fn studies() -> Vec<Study> {
    let equations = &["24", "33", "37", "52", "53", "55", "58", "69"];
    let of = |name: &str, claim: &str, run: fn(&Conditions) -> Measured| {
        Study::new(name, claim, run).equations(equations).source(SOURCE).level(Level::Full).expect(WITHIN)
    };
    vec![
        of(
            "jet/hole",
            "the jet digs 49 ± 5 mm within 10 ms, no fraction leaves 0 to 1 in any step, and the water keeps less energy than the \
             jet brought (values: half widths from the middle of each band)",
            hole,
        )
        .mutant(SLOW),
        of(
            "jet/pressure",
            "after 2, 5 and 10 ms no pressure is below −0.25 MPa or beyond 2.5 times that of the jet's stagnation (values: \
             half widths from the middle of the band)",
            pressure,
        ),
        of(
            "jet/conductivity",
            "the more permeable the soil, the deeper the hole, by more than its contour is searched for (values: half widths from the middle of each band)",
            conductivity,
        )
        .mutant(SWAPPED),
        #[cfg(feature = "implicit")]
        of(
            "jet/silt",
            "drag solved over the step digs as deep as explicit drag to a particle spacing, and from sand to silt the hole \
             gets shallower (values: half widths from the middle of each band)",
            silt,
        )
        .mutant(SWAPPED),
    ]
}

/// What was seen of a jet.
#[derive(Clone)]
struct Dig {
    hole: Hole,
    fractions: [f64; 2],
    /// At [`TIMES`], and at any time \[Pa\].
    pressures: [f64; 2],
    extremes: [f64; 2],
    /// Kinetic energy at the end over what the jet brought \[-\].
    kept: f64,
}

/// With explicit drag from 5e-5 m/s up, as the program chooses.
fn dig(conductivity: f64, conditions: &Conditions) -> Dig {
    dig_by("automatic", conductivity, if conditions.is(SLOW) { 20.0 } else { 25.0 })
}

fn dig_by(scheme: &str, conductivity: f64, speed: f64) -> Dig {
    static RUNS: SharedRuns<Dig> = SharedRuns::new();
    RUNS.get(format!("{scheme} {conductivity} {speed}"), || run(scheme, conductivity, speed))
}

/// In f64 with the default preset, h = 1.5 Δx and ψ = 0.
fn run(scheme: &str, conductivity: f64, speed: f64) -> Dig {
    let text = CASE
        .replace("PRESET", "default")
        .replace("INTEGRATOR", "leap-frog-ab3")
        .replace("spacing_m = 0.005", "spacing_m = 0.005\nsmoothing_ratio = 1.5")
        .replace("conductivity_m_per_s = 5.0e-4", &format!("conductivity_m_per_s = {conductivity}"))
        .replace("[mixture]", &format!("[mixture]\ndrag_scheme = \"{scheme}\""))
        .replace("[0.0, -25.0]", &format!("[0.0, {:?}]", -speed));
    let (case, _) = Case::parse("jet", &text).expect("a case");
    let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).expect("a length");
    let mut run = case.simulation(kernel, Preset::Default.leap_frog()).expect("a case");
    // One thread each: the harness runs studies side by side.
    Threads::new(1).expect("a thread").install(|| {
        run.start().expect("a start");
        let start = run.budget();
        let (mut fractions, mut pressures, mut extremes) = (Vec::new(), Vec::new(), Vec::new());
        for time in TIMES {
            let _: ControlFlow<()> = run
                .run_until(time, |run| {
                    let water = run.mixture().water();
                    let inner = water.wall_particles()..water.len();
                    fractions.extend(range(inner.clone().map(|i| water.volume_fraction(i))));
                    extremes.extend(range(inner.map(|i| water.pressures()[i])));
                    ControlFlow::Continue(())
                })
                .expect("a sound run");
            pressures.extend(range(Parcel::of(run.mixture().water()).iter().map(|it| it.pressure)));
        }
        let end = run.budget();
        let came = start.taken[Account::Inflow] - end.taken[Account::Inflow];
        let hole = Hole::of(&Parcel::of(run.mixture().soil()), SPACING, FRACTION);
        let [fractions, pressures, extremes] = [fractions, pressures, extremes].map(range);
        Dig { hole, fractions, pressures, extremes, kept: end.kinetic / came }
    })
}

fn hole(conditions: &Conditions) -> Measured {
    let Dig { hole, fractions: [least, most], kept, .. } = dig(CONDUCTIVITY, conditions);
    measured(vec![
        Band::new("depth [m]", Some(hole.depth()), (0.044, 0.054)),
        Band::new("least φ_f", Some(least), (-1e-4, 1.0001)),
        Band::new("largest φ_f", Some(most), (-1e-4, 1.0001)),
        Band::new("kinetic energy over what came", Some(kept), (0.0, 1.0)),
    ])
    .note(format!("width at half the depth over that at a tenth of it: {:.2}", hole.roundness()))
}

fn pressure(conditions: &Conditions) -> Measured {
    let Dig { pressures: [least, most], extremes, .. } = dig(CONDUCTIVITY, conditions);
    let band = |what, p| Band::new(what, Some(p), (-0.25e6, 0.8e6));
    measured(vec![band("least pressure [Pa]", least), band("largest pressure [Pa]", most)])
        .note(format!("in any step {:.4e} to {:.4e} Pa: the first drops strike", extremes[0], extremes[1]))
}

fn conductivity(conditions: &Conditions) -> Measured {
    let mut soils = [5e-5, 5e-4, 5e-3];
    if conditions.is(SWAPPED) {
        soils.reverse();
    }
    let holes = soils.map(|k| (k, dig(k, conditions).hole));
    measured(deepening(&holes)).note(noted(&holes)).picture(&chart(&holes))
}

#[cfg(feature = "implicit")]
fn silt(conditions: &Conditions) -> Measured {
    let mut soils = [1e-6, 1e-5, 5e-5, 5e-4];
    if conditions.is(SWAPPED) {
        soils.reverse();
    }
    let holes = soils.map(|k| (k, dig_by("backward-euler", k, 25.0).hole));
    let beside = |&k: &f64| {
        let solved = dig_by("backward-euler", k, 25.0).hole.depth() - dig(k, conditions).hole.depth();
        Band::new(format!("deeper than explicit, k = {k:e} [m]"), Some(solved), (-SPACING, SPACING))
    };
    let bands = deepening(&holes).into_iter().chain([5e-5, 5e-4].iter().map(beside)).collect();
    measured(bands).note(noted(&holes)).picture(&chart(&holes))
}

/// By how much each hole is deeper than the one before.
fn deepening(holes: &[(f64, Hole)]) -> Vec<Band> {
    let deeper = |pair: &[(f64, Hole)]| {
        let by = pair[1].1.depth() - pair[0].1.depth();
        Band::new("deeper by [m]", Some(by), (0.2 * SPACING, 0.175))
    };
    holes.windows(2).map(deeper).collect()
}

fn noted(holes: &[(f64, Hole)]) -> String {
    let depths: Vec<f64> = holes.iter().map(|(_, hole)| hole.depth()).collect();
    format!("depths {depths:.4?} m")
}

fn chart(holes: &[(f64, Hole)]) -> Chart {
    let chart = Chart::new("Jet: the hole after 10 ms", "x [m]", "y [m]");
    let with = |chart: Chart, (k, hole): &(f64, Hole)| {
        chart.with(Series::line(&format!("k = {k:e} m/s"), hole.floor.clone()))
    };
    holes.iter().fold(chart, with)
}
