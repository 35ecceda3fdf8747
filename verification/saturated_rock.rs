//! Saturated soil: the linear equations of its plane waves, and a run of one on particles.

use crate::fits::{Series, growth_rate};
use crate::seepage::Powered;
use crate::soil::along;
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, DragScheme, Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{StepSize, VelocityVerlet};
use alluvium::verify::Conditions;
use alluvium::{Real, SymTensor, Vector, setup};
use core::f64::consts::PI;
use core::ops::ControlFlow;
use nalgebra::{Complex, Matrix4, Vector4};

pub const TRUE_WEIGHT: &str = "γ_w with the true density";
pub const NO_DRAG: &str = "no drag";

/// Densities of grains and water \[kg/m³\], fraction of soil \[-\], conductivity \[m/s\], moduli of Table 3.
const GRAINS: f64 = 2700.0;
const WATER: f64 = 1000.0;
const FRACTION: f64 = 0.5;
pub const CONDUCTIVITY: f64 = 5e-4;
const BULK: f64 = 125e6;
const POISSON: f64 = 0.3;
const GRAVITY: f64 = 9.81;
/// Wave length and smoothing length \[m\].
const LENGTH: f64 = 0.5;
pub const SMOOTHING: f64 = 0.005;
/// Smoothing length over spacing, and rows across the strip.
const RATIO: f64 = 2.0;
const ROWS: f64 = 9.0;
/// c Δt/h.
const COURANT: f64 = 0.2;
/// Of the largest velocity \[m/s\].
const AMPLITUDE: f64 = 1e-4;
/// Second moment of the kernel over h², Wendland C2 in two and three dimensions.
const SECOND_MOMENT: [f64; 2] = [5.0 / 18.0, 4.0 / 15.0];

/// Wave number k \[1/m\].
pub const WAVE_NUMBER: f64 = 2.0 * PI / LENGTH;

/// Saturated soil with water of one speed of sound \[m/s\].
#[derive(Clone, Copy)]
pub struct Rock {
    pub sound_speed: f64,
    /// k \[m/s\].
    pub conductivity: f64,
    pub summed: Summed,
    /// h \[m\].
    pub smoothing: f64,
}

/// Which slip drag is summed with.
#[derive(Clone, Copy, PartialEq)]
pub enum Summed {
    /// That of the particles of a pair.
    Plain,
    /// Reconstructed between them.
    Reconstructed,
}

/// dy/dt = A y for the amplitudes y of velocities of soil and water (sine), pore pressure and stress of the
/// grains (cosine), the latter two over [`IMPEDANCE`].
pub struct Equations(Matrix4<f64>);

/// Makes pressures comparable with velocities \[Pa s/m\].
const IMPEDANCE: f64 = 1e5;

impl Rock {
    fn elasticity<T: Real>(self) -> Elasticity<T> {
        Elasticity::from_bulk(T::of(BULK), T::of(POISSON)).expect("moduli")
    }

    /// C_d (37) \[kg/m³/s\].
    fn drag(self) -> f64 {
        (1.0 - FRACTION).powi(2) * WATER * GRAVITY / self.conductivity // (37)
    }

    /// ν = m₂h²C_d/(ρ_s + ρ_f) \[m²/s\].
    pub fn viscosity_of_drag<const D: usize>(self) -> f64 {
        let density = FRACTION * GRAINS + (1.0 - FRACTION) * WATER;
        SECOND_MOMENT[D - 2] * self.smoothing * self.smoothing * self.drag() / density
    }

