//! For programs.

use super::Report;
use crate::verify::expected::Measured;
use crate::verify::json;
use crate::verify::study::{Outcome, Standing};
use core::fmt::Write;

impl Outcome {
    /// For programs: JSON, without a line break.
    pub fn json(&self) -> String {
        let mut out = String::new();
        outcome_json(&mut out, self);
        out
    }
}

impl Report<'_> {
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

/// One outcome.
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
    json::name(out, "met");
    out.push_str(if outcome.standing == Standing::Met { "true" } else { "false" });
    json::name(out, "falls short");
    out.push_str(if outcome.standing == Standing::FallsShort { "true" } else { "false" });
    json::name(out, "finished");
    out.push_str(if outcome.measured.is_some() { "true" } else { "false" });
    json::name(out, "seconds");
    json::number(out, outcome.seconds);
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
    let texts = |out: &mut String, name: &str, texts: fn(&Measured) -> &Vec<String>| {
        json::name(out, name);
        json::list(out, outcome.measured.iter().flat_map(texts), |out, text| json::text(out, text));
    };
    texts(out, "notes", |measured| &measured.notes);
    texts(out, "pictures", |measured| &measured.pictures);
    json::name(out, "tables");
    json::list(out, outcome.measured.iter().flat_map(|measured| &measured.tables), |out, table| {
        json::list(out, table, |out, row| json::list(out, row, |out, text| json::text(out, text)));
    });
    out.push('}');
}
