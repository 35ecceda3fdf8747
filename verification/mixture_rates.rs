//! What one evaluation of soil and water together must satisfy, wherever the particles are: the power
//! identity, momentum, no force at uniform pressure, drag as Darcy's law has it.

use crate::balance::{self, random};
use crate::bands::worst;
use crate::rungs::every_rung;
use crate::seepage::Powered;
use crate::soil::{GRAINS, elastic, elasticity};
use crate::water::{periodic, water};
use alluvium::budget::Account;
use alluvium::kernel::{Kernel, WendlandC2, WendlandC4};
use alluvium::material::{Conductivity, Darcy, DragLaw, NoDrag, Soil, SoilMemory, Unyielding, Water};
use alluvium::mixture::{ArtificialViscosity, CouplingForm, DensityDiffusion, Mixture, Phase, Source, Wall};
use alluvium::time::Evolve;
use alluvium::verify::{Arrangement, Conditions, Expected, Measured, Study};
use alluvium::{Real, SymTensor, Vector, setup};

type Both<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>>;

const SOURCE: &str =
    "chain rule: force, density rate and fraction rate are conjugate pair by pair (docs/decisions)";
const NO_FRACTION: &str = "the volume fraction's rate (69) left out of the true density's";
const DROPPED: [(&str, Account); 5] = [
    ("sources not booked", Account::External),
    ("drag not booked", Account::Drag),
    ("relaxation not booked", Account::Relaxation),
    ("density diffusion not booked", Account::DensityDiffusion),
    ("artificial viscosity not booked", Account::ArtificialViscosity),
];
const UNLIKE: &str = "forces of the usual sums beside rates of these";
const NO_STORE: &str = "the skeleton's energy left out";
const ONE_SIDED: &str = "momentum of the water alone";
const PRINTED: &str = "pressure by (55), (58) as printed";
const DIFFERENT: &str = "pressure by differences";
const FULL_WEIGHT: &str = "γ_w with the true density";
const CUBED: &str = "φ_f cubed";

pub fn studies() -> Vec<Study> {
    let (own, printed) = (CouplingForm::PressureDifference, CouplingForm::Printed);
    let mut studies = Vec::new();
    studies.extend(every_rung!(identity, "mixture/powers", (own, Sums::Usual); 1e-13, 1e-5));
    studies.extend(every_rung!(identity, "mixture/powers/printed", (printed, Sums::Usual); 1e-13, 1e-5));
    studies.extend(every_rung!(identity, "mixture/powers/corrected", (own, Sums::Corrected); 1e-13, 1e-5));
    studies.extend(
        every_rung!(identity, "mixture/powers/printed and corrected", (printed, Sums::Corrected); 1e-13, 1e-5),
    );
    studies.extend(every_rung!(identity, "mixture/powers/interphase kernel", (own, Sums::Wide); 1e-13, 1e-5));
    studies.extend(
        every_rung!(identity, "mixture/powers/printed, interphase kernel", (printed, Sums::Wide); 1e-13, 1e-5),
    );
    for (name, sums) in
        [("", Sums::Usual), ("/corrected", Sums::Corrected), ("/interphase kernel", Sums::Wide)]
    {
        studies.extend(every_rung!(momentum, format!("mixture/momentum{name}"), sums; 1e-13, 1e-5));
        studies.extend(every_rung!(locking, format!("mixture/no locking{name}"), sums; 1e-9, 1e-2));
    }
    studies.push(locked("mixture/locking as printed/2d/f64"));
    studies.extend(every_rung!(drag, "mixture/drag rate"; 1e-12, 1e-5));
    studies
}

/// What the sums are made with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sums {
    Usual,
    /// Gradients exact for linear fields.
    Corrected,
    /// Another, wider kernel between soil and water.
    Wide,
}

