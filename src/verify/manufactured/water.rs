//! Water alone.

use super::{Derivatives, Fields, Number, derivatives};
use core::f64::consts::PI;

/// Density and velocity \[ρ, v_x, v_y, v_z\]; in 2D the last is zero.
pub trait SingleFields<const D: usize>: Fields<D, 4> {}
impl<F: Fields<D, 4>, const D: usize> SingleFields<D> for F {}

/// The law of water, once more and by itself: Tait's pressure (16) and Newton's viscosity (14).
#[derive(Clone, Copy, Debug)]
pub struct WaterLaw {
    /// ρ̃₀ \[kg/m³\].
    pub reference_density: f64,
    /// c \[m/s\].
    pub sound_speed: f64,
    /// μ \[Pa s\].
    pub viscosity: f64,
}

/// χ of (16).
const EXPONENT: i32 = 7;

impl WaterLaw {
    /// p \[Pa\] (16) at a true density over ρ̃₀.
    pub fn pressure<N: Number>(&self, density_ratio: N) -> N {
        let stiffness = self.reference_density * self.sound_speed * self.sound_speed / f64::from(EXPONENT);
        (density_ratio.powi(EXPONENT) - 1.0) * stiffness // (16), (17)
    }

    /// The acceleration \[m/s²\] that makes the motion exact: `Dv/Dt + ∇p/ρ − ∇·τ/ρ`.
    pub fn source<F: SingleFields<D>, const D: usize>(&self, flow: &F, x: &[f64; D], t: f64) -> [f64; D] {
        let d = derivatives(flow, x, t);
        let stress = derivatives(&Stresses { flow, law: self }, x, t);
        core::array::from_fn(|k| {
            let pull: f64 = (0..D).map(|l| stress.gradient[3 * k + l][l]).sum();
            d.following(1 + k, &d.value[1..=D]) - pull / d.value[0]
        })
    }
}

/// Cauchy stress −p I + τ of a flow, by rows.
struct Stresses<'a, F> {
    flow: &'a F,
    law: &'a WaterLaw,
}

impl<F: SingleFields<D>, const D: usize> Fields<D, 9> for Stresses<'_, F> {
    fn at<N: Number>(&self, x: &[N; D], t: N) -> [N; 9] {
        let d: Derivatives<N, D, 4> = derivatives(self.flow, x, t);
        let slope = |a: usize, b: usize| if a < D && b < D { d.gradient[1 + a][b] } else { N::zero() };
        let third = (0..3).fold(N::zero(), |sum, a| sum + slope(a, a)) / 3.0;
        let pressure = self.law.pressure(d.value[0] / self.law.reference_density);
        core::array::from_fn(|place| {
            let (a, b) = (place / 3, place % 3);
            let shear = (slope(a, b) + slope(b, a)) * self.law.viscosity; // (14), (15)
            if a == b { shear - third * (2.0 * self.law.viscosity) - pressure } else { shear }
        })
    }
}

/// A standing wave of density on a flow of vortices, in a box of edge one that repeats itself.
///
/// $$\rho = \rho_0(1 + \epsilon R\cos\omega t),\qquad \rho\mathbf v = \rho_0\Big(U\,\nabla\times\chi -
/// \frac{\epsilon\omega\sin\omega t}{D k^2}\nabla R\Big),\qquad \nabla^2R = -Dk^2R$$
#[derive(Clone, Copy, Debug)]
pub struct Wave {
    /// ρ₀ \[kg/m³\].
    pub density: f64,
    /// ε \[-\].
    pub amplitude: f64,
    /// U \[m/s\].
    pub speed: f64,
    /// ω \[1/s\].
    pub frequency: f64,
}

/// Wave number of one wave in the box \[1/m\].
pub(super) const K: f64 = 2.0 * PI;

/// A product of sines and cosines of all coordinates, cosine where `even`, and its gradient over k.
pub(super) fn product<N: Number, const D: usize>(x: &[N; D], even: [bool; 3]) -> (N, [N; D]) {
    let factor = |a: usize| if even[a] { (x[a] * K).cos() } else { (x[a] * K).sin() };
    let slope = |a: usize| if even[a] { -(x[a] * K).sin() } else { (x[a] * K).cos() };
    let times = |by: usize| (0..D).fold(N::one(), |p, a| p * if a == by { slope(a) } else { factor(a) });
    (times(D), core::array::from_fn(times))
}

/// The curl of `χ = sin kx sin ky / k`, or of `cos kx cos ky / k` if `even`, in the plane of x and y.
pub(super) fn vortices<N: Number, const D: usize>(x: &[N; D], even: bool) -> [N; D] {
    let ((sx, cx), (sy, cy)) = ((x[0] * K).sin_cos(), (x[1] * K).sin_cos());
    let mut v = [N::zero(); D];
    (v[0], v[1]) = if even { (-(cx * sy), sx * cy) } else { (sx * cy, -(cx * sy)) };
    v
}

impl<const D: usize> Fields<D, 4> for Wave {
    fn at<N: Number>(&self, x: &[N; D], t: N) -> [N; 4] {
        let (r, slope) = product(x, [true, false, true]);
        let (sin, cos) = (t * self.frequency).sin_cos();
        let ratio = r * cos * self.amplitude + 1.0;
        let vortices = vortices(x, false);
        let rocking = sin * (-self.amplitude * self.frequency / (D as f64 * K));
        let mut fields = [N::zero(); 4];
        fields[0] = ratio * self.density;
        for a in 0..D {
            fields[1 + a] = (vortices[a] * self.speed + slope[a] * rocking) / ratio;
        }
        fields
    }
}

#[cfg(test)]
mod tests {
    use super::super::continuity;
    use super::*;

    fn wave() -> Wave {
        Wave { density: 1000.0, amplitude: 0.1, speed: 0.3, frequency: 5.0 }
    }

    #[test]
    fn the_wave_keeps_mass() {
        let scale = 1000.0 * 0.1 * 5.0;
        assert!(continuity(&wave(), 0, 1, &[0.13, 0.71], 0.2).abs() < 1e-13 * scale);
        assert!(continuity(&wave(), 0, 1, &[0.13, 0.71, 0.4], 0.2).abs() < 1e-13 * scale);
    }

    #[test]
    fn vortices_alone_need_what_viscosity_takes() {
        // Steady vortices of constant density: v·∇v = ∇(…), and −∇·τ/ρ = 2 ν k² v.
        let law = WaterLaw { reference_density: 1000.0, sound_speed: 10.0, viscosity: 2.0 };
        let flow = Wave { amplitude: 0.0, ..wave() };
        let (x, y) = (0.13 * K, 0.71 * K);
        let source = law.source(&flow, &[0.13, 0.71], 0.4);
        let (u, v) = (0.3 * x.sin() * y.cos(), -0.3 * x.cos() * y.sin());
        let turning = |sine: f64| 0.5 * 0.09 * K * sine;
        let expected = [
            turning((2.0 * x).sin()) + 2.0 * 0.002 * K * K * u,
            turning((2.0 * y).sin()) + 2.0 * 0.002 * K * K * v,
        ];
        assert!(source.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{source:?} {expected:?}");
    }
}
