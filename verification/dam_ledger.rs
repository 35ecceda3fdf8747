//! The dam break to half a second: whether the energy closes, and whether the walls hold.
//!
//! The water meets the far wall at t = 0.22 s, runs up it and falls back. What then is lost or made is the work of
//! flakes of spray: `docs/decisions/0016-the-papers-dam-break.md`.

use crate::dam_run::{Closing, THIN, UNBOOKED};
use alluvium::Preset::{Default, Paper};
use alluvium::verify::{Expected, Level, Measured, Study};

const DYNAMIC: Closing =
    Closing { preset: Default, spacing: 0.005, dynamic: true, courant: 0.2, reinitialise_every: 0 };
const EXTRAPOLATED: Closing = Closing { dynamic: false, ..DYNAMIC };
/// Half the step takes the flakes' vibration, which grows with Δt³, out of the ledger.
const HALF_STEP: Closing = Closing { courant: 0.1, ..EXTRAPOLATED };
/// Reinitialisation takes the suction away that holds flakes together.
const REINITIALISED: Closing = Closing { reinitialise_every: 20, ..EXTRAPOLATED };
/// Its own step, 1e-5 s at its own spacing, is a Courant number of 0.2.
const PAPER: Closing = Closing { preset: Paper, ..REINITIALISED };

/// What the paper's spacing is a half, and a quarter of \[m\].
const MIDDLE: f64 = 0.0025;
const FINE: f64 = 0.00125;

pub fn studies() -> Vec<Study> {
    let at = |closing, spacing| Closing { spacing, ..closing };
    let full = |closing, largest| closure(closing, largest).level(Level::Full);
    vec![
        closure(DYNAMIC, 1e-4),
        closure(HALF_STEP, 1e-4),
        full(EXTRAPOLATED, 1e-4),
        full(at(EXTRAPOLATED, MIDDLE), 1e-4),
        full(at(DYNAMIC, FINE), 1e-4),
        full(at(EXTRAPOLATED, FINE), 1e-4),
        closure(REINITIALISED, 2e-3),
        closure(Closing { courant: 0.1, ..PAPER }, 2e-3),
        full(at(REINITIALISED, MIDDLE), 2e-3),
        full(at(PAPER, FINE), 2e-3).falls_short(
            Expected::Bound { largest: 1.1e-2 },
            "leap-frog as printed feeds spray by (ωΔt)⁴/4 a step",
        ),
        full(at(Closing { courant: 0.1, ..PAPER }, FINE), 2e-3),
        tightness(HALF_STEP),
        tightness(at(EXTRAPOLATED, MIDDLE)).level(Level::Full),
        tightness(at(EXTRAPOLATED, FINE)).level(Level::Full),
    ]
}

/// The preset, the walls, what else is done, and how finely.
fn name(what: &str, closing: Closing) -> String {
    let preset = if closing.preset == Paper { "paper" } else { "default" };
    let walls = if closing.dynamic || closing.preset == Paper { "dynamic" } else { "extrapolated" };
    let booked = if closing.reinitialise_every > 0 { " with (70)" } else { "" };
    format!(
        "dam-break/{what}/{preset}, {walls} walls{booked}, Courant number {}/{}",
        closing.courant, closing.spacing
    )
}

fn closure(closing: Closing, largest: f64) -> Study {
    let claim = "energy closes to t = 0.5 s, all accounts booked, relative to the initial potential energy";
    Study::new(name("closure", closing), claim, move |conditions| {
        let record = closing.run(conditions);
        Measured::value(record.closure).note(format!("largest at t = {:.3} s", record.open_at))
    })
    .equations(&["52", "58", "59", "70", "71"])
    .source("conservation of energy")
    .expect(Expected::Bound { largest })
    .mutant(UNBOOKED)
}

fn tightness(closing: Closing) -> Study {
    let claim = "to t = 0.5 s no particle goes through the walls or over them, and none hangs at the wall the water has \
                 left (values: most at any time)";
    Study::new(name("walls", closing), claim, move |conditions| {
        let record = closing.run(conditions);
        Measured::values([("leaked", record.leaked as f64), ("stuck", record.stuck as f64)])
            .note(format!("the farthest behind the face of a wall: {:.3} spacings", record.deepest))
    })
    .source("a wall is a wall")
    .mutant(THIN)
}
