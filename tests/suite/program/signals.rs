//! Runs that are told to end.

use super::{TINY, scratch};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Patience with a machine that has other things to do.
const PATIENCE: Duration = Duration::from_secs(120);

/// Asks again and again; the run that is waited for is stopped where patience ends.
fn wait_for<R>(run: &mut Child, what: &str, mut ask: impl FnMut(&mut Child) -> Option<R>) -> R {
    let start = Instant::now();
    loop {
        if let Some(answer) = ask(run) {
            return answer;
        }
        if start.elapsed() > PATIENCE {
            run.kill().ok();
            panic!("no {what} within {PATIENCE:?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// A run that would take days gets a signal once it runs.
fn ends_well(signal: &str, code: i32) {
    let folder = scratch(signal);
    let (file, out) = (folder.join("case.toml"), folder.join("out"));
    let case = TINY
        .replace("end_time_s = 0.004", "end_time_s = 1000.0")
        .replace("dump_interval_s = 0.002", "dump_interval_s = 500.0\nhistory_interval_s = 0.01");
    std::fs::write(&file, case).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_alluvium"));
    command.arg("run").arg(&file).arg("--out").arg(&out).args(["--threads", "1"]);
    let mut run = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap_or_default();
    wait_for(&mut run, "history", |_| (read("history.csv").lines().count() > 3).then_some(()));
    assert!(read("manifest.json").contains("\"running\"") && read("run.log").contains("dump 0000"));
    let sent = Command::new("sh").arg("-c").arg(format!("kill -{signal} {}", run.id())).status().unwrap();
    assert!(sent.success());
    let ended = wait_for(&mut run, "end", |run| run.try_wait().unwrap());
    assert_eq!(ended.code(), Some(code), "{}", read("run.log"));
    let manifest: serde_json::Value = serde_json::from_str(&read("manifest.json")).unwrap();
    assert_eq!(manifest["outcome"], "interrupted");
    assert!(manifest["steps"].as_u64().unwrap() > 10, "{manifest}");
    let files: Vec<&str> =
        manifest["files"].as_array().unwrap().iter().filter_map(|it| it.as_str()).collect();
    assert!(files.contains(&"data/water_0001.vtp"), "{files:?}");
    let start = super::failing::particles(&out.join("data/water_0000.vtp"));
    assert_eq!(super::failing::particles(&out.join("data/water_0001.vtp")), start, "the last state is whole");
    assert!(
        read("data/water.pvd").contains("water_0001.vtp") && read("data/water.pvd").ends_with("</VTKFile>\n")
    );
    let last = read("run.log");
    assert!(last.lines().last().unwrap().contains("interrupted: t = "), "{last}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn ctrl_c_ends_with_130_after_the_last_state() {
    ends_well("INT", 130);
}

#[test]
fn a_request_to_terminate_ends_with_143_after_the_last_state() {
    ends_well("TERM", 143);
}
