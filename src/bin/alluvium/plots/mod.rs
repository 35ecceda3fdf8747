//! Pictures of particles, beside the charts of the library.

mod particles;
#[cfg(test)]
mod samples;

pub use alluvium::verify::plot::{Chart, Series, beside, convergence};
pub use particles::{Panel, ParticlePicture};
