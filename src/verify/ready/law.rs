//! What every law must obey: objectivity, admissibility, energy.

use super::law_energy::{elastic_work, inverse, losses, pressure_work, standing};
use super::law_states::{
    ANGLES, PLANES, bears_suction, loses, moves, prepared, remembers_stress, strains, trials,
};
use super::{by_precision, worst};
use crate::driver::{Driver, Leg};
use crate::material::{Material, Memory};
use crate::real::Real;
use crate::space::{SymTensor, Tensor};
use crate::verify::flawed::{Mistake, MistakenLaw};
use crate::verify::{Conditions, Expected, Measured, Study};

const SPIN: &str = "spin of the wrong sign";
const COMPRESSION: &str = "compression off by 0.1 %";
const ENERGY: &str = "stored energy off by 0.1 %";
const HALFWAY: &str = "admitted half of the way";
const LOSS: &str = "losses of the other sign";
const VISCOUS: &str = "stress that depends on the rate";
const SLOPE: &str = "hydrostatic slope off by 5 %";
const MISTAKES: [(&str, Mistake); 7] = [
    (SLOPE, Mistake::Slope),
    (SPIN, Mistake::Spin),
    (COMPRESSION, Mistake::Compression),
    (ENERGY, Mistake::Energy),
    (HALFWAY, Mistake::Halfway),
    (LOSS, Mistake::Loss),
    (VISCOUS, Mistake::Viscous),
];

/// Studies of a law: `objectivity`, `admitted`, `losses`; of matter that can be compressed `inverse`,
/// `pressure work` and `hydrostatic`; of a law that remembers stress `elastic work`; of one with a memory and
/// no viscosity `rate`.
///
/// Its states are those that random strains of up to 1 % lead to, from no memory and, if it remembers
/// stress, from up to a thousandth of ρ̃₀c² of it.
pub fn law<T: Real, M: Material<T>>(name: &str, law: M) -> Vec<Study> {
    let mut studies = every_law::<T, M>(name, &law);
    if !M::RIGID_GRAINS {
        studies.extend(compressible::<T, M>(name, &law));
    }
    if remembers_stress::<T, M>(&law) {
        let claim = "the work of small strain is stored or lost, as a part of it";
        let work = study::<T, M>(name, &law, "elastic work", claim, elastic_work::<T, M>, [1e-9, 2e-4]);
        studies.push(work.source("conservation of energy").mutant(ENERGY));
    }
    if core::mem::size_of::<M::Memory>() > 0 && law.kinematic_viscosity() == T::ZERO {
        let claim = "a path gives the same stress however fast it is gone";
        let rate = study::<T, M>(name, &law, "rate", claim, rate::<T, M>, [1e-10, 1e-4])
            .source("a law without viscosity knows no time");
        studies.push(naming(rate, VISCOUS, remembers_stress::<T, M>(&law)));
    }
    studies
}

/// A study that bounds what `measure` finds on the law, in `f64` and `f32`.
fn study<T: Real, M: Material<T>>(
    name: &str,
    law: &M,
    what: &str,
    claim: &str,
    measure: fn(&MistakenLaw<M>) -> Measured,
    bars: [f64; 2],
) -> Study {
    let law = law.clone();
    let run = move |conditions: &Conditions| {
        let mistake = MISTAKES.iter().find(|(name, _)| conditions.is(name)).map(|found| found.1);
        measure(&MistakenLaw { law: law.clone(), mistake })
    };
    let largest = by_precision::<T, _>(bars[0], bars[1]);
    Study::new(format!("{name}/{what}"), claim, run).expect(Expected::Bound { largest })
}

/// Names a mutant where it makes a difference.
fn naming(study: Study, mutant: &'static str, differs: bool) -> Study {
    if differs { study.mutant(mutant) } else { study }
}

/// What every law must be.
fn every_law<T: Real, M: Material<T>>(name: &str, law: &M) -> Vec<Study> {
    let claim = "stress turns with matter that is turned, and so does its answer to strain";
    let objectivity = study::<T, M>(name, law, "objectivity", claim, objectivity::<T, M>, [1e-11, 2e-5])
        .equations(&["33", "34", "35"])
        .source("exact: R σ Rᵀ");
    let claim = "what is admitted once is not changed again";
    let admitted = study::<T, M>(name, law, "admitted", claim, admitted::<T, M>, [1e-10, 1e-4])
        .source("nearest to itself is what is admissible");
    let claim = "no loss is negative, as a part of the work";
    let losses = study::<T, M>(name, law, "losses", claim, losses::<T, M>, [1e-11, 1e-4])
        .source("second law of thermodynamics");
    vec![
        naming(objectivity, SPIN, remembers_stress::<T, M>(law)),
        naming(admitted, HALFWAY, moves::<T, M>(law)),
        naming(losses, LOSS, loses::<T, M>(law)),
    ]
}

