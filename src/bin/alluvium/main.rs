//! The program `alluvium`: runs cases of soil or water, drives laws, and shows what came out.

mod arguments;
mod case_file;
mod connect;
mod drive;
mod folder;
mod gallery;
mod interrupt;
mod manifest;
mod outcome;
mod plots;
mod preflight;
mod published;
mod reporter;
mod reproduce;
mod run;
mod screen;
mod simulated;
mod solver;
#[cfg(test)]
mod stand_in;

use arguments::{Arguments, Command};
use clap::Parser;
use outcome::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match &arguments.command {
        Command::Reproduce(options) => reproduce::reproduce(options),
        Command::Run(options) => run::run_file(options),
        Command::Check(options) => preflight::check_file(&options.case),
        Command::Drive(options) => drive::drive(options),
        Command::List => reproduce::list(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            if !matches!(failure, Failure::Interrupted { .. }) {
                screen::say(&failure);
            }
            ExitCode::from(failure.code())
        }
    }
}
