//! What one evaluation must satisfy exactly, wherever the particles are: the power identity of the
//! semi-discrete equations, and rest across a jump of the volume fraction.

use crate::balance::{self, random};
use crate::rungs::every_rung;
use crate::water::{WaterMixture, periodic, water};
use alluvium::budget::Account;
use alluvium::kernel::WendlandC2;
use alluvium::mixture::{
    ArtificialViscosity, DensityDiffusion, GradientWeight, Mixture, Phase, Slip, Wall, WallKind,
};
use alluvium::time::Evolve;
use alluvium::verify::{Arrangement, Conditions, Expected, Measured, Study};
use alluvium::{Real, Vector};

const SOURCE: &str = "chain rule: the sums (52), (58), (62) are conjugate pair by pair";
const PRINTED: &str = "velocity gradient with m_j/ρ_j";
const PARTIAL: &str = "diffusion of the partial density";
const DROPPED: [(&str, Account); 6] = [
    ("artificial viscosity not booked", Account::ArtificialViscosity),
    ("density diffusion not booked", Account::DensityDiffusion),
    ("viscosity not booked", Account::Viscosity),
    ("wall work not booked", Account::WallWork),
    ("external work not booked", Account::External),
    (NO_WALL, Account::WallExtrapolation),
];
const NO_COMPRESSION: &str = "compression not booked";
const NO_WALL: &str = "compression of the extrapolated wall not booked";

pub fn studies() -> Vec<Study> {
    let mut studies = Vec::new();
    studies.extend(every_rung!(identity, "powers/dynamic walls", (WallKind::Dynamic, false); 1e-13, 1e-5));
    studies.extend(every_rung!(identity, "powers/corrected", (WallKind::Dynamic, true); 1e-13, 1e-5));
    for (name, slip) in [("no slip", Slip::NoSlip), ("free slip", Slip::FreeSlip)] {
        let kind = WallKind::Extrapolated { slip, suction: true };
        let (plain, corrected) = (format!("powers/{name} walls"), format!("powers/corrected/{name} walls"));
        studies.extend(every_rung!(identity, plain, (kind, false); 1e-13, 1e-5));
        studies.extend(every_rung!(identity, corrected, (kind, true); 1e-13, 1e-5));
    }
    studies.extend(every_rung!(jump, "jump"; 1e-13, 1e-5));
    studies
}

/// With walls of a kind, with gradients corrected or not.
fn identity<T: Real, const D: usize>(name: &str, (kind, corrected): (WallKind, bool), largest: f64) -> Study {
    let study = Study::new(
        name,
        "in every evaluation, on particles anywhere, the powers of all terms add up to the change of energy",
        move |conditions| {
            let residuals = (1..=3)
                .map(|seed| (format!("cloud {seed}"), residual::<T, D>((kind, corrected), seed, conditions)));
            Measured::values(residuals)
        },
    )
    .equations(&["14", "52", "54", "58", "59", "62"])
    .source(SOURCE)
    .expect(Expected::Bound { largest })
    .mutant(PRINTED)
    .mutant(NO_COMPRESSION);
    let extrapolates = kind != WallKind::Dynamic;
    let dropped = DROPPED.into_iter().filter(|(name, _)| extrapolates || *name != NO_WALL);
    dropped.fold(study, |study, (name, _)| study.mutant(name))
}

/// A jittered cloud with random pressure and velocity; a quarter of it is a moving wall.
fn cloud<T: Real, const D: usize>(kind: WallKind, seed: u64) -> WaterMixture<T, D> {
    let arrangement = Arrangement::<D>::jittered(if D == 2 { 24 } else { 12 }, 0.25, seed);
    let spacing = arrangement.spacing;
    let (walls, free): (Vec<_>, Vec<_>) =
        arrangement.positions::<T>().into_iter().partition(|x| x[D - 1] < T::of(0.25));
    // A few per cent of compression, a fifth of the speed of sound: every term has its weight.
    let pressure = move |x: &Vector<T, D>| T::of(6e3 * random(x, seed));
    let volume = T::of(arrangement.volume);
    let mut phase = Phase::new(water::<T>(10.0, 0.05));
    let wall = Wall::new(kind).moving(|x, _| {
        let mut v = Vector::zero();
        v[0] = T::of(0.5) + x[1];
        v
    });
    phase.add_wall(wall, &walls, volume, pressure).expect("a wall");
    phase.add(&free, volume, pressure).expect("particles");
    phase.set_velocity(|x| Vector::of(core::array::from_fn(|k| 2.0 * random(x, 7 + k as u64))));
    let mut gravity = Vector::zero();
    gravity[D - 1] = T::of(-9.81);
    let kernel = WendlandC2::new(T::of(1.5 * spacing)).expect("a length");
    Mixture::of_water(kernel, phase)
        .with_gravity(gravity)
        .with_force(|x, _| Vector::splat(x[0] * T::of(3.0)))
        .with_periodic(periodic([1.0; D]))
        .with_artificial_viscosity(ArtificialViscosity { linear: T::of(0.01), quadratic: T::of(0.05) })
        .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::Hydrostatic(T::of(0.1))))
        .and_then(|mixture| mixture.with_strain_control(T::ONE))
        .expect("numerics")
}

