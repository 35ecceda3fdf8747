//! What one evaluation of soil must satisfy, wherever the particles are: the power identity of (53), (55),
//! (65), (66), and stress that turns with the material.

use crate::balance::{self, random};
use crate::soil::{GRAINS, SoilMixture, SpinningBack, artificial_stress, elastic, elasticity, on_cone};
use crate::water::periodic;
use alluvium::budget::Account;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Cone, DruckerPrager, Material, Plasticity, Soil, SoilMemory, YieldSurface};
use alluvium::mixture::{
    ArtificialViscosity, GradientWeight, HourglassControl, Mixture, Phase, Slip, Wall, WallKind,
};
use alluvium::time::{Evolve, Moment};
use alluvium::verify::{Arrangement, Conditions, Expected, Measured, Study};
use alluvium::{Real, SymTensor, Vector};

const SOURCE: &str = "chain rule: the sums (53), (55), (65) are conjugate pair by pair";
const PRINTED: &str = "velocity gradient with m_j/ρ_j";
const DROPPED: [(&str, Account); 7] = [
    ("artificial viscosity not booked", Account::ArtificialViscosity),
    ("artificial stress not booked", Account::ArtificialStress),
    ("wall work not booked", Account::WallWork),
    ("external work not booked", Account::External),
    (NO_WALL, Account::WallExtrapolation),
    (NO_FLOW, Account::Plastic),
    (NO_HOLD, Account::HourglassControl),
];
const NO_STORE: &str = "stored energy left out";
const NO_WALL: &str = "stress of the extrapolated wall not booked";
const NO_FLOW: &str = "plastic flow not booked";
const NO_HOLD: &str = "hourglass control not booked";
const BACKWARDS: &str = "spin of the opposite sign (66)";

pub fn studies() -> Vec<Study> {
    let mut studies = vec![
        identity::<f64, 2>("soil/powers/dynamic walls/2d/f64", WallKind::Dynamic, 1e-13),
        identity::<f64, 3>("soil/powers/dynamic walls/3d/f64", WallKind::Dynamic, 1e-13),
        identity::<f32, 2>("soil/powers/dynamic walls/2d/f32", WallKind::Dynamic, 1e-5),
        identity::<f32, 3>("soil/powers/dynamic walls/3d/f32", WallKind::Dynamic, 1e-5),
    ];
    let slips = [("no slip", Slip::NoSlip), ("free slip", Slip::FreeSlip), ("friction", Slip::Friction(0.2))];
    for (name, slip) in slips {
        let kind = WallKind::Extrapolated { slip, suction: true };
        studies.push(identity::<f64, 2>(&format!("soil/powers/{name} walls/2d/f64"), kind, 1e-13));
    }
    studies.push(flowing::<f64, 2>("soil/powers/flowing/2d/f64", 1e-13));
    studies.push(flowing::<f64, 3>("soil/powers/flowing/3d/f64", 1e-13));
    studies.push(flowing::<f32, 2>("soil/powers/flowing/2d/f32", 1e-5));
    studies.push(flowing::<f32, 3>("soil/powers/flowing/3d/f32", 1e-5));
    studies.push(held::<f64, 2>("soil/powers/held/2d/f64", 1e-13));
    studies.push(held::<f64, 3>("soil/powers/held/3d/f64", 1e-13));
    studies.push(held::<f32, 2>("soil/powers/held/2d/f32", 1e-5));
    studies.push(held::<f32, 3>("soil/powers/held/3d/f32", 1e-5));
    studies.extend([
        turning::<f64, 2>("soil/objectivity/2d/f64"),
        turning::<f64, 3>("soil/objectivity/3d/f64"),
        turning::<f32, 2>("soil/objectivity/2d/f32"),
        turning::<f32, 3>("soil/objectivity/3d/f32"),
    ]);
    studies
}

const CLAIM: &str = "in every evaluation of soil, on particles anywhere, the powers of all terms add up to the change of energy";
const EQUATIONS: &[&str] = &["53", "55", "59", "65", "66"];

fn identity<T: Real, const D: usize>(name: &str, kind: WallKind, largest: f64) -> Study {
    let study = Study::new(name, CLAIM, move |conditions| {
        let residual = |seed| residual(cloud::<T, D, _>(elastic(), kind, seed), conditions);
        Measured::values((1..=3).map(|seed| (format!("cloud {seed}"), residual(seed))))
    })
    .equations(EQUATIONS)
    .source(SOURCE)
    .expect(Expected::Bound { largest })
    .mutant(PRINTED)
    .mutant(NO_STORE);
    let extrapolates = kind != WallKind::Dynamic;
    let is_seen = |name| ![NO_FLOW, NO_HOLD].contains(&name) && (extrapolates || name != NO_WALL);
    let dropped = DROPPED.into_iter().filter(|(name, _)| is_seen(*name));
    dropped.fold(study, |study, (name, _)| study.mutant(name))
}

