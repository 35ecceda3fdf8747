//! What the program writes into a run's `manifest.json`: the compiler and the commit it was built from.
//! Does nothing unless the program or the verification is built.

use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let wanted = |feature| std::env::var_os(feature).is_some();
    if !wanted("CARGO_FEATURE_CLI") && !wanted("CARGO_FEATURE_VERIFY") {
        return;
    }
    let compiler = std::env::var("RUSTC").ok().and_then(|rustc| said(&rustc, &["--version"]));
    println!("cargo::rustc-env=ALLUVIUM_COMPILER={}", compiler.unwrap_or_default());
    println!("cargo::rustc-env=ALLUVIUM_COMMIT={}", commit().unwrap_or_default());
    for name in ["TARGET", "PROFILE"] {
        println!("cargo::rustc-env=ALLUVIUM_{name}={}", std::env::var(name).unwrap_or_default());
    }
}

/// The commit, with `+` if tracked files differ from it; nothing outside a clone of this repository.
fn commit() -> Option<String> {
    let top = said("git", &["rev-parse", "--show-toplevel"])?;
    let here = std::env::var("CARGO_MANIFEST_DIR").ok()?;
    if std::fs::canonicalize(top).ok()? != std::fs::canonicalize(here).ok()? {
        return None;
    }
    for file in ["HEAD", "logs/HEAD", "index"] {
        if let Some(path) = said("git", &["rev-parse", "--git-path", file]) {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    let commit = said("git", &["rev-parse", "--short=12", "HEAD"])?;
    let changed = said("git", &["status", "--porcelain", "--untracked-files=no"]).is_some();
    Some(if changed { commit + "+" } else { commit })
}

/// What a command says in one line, if it says anything.
fn said(command: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(command).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let line = text.lines().next()?.trim().to_owned();
    (output.status.success() && !line.is_empty()).then_some(line)
}
