//! The paper's column of sand against the experiment of Bui et al. (2008).

use crate::bands::{Band, WITHIN, measured};
use crate::dam_run::published;
use crate::shared_runs::SharedRuns;
use alluvium::case::Case;
use alluvium::kernel::WendlandC2;
use alluvium::parallel::Threads;
use alluvium::time::LeapFrog;
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::sand_column::{COMPARED, FailureLine, MOVED, Pile, Section};
use alluvium::verify::{Conditions, Curve, Level, Study};
use std::ops::ControlFlow;

const CASE: &str = include_str!("cases/sand_column.toml");
const SURFACE: &str = include_str!("data/bui_2008_surface.csv");
const SOURCE: &str = "Bui, Fukagawa, Sako & Ohno (2008), experiment with bars of aluminium: surface and failure \
                      line in verification/data";
const STEEP: &str = "friction angle of 30°";
const EARLY: &str = "looked at after 0.3 s";
/// When the heap has come to rest \[s\].
const END: f64 = 1.0;

pub fn studies() -> Vec<Study> {
    let [coarse, fine] = [0.0025, 0.00125];
    let studies = [surface(coarse).mutant(STEEP), surface(fine), rest(coarse).mutant(EARLY), rest(fine)];
    studies.into_iter().map(|study| study.level(Level::Full).expect(WITHIN)).collect()
}

fn surface(spacing: f64) -> Study {
    let claim = "sand that flows at a constant volume ends where the experiment ended: surface, foot of the failure \
                 line, area (values: half widths from the middle of each band)";
    Study::new(format!("sand-column/surface/{spacing}"), claim, move |conditions| {
        let heap = heap(spacing, conditions);
        let (rms, _) = heap.surface.distance(&experiment().between(0.0, COMPARED), 0.0);
        let chart = Chart::new(&format!("Sand column, Δx = {spacing} m"), "x [m]", "y [m]")
            .with(Series::line("computed", heap.surface.points().to_vec()))
            .with(Series::points("experiment", experiment().points().to_vec()));
        measured(vec![
            Band::new("rms of the surface [m]", Some(rms), (0.0, 5e-3)),
            Band::new("x at 20 mm [m]", heap.reach[0], (0.31, 0.33)),
            Band::new("x at 50 mm [m]", heap.reach[1], (0.184, 0.204)),
            Band::new("foot of the failure line [m]", heap.foot, (0.16, 0.20)),
            Band::new("area over that at the start", Some(heap.area), (1.0, 1.07)),
        ])
        .picture(&chart)
    })
    .equations(&["24", "26", "33", "53", "55", "65", "76"])
    .source(SOURCE)
}

fn rest(spacing: f64) -> Study {
    let claim = "the heap rests under its own weight (values: half widths from the middle of each band)";
    Study::new(format!("sand-column/rest/{spacing}"), claim, move |conditions| {
        let heap = heap(spacing, conditions);
        measured(vec![
            Band::new("largest pressure [Pa]", Some(heap.pressure), (0.0, 3e3)),
            Band::new("rms velocity [m/s]", Some(heap.speed), (0.0, 1e-3)),
        ])
    })
    .equations(&["24", "26", "55"])
    .source("the weight of the heap, ρgH = 2.6 kPa")
}

/// The column after its collapse.
#[derive(Clone)]
struct Heap {
    surface: Curve,
    /// Where it is 20 and 50 mm high \[m\].
    reach: [Option<f64>; 2],
    foot: Option<f64>,
    area: f64,
    pressure: f64,
    speed: f64,
}

fn heap(spacing: f64, conditions: &Conditions) -> Heap {
    static RUNS: SharedRuns<Heap> = SharedRuns::new();
    RUNS.get(format!("{spacing} {:?}", conditions.mutant), || collapse(spacing, conditions))
}

fn collapse(spacing: f64, conditions: &Conditions) -> Heap {
    let angle = if conditions.is(STEEP) { "friction_angle_deg = 30.0" } else { "friction_angle_deg = 19.8" };
    let text = CASE
        .replace("PRESET", "default")
        .replace("INTEGRATOR", "leap-frog")
        .replace("friction_angle_deg = 19.8", angle)
        .replace("[[soil.block]]", "[soil.stress_regularisation]\nevery_steps = 200\n\n[[soil.block]]")
        .replace("spacing_m = 0.005", &format!("spacing_m = {spacing}"));
    let (case, _) = Case::parse("sand column", &text).expect("a case");
    let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).expect("a length");
    let mut run = case.simulation(kernel, LeapFrog::new()).expect("a case");
    // One thread each: the harness runs studies side by side.
    Threads::new(1).expect("a thread").install(|| {
        let start = Pile::of(run.mixture(), Section::FLAT);
        let end = if conditions.is(EARLY) { 0.3 } else { END };
        let _: ControlFlow<()> = run.run_until(end, |_| ControlFlow::Continue(())).expect("a sound run");
        let end = Pile::of(run.mixture(), Section::FLAT);
        Heap {
            surface: end.profile(),
            reach: [0.02, 0.05].map(|height| end.reach(height)),
            foot: FailureLine::between(&start, &end, MOVED).foot(),
            area: end.volume_below_surface() / start.volume_below_surface(),
            pressure: end.largest_pressure(),
            speed: end.rms_velocity(),
        }
    })
}

fn experiment() -> Curve {
    published(SURFACE)
}
