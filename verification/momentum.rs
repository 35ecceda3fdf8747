//! What moves the mixture as a whole: weight, walls, what comes in and leaves, and nothing else.

use crate::bands::worst;
use crate::budgets::{CASES, Ledger, TANK, ledger};
use alluvium::Real;
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};

const FORGOTTEN: &str = "a thousandth of what walls and openings give left out of the books";
/// Parts of the weight's momentum that rounding explains.
const DOUBLE: f64 = 1e-12;
const SINGLE: f64 = 5e-6;
const DEFAULT: Choices = Choices { preset: "default", integrator: "leap-frog-ab3", drag: "automatic" };

/// What a case leaves open.
#[derive(Clone, Copy)]
struct Choices {
    preset: &'static str,
    integrator: &'static str,
    /// How drag goes through a step.
    drag: &'static str,
}

pub fn studies() -> Vec<Study> {
    let verlet = Choices { integrator: "velocity-verlet", ..DEFAULT };
    let paper = Choices { preset: "paper", integrator: "leap-frog", ..DEFAULT };
    let mut studies = Vec::new();
    for (name, text) in CASES {
        // A second of the U-tube takes too long.
        let level = if name == "U-tube" { Level::Full } else { Level::Quick };
        studies.push(momentum::<f64, 2>(&format!("{name}/default"), text, DEFAULT, DOUBLE).level(level));
        let of = |what: &str, choices| {
            momentum::<f64, 2>(&format!("{name}/{what}"), text, choices, DOUBLE).level(Level::Full)
        };
        studies.push(of("default/velocity-verlet", verlet));
        let printed = of("paper", paper);
        studies.push(if name == "U-tube" {
            printed.falls_short(
                Expected::Bound { largest: 0.95 },
                "it stops after a tenth of its time: density diffusion of the partial density moves mass across the \
                 surface of the soil",
            )
        } else {
            printed
        });
        let single = momentum::<f32, 2>(&format!("{name}/default/f32"), text, DEFAULT, SINGLE);
        studies.push(single.level(Level::Full));
    }
    #[cfg(feature = "implicit")]
    for (name, text) in &CASES[2..] {
        let solved = Choices { drag: "backward-euler", ..DEFAULT };
        let name = format!("{name}/drag solved over the step");
        studies.push(momentum::<f64, 2>(&name, text, solved, DOUBLE).level(Level::Full));
    }
    studies.push(momentum::<f64, 3>("tank/3d/f64", TANK, DEFAULT, DOUBLE).level(Level::Full));
    studies.push(momentum::<f32, 3>("tank/3d/f32", TANK, DEFAULT, SINGLE).level(Level::Full));
    studies
}

fn momentum<T: Real, const D: usize>(
    name: &str,
    text: &'static str,
    Choices { preset, integrator, drag }: Choices,
    largest: f64,
) -> Study {
    Study::new(
        format!("momentum/{name}"),
        "soil and water together gain the momentum that weight, walls and openings give them (values: what these do not \
         explain at the worst instant, over the weight's momentum up to the end; of the time, what did not run)",
        move |conditions| {
            let text = text.replace("[mixture]", &format!("[mixture]\ndrag_scheme = \"{drag}\""));
            measured(&ledger::<T, D>(&text, preset, integrator), conditions)
        },
    )
    .equations(&["55", "58"])
    .source("conservation of momentum")
    .expect(Expected::Bound { largest })
    .mutant(FORGOTTEN)
}

fn measured<const D: usize>(ledger: &Ledger<D>, conditions: &Conditions) -> Measured {
    let (start, end) = (&ledger.budgets[0], &ledger.budgets[ledger.budgets.len() - 1]);
    let weight = |time: f64| 9.81 * start.mass * time;
    let part = if conditions.is(FORGOTTEN) { 1e-3 } else { 0.0 };
    let unexplained = |k: usize| {
        let off = ledger.budgets.iter().map(|it| {
            // Without walls and openings all would fall, along the second axis.
            let fallen = if k == 1 { -weight(it.time) } else { 0.0 };
            (it.momentum_closure(start)[k] + part * (it.impulse[k] - fallen)).abs() / weight(end.time)
        });
        (["along x", "along y", "along z"][k], worst(off))
    };
    let measured = Measured::values((0..D).map(unexplained).chain([("time not run", 1.0 - ledger.ran)]));
    match &ledger.stopped {
        Some(stopped) => measured.note(format!("stopped: {stopped}")),
        None => measured,
    }
}
