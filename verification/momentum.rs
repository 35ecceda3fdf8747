//! What moves the mixture as a whole: weight, walls, what comes in and leaves, and nothing else.

use crate::budgets::{CASES, Ledger, TANK, ledger};
use alluvium::Real;
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};

const FORGOTTEN: &str = "what walls and openings give left out of the books";
/// Parts of the momentum's scale that rounding explains.
const DOUBLE: f64 = 1e-12;
const SINGLE: f64 = 1e-4;

pub fn studies() -> Vec<Study> {
    let mut studies = Vec::new();
    for (name, text) in CASES {
        let of = |preset, integrator| {
            momentum::<f64, 2>(&format!("{name}/{preset}"), text, (preset, integrator), DOUBLE)
        };
        studies.push(of("default", "leap-frog-ab3"));
        studies.push(of("paper", "leap-frog").level(Level::Full));
        let single = format!("{name}/default/f32");
        studies
            .push(momentum::<f32, 2>(&single, text, ("default", "leap-frog-ab3"), SINGLE).level(Level::Full));
    }
    let choices = ("default", "leap-frog-ab3");
    studies.push(momentum::<f64, 3>("tank/3d/f64", TANK, choices, DOUBLE).level(Level::Full));
    studies.push(momentum::<f32, 3>("tank/3d/f32", TANK, choices, SINGLE).level(Level::Full));
    studies
}

fn momentum<T: Real, const D: usize>(
    name: &str,
    text: &'static str,
    (preset, integrator): (&'static str, &'static str),
    largest: f64,
) -> Study {
    Study::new(
        format!("momentum/{name}"),
        "soil and water together gain the momentum that weight, walls and openings give them (value: what these do not \
         explain at the worst instant, over the weight's momentum up to the end)",
        move |conditions| measured(&ledger::<T, D>(text, preset, integrator), conditions),
    )
    .equations(&["55", "58"])
    .source("conservation of momentum")
    .expect(Expected::Bound { largest })
    .mutant(FORGOTTEN)
}

fn measured<const D: usize>(ledger: &Ledger<D>, conditions: &Conditions) -> Measured {
    let (start, end) = (&ledger.budgets[0], &ledger.budgets[ledger.budgets.len() - 1]);
    let weight = |mass: f64, time: f64| 9.81 * mass * time;
    let scale = weight(end.mass, end.time);
    let unexplained = |k: usize| {
        let worst = ledger.budgets.iter().map(|it| {
            // The vertical is the second axis: without walls all would fall.
            let given = if k == 1 { -weight(start.mass, it.time) } else { 0.0 };
            let forgotten = if conditions.is(FORGOTTEN) { it.impulse[k] - given } else { 0.0 };
            (it.momentum_closure(start)[k] + forgotten).abs() / scale
        });
        (["along x", "along y", "along z"][k], worst.fold(0.0, f64::max))
    };
    Measured::values((0..D).map(unexplained))
}
