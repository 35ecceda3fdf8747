//! A study and its outcome.

use super::expected::{Expected, Measured};
use core::panic::AssertUnwindSafe;
use std::time::Instant;

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

/// How far a study that misses its claim is known to come.
#[derive(Clone, Debug)]
pub struct Shortfall {
    /// What it does reach.
    pub reaches: Expected,
    /// Why not what is claimed.
    pub why: String,
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
    /// How far it is known to come, where it misses what is claimed.
    pub shortfall: Option<Shortfall>,
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
            shortfall: None,
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

    /// It is known to miss what it expects, and to reach this: coming less far is a failure, and so is meeting the
    /// claim after all, as then this is no longer so.
    pub fn falls_short(mut self, reaches: Expected, why: impl Into<String>) -> Self {
        self.shortfall = Some(Shortfall { reaches, why: why.into() });
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
        let begin = Instant::now();
        let run = AssertUnwindSafe(|| (self.run)(&Conditions { mutant }));
        let result = std::panic::catch_unwind(run);
        let seconds = begin.elapsed().as_secs_f64();
        let (measured, standing, sentence) = match result {
            Ok(measured) => {
                let (standing, sentence) = self.judge(&measured);
                (Some(measured), standing, sentence)
            }
            Err(panic) => {
                let text = panic.downcast_ref::<String>().map(String::as_str);
                let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
                (None, Standing::Missed, format!("did not finish: {text}"))
            }
        };
        Outcome {
            study: self.name.clone(),
            mutant: mutant.map(str::to_owned),
            measured,
            standing,
            sentence,
            seconds,
        }
    }

    fn judge(&self, measured: &Measured) -> (Standing, String) {
        let (met, sentence) = self.expected.judge(measured);
        let Some(Shortfall { reaches, why }) = &self.shortfall else {
            return (if met { Standing::Met } else { Standing::Missed }, sentence);
        };
        let (reached, _) = reaches.judge(measured);
        if met {
            (Standing::Missed, format!("{sentence}; met, though said to fall short"))
        } else if reached {
            (Standing::FallsShort, format!("{sentence}; known to fall short: {why}"))
        } else {
            (
                Standing::Missed,
                format!("{sentence}; known to fall short, but not by so much ({reaches}): {why}"),
            )
        }
    }
}

/// Where an outcome stands beside its claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// As claimed.
    Met,
    /// Not as claimed, but as far as it is [known](Study::falls_short) to come.
    FallsShort,
    /// Not as claimed.
    Missed,
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
    pub standing: Standing,
    /// What to say about it.
    pub sentence: String,
    /// How long it took \[s\].
    pub seconds: f64,
}

impl Outcome {
    /// The study, unchanged, measured what it expects.
    pub fn passed(&self) -> bool {
        self.mutant.is_none() && self.standing == Standing::Met
    }
    /// The study, unchanged, misses its claim by as much as is known.
    pub fn falls_short(&self) -> bool {
        self.mutant.is_none() && self.standing == Standing::FallsShort
    }
    /// The mutant was noticed: the study finished, and measured neither what it expects nor what it is known to reach.
    pub fn caught(&self) -> bool {
        self.mutant.is_some() && self.measured.is_some() && self.standing == Standing::Missed
    }
    /// Nothing new: [`passed`](Self::passed) or [`falls_short`](Self::falls_short), or [`caught`](Self::caught) under a
    /// mutant.
    pub fn is_good(&self) -> bool {
        self.passed() || self.falls_short() || self.caught()
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
        assert!(harmless.standing == Standing::Met && !harmless.is_good());
        let broken = study().run_mutant("breaks");
        assert!(!broken.is_good() && broken.sentence == "did not finish: broken 7");
    }

    #[test]
    fn who_falls_short_does_so_by_as_much_as_is_known() {
        let reaching = |value: f64, known: f64| {
            let bound = |largest| Expected::Bound { largest };
            let study = Study::new("s", "c", move |_| Measured::value(value)).expect(bound(1.0));
            study.falls_short(bound(known), "because").run()
        };
        let as_known = reaching(1.5, 2.0);
        assert!(as_known.falls_short() && as_known.is_good() && !as_known.passed());
        assert!(as_known.sentence.ends_with("known to fall short: because"));
        assert!(!reaching(2.5, 2.0).is_good(), "farther off than known");
        assert!(!reaching(0.5, 2.0).is_good(), "met after all");
    }

    #[test]
    fn a_mutant_of_a_study_that_falls_short_must_be_worse_than_known() {
        let of = |mistaken: f64| {
            let study = Study::new("s", "c", move |conditions| {
                Measured::value(if conditions.is("wrong") { mistaken } else { 1.5 })
            });
            let bound = |largest| Expected::Bound { largest };
            study.expect(bound(1.0)).falls_short(bound(2.0), "because").run_mutant("wrong")
        };
        assert!(of(3.0).caught() && !of(1.6).caught() && !of(1.6).is_good());
    }
}
