//! The flags a test program does not have by itself.

/// What was asked for.
#[derive(Debug, Default)]
pub struct Flags {
    pub full: bool,
    /// The mistakes of the quick level.
    pub mutants: bool,
    /// Those of all studies that run.
    pub all_mutants: bool,
    pub reports: Vec<String>,
    /// Where outcomes are kept, to go on from.
    pub resume: Option<String>,
    /// Nothing is run: what is kept is all there is.
    pub recorded: bool,
}

impl Flags {
    /// Takes its own flags out of the arguments and leaves the others.
    pub fn split(arguments: impl Iterator<Item = String>) -> Result<(Self, Vec<String>), String> {
        let (mut flags, mut others) = (Self::default(), Vec::new());
        let mut arguments = arguments;
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "--full" => flags.full = true,
                "--mutants" => flags.mutants = true,
                "--all-mutants" => flags.all_mutants = true,
                "--recorded" => flags.recorded = true,
                "--report" => {
                    let file = arguments.next().ok_or("--report needs a file name, or - for the terminal")?;
                    flags.reports.push(file);
                }
                "--resume" => flags.resume = Some(arguments.next().ok_or("--resume needs a file name")?),
                _ => match argument.split_once('=') {
                    Some(("--report", file)) => flags.reports.push(file.to_owned()),
                    Some(("--resume", file)) => flags.resume = Some(file.to_owned()),
                    _ => others.push(argument),
                },
            }
        }
        Ok((flags, others))
    }
}
