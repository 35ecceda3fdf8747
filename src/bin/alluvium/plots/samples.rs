//! Pictures of made-up data: each is whole, and small enough to share.

use super::{Chart, Panel, ParticlePicture, Series, beside, convergence};
use std::path::PathBuf;

/// Where pictures go if `ALLUVIUM_SAMPLES` names a folder: to look at.
fn keep(name: &str, svg: &str) {
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    if let Some(folder) = std::env::var_os("ALLUVIUM_SAMPLES") {
        std::fs::write(PathBuf::from(folder).join(name), svg).unwrap();
    }
}

fn slump(time: f64) -> Panel {
    let spacing = 0.00125;
    let (width, height) = (0.1 * (1.0 + 12.0 * time), 0.2 / (1.0 + 4.0 * time));
    let cells = |length: f64| (length / spacing) as usize;
    let surface = |x: f64| height * (1.0 - (x / width).powi(2));
    let place = |n: usize| (n as f64 + 0.5) * spacing;
    let water = (0..cells(width)).flat_map(|i| {
        let x = place(i);
        (0..cells(surface(x))).map(move |j| ([x, place(j)], 9.81 * (surface(x) - place(j))))
    });
    let floor = (0..330).flat_map(|i| (1..4).map(move |j| [place(i) - 0.005, -place(j - 1)]));
    Panel {
        caption: format!("t = {time:.2} s"),
        layers: vec![water.collect()],
        walls: floor.collect(),
        lines: Vec::new(),
    }
}

#[test]
fn particles() {
    let picture = ParticlePicture {
        quantity: "pressure [kPa]",
        range: (0.0, 2.0),
        window: ([-0.01, -0.01], [0.41, 0.25]),
        spacing: 0.00125,
        axes: ["x [m]", "y [m]"],
        columns: 2,
    };
    let svg = picture.svg(&[0.0, 0.05, 0.1, 0.2].map(slump));
    assert!(svg.len() < 1_000_000, "{} bytes", svg.len());
    keep("particles.svg", &svg);
    keep("particles_one.svg", &picture.svg(&[slump(0.1)]));
    let strain = ParticlePicture { quantity: "strain [-]", range: (0.01, 2.0), ..picture };
    let strains = strain.svg_logarithmic(&[0.0, 0.1].map(slump));
    assert!(strains.contains(">0.01<") && strains.contains(">0.1<"));
    keep("particles_logarithmic.svg", &strains);
}

#[test]
fn curves() {
    let t: Vec<f64> = (0..=300).map(|n| 0.01 * f64::from(n)).collect();
    let curve = |f: &dyn Fn(f64) -> f64| t.iter().map(|t| (*t, f(*t))).collect::<Vec<_>>();
    let some = |f: &dyn Fn(f64) -> f64| t.iter().step_by(30).map(|t| (*t, f(*t))).collect::<Vec<_>>();
    let chart = Chart::new("Dam break: the front", "T = t √(2g/L)", "X = x/L")
        .with(Series::line("alluvium, Δx = 1.25 mm", curve(&|t| 1.0 + 0.36 * t.powf(1.9))))
        .with(Series::points("Martin & Moyce 1952, n² = 2", some(&|t| 1.0 + 0.33 * t.powf(1.9))))
        .with(Series::points("Koshizuka & Oka 1996, experiment", some(&|t| 1.0 + 0.31 * t.powf(1.9))))
        .with(Series::points("Koshizuka & Oka 1996, MPS", some(&|t| 1.0 + 0.4 * t.powf(1.9))));
    keep("front.svg", &chart.svg());
    let part = |f: &dyn Fn(f64) -> f64| t.iter().map(|t| f(*t)).collect::<Vec<_>>();
    let parts = [
        ("potential", part(&|t| 1.0 / (1.0 + t))),
        ("kinetic", part(&|t| 0.8 * (1.0 - 1.0 / (1.0 + t)))),
        ("artificial viscosity", part(&|t| 0.12 * (1.0 - 1.0 / (1.0 + t)))),
        ("density diffusion", part(&|t| 0.08 * (1.0 - 1.0 / (1.0 + t)))),
    ];
    let budget = Chart::new("Where the energy is", "time [s]", "energy / initial potential energy")
        .with_all(Series::stack(&t, &parts));
    keep("energy.svg", &budget.y_range(0.0, 1.1).svg());
    let steps = Chart::new("Time step", "time [s]", "Δt [s]")
        .logarithmic(false, true)
        .with(Series::line("acoustic", curve(&|_| 1.3e-5)))
        .with(Series::dashed("force", curve(&|t| 2e-4 / (1.0 + t))));
    keep("steps.svg", &steps.svg());
    let errors = [(0.01, 0.11), (0.005, 0.068), (0.0025, 0.041), (0.00125, 0.022)];
    let (svg, _) =
        convergence("Error against the volume-of-fluid reference", "Δx [m]", "L₂ error (78)", &errors, 1.0);
    keep("convergence.svg", &svg);
    let two = beside(&[chart, steps]);
    assert_eq!(two.matches("</svg>").count(), 3);
    keep("two.svg", &two);
}