impl Sums {
    fn apply<T: Real, const D: usize>(self, mixture: Both<T, D>) -> Both<T, D> {
        let wider = T::of(1.3) * mixture.kernel().smoothing_length();
        match self {
            Self::Usual => mixture,
            Self::Corrected => mixture.with_gradient_correction(),
            Self::Wide => mixture
                .with_interphase_kernel(WendlandC4::new(wider).expect("a length"))
                .expect("a length near that within"),
        }
    }
}

/// For a form of the coupling.
fn identity<T: Real, const D: usize>(name: &str, (form, sums): (CouplingForm, Sums), largest: f64) -> Study {
    let study = Study::new(
        name,
        "in every evaluation of soil and water, on particles anywhere, the powers of all terms add up to the \
         change of energy",
        move |conditions| {
            Measured::values((1..=3).map(|seed| {
                let evaluated = |sums: Sums| {
                    let mut cloud = sums.apply(with_sources(cloud::<T, D>(seed)).with_coupling(form));
                    cloud.evaluate().expect("rates");
                    cloud
                };
                let (cloud, other) = (evaluated(sums), conditions.is(UNLIKE).then(|| evaluated(Sums::Usual)));
                let forces = other.as_ref().unwrap_or(&cloud);
                (format!("cloud {seed}"), residual(&cloud, forces, conditions))
            }))
        },
    )
    .equations(&["37", "52", "53", "55", "58", "65", "69"])
    .source(SOURCE)
    .expect(Expected::Bound { largest })
    .mutant(NO_FRACTION)
    .mutant(NO_STORE);
    let study = if sums == Sums::Usual { study } else { study.mutant(UNLIKE) };
    let dropped = DROPPED
        .into_iter()
        .filter(|(_, account)| form == CouplingForm::PressureDifference || *account != Account::Relaxation);
    dropped.fold(study, |study, (name, _)| study.mutant(name))
}

/// Two jittered clouds in the same space, with random stress, pressure, velocity and fraction; the lowest
/// quarter of each is a dynamic wall.
fn cloud<T: Real, const D: usize>(seed: u64) -> Both<T, D> {
    let side = if D == 2 { 20 } else { 10 };
    let arranged = |seed| {
        let arrangement = Arrangement::<D>::jittered(side, 0.25, seed);
        let (low, high): (Vec<_>, Vec<_>) =
            arrangement.positions::<T>().into_iter().partition(|x| x[D - 1] < T::of(0.25));
        (arrangement.spacing, T::of(arrangement.volume), low, high)
    };
    let velocity =
        move |x: &Vector<T, D>, salt: u64| Vector::of(core::array::from_fn(|k| random(x, salt + k as u64)));
    let (spacing, volume, low, high) = arranged(seed);
    let mut soil = Phase::new(elastic::<T>());
    soil.add_wall(Wall::dynamic(), &low, volume, |_| T::ZERO).expect("a wall");
    soil.add(&high, volume, |_| T::ZERO).expect("particles");
    soil.set_volume_fraction(|x| T::of(0.5 + 0.1 * random(x, 3)));
    soil.set_stress(|x| SymTensor(core::array::from_fn(|k| T::of(5e3 * random(x, 11 + k as u64)))));
    soil.set_velocity(|x| velocity(x, 21));
    let (_, volume, low, high) = arranged(seed + 50);
    let pressure = move |x: &Vector<T, D>| T::of(3e3 * random(x, 5));
    let mut fluid = Phase::new(water::<T>(10.0, 0.005));
    fluid.add_wall(Wall::dynamic(), &low, volume, pressure).expect("a wall");
    fluid.add(&high, volume, pressure).expect("particles");
    fluid.set_velocity(|x| velocity(x, 31));
    let mut gravity = Vector::zero();
    gravity[D - 1] = T::of(-9.81);
    let kernel = WendlandC2::new(T::of(1.5 * spacing)).expect("a length");
    Mixture::new(kernel, soil, fluid)
        .with_gravity(gravity)
        .with_periodic(periodic([1.0; D]))
        .with_drag(Darcy::new(Conductivity::new(T::of(0.05)).expect("a conductivity")))
        .with_artificial_viscosity(ArtificialViscosity { linear: T::of(0.05), quadratic: T::ONE })
        .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::TrueDensity(T::of(0.1))))
        .and_then(|mixture| mixture.with_density_relaxation(T::of(0.01)))
        .expect("numerics")
}

