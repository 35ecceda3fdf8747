//! Where a report was made.

use std::process::Command;

/// The machine, the compiler and the version of the code; no date, so that equal results give
/// equal reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Environment {
    /// The processor's name.
    pub processor: String,
    /// How many threads it runs side by side.
    pub cores: usize,
    /// The widest instructions in use.
    pub instructions: &'static str,
    /// The compiler, as it calls itself.
    pub compiler: String,
    /// The commit, with `-dirty` behind it if files have been changed since.
    pub commit: String,
    /// Whether optimisation was on.
    pub optimised: bool,
}

impl Environment {
    /// Asks the machine; what cannot be found out is called `unknown`.
    pub fn detect() -> Self {
        let processor = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
            let line = text.lines().find(|line| line.starts_with("model name"))?;
            Some(line.split_once(':')?.1.trim().to_owned())
        });
        let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
        let commit = answer("git", &["rev-parse", "HEAD"]).map(|commit| {
            let changes = answer("git", &["status", "--porcelain", "--untracked-files=no"]);
            if changes.is_none_or(|text| text.is_empty()) { commit } else { commit + "-dirty" }
        });
        let unknown = || "unknown".to_owned();
        Self {
            processor: processor.unwrap_or_else(unknown),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            instructions: crate::InstructionSet::detect().name(),
            compiler: answer(&compiler, &["--version"]).unwrap_or_else(unknown),
            commit: commit.unwrap_or_else(unknown),
            optimised: !cfg!(debug_assertions),
        }
    }
}

/// What a command prints, if it succeeds.
fn answer(command: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(command).args(arguments).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
