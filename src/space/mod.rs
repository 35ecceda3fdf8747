//! Vectors of the particle space (2D or 3D) and three-dimensional tensors.
//!
//! Stress and strain are always three-dimensional; two dimensions mean plane strain, embedded.

mod dense;
mod principal;
mod sym_tensor;
mod tensor;
mod vector;

pub(crate) use dense::Dense;
pub(crate) use principal::Principal;
pub use sym_tensor::SymTensor;
pub use tensor::Tensor;
pub use vector::Vector;
