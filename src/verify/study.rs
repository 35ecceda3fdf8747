//! A study and its outcome.

use super::expected::{Expected, Measured};
use core::panic::AssertUnwindSafe;

/// When a study runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Always: seconds.
    Quick,
    /// On request: minutes.
    Full,
}

/// Under what a study runs: as it is, or with one deliberate mistake.
#[derive(Clone, Copy, Debug, Default)]
pub struct Conditions<'a> {
    /// The mutant in force.
    pub mutant: Option<&'a str>,
}

impl Conditions<'_> {
    /// Whether the mutant of this name is in force.
    pub fn is(&self, mutant: &str) -> bool {
        self.mutant == Some(mutant)
    }
}

type Run = dyn Fn(&Conditions) -> Measured + Send + Sync;

/// A claim, how to measure it, and what has to come out.
pub struct Study {
    /// Its name, unique among all, `topic/what`.
    pub name: String,
    /// What it shows, in a sentence.
    pub claim: String,
    /// The equations it stands for, by number.
    pub equations: &'static [&'static str],
    /// Where the expectation comes from.
    pub source: String,
    /// When it runs.
    pub level: Level,
    /// What has to come out.
    pub expected: Expected,
    /// Mistakes under which it must fail.
    pub mutants: Vec<&'static str>,
    run: Box<Run>,
}

impl core::fmt::Debug for Study {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Study")
            .field("name", &self.name)
            .field("expected", &self.expected)
            .finish_non_exhaustive()
    }
}

impl Study {
    /// A quick study that expects no differences; say what else it expects with the methods below.
    pub fn new(
        name: impl Into<String>,
        claim: impl Into<String>,
        run: impl Fn(&Conditions) -> Measured + Send + Sync + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            claim: claim.into(),
            equations: &[],
            source: String::new(),
            level: Level::Quick,
            expected: Expected::Identical,
            mutants: Vec::new(),
            run: Box::new(run),
        }
    }
    /// The equations it stands for.
    pub fn equations(mut self, numbers: &'static [&'static str]) -> Self {
        self.equations = numbers;
        self
    }
    /// Where the expectation comes from.
    pub fn source(mut self, source: impl Into<String>) -> Self {
        self.source = source.into();
        self
    }
    /// When it runs.
    pub fn level(mut self, level: Level) -> Self {
        self.level = level;
        self
    }
    /// What has to come out.
    pub fn expect(mut self, expected: Expected) -> Self {
        self.expected = expected;
        self
    }
    /// One more mistake under which it must fail.
    pub fn mutant(mut self, name: &'static str) -> Self {
        self.mutants.push(name);
        self
    }

    /// Runs it as it is.
    pub fn run(&self) -> Outcome {
        self.run_under(None)
    }

    /// Runs it under one of its mutants; good news is then an outcome that [was
    /// caught](Outcome::caught).
    pub fn run_mutant(&self, mutant: &str) -> Outcome {
        self.run_under(Some(mutant))
    }

    fn run_under(&self, mutant: Option<&str>) -> Outcome {
        let run = AssertUnwindSafe(|| (self.run)(&Conditions { mutant }));
        let result = std::panic::catch_unwind(run);
        let (measured, met, sentence) = match result {
            Ok(measured) => {
                let (met, sentence) = self.expected.judge(&measured);
                (Some(measured), met, sentence)
            }
            Err(panic) => {
                let text = panic.downcast_ref::<String>().map(String::as_str);
                let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
                (None, false, format!("did not finish: {text}"))
            }
        };
        Outcome { study: self.name.clone(), mutant: mutant.map(str::to_owned), measured, met, sentence }
    }
}

/// What came out of a study.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The study's name.
    pub study: String,
    /// The mutant it ran under.
    pub mutant: Option<String>,
    /// The numbers; none if it did not finish.
    pub measured: Option<Measured>,
    /// Whether they were as expected.
    pub met: bool,
    /// What to say about it.
    pub sentence: String,
}

impl Outcome {
    /// The study, unchanged, measured what it expects.
    pub fn passed(&self) -> bool {
        self.mutant.is_none() && self.met
    }
    /// The mutant was noticed: the study finished, and did not measure what it expects.
    pub fn caught(&self) -> bool {
        self.mutant.is_some() && self.measured.is_some() && !self.met
    }
    /// [`passed`](Self::passed), or [`caught`](Self::caught) under a mutant.
    pub fn is_good(&self) -> bool {
        self.passed() || self.caught()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn study() -> Study {
        Study::new("s", "c", |conditions| {
            assert!(!conditions.is("breaks"), "broken {}", 7);
            Measured::value(if conditions.is("wrong") { 1.0 } else { 0.0 })
        })
    }

    #[test]
    fn a_mutant_must_be_measured_to_be_caught() {
        assert!(study().run().passed() && !study().run().caught());
        assert!(study().run_mutant("wrong").caught());
        let harmless = study().run_mutant("harmless");
        assert!(harmless.met && !harmless.is_good());
        let broken = study().run_mutant("breaks");
        assert!(!broken.is_good() && broken.sentence == "did not finish: broken 7");
    }
}
