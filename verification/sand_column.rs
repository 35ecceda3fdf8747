//! The paper's column of sand against the experiment of Bui et al. (2008).

use crate::bands::{Band, WITHIN, measured, range};
use crate::dam_run::published;
use crate::shared_runs::SharedRuns;
use alluvium::budget::{Account, Budget};
use alluvium::case::Case;
use alluvium::kernel::WendlandC2;
use alluvium::parallel::Threads;
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::sand_column::{COMPARED, FailureLine, MOVED, Pile, RUN_OUT, Section, run_out};
use alluvium::verify::{Conditions, Curve, Level, Measured, Study};
use alluvium::{Preset, Real};
use std::ops::ControlFlow;

const CASE: &str = include_str!("cases/sand_column.toml");
const SURFACE: &str = include_str!("data/bui_2008_surface.csv");
const SOURCE: &str = "Bui, Fukagawa, Sako & Ohno (2008), experiment with bars of aluminium: surface and failure \
                      line in verification/data";
const STEEP: &str = "friction angle of 30°";
const SLIPPERY: &str = "friction angle of 10°";
const UNBOOKED: &str = "smoothing left out of the ledger";
const EARLY: &str = "looked at after 0.3 s";
/// When the heap has come to rest \[s\].
const END: f64 = 1.0;

pub fn studies() -> Vec<Study> {
    let [coarse, fine] = [0.0025, 0.00125];
    let studies = [
        surface(coarse).mutant(STEEP),
        surface(fine),
        rest(coarse).mutant(EARLY),
        rest(fine),
        precision(coarse),
        regularisation(),
        shapes(),
    ];
    studies.into_iter().map(|study| study.level(Level::Full).expect(WITHIN)).collect()
}

