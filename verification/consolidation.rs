//! Terzaghi's consolidation: pore pressure that soil takes over while water drains.

use crate::seepage::Powered;
use crate::water::periodic;
use alluvium::kernel::WendlandC2;
use alluvium::material::{Conductivity, Darcy, Elasticity, Soil, Unyielding, Water};
use alluvium::mixture::{DensityDiffusion, Mixture, Phase};
use alluvium::simulation::Simulation;
use alluvium::time::{LeapFrog, StepSize};
use alluvium::verify::consolidation::{Layer, remaining};
use alluvium::verify::{Conditions, Expected, Measured, Study};
use alluvium::{SymTensor, setup};

const TRUE_WEIGHT: &str = "γ_w with the true density";
const RIGID: &str = "the coefficient of water that cannot be compressed";
/// Table 3, but for the conductivity \[m/s\], under which the layer's sound has come and gone three times
/// before the pressure is looked at.
const GRAINS: f64 = 2700.0;
const FRACTION: f64 = 0.5;
const BULK: f64 = 125e6;
const POISSON: f64 = 0.3;
const SOUND_SPEED: f64 = 250.0;
const CONDUCTIVITY: f64 = 1e-4;
/// The longest way to the drain H and the spacing \[m\].
const HEIGHT: f64 = 0.12;
const SPACING: f64 = 0.005;
/// Pressure at T = 0 \[Pa\].
const PRESSURE: f64 = 1e3;
/// The start, at which pressure no longer jumps at the drain, and when it is looked at, over H²/c_v.
const START: f64 = 0.02;
const TIMES: [f64; 5] = [0.05, 0.1, 0.2, 0.5, 1.0];

pub fn studies() -> Vec<Study> {
    vec![
        Study::new(
            "mixture/consolidation/2d/f64",
            "pore pressure drains from a loaded layer of soil as Terzaghi's series says, with the coefficient \
             of compressible water (values: rms difference over the pressure at the start)",
            |c| {
                let diffused = differences(DensityDiffusion::Hydrostatic(0.1), c);
                let worst = diffused.into_iter().map(|(_, value)| value).fold(0.0, f64::max);
                Measured::values(differences(DensityDiffusion::None, c))
                    .note(format!("with the usual density diffusion up to {worst:.4}: it drains too"))
            },
        )
        .equations(&["37", "52", "53", "55", "58", "65", "69"])
        .source("Terzaghi (1943); c_v = (k/γ_w)/(1/φ_s(K + 4G/3) + φ_f/K_f)")
        .expect(Expected::Bound { largest: 0.02 })
        .mutant(TRUE_WEIGHT)
        .mutant(RIGID),
    ]
}

/// Differences of the profiles of pressure at [`TIMES`].
///
/// A plane at which water drains freely is one of symmetry: the layer and its mirror image of opposite
/// pressure, total stress nowhere, in a strip that repeats itself. So no free surface, with its own errors,
/// stands in for the drain; half way between two of them nothing flows, as above tight rock.
fn differences(diffusion: DensityDiffusion<f64>, conditions: &Conditions) -> Vec<(String, f64)> {
    let size = [4.0 * HEIGHT, 7.0 * SPACING];
    let (places, volume) = (setup::fill::<f64, 2>([0.0; 2], size, SPACING), SPACING * SPACING);
    let elasticity = Elasticity::from_bulk(BULK, POISSON).expect("moduli");
    let layer = Layer {
        height: HEIGHT,
        conductivity: CONDUCTIVITY,
        stiffness: FRACTION * elasticity.plane_wave_modulus(),
        storage: if conditions.is(RIGID) { 0.0 } else { (1.0 - FRACTION) / (1e3 * SOUND_SPEED.powi(2)) },
    };
    let exact = |x: f64, time: f64| {
        let side = if x < 2.0 * HEIGHT { PRESSURE } else { -PRESSURE };
        side * remaining((x % (2.0 * HEIGHT)) / HEIGHT, time)
    };
    let mut soil = Phase::new(Soil::new(GRAINS, elasticity, Unyielding).expect("a soil"));
    soil.add(&places, volume, |_| 0.0).expect("soil");
    soil.set_volume_fraction(|_| FRACTION);
    soil.set_stress(|x| {
        let along = exact(x[0], START) / FRACTION;
        let mut stress = SymTensor::isotropic(POISSON / (1.0 - POISSON) * along);
        stress.0[SymTensor::<f64>::index(0, 0)] = along;
        stress
    });
    let mut water = Phase::new(Water::new(1000.0, SOUND_SPEED).expect("water"));
    water.add(&places, volume, |x| exact(x[0], START)).expect("water");
    let right = Darcy::new(Conductivity::new(CONDUCTIVITY).expect("a conductivity"));
    let power = if conditions.is(TRUE_WEIGHT) { 1 } else { 2 };
    let mixture = Mixture::new(WendlandC2::new(1.5 * SPACING).expect("a length"), soil, water)
        .with_periodic(periodic(size))
        .with_drag(Powered { right, power })
        .with_density_diffusion(diffusion)
        .expect("a coefficient");
    let mut run = Simulation::new(mixture, LeapFrog::new(), StepSize::courant(0.2).expect("a number"));
    let difference = |time: f64| {
        let end = (time - START) * HEIGHT * HEIGHT / layer.coefficient();
        while run.time() < end * (1.0 - 1e-9) {
            run.step_at_most(end - run.time()).expect("a step");
        }
        let water = run.mixture().water();
        let square = |a: usize| {
            let x = water.positions()[a][0];
            ((water.pressures()[a] - exact(x, time)) / PRESSURE).powi(2)
        };
        ((0..water.len()).map(square).sum::<f64>() / water.len() as f64).sqrt()
    };
    let named = TIMES.map(|time| format!("T = {time}"));
    named.into_iter().zip(TIMES.map(difference)).collect()
}