/// The same while (36) makes part of the soil flow.
fn flowing<T: Real, const D: usize>(name: &str, largest: f64) -> Study {
    Study::new(name, CLAIM, move |conditions| {
        let cone = DruckerPrager::cohesive(Cone::PlaneStrain, T::of(0.4), T::of(0.1), T::of(1e3));
        let soil = on_cone(cone.expect("a cone")).with_plasticity(Plasticity::Rate);
        let mixture = cloud::<T, D, _>(soil, WallKind::Dynamic, 4);
        Measured::value(residual(mixture, conditions))
    })
    .equations(&["26", "30", "36", "53", "55", "65", "66"])
    .source(SOURCE)
    .expect(Expected::Bound { largest })
    .mutant(NO_FLOW)
}

/// The same with corrected gradients, while what these do not see is held.
fn held<T: Real, const D: usize>(name: &str, largest: f64) -> Study {
    Study::new(name, CLAIM, move |conditions| {
        let control = HourglassControl { stiffness: T::of(4.0), viscosity: T::of(0.1) };
        let mixture = cloud::<T, D, _>(elastic(), WallKind::Dynamic, 5).with_gradient_correction();
        let mut mixture = mixture.with_hourglass_control(control).expect("a strength");
        // The elastic hold is of what has been.
        mixture.evaluate().expect("rates");
        mixture.advance(Moment::Now, Moment::Now, T::of(1e-4));
        Measured::value(residual(mixture, conditions))
    })
    .equations(EQUATIONS)
    .source(SOURCE)
    .expect(Expected::Bound { largest })
    .mutant(NO_HOLD)
    .mutant(NO_STORE)
}

/// A jittered cloud with random stress and velocity; a quarter of it is a moving wall.
fn cloud<T: Real, const D: usize, Y: YieldSurface<T>>(
    soil: Soil<T, Y>,
    kind: WallKind,
    seed: u64,
) -> SoilMixture<T, D, Soil<T, Y>> {
    let arrangement = Arrangement::<D>::jittered(if D == 2 { 24 } else { 12 }, 0.25, seed);
    let spacing = arrangement.spacing;
    let (walls, free): (Vec<_>, Vec<_>) =
        arrangement.positions::<T>().into_iter().partition(|x| x[D - 1] < T::of(0.25));
    let volume = T::of(arrangement.volume);
    let mut phase = Phase::new(soil);
    let wall = Wall::new(kind).moving(|x, _| {
        let mut v = Vector::zero();
        v[0] = T::of(0.5) + x[1];
        v
    });
    phase.add_wall(wall, &walls, volume, |_| T::ZERO).expect("a wall");
    phase.add(&free, volume, |_| T::ZERO).expect("particles");
    phase.set_volume_fraction(|x| T::of(0.6 + 0.1 * random(x, 3)));
    let soil = phase.material().clone();
    phase.set_stress(|x| {
        let raw = SymTensor(core::array::from_fn(|k| T::of(5e4 * random(x, seed ^ (11 + k as u64)))));
        soil.admit(SoilMemory::stressed(raw)).0.stress
    });
    phase.set_velocity(|x| Vector::of(core::array::from_fn(|k| 2.0 * random(x, 7 + k as u64))));
    let mut gravity = Vector::zero();
    gravity[D - 1] = T::of(-9.81);
    let kernel = WendlandC2::new(T::of(1.5 * spacing)).expect("a length");
    Mixture::of_soil(kernel, phase)
        .with_gravity(gravity)
        .with_force(|x, _| Vector::splat(x[0] * T::of(3.0)))
        .with_periodic(periodic([1.0; D]))
        .with_soil_artificial_viscosity(ArtificialViscosity { linear: T::of(0.1), quadratic: T::ONE })
        .and_then(|mixture| mixture.with_artificial_stress(artificial_stress(spacing)))
        .expect("numerics")
}

/// |Σ of all powers| / Σ |terms|.
fn residual<T: Real, const D: usize, Y: YieldSurface<T>>(
    mut mixture: SoilMixture<T, D, Soil<T, Y>>,
    conditions: &Conditions,
) -> f64 {
    if conditions.is(PRINTED) {
        mixture = mixture.with_gradient_weight(GradientWeight::Printed);
    }
    mixture.evaluate().expect("rates");
    let stored = energy_rates(&mixture, conditions);
    balance::residual(stored, &mixture.exchange_rate().taken, &DROPPED, conditions)
}

