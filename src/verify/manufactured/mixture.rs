//! Soil and water together.

use super::water::{K, WaterLaw, product, vortices};
use super::{Fields, Number, derivatives};
use crate::space::SymTensor;

/// Places among the fields of a mixture: φ_s, v_s, partial density ρ_f, v_f, σ (xx, yy, zz, xy, yz, xz; positive in
/// tension, per area of the grains). In 2D the third components of vectors are zero.
mod place {
    pub(super) const SOIL_FRACTION: usize = 0;
    pub(super) const SOIL_VELOCITY: usize = 1;
    pub(super) const WATER_DENSITY: usize = 4;
    pub(super) const WATER_VELOCITY: usize = 5;
    pub(super) const STRESS: usize = 8;
    pub(super) const COUNT: usize = 14;
}

/// Motion of soil and water, [φ_s, v_s, ρ_f, v_f, σ].
pub trait MixtureFields<const D: usize>: Fields<D, { place::COUNT }> {}
impl<F: Fields<D, { place::COUNT }>, const D: usize> MixtureFields<D> for F {}

/// The laws of both, once more and by themselves.
#[derive(Clone, Copy, Debug)]
pub struct Both {
    /// Of the water, inviscid.
    pub water: WaterLaw,
    /// ρ̃_s \[kg/m³\] of the grains.
    pub grain_density: f64,
    /// K \[Pa\] of the skeleton.
    pub bulk: f64,
    /// G \[Pa\].
    pub shear: f64,
    /// g/k \[1/s\] of Darcy's drag (37).
    pub resistance: f64,
}

/// What the soil needs.
#[derive(Clone, Copy, Debug)]
pub struct SoilSource<const D: usize> {
    /// Force per mass \[m/s²\].
    pub acceleration: [f64; D],
    /// Added to the rate of the stress \[Pa/s\].
    pub stress: SymTensor<f64>,
}

/// What is differentiated beside the fields: pore pressure, then φ_s σ.
struct Forces<'a, F> {
    motion: &'a F,
    law: &'a Both,
}

impl<F: MixtureFields<D>, const D: usize> Fields<D, 7> for Forces<'_, F> {
    fn at<N: Number>(&self, x: &[N; D], t: N) -> [N; 7] {
        let fields = self.motion.at(x, t);
        let soil = fields[place::SOIL_FRACTION];
        let ratio = fields[place::WATER_DENSITY] / self.law.water.reference_density / (-soil + 1.0);
        core::array::from_fn(|m| match m {
            0 => self.law.water.pressure(ratio), // (20)
            _ => soil * fields[place::STRESS + m - 1],
        })
    }
}

/// The components of a vector among the fields.
fn vector<const D: usize>(fields: &[f64], first: usize) -> [f64; D] {
    core::array::from_fn(|k| fields[first + k])
}

impl Both {
    /// p \[Pa\] of a motion.
    pub fn pressure<F: MixtureFields<D>, const D: usize>(&self, motion: &F, x: &[f64; D], t: f64) -> f64 {
        Forces { motion, law: self }.at(x, t)[0]
    }

    /// C_d (37) \[kg/m³/s\] between the two.
    fn drag(&self, fields: &[f64]) -> f64 {
        (1.0 - fields[place::SOIL_FRACTION]) * fields[place::WATER_DENSITY] * self.resistance
    }

    /// The acceleration \[m/s²\] that makes the water's motion exact (58):
    /// `Dv_f/Dt + (φ_f ∇p + C_d (v_f − v_s))/ρ_f`.
    pub fn water_source<F: MixtureFields<D>, const D: usize>(
        &self,
        motion: &F,
        x: &[f64; D],
        t: f64,
    ) -> [f64; D] {
        let (d, forces) = (derivatives(motion, x, t), derivatives(&Forces { motion, law: self }, x, t));
        let (soil, water) =
            (vector::<D>(&d.value, place::SOIL_VELOCITY), vector::<D>(&d.value, place::WATER_VELOCITY));
        let fraction = 1.0 - d.value[place::SOIL_FRACTION];
        core::array::from_fn(|k| {
            let resisting = fraction * forces.gradient[0][k] + self.drag(&d.value) * (water[k] - soil[k]);
            d.following(place::WATER_VELOCITY + k, &water) + resisting / d.value[place::WATER_DENSITY]
        })
    }

