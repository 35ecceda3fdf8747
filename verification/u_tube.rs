//! The paper's U-tube against the exact course of its levels (Figs. 9 and 10).

use crate::bands::{Band, WITHIN, measured, range, worst};
use alluvium::Preset;
use alluvium::budget::Budget;
use alluvium::case::Case;
use alluvium::kernel::WendlandC2;
use alluvium::parallel::Threads;
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::u_tube::{Levels, SPACING, exact_difference, initial_difference};
use alluvium::verify::{Conditions, Expected, Level, Measured, Parcel, Study};
use std::ops::ControlFlow;

const CASE: &str = include_str!("cases/u_tube.toml");
const CONDUCTIVITY: f64 = 0.01;
pub const PERMEABLE: &str = "conductivity a tenth too large";
const HIGHER: &str = "a row more of water in the left arm";
/// Level of both arms where they are equal \[m\]: that of the right one.
const EQUAL: f64 = 2.0;
/// The end \[s\], how often it is looked at, and from when on Darcy's law is asked for: the start sloshes.
const END: f64 = 20.0;
const INTERVAL: f64 = 0.5;
const QUIET: f64 = 5.0;

pub fn studies() -> Vec<Study> {
    vec![
        of("u-tube/levels", "water seeps from arm to arm as the exact course has it", text).falls_short(
            Expected::Bound { largest: 1.1 },
            "q L/(k Δh) is 0.959 at one instant, as the water sways; every 2 s it is 0.971 to 0.989",
        ),
        of(
            "u-tube/levels/corrected gradients",
            "with gradients that are exact where the pressure is linear, water seeps from arm to arm as the exact \
             course has it",
            corrected,
        ),
        equal(),
    ]
}

fn equal() -> Study {
    let run = |conditions: &Conditions| {
        let higher = if conditions.is(HIGHER) { SPACING } else { 0.0 };
        let text = text(CONDUCTIVITY).replace("[mixture]", "[mixture]\ndrag_scheme = \"explicit\"");
        let levels = follow(&level(&text, higher), 0.1, 2.0);
        Measured::value(worst(levels.iter().map(|(it, _)| it.surface.abs())))
    };
    Study::new(
        "u-tube/equal levels",
        "equal levels stay equal (value: by how much they differ at worst, in m)",
        run,
    )
    .equations(&["37", "52", "55", "58", "67", "69"])
    .source("nothing drives the water")
    .level(Level::Full)
    .expect(Expected::Bound { largest: 1e-4 })
    .mutant(HIGHER)
}

fn of(name: &str, claim: &str, text: fn(f64) -> String) -> Study {
    let claim = format!("{claim} (values: half widths from the middle of each band)");
    Study::new(name, claim, move |conditions| compared(&levels(text, conditions)))
        .equations(&["37", "52", "55", "58", "67", "69", "80"])
        .source("(L_o + L/n) z'' + gL/k z' + 2gz = 0, of which Eq. (80) is the slow root")
        .level(Level::Full)
        .expect(WITHIN)
        .mutant(PERMEABLE)
}

/// In f64 with the default preset and h = 2.25 Δx: 1.5 of the spacing water has in the soil, Δx/√n.
pub fn text(conductivity: f64) -> String {
    CASE.replace("PRESET", "default")
        .replace("INTEGRATOR", "leap-frog-ab3")
        .replace("spacing_m = 0.05", "spacing_m = 0.05\nsmoothing_ratio = 2.25")
        .replace("conductivity_m_per_s = 0.01", &format!("conductivity_m_per_s = {conductivity}"))
}

/// This case with both arms and the soil between them filled to one level, the left arm by so much more \[m\].
pub fn level(text: &str, higher: f64) -> String {
    let left = EQUAL + higher;
    let line = |line: &str| match line.split_once(" = ") {
        Some(("surface_m", "4.05")) => format!("surface_m = {left:?}"),
        Some(("surface_m", _)) => format!("surface_m = {EQUAL:?}"),
        Some(("high_m", "[1.05, 4.05]")) => format!("high_m = [1.05, {left:?}]"),
        _ => line.to_owned(),
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// The same as [`text`] with [`alluvium::mixture::Mixture::with_gradient_correction`].
fn corrected(conductivity: f64) -> String {
    text(conductivity).replace("[particles]", "[particles]\ngradient_correction = true")
}

/// The levels of this case, with its books, each interval up to the end \[s\].
pub fn follow(text: &str, interval: f64, end: f64) -> Vec<(Levels, Budget<2>)> {
    let (case, _) = Case::parse("U-tube", text).expect("a case");
    let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).expect("a length");
    let mut run = case.simulation(kernel, Preset::Default.leap_frog()).expect("a case");
    let mut look = |n: usize| {
        let time = n as f64 * interval;
        let _: ControlFlow<()> = run.run_until(time, |_| ControlFlow::Continue(())).expect("a sound run");
        (Levels::of(time, &Parcel::of(run.mixture().water())), run.budget())
    };
    // One thread each: the harness runs studies side by side.
    let count = (end / interval).round() as usize;
    Threads::new(1).expect("a thread").install(|| (0..=count).map(&mut look).collect())
}

fn levels(text: fn(f64) -> String, conditions: &Conditions) -> Vec<Levels> {
    let conductivity = if conditions.is(PERMEABLE) { 1.1 * CONDUCTIVITY } else { CONDUCTIVITY };
    follow(&text(conductivity), INTERVAL, END).into_iter().map(|(levels, _)| levels).collect()
}

fn compared(levels: &[Levels]) -> Measured {
    let start = &levels[0];
    let exact = |it: &Levels| exact_difference(it.time, CONDUCTIVITY);
    let off = |it: &Levels, part: f64| (part - exact(it) / initial_difference()).abs();
    let by_mass = worst(levels.iter().map(|it| off(it, it.by_mass(start) / initial_difference())));
    let by_surface = worst(levels.iter().map(|it| off(it, it.surface / start.surface)));
    let quiet: Vec<&Levels> = levels.iter().filter(|it| it.time > QUIET).collect();
    let apart = worst(quiet.iter().map(|it| (it.head - it.by_mass(start)).abs()));
    let [least, most] = range(quiet.iter().map(|it| it.darcy_ratio(CONDUCTIVITY)));
    let series = |of: &dyn Fn(&Levels) -> f64| levels.iter().map(|it| (it.time, of(it))).collect::<Vec<_>>();
    let chart = Chart::new("U-tube: difference of the levels", "time [s]", "δZ [m]")
        .with(Series::line("exact", series(&exact)))
        .with(Series::points("by mass", series(&|it| it.by_mass(start))))
        .with(Series::points("by free surface", series(&|it| it.surface)))
        .with(Series::points("by head", series(&|it| it.head)));
    measured(vec![
        Band::new("by mass, of the start", Some(by_mass), (0.0, 0.01)),
        Band::new("by free surface, of its start", Some(by_surface), (0.0, 0.01)),
        Band::new("head less that by mass [m]", Some(apart), (0.0, 0.015)),
        Band::new("least q L/(k Δh)", Some(least), (0.96, 1.04)),
        Band::new("largest q L/(k Δh)", Some(most), (0.96, 1.04)),
    ])
    .picture(&chart)
}
