//! Computed against expected and published, as a table: every bar with its number and a plain yes or no.

use super::{Results, Watch};
use crate::reproduce::bars::Bars;
use alluvium::case::Case;

/// Fronts at these times lie in these intervals in every computation that was compared.
const EXPECTED: [(f64, f64, f64); 3] = [(1.5, 1.98, 2.08), (2.0, 2.56, 2.70), (2.5, 3.20, 3.38)];
/// Between these times the front is compared with published data.
const COMPARED: (f64, f64) = (1.0, 2.9);

/// One line per bar.
pub fn bars(case: &Case, results: &Results, watch: &Watch<'_>) -> String {
    let mut table = Bars::default();
    fronts(&mut table, results);
    noise(&mut table, case, watch);
    closure(&mut table, case, results);
    strays(&mut table, watch);
    table.markdown()
}

fn fronts(table: &mut Bars, results: &Results) {
    for (time, low, high) in EXPECTED {
        let (what, bar) = (format!("front X at T = {time}"), format!("{low:.2} to {high:.2}"));
        match results.front.at(time) {
            Some(x) => table.add(&what, format!("{x:.3}"), bar, Some((low..=high).contains(&x))),
            None => table.add(&what, "not reached", bar, None),
        }
    }
    let compared = results.front.between(COMPARED.0, COMPARED.1);
    let published: Vec<_> = results.published.iter().map(|(_, curve)| curve).collect();
    let beyond = compared.beyond(&published);
    let what = format!("front outside the published envelope, {} < T < {}", COMPARED.0, COMPARED.1);
    table.add(&what, format!("{beyond:.3}"), "at most 0.05", Some(beyond <= 0.05));
    let (shift, rms) = results.front.best_shift(&published[0].between(0.0, COMPARED.1));
    let what = format!("rms of X against Martin & Moyce moved by {shift:+.2} in T");
    table.add(&what, format!("{rms:.3}"), "at most 0.2", Some(rms <= 0.2));
}

fn noise(table: &mut Bars, case: &Case, watch: &Watch<'_>) {
    for time in [0.1, 0.2] {
        let Some(measures) = watch.at(time) else { continue };
        let (noise, particles) = measures.noise;
        let what = format!("pressure noise over ρgH at {time} s, {particles} particles");
        let percent = format!("{:.2} %", 100.0 * noise);
        if case.preset == alluvium::Preset::Default {
            table.add(&what, percent, "below 3 %", Some(noise < 0.03));
        } else {
            table.add(&what, percent, "none for this preset", None);
        }
    }
}

fn closure(table: &mut Bars, case: &Case, results: &Results) {
    let booked = case.water.as_ref().map_or(0, |water| water.reinitialisation_every) > 0;
    let (bar, kind) = if booked { (2e-3, "with (70) booked") } else { (1e-4, "without (70)") };
    let last = results.ledger.closure.last().copied().unwrap_or(0.0);
    let largest = results.ledger.closure.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let what = format!("energy closure at {} s over the potential energy at the start", case.end_time);
    table.add(&what, format!("{last:.1e}"), format!("below {bar:e} {kind}"), Some(last.abs() < bar));
    table.add("its largest value on the way", format!("{largest:.1e}"), "none", None);
}

fn strays(table: &mut Bars, watch: &Watch<'_>) {
    let most = |of: fn(&crate::solver::DamBreak) -> usize| {
        watch.measures.iter().map(|(_, measures)| of(measures)).max().unwrap_or(0)
    };
    let leaked = most(|measures| measures.leaked);
    table.add(
        "particles that went through a wall, most at any dump",
        leaked.to_string(),
        "0",
        Some(leaked == 0),
    );
    if let Some(measures) = watch.at(0.2) {
        let stuck = measures.stuck;
        let what = "particles hanging at the left wall at 0.2 s";
        table.add(what, stuck.to_string(), "0", Some(stuck == 0));
    }
    let stuck = most(|measures| measures.stuck);
    table.add("the same, most at any dump", stuck.to_string(), "none", None);
    if let Some(measures) = watch.at(0.2) {
        let error = measures.velocity;
        let what = format!(
            "L₂ error (78) of the horizontal velocity at 0.2 s, {} particles, {} left out",
            error.compared, error.left_out
        );
        table.add(&what, format!("{:.3}", error.l2), "none", None);
    }
}
