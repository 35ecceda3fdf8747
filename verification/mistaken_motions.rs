//! Terms of the mixture's equations that are wrong, as sources: to the particles the same as a mistake in them.

use crate::motions::{BOTH, MOTION, WATER};
use alluvium::verify::manufactured::Fields;

/// A term of the mixture's equations that is wrong.
#[derive(Clone, Copy, Debug)]
pub enum Mistake {
    /// −φ_s ∇p of the soil is left out.
    NoBuoyancy,
    /// The soil does not feel the drag.
    OneSidedDrag,
    /// The water's pressure by the volume fraction of the start.
    FrozenReference,
    /// σ_xx for σ_yy and back, in the soil's momentum.
    SwappedStress,
}

impl Mistake {
    /// What it adds to the accelerations of soil and water \[m/s²\].
    pub fn adds<const D: usize>(self, x: &[f64; D], t: f64) -> [[f64; D]; 2] {
        const STEP: f64 = 1e-5;
        let slope = |field: &dyn Fn(&[f64; D]) -> f64, k: usize| {
            let shifted = |by: f64| core::array::from_fn(|a| if a == k { x[a] + by } else { x[a] });
            (field(&shifted(STEP)) - field(&shifted(-STEP))) / (2.0 * STEP)
        };
        let pressure = |x: &[f64; D]| BOTH.pressure(&MOTION, x, t);
        let soil_fraction = MOTION.soil_fraction(x, t);
        let of_both = |soil: &dyn Fn(usize) -> f64, water: &dyn Fn(usize) -> f64| {
            [core::array::from_fn(soil), core::array::from_fn(water)]
        };
        match self {
            Self::NoBuoyancy => of_both(&|k| slope(&pressure, k) / BOTH.grain_density, &|_| 0.0),
            Self::OneSidedDrag => {
                let slip = |k: usize| MOTION.water_velocity(x, t)[k] - MOTION.soil_velocity(x, t)[k];
                let water: f64 = MOTION.at(x, t)[4];
                let drag = (1.0 - soil_fraction) * water * BOTH.resistance;
                of_both(&|k| -drag * slip(k) / (BOTH.grain_density * soil_fraction), &|_| 0.0)
            }
            Self::FrozenReference => {
                let frozen = |x: &[f64; D]| {
                    let water: f64 = MOTION.at(x, t)[4];
                    BOTH.water
                        .pressure(water / WATER.reference_density / (1.0 - MOTION.soil_fraction(x, 0.0)))
                };
                let excess = |x: &[f64; D]| frozen(x) - pressure(x);
                let density: f64 = MOTION.at(x, t)[4];
                of_both(&|k| -slope(&excess, k) / BOTH.grain_density, &|k| {
                    -(1.0 - soil_fraction) * slope(&excess, k) / density
                })
            }
            Self::SwappedStress => {
                let difference = |x: &[f64; D]| {
                    let stress = MOTION.stress(x, t);
                    MOTION.soil_fraction(x, t) * (stress.0[1] - stress.0[0])
                };
                let over = 1.0 / (BOTH.grain_density * soil_fraction);
                let sign = [1.0, -1.0, 0.0];
                of_both(&|k| sign[k] * slope(&difference, k) * over, &|_| 0.0)
            }
        }
    }
}
