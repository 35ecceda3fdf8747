//! Whole runs of a solver that simulates nothing.

use super::*;
use crate::arguments::Existing;
use crate::stand_in::{StandIn, case, folder};
use alluvium::output::Table;

fn options(out: PathBuf, existing: Existing) -> OutputOptions {
    OutputOptions { out: Some(out), existing, threads: Some(1) }
}

fn run(fails_at: f64, options: &OutputOptions) -> Result<Finished, Failure> {
    let (case, warnings) = case();
    run_with(|_| Ok(Box::new(StandIn::new(fails_at))), case, &warnings, options, true)
}

#[test]
fn a_run_leaves_a_whole_folder() {
    let path = folder("run");
    let finished = run(f64::INFINITY, &options(path.clone(), Existing::Error)).unwrap();
    let times: Vec<f64> = finished.views.iter().map(|(time, _)| *time).collect();
    assert_eq!(times, [0.0, 0.1, 0.25]);
    let read = |name: &str| std::fs::read_to_string(path.join(name)).unwrap();
    let history = Table::parse(&read("history.csv")).unwrap();
    let recorded = history.column("time [s]").unwrap();
    assert_eq!((recorded[0], *recorded.last().unwrap()), (0.0, 0.25));
    assert!(recorded.windows(2).all(|w| w[1] > w[0] && w[1] - w[0] < 0.02), "{recorded:?}");
    assert_eq!(Table::parse(&read("gauges/toe.csv")).unwrap().columns(), ["time [s]", "pressure [Pa]"]);
    assert_eq!(read("data/water.pvd").matches("water_000").count(), 3);
    let used = Case::parse("case.used.toml", &read("case.used.toml")).unwrap().0;
    assert_eq!(used, Case { threads: 1, ..case().0 });
    let manifest: serde_json::Value = serde_json::from_str(&read("manifest.json")).unwrap();
    assert_eq!(manifest["outcome"], "done");
    for file in manifest["files"].as_array().unwrap() {
        assert!(path.join(file.as_str().unwrap()).exists(), "{file}");
    }
    assert!(read("run.log").contains("done: t = 0.25000 s"));
    std::fs::remove_dir_all(&path).unwrap();
}

#[test]
fn a_failing_run_leaves_its_last_state() {
    let path = folder("failing");
    let Err(failure) = run(0.15, &options(path.clone(), Existing::Error)) else { panic!("no failure") };
    assert_eq!(failure.code(), 4);
    assert!(failure.to_string().contains("particle 7"), "{failure}");
    assert!(path.join("data/water_0002.vtp").exists(), "two dumps were due, the third is the failure");
    let manifest = std::fs::read_to_string(path.join("manifest.json")).unwrap();
    assert!(manifest.contains("the run stopped: particle 7"));
    std::fs::remove_dir_all(&path).unwrap();
}

#[test]
fn a_folder_in_use_is_left_alone_unless_told() {
    let path = folder("existing");
    run(f64::INFINITY, &options(path.clone(), Existing::Error)).unwrap();
    std::fs::write(path.join("notes.txt"), "mine").unwrap();
    std::fs::write(path.join("data/water_0099.vtp"), "not of this run").unwrap();
    let Err(failure) = run(0.05, &options(path.clone(), Existing::Error)) else { panic!("overwritten") };
    assert_eq!(failure.code(), 2);
    assert!(failure.to_string().contains("--existing overwrite"), "{failure}");
    assert!(path.join("data/water_0002.vtp").exists());
    assert!(run(0.05, &options(path.clone(), Existing::Overwrite)).is_err());
    assert!(!path.join("data/water_0002.vtp").exists(), "files of the former run are gone");
    assert!(path.join("notes.txt").exists() && path.join("data/water_0099.vtp").exists());
    std::fs::remove_file(path.join("manifest.json")).unwrap();
    let Err(failure) = run(0.05, &options(path.clone(), Existing::Overwrite)) else { panic!("deleted") };
    assert!(failure.to_string().contains("nothing was deleted"), "{failure}");
    std::fs::remove_dir_all(&path).unwrap();
}