/// |Σ of all powers| / Σ |terms|.
fn residual<T: Real, const D: usize>(
    (kind, corrected): (WallKind, bool),
    seed: u64,
    conditions: &Conditions,
) -> f64 {
    let mut mixture = cloud::<T, D>(kind, seed);
    if corrected {
        mixture = mixture.with_gradient_correction();
    }
    if conditions.is(PRINTED) {
        mixture = mixture.with_gradient_weight(GradientWeight::Printed);
    }
    mixture.evaluate().expect("rates");
    let stored = energy_rates(&mixture, conditions);
    balance::residual(stored, &mixture.exchange_rate().taken, &DROPPED, conditions)
}

/// Rates of kinetic, potential and compressive energy, particle by particle.
fn energy_rates<T: Real, const D: usize>(mixture: &WaterMixture<T, D>, conditions: &Conditions) -> Vec<f64> {
    let water = mixture.water();
    let gravity = mixture.gravity().as_f64();
    let mut terms = Vec::new();
    for i in 0..water.len() {
        let mass = water.masses()[i].as_f64();
        let is_wall = i < water.wall_particles();
        if !is_wall {
            let (v, a) = (water.velocities()[i].as_f64(), water.accelerations()[i].as_f64());
            terms.push(mass * (0..D).map(|k| v[k] * a[k]).sum::<f64>());
            terms.push(-mass * (0..D).map(|k| v[k] * gravity[k]).sum::<f64>());
        }
        let evolves = !is_wall || water.walls()[0].kind() == WallKind::Dynamic;
        if evolves && !conditions.is(NO_COMPRESSION) {
            let density = water.density(i).as_f64();
            let stores = water.pressures()[i].as_f64() * water.volume_fraction(i).as_f64();
            terms.push(mass * stores / (density * density) * water.density_rate(i).as_f64());
        }
    }
    terms
}

fn jump<T: Real, const D: usize>(name: &str, largest: f64) -> Study {
    Study::new(
        name,
        "still water of one true density is at rest in density across a jump of the volume fraction",
        move |conditions| {
            let kinds = [
                DensityDiffusion::TrueDensity,
                DensityDiffusion::Hydrostatic,
                DensityDiffusion::Renormalised,
            ];
            Measured::values(kinds.map(|kind| {
                let diffusion = match conditions.is(PARTIAL) {
                    true => DensityDiffusion::PartialDensity(T::of(0.1)),
                    false => kind(T::of(0.1)),
                };
                (format!("{diffusion:?}"), jump_rate::<T, D>(diffusion))
            }))
        },
    )
    .equations(&["52", "54"])
    .source("the diffusing quantity is uniform, so every pair of (54) is zero")
    .expect(Expected::Bound { largest })
    .mutant(PARTIAL)
}

/// The largest |dρ/dt| in units of ρ̃₀ c/h.
fn jump_rate<T: Real, const D: usize>(diffusion: DensityDiffusion<T>) -> f64 {
    let arrangement = Arrangement::<D>::jittered(16, 0.2, 5);
    let (c, h) = (10.0, 1.3 * arrangement.spacing);
    let mut phase = Phase::new(water::<T>(c, 0.0));
    phase.add(&arrangement.positions(), T::of(arrangement.volume), |_| T::of(1e3)).expect("particles");
    phase.set_volume_fraction(|x| T::of(if x[0] < T::of(0.5) { 1.0 } else { 0.5 }));
    let mut mixture = Mixture::of_water(WendlandC2::new(T::of(h)).expect("a length"), phase)
        .with_periodic(periodic([1.0; D]))
        .with_density_diffusion(diffusion)
        .expect("numerics");
    mixture.evaluate().expect("rates");
    let water = mixture.water();
    let worst = (0..water.len()).map(|i| water.density_rate(i).as_f64().abs()).fold(0.0, f64::max);
    worst * h / (1000.0 * c)
}
