//! Whole runs of the program: exit codes and files.

mod broken;
mod failing;
#[cfg(unix)]
mod signals;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const TINY: &str = r#"
name = "tiny"
end_time_s = 0.004
[particles]
spacing_m = 0.02
[water]
sound_speed_m_per_s = 20.0
[[water.block]]
low_m = [0.0, 0.0]
high_m = [0.1, 0.1]
[tank]
low_m = [0.0, 0.0]
high_m = [0.2, 0.2]
open = ["+y"]
[output]
dump_interval_s = 0.002
[[gauge]]
name = "toe"
position_m = [0.05, 0.01]
"#;

fn scratch(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("alluvium-program-{name}-{}", std::process::id()));
    std::fs::remove_dir_all(&path).ok();
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// Runs a case given as text in a folder of its own.
fn run(folder: &Path, case: &str) -> Output {
    let file = folder.join("case.toml");
    std::fs::write(&file, case).unwrap();
    let out = folder.join("out");
    program(&[
        "run".as_ref(),
        file.as_os_str(),
        "--out".as_ref(),
        out.as_os_str(),
        "--threads".as_ref(),
        "1".as_ref(),
    ])
}

fn program(arguments: &[&std::ffi::OsStr]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_alluvium")).args(arguments).output().unwrap()
}

/// Who reads a run's lines may go; the run goes on to its end.
#[test]
fn a_run_needs_no_listener() {
    let folder = scratch("unheard");
    let (case, out) = (folder.join("case.toml"), folder.join("out"));
    std::fs::write(&case, TINY).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_alluvium"));
    run.arg("run").arg(&case).arg("--out").arg(&out).args(["--threads", "1"]);
    let mut child = run.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop((child.stdout.take(), child.stderr.take()));
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(std::fs::read_to_string(out.join("manifest.json")).unwrap().contains("\"done\""));
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The resolved case of a run, run again, is the same run to the last bit of a dump.
fn assert_can_be_repeated(out: &Path, dump: &str) {
    let again = scratch(&format!("{dump}-again"));
    let used = std::fs::read_to_string(out.join("case.used.toml")).unwrap();
    assert_eq!(run(&again, &used).status.code(), Some(0));
    let bytes = |out: &Path| std::fs::read(out.join("data").join(dump)).unwrap();
    assert!(bytes(out) == bytes(&again.join("out")), "{dump} differs");
    std::fs::remove_dir_all(&again).unwrap();
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_run_ends_well_and_can_be_repeated() {
    let folder = scratch("good");
    let output = run(&folder, TINY);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let out = folder.join("out");
    for file in [
        "history.csv",
        "manifest.json",
        "run.log",
        "gauges/toe.csv",
        "data/water.pvd",
        "pictures/particles.svg",
    ] {
        assert!(out.join(file).exists(), "{file}");
    }
    assert_can_be_repeated(&out, "water_0002.vtp");
    let refused = run(&folder, TINY);
    assert_eq!(refused.status.code(), Some(2), "a folder that is not empty");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A small pile of sand, in grains of 60 % of its volume.
const SAND: &str = r#"
name = "sand"
end_time_s = 0.004
[particles]
spacing_m = 0.02
[soil]
reference_density_kg_per_m3 = 2650.0
volume_fraction = 0.6
bulk_modulus_pa = 0.7e6
poissons_ratio = 0.3
friction_angle_deg = 30.0
[[soil.block]]
low_m = [0.0, 0.0]
high_m = [0.2, 0.1]
[tank]
low_m = [0.0, 0.0]
high_m = [0.4, 0.2]
open = ["+y"]
[output]
dump_interval_s = 0.002
fields = ["velocity", "stress", "equivalent_plastic_strain"]
[[gauge]]
name = "floor"
position_m = [0.05, 0.01]
[[gauge]]
name = "top"
position_m = [0.05, 0.0]
quantity = "surface-elevation"
"#;

#[test]
fn soil_runs_and_tells_where_its_energy_is() {
    let folder = scratch("sand");
    let output = run(&folder, SAND);
    assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
    let out = folder.join("out");
    let table = |name: &str| {
        let text = std::fs::read_to_string(out.join(name)).unwrap();
        alluvium::output::Table::parse(&text).unwrap()
    };
    let history = table("history.csv");
    let first = |name: &str| history.column(name).unwrap()[0];
    assert_eq!((first("soil_particles"), first("water_particles")), (50.0, 0.0));
    assert!((first("front [m]") - 0.2).abs() < 1e-12);
    assert!(first("elastic_energy [J/m]") > 0.0 && first("compressive_energy [J/m]") == 0.0);
    for column in ["taken_by_plastic [J/m]", "taken_by_cut_off [J/m]", "force_y_on_wall_-y [N/m]"] {
        assert!(history.column(column).unwrap().iter().all(|x| x.is_finite()), "{column}");
    }
    // The floor bears the weight: 0.6 · 2650 kg/m³ over 0.02 m².
    let weight = 0.6 * 2650.0 * 9.81 * 0.02;
    let borne = -first("force_y_on_wall_-y [N/m]");
    assert!((borne / weight - 1.0).abs() < 0.3, "{borne} N/m of {weight} N/m");
    let pressure = table("gauges/floor.csv").column("pressure [Pa]").unwrap()[0];
    assert!(pressure > 500.0 && pressure < 2650.0, "{pressure}");
    let top = table("gauges/top.csv").column("surface_elevation [m]").unwrap()[0];
    assert!((top - 0.1).abs() < 5e-3, "{top}");
    let dump = std::fs::read(out.join("data/soil_0002.vtp")).unwrap();
    let head = String::from_utf8_lossy(&dump[..3000.min(dump.len())]).into_owned();
    assert!(head.contains("\"stress\"") && head.contains("\"equivalent_plastic_strain\""), "{head}");
    assert!(out.join("data/soil.pvd").exists() && !out.join("data/water.pvd").exists());
    let picture = std::fs::read_to_string(out.join("pictures/particles.svg")).unwrap();
    assert!(picture.contains("equivalent plastic strain"));
    assert_can_be_repeated(&out, "soil_0002.vtp");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn wrong_usage_is_answered_with_2() {
    assert_eq!(program(&["reproduce".as_ref(), "nothing".as_ref()]).status.code(), Some(2));
    assert_eq!(program(&["fly".as_ref()]).status.code(), Some(2));
}
