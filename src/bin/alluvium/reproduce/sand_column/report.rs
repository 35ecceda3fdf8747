//! Computed against the experiment, as tables: every bar with its number and a plain yes or no.

use super::{Beside, Published, Run};
use crate::reproduce::bars::Bars;
use crate::reproduce::ledger::Ledger;
use alluvium::verify::sand_column::{COMPARED, FailureLine, WIDTH, run_out};
use core::fmt::Write;

/// One line per bar.
pub fn bars(run: &Run, ledger: &Ledger, published: &Published) -> String {
    let mut table = Bars::default();
    surface(&mut table, run, published);
    failure(&mut table, run);
    rest(&mut table, run);
    let largest = ledger.closure.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let what = "energy closure, the largest, over the potential energy at the start";
    table.add(what, format!("{largest:.1e}"), "below 1e-4", Some(largest < 1e-4));
    table.markdown()
}

fn surface(table: &mut Bars, run: &Run, published: &Published) {
    let (rms, count) = run.surface.distance(&published.surface.between(0.0, COMPARED), 0.0);
    let what = format!("surface, rms over {count} measured points up to {COMPARED} m");
    table.add(&what, format!("{:.2} mm", rms * 1e3), "at most 5 mm", Some(rms <= 5e-3));
    let Some((_, end)) = run.end() else { return };
    for (height, expected) in [(0.02, 0.32), (0.05, 0.194)] {
        let (what, bar) =
            (format!("x where the surface is {} mm high", height * 1e3), format!("{expected} ± 0.01 m"));
        match end.reach(height) {
            Some(x) => {
                table.add(&what, format!("{x:.3} m"), bar, Some((x - expected).abs() <= 0.01));
            }
            None => table.add(&what, "nowhere", bar, Some(false)),
        }
    }
    if let Some((ruler, density)) = run.bulking() {
        let (bar, within) = ("1.00 to 1.07", (1.0..=1.07).contains(&ruler));
        table.add("area below the surface over that at the start", format!("{ruler:.3}"), bar, Some(within));
        table.add("Σ V of the particles over that at the start", format!("{density:.3}"), "none", None);
    }
    let front = end.front();
    let far = format!("{front:.3} m, (L∞ − L₀)/L₀ = {:.2}", run_out(front, WIDTH));
    table.add("end of the heap", far, "none", None);
    table.add("farthest grain", format!("{:.3} m", end.farthest()), "none", None);
}

fn failure(table: &mut Bars, run: &Run) {
    let (what, bar) = ("foot of the failure line (moved by 2.5 mm)", "0.18 ± 0.02 m");
    match run.failure.foot() {
        Some(x) => table.add(what, format!("{x:.3} m"), bar, Some((x - 0.18).abs() <= 0.02)),
        None => table.add(what, "there is none", bar, Some(false)),
    }
    table.add("straight line through it", straight(&run.failure), "none", None);
}

fn rest(table: &mut Bars, run: &Run) {
    let Some((time, end)) = run.end() else { return };
    let pressure = end.largest_pressure();
    let what = format!("largest pressure at {time} s");
    table.add(&what, format!("{:.2} kPa", pressure * 1e-3), "below 3 kPa", Some(pressure < 3e3));
    let most = run.piles.iter().map(|(_, pile)| pile.largest_pressure()).fold(0.0, f64::max);
    table.add("the same, most at any dump", format!("{:.2} kPa", most * 1e-3), "none", None);
    let speed = end.rms_velocity();
    let what = format!("rms velocity at {time} s");
    table.add(&what, format!("{speed:.1e} m/s"), "below 1e-3 m/s", Some(speed < 1e-3));
}

fn straight(line: &FailureLine) -> String {
    line.straight().map_or("none".to_owned(), |(angle, foot)| format!("{angle:.1}°, foot {foot:.3} m"))
}

/// The paper's flow rule beside, without bars.
pub fn beside(run: &Run, beside: Option<&Beside>, published: &Published) -> String {
    let Some(Beside { run: other, stopped }) = beside else {
        return "\nThe flow is associated (ψ = θ), as the paper has it: it bulks, and does not come to rest.\n"
            .to_owned();
    };
    let mut text =
        "\n## Beside: associated flow, as the paper has it\n\nThe same run with ψ = θ, the paper's flow \
                    rule. Sand that shears then dilates without end: no grain does that, and the \
                    experiment did not. It is shown to be seen, not as a result.\n\n"
            .to_owned();
    if let Some(what) = stopped {
        writeln!(text, "It did not reach the end: {what}\n").ok();
    }
    text += "| what | ψ = 0 | ψ = θ | experiment |\n|---|---|---|---|\n";
    let reach = |height: f64| {
        let of = |run: &Run| run.end().and_then(|(_, pile)| pile.reach(height));
        [of(run), of(other)].map(|x| x.map_or("nowhere".to_owned(), |x| format!("{x:.3} m")))
    };
    let measured = |height: f64| {
        let last = published.surface.points().windows(2).rev().find(|pair| pair[0].1 >= height);
        let between = |pair: &[(f64, f64)]| {
            let [(x, y), (to_x, to_y)] = [pair[0], pair[1]];
            format!("{:.3} m", x + (to_x - x) * (y - height) / (y - to_y))
        };
        last.map_or("–".to_owned(), between)
    };
    let mut row = |what: &str, [own, theirs]: [String; 2], published: &str| {
        writeln!(text, "| {what} | {own} | {theirs} | {published} |").ok();
    };
    for height in [0.05, 0.02, 0.01] {
        let what = format!("x where the surface is {} mm high", height * 1e3);
        row(&what, reach(height), &measured(height));
    }
    let both =
        |of: &dyn Fn(&Run) -> Option<String>| [run, other].map(|run| of(run).unwrap_or("–".to_owned()));
    let under = area(published.surface.points()) / (WIDTH * alluvium::verify::sand_column::HEIGHT);
    let bulking = |run: &Run| run.bulking().map(|(ruler, _)| format!("{ruler:.3}"));
    row("area below the surface over that at the start", both(&bulking), &format!("{under:.3}"));
    let line = |run: &Run| Some(straight(&run.failure));
    row("failure line", both(&line), &straight(&published.failure));
    let speed = |run: &Run| run.end().map(|(_, pile)| format!("{:.1e} m/s", pile.rms_velocity()));
    row("rms velocity at the end", both(&speed), "0");
    let pressure = |run: &Run| {
        let all = run.piles.iter().map(|(_, pile)| pile.largest_pressure());
        all.reduce(f64::max).map(|p| format!("{:.1} kPa", p * 1e-3))
    };
    row("largest pressure at any dump", both(&pressure), "–");
    text
}

/// Area below a curve.
fn area(points: &[(f64, f64)]) -> f64 {
    points.windows(2).map(|pair| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1)).sum()
}
