//! The exact course of a saturated layer of soil that is loaded, or bears its own weight, and drains at one
//! side (Terzaghi 1943), for water that can be compressed.

use core::f64::consts::PI;

/// g \[m/s²\].
const GRAVITY: f64 = 9.81;
/// Density of water \[kg/m³\].
const WATER: f64 = 1000.0;
/// Terms of the series: enough from T = 0.001 on.
const TERMS: u32 = 200;

/// A layer of saturated soil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Its height H \[m\]: the longest way to the drain.
    pub height: f64,
    /// Hydraulic conductivity k \[m/s\].
    pub conductivity: f64,
    /// φ_s (K + 4G/3) of the grains' moduli \[Pa\].
    pub stiffness: f64,
    /// φ_f/K_f \[1/Pa\]: water that is stored per pressure; 0 if it cannot be compressed.
    pub storage: f64,
}

impl Layer {
    /// c_v \[m²/s\] of the diffusion of pore pressure.
    pub fn coefficient(&self) -> f64 {
        self.conductivity / (WATER * GRAVITY) / (1.0 / self.stiffness + self.storage)
    }

    /// The part of a sudden load that the water bears at first \[-\].
    pub fn share_of_water(&self) -> f64 {
        1.0 / (1.0 + self.storage * self.stiffness)
    }
}

/// Excess pressure over that of the start, which was uniform, at a distance of `z` heights from the drain and
/// at the time `time` H²/c_v.
pub fn remaining(z: f64, time: f64) -> f64 {
    series(z, time, |m| 2.0 / m)
}

/// The same where the excess at the start rose evenly from the drain, as the weight of soil does, over its
/// largest.
pub fn remaining_of_weight(z: f64, time: f64) -> f64 {
    series(z, time, |m| 2.0 * m.sin() / (m * m))
}

/// The part of the settlement under a uniform load that has come about \[-\].
pub fn settled(time: f64) -> f64 {
    1.0 - sum(time, |m| 2.0 / (m * m))
}

/// The same under the soil's own weight.
pub fn settled_of_weight(time: f64) -> f64 {
    1.0 - sum(time, |m| 4.0 * m.sin() / m.powi(3))
}

fn series(z: f64, time: f64, amplitude: impl Fn(f64) -> f64) -> f64 {
    sum(time, |m| amplitude(m) * (m * z).sin())
}

/// Σ f(M) e^{−M² T} with M = (2n + 1)π/2.
fn sum(time: f64, of: impl Fn(f64) -> f64) -> f64 {
    let number = |n: u32| (f64::from(n) + 0.5) * PI;
    (0..TERMS).map(number).map(|m| of(m) * (-m * m * time).exp()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-4
    }

    #[test]
    fn the_series_are_the_tabulated_ones() {
        assert!(near(remaining(0.5, 0.2), 0.553176));
        assert!(near(settled(0.197), 0.5003) && near(settled(0.848), 0.9));
        assert!(near(remaining(0.4, 1e-3), 1.0) && near(remaining_of_weight(0.4, 1e-4), 0.4));
        assert!(near(settled_of_weight(0.0), 0.0) && near(settled_of_weight(5.0), 1.0));
        // The mean excess is what is not settled.
        let mean = |of: fn(f64, f64) -> f64| {
            (0..1000).map(|n| of((f64::from(n) + 0.5) / 1000.0, 0.3)).sum::<f64>() / 1000.0
        };
        assert!(near(mean(remaining), 1.0 - settled(0.3)));
        assert!(near(2.0 * mean(remaining_of_weight), 1.0 - settled_of_weight(0.3)));
    }

    #[test]
    fn water_that_can_be_compressed_slows_it() {
        // Table 3.
        let stiffness = 0.5 * 125e6 * (1.0 + 4.0 / 3.0 * 0.461538);
        let layer = Layer { height: 1.0, conductivity: 5e-4, stiffness, storage: 0.5 / 62.5e6 };
        assert!((layer.coefficient() - 2.847).abs() < 1e-3 && (layer.share_of_water() - 0.553).abs() < 1e-3);
        let rigid = Layer { storage: 0.0, ..layer };
        assert!((rigid.coefficient() - 5.146).abs() < 1e-3);
    }
}
