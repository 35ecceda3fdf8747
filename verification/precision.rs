//! Single precision against double, resolution by resolution.

use crate::motions::{Run, WATER, alone, errors_alone, fluid};
use alluvium::Real;
use alluvium::time::VelocityVerlet;
use alluvium::verify::plot::{Chart, Series};
use alluvium::verify::{Expected, Level, Measured, Study};

const SOURCE: &str = "the same run in double precision";

pub fn studies() -> Vec<Study> {
    vec![
        precision("precision/manufactured/h = 2 dx", &[12, 24, 48], 2.0)
            .expect(Expected::Bound { largest: 1e-3 })
            .level(Level::Quick),
        precision("precision/manufactured/h = 2 dx/fine", &[16, 32, 64, 96], 2.0)
            .expect(Expected::Bound { largest: 1e-3 })
            .level(Level::Full),
        // At h = dx disorder grows, out of nothing but rounding: by 64 particles single precision is lost.
        precision("precision/manufactured/h = dx", &[16, 32, 48], 1.0)
            .expect(Expected::Bound { largest: 0.1 })
            .level(Level::Full),
    ]
}

fn precision(name: &str, sides: &'static [usize], ratio: f64) -> Study {
    let title = name.to_owned();
    Study::new(
        name,
        "manufactured flow of water has the same error in single precision as in double (values: relative difference \
         of the two errors, by particles along an edge)",
        move |_| {
            let (single, double) = (errors::<f32>(sides, ratio), errors::<f64>(sides, ratio));
            let difference = |k: usize| (format!("{}", sides[k]), single[k].1 / double[k].1 - 1.0);
            Measured::values((0..sides.len()).map(difference)).picture(
                &Chart::new(&title, "resolution [m]", "relative error of the velocity [-]")
                    .logarithmic(true, true)
                    .with(Series::line("f64", double.clone()))
                    .with(Series::points("f32", single)),
            )
        },
    )
    .equations(&["52", "58"])
    .source(SOURCE)
}

/// Errors of the velocity at each resolution.
fn errors<T: Real>(sides: &[usize], ratio: f64) -> Vec<(f64, f64)> {
    let error = |&side: &usize| {
        let mixture = alone::<T, 2>(Run::new(side, ratio), fluid(WATER.viscosity), VelocityVerlet::new());
        (1.0 / side as f64, errors_alone(&mixture)[0])
    };
    sides.iter().map(error).collect()
}
