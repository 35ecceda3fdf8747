//! Pictures, as SVG: vector graphics that open everywhere and need no fonts or libraries.

mod canvas;
mod chart;
mod colour;
mod convergence;
mod legend;
mod scale;

pub use canvas::{Anchor, Canvas, Stroke};
pub use chart::{Chart, Series, beside};
pub use colour::viridis;
pub use convergence::{convergence, convergence_chart};
pub use scale::Scale;
