//! Whole runs of a solver that simulates nothing.

use super::*;
use crate::arguments::Existing;
use crate::simulated::Simulated;
use crate::stand_in::{StandIn, case, folder};
use alluvium::kernel::WendlandC2;
use alluvium::output::Table;
use alluvium::time::LeapFrog;

fn options(out: PathBuf, existing: Existing) -> OutputOptions {
    OutputOptions { out: Some(out), existing, threads: Some(1) }
}

fn run(fails_at: f64, options: &OutputOptions) -> Result<Finished, Failure> {
    let (case, warnings) = case();
    run_with(|_| Ok(Box::new(StandIn::new(fails_at))), case, &warnings, options, &mut |_, _| {})
}

#[test]
fn a_run_leaves_a_whole_folder() {
    let path = folder("run");
    let (case, warnings) = case();
    let mut times = Vec::new();
    let new = |_: &Case| Ok(Box::new(StandIn::new(f64::INFINITY)) as _);
    let options = options(path.clone(), Existing::Error);
    run_with(new, case, &warnings, &options, &mut |time, _| times.push(time)).unwrap();
    assert_eq!(times, [0.0, 0.1, 0.25]);
    let read = |name: &str| std::fs::read_to_string(path.join(name)).unwrap();
    let history = Table::parse(&read("history.csv")).unwrap();
    let recorded = history.column("time [s]").unwrap();
    assert_eq!((recorded[0], *recorded.last().unwrap()), (0.0, 0.25));
    assert!(recorded.windows(2).all(|w| w[1] > w[0] && w[1] - w[0] < 0.02), "{recorded:?}");
    assert_eq!(Table::parse(&read("gauges/toe.csv")).unwrap().columns(), ["time [s]", "pressure [Pa]"]);
    assert_eq!(read("data/water.pvd").matches("water_000").count(), 3);
    let used = Case::parse("case.used.toml", &read("case.used.toml")).unwrap().0;
    assert_eq!(used, Case { threads: 1, ..crate::stand_in::case().0 });
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

/// No case file makes a NaN, so it is put into a simulation that has run well, which the program then goes on with.
#[test]
fn a_velocity_that_is_not_a_number_ends_in_a_dump_of_it() {
    let path = folder("nan");
    let (case, warnings) = case();
    let mut culprit = None;
    let mut mean_spirited = |case: &Case| {
        let kernel = WendlandC2::<f64, 2>::new(case.smoothing_length()).unwrap();
        let mut simulation = case.simulation(kernel, LeapFrog::new()).unwrap();
        for _ in 0..5 {
            simulation.step().unwrap();
        }
        let water = simulation.mixture_mut().water_mut();
        culprit = Some(water.ids()[17]);
        water.velocities_mut()[17][1] = f64::NAN;
        Ok(Box::new(Simulated::new(simulation, case)) as _)
    };
    let options = options(path.clone(), Existing::Error);
    let ended = run_with(&mut mean_spirited, case, &warnings, &options, &mut |_, _| {});
    let Err(failure) = ended else { panic!("it went on") };
    assert_eq!(failure.code(), 4);
    let message = failure.to_string();
    let particle = format!("velocity of water particle {} at ", culprit.unwrap());
    for part in [&*particle, "is not finite", "term: state before the evaluation", "t = "] {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
    let manifest = std::fs::read_to_string(path.join("manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    assert_eq!(manifest["steps"], 5, "none was taken with it");
    assert!(std::fs::read_to_string(path.join("data/water.pvd")).unwrap().contains("water_0001.vtp"));
    let dump = std::fs::read(path.join("data/water_0001.vtp")).unwrap();
    assert!(dump.ends_with(b"</VTKFile>\n"));
    let nan = f64::NAN.to_le_bytes();
    assert_eq!(dump.windows(8).filter(|bytes| *bytes == nan).count(), 1, "the one velocity is in the dump");
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
