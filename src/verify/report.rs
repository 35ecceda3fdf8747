//! Outcomes on paper.

use super::environment::Environment;
use super::json;
use super::study::{Outcome, Study};
use core::fmt::Write;

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

    /// For people.
    pub fn markdown(&self) -> String {
        let mut out = String::from("# Verification\n\n");
        let e = &self.environment;
        let build = if e.optimised { "release" } else { "debug" };
        let lines = [
            ("processor", format!("{}, {} threads, {}", e.processor, e.cores, e.instructions)),
            ("compiler", format!("{}, {build} build", e.compiler)),
            ("commit", e.commit.clone()),
            ("studies", tally(self.outcomes().filter(|o| o.mutant.is_none()), "passed")),
            ("mutants", tally(self.outcomes().filter(|o| o.mutant.is_some()), "caught")),
        ];
        for (name, value) in lines {
            let _ = writeln!(out, "- {name}: {value}");
        }
        out.push_str("\n| study | equations | result | |\n|---|---|---|---|\n");
        for (study, own) in &self.studies {
            for outcome in own {
                let name = full_name(outcome);
                let equations = study.equations.join(", ");
                let _ =
                    writeln!(out, "| {name} | {equations} | {} | {} |", outcome.sentence, verdict(outcome));
            }
        }
        for (study, own) in &self.studies {
            details(&mut out, study, own);
        }
        out
    }

    /// For programs.
    pub fn json(&self) -> String {
        let mut out = String::from("{");
        let e = &self.environment;
        let facts = [
            ("processor", e.processor.as_str()),
            ("instructions", e.instructions),
            ("compiler", e.compiler.as_str()),
            ("commit", e.commit.as_str()),
        ];
        for (name, value) in facts {
            json::name(&mut out, name);
            json::text(&mut out, value);
        }
        let _ = write!(out, ",\"cores\":{},\"optimised\":{}", e.cores, e.optimised);
        json::name(&mut out, "outcomes");
        json::list(&mut out, self.outcomes(), outcome_json);
        out.push_str("}\n");
        out
    }
}

fn full_name(outcome: &Outcome) -> String {
    match &outcome.mutant {
        None => outcome.study.clone(),
        Some(mutant) => format!("{}, mutant: {mutant}", outcome.study),
    }
}

fn verdict(outcome: &Outcome) -> &'static str {
    match (&outcome.mutant, outcome.is_good()) {
        (None, true) => "passed",
        (None, false) => "**FAILED**",
        (Some(_), true) => "caught",
        (Some(_), false) => "**SURVIVED**",
    }
}

fn tally<'a>(outcomes: impl Iterator<Item = &'a Outcome>, word: &str) -> String {
    let (mut good, mut all) = (0, 0);
    for outcome in outcomes {
        good += usize::from(outcome.is_good());
        all += 1;
    }
    format!("{good} of {all} {word}")
}

fn details(out: &mut String, study: &Study, own: &[&Outcome]) {
    let _ = writeln!(out, "\n## {}\n\n{}.\n", study.name, study.claim);
    if !study.source.is_empty() {
        let _ = writeln!(out, "Source: {}.\n", study.source);
    }
    for outcome in own {
        let _ = writeln!(out, "{}: {}, {}.\n", full_name(outcome), verdict(outcome), outcome.sentence);
        let Some(measured) = outcome.measured.as_ref().filter(|_| outcome.mutant.is_none()) else {
            continue;
        };
        out.push_str("| | spacing | measured | order |\n|---|---|---|---|\n");
        let orders = measured.orders();
        for (k, point) in measured.points.iter().enumerate() {
            let spacing =
                if point.spacing.is_nan() { String::new() } else { format!("{:.4e}", point.spacing) };
            let order =
                k.checked_sub(1).and_then(|k| orders.get(k)).map_or(String::new(), |p| format!("{p:.3}"));
            let _ = writeln!(out, "| {} | {spacing} | {:.6e} | {order} |", point.label, point.value);
        }
        for note in &measured.notes {
            let _ = writeln!(out, "\n{note}.");
        }
        out.push('\n');
    }
}

fn outcome_json(out: &mut String, outcome: &Outcome) {
    out.push('{');
    json::name(out, "study");
    json::text(out, &outcome.study);
    if let Some(mutant) = &outcome.mutant {
        json::name(out, "mutant");
        json::text(out, mutant);
    }
    json::name(out, "good");
    out.push_str(if outcome.is_good() { "true" } else { "false" });
    json::name(out, "sentence");
    json::text(out, &outcome.sentence);
    json::name(out, "points");
    let points = outcome.measured.iter().flat_map(|measured| &measured.points);
    json::list(out, points, |out, point| {
        out.push('{');
        json::name(out, "label");
        json::text(out, &point.label);
        json::name(out, "spacing");
        json::number(out, point.spacing);
        json::name(out, "value");
        json::number(out, point.value);
        out.push('}');
    });
    out.push('}');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{Expected, Measured};

    #[test]
    fn a_report_names_what_passed_and_what_survived() {
        let study = Study::new("water/rest", "Still water stays still", |conditions| {
            Measured::errors([(0.2, 0.04), (0.1, if conditions.is("bad") { 0.04 } else { 0.01 })])
        });
        let studies = [study.expect(Expected::order(2.0, 0.1)).mutant("bad").mutant("harmless")];
        let run = |mutant: &str| studies[0].run_mutant(mutant);
        let outcomes = [run("harmless"), run("bad"), studies[0].run()];
        let environment = Environment { commit: "abc".to_owned(), ..Environment::detect() };
        let report = Report::new(environment, &studies, &outcomes);
        let text = report.markdown();
        assert!(text.contains("- studies: 1 of 1 passed\n- mutants: 1 of 2 caught"));
        assert!(text.contains("**SURVIVED**") && text.contains("| 1.0000e-1 | 1.000000e-2 | 2.000 |"));
        assert!(text.find("rest | ").unwrap() < text.find("mutant: bad").unwrap());
        let json = report.json();
        assert!(json.contains("\"commit\":\"abc\"") && json.contains("\"mutant\":\"bad\",\"good\":true"));
        assert_eq!(json.matches('{').count(), json.matches('}').count());
    }
}