    /// What makes the soil's motion exact (55), (33)–(35):
    /// `Dv_s/Dt − (∇·(φ_s σ) − φ_s ∇p + C_d (v_f − v_s))/ρ_s` and `Dσ/Dt − (ωσ − σω) − C : ε̇`.
    pub fn soil_source<F: MixtureFields<D>, const D: usize>(
        &self,
        motion: &F,
        x: &[f64; D],
        t: f64,
    ) -> SoilSource<D> {
        let (d, forces) = (derivatives(motion, x, t), derivatives(&Forces { motion, law: self }, x, t));
        let (soil, water) =
            (vector::<D>(&d.value, place::SOIL_VELOCITY), vector::<D>(&d.value, place::WATER_VELOCITY));
        let fraction = d.value[place::SOIL_FRACTION];
        let acceleration = core::array::from_fn(|k| {
            let pull: f64 = (0..D).map(|l| forces.gradient[1 + SymTensor::<f64>::index(k, l)][l]).sum();
            let driving =
                pull - fraction * forces.gradient[0][k] + self.drag(&d.value) * (water[k] - soil[k]);
            d.following(place::SOIL_VELOCITY + k, &soil) - driving / (self.grain_density * fraction)
        });
        let slope =
            |a: usize, b: usize| if a < D && b < D { d.gradient[place::SOIL_VELOCITY + a][b] } else { 0.0 };
        let spin = |a: usize, b: usize| 0.5 * (slope(a, b) - slope(b, a)); // (35)
        let stress = |a: usize, b: usize| d.value[place::STRESS + SymTensor::<f64>::index(a, b)];
        let swelling: f64 = (0..3).map(|a| slope(a, a)).sum();
        let rate = |a: usize, b: usize| {
            let turning: f64 = (0..3).map(|c| spin(a, c) * stress(c, b) - stress(a, c) * spin(c, b)).sum(); // (34)
            let shearing = self.shear * (slope(a, b) + slope(b, a));
            let pressing = if a == b { (self.bulk - 2.0 / 3.0 * self.shear) * swelling } else { 0.0 };
            turning + shearing + pressing
        };
        let mut source = SymTensor::zero();
        for (a, b) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)] {
            let m = SymTensor::<f64>::index(a, b);
            source.0[m] = d.following(place::STRESS + m, &soil) - rate(a, b);
        }
        SoilSource { acceleration, stress: source }
    }
}

/// Standing waves of both constituents on vortices of both, in a box of edge one that repeats itself; the soil under a
/// stress that rocks as well.
///
/// $$\phi_s = \phi_0 + A R_1\sin\omega t,\qquad \phi_s\mathbf v_s = \frac{A\omega\cos\omega t}{Dk^2}\nabla R_1 +
/// U_s\nabla\times\chi_s$$
/// $$\rho_f = \tilde\rho_0(\phi_f + \epsilon R_2\cos\omega t),\qquad \rho_f\mathbf v_f =
/// -\frac{\tilde\rho_0}{Dk^2}\big(A\omega\cos\omega t\,\nabla R_1 + \epsilon\omega\sin\omega t\,\nabla R_2\big) +
/// \tilde\rho_0U_f\nabla\times\chi_f$$
#[derive(Clone, Copy, Debug)]
pub struct WaveOfBoth {
    /// ρ̃₀ \[kg/m³\] of the water.
    pub water_density: f64,
    /// φ₀ \[-\].
    pub fraction: f64,
    /// A \[-\].
    pub fraction_amplitude: f64,
    /// ε \[-\].
    pub amplitude: f64,
    /// U_s \[m/s\].
    pub soil_speed: f64,
    /// U_f \[m/s\].
    pub water_speed: f64,
    /// ω \[1/s\].
    pub frequency: f64,
    /// Mean pressure of the skeleton \[Pa\].
    pub pressure: f64,
    /// Amplitude of its shear stress \[Pa\].
    pub shear_stress: f64,
}

