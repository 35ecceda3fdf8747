//! Pressure, energy and losses of a law.

use super::law_states::{admissible, bears_suction, gradient, pressed, stiffness, trials};
use crate::driver::{Driver, Leg};
use crate::material::{Loss, Material};
use crate::real::Real;
use crate::space::SymTensor;
use crate::verify::flawed::MistakenLaw;
use crate::verify::{Measured, Random, integrate};

/// Compressions looked at \[-\]; negative ones only of what bears suction.
fn compressions<T: Real, M: Material<T>>(law: &M) -> Vec<f64> {
    let all = [-0.02, -1e-3, 1e-3, 1e-2, 0.05].into_iter();
    all.filter(|e| *e > 0.0 || bears_suction(law)).collect()
}

fn labelled(e: f64) -> String {
    format!("e = {e}")
}

/// The compression found back from its pressure, relative.
pub(super) fn inverse<T: Real, M: Material<T>>(law: &MistakenLaw<M>) -> Measured {
    let memory = M::Memory::default();
    Measured::values(compressions(&law.law).into_iter().map(|e| {
        let back = law.compression(law.pressure(T::of(e), &memory));
        (labelled(e), back.as_f64() / T::of(e).as_f64() - 1.0)
    }))
}

/// The energy stored from no compression on, over `∫ p/(ρ̃₀ (1 + e)²) de`, less one.
pub(super) fn pressure_work<T: Real, M: Material<T>>(law: &MistakenLaw<M>) -> Measured {
    let memory = M::Memory::default();
    let density = law.reference_density().as_f64();
    let force =
        |e: f64| law.pressure(T::of(e), &memory).as_f64() / (density * (1.0 + T::of(e).as_f64()).powi(2));
    Measured::values(compressions(&law.law).into_iter().map(|e| {
        let end = T::of(e).as_f64();
        let work = integrate(0.0, end, T::EPSILON.as_f64() * force(e).abs(), &force);
        let stored = law.stored_energy(T::of(e), &memory) - law.stored_energy(T::ZERO, &memory);
        (labelled(e), stored / work - 1.0)
    }))
}

/// The hydrostatic slope over `ρ̃₀/(dp/de)`, less one; and its bend less `1 − p″/p′`.
pub(super) fn standing<T: Real, M: Material<T>>(law: &MistakenLaw<M>) -> Measured {
    let pressure = |e: f64| law.pressure(T::of(e), &M::Memory::default()).as_f64();
    let step = if T::EPSILON.as_f64() < 1e-10 { 1e-3 } else { 1e-2 };
    let first = (pressure(step) - pressure(-step)) / (2.0 * step);
    let second = (pressure(step) - 2.0 * pressure(0.0) + pressure(-step)) / (step * step);
    let (slope, bend) = law.hydrostatic_slope();
    let exact = law.reference_density().as_f64() / first;
    let of_bend = bend.as_f64() - (1.0 - second / first);
    Measured::values([("slope", slope.as_f64() / exact - 1.0), ("bend", of_bend)])
}

/// Work less what is stored and lost, for small strains from an isotropic pressure, over pressure times strain.
pub(super) fn elastic_work<T: Real, M: Material<T>>(law: &MistakenLaw<M>) -> Measured {
    let mut random = Random::new(41);
    let (memory, size) = (pressed(&law.law), 2e-5);
    let density = law.reference_density().as_f64();
    let start = law.stored_energy(T::ZERO, &memory);
    Measured::values((0..12).map(|n| {
        let mut strain = SymTensor(core::array::from_fn(|_| size * random.between(-1.0, 1.0)));
        if !M::RIGID_GRAINS {
            // The reference volume is that of the work only where the volume stays.
            strain = strain.deviator();
        }
        let mut driver = Driver::new(law.clone(), memory);
        let rows =
            driver.follow(&Leg::strain(SymTensor(strain.0.map(T::of))), 4).expect("a law that stays finite");
        let end = &rows[3];
        let stored = density * (law.stored_energy(T::ZERO, &end.memory) - start);
        let missing = end.work.as_f64() - stored - end.lost.total().as_f64();
        (format!("strain {n}"), missing / (1e-3 * stiffness(&law.law) * size))
    }))
}

/// How negative losses are: of power over stress times strain rate, of admission over `σ²/ρ̃₀c²`.
pub(super) fn losses<T: Real, M: Material<T>>(law: &MistakenLaw<M>) -> Measured {
    let mut random = Random::new(43);
    let mut worst = [0.0_f64; 8];
    let mut book = |first: usize, loss: &Loss<T>, scale: f64| {
        let parts = [loss.viscous, loss.plastic, loss.scale_back, loss.cut_off];
        for (worst, part) in worst[first..].iter_mut().zip(parts.map(T::as_f64)) {
            let negative = if part < 0.0 { -part / scale } else { 0.0 * part };
            *worst = super::worst([*worst, negative].into_iter());
        }
    };
    let stress = |memory: &M::Memory, deviator: SymTensor<T>| {
        let stress = deviator - SymTensor::isotropic(law.pressure(T::ZERO, memory));
        stress.double_dot(&stress).as_f64().sqrt()
    };
    for memory in admissible::<T, M>(&law.law) {
        let size = 10_f64.powf(random.between(-3.0, 3.0));
        let gradient = gradient(&mut random, size);
        let (stretch, deviator) = (gradient.symmetric(), law.deviator(&gradient, &memory));
        let power = stress(&memory, deviator) * stretch.double_dot(&stretch).as_f64().sqrt();
        book(0, &law.power_lost(&stretch, &deviator, &memory), power);
    }
    for memory in trials::<T, M>(&law.law) {
        let size = stress(&memory, law.deviator(&crate::space::Tensor::zero(), &memory));
        book(4, &law.admit(memory).1, size * size / stiffness(&law.law));
    }
    let kinds = ["viscous", "plastic", "by scaling back", "by cutting off"];
    let labels = kinds.map(|kind| format!("power, {kind}")).into_iter();
    let labels = labels.chain(kinds.map(|kind| format!("admitting, {kind}")));
    Measured::values(labels.zip(worst))
}