/// Rates of kinetic, potential and elastic energy, particle by particle.
fn energy_rates<T: Real, const D: usize, Y: YieldSurface<T>>(
    mixture: &SoilMixture<T, D, Soil<T, Y>>,
    conditions: &Conditions,
) -> Vec<f64> {
    let soil = mixture.soil();
    let gravity = mixture.gravity().as_f64();
    let mut terms = Vec::new();
    for i in 0..soil.len() {
        let mass = soil.masses()[i].as_f64();
        let is_wall = i < soil.wall_particles();
        if !is_wall {
            let (v, a) = (soil.velocities()[i].as_f64(), soil.accelerations()[i].as_f64());
            terms.push(mass * (0..D).map(|k| v[k] * a[k]).sum::<f64>());
            terms.push(-mass * (0..D).map(|k| v[k] * gravity[k]).sum::<f64>());
        }
        let evolves = !is_wall || soil.walls()[0].kind() == WallKind::Dynamic;
        if evolves && !conditions.is(NO_STORE) {
            // d(½ σ:C⁻¹:σ)/dt = ε:σ̇, per volume of grains.
            let strain = elasticity::<T>().strain(&soil.memory(i).stress);
            let stored = strain.double_dot(&soil.memory_rate(i).stress).as_f64();
            terms.push(mass / GRAINS * stored);
        }
    }
    terms
}

/// The stress of soil that turns as a whole turns with it, whatever its axes: here at 16 angles and about
/// an oblique axis in three dimensions.
fn turning<T: Real, const D: usize>(name: &str) -> Study {
    Study::new(
        name,
        "where soil turns as a whole its stress changes by ωσ − σω, at any angle between the two: the error \
         is that of the gradient on a lattice (values: of the size of the rate)",
        |conditions| {
            let angles = (0..24).map(|n| f64::from(n) * core::f64::consts::PI / 24.0);
            Measured::values(angles.map(|angle| {
                let error = match conditions.is(BACKWARDS) {
                    true => turning_error::<T, D, _>(SpinningBack(elastic()), angle),
                    false => turning_error::<T, D, _>(elastic(), angle),
                };
                (format!("{:.1}°", angle.to_degrees()), error)
            }))
        },
    )
    .equations(&["33", "34", "35", "66"])
    .source("exact: a rotation R takes σ to RσRᵀ; the gradient's gain on the lattice is 1 − 8e-4")
    .expect(Expected::Bound { largest: 1e-3 })
    .mutant(BACKWARDS)
}

fn turning_error<T: Real, const D: usize, S: Material<T, Memory = SoilMemory<T>>>(
    soil: S,
    angle: f64,
) -> f64 {
    const SIDE: usize = 11;
    let spacing = 1.0 / SIDE as f64;
    let arrangement = Arrangement::<D>::lattice(SIDE);
    let mut phase = Phase::new(soil);
    let places: Vec<Vector<T, D>> = arrangement.positions();
    phase.add(&places, T::of(arrangement.volume), |_| T::ZERO).expect("particles");
    // Uniaxial stress under `angle`, with a part that has no zeros in three dimensions.
    let (sin, cos) = angle.sin_cos();
    let oblique = if D == 3 { 0.4 } else { 0.0 };
    let stress =
        SymTensor([cos * cos, sin * sin, 0.3, sin * cos, oblique, -0.7 * oblique].map(|x| T::of(1e4 * x)));
    phase.set_stress(|_| stress);
    // ω_xy, ω_yz, ω_xz; v = ω x.
    let spin = [1.0, oblique, 0.5 * oblique];
    let omega = [[0.0, spin[0], spin[2]], [-spin[0], 0.0, spin[1]], [-spin[2], -spin[1], 0.0]];
    phase.set_velocity(|x| {
        let x = x.as_f64();
        Vector::of(core::array::from_fn(|a| 0.1 * (0..D).map(|b| omega[a][b] * (x[b] - 0.5)).sum::<f64>()))
    });
    let mut mixture = crate::soil::bare(2.0 * spacing, phase);
    mixture.evaluate().expect("rates");
    let soil = mixture.soil();
    let middle = (0..soil.len())
        .find(|&i| soil.positions()[i].0.iter().all(|x| (x.as_f64() - 0.5).abs() < 1e-3))
        .expect("a particle in the middle");
    let rate = soil.memory_rate(middle).stress;
    let at = |t: &SymTensor<T>, a: usize, b: usize| t.0[SymTensor::<T>::index(a, b)].as_f64();
    let (mut error, mut size) = (0.0_f64, 0.0_f64);
    for a in 0..3 {
        for b in a..3 {
            let in_space =
                |row: usize, column: usize| if row < D && column < D { omega[row][column] } else { 0.0 };
            let exact: f64 = (0..3)
                .map(|c| 0.1 * (in_space(a, c) * at(&stress, c, b) - at(&stress, a, c) * in_space(c, b)))
                .sum();
            error = error.max((at(&rate, a, b) - exact).abs());
            size = size.max(exact.abs());
        }
    }
    error / size
}
