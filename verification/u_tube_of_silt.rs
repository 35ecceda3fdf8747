//! The U-tube with soil that lets next to nothing through, drag solved over the step of sound.

use crate::bands::{Band, WITHIN, measured, range, worst};
use crate::u_tube::{PERMEABLE, follow, level, text};
use alluvium::budget::{Account, Budget};
use alluvium::verify::u_tube::{Levels, exact_difference, initial_difference};
use alluvium::verify::{Conditions, Level, Measured, Study};

/// The end and how often it is looked at \[s\].
const END: f64 = 1.0;
const INTERVAL: f64 = 0.1;

pub fn studies() -> Vec<Study> {
    vec![of("u-tube/silt/k = 1e-4", 1e-4), of("u-tube/silt/k = 1e-6", 1e-6)]
}

fn of(name: &str, conductivity: f64) -> Study {
    let claim = "through silt in a U-tube water seeps as Darcy's law and the exact course have it, unequal levels all but \
                 stay, equal ones do, and the ledger closes (values: half widths from the middle of each band)";
    Study::new(name, claim, move |conditions| compared(conductivity, conditions))
        .equations(&["37", "52", "55", "58", "67", "69", "80"])
        .source("(L_o + L/n) z'' + gL/k z' + 2gz = 0, of which Eq. (80) is the slow root; Darcy's law")
        .level(Level::Full)
        .expect(WITHIN)
        .mutant(PERMEABLE)
}

/// A case of this conductivity, drag solved over the step. The usual density diffusion spreads pore pressure by
/// δhc = 0.7 m²/s, silt of 1e-6 m/s by 8e-4 m²/s: it would bend the course of the pressure at both ends of the soil.
/// The renormalised one leaves what is linear alone.
fn solved(conductivity: f64) -> String {
    let case = text(conductivity).replace("[mixture]", "[mixture]\ndrag_scheme = \"backward-euler\"");
    case + "\n[water.density_diffusion]\nkind = \"renormalised\"\n"
}

fn compared(conductivity: f64, conditions: &Conditions) -> Measured {
    let simulated = if conditions.is(PERMEABLE) { 1.1 * conductivity } else { conductivity };
    let runs = [solved(simulated), level(&solved(simulated), 0.0)].map(|text| follow(&text, INTERVAL, END));
    let [seeping, equal] = runs.each_ref().map(|run| run.iter().map(|(it, _)| *it).collect::<Vec<_>>());
    let (start, end) = (&seeping[0], &seeping[seeping.len() - 1]);
    let [least, most] = range(seeping[1..].iter().map(|it| it.darcy_ratio(conductivity)));
    let fallen = initial_difference() - end.by_mass(start);
    let by_surface = worst(seeping.iter().map(|it| (it.surface / start.surface - 1.0).abs()));
    let apart = worst(equal.iter().map(|it| it.surface.abs()));
    let gradient = worst(equal.iter().map(|it| it.flow.abs() / conductivity));
    let unexplained = runs.each_ref().map(|run| unexplained(run));
    let exact = initial_difference() - exact_difference(END, conductivity);
    measured(vec![
        Band::new("least q L/(k Δh)", Some(least), (0.95, 1.05)),
        Band::new("largest q L/(k Δh)", Some(most), (0.95, 1.05)),
        Band::new("fallen by mass, of the exact course", Some(fallen / exact), (0.95, 1.05)),
        Band::new("by free surface, of its start", Some(by_surface), (-0.01, 0.01)),
        Band::new("equal levels apart [m]", Some(apart), (-1e-4, 1e-4)),
        Band::new("q/k between equal levels", Some(gradient), (-0.01, 0.01)),
        Band::new("closure over the potential energy", Some(unexplained[0]), (-1e-6, 1e-6)),
        Band::new("the same, equal levels", Some(unexplained[1]), (-1e-6, 1e-6)),
    ])
    .note(format!("fallen by {fallen:.4e} m; {}", energies(&runs[0], &seeping)))
}

/// Energy no account explains, at worst, over the potential energy at the start.
fn unexplained(run: &[(Levels, Budget<2>)]) -> f64 {
    let start = &run[0].1;
    worst(run.iter().map(|(_, it)| it.closure(start).abs())) / start.potential
}

/// What drag took beside the weight of the water that seeped through over the difference of heads.
fn energies(run: &[(Levels, Budget<2>)], levels: &[Levels]) -> String {
    let taken = |n: usize| run[n].1.taken[Account::Drag];
    let weight: f64 = levels
        .windows(2)
        .map(|pair| 9810.0 * 0.5 * (pair[0].head + pair[1].head) * (pair[1].beyond - pair[0].beyond))
        .sum();
    format!("drag took {:.4e} J, the seepage's head is {weight:.4e} J", taken(run.len() - 1) - taken(0))
}
