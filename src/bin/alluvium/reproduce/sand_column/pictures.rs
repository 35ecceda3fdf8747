//! Surface and failure line, plastic strain.

use super::{Beside, FLOOR, Published, Run};
use crate::plots::{Chart, Panel, ParticlePicture, Series};
use alluvium::case::Case;
use alluvium::verify::sand_column::{Grain, HEIGHT, Pile, WIDTH};

/// Final surface and failure line over the measured ones.
pub fn surface(run: &Run, beside: Option<&Beside>, published: &Published, case: &Case) -> String {
    let spacing = case.particles.spacing * 1e3;
    let start = vec![(0.0, HEIGHT), (WIDTH, HEIGHT), (WIDTH, 0.0)];
    let mut chart = Chart::new("Sand column: final surface and failure line", "x [m]", "y [m]")
        .x_range(0.0, 0.6)
        .y_range(0.0, 0.14)
        .with(Series::dashed("at the start", start).coloured("#999999"));
    if let Some(beside) = beside {
        let profile = beside.run.surface.points().to_vec();
        chart = chart.with(Series::dashed("ψ = θ, the paper's flow rule", profile).coloured("#56b4e9"));
    }
    chart
        .with(
            Series::line(&format!("surface, Δx = {spacing} mm"), run.surface.points().to_vec())
                .coloured("#0072b2"),
        )
        .with(Series::line("failure line", run.failure.points().to_vec()).coloured("#d55e00"))
        .with(
            Series::points("surface, Bui et al. 2008", published.surface.points().to_vec())
                .coloured("#0072b2"),
        )
        .with(
            Series::points("failure line, Bui et al. 2008", published.failure.points().to_vec())
                .coloured("#d55e00"),
        )
        .svg()
}

/// Equivalent plastic strain at the dumps after the start.
pub fn plastic_strain(run: &Run) -> String {
    strain(run, "equivalent plastic strain [-]", |grain| grain.plastic_strain)
}

/// Plastic shear strain (79) at the same dumps.
pub fn plastic_shear(run: &Run) -> String {
    strain(run, "plastic shear strain |ε_p^xy| [-]", |grain| grain.plastic_shear.abs())
}

fn strain(run: &Run, quantity: &'static str, of: impl Fn(&Grain) -> f64) -> String {
    let spacing = run.piles.first().map_or(SMALLEST, |(_, pile)| pile.spacing());
    let picture = ParticlePicture {
        quantity,
        range: (0.01, 2.0),
        window: ([-0.005, -0.005], [FLOOR, 0.13]),
        spacing,
        axes: ["x [m]", "y [m]"],
        columns: 2,
    };
    let grains = |pile: &Pile| pile.grains().iter().map(|grain| (grain.place, of(grain))).collect();
    let panel = |(time, pile): &(f64, Pile)| Panel {
        caption: format!("t = {time:.2} s"),
        layers: vec![grains(pile)],
        walls: Vec::new(),
        lines: Vec::new(),
    };
    picture.svg_logarithmic(&run.piles.iter().skip(1).map(panel).collect::<Vec<_>>())
}

/// A diameter \[m\] where there is nothing to draw.
const SMALLEST: f64 = 1e-3;
