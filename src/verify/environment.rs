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
    /// The commit this library was built from, with `+` behind it if files differed from it.
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
        let commit = option_env!("ALLUVIUM_COMMIT").filter(|commit| !commit.is_empty());
        let unknown = || "unknown".to_owned();
        Self {
            processor: processor.unwrap_or_else(unknown),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            instructions: crate::InstructionSet::detect().name(),
            compiler: answer(&compiler, &["--version"]).unwrap_or_else(unknown),
            commit: commit.map_or_else(unknown, str::to_owned),
            optimised: !cfg!(debug_assertions),
        }
    }
}

/// What a command prints, if it succeeds.
fn answer(command: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(command).args(arguments).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
