//! The case is the paper's, and what is drawn and told of a run.

use super::*;
use crate::arguments::{Existing, OutputOptions, PrecisionName, PresetName};
use crate::run::run_with;
use crate::stand_in::{self, StandIn};
use alluvium::case::StepSize;

fn options(preset: PresetName) -> ReproduceOptions {
    let output = OutputOptions { out: None, existing: Existing::Error, threads: None };
    let (name, precision) = ("dam-break".to_owned(), PrecisionName::F32);
    ReproduceOptions { name, quick: false, preset, precision, spacing: None, output }
}

#[test]
fn the_case_is_the_papers() {
    for preset in [PresetName::Default, PresetName::Paper] {
        let case = |spacing: f64| {
            let text = case_text("dam-break", &options(preset), spacing, "0.0, 0.1, 0.5");
            let (case, warnings) = Case::parse("dam-break", &text).unwrap();
            assert_eq!(warnings.problems, []);
            case
        };
        let full = case(SPACING);
        assert_eq!((full.water_particles(), full.end_time), (12_800, 0.5));
        assert_eq!(full.water.as_ref().unwrap().sound_speed, 25.0);
        assert_eq!(case(2.0 * SPACING).water_particles(), 3_200);
        if preset == PresetName::Paper {
            assert_eq!(full.time.step, StepSize::Fixed(1e-5));
            assert_eq!(case(2.0 * SPACING).time.step, StepSize::Fixed(1e-5));
            assert_eq!(case(0.5 * SPACING).time.step, StepSize::Fixed(5e-6));
        }
    }
}

#[test]
fn a_run_is_compared_and_drawn() {
    let path = stand_in::folder("dam-break");
    let output = OutputOptions { out: Some(path.clone()), existing: Existing::Error, threads: Some(1) };
    let (case, warnings) = stand_in::case();
    let reference = volume_of_fluid().unwrap();
    let mut watch = Watch::new(&reference);
    let new = |_: &Case| Ok(Box::new(StandIn::new(f64::INFINITY)) as _);
    let mut look = |time: f64, solver: &mut dyn Solver| watch.look(time, solver);
    let finished = run_with(new, case.clone(), &warnings, &output, &mut look).unwrap();
    present(&case, finished, &watch).unwrap();
    let report = std::fs::read_to_string(path.join("report.md")).unwrap();
    assert!(report.contains("T = 1.5 | 1.82"), "{report}");
    assert!(report.contains("| **no** |") && report.contains("rms of X"), "{report}");
    for picture in ["front", "energy", "time_step", "particles"] {
        let svg = std::fs::read_to_string(path.join(format!("pictures/{picture}.svg"))).unwrap();
        assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"), "{picture}");
    }
    let manifest = std::fs::read_to_string(path.join("manifest.json")).unwrap();
    assert!(manifest.contains("pictures/front.svg") && manifest.contains("\"done\""));
    std::fs::remove_dir_all(&path).unwrap();
}
