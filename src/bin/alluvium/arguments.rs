//! The command line.

use crate::drive::DriveOptions;
use alluvium::Preset;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Smoothed particle hydrodynamics of water and soil.
///
/// Exit codes: 0 done, 1 a file could not be read or written, 2 wrong usage, 3 the case or the
/// law is invalid, 4 the numbers went wrong, 130 interrupted by ctrl-C, 143 by SIGTERM (4, 130 and 143
/// after the last state was written).
#[derive(Debug, Parser)]
#[command(name = "alluvium", version, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Reproduce a result of the paper, compare it with published data and draw it.
    Reproduce(ReproduceOptions),
    /// Run a case file.
    Run(RunOptions),
    /// Read a case file without running it: what is wrong with it, what it would cost.
    Check(CheckOptions),
    /// Drive a law of soil along a path of strain and stress, without particles.
    Drive(DriveOptions),
    /// List what can be reproduced.
    List,
}

#[derive(Args, Debug)]
pub struct ReproduceOptions {
    /// What to reproduce; `alluvium list` names them.
    pub name: String,
    /// Coarse and short: ends within a minute.
    #[arg(long)]
    pub quick: bool,
    /// Recommended choices, or the paper's as printed.
    #[arg(long, value_enum, default_value_t = PresetName::Default)]
    pub preset: PresetName,
    /// The numbers to compute in.
    #[arg(long, value_enum, default_value_t = PrecisionName::F64)]
    pub precision: PrecisionName,
    /// Particle spacing [m] instead of the paper's (or the quick one).
    #[arg(long, value_name = "METRES", allow_negative_numbers = true, value_parser = positive)]
    pub spacing: Option<f64>,
    #[command(flatten)]
    pub output: OutputOptions,
}

#[derive(Args, Debug)]
pub struct RunOptions {
    /// The case file.
    pub case: PathBuf,
    #[command(flatten)]
    pub output: OutputOptions,
}

#[derive(Args, Debug)]
pub struct CheckOptions {
    /// The case file.
    pub case: PathBuf,
}

/// Where results go, and how many threads compute them.
#[derive(Args, Clone, Debug)]
pub struct OutputOptions {
    /// The run's folder [default: runs/NAME].
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
    /// What to do if the folder is not empty.
    #[arg(long, value_enum, default_value_t = Existing::Error)]
    pub existing: Existing,
    /// Threads, up to 4096; 0 is one per core. Results do not depend on it [default: the case's].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(..=4096))]
    pub threads: Option<u16>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Existing {
    /// Stop: nothing is touched.
    Error,
    /// Delete what the former run wrote, and nothing else.
    Overwrite,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PresetName {
    Default,
    Paper,
}

impl PresetName {
    /// The library's.
    pub fn preset(self) -> Preset {
        match self {
            Self::Default => Preset::Default,
            Self::Paper => Preset::Paper,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PrecisionName {
    F32,
    F64,
}

impl PrecisionName {
    /// As in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("it must be a number above 0, in metres".to_owned()),
    }
}
