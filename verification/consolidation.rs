//! Terzaghi's consolidation: pore pressure that soil takes over while water drains.

use crate::seepage::Powered;
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{DensityDiffusion, Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::consolidation::{Layer, remaining};
use alluvium::verify::{Conditions, Expected, Level, Measured, Study};
use alluvium::{Real, SymTensor, setup};

const TRUE_WEIGHT: &str = "γ_w with the true density";
const RIGID: &str = "the coefficient of water that cannot be compressed";
/// Table 3.
const GRAINS: f64 = 2700.0;
const FRACTION: f64 = 0.5;
const BULK: f64 = 125e6;
const POISSON: f64 = 0.3;
const SOUND_SPEED: f64 = 250.0;
/// Under this conductivity the layer's sound has come and gone three times before the pressure is looked at.
const EVALUATED: Sample = Sample { conductivity: 1e-4, height: 0.12, spacing: 0.005 };
/// Pressure at T = 0 \[Pa\].
const PRESSURE: f64 = 1e3;
/// The start, at which pressure no longer jumps at the drain, and when it is looked at, over H²/c_v.
const START: f64 = 0.02;
const TIMES: [f64; 5] = [0.05, 0.1, 0.2, 0.5, 1.0];
const SOURCE: &str = "Terzaghi (1943); c_v = (k/γ_w)/(1/φ_s(K + 4G/3) + φ_f/K_f)";

/// What drains.
#[derive(Clone, Copy)]
struct Sample {
    /// \[m/s\].
    conductivity: f64,
    /// The longest way to the drain H \[m\].
    height: f64,
    /// \[m\].
    spacing: f64,
}

type Layered<T, const D: usize> = Mixture<T, D, WendlandC2<T, D>, Soil<T, Unyielding>, Water<T>>;

pub fn studies() -> Vec<Study> {
    vec![
        draining::<f64, 2>("mixture/consolidation/2d/f64", &TIMES),
        draining::<f32, 2>("mixture/consolidation/2d/f32", &TIMES[..3]),
        draining::<f64, 3>("mixture/consolidation/3d/f64", &TIMES[..3]).level(Level::Full),
        draining::<f32, 3>("mixture/consolidation/3d/f32", &TIMES[..3]).level(Level::Full),
        #[cfg(feature = "implicit")]
        solved("1e-4", EVALUATED),
        #[cfg(feature = "implicit")]
        solved("1e-6", Sample { conductivity: 1e-6, height: 0.024, spacing: 0.002 }).level(Level::Full),
    ]
}

fn draining<T: Real, const D: usize>(name: &str, times: &'static [f64]) -> Study {
    Study::new(
        name,
        "without density diffusion, pore pressure drains from a loaded layer of soil as Terzaghi's series says, with \
         the coefficient of compressible water, and so it does with the renormalised one (values: rms difference over \
         the pressure at the start)",
        |c| {
            let course = |diffusion| {
                differences::<T, D>(EVALUATED, times, layered(EVALUATED, diffusion, c), c)
            };
            let plain = course(DensityDiffusion::None);
            let renormalised = course(DensityDiffusion::Renormalised(T::of(0.1)));
            let named = renormalised.into_iter().map(|(time, value)| (format!("{time}, renormalised"), value));
            let measured = Measured::values(plain.into_iter().chain(named));
            if times.len() < TIMES.len() {
                return measured;
            }
            let diffused = course(DensityDiffusion::Hydrostatic(T::of(0.1)));
            let worst = diffused.into_iter().map(|(_, value)| value).fold(0.0, f64::max);
            measured.note(format!("with the usual density diffusion up to {worst:.4}: it drains too"))
        },
    )
    .equations(&["37", "52", "53", "55", "58", "65", "69"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 0.02 })
    .mutant(TRUE_WEIGHT)
    .mutant(RIGID)
}

/// The same with drag solved over the step of sound.
#[cfg(feature = "implicit")]
fn solved(name: &str, sample: Sample) -> Study {
    Study::new(
        format!("mixture/consolidation/solved drag/k = {name}"),
        "with drag solved over the step that sound allows, pore pressure drains from silt as from sand (values: \
         rms difference over the pressure at the start)",
        move |c| {
            let mixture = layered::<f64, 2>(sample, DensityDiffusion::None, c);
            let solved = mixture.with_drag_scheme(alluvium::mixture::DragScheme::BackwardEuler);
            Measured::values(differences(sample, &TIMES[..3], solved, c))
        },
    )
    .equations(&["37", "52", "53", "55", "58", "65", "69"])
    .source(SOURCE)
    .expect(Expected::Bound { largest: 0.02 })
    .mutant(TRUE_WEIGHT)
    .mutant(RIGID)
}

fn elasticity<T: Real>() -> Elasticity<T> {
    Elasticity::from_bulk(T::of(BULK), T::of(POISSON)).expect("moduli")
}

impl Sample {
    fn layer(&self, conditions: &Conditions) -> Layer {
        Layer {
            height: self.height,
            conductivity: self.conductivity,
            stiffness: FRACTION * elasticity::<f64>().plane_wave_modulus(),
            storage: if conditions.is(RIGID) { 0.0 } else { (1.0 - FRACTION) / (1e3 * SOUND_SPEED.powi(2)) },
        }
    }

    /// Pressure \[Pa\] at this place and time.
    fn exact(&self, x: f64, time: f64) -> f64 {
        let side = if x < 2.0 * self.height { PRESSURE } else { -PRESSURE };
        side * remaining((x % (2.0 * self.height)) / self.height, time)
    }
}

/// The layer at [`START`].
///
/// A plane at which water drains freely is one of symmetry: the layer and its mirror image of opposite
/// pressure, total stress nowhere, in a strip that repeats itself. So no free surface, with its own errors,
/// stands in for the drain; half way between two of them nothing flows, as above tight rock.
fn layered<T: Real, const D: usize>(
    sample: Sample,
    diffusion: DensityDiffusion<T>,
    conditions: &Conditions,
) -> Layered<T, D> {
    let Sample { conductivity, height, spacing } = sample;
    let mut size = [7.0 * spacing; D];
    size[0] = 4.0 * height;
    let (places, volume) = (setup::fill::<T, D>([0.0; D], size, spacing), T::of(spacing.powi(D as i32)));
    let mut soil = Phase::new(Soil::new(T::of(GRAINS), elasticity(), Unyielding).expect("a soil"));
    soil.add(&places, volume, |_| T::ZERO).expect("soil");
    soil.set_volume_fraction(|_| T::of(FRACTION));
    soil.set_stress(|x| {
        let along = sample.exact(x[0].as_f64(), START) / FRACTION;
        let mut stress = SymTensor::isotropic(T::of(POISSON / (1.0 - POISSON) * along));
        stress.0[SymTensor::<T>::index(0, 0)] = T::of(along);
        stress
    });
    let mut water = Phase::new(Water::new(T::of(1000.0), T::of(SOUND_SPEED)).expect("water"));
    water.add(&places, volume, |x| T::of(sample.exact(x[0].as_f64(), START))).expect("water");
    let right = Darcy::new(Conductivity::new(T::of(conductivity)).expect("a conductivity"));
    let power = if conditions.is(TRUE_WEIGHT) { 1 } else { 2 };
    Mixture::new(WendlandC2::new(T::of(1.5 * spacing)).expect("a length"), soil, water)
        .with_periodic(periodic(size))
        .with_drag(Powered { right, power })
        .with_density_diffusion(diffusion)
        .expect("a coefficient")
}

/// Differences of the profiles of pressure at these times.
fn differences<T: Real, const D: usize>(
    sample: Sample,
    times: &[f64],
    mixture: Layered<T, D>,
    conditions: &Conditions,
) -> Vec<(String, f64)> {
    let unit = sample.height * sample.height / sample.layer(conditions).coefficient();
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(T::of(0.2)).expect("a number"));
    let difference = |&time: &f64| {
        let end = (time - START) * unit;
        while run.time() < end * (1.0 - 1e-9) {
            run.step_at_most(end - run.time()).expect("a step");
        }
        let water = run.mixture().water();
        let square = |a: usize| {
            let x = water.positions()[a][0].as_f64();
            ((water.pressures()[a].as_f64() - sample.exact(x, time)) / PRESSURE).powi(2)
        };
        ((0..water.len()).map(square).sum::<f64>() / water.len() as f64).sqrt()
    };
    let differences = times.iter().map(difference).collect::<Vec<_>>();
    times.iter().map(|time| format!("T = {time}")).zip(differences).collect()
}
