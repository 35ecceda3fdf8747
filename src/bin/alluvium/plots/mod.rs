//! Pictures, as SVG: vector graphics that open everywhere and need no fonts or libraries.

mod canvas;
mod chart;
mod colour;
#[cfg_attr(not(test), expect(dead_code, reason = "the convergence study will draw it"))]
mod convergence;
mod particles;
#[cfg(test)]
mod samples;
mod scale;

pub use chart::{Chart, Series};
#[cfg_attr(not(test), expect(unused_imports, reason = "the convergence study will draw it"))]
pub use convergence::convergence;
pub use particles::{Panel, ParticlePicture};
