//! Symmetric three-dimensional tensors: stress and strain.

use super::Vector;
use crate::real::Num;
use core::ops::{Add, Mul, Sub};

/// A symmetric three-dimensional tensor: components xx, yy, zz, xy, yz, xz (ParaView's order).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SymTensor<N>(pub [N; 6]);

impl<N: Num> SymTensor<N> {
    /// All components zero.
    #[inline(always)]
    pub fn zero() -> Self {
        Self([N::lit(0.0); 6])
    }
    /// `x` times the unit tensor.
    pub fn isotropic(x: N) -> Self {
        let o = N::lit(0.0);
        Self([x, x, x, o, o, o])
    }
    /// Sum of the diagonal.
    pub fn trace(&self) -> N {
        self.0[0] + self.0[1] + self.0[2]
    }
    /// The tensor less a third of its trace on the diagonal.
    pub fn deviator(&self) -> Self {
        *self - Self::isotropic(self.trace() * N::lit(1.0 / 3.0))
    }
    /// Double contraction `a : b = a^{αβ} b^{αβ}`.
    pub fn double_dot(&self, other: &Self) -> N {
        let (a, b) = (&self.0, &other.0);
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + N::lit(2.0) * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
    }
    /// `√J₂`, the magnitude of the deviator, `J₂ = ½ τ:τ`, Eq. (28).
    pub fn root_j2(&self) -> N {
        let tau = self.deviator();
        (tau.double_dot(&tau) * N::lit(0.5)).sqrt() // (28)
    }
    /// How fast it turns with a spin (xy, yz, xz as of [`Tensor::spin`](super::Tensor::spin)): `ωt − tω`.
    pub fn turning(&self, spin: &[N; 3]) -> Self {
        let ([a, b, c], [xx, yy, zz, xy, yz, xz]) = (*spin, self.0);
        let two = N::lit(2.0);
        Self([
            two * (a * xy + c * xz),
            two * (b * yz - a * xy),
            N::lit(-2.0) * (b * yz + c * xz),
            a * (yy - xx) + b * xz + c * yz,
            b * (zz - yy) - a * xz - c * xy,
            c * (zz - xx) + a * yz - b * xy,
        ])
    }
    /// The nine components, row by row.
    pub(super) fn square(&self) -> [[N; 3]; 3] {
        core::array::from_fn(|a| core::array::from_fn(|b| self.0[Self::index(a, b)]))
    }
    /// Contraction with a vector of the particle space, `t^{αβ} x^β`.
    #[inline(always)]
    pub fn dot<const D: usize>(&self, x: Vector<N, D>) -> Vector<N, D> {
        let mut out = Vector::zero();
        for a in 0..D {
            for b in 0..D {
                out.0[a] += self.0[Self::index(a, b)] * x.0[b];
            }
        }
        out
    }
    /// Position of component (α, β) in the six.
    #[inline(always)]
    pub const fn index(a: usize, b: usize) -> usize {
        const AT: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
        AT[a][b]
    }
}

impl<N: Num> Default for SymTensor<N> {
    fn default() -> Self {
        Self::zero()
    }
}

impl<N: Num> Add for SymTensor<N> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        for k in 0..6 {
            self.0[k] += other.0[k];
        }
        self
    }
}

impl<N: Num> Sub for SymTensor<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        for k in 0..6 {
            self.0[k] -= other.0[k];
        }
        self
    }
}

impl<N: Num> Mul<N> for SymTensor<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, factor: N) -> Self {
        for k in 0..6 {
            self.0[k] *= factor;
        }
        self
    }
}
