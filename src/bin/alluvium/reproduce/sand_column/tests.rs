//! The case is the paper's, and what is drawn and told of a run.

use super::*;
use crate::arguments::{Existing, PrecisionName};
use crate::run::run_with;
use crate::stand_in::{self, StandIn};
use alluvium::verify::sand_column::Grain;

fn options(preset: PresetName) -> ReproduceOptions {
    let output = OutputOptions { out: None, existing: Existing::Error, threads: None };
    let (name, precision) = ("sand-column".to_owned(), PrecisionName::F64);
    ReproduceOptions { name, quick: false, preset, precision, spacing: None, output }
}

#[test]
fn the_case_is_the_papers() {
    for preset in [PresetName::Default, PresetName::Paper] {
        let options = options(preset);
        let column = Column::of_the_paper(&options);
        let (case, _) = column.case(&options).unwrap();
        assert_eq!((case.soil_particles(), case.end_time), (12_800, 1.0));
        let (coarse, _) = Column { spacing: 4.0 * SPACING, ..column }.case(&options).unwrap();
        assert_eq!(coarse.soil_particles(), 800);
        let dilatancy = if preset == PresetName::Paper { FRICTION_ANGLE } else { 0.0 };
        assert_eq!(column.dilatancy, dilatancy);
    }
}

/// A column that becomes a wedge twice as long within a second; what was within 0.1 m stays.
fn pile(time: f64) -> Pile {
    let spacing = 0.005;
    let grain = |n: u32| {
        let (x, y) = (f64::from(n % 40) + 0.5, f64::from(n / 40) + 0.5);
        let (x, y) = (x * spacing, y * spacing);
        let far = (x + y - 0.1).max(0.0) * time;
        let place = [x + far, y * (1.0 - 0.5 * far / 0.2)];
        Grain {
            id: n,
            place,
            volume: spacing * spacing,
            speed: 0.0,
            pressure: 900.0,
            plastic_strain: 5.0 * far,
            plastic_shear: -4.0 * far,
        }
    };
    Pile::new(Section::FLAT, spacing, (0..800).map(grain).collect())
}

fn watched(end: f64) -> Watch {
    let times = [0.0, 0.1, 0.2, 0.3, 0.5, 1.0].into_iter();
    Watch { piles: times.filter(|time| *time <= end).map(|time| (time, pile(time))).collect() }
}

#[test]
fn a_run_is_compared_and_drawn() {
    let path = stand_in::folder("sand-column");
    let output = OutputOptions { out: Some(path.clone()), existing: Existing::Error, threads: Some(1) };
    let (case, warnings) = stand_in::case();
    let new = |_: &Case| Ok(Box::new(StandIn::new(f64::INFINITY)) as _);
    let finished = run_with(new, case.clone(), &warnings, &output, &mut |_, _| {}).unwrap();
    let stopped = Some("particle 7 left".to_owned());
    let beside = Beside { run: Run::of(&watched(0.5)), stopped };
    let published = Published::read().unwrap();
    present(&case, finished, &Run::of(&watched(1.0)), Some(&beside), &published).unwrap();
    let report = std::fs::read_to_string(path.join("report.md")).unwrap();
    for part in ["| yes |", "| **no** |", "0.90 kPa", "particle 7 left", "32.9°, foot 0.179 m", "0.314 m"] {
        assert!(report.contains(part), "{part} is missing:\n{report}");
    }
    for picture in ["surface", "energy", "plastic_strain", "plastic_shear", "plastic_strain_associated"] {
        let svg = std::fs::read_to_string(path.join(format!("pictures/{picture}.svg"))).unwrap();
        assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"), "{picture}");
        if let Some(folder) = std::env::var_os("ALLUVIUM_SAMPLES") {
            std::fs::write(std::path::PathBuf::from(folder).join(format!("sand_{picture}.svg")), svg)
                .unwrap();
        }
    }
    std::fs::remove_dir_all(&path).unwrap();
}

#[test]
fn run_out_is_drawn_over_the_laws() {
    let svg = run_out::picture(&[(0.5, 1.0), (1.0, 2.6), (2.0, 5.1)], 0.0025);
    for source in ["Lube", "Lajeunesse", "Lagrée", "Nguyen"] {
        assert_eq!(svg.matches(source).count(), 1, "{source}");
    }
    if let Some(folder) = std::env::var_os("ALLUVIUM_SAMPLES") {
        std::fs::write(std::path::PathBuf::from(folder).join("run_out.svg"), svg).unwrap();
    }
}