impl<const D: usize> Fields<D, { place::COUNT }> for WaveOfBoth {
    fn at<N: Number>(&self, x: &[N; D], t: N) -> [N; place::COUNT] {
        let ((first, first_slope), (second, second_slope)) =
            (product(x, [false, true, true]), product(x, [true, false, true]));
        let (sin, cos) = (t * self.frequency).sin_cos();
        let soil = first * sin * self.fraction_amplitude + self.fraction;
        let water = second * cos * self.amplitude - soil + 1.0;
        let (soil_vortices, water_vortices) = (vortices(x, false), vortices(x, true));
        let over = self.frequency / (D as f64 * K);
        let (opening, pressing) = (cos * (self.fraction_amplitude * over), sin * (self.amplitude * over));
        let mut fields = [N::zero(); place::COUNT];
        fields[place::SOIL_FRACTION] = soil;
        fields[place::WATER_DENSITY] = water * self.water_density;
        for a in 0..D {
            fields[place::SOIL_VELOCITY + a] =
                (first_slope[a] * opening + soil_vortices[a] * self.soil_speed) / soil;
            fields[place::WATER_VELOCITY + a] = (water_vortices[a] * self.water_speed
                - first_slope[a] * opening
                - second_slope[a] * pressing)
                / water;
        }
        let (shear, _) = product(x, [true, true, true]);
        let (twist, _) = product(x, [false, false, true]);
        let pressure = (first * cos * 0.2 + 1.0) * self.pressure;
        let rocking = cos * self.shear_stress;
        // xx, yy, zz, xy
        fields[place::STRESS] = shear * rocking - pressure;
        fields[place::STRESS + 1] = shear * rocking * -0.5 - pressure;
        fields[place::STRESS + 2] = shear * rocking * -0.5 - pressure;
        fields[place::STRESS + 3] = twist * rocking;
        fields
    }
}

impl WaveOfBoth {
    /// φ_s \[-\].
    pub fn soil_fraction<const D: usize>(&self, x: &[f64; D], t: f64) -> f64 {
        self.at(x, t)[place::SOIL_FRACTION]
    }
    /// v_s \[m/s\].
    pub fn soil_velocity<const D: usize>(&self, x: &[f64; D], t: f64) -> [f64; D] {
        vector(&self.at(x, t), place::SOIL_VELOCITY)
    }
    /// v_f \[m/s\].
    pub fn water_velocity<const D: usize>(&self, x: &[f64; D], t: f64) -> [f64; D] {
        vector(&self.at(x, t), place::WATER_VELOCITY)
    }
    /// σ \[Pa\].
    pub fn stress<const D: usize>(&self, x: &[f64; D], t: f64) -> SymTensor<f64> {
        SymTensor(vector(&self.at(x, t), place::STRESS))
    }
}

#[cfg(test)]
mod tests {
    use super::super::continuity;
    use super::*;

    #[test]
    fn both_keep_mass() {
        let motion = WaveOfBoth {
            water_density: 1000.0,
            fraction: 0.5,
            fraction_amplitude: 0.1,
            amplitude: 0.01,
            soil_speed: 0.1,
            water_speed: 0.2,
            frequency: 4.0,
            pressure: 1e3,
            shear_stress: 5e2,
        };
        for t in [0.0, 0.31] {
            let soil = continuity(&motion, place::SOIL_FRACTION, place::SOIL_VELOCITY, &[0.13, 0.71, 0.3], t);
            let water = continuity(&motion, place::WATER_DENSITY, place::WATER_VELOCITY, &[0.13, 0.71], t);
            assert!(soil.abs() < 1e-13 && water.abs() < 1e-10, "{soil} {water}");
        }
    }
}
