//! The hole and the flow, as a table and a chart.

use super::{Jet, Look, Watch};
use crate::plots::{Chart, Series};
use crate::reproduce::bars::Bars;
use crate::reproduce::head;
use crate::reproduce::ledger::Ledger;
use crate::run::Finished;
use crate::solver::{Parcels, quantity};
use alluvium::case::Case;
use alluvium::output::Table;
use alluvium::verify::Parcel;
use alluvium::verify::jet::{TANK, overflow};

/// When the hole is measured \[s\].
const MEASURED: f64 = 0.01;

/// What was run.
pub fn head(case: &Case, finished: &Finished, jet: &Jet) -> String {
    let more = format!(
        " h = {} Δx, k = {:e} m/s, ψ = {}°, φ_s = {}.",
        case.particles.smoothing_ratio, jet.conductivity, jet.dilatancy, jet.fraction
    );
    head::of_report("Excavation of saturated soil by a jet", "soil and water", case, finished, &more)
}

/// One line per bar.
pub fn bars(watch: &Watch, history: &Table, ledger: &Ledger) -> String {
    let mut table = Bars::default();
    if let Some(look) = watch.hole_at(MEASURED) {
        let depth = 1e3 * look.hole.depth();
        // Consistent associated flow misses it; "F ≥ 0" to the letter comes near (A13, decision 25).
        let (bar, within) = if watch.jet.dilatancy > 0.0 {
            ("24 to 27 mm", (24.0..=27.0).contains(&depth))
        } else {
            ("49 ± 5 mm", (44.0..=54.0).contains(&depth))
        };
        let when = format!("depth of the hole at {:.0} ms", 1e3 * look.time);
        table.add(&when, format!("{depth:.1} mm"), bar, Some(within));
        let width = format!("{:.0} mm", 1e3 * look.hole.width_at(0.5));
        table.add("its width at half the depth", width, "none", None);
        let ratio = format!("{:.2}", look.hole.roundness());
        table.add("that over the width at a tenth of it (U 1, V ½)", ratio, "none", None);
        let curvature = format!("{:.1} /m", look.hole.curvature());
        table.add("curvature of its floor", curvature, "none", None);
        table.add("its section", format!("{:.1} cm²", 1e4 * look.hole.area()), "none", None);
    }
    let fractions = watch.looks.iter().flat_map(|look| &look.parcels.water).map(|it| it.fraction);
    let (least, most) = fractions.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    let within = least >= -1e-4 && most <= 1.0001;
    let found = format!("{least:.4} to {most:.5}");
    table.add("volume fraction of water at the dumps", found, "-1e-4 to 1.0001", Some(within));
    let pressures = || watch.looks.iter().flat_map(|look| &look.parcels.water).map(|it| it.pressure * 1e-6);
    let (least, most) = pressures().fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    let within = least >= -0.25 && most <= 0.8;
    table.add(
        "pressure at the dumps",
        format!("{least:.3} to {most:.3} MPa"),
        "-0.25 to 0.8 MPa",
        Some(within),
    );
    for (what, of) in
        [("soil", |it| &it.soil), ("water", |it| &it.water)] as [(&str, fn(&Parcels) -> &[Parcel]); 2]
    {
        let Some(look) = watch.looks.last() else { continue };
        let [above, beyond] = overflow(of(&look.parcels)).map(|area| format!("{:.1} cm²", 1e4 * area));
        let when = format!("{what} above the rim at {:.0} ms, and of it beyond the tank", 1e3 * look.time);
        table.add(&when, format!("{above}, {beyond}"), "none", None);
    }
    energies(&mut table, history, ledger);
    table.markdown()
}

fn energies(table: &mut Bars, history: &Table, ledger: &Ledger) {
    let last = |name: &str| quantity::column(history, name).ok().and_then(|column| column.last().copied());
    let came = last(quantity::INFLOW).map(|taken| -taken);
    if let (Some(kinetic), Some(came)) = (last(quantity::KINETIC), came) {
        let found = format!("{kinetic:.0} of {came:.0} J/m");
        table.add("kinetic energy at the end, of what the jet brought", found, "less", Some(kinetic < came));
        let closure = last(quantity::CLOSURE).unwrap_or(f64::NAN) / came;
        table.add(
            "energy closure at the end over what the jet brought",
            format!("{closure:.1e}"),
            "none",
            None,
        );
    }
    let largest = ledger.closure.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    table.add(
        "energy closure, the largest, over the potential energy",
        format!("{largest:.1e}"),
        "none",
        None,
    );
}

/// The floor of the hole at each dump (Fig. 13).
pub fn floors(watch: &Watch) -> String {
    let chart = Chart::new("Jet: the surface of the soil", "x [m]", "y [m]").y_range(0.0, TANK[1] + 0.05);
    let with = |chart: Chart, look: &Look| {
        chart.with(Series::line(&format!("{:.0} ms", 1e3 * look.time), look.hole.floor.clone()))
    };
    watch.looks.iter().fold(chart, with).svg()
}