/// The same with a source for each.
fn with_sources<T: Real, const D: usize>(cloud: Both<T, D>) -> Both<T, D> {
    cloud
        .with_soil_source(|x, _| {
            let stress = SymTensor(core::array::from_fn(|k| T::of(1e5 * random(x, 41 + k as u64))));
            Source { acceleration: Vector::splat(x[0] * T::of(3.0)), memory: SoilMemory::stressed(stress) }
        })
        .with_water_source(|x, _| Source { acceleration: Vector::splat(x[1] * T::of(2.0)), memory: () })
}

/// |Σ of all powers| / Σ |terms|, with the accelerations of `forces`.
fn residual<T: Real, const D: usize>(
    mixture: &Both<T, D>,
    forces: &Both<T, D>,
    conditions: &Conditions,
) -> f64 {
    let stored = energy_rates(mixture, forces, conditions);
    balance::residual(stored, &mixture.exchange_rate().taken, &DROPPED, conditions)
}

/// Rates of kinetic, potential, elastic and compressive energy, particle by particle.
fn energy_rates<T: Real, const D: usize>(
    mixture: &Both<T, D>,
    forces: &Both<T, D>,
    conditions: &Conditions,
) -> Vec<f64> {
    let (soil, water) = (mixture.soil(), mixture.water());
    let [of_soil, of_water] = [forces.soil().accelerations(), forces.water().accelerations()];
    let gravity = mixture.gravity().as_f64();
    let moving = |mass: T, v: Vector<T, D>, a: Vector<T, D>| {
        let (mass, v, a) = (mass.as_f64(), v.as_f64(), a.as_f64());
        mass * (0..D).map(|k| v[k] * (a[k] - gravity[k])).sum::<f64>()
    };
    let mut terms = Vec::new();
    for i in 0..soil.len() {
        if i >= soil.wall_particles() {
            terms.push(moving(soil.masses()[i], soil.velocities()[i], of_soil[i]));
        }
        if !conditions.is(NO_STORE) {
            let strain = elasticity::<T>().strain(&soil.memory(i).stress);
            let stored = strain.double_dot(&soil.memory_rate(i).stress).as_f64();
            terms.push(soil.masses()[i].as_f64() / GRAINS * stored);
        }
    }
    for a in 0..water.len() {
        if a >= water.wall_particles() {
            terms.push(moving(water.masses()[a], water.velocities()[a], of_water[a]));
        }
        // φ dρ̃/dt = dρ/dt − ρ̃ dφ/dt
        let (density, fraction) = (water.density(a).as_f64(), water.volume_fraction(a).as_f64());
        let kept = if conditions.is(NO_FRACTION) { 0.0 } else { 1.0 };
        let compression = water.density_rate(a).as_f64()
            - kept * water.true_density(a).as_f64() * water.fraction_rate(a).as_f64();
        let stores = water.pressures()[a].as_f64() * fraction / (density * density);
        terms.push(water.masses()[a].as_f64() * stores * compression);
    }
    terms
}

fn momentum<T: Real, const D: usize>(name: &str, sums: Sums, largest: f64) -> Study {
    Study::new(
        name,
        "soil and water push each other equally: what both gain is their weight (values: the rest over the \
         sum of all forces)",
        move |conditions| {
            Measured::values((1..=3).map(|seed| {
                let mut mixture = sums.apply(cloud::<T, D>(seed)).with_gravity(Vector::zero());
                mixture.evaluate().expect("rates");
                let mut force = [0.0; D];
                let mut size = 0.0;
                let mut add = |mass: &T, a: &Vector<T, D>| {
                    for k in 0..D {
                        force[k] += mass.as_f64() * a[k].as_f64();
                        size += (mass.as_f64() * a[k].as_f64()).abs();
                    }
                };
                let (soil, water) = (mixture.soil(), mixture.water());
                water.masses().iter().zip(water.accelerations()).for_each(|(m, a)| add(m, a));
                if !conditions.is(ONE_SIDED) {
                    soil.masses().iter().zip(soil.accelerations()).for_each(|(m, a)| add(m, a));
                }
                (format!("cloud {seed}"), force.iter().map(|f| f.abs()).fold(0.0, f64::max) / size)
            }))
        },
    )
    .equations(&["55", "58"])
    .source("Newton's third law, pair by pair")
    .expect(Expected::Bound { largest })
    .mutant(ONE_SIDED)
}

