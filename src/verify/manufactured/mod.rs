//! Manufactured solutions: a motion is chosen, and what it takes to be exact is given to the particles.
//!
//! The chosen fields are written once, for any number. Dual numbers then give every derivative of them without a
//! formula of its own that could be wrong. Masses of particles never change, so a motion must keep
//! mass by itself, ∂ρ/∂t + ∇·(ρv) = 0; [`continuity`] tells whether it does. The sources are those of momentum and of the soil's stress
//! alone; [`Mixture::with_water_source`](crate::mixture::Mixture::with_water_source) and
//! [`Mixture::with_soil_source`](crate::mixture::Mixture::with_soil_source) take them.
//!
//! Method: Roache (1998), *Verification and Validation in Computational Science and Engineering*.

mod mixture;
mod water;

pub use mixture::{Both, MixtureFields, SoilSource, WaveOfBoth};
pub use water::{SingleFields, WaterLaw, Wave};

use num_dual::{Dual, DualNum};

/// A number that may carry derivatives.
pub trait Number: DualNum<Primitive = f64> + Copy {}
impl<N: DualNum<Primitive = f64> + Copy> Number for N {}

/// `M` fields of place \[m\] and time \[s\], in SI units.
pub trait Fields<const D: usize, const M: usize> {
    /// Their values.
    fn at<N: Number>(&self, x: &[N; D], t: N) -> [N; M];
}

/// Values of fields and their first derivatives, at a place and a time.
#[derive(Clone, Copy, Debug)]
pub struct Derivatives<N, const D: usize, const M: usize> {
    /// The values.
    pub value: [N; M],
    /// ∂/∂t, at the place.
    pub rate: [N; M],
    /// ∂/∂x, the place's components last.
    pub gradient: [[N; D]; M],
}

impl<N: Number, const D: usize, const M: usize> Derivatives<N, D, M> {
    /// The rate of field `m` seen by who moves with that velocity, `∂/∂t + v·∇`.
    pub fn following(&self, m: usize, velocity: &[N]) -> N {
        let carried = self.gradient[m].iter().zip(velocity).map(|(&slope, &v)| slope * v);
        carried.fold(self.rate[m], |sum, part| sum + part)
    }
}

/// Differentiates fields.
pub fn derivatives<F: Fields<D, M>, N: Number, const D: usize, const M: usize>(
    fields: &F,
    x: &[N; D],
    t: N,
) -> Derivatives<N, D, M> {
    // Along one direction at a time: the number of directions, D + 1, is no array's length in stable Rust.
    let along = |direction: usize| {
        let seed =
            |k: usize, at: N| if k == direction { Dual::from_re(at).derivative() } else { Dual::from_re(at) };
        fields.at(&core::array::from_fn(|k| seed(k, x[k])), seed(D, t))
    };
    let in_time = along(D);
    let in_space: [_; D] = core::array::from_fn(along);
    Derivatives {
        value: in_time.map(|field| field.re),
        rate: in_time.map(|field| field.eps),
        gradient: core::array::from_fn(|m| core::array::from_fn(|k| in_space[k][m].eps)),
    }
}

/// What a motion lacks of keeping mass: `∂ρ/∂t + ∇·(ρv)` \[kg/m³/s\] of the density and the velocity whose places
/// among the fields are `density` and `velocity…`. Zero, or the motion is none of particles.
pub fn continuity<F: Fields<D, M>, const D: usize, const M: usize>(
    fields: &F,
    density: usize,
    velocity: usize,
    x: &[f64; D],
    t: f64,
) -> f64 {
    let d = derivatives(fields, x, t);
    let divergence: f64 = (0..D).map(|k| d.gradient[velocity + k][k]).sum();
    d.following(density, &d.value[velocity..velocity + D]) + d.value[density] * divergence
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Product;
    impl Fields<2, 1> for Product {
        fn at<N: Number>(&self, x: &[N; 2], t: N) -> [N; 1] {
            [x[0].sin() * x[1].exp() * t * t]
        }
    }

    #[test]
    fn derivatives_are_those_by_hand() {
        let (x, y, t) = (0.3_f64, -0.2_f64, 1.7_f64);
        let d = derivatives(&Product, &[x, y], t);
        let by_hand = [x.cos() * y.exp() * t * t, x.sin() * y.exp() * t * t];
        assert!((d.rate[0] - 2.0 * t * x.sin() * y.exp()).abs() < 1e-15);
        assert!(d.gradient[0].iter().zip(by_hand).all(|(a, b)| (a - b).abs() < 1e-15));
        let moving = d.rate[0] + 2.0 * by_hand[0] - 3.0 * by_hand[1];
        assert!((d.following(0, &[2.0, -3.0]) - moving).abs() < 1e-15);
    }
}
