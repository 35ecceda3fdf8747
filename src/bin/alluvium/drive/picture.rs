//! The stress path, and stress over strain.

use super::{Answer, DriveOptions, PathName};
use crate::plots::{Chart, Series, beside};

/// Both, side by side, in kPa.
pub fn svg(options: &DriveOptions, answer: &Answer) -> String {
    beside(&[stress_path(options, answer), stress_strain(options, answer)])
}

fn title(options: &DriveOptions) -> String {
    match options.path {
        PathName::Oedometer => "Oedometer",
        PathName::TriaxialCompression => "Triaxial compression",
        PathName::TriaxialExtension => "Triaxial extension",
        PathName::SimpleShear => "Simple shear",
        PathName::PureShear => "Pure shear",
        PathName::Isotropic => "Isotropic compression",
        PathName::Rotation => "Rotation",
        PathName::Cyclic => "Cyclic simple shear",
        PathName::Own => "Own path",
    }
    .to_owned()
}

/// q over p, with a mark at the start.
fn stress_path(options: &DriveOptions, answer: &Answer) -> Chart {
    let (p, root) = (answer.kilo("pressure [Pa]"), answer.kilo("root_j2 [Pa]"));
    let path: Vec<_> = p.into_iter().zip(root).map(|(p, root)| (p, 3_f64.sqrt() * root)).collect();
    let first: Vec<_> = path.first().copied().into_iter().collect();
    let (title, x) = (format!("{}: stress path", title(options)), "mean pressure p [kPa]");
    // What is all rounding shall not fill an axis.
    let largest = path.iter().map(|p| p.0.abs().max(p.1)).fold(0.0, f64::max).max(1e-9);
    let range = |of: fn(&(f64, f64)) -> f64| {
        let low = path.iter().map(of).fold(0.0, f64::min);
        let high = path.iter().map(of).fold(0.0, f64::max).max(low + 0.1 * largest);
        let room = 0.04 * (high - low);
        (low - room, high + room)
    };
    let (along, up) = (range(|p| p.0), range(|p| p.1));
    Chart::new(&title, x, "q = √(3J₂) [kPa]")
        .x_range(along.0, along.1)
        .y_range(up.0, up.1)
        .with(Series::line("path", path))
        .with(Series::points("start", first))
}

fn stress_strain(options: &DriveOptions, answer: &Answer) -> Chart {
    let (label, per_unit, shown) = match options.path {
        PathName::Oedometer => ("axial shortening [-]", 1.0, ["zz", "xx"].as_slice()),
        PathName::TriaxialCompression => ("axial shortening [-]", 1.0, ["zz", "xx"].as_slice()),
        PathName::TriaxialExtension => ("axial lengthening [-]", 1.0, ["zz", "xx"].as_slice()),
        PathName::Isotropic => ("volume lost [-]", 1.0, ["zz"].as_slice()),
        PathName::Rotation => ("angle [°]", 1_f64.to_degrees(), ["xx", "yy", "xy"].as_slice()),
        PathName::Own => ("legs gone [-]", 1.0, ["xx", "yy", "zz", "xy"].as_slice()),
        PathName::SimpleShear | PathName::PureShear | PathName::Cyclic => {
            ("shear strain γ [-]", 1.0, ["xy", "xx", "yy"].as_slice())
        }
    };
    let chart = Chart::new("Stress, positive in tension", label, "σ [kPa]");
    let series = |component: &&str| {
        let stress = answer.kilo(&format!("stress_{component} [Pa]"));
        let points = answer.amounts.iter().map(|amount| amount * per_unit).zip(stress).collect();
        Series::line(&format!("σ_{component}"), points)
    };
    shown.iter().map(series).fold(chart, Chart::with)
}
