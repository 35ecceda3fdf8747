//! For people who look: one page that needs nothing but a browser.

use super::{Report, tally, verdict};
use crate::verify::expected::{Expected, Measured};
use crate::verify::plot::convergence_chart;
use crate::verify::study::{Outcome, Study};
use core::fmt::Write;

const STYLE: &str = "
body { font: 15px/1.5 Helvetica, Arial, 'DejaVu Sans', sans-serif; color: #222; background: #fff; max-width: 62rem;
  margin: 2rem auto; padding: 0 1rem }
h2 { margin: 2.2rem 0 .4rem; border-bottom: 1px solid #ccc }
table { border-collapse: collapse; margin: .6rem 0 } td, th { padding: .15rem .7rem; text-align: left;
  border-bottom: 1px solid #e4e4e4; font-variant-numeric: tabular-nums }
summary { cursor: pointer; padding: .2rem 0 } details { border-bottom: 1px solid #eee } details > div { padding: 0 1.2rem .8rem }
.mark { display: inline-block; min-width: 5.6rem; font-weight: bold } .good { color: #00694a } .bad { color: #b3261e } .short { color: #8a5a00 }
.number { color: #555 } svg { display: block; max-width: 44rem; width: 100%; height: auto }
.bar { display: inline-block; width: 12rem; height: .6rem; background: #eee; vertical-align: middle }
.bar i { display: block; height: 100%; background: #0072b2 } .bar i.over { background: #b3261e }
body.failures details.passed { display: none }";

const SCRIPT: &str = "document.getElementById('only').onchange = e => \
                      document.body.classList.toggle('failures', e.target.checked)";

impl Report<'_> {
    /// For people: one self-contained page with a chart of each convergence.
    pub fn html(&self) -> String {
        let e = &self.environment;
        let build = if e.optimised { "release" } else { "debug" };
        let mut out = format!(
            "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>alluvium: verification</title>\n\
             <meta name=\"viewport\" content=\"width=device-width\"><style>{STYLE}</style>\n<h1>Verification</h1>\n<table>"
        );
        let rows = [
            ("processor", format!("{}, {} threads, {}", e.processor, e.cores, e.instructions)),
            ("compiler", format!("{}, {build} build", e.compiler)),
            ("commit", e.commit.clone()),
            ("studies", tally(self.outcomes().filter(|o| o.mutant.is_none()), "passed")),
            ("deliberate mistakes", tally(self.outcomes().filter(|o| o.mutant.is_some()), "caught")),
        ];
        for (name, value) in rows {
            let _ = write!(out, "<tr><th>{name}<td>{}", escaped(&value));
        }
        out.push_str("</table>\n<label><input type=\"checkbox\" id=\"only\"> only what failed or falls short</label>\n");
        let mut topic = "";
        for (study, own) in &self.studies {
            let here = study.name.split('/').next().unwrap_or_default();
            if here != topic {
                topic = here;
                let _ = writeln!(out, "<h2 id=\"{0}\">{0}</h2>", escaped(topic));
            }
            write_study(&mut out, study, own);
        }
        let _ = writeln!(out, "<script>{SCRIPT}</script></html>");
        out
    }
}

fn write_study(out: &mut String, study: &Study, own: &[&Outcome]) {
    let (good, short) =
        (own.iter().all(|outcome| outcome.is_good()), own.iter().any(|outcome| outcome.falls_short()));
    let class = if good && !short { "passed" } else { "missed" };
    let open = if good { "" } else { " open" };
    let _ = write!(out, "<details class=\"{class}\"{open}><summary>");
    for outcome in own.iter().filter(|outcome| outcome.mutant.is_none()) {
        mark(out, outcome);
    }
    let _ = write!(out, "{}</summary><div><p>{}.", escaped(&study.name), escaped(&study.claim));
    if !study.equations.is_empty() {
        let _ = write!(out, " <span class=\"number\">Eq. ({})</span>", study.equations.join("), ("));
    }
    if !study.source.is_empty() {
        let _ = write!(out, "<br><span class=\"number\">Source: {}.</span>", escaped(&study.source));
    }
    for outcome in own {
        out.push_str("<p>");
        if let Some(mutant) = &outcome.mutant {
            mark(out, outcome);
            let _ = write!(out, "mistake: {} — ", escaped(mutant));
        }
        let _ = write!(
            out,
            "{} <span class=\"number\">{:.1} s</span>",
            escaped(&outcome.sentence),
            outcome.seconds
        );
        if let (None, Some(measured)) = (&outcome.mutant, &outcome.measured) {
            write_measured(out, study, measured);
        }
    }
    out.push_str("</div></details>\n");
}

fn mark(out: &mut String, outcome: &Outcome) {
    let class = match outcome.is_good() {
        true if outcome.falls_short() => "short",
        true => "good",
        false => "bad",
    };
    let _ = write!(out, "<span class=\"mark {class}\">{}</span>", verdict(outcome).trim_matches('*'));
}

fn write_measured(out: &mut String, study: &Study, measured: &Measured) {
    let orders = measured.orders();
    if orders.is_empty() {
        write_values(out, study.expected, measured);
    } else {
        let pairs: Vec<_> = measured.points.iter().map(|point| (point.spacing, point.value)).collect();
        let expected = match study.expected {
            Expected::Order { at_least, at_most } if at_most.is_finite() => Some(0.5 * (at_least + at_most)),
            _ => None,
        };
        let labels = [study.name.as_str(), "resolution", "error"];
        out.push_str(&convergence_chart(labels, &pairs, expected).0.svg());
        out.push_str("<table><tr><th>resolution<th>error<th>order");
        for (k, point) in measured.points.iter().enumerate() {
            let order =
                k.checked_sub(1).and_then(|k| orders.get(k)).map_or(String::new(), |p| format!("{p:.3}"));
            let _ = write!(out, "<tr><td>{:.4e}<td>{:.4e}<td>{order}", point.spacing, point.value);
        }
        out.push_str("</table>");
    }
    for table in &measured.tables {
        out.push_str("<table>");
        for (k, row) in table.iter().enumerate() {
            let cell = if k == 0 { "<th>" } else { "<td>" };
            let _ = write!(
                out,
                "<tr>{}",
                row.iter().map(|text| cell.to_owned() + &escaped(text)).collect::<String>()
            );
        }
        out.push_str("</table>");
    }
    for note in &measured.notes {
        let _ = write!(out, "<p class=\"number\">{}.", escaped(note));
    }
    for picture in &measured.pictures {
        out.push_str(picture);
    }
}

/// Values, each with a bar of how far it comes towards what is allowed.
fn write_values(out: &mut String, expected: Expected, measured: &Measured) {
    out.push_str("<table>");
    for point in &measured.points {
        let allowed = match expected {
            Expected::Bound { largest } => Some(point.value.abs() / largest),
            Expected::Value { value, tolerance } => Some((point.value - value).abs() / tolerance),
            _ => None,
        };
        let _ = write!(out, "<tr><td>{}<td>{:.6e}<td>", escaped(&point.label), point.value);
        if let Some(used) = allowed.filter(|used| used.is_finite()) {
            let over = if used > 1.0 { " class=\"over\"" } else { "" };
            let width = 100.0 * used.min(1.0);
            let _ = write!(
                out,
                "<span class=\"bar\"><i{over} style=\"width:{width:.1}%\"></i></span> {:.1} %",
                100.0 * used
            );
        }
    }
    out.push_str("</table>");
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
