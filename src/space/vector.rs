//! Vectors of the particle space, of numbers or of SIMD lanes.

use crate::real::{Num, Real};
use core::ops::{Add, AddAssign, Index, IndexMut, Mul, MulAssign, Neg, Sub, SubAssign};

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
