//! Outcomes on paper.

mod html;
mod machine;
mod markdown;

use super::environment::Environment;
use super::study::{Outcome, Study};

/// Studies with their outcomes, in order.
#[derive(Debug)]
pub struct Report<'a> {
    /// Where it was made.
    pub environment: Environment,
    /// Each study with its outcomes: as it is, and under mutants.
    pub studies: Vec<(&'a Study, Vec<&'a Outcome>)>,
}

impl<'a> Report<'a> {
    /// Sorts outcomes under their studies, whatever order they came in; studies without are left out.
    pub fn new(environment: Environment, studies: &'a [Study], outcomes: &'a [Outcome]) -> Self {
        let of = |study: &Study| -> Vec<&Outcome> {
            let mut own: Vec<_> = outcomes.iter().filter(|outcome| outcome.study == study.name).collect();
            own.sort_by_key(|outcome| {
                let place = |mutant| study.mutants.iter().position(|m| m == mutant);
                outcome.mutant.as_ref().map(place)
            });
            own
        };
        let studies = studies.iter().map(|study| (study, of(study))).filter(|(_, own)| !own.is_empty());
        Self { environment, studies: studies.collect() }
    }

    fn outcomes(&self) -> impl Iterator<Item = &Outcome> {
        self.studies.iter().flat_map(|(_, own)| own.iter().copied())
    }
}

pub(super) fn full_name(outcome: &Outcome) -> String {
    match &outcome.mutant {
        None => outcome.study.clone(),
        Some(mutant) => format!("{}, mutant: {mutant}", outcome.study),
    }
}

pub(super) fn verdict(outcome: &Outcome) -> &'static str {
    match (&outcome.mutant, outcome.is_good()) {
        (None, true) if outcome.falls_short() => "*falls short*",
        (None, true) => "passed",
        (None, false) => "**FAILED**",
        (Some(_), true) => "caught",
        (Some(_), false) => "**SURVIVED**",
    }
}

/// How many were good, how many of them fall short as is known, or that there was none; and the time they took.
pub(super) fn tally<'a>(outcomes: impl Iterator<Item = &'a Outcome>, word: &str) -> String {
    let (mut good, mut short, mut all, mut seconds) = (0, 0, 0, 0.0);
    for outcome in outcomes {
        short += usize::from(outcome.falls_short());
        good += usize::from(outcome.is_good() && !outcome.falls_short());
        all += 1;
        seconds += outcome.seconds;
    }
    let short = if short == 0 { String::new() } else { format!(", {short} fall short as is known") };
    match all {
        0 => "not run".to_owned(),
        _ => format!("{good} of {all} {word}{short}; {:.1} min of one thread", seconds / 60.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{Expected, Measured};

    #[test]
    fn a_report_names_what_passed_and_what_survived() {
        let study = Study::new("water/rest", "Still water stays still", |conditions| {
            Measured::errors([(0.2, 0.04), (0.1, if conditions.is("bad") { 0.04 } else { 0.01 })])
                .table(["f64", "f32"], [["1.5".into(), "<2".into()]])
        });
        let studies = [study.expect(Expected::order(2.0, 0.1)).mutant("bad").mutant("harmless")];
        let run = |mutant: &str| studies[0].run_mutant(mutant);
        let outcomes = [run("harmless"), run("bad"), studies[0].run()];
        let environment = Environment { commit: "abc".to_owned(), ..Environment::detect() };
        let report = Report::new(environment, &studies, &outcomes);
        let text = report.markdown();
        assert!(
            text.contains(
                "- studies: 1 of 1 passed; 0.0 min of one thread\n- mutants: 1 of 2 caught; 0.0 min"
            )
        );
        assert!(text.contains("**SURVIVED**") && text.contains("| 1.0000e-1 | 1.000000e-2 | 2.000 |"));
        assert!(text.contains("\n| f64 | f32 |\n|---|---|\n| 1.5 | <2 |\n"));
        assert!(report.html().contains("<tr><th>f64<th>f32<tr><td>1.5<td>&lt;2</table>"));
        assert!(report.json().contains("\"tables\":[[[\"f64\",\"f32\"],[\"1.5\",\"<2\"]]]"));
        assert!(text.find("rest | ").unwrap() < text.find("mutant: bad").unwrap());
        assert!(report.html().contains("<tr><th>deliberate mistakes<td>1 of 2 caught"));
        let json = report.json();
        assert!(json.contains("\"commit\":\"abc\"") && json.contains("\"mutant\":\"bad\",\"good\":true"));
        assert_eq!(json.matches('{').count(), json.matches('}').count());
        let alone = Report::new(Environment::detect(), &studies, &outcomes[2..]);
        assert!(
            alone
                .markdown()
                .contains("- studies: 1 of 1 passed; 0.0 min of one thread\n- mutants: not run\n")
        );
        assert!(alone.html().contains("<tr><th>deliberate mistakes<td>not run"));
    }
}