    /// The equations, for strain along x alone.
    pub fn equations(self) -> Equations {
        let (phi_s, phi_f, k, z) = (FRACTION, 1.0 - FRACTION, WAVE_NUMBER, IMPEDANCE);
        let (rho_s, rho_f) = (phi_s * GRAINS, phi_f * WATER);
        let (stiffness, bulk) =
            (self.elasticity::<f64>().plane_wave_modulus(), WATER * self.sound_speed.powi(2));
        let c = self.drag();
        Equations(Matrix4::from_row_slice(
            &[
                [-c / rho_s, c / rho_s, k * phi_s * z / rho_s, -k * phi_s * z / rho_s],
                [c / rho_f, -c / rho_f, k * phi_f * z / rho_f, 0.0],
                [-bulk * k * phi_s / (phi_f * z), -bulk * k / z, 0.0, 0.0],
                [stiffness * k / z, 0.0, 0.0, 0.0],
            ]
            .concat(),
        ))
    }

    /// Soil and water in a periodic strip, moving as the mode of this root does.
    fn mixture<T: Real, const D: usize>(self, root: Complex<f64>, conditions: &Conditions) -> Waves<T, D> {
        let spacing = self.smoothing / RATIO;
        let mut size = [ROWS * spacing; D];
        size[0] = LENGTH;
        let (places, volume) = (setup::fill([0.0; D], size, spacing), T::of(spacing.powi(D as i32)));
        let start = self.equations().mode(root) * AMPLITUDE;
        let sine = |x: &Vector<T, D>| (WAVE_NUMBER * x[0].as_f64()).sin();
        let cosine = |x: &Vector<T, D>| (WAVE_NUMBER * x[0].as_f64()).cos();
        let law = Soil::new(T::of(GRAINS), self.elasticity(), Unyielding).expect("a soil");
        let mut soil = Phase::new(law);
        soil.add(&places, volume, |_| T::ZERO).expect("soil");
        soil.set_volume_fraction(|_| T::of(FRACTION));
        soil.set_velocity(|x| along(0, start[0] * sine(x)));
        // Uniaxial strain.
        let lateral = POISSON / (1.0 - POISSON);
        soil.set_stress(|x| {
            let along_x = start[3] * IMPEDANCE * cosine(x);
            let mut stress = SymTensor::isotropic(T::of(lateral * along_x));
            stress.0[SymTensor::<T>::index(0, 0)] = T::of(along_x);
            stress
        });
        let mut water = Phase::new(Water::new(T::of(WATER), T::of(self.sound_speed)).expect("water"));
        water.add(&places, volume, |x| T::of(start[2] * IMPEDANCE * cosine(x))).expect("water");
        water.set_velocity(|x| along(0, start[1] * sine(x)));
        let none = ArtificialViscosity { linear: T::ZERO, quadratic: T::ZERO };
        let mixture = Mixture::new(WendlandC2::new(T::of(self.smoothing)).expect("a length"), soil, water)
            .with_periodic(periodic(size))
            .with_artificial_viscosity(none)
            .and_then(|mixture| mixture.with_soil_artificial_viscosity(none))
            .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::None))
            .expect("no dissipation but drag");
        if conditions.is(NO_DRAG) {
            return mixture;
        }
        let right = Darcy::new(Conductivity::new(T::of(self.conductivity)).expect("a conductivity"));
        let power = if conditions.is(TRUE_WEIGHT) { 1 } else { 2 };
        let mixture = self.solved(mixture.with_drag(Powered { right, power }));
        match self.summed {
            Summed::Plain => mixture,
            Summed::Reconstructed => mixture.with_reconstructed_drag(),
        }
    }

    /// Drag solved over the step where it is too stiff to be evaluated.
    fn solved<T: Real, const D: usize>(self, mixture: Waves<T, D>) -> Waves<T, D> {
        let (rho_s, rho_f) = (FRACTION * GRAINS, (1.0 - FRACTION) * WATER);
        let stopping_time = rho_s * rho_f / (self.drag() * (rho_s + rho_f));
        let step = COURANT * self.smoothing / (self.elasticity::<f64>().plane_wave_modulus() / GRAINS).sqrt();
        if step < 0.4 * stopping_time { mixture } else { mixture.with_drag_scheme(DragScheme::BackwardEuler) }
    }

    /// The root \[1/s\] that is observed over so many periods, or decay times, of this one.
    pub fn run<T: Real, const D: usize>(
        self,
        root: Complex<f64>,
        times: f64,
        conditions: &Conditions,
    ) -> Complex<f64> {
        let left = self.equations().left(root);
        let end = times * if root.im > 0.0 { 2.0 * PI / root.im } else { -1.0 / root.re };
        let step = StepSize::courant(T::of(COURANT)).expect("a number");
        let mut run = Simulation::new(self.mixture::<T, D>(root, conditions), VelocityVerlet::new(), step);
        let (mut sizes, mut turns) = (Series::new(), Series::new());
        let (mut turn, mut last) = (0.0, None);
        let _: ControlFlow<()> = run
            .run_until(end, |run| {
                let now = left.dot(&amplitudes(run.mixture(), self.sound_speed).map(Complex::from));
                turn += last.map_or(0.0, |last: Complex<f64>| (now / last).arg());
                last = Some(now);
                sizes.push((run.time(), now.norm()));
                turns.push((run.time(), turn.exp()));
                ControlFlow::Continue(())
            })
            .expect("a sound run");
        Complex::new(growth_rate(&sizes), growth_rate(&turns))
    }
}

