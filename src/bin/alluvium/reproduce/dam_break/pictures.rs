//! Front, energy, time step, particles.

use super::Results;
use crate::plots::{Chart, Panel, ParticlePicture, Series};
use crate::solver::View;
use alluvium::verify::dam_break::{TANK, WIDTH, dimensionless_time};

/// The front against published data.
pub fn front(results: &Results, spacing: f64) -> String {
    let name = format!("alluvium, Δx = {} mm", spacing * 1e3);
    let computed = results.front.between(0.0, 3.4).points().to_vec();
    let chart = Chart::new("Dam break: the front", "T = t √(2g/L)", "X = x/L")
        .x_range(0.0, 3.4)
        .y_range(0.8, 4.4)
        .with(Series::line(&name, computed));
    let far_wall = Series::dashed("far wall of the tank", vec![(2.3, TANK / WIDTH), (3.4, TANK / WIDTH)]);
    let series = |(name, curve): &(&str, _)| Series::points(name, points(curve));
    results.published.iter().map(series).fold(chart, Chart::with).with(far_wall.coloured("#999999")).svg()
}

fn points(curve: &alluvium::verify::dam_break::Curve) -> Vec<(f64, f64)> {
    curve.points().to_vec()
}

/// The step in time, where nothing but the equations bounded it, and which limits did.
pub fn time_step(results: &Results) -> String {
    let steps: Vec<_> = results.steps.iter().map(|(time, step, _)| (*time, step * 1e6)).collect();
    let longest = steps.iter().map(|(_, step)| *step).fold(0.0, f64::max);
    let mut limits: Vec<&str> = results.steps.iter().map(|(.., limit)| limit.as_str()).collect();
    limits.sort_unstable();
    limits.dedup();
    Chart::new("Dam break: the time step", "time [s]", "Δt [µs]")
        .x_range(0.0, results.time.last().copied().unwrap_or(1.0))
        .y_range(0.0, 1.2 * longest)
        .with(Series::line(&format!("bound by: {}", limits.join(", ")), steps))
        .svg()
}

/// Pressure at the paper's times.
pub fn particles(views: &[(f64, View)], spacing: f64) -> String {
    let picture = ParticlePicture {
        quantity: "pressure [kPa]",
        range: (0.0, 2.0),
        window: ([-0.01, -0.01], [0.41, 0.25]),
        spacing,
        axes: ["x [m]", "y [m]"],
        columns: 2,
    };
    let flat = |x: &[f64; 3]| [x[0], x[1]];
    let panel = |(time, view): &(f64, View)| Panel {
        caption: format!("t = {time:.2} s, T = {:.2}", dimensionless_time(*time)),
        layers: vec![view.water.iter().map(|seen| (flat(&seen.place), seen.pressure * 1e-3)).collect()],
        walls: view.walls.iter().map(flat).collect(),
        lines: Vec::new(),
    };
    let shown = views.iter().filter(|(time, _)| *time > 0.04 && *time < 0.35);
    picture.svg(&shown.map(panel).collect::<Vec<_>>())
}
