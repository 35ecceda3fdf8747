//! Three-dimensional tensors, as the gradient of a velocity is one.

use super::SymTensor;
use crate::real::Num;

/// A three-dimensional second-order tensor, row by row: `t[α][β]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tensor<N>(pub [[N; 3]; 3]);

impl<N: Num> Tensor<N> {
    /// All components zero.
    pub fn zero() -> Self {
        Self([[N::lit(0.0); 3]; 3])
    }
    /// Embeds a `D × D` tensor; the components beyond `D` are zero (plane strain).
    pub fn embed<const D: usize>(t: &[[N; D]; D]) -> Self {
        let mut out = Self::zero();
        for a in 0..D {
            for b in 0..D {
                out.0[a][b] = t[a][b];
            }
        }
        out
    }
    /// Sum of the diagonal.
    pub fn trace(&self) -> N {
        self.0[0][0] + self.0[1][1] + self.0[2][2]
    }
    /// Symmetric part, ½(t + tᵀ).
    pub fn symmetric(&self) -> SymTensor<N> {
        let half = N::lit(0.5);
        let t = &self.0;
        SymTensor([
            t[0][0],
            t[1][1],
            t[2][2],
            half * (t[0][1] + t[1][0]),
            half * (t[1][2] + t[2][1]),
            half * (t[0][2] + t[2][0]),
        ])
    }
    /// Antisymmetric part, ½(t − tᵀ): components xy, yz, xz. Of a velocity gradient it is the spin
    /// \[1/s\], Eq. (35).
    pub fn spin(&self) -> [N; 3] {
        let half = N::lit(0.5);
        let t = &self.0;
        [half * (t[0][1] - t[1][0]), half * (t[1][2] - t[2][1]), half * (t[0][2] - t[2][0])] // (35)
    }
}