type Waves<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>>;

/// The amplitudes y of [`Equations`].
fn amplitudes<T: Real, const D: usize>(mixture: &Waves<T, D>, sound_speed: f64) -> Vector4<f64> {
    let (soil, water) = (mixture.soil(), mixture.water());
    let mut y = Vector4::zeros();
    let bulk = WATER * sound_speed * sound_speed;
    for i in 0..soil.len() {
        let (sin, cos) = (WAVE_NUMBER * soil.positions()[i][0].as_f64()).sin_cos();
        y[0] += soil.velocities()[i][0].as_f64() * sin;
        y[3] += soil.memory(i).stress.0[SymTensor::<T>::index(0, 0)].as_f64() * cos / IMPEDANCE;
    }
    for a in 0..water.len() {
        let (sin, cos) = (WAVE_NUMBER * water.positions()[a][0].as_f64()).sin_cos();
        y[1] += water.velocities()[a][0].as_f64() * sin;
        y[2] += bulk * water.compression(a).as_f64() * cos / IMPEDANCE;
    }
    y * (2.0 / soil.len() as f64)
}

impl Equations {
    /// The oscillating root.
    pub fn fast(&self) -> Complex<f64> {
        let roots = self.0.complex_eigenvalues();
        roots.iter().copied().max_by(|a, b| a.im.total_cmp(&b.im)).expect("four roots")
    }

    /// The slower of the two that only decay.
    pub fn slow(&self) -> Complex<f64> {
        let fast = self.fast().im;
        let roots = self.0.complex_eigenvalues();
        let decaying = roots.iter().copied().filter(|root| root.im.abs() < 1e-6 * fast);
        decaying.max_by(|a, b| a.re.total_cmp(&b.re)).expect("two of them")
    }

    /// The real part of the mode of this root, of velocities of about one.
    fn mode(&self, root: Complex<f64>) -> Vector4<f64> {
        vector_of(self.0, root).map(|part| part.re)
    }

    /// The mode of the transposed matrix: its product with y is the share of the mode in y.
    fn left(&self, root: Complex<f64>) -> Vector4<Complex<f64>> {
        vector_of(self.0.transpose(), root)
    }
}

/// The eigenvector of this root, by inverse iteration.
fn vector_of(matrix: Matrix4<f64>, root: Complex<f64>) -> Vector4<Complex<f64>> {
    let beside = root * (1.0 + 1e-7);
    let shifted = matrix.map(Complex::from) - Matrix4::from_diagonal_element(beside);
    let factors = shifted.lu();
    let mut vector = Vector4::from_element(Complex::from(1.0));
    for _ in 0..3 {
        vector = factors.solve(&vector).expect("not singular");
        // The largest part is real.
        let largest = vector.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm())).expect("four");
        vector /= largest;
    }
    vector
}