/// φ_s of every particle of soil: the U-tube's.
const SOLID: f64 = 0.55;

/// Soil and water on the same lattice with h/Δx = `ratio`, the water displaced by parts of the spacing, in a periodic
/// box.
fn displaced<T: Real, const D: usize>(
    ratio: f64,
    displacement: [f64; D],
    pressure: f64,
    drag: impl DragLaw<T> + 'static,
) -> Both<T, D> {
    let side = if D == 2 { 20 } else { 10 };
    let spacing = 1.0 / f64::from(side);
    let places = setup::fill::<T, D>([0.0; D], [1.0; D], spacing);
    let volume = T::of(spacing.powi(D as i32));
    let mut soil = Phase::new(elastic::<T>());
    soil.add(&places, volume, |_| T::ZERO).expect("particles");
    soil.set_volume_fraction(|_| T::of(SOLID));
    let shift = Vector::of(displacement.map(|part| part * spacing));
    let moved: Vec<Vector<T, D>> = places.iter().map(|x| *x + shift).collect();
    let mut fluid = Phase::new(water::<T>(30.0, 0.0));
    fluid.add(&moved, volume, |_| T::of(pressure)).expect("particles");
    Mixture::new(WendlandC2::new(T::of(ratio * spacing)).expect("a length"), soil, fluid)
        .with_periodic(periodic([1.0; D]))
        .with_drag(drag)
}

/// h/Δx \[-\], and the force \[kN/m³\] with which soil as printed holds water that is moved along a line of slope 0.3.
const LOCKED: [(f64, f64); 3] = [(1.0, 43.2), (1.3, 12.1), (1.5, 5.95)];

/// The largest force on water at rest under 30 kPa \[kN/m³\], whichever of these places in its cell it has.
fn spurious<T: Real, const D: usize>(
    ratio: f64,
    form: CouplingForm,
    sums: Sums,
    places: impl IntoIterator<Item = [f64; D]>,
) -> f64 {
    worst(places.into_iter().map(|place| {
        let mut mixture = sums.apply(displaced::<T, D>(ratio, place, 3e4, NoDrag)).with_coupling(form);
        mixture.evaluate().expect("rates");
        let water = mixture.water();
        let force = |a: usize| (water.accelerations()[a].norm() * water.density(a)).as_f64() * 1e-3;
        worst((0..water.len()).map(force))
    }))
}

/// Places in a cell, in spacings from its middle: any two coordinates are those of a grid of 5 × 5.
fn all_over<const D: usize>() -> impl Iterator<Item = [f64; D]> {
    (0..25).map(|n| {
        let [a, b] = [n / 5, n % 5];
        core::array::from_fn(|k| f64::from([a, b, (a + b) % 5][k]) / 5.0 - 0.4)
    })
}

fn locking<T: Real, const D: usize>(name: &str, sums: Sums, largest: f64) -> Study {
    Study::new(
        name,
        "water at a uniform 30 kPa feels no force from soil, wherever it stands in its lattice (values: \
         largest force in kN/m³, over 25 places all over a cell)",
        move |conditions| {
            let printed = conditions.is(PRINTED);
            let form = if printed { CouplingForm::Printed } else { CouplingForm::PressureDifference };
            Measured::values(LOCKED.map(|(ratio, _)| {
                (format!("h = {ratio} Δx"), spurious::<T, D>(ratio, form, sums, all_over()))
            }))
        },
    )
    .equations(&["55", "58"])
    .source("the force is a sum of pressure differences")
    .expect(Expected::Bound { largest })
    .mutant(PRINTED)
}