/// What a law of matter that can be compressed must be.
fn compressible<T: Real, M: Material<T>>(name: &str, law: &M) -> Vec<Study> {
    let claim = "the compression is the inverse of the pressure";
    let inverse = study::<T, M>(name, law, "inverse", claim, inverse::<T, M>, [1e-11, 5e-4]);
    let claim = "the stored energy E is the work of pressure: dE/de = p/(ρ̃₀ (1 + e)²)";
    let work = study::<T, M>(name, law, "pressure work", claim, pressure_work::<T, M>, [1e-9, 2e-4]);
    let mut studies =
        vec![inverse.mutant(COMPRESSION), work.source("Gauss-Legendre quadrature").mutant(ENERGY)];
    if bears_suction::<T, M>(law) {
        let claim = "the hydrostatic slope and its bend are those of dp = ρ̃ d(g·x)";
        let standing = study::<T, M>(name, law, "hydrostatic", claim, standing::<T, M>, [1e-3, 2e-2]);
        studies.push(standing.source("differences of the pressure").mutant(SLOPE));
    }
    studies
}

/// Turned and then strained, against strained without turning; in units of the largest stress.
fn objectivity<T: Real, M: Material<T>>(law: &MistakenLaw<M>) -> Measured {
    let increments = by_precision::<T, _>(3000, 60);
    let strain = SymTensor([-4e-4, -1e-4, -2.5e-4, 1.5e-4, -0.5e-4, 1e-4]);
    let follow = |driver: &mut Driver<T, _>, leg: Leg<T>, increments| {
        driver.follow(&leg, increments).expect("a law that stays finite");
        driver.row().stress.0.map(T::as_f64)
    };
    let mut values = Vec::new();
    for (plane, axis) in PLANES {
        for degrees in ANGLES {
            let angle = f64::to_radians(degrees);
            let errors = prepared::<T, M>(&law.law).into_iter().map(|memory| {
                let mut still = Driver::new(law.clone(), memory);
                let mut turned = still.clone();
                let end = follow(&mut still, Leg::strain(SymTensor(strain.0.map(T::of))), 10);
                let spun = Leg::strain(SymTensor::zero()).turning(axis.spin(angle).map(T::of));
                follow(&mut turned, spun, increments);
                let there = SymTensor(axis.turned(&strain.0, angle).map(T::of));
                let found = follow(&mut turned, Leg::strain(there), 10);
                apart(&found, &axis.turned(&end, angle), largest(&end))
            });
            values.push((format!("{degrees}° in {plane}"), worst(errors)));
        }
    }
    Measured::values(values)
}

/// By how much the second admission changes stress and what is shown of the memory, as a part of them.
fn admitted<T: Real, M: Material<T>>(law: &MistakenLaw<M>) -> Measured {
    let (mut of_stress, mut of_memory) = (0.0_f64, 0.0_f64);
    for trial in trials::<T, M>(&law.law) {
        let once = law.admit(trial).0;
        let twice = law.admit(once).0;
        let stress = |memory: &M::Memory| {
            let pressure = law.pressure(T::ZERO, memory);
            (law.deviator(&Tensor::zero(), memory) - SymTensor::isotropic(pressure)).0.map(T::as_f64)
        };
        let shown = |memory: &M::Memory| {
            let mut numbers = Vec::new();
            memory.show(&mut numbers);
            numbers
        };
        // Where all stress is taken away, what is left of it is rounding of the trial.
        let scale = largest(&stress(&trial)).max(largest(&stress(&once)));
        of_stress = worst([of_stress, apart(&stress(&once), &stress(&twice), scale)].into_iter());
        let (first, second) = (shown(&once), shown(&twice));
        let mut at = 0;
        for &(_, count) in <M::Memory as Memory<T>>::SHOWN {
            let (a, b) = (&first[at..at + count], &second[at..at + count]);
            let scale = largest(&shown(&trial)[at..at + count]).max(largest(a));
            of_memory = worst([of_memory, apart(a, b, scale)].into_iter());
            at += count;
        }
    }
    Measured::values([("stress", of_stress), ("memory", of_memory)])
}

fn largest(numbers: &[f64]) -> f64 {
    worst(numbers.iter().map(|x| x.abs()))
}

/// The largest difference over `scale`; nothing if there is none.
fn apart(a: &[f64], b: &[f64], scale: f64) -> f64 {
    let difference = worst(a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    if difference == 0.0 { 0.0 } else { difference / scale }
}

/// The stress at the end of a path that is gone fast and slowly, less that after a second for each leg, as a
/// part of it.
fn rate<T: Real, M: Material<T>>(law: &MistakenLaw<M>) -> Measured {
    let mut values = Vec::new();
    let end = |duration: f64, memory: M::Memory| {
        let mut driver = Driver::new(law.clone(), memory);
        for strain in strains() {
            let leg = Leg::strain(SymTensor(strain.map(T::of))).turning([0.1, -0.05, 0.02].map(T::of));
            let leg = leg.lasting(T::of(duration)).expect("a time");
            driver.follow(&leg, 50).expect("a law that stays finite");
        }
        driver.row().stress.0.map(T::as_f64)
    };
    for (n, memory) in prepared::<T, M>(&law.law).into_iter().enumerate() {
        let second = end(1.0, memory);
        for duration in [1e-3, 1e3] {
            let error = apart(&end(duration, memory), &second, largest(&second));
            values.push((format!("state {n}, {duration} s"), error));
        }
    }
    Measured::values(values)
}
