//! What every law of drag must obey.

use super::drag_pairs::{NO_REACTION, UNBOOKED, energy, momentum};
use super::{by_precision, worst};
use crate::material::DragLaw;
use crate::real::Real;
use crate::verify::{Conditions, Expected, Measured, Study};

pub(super) const NEGATIVE: &str = "coefficient of the other sign";
const FALLING: &str = "coefficient over the square of the slip";
const DRY: &str = "coefficient over the cube of the fraction";
const TANGENT: &str = "slip left out of the tangent";

const FRACTIONS: [f64; 8] = [0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0];
const DENSITIES: [f64; 3] = [700.0, 1000.0, 1300.0];
const SLIPS: [f64; 7] = [0.0, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0];

/// Studies of a law of drag: `sign`, `rising`, `dry`, `tangent`; on pairs of particles of soil and water `momentum`
/// and `energy`; and, where it says that it does not know the slip, `slip`. They look at fractions φ_f from 5 to
/// 100 %, densities about that of water, slips up to 10 m/s. `momentum` is a check of the sums that carry the law: a
/// law has but one coefficient for both particles of a pair.
pub fn drag<T: Real, L: DragLaw<T> + Clone + 'static>(name: &str, law: L) -> Vec<Study> {
    let study = |what: &str, claim: &str, measure: fn(&L, &Conditions) -> Measured| {
        let law = law.clone();
        Study::new(format!("{name}/{what}"), claim, move |conditions| measure(&law, conditions))
    };
    let middle = coefficient::<T, L>(&law, &Conditions::default(), 0.5, 1000.0, 0.1);
    let drags = middle != 0.0;
    let with = |study: Study, mutant, differs: bool| if differs { study.mutant(mutant) } else { study };
    let sign = study("sign", "the coefficient is finite and not negative", sign::<T, L>)
        .source("drag takes energy, and gives none");
    let rising = study("rising", "drag does not fall where the slip grows", rising::<T, L>)
        .source("steps and implicit solutions are bounded by it");
    let dry = study(
        "dry",
        "where the water vanishes the coefficient is not above what it is at 5 %, as a part of that",
        dry::<T, L>,
    )
    .source("sums over a few particles must not make drag without bounds")
    .expect(Expected::Bound { largest: by_precision::<T, _>(1e-9, 1e-4) });
    let tangent =
        study("tangent", "the tangent is the slope of drag over the slip, relative", tangent::<T, L>)
            .source("differences of fourth order")
            .expect(Expected::Bound { largest: by_precision::<T, _>(2e-3, 1e-2) });
    let bar = Expected::Bound { largest: by_precision::<T, _>(1e-13, 1e-5) };
    let momentum = study(
        "momentum",
        "soil and water drag each other equally, pair by pair (values: what is left over of both forces)",
        momentum::<T, L>,
    )
    .equations(&["37", "55", "58"])
    .source("Newton's third law")
    .expect(bar);
    let energy = study(
        "energy",
        "drag never creates energy, and the ledger has what it takes, pair by pair (values: parts of the power)",
        energy::<T, L>,
    )
    .equations(&["37", "55", "58"])
    .source("second law of thermodynamics")
    .expect(bar);
    let energy = with(energy, NEGATIVE, drags);
    let mut studies = vec![
        with(momentum, NO_REACTION, drags),
        with(energy, UNBOOKED, drags),
        with(sign, NEGATIVE, drags),
        with(rising, FALLING, drags),
        with(dry, DRY, drags),
        with(tangent, TANGENT, law.knows_slip()),
    ];
    if !law.knows_slip() {
        studies.push(
            study("slip", "it does not know the slip, as it says", unaware::<T, L>).source("comparison"),
        );
    }
    studies
}