/// The printed form shows what it is known for.
fn locked(name: &str) -> Study {
    Study::new(
        name,
        "as printed, soil on a lattice of Δx = 0.05 m holds water at 30 kPa with forces of up to 43.2, 12.1 and \
         5.95 kN/m³ at h = Δx, 1.3 Δx and 1.5 Δx (values: over these, the largest along a line of slope 0.3)",
        |conditions| {
            let form =
                if conditions.is(DIFFERENT) { CouplingForm::PressureDifference } else { CouplingForm::Printed };
            let line = [0.1, 0.2, 0.3, 0.4, 0.5].map(|x| [x, 0.3 * x]);
            Measured::values(LOCKED.map(|(ratio, known)| {
                (format!("h = {ratio} Δx"), spurious::<f64, 2>(ratio, form, Sums::Usual, line) / known)
            }))
        },
    )
    .equations(&["55", "58"])
    .source("a prototype of the same sums; p φ_s max|∇S| of the lattice sum S is 43.1, 12.0 and 6.0 kN/m³")
    .expect(Expected::Value { value: 1.0, tolerance: 0.02 })
    .mutant(DIFFERENT)
}

fn drag<T: Real, const D: usize>(name: &str, largest: f64) -> Study {
    Study::new(
        name,
        "on coincident lattices the velocity between soil and water falls at the rate S₀/t_s, \
         1/t_s = C_d (1/ρ_f + 1/ρ_s), C_d = φ_f² ρ̃_f g/k (value: relative difference)",
        |conditions| {
            let (k, slip) = (1e-2, 0.1);
            let right = Darcy::new(Conductivity::new(T::of(k)).expect("a conductivity"));
            let power = match (conditions.is(FULL_WEIGHT), conditions.is(CUBED)) {
                (true, _) => 1,
                (_, true) => 3,
                _ => 2,
            };
            let mut mixture = displaced::<T, D>(1.5, [0.0; D], 0.0, Powered { right, power });
            let mut velocity = Vector::zero();
            velocity[0] = T::of(slip);
            mixture.water_mut().set_velocity(|_| velocity);
            mixture.evaluate().expect("rates");
            let (soil, water) = (mixture.soil(), mixture.water());
            let (rho_s, rho_f) = (soil.density(0).as_f64(), water.density(0).as_f64());
            let side: i64 = if D == 2 { 20 } else { 10 };
            let sum = lattice_sum::<T, D>(mixture.kernel(), 1.0 / side as f64);
            let fraction = 1.0 - SOLID * sum; // (3), (68)
            let coefficient = fraction * fraction * 1000.0 * 9.81 / k;
            let expected = slip * sum * coefficient * (1.0 / rho_f + 1.0 / rho_s);
            let rate = (soil.accelerations()[3][0] - water.accelerations()[3][0]).as_f64();
            Measured::value(rate / expected - 1.0)
        },
    )
    .equations(&["3", "37", "55", "58", "68"])
    .source("DUSTYBOX; S₀ is the kernel's lattice sum")
    .expect(Expected::Bound { largest })
    .mutant(FULL_WEIGHT)
    .mutant(CUBED)
}

/// `Σ V W` on the lattice.
pub fn lattice_sum<T: Real, const D: usize>(kernel: &WendlandC2<T, D>, spacing: f64) -> f64 {
    let reach = (kernel.support().as_f64() / spacing) as i64;
    let mut sum = 0.0;
    for a in -reach..=reach {
        for b in -reach..=reach {
            for c in if D == 3 { -reach..=reach } else { 0..=0 } {
                let r2 = T::of((a * a + b * b + c * c) as f64 * spacing * spacing);
                if r2.as_f64().sqrt() < kernel.support().as_f64() {
                    sum += kernel.value(r2).as_f64() * spacing.powi(D as i32);
                }
            }
        }
    }
    sum
}
