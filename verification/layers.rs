//! Two dimensions against one layer of particles in three, in a box that is one spacing thick and repeats itself.
//!
//! They are not the same to a bit: the kernel of three dimensions, added up over the layers, is another than that of
//! two. What differs is the gain of the sums, and that is known. Two parts of it go in their own ways: the smoothing over
//! h with (kh)², by resolution; the lattice's own with h/Δx, and by no resolution. A collapse told in both ways is
//! `dam-break/slab`.

use crate::clouds::Made;
use crate::fits::{Series, oscillation};
use crate::soil::{along, elastic_of};
use crate::water::{periodic, water};
use alluvium::kernel::{Kernel, WendlandC2};
use alluvium::material::{Conductivity, Darcy};
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{StepSize, VelocityVerlet};
use alluvium::verify::{Conditions, Expected, Measured, Study};
use alluvium::{Real, Vector, setup};
use core::f64::consts::TAU;
use core::ops::ControlFlow;
use nalgebra::Matrix4;

const STIFF: &str = "three-dimensional particles 1 % stiffer";
const THIN: &str = "one layer is taken for a fifth less than its thickness";

/// Particles along a wave of length one; rows across.
const SIDE: usize = 32;
const ROWS: f64 = 4.0;
const RATIOS: [f64; 3] = [1.3, 2.0, 3.0];
/// Speed of sound in water \[m/s\], densities \[kg/m³\], bulk and shear modulus of the soil \[Pa\].
const SOUND: f64 = 1.0;
const GRAINS: f64 = 2650.0;
const WATER: f64 = 1000.0;
const MODULI: [f64; 2] = [1500.0, 900.0];
const FRACTION: f64 = 0.5;
/// \[m/s\]
const CONDUCTIVITY: f64 = 0.5;
/// Of the velocity \[m/s\].
const AMPLITUDE: f64 = 1e-4;

pub fn studies() -> Vec<Study> {
    let mut studies: Vec<Study> = Made::ALL.into_iter().map(study::<f64>).collect();
    studies.push(study::<f32>(Made::Mixture));
    studies
}

fn study<T: Real>(made: Made) -> Study {
    Study::new(
        format!("invariance/one layer/{}/{}", made.name(), T::NAME),
        "a standing wave in one periodic layer of three-dimensional particles has the frequency it has in two \
         dimensions, but for the gains of the two lattices' sums (values: ratio of the frequencies over that of the gains, \
         less one)",
        move |conditions| compare::<T>(made, conditions),
    )
    .equations(&["39", "43", "52", "53", "55", "58", "65", "69"])
    .source("(50), (51) for a plane wave on a lattice: k becomes −Σ V sin(kx) ∂W/∂x, in 2D and in 3D")
    // The errors of step and amplitude are the same in both, and cancel. What is left of the mixture is as large as
    // half of the effect.
    .expect(Expected::Bound { largest: if made == Made::Mixture { 1e-3 } else { 1e-5 } })
    .mutant(STIFF)
    .mutant(THIN)
}

fn compare<T: Real>(made: Made, conditions: &Conditions) -> Measured {
    let mut notes = Vec::new();
    let values = RATIOS.map(|ratio| {
        let thick = if conditions.is(THIN) { 0.8 } else { 1.0 };
        let found = frequency::<T, 3>(made, ratio, thick, conditions) / frequency::<T, 2>(made, ratio, 1.0, conditions);
        let gains = gains(made, SIDE, ratio);
        let finer = [64, 256].map(|side| self::gains(made, side, ratio));
        notes.push(format!(
            "h = {ratio} Δx: 3D over 2D {found:.5}; by the sums {gains:.5}, and with 64 and 256 particles along the \
             wave {:.5} and {:.5}",
            finer[0], finer[1]
        ));
        (format!("h = {ratio} Δx"), found / gains - 1.0)
    });
    notes.into_iter().fold(Measured::values(values), Measured::note)
}

/// The ratio of the frequencies of 3D and 2D, by the sums of lattices of `side` particles.
fn gains(made: Made, side: usize, ratio: f64) -> f64 {
    Sums::of::<3>(side, ratio).frequency(made) / Sums::of::<2>(side, ratio).frequency(made)
}

const WAVE_NUMBER: f64 = TAU;

/// What a lattice's sums make of a plane wave.
struct Sums {
    /// −Σ V sin(kx) ∂W/∂x.
    wave_number: f64,
    /// Σ V W, and Σ V W cos(kx).
    whole: f64,
    smoothed: f64,
}

impl Sums {
    fn of<const D: usize>(side: usize, ratio: f64) -> Self {
        let spacing = 1.0 / side as f64;
        let kernel = WendlandC2::<f64, D>::new(ratio * spacing).expect("a length");
        let (reach, volume) = (kernel.support() * kernel.support(), spacing.powi(D as i32));
        let most = (2.0 * ratio) as i32 + 1;
        let deep = if D == 3 { most } else { 0 };
        let mut sums = Self { wave_number: 0.0, whole: 0.0, smoothed: 0.0 };
        for (a, b, c) in (-most..=most)
            .flat_map(|a| (-most..=most).map(move |b| (a, b)))
            .flat_map(|(a, b)| (-deep..=deep).map(move |c| (a, b, c)))
        {
            let (r2, x) = (f64::from(a * a + b * b + c * c) * spacing * spacing, f64::from(a) * spacing);
            if r2 < reach {
                let (sin, cos) = (WAVE_NUMBER * x).sin_cos();
                sums.wave_number -= volume * sin * x * kernel.slope(r2);
                sums.whole += volume * kernel.value(r2);
                sums.smoothed += volume * kernel.value(r2) * cos;
            }
        }
        sums
    }

