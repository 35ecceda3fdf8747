//! Runs that go bad, through the program: exit code 4 within one step, and the last state in the folder.
//!
//! No case file makes a number that is NaN: its reader refuses them, and checks refuse what would divide by
//! zero. `src/bin/alluvium/run/tests.rs` puts one into the simulation that the program runs.

use super::{TINY, errors, run, scratch};
use crate::output::{array, doubles};
use std::path::Path;

/// The arrays of a dump: how many particles there are, checked against each array's length.
pub fn particles(file: &Path) -> usize {
    let bytes = std::fs::read(file).unwrap();
    assert!(bytes.ends_with(b"</VTKFile>\n"), "{} is whole", file.display());
    let (kind, components, positions) = array(&bytes, "position");
    let size = if kind == "Float32" { 4 } else { 8 };
    assert_eq!(components, 3);
    let n = positions.len() / (3 * size);
    for (name, width) in [("velocity", 3), ("pressure", 1), ("density", 1)] {
        let (kind_too, components, values) = array(&bytes, name);
        assert_eq!((kind_too, components, values.len()), (kind.clone(), width, n * width * size), "{name}");
    }
    assert_eq!((array(&bytes, "id").2.len(), array(&bytes, "kind").2.len()), (4 * n, n));
    n
}

/// The message of a run that fails at once, after its folder was found to be complete.
fn failed(name: &str, case: &str) -> String {
    let folder = scratch(name);
    let output = run(&folder, case);
    let shown = errors(&output);
    assert_eq!(output.status.code(), Some(4), "{shown}");
    let out = folder.join("out");
    let manifest = std::fs::read_to_string(out.join("manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    assert_eq!(manifest["steps"], 0, "the step that failed is none");
    let message = shown.lines().last().unwrap().to_owned();
    assert_eq!(manifest["outcome"], message.as_str());
    // The start and the failure.
    let collection = std::fs::read_to_string(out.join("data/water.pvd")).unwrap();
    assert!(collection.ends_with("</VTKFile>\n"), "{collection}");
    for file in ["water_0000.vtp", "water_0001.vtp"] {
        assert!(collection.contains(&format!("file=\"{file}\"")), "{collection}");
        assert!(particles(&out.join("data").join(file)) >= 25);
    }
    let log = std::fs::read_to_string(out.join("run.log")).unwrap();
    assert!(log.contains(&message), "{log}");
    let history = std::fs::read_to_string(out.join("history.csv")).unwrap();
    assert!(alluvium::output::Table::parse(&history).unwrap().rows() >= 1);
    std::fs::remove_dir_all(&folder).unwrap();
    message
}

fn names(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
}

#[test]
fn a_far_too_long_step() {
    let message = failed("long", &format!("{TINY}\n[time]\ntime_step_s = 0.01\n"));
    names(&message, &["time step 1.000e-2 s", "t = 0.0", "too long", "acoustic limit", "at most 1.300e-3 s"]);
}

/// Single precision has no places an eighth of a spacing apart at a million metres from the origin.
#[test]
fn particles_that_overlap() {
    let far = format!("precision = \"f32\"\n{TINY}")
        .replace("low_m = [0.0, 0.0]", "low_m = [1e6, 0.0]")
        .replace("[0.1, 0.1]", "[1000000.1, 0.1]")
        .replace("[0.2, 0.2]", "[1000000.2, 0.2]")
        .replace("[0.05, 0.01]", "[1000000.05, 0.01]");
    let message = failed("overlap", &far);
    names(&message, &["water", "particle", "[1000000.", "overlaps particle", "0.000e0 m apart", "t = 0.0"]);
}

/// Water so thick in a drop so small that single precision has no square of its accelerations. Nothing overlaps,
/// and nothing is said to.
#[test]
fn accelerations_beyond_the_precision() {
    let drop = r#"
        name = "drop"
        precision = "f32"
        end_time_s = 1e-9
        gravity_m_per_s2 = [0.0, 0.0]
        particles.spacing_m = 2e-9
        [water]
        sound_speed_m_per_s = 1e5
        viscosity_pa_s = 1e6
        reference_density_kg_per_m3 = 1.0
        [[water.block]]
        low_m = [0.0, 0.0]
        high_m = [2e-8, 2e-8]
        velocity_m_per_s = [1e4, 0.0]
        [[water.block]]
        low_m = [2e-8, 0.0]
        high_m = [4e-8, 2e-8]
        velocity_m_per_s = [-1e4, 0.0]
    "#;
    let message = failed("thick", drop);
    names(&message, &["acceleration of water particle", "its square is no number of f32", "t = 0.0"]);
}

/// The reader of dumps sees what is wrong with one.
#[test]
fn a_dump_tells_what_was_written() {
    let folder = scratch("dump");
    let path = folder.join("water.vtp");
    let places = [[0.25_f64, 1.0], [0.5, 2.0]].map(alluvium::Vector);
    let two = || [1.0_f64, f64::NAN];
    let file = alluvium::output::Vtp::new(0.0, &places).vector("velocity", places).unwrap();
    let file = file.scalar("pressure", two()).and_then(|file| file.scalar("density", two())).unwrap();
    let file = file.scalar("id", [0_u32, 1]).and_then(|file| file.scalar("kind", [0_u8, 0])).unwrap();
    file.write(&path).unwrap();
    assert_eq!(particles(&path), 2);
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(doubles(&array(&bytes, "position").2)[..2], [0.25, 1.0]);
    assert!(doubles(&array(&bytes, "pressure").2)[1].is_nan(), "what went wrong is in the dump");
    std::fs::write(&path, &bytes[..bytes.len() - 20]).unwrap();
    assert!(std::panic::catch_unwind(|| particles(&path)).is_err());
    std::fs::remove_dir_all(&folder).unwrap();
}
