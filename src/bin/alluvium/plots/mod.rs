//! Pictures, as SVG: vector graphics that open everywhere and need no fonts or libraries.

mod canvas;
mod chart;
mod colour;
mod convergence;
mod particles;
#[cfg(test)]
mod samples;
mod scale;

pub use chart::{Chart, Series, beside};
pub use convergence::convergence;
pub use particles::{Panel, ParticlePicture};