fn surface(spacing: f64) -> Study {
    let claim = "sand that flows at a constant volume, its stress smoothed every 200 steps, is after 1 s where the experiment \
                 ended: surface, foot of the failure line, area (values: half widths from the middle of each band)";
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
    let claim = "the heap, its stress smoothed every 200 steps, rests under its own weight after 1 s (values: half widths from \
                 the middle of each band)";
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

fn precision(spacing: f64) -> Study {
    let claim = "single precision ends where double precision does: the surfaces are no further from each other than \
                 those of two resolutions in double precision (value: the ratio of these rms distances)";
    Study::new("sand-column/precision", claim, move |conditions| {
        let sound = Conditions::default();
        let [single, double, coarse] =
            [heap_in::<f32>(spacing, conditions), heap(spacing, &sound), heap(2.0 * spacing, &sound)];
        let apart = |other: &Heap| other.surface.distance(&double.surface.between(0.0, COMPARED), 0.0).0;
        let note =
            format!("f32 from f64 {:.3e} m, {:.3e} m between resolutions", apart(&single), apart(&coarse));
        Measured::value(apart(&single) / apart(&coarse)).note(note)
    })
    .equations(&["33", "53", "55"])
    .source("the same case in another precision, and at twice the spacing")
    .mutant(STEEP)
}

fn regularisation() -> Study {
    let claim = "stress smoothed every 200 steps takes energy, and the ledger has it (value: what no account explains \
                 over two thousandths of what was released)";
    Study::new("sand-column/regularisation", claim, move |conditions| {
        let (_, _, [start, end]) = run::<f64>(&text(0.005, 19.8).replace("[[soil.block]]", REGULARISED), 0.6);
        let released = start.potential - end.potential;
        let taken = end.taken[Account::Regularisation];
        let left_out = if conditions.is(UNBOOKED) { taken } else { 0.0 };
        let note = format!("released {released:.3e} J/m, smoothing took {taken:.3e} J/m");
        Measured::value((end.closure(&start) - left_out).abs() / released / 2e-3).note(note)
    })
    .equations(&["33", "55"])
    .source("conservation of energy")
    .mutant(UNBOOKED)
}

/// Columns of other shapes, 0.1 m wide: aspect ratio, and when each is at rest \[s\].
const SHAPES: [(f64, f64); 4] = [(0.5, 0.8), (1.0, 1.1), (2.0, 1.5), (4.0, 2.1)];

fn shapes() -> Study {
    let claim = "columns of other shapes run no less far than the shortest and no farther than the longest of the laws of \
                 others, which differ by a factor of two to three (values: half widths from the middle between these)";
    Study::new("sand-column/run-out", claim, move |conditions| {
        let angle = if conditions.is(SLIPPERY) { 10.0 } else { 19.8 };
        let bands = SHAPES.map(|(ratio, end)| {
            let width = 0.1;
            let text = text(0.005, angle)
                .replace("high_m = [0.2, 0.1]", &format!("high_m = [{width}, {}]", ratio * width))
                .replace("high_m = [0.7, 0.15]", &format!("high_m = [2.0, {}]", (ratio + 0.5) * width));
            let (_, heap, _) = run::<f64>(&text, end);
            let [least, most] = range(RUN_OUT.iter().filter_map(|law| law.at(ratio)));
            Band::new(
                format!("(L∞ − L₀)/L₀ at a = {ratio}"),
                Some(run_out(heap.front(), width)),
                (least, most),
            )
        });
        measured(bands.into())
    })
    .equations(&["24", "26", "33", "53", "55"])
    .source("laws in verification/data/column_collapse_scaling_laws.csv, each with its source")
    .mutant(SLIPPERY)
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
    heap_in::<f64>(spacing, conditions)
}

fn heap_in<T: Real>(spacing: f64, conditions: &Conditions) -> Heap {
    static RUNS: SharedRuns<Heap> = SharedRuns::new();
    RUNS.get(format!("{} {spacing} {:?}", T::NAME, conditions.mutant), || collapse::<T>(spacing, conditions))
}

fn collapse<T: Real>(spacing: f64, conditions: &Conditions) -> Heap {
    let angle = if conditions.is(STEEP) { 30.0 } else { 19.8 };
    let text = text(spacing, angle).replace("[[soil.block]]", REGULARISED);
    let end = if conditions.is(EARLY) { 0.3 } else { END };
    let (start, end, _) = run::<T>(&text, end);
    Heap {
        surface: end.profile(),
        reach: [0.02, 0.05].map(|height| end.reach(height)),
        foot: FailureLine::between(&start, &end, MOVED).foot(),
        area: end.volume_below_surface() / start.volume_below_surface(),
        pressure: end.largest_pressure(),
        speed: end.rms_velocity(),
    }
}

const REGULARISED: &str = "[soil.stress_regularisation]\nevery_steps = 200\n\n[[soil.block]]";

/// The case at a spacing \[m\] and an angle of friction \[°\].
fn text(spacing: f64, angle: f64) -> String {
    CASE.replace("PRESET", "default")
        .replace("INTEGRATOR", "leap-frog-ab3")
        .replace("friction_angle_deg = 19.8", &format!("friction_angle_deg = {angle:.1}"))
        .replace("spacing_m = 0.005", &format!("spacing_m = {spacing}"))
}

/// How a case begins and ends, and its ledger of both.
fn run<T: Real>(text: &str, end: f64) -> (Pile, Pile, [Budget<2>; 2]) {
    let (case, _) = Case::parse("sand column", text).expect("a case");
    let kernel = WendlandC2::<T, 2>::new(T::of(case.smoothing_length())).expect("a length");
    let mut run = case.simulation(kernel, Preset::Default.leap_frog()).expect("a case");
    // One thread each: the harness runs studies side by side.
    Threads::new(1).expect("a thread").install(|| {
        run.start().expect("a start");
        let before = (Pile::of(run.mixture(), Section::FLAT), run.budget());
        let _: ControlFlow<()> = run.run_until(end, |_| ControlFlow::Continue(())).expect("a sound run");
        (before.0, Pile::of(run.mixture(), Section::FLAT), [before.1, run.budget()])
    })
}

fn experiment() -> Curve {
    published(SURFACE)
}
