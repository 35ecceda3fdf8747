//! Levels and flow against the exact course: tables and charts.

use super::CONDUCTIVITY;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use crate::reproduce::ledger::Ledger;
use crate::run::Finished;
use alluvium::case::Case;
use alluvium::verify::u_tube::{HeadProfile, Levels, exact_difference, initial_difference};

/// Bars are asked from here on \[s\] where the start's sloshing must have died, and up to here.
const QUIET: f64 = 5.0;
const EARLY: f64 = 20.0;
/// How far levels may be off, of the difference at the start \[-\]: up to there, and at all times.
const EARLY_BAR: f64 = 0.01;
const BAR: f64 = 0.02;

/// What was run.
pub fn head(case: &Case, finished: &Finished) -> String {
    let more = format!(" h = {:.3} m, k = {CONDUCTIVITY} m/s.", case.smoothing_length());
    head::of_report("Flow through soil in a U-tube", "water", case, finished, &more)
}

/// One line per bar.
pub fn bars(levels: &[Levels], ledger: &Ledger) -> String {
    let mut table = Bars::default();
    for (until, when, bar) in [(EARLY, "to 20 s", EARLY_BAR), (f64::INFINITY, "at all times", BAR)] {
        for (name, errors) in off_the_course(levels) {
            let during = errors.iter().filter(|(time, _)| *time <= until);
            let error = during.map(|(_, error)| error.abs()).fold(0.0, f64::max);
            let what = format!("difference of levels by {name} against the exact course, {when}");
            let bar_text = format!("within {:.0} % of its own start", 1e2 * bar);
            table.add(&what, format!("{:.2} %", 1e2 * error), bar_text, Some(error < bar));
        }
    }
    let later = levels.partition_point(|it| it.time <= QUIET);
    let (quiet, late) = levels[later..].split_at(levels[later..].partition_point(|it| it.time < EARLY));
    for (looks, when, is_asked) in [(quiet, "5 to 20 s", true), (late, "from 20 s on", false)] {
        if looks.is_empty() {
            continue;
        }
        let bar = |bar: &'static str| if is_asked { bar } else { "none" };
        let apart = looks.iter().map(|it| (it.head - it.by_mass(&levels[0])).abs()).fold(0.0, f64::max);
        let what = format!("head less the difference by mass, {when}");
        let met = is_asked.then_some(apart < 0.015);
        table.add(&what, format!("{:.1} mm", 1e3 * apart), bar("below 15 mm"), met);
        let ratios = looks.iter().map(|it| it.darcy_ratio(CONDUCTIVITY));
        let (least, most) = ratios.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        let met = is_asked.then_some(least >= 0.96 && most <= 1.04);
        let found = format!("{least:.3} to {most:.3}");
        table.add(&format!("q over k Δh/L, {when}"), found, bar("0.96 to 1.04"), met);
    }
    let largest = ledger.closure.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let what = "energy closure, the largest, over the potential energy at the start";
    table.add(what, format!("{largest:.1e}"), "below 1e-4", Some(largest < 1e-4));
    table.markdown()
}

/// By what the difference of levels is measured, and over time \[s\] how far it is off the exact course, of its
/// own start \[-\].
fn off_the_course(levels: &[Levels]) -> [(&'static str, Vec<(f64, f64)>); 2] {
    let exact = |it: &Levels| exact_difference(it.time, CONDUCTIVITY) / initial_difference();
    let by_mass = |it: &Levels| it.by_mass(&levels[0]) / initial_difference();
    let by_surface = |it: &Levels| it.surface / levels[0].surface;
    let off = |of: &dyn Fn(&Levels) -> f64| levels.iter().map(|it| (it.time, of(it) - exact(it))).collect();
    [("mass", off(&by_mass)), ("free surface", off(&by_surface))]
}

/// The same errors as a chart, between their bars.
pub fn errors(levels: &[Levels]) -> String {
    let end = levels.last().map_or(1.0, |it| it.time);
    let bar = |side: f64| {
        let steps = [(0.0, EARLY_BAR), (EARLY, EARLY_BAR), (EARLY, BAR), (end.max(EARLY), BAR)];
        steps.map(|(time, bar)| (time, 1e2 * side * bar)).to_vec()
    };
    let title = "U-tube: difference of the levels against the exact course";
    let chart = Chart::new(title, "time [s]", "error [% of the start]")
        .x_range(0.0, end)
        .with(Series::dashed("bars", bar(1.0)).coloured("#999999"))
        .with(Series::dashed("", bar(-1.0)).coloured("#999999"));
    let [(mass, by_mass), (surface, by_surface)] = off_the_course(levels);
    let of = |name: &str, errors: Vec<(f64, f64)>| {
        let errors = errors.into_iter().map(|(time, error)| (time, 1e2 * error)).collect();
        Series::points(&format!("by {name}"), errors)
    };
    chart.with(of(mass, by_mass).coloured("#0072b2")).with(of(surface, by_surface).coloured("#d55e00")).svg()
}

/// Head along the soil at up to five instants, over the straight lines of Darcy's flow.
pub fn heads(profiles: &[HeadProfile]) -> String {
    const COLOURS: [&str; 5] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"];
    let chart = Chart::new("U-tube: head along the soil", "x [m]", "head p/ρg + y [m]");
    let every = profiles.len().saturating_sub(1).div_ceil(COLOURS.len() - 1).max(1);
    let with = |chart: Chart, (profile, colour): (&HeadProfile, &'static str)| {
        chart
            .with(Series::line("", profile.ends.to_vec()).coloured(colour))
            .with(Series::points(&format!("{:.0} s", profile.time), profile.columns.clone()).coloured(colour))
    };
    profiles.iter().step_by(every).zip(COLOURS).fold(chart, with).svg()
}

/// Differences of levels over time (Fig. 9).
pub fn levels(levels: &[Levels]) -> String {
    let Some(start) = levels.first() else { return String::new() };
    let series = |of: &dyn Fn(&Levels) -> f64| levels.iter().map(|it| (it.time, of(it))).collect::<Vec<_>>();
    let end = levels.last().map_or(1.0, |it| it.time);
    let fine = (0..=200).map(|n| end * f64::from(n) / 200.0);
    let exact = fine.map(|time| (time, exact_difference(time, CONDUCTIVITY))).collect();
    Chart::new("U-tube: difference of the levels", "time [s]", "δZ [m]")
        .with(Series::line("exact", exact).coloured("#999999"))
        .with(Series::points("by mass", series(&|it| it.by_mass(start))).coloured("#0072b2"))
        .with(Series::points("by free surface", series(&|it| it.surface)).coloured("#d55e00"))
        .with(Series::points("by head", series(&|it| it.head)).coloured("#009e73"))
        .svg()
}

/// Darcy velocity over time (Fig. 10).
pub fn flow(levels: &[Levels]) -> String {
    let end = levels.last().map_or(1.0, |it| it.time);
    let step = end / 200.0;
    let rate = |time: f64| {
        let difference = |time: f64| exact_difference(time, CONDUCTIVITY);
        0.5 * (difference(time) - difference(time + step)) / step
    };
    let exact = (0..200).map(|n| (f64::from(n) + 0.5) * step).map(|t| (t, rate(t - 0.5 * step))).collect();
    Chart::new("U-tube: Darcy velocity in the soil", "time [s]", "q [m/s]")
        .with(Series::line("exact, −½ dδZ/dt", exact).coloured("#999999"))
        .with(
            Series::points("⟨φ v⟩ in the soil", levels.iter().map(|it| (it.time, it.flow)).collect())
                .coloured("#0072b2"),
        )
        .svg()
}
