//! Plane waves of soil and water together: compression that both share, and the slow diffusion of pore pressure.

use crate::fits::{Series, growth_rate};
use crate::seepage::Powered;
use crate::soil::along;
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{ArtificialViscosity, DensityDiffusion, DragScheme, Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{StepSize, VelocityVerlet};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{SymTensor, Vector, setup};
use core::f64::consts::PI;
use core::ops::ControlFlow;
use nalgebra::{Complex, Matrix4, Vector4};

const SOURCE: &str = "eigenvalues of the linear equations of soil and water for one wave number";
const TRUE_WEIGHT: &str = "γ_w with the true density";
const NO_DRAG: &str = "no drag";
const PLAIN: &str = "slips of the particles of a pair";

/// Densities of grains and water \[kg/m³\], fraction of soil \[-\], conductivity \[m/s\], moduli of Table 3.
const GRAINS: f64 = 2700.0;
const WATER: f64 = 1000.0;
const FRACTION: f64 = 0.5;
const CONDUCTIVITY: f64 = 5e-4;
const BULK: f64 = 125e6;
const POISSON: f64 = 0.3;
const GRAVITY: f64 = 9.81;
/// Wave length and smoothing length \[m\].
const LENGTH: f64 = 0.5;
const SMOOTHING: f64 = 0.005;
/// Smoothing length over spacing, and rows across the strip.
const RATIO: f64 = 2.0;
const ROWS: f64 = 9.0;
/// c Δt/h.
const COURANT: f64 = 0.2;
/// Of the largest velocity \[m/s\].
const AMPLITUDE: f64 = 1e-4;
/// Second moment of the kernel over h², Wendland C2 in two dimensions.
const SECOND_MOMENT: f64 = 5.0 / 18.0;

/// Table 3, and the same with softer water.
const IN_TABLE: Rock = Rock { sound_speed: 250.0, conductivity: CONDUCTIVITY, summed: Summed::Plain };
const SOFT: Rock = Rock { sound_speed: 100.0, ..IN_TABLE };

pub fn studies() -> Vec<Study> {
    vec![
        phase(),
        damping(),
        spurious_damping(),
        decades("one decade", &[5e-3, 5e-4]),
        decades("eight decades", &[1e1, 1e0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7])
            .level(Level::Full)
            .falls_short(
                Expected::Bound { largest: 4e-5 },
                "at k = 1e-7 m/s, where the drag's viscosity alone would damp by 7.3e3 /s",
            ),
    ]
}

/// The frequency of the fast wave.
fn phase() -> Study {
    Study::new(
        "mixture/waves/phase/2d/f64",
        "a compression wave of soil and water has the phase of their linear equations (values: relative \
         error of the frequency)",
        |c| {
            Measured::values([("c_f = 250 m/s", IN_TABLE), ("c_f = 100 m/s", SOFT)].map(|(name, rock)| {
                let exact = rock.equations().fast();
                (name, rock.run(exact, 2.5, c).im / exact.im - 1.0)
            }))
        },
    )
    .equations(&["52", "55", "58", "69"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 0.01 })
    .mutant(NO_DRAG)
}

/// What drag takes from the slow and the fast root.
fn damping() -> Study {
    Study::new(
        "mixture/waves/damping/2d/f64",
        "drag damps the diffusion of pore pressure and, with soft water, the fast wave as their linear \
         equations say (values: relative error of the rate)",
        |c| {
            let slow = IN_TABLE.equations().slow();
            let fast = SOFT.equations().fast();
            Measured::values([
                ("slow, c_f = 250 m/s", IN_TABLE.run(slow, 2.5, c).re / slow.re - 1.0),
                ("fast, c_f = 100 m/s", SOFT.run(fast, 2.5, c).re / fast.re - 1.0),
            ])
            .note(format!("exact rates {:.4} and {:.4} /s", slow.re, fast.re))
        },
    )
    .equations(&["37", "52", "55", "58", "69"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 0.05 })
    .mutant(TRUE_WEIGHT)
}

/// What the width of the kernel adds to it.
fn spurious_damping() -> Study {
    Study::new(
        "mixture/waves/spurious damping/2d/f64",
        "summed over a kernel, drag also smooths what soil and water do together, as a viscosity \
         ν = m₂h²C_d/(ρ_s + ρ_f) does (value: damping of the fast wave of Table 3 beyond the exact, over \
         ½νk²)",
        |c| {
            let exact = IN_TABLE.equations().fast();
            let found = IN_TABLE.run(exact, 2.5, c);
            let more = exact.re - found.re;
            let predicted = 0.5 * IN_TABLE.viscosity_of_drag() * WAVE_NUMBER * WAVE_NUMBER;
            Measured::value(more / predicted).note(format!(
                "exact {:.4} /s, measured {:.4} /s, ½νk² = {predicted:.4} /s",
                -exact.re, -found.re
            ))
        },
    )
    .equations(&["37", "55", "58"])
    .source("expansion of the kernel's sum, m₂ = 5/18 for Wendland C2 in two dimensions")
    .expect(Expected::Value { value: 1.0, tolerance: 0.05 })
    .mutant(TRUE_WEIGHT)
}

/// What is measured of a wave that drag does next to nothing to, k from 0.1 m/s, beyond its damping \[1/s\].
const FLOOR: f64 = 5e-3;

/// Damping of the fast wave over decades of conductivity, with drag of reconstructed velocities.
fn decades(count: &str, conductivities: &'static [f64]) -> Study {
    Study::new(
        format!("mixture/waves/reconstructed drag/{count}/2d/f64"),
        "drag of velocities reconstructed between particles adds little to the damping of the fast wave that the \
         linear equations have, where drag summed over a kernel adds ½νk²: a small part of the frequency (values: \
         damping beyond the exact, over the frequency)",
        move |c| {
            let mut notes = vec![format!("the measurement's floor is {FLOOR:e} /s")];
            let mut value = |conductivity: f64| {
                let plain = Rock { conductivity, ..IN_TABLE };
                let rock = if c.is(PLAIN) { plain } else { Rock { summed: Summed::Reconstructed, ..plain } };
                let exact = rock.equations().fast();
                let found = rock.run(exact, 2.5, c);
                let predicted = 0.5 * rock.viscosity_of_drag() * WAVE_NUMBER * WAVE_NUMBER;
                let without = match predicted < 0.3 * exact.im && !c.is(PLAIN) {
                    true => format!("{:.4e} /s", -plain.run(exact, 2.5, c).re),
                    false => "not run".to_owned(),
                };
                notes.push(format!(
                    "k = {conductivity:e} m/s: exact {:.4e} /s, reconstructed {:.4e} /s, plain {without} (½νk² = \
                     {predicted:.4e} /s, of which {:.2e} is left)",
                    -exact.re,
                    -found.re,
                    (exact.re - found.re) / predicted
                ));
                (format!("k = {conductivity:e} m/s"), (exact.re - found.re) / exact.im)
            };
            let measured = Measured::values(conductivities.iter().map(|&k| value(k)).collect::<Vec<_>>());
            notes.into_iter().fold(measured, Measured::note)
        },
    )
    .equations(&["37", "55", "58"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 2e-5 })
    .mutant(PLAIN)
}

/// Wave number k \[1/m\].
const WAVE_NUMBER: f64 = 2.0 * PI / LENGTH;

/// Saturated soil with water of one speed of sound \[m/s\].
#[derive(Clone, Copy)]
struct Rock {
    sound_speed: f64,
    /// k \[m/s\].
    conductivity: f64,
    summed: Summed,
}

/// Which slip drag is summed with.
#[derive(Clone, Copy, PartialEq)]
enum Summed {
    /// That of the particles of a pair.
    Plain,
    /// Reconstructed between them.
    Reconstructed,
}

/// dy/dt = A y for the amplitudes y of velocities of soil and water (sine), pore pressure and stress of the
/// grains (cosine), the latter two over [`IMPEDANCE`].
struct Equations(Matrix4<f64>);

/// Makes pressures comparable with velocities \[Pa s/m\].
const IMPEDANCE: f64 = 1e5;

impl Rock {
    fn elasticity(self) -> Elasticity<f64> {
        Elasticity::from_bulk(BULK, POISSON).expect("moduli")
    }

    /// C_d (37) \[kg/m³/s\].
    fn drag(self) -> f64 {
        (1.0 - FRACTION).powi(2) * WATER * GRAVITY / self.conductivity // (37)
    }

    /// ν = m₂h²C_d/(ρ_s + ρ_f) \[m²/s\].
    fn viscosity_of_drag(self) -> f64 {
        let density = FRACTION * GRAINS + (1.0 - FRACTION) * WATER;
        SECOND_MOMENT * SMOOTHING * SMOOTHING * self.drag() / density
    }

    /// The equations, for plane strain.
    fn equations(self) -> Equations {
        let (phi_s, phi_f, k, z) = (FRACTION, 1.0 - FRACTION, WAVE_NUMBER, IMPEDANCE);
        let (rho_s, rho_f) = (phi_s * GRAINS, phi_f * WATER);
        let (stiffness, bulk) = (self.elasticity().plane_wave_modulus(), WATER * self.sound_speed.powi(2));
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
    fn mixture(self, root: Complex<f64>, conditions: &Conditions) -> Waves {
        let spacing = SMOOTHING / RATIO;
        let size = [LENGTH, ROWS * spacing];
        let (places, volume) = (setup::fill([0.0; 2], size, spacing), spacing * spacing);
        let start = self.equations().mode(root) * AMPLITUDE;
        let sine = |x: &Vector<f64, 2>| (WAVE_NUMBER * x[0]).sin();
        let cosine = |x: &Vector<f64, 2>| (WAVE_NUMBER * x[0]).cos();
        let law = Soil::new(GRAINS, self.elasticity(), Unyielding).expect("a soil");
        let mut soil = Phase::new(law);
        soil.add(&places, volume, |_| 0.0).expect("soil");
        soil.set_volume_fraction(|_| FRACTION);
        soil.set_velocity(|x| along(0, start[0] * sine(x)));
        // Uniaxial strain.
        let lateral = POISSON / (1.0 - POISSON);
        soil.set_stress(|x| {
            let along_x = start[3] * IMPEDANCE * cosine(x);
            let mut stress = SymTensor::isotropic(lateral * along_x);
            stress.0[SymTensor::<f64>::index(0, 0)] = along_x;
            stress
        });
        let mut water = Phase::new(Water::new(WATER, self.sound_speed).expect("water"));
        water.add(&places, volume, |x| start[2] * IMPEDANCE * cosine(x)).expect("water");
        water.set_velocity(|x| along(0, start[1] * sine(x)));
        let none = ArtificialViscosity { linear: 0.0, quadratic: 0.0 };
        let mixture = Mixture::new(WendlandC2::new(SMOOTHING).expect("a length"), soil, water)
            .with_periodic(periodic(size))
            .with_artificial_viscosity(none)
            .and_then(|mixture| mixture.with_soil_artificial_viscosity(none))
            .and_then(|mixture| mixture.with_density_diffusion(DensityDiffusion::None))
            .expect("no dissipation but drag");
        if conditions.is(NO_DRAG) {
            return mixture;
        }
        let right = Darcy::new(Conductivity::new(self.conductivity).expect("a conductivity"));
        let power = if conditions.is(TRUE_WEIGHT) { 1 } else { 2 };
        let mixture = self.solved(mixture.with_drag(Powered { right, power }));
        match self.summed {
            Summed::Plain => mixture,
            Summed::Reconstructed => mixture.with_reconstructed_drag(),
        }
    }

    /// Drag solved over the step where it is too stiff to be evaluated.
    fn solved(self, mixture: Waves) -> Waves {
        let (rho_s, rho_f) = (FRACTION * GRAINS, (1.0 - FRACTION) * WATER);
        let stopping_time = rho_s * rho_f / (self.drag() * (rho_s + rho_f));
        let step = COURANT * SMOOTHING / (self.elasticity().plane_wave_modulus() / GRAINS).sqrt();
        if step < 0.4 * stopping_time { mixture } else { mixture.with_drag_scheme(DragScheme::BackwardEuler) }
    }

    /// The root \[1/s\] that is observed over so many periods, or decay times, of this one.
    fn run(self, root: Complex<f64>, times: f64, conditions: &Conditions) -> Complex<f64> {
        let left = self.equations().left(root);
        let end = times * if root.im > 0.0 { 2.0 * PI / root.im } else { -1.0 / root.re };
        let step = StepSize::courant(COURANT).expect("a number");
        let mut run = Simulation::new(self.mixture(root, conditions), VelocityVerlet::new(), step);
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

type Waves = Mixture<f64, 2, WendlandC2<f64, 2>, Soil<f64, Unyielding>, Water<f64>>;

/// The amplitudes y of [`Equations`].
fn amplitudes(mixture: &Waves, sound_speed: f64) -> Vector4<f64> {
    let (soil, water) = (mixture.soil(), mixture.water());
    let mut y = Vector4::zeros();
    let bulk = WATER * sound_speed * sound_speed;
    for i in 0..soil.len() {
        let (sin, cos) = (WAVE_NUMBER * soil.positions()[i][0]).sin_cos();
        y[0] += soil.velocities()[i][0] * sin;
        y[3] += soil.memory(i).stress.0[SymTensor::<f64>::index(0, 0)] * cos / IMPEDANCE;
    }
    for a in 0..water.len() {
        let (sin, cos) = (WAVE_NUMBER * water.positions()[a][0]).sin_cos();
        y[1] += water.velocities()[a][0] * sin;
        y[2] += bulk * water.compression(a) * cos / IMPEDANCE;
    }
    y * (2.0 / soil.len() as f64)
}

impl Equations {
    /// The oscillating root.
    fn fast(&self) -> Complex<f64> {
        let roots = self.0.complex_eigenvalues();
        roots.iter().copied().max_by(|a, b| a.im.total_cmp(&b.im)).expect("four roots")
    }

    /// The slower of the two that only decay.
    fn slow(&self) -> Complex<f64> {
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
