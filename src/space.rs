//! Vectors of the particle space (2D or 3D) and three-dimensional tensors.
//!
//! Stress and strain are always three-dimensional; two dimensions mean plane strain, embedded.

use crate::real::{Num, Real};
use core::ops::{Add, AddAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign};
use nalgebra::SMatrix;

/// A vector in `D` dimensions, of numbers or of SIMD lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Vector<N, const D: usize>(pub [N; D]);

impl<N: Num, const D: usize> Vector<N, D> {
    /// All components zero.
    #[inline(always)]
    pub fn zero() -> Self {
        Self([N::lit(0.0); D])
    }
    /// All components equal.
    #[inline(always)]
    pub fn splat(x: N) -> Self {
        Self([x; D])
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> N {
        let mut sum = self.0[0] * other.0[0];
        for k in 1..D {
            sum += self.0[k] * other.0[k];
        }
        sum
    }
    /// Squared length.
    #[inline(always)]
    pub fn norm2(self) -> N {
        self.dot(self)
    }
    /// Length.
    #[inline(always)]
    pub fn norm(self) -> N {
        self.norm2().sqrt()
    }
    /// The same vector in every lane.
    #[inline(always)]
    pub fn spread(x: &Vector<N::Scalar, D>) -> Self {
        let mut out = Self::zero();
        for k in 0..D {
            out.0[k] = N::splat(x.0[k]);
        }
        out
    }
}

impl<T: Real, const D: usize> Vector<T, D> {
    /// Rounds the components of a double-precision vector.
    pub fn of(x: [f64; D]) -> Self {
        Self(x.map(T::of))
    }
    /// The components in double precision.
    pub fn as_f64(&self) -> [f64; D] {
        self.0.map(T::as_f64)
    }
    /// No component is infinite or NaN.
    pub fn is_finite(&self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
}

impl<N: Num, const D: usize> Default for Vector<N, D> {
    fn default() -> Self {
        Self::zero()
    }
}

impl<N, const D: usize> Index<usize> for Vector<N, D> {
    type Output = N;
    #[inline(always)]
    fn index(&self, k: usize) -> &N {
        &self.0[k]
    }
}

impl<N, const D: usize> IndexMut<usize> for Vector<N, D> {
    #[inline(always)]
    fn index_mut(&mut self, k: usize) -> &mut N {
        &mut self.0[k]
    }
}

impl<N: Num, const D: usize> AddAssign for Vector<N, D> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        for k in 0..D {
            self.0[k] += other.0[k];
        }
    }
}

impl<N: Num, const D: usize> SubAssign for Vector<N, D> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        for k in 0..D {
            self.0[k] -= other.0[k];
        }
    }
}

impl<N: Num, const D: usize> MulAssign<N> for Vector<N, D> {
    #[inline(always)]
    fn mul_assign(&mut self, factor: N) {
        for k in 0..D {
            self.0[k] *= factor;
        }
    }
}

impl<N: Num, const D: usize> Add for Vector<N, D> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<N: Num, const D: usize> Sub for Vector<N, D> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl<N: Num, const D: usize> Mul<N> for Vector<N, D> {
    type Output = Self;
    #[inline(always)]
    fn mul(mut self, factor: N) -> Self {
        self *= factor;
        self
    }
}

impl<N: Num, const D: usize> Neg for Vector<N, D> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::zero() - self
    }
}

#[cfg(feature = "serde")]
impl<N: serde::Serialize, const D: usize> serde::Serialize for Vector<N, D> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeTuple;
        let mut tuple = serializer.serialize_tuple(D)?;
        for x in &self.0 {
            tuple.serialize_element(x)?;
        }
        tuple.end()
    }
}

#[cfg(feature = "serde")]
impl<'de, N: serde::Deserialize<'de>, const D: usize> serde::Deserialize<'de> for Vector<N, D> {
    fn deserialize<S: serde::Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        struct Components<N, const D: usize>(core::marker::PhantomData<N>);
        impl<'de, N: serde::Deserialize<'de>, const D: usize> serde::de::Visitor<'de> for Components<N, D> {
            type Value = Vector<N, D>;
            fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "{D} components")
            }
            fn visit_seq<A: serde::de::SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
                let mut components = Vec::with_capacity(D);
                while let Some(x) = seq.next_element()? {
                    components.push(x);
                }
                let count = components.len();
                let array =
                    components.try_into().map_err(|_| serde::de::Error::invalid_length(count, &self))?;
                Ok(Vector(array))
            }
        }
        deserializer.deserialize_tuple(D, Components(core::marker::PhantomData))
    }
}

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
    /// How fast it turns with a spin (xy, yz, xz as of [`Tensor::spin`]): `ωt − tω`.
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
    fn square(&self) -> [[N; 3]; 3] {
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

/// Principal values, largest first, and their directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Principal<T> {
    pub(crate) values: [T; 3],
    directions: [[T; 3]; 3],
}

impl<T: Real> Principal<T> {
    /// Of a tensor; `None` if it holds a number that is not finite.
    pub(crate) fn of(tensor: &SymTensor<T>) -> Option<Self> {
        let (values, directions) = T::eigen(&tensor.square())?;
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| values[b].partial_cmp(&values[a]).unwrap_or(core::cmp::Ordering::Equal));
        Some(Self { values: order.map(|k| values[k]), directions: order.map(|k| directions[k]) })
    }
    /// The tensor with these values along the same directions.
    pub(crate) fn with(&self, values: &[T; 3]) -> SymTensor<T> {
        let mut out = SymTensor::zero();
        for (n, &value) in self.directions.iter().zip(values) {
            let [x, y, z] = *n;
            out = out + SymTensor([x * x, y * y, z * z, x * y, y * z, x * z]) * value;
        }
        out
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

/// Dense linear algebra on `D × D` matrices, done by nalgebra: the one place its bounds appear.
pub(crate) trait Dense: Sized {
    /// The inverse, or `None` for a singular matrix.
    fn inverse<const D: usize>(m: &[[Self; D]; D]) -> Option<[[Self; D]; D]>;
    /// Eigenvalues of a symmetric matrix with their directions, each of length one; `None` if they
    /// are not found, as for numbers that are not finite.
    fn eigen(m: &[[Self; 3]; 3]) -> Option<([Self; 3], [[Self; 3]; 3])>;
}

macro_rules! dense {
    ($t:ident) => {
        impl Dense for $t {
            fn inverse<const D: usize>(m: &[[$t; D]; D]) -> Option<[[$t; D]; D]> {
                let m = SMatrix::<$t, D, D>::from_fn(|row, column| m[row][column]);
                let inverse = m.try_inverse()?;
                let mut out = [[0.0; D]; D];
                for (row, values) in out.iter_mut().enumerate() {
                    for (column, value) in values.iter_mut().enumerate() {
                        *value = inverse[(row, column)];
                    }
                }
                Some(out)
            }
            fn eigen(m: &[[$t; 3]; 3]) -> Option<([$t; 3], [[$t; 3]; 3])> {
                let m = SMatrix::<$t, 3, 3>::from_fn(|row, column| m[row][column]);
                let found = nalgebra::SymmetricEigen::try_new(m, $t::EPSILON, 100)?;
                let direction = |k: usize| core::array::from_fn(|axis| found.eigenvectors[(axis, k)]);
                let all_finite = found.eigenvalues.iter().all(|value| value.is_finite());
                all_finite.then(|| (found.eigenvalues.into(), core::array::from_fn(direction)))
            }
        }
    };
}
dense!(f32);
dense!(f64);
