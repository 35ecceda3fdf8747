//! Levels and flow against the exact course: tables and charts.

use super::CONDUCTIVITY;
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use crate::reproduce::ledger::Ledger;
use crate::run::Finished;
use alluvium::case::Case;
use alluvium::verify::u_tube::{Levels, exact_difference, initial_difference};

/// Bars are asked from here on \[s\] where the start's sloshing must have died, and up to here.
const QUIET: f64 = 5.0;
const EARLY: f64 = 20.0;

/// What was run.
pub fn head(case: &Case, finished: &Finished) -> String {
    let more = format!(" h = {:.3} m, k = {CONDUCTIVITY} m/s.", case.smoothing_length());
    head::of_report("Flow through soil in a U-tube", "water", case, finished, &more)
}

/// One line per bar.
pub fn bars(levels: &[Levels], ledger: &Ledger) -> String {
    let mut table = Bars::default();
    let Some(start) = levels.first() else { return table.markdown() };
    let off = |it: &Levels, difference: f64, whole: f64| {
        (difference / whole - exact_difference(it.time, CONDUCTIVITY) / initial_difference()).abs()
    };
    let worst = |until: f64, of: &dyn Fn(&Levels) -> f64| {
        levels.iter().filter(|it| it.time <= until).map(of).fold(0.0, f64::max)
    };
    let by_mass = |it: &Levels| off(it, it.by_mass(start), initial_difference());
    let by_surface = |it: &Levels| off(it, it.surface, start.surface);
    for (until, when, bar) in [(EARLY, "to 20 s", 0.01), (f64::INFINITY, "at all times", 0.02)] {
        for (name, of) in [("mass", &by_mass as &dyn Fn(&Levels) -> f64), ("free surface", &by_surface)] {
            let error = worst(until, of);
            let what = format!("difference of levels by {name} against the exact course, {when}");
            let bar_text = format!("within {:.0} % of its own start", 1e2 * bar);
            table.add(&what, format!("{:.2} %", 1e2 * error), bar_text, Some(error < bar));
        }
    }
    let quiet: Vec<&Levels> = levels.iter().filter(|it| it.time > QUIET && it.time < EARLY).collect();
    if !quiet.is_empty() {
        let apart = quiet.iter().map(|it| (it.head - it.by_mass(start)).abs()).fold(0.0, f64::max);
        let what = "head less the difference by mass, 5 to 20 s";
        table.add(what, format!("{:.1} mm", 1e3 * apart), "below 15 mm", Some(apart < 0.015));
        let ratios = quiet.iter().map(|it| it.darcy_ratio(CONDUCTIVITY));
        let (least, most) = ratios.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        let met = least >= 0.96 && most <= 1.04;
        let found = format!("{least:.3} to {most:.3}");
        table.add("q over k Δh/L, 5 to 20 s", found, "0.96 to 1.04", Some(met));
    }
    let largest = ledger.closure.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let what = "energy closure, the largest, over the potential energy at the start";
    table.add(what, format!("{largest:.1e}"), "below 1e-4", Some(largest < 1e-4));
    table.markdown()
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
