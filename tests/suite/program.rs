//! Whole runs of the program: exit codes and files.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

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
    let read = |path: PathBuf| std::fs::read(path).unwrap();
    let last = "data/water_0002.vtp";
    // The resolved case, run again, is the same run.
    let again = scratch("again");
    let used = String::from_utf8(read(out.join("case.used.toml"))).unwrap();
    assert_eq!(run(&again, &used).status.code(), Some(0));
    assert_eq!(read(out.join(last)), read(again.join("out").join(last)));
    let refused = run(&folder, TINY);
    assert_eq!(refused.status.code(), Some(2), "a folder that is not empty");
    [folder, again].iter().for_each(|folder| std::fs::remove_dir_all(folder).unwrap());
}

#[test]
fn a_broken_case_is_answered_with_3() {
    let folder = scratch("broken");
    let output = run(&folder, &TINY.replace("spacing_m", "spacing"));
    assert_eq!(output.status.code(), Some(3));
    assert!(errors(&output).contains("spacing_m"), "{}", errors(&output));
    let kernel = TINY.replace("[particles]", "[particles]\nkernel = \"cubic-spline\"");
    let output = run(&folder, &kernel);
    assert_eq!(output.status.code(), Some(3));
    assert!(errors(&output).contains("cubic-spline"), "{}", errors(&output));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_far_too_long_step_is_answered_with_4_and_a_dump() {
    let folder = scratch("failing");
    let output = run(&folder, &format!("{TINY}\n[time]\ntime_step_s = 0.01\n"));
    assert_eq!(output.status.code(), Some(4), "{}", errors(&output));
    assert!(errors(&output).contains("too long"), "{}", errors(&output));
    let dumps = std::fs::read_dir(folder.join("out/data")).unwrap().count();
    assert!(dumps >= 3, "the start, the failure and the collection");
    assert!(std::fs::read_to_string(folder.join("out/manifest.json")).unwrap().contains("too long"));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn wrong_usage_is_answered_with_2() {
    assert_eq!(program(&["reproduce".as_ref(), "nothing".as_ref()]).status.code(), Some(2));
    assert_eq!(program(&["fly".as_ref()]).status.code(), Some(2));
}