    /// Of the fast wave \[1/s\], from the linear equations of velocities of soil and water, pore pressure, stress.
    fn frequency(&self, made: Made) -> f64 {
        let k = self.wave_number;
        let modulus = MODULI[0] + 4.0 / 3.0 * MODULI[1];
        match made {
            Made::Water => return SOUND * k,
            Made::Soil => return (modulus / GRAINS).sqrt() * k,
            Made::Mixture => {}
        }
        // The space the soil leaves, by its own sum (68).
        let (phi_s, phi_f) = (FRACTION, 1.0 - FRACTION * self.whole);
        let (rho_s, rho_f, bulk) = (phi_s * GRAINS, phi_f * WATER, WATER * SOUND * SOUND);
        let drag = phi_f * phi_f * WATER * 9.81 / CONDUCTIVITY;
        let (own, other) = (drag * self.whole, drag * self.smoothed);
        let matrix = Matrix4::from_row_slice(
            &[
                [-own / rho_s, other / rho_s, k * phi_s / rho_s, -k * phi_s / rho_s],
                [other / rho_f, -own / rho_f, k * phi_f / rho_f, 0.0],
                [-bulk * k * phi_s / phi_f, -bulk * k, 0.0, 0.0],
                [modulus * k, 0.0, 0.0, 0.0],
            ]
            .concat(),
        );
        matrix.complex_eigenvalues().iter().fold(0.0, |most, root| most.max(root.im))
    }
}

/// Of the standing wave \[1/s\], fitted to the momentum over two periods.
fn frequency<T: Real, const D: usize>(made: Made, ratio: f64, thick: f64, conditions: &Conditions) -> f64 {
    let spacing = 1.0 / SIDE as f64;
    let size: [f64; D] = core::array::from_fn(|k| [1.0, ROWS * spacing, spacing][k]);
    let places = setup::fill([0.0; D], size, spacing);
    let volume = T::of(spacing.powi(D as i32) * thick);
    let stiffer = if conditions.is(STIFF) && D == 3 { 1.01 } else { 1.0 };
    let moving = |x: &Vector<T, D>| along(0, AMPLITUDE * (WAVE_NUMBER * x[0].as_f64()).sin());
    let mut soil = Phase::new(elastic_of(GRAINS, stiffer * MODULI[0], stiffer * MODULI[1]));
    if made.has_soil() {
        soil.add(&places, volume, |_| T::ZERO).expect("soil");
        soil.set_volume_fraction(|_| T::of(FRACTION));
        soil.set_velocity(moving);
    }
    let mut fluid = Phase::new(water::<T>(stiffer * SOUND, 0.0));
    if made.has_water() {
        fluid.add(&places, volume, |_| T::ZERO).expect("water");
        fluid.set_velocity(moving);
    }
    let none = ArtificialViscosity { linear: T::ZERO, quadratic: T::ZERO };
    let mixture = Mixture::new(WendlandC2::new(T::of(ratio * spacing)).expect("a length"), soil, fluid)
        .with_periodic(periodic(size))
        .with_drag(Darcy::new(Conductivity::new(T::of(CONDUCTIVITY)).expect("a conductivity")))
        .with_artificial_viscosity(none)
        .and_then(|mixture| mixture.with_soil_artificial_viscosity(none))
        .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::None))
        .expect("no dissipation but drag");
    let step = StepSize::fixed(T::of(4e-3)).expect("a step");
    let mut run = Simulation::new(mixture, VelocityVerlet::new(), step);
    let mut series = Series::new();
    let _: ControlFlow<()> = run
        .run_until(2.0, |run| {
            let (soil, water) = (run.mixture().soil(), run.mixture().water());
            let mode = |x: &Vector<T, D>, v: &Vector<T, D>, mass: &T| {
                mass.as_f64() * v[0].as_f64() * (WAVE_NUMBER * x[0].as_f64()).sin() / AMPLITUDE
            };
            let of_soil = soil.positions().iter().zip(soil.velocities()).zip(soil.masses());
            let of_water = water.positions().iter().zip(water.velocities()).zip(water.masses());
            let momentum: f64 = of_soil.chain(of_water).map(|((x, v), mass)| mode(x, v, mass)).sum();
            series.push((run.time(), momentum));
            ControlFlow::Continue(())
        })
        .expect("a sound run");
    let scale = series[0].1;
    for (_, momentum) in &mut series {
        *momentum /= scale;
    }
    oscillation(&series, Sums::of::<D>(SIDE, ratio).frequency(made)).frequency
}