/// C_d under the mutant in force.
fn coefficient<T: Real, L: DragLaw<T>>(
    law: &L,
    conditions: &Conditions,
    fraction: f64,
    density: f64,
    slip: f64,
) -> f64 {
    let coefficient = law.coefficient(T::of(fraction), T::of(density), T::of(slip)).as_f64();
    if conditions.is(NEGATIVE) {
        -coefficient
    } else if conditions.is(FALLING) {
        coefficient / (slip * slip).max(1e-12)
    } else if conditions.is(DRY) {
        coefficient / fraction.powi(3)
    } else {
        coefficient
    }
}

/// All fractions with all densities.
fn states() -> impl Iterator<Item = (f64, f64)> {
    FRACTIONS.into_iter().flat_map(|fraction| DENSITIES.map(|density| (fraction, density)))
}

fn sign<T: Real, L: DragLaw<T>>(law: &L, conditions: &Conditions) -> Measured {
    let at = states().flat_map(|(fraction, density)| SLIPS.map(|slip| (fraction, density, slip)));
    let wrong = |(fraction, density, slip): &(f64, f64, f64)| {
        let c = coefficient::<T, L>(law, conditions, *fraction, *density, *slip);
        !(c >= 0.0 && c.is_finite())
    };
    Measured::value(at.filter(wrong).count() as f64)
}

fn rising<T: Real, L: DragLaw<T>>(law: &L, conditions: &Conditions) -> Measured {
    let falls = |(fraction, density): (f64, f64)| {
        let force = |slip: f64| slip * coefficient::<T, L>(law, conditions, fraction, density, slip);
        let rises = |slips: &&[f64]| force(slips[1]) >= force(slips[0]);
        SLIPS.len() - 1 - SLIPS.windows(2).filter(rises).count()
    };
    Measured::value(states().map(falls).sum::<usize>() as f64)
}

/// By how much the coefficient exceeds that at the least fraction, where there is less water yet.
fn dry<T: Real, L: DragLaw<T>>(law: &L, conditions: &Conditions) -> Measured {
    Measured::values([0.0, 0.1, 10.0].map(|slip| {
        let at = |fraction: f64| coefficient::<T, L>(law, conditions, fraction, 1000.0, slip);
        let limit = at(FRACTIONS[0]);
        let excess = [0.03, 1e-2, 1e-4, 1e-8, 1e-16].map(at).into_iter().map(|c| c - limit);
        let most = worst(excess);
        (format!("slip {slip} m/s"), if most == 0.0 { 0.0 } else { most / limit })
    }))
}

fn tangent<T: Real, L: DragLaw<T>>(law: &L, conditions: &Conditions) -> Measured {
    Measured::values(SLIPS[1..].iter().map(|&slip| {
        let error = |(fraction, density): (f64, f64)| {
            let c = |slip: f64| law.coefficient(T::of(fraction), T::of(density), T::of(slip)).as_f64();
            let force = |slip: f64| T::of(slip).as_f64() * c(slip);
            let central = |part: f64| {
                let (above, below) =
                    (T::of(slip * (1.0 + part)).as_f64(), T::of(slip * (1.0 - part)).as_f64());
                (force(above) - force(below)) / (above - below)
            };
            let exact = (4.0 * central(0.02) - central(0.04)) / 3.0;
            let given = match conditions.is(TANGENT) {
                true => c(slip),
                false => law.tangent(T::of(fraction), T::of(density), T::of(slip)).as_f64(),
            };
            if given == exact { 0.0 } else { given / exact - 1.0 }
        };
        let most = worst(states().map(|state| error(state).abs()));
        (format!("slip {slip} m/s"), most)
    }))
}

/// How often the coefficient depends on the slip.
fn unaware<T: Real, L: DragLaw<T>>(law: &L, conditions: &Conditions) -> Measured {
    let depends = |(fraction, density): &(f64, f64)| {
        let c = |slip: f64| coefficient::<T, L>(law, conditions, *fraction, *density, slip);
        SLIPS.iter().any(|&slip| c(slip) != c(0.0))
    };
    Measured::value(states().filter(depends).count() as f64)
}
