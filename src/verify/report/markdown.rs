//! For people who read text.

use super::{Report, full_name, tally, verdict};
use crate::verify::study::{Outcome, Study};
use core::fmt::Write;

impl Report<'_> {
    /// For people: Markdown.
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
        out.push_str("\n| study | equations | result | | s |\n|---|---|---|---|---|\n");
        for (study, own) in &self.studies {
            for outcome in own {
                let name = full_name(outcome);
                let equations = study.equations.join(", ");
                let Outcome { sentence, seconds, .. } = outcome;
                let _ = writeln!(
                    out,
                    "| {name} | {equations} | {sentence} | {} | {seconds:.1} |",
                    verdict(outcome)
                );
            }
        }
        for (study, own) in &self.studies {
            details(&mut out, study, own);
        }
        out
    }
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
        for table in &measured.tables {
            out.push('\n');
            for (k, row) in table.iter().enumerate() {
                let _ = writeln!(out, "| {} |", row.join(" | "));
                if k == 0 {
                    let _ = writeln!(out, "|{}", "---|".repeat(row.len()));
                }
            }
        }
        for note in &measured.notes {
            let _ = writeln!(out, "\n{note}.");
        }
        out.push('\n');
    }
}
