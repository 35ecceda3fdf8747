//! `docs/equations.md` and the code agree, both ways: every numbered equation of the paper has a row,
//! every item a row names exists, and every line that cites an equation stands in a file its row names.

use crate::source::{Source, has_word, library, root};
use std::collections::BTreeMap;
use std::fs;

/// The last numbered equation of the paper.
const LAST: usize = 80;

/// One row of the register.
struct Row {
    /// Items `file.rs::name` of the code.
    items: Vec<(String, String)>,
    /// Items `file.rs::name` of tests and studies.
    shown_by: Vec<(String, String)>,
    text: String,
}

fn rows(register: &str) -> BTreeMap<usize, Row> {
    let mut rows = BTreeMap::new();
    for line in register.lines().filter(|line| line.starts_with("| (")) {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        assert_eq!(cells.len(), 5, "five columns: {line}");
        let number = cells[0].trim_matches(['(', ')']).parse().unwrap();
        let row = Row { items: items(cells[2]), shown_by: items(cells[3]), text: line.to_owned() };
        assert!(rows.insert(number, row).is_none(), "({number}) has two rows");
    }
    rows
}

/// What stands in backticks as `path::name`.
fn items(cell: &str) -> Vec<(String, String)> {
    let quoted = cell.split('`').skip(1).step_by(2);
    quoted.filter_map(|item| item.split_once("::")).map(|(a, b)| (a.to_owned(), b.to_owned())).collect()
}

fn register() -> BTreeMap<usize, Row> {
    rows(&fs::read_to_string(root().join("docs/equations.md")).unwrap())
}

/// Whether some text defines `name`: a function, type, constant, module, field, variant, or a type
/// that a macro makes.
fn defines(text: &str, name: &str) -> bool {
    const KEYWORDS: [&str; 7] = ["fn", "struct", "enum", "trait", "const", "type", "mod"];
    text.lines().map(str::trim_start).any(|line| {
        let start = line.strip_prefix("pub ").unwrap_or(line);
        let rest = start.strip_prefix(name);
        KEYWORDS.iter().any(|keyword| has_word(line, &format!("{keyword} {name}")))
            || rest.is_some_and(|rest| rest.starts_with([',', '(', ':']) || rest.starts_with(" {"))
    })
}

#[test]
fn every_equation_has_a_row() {
    let rows = register();
    let missing: Vec<usize> = (1..=LAST).filter(|number| !rows.contains_key(number)).collect();
    assert!(missing.is_empty(), "no row for {missing:?}");
    assert!(rows.keys().all(|number| (1..=LAST).contains(number)));
}

#[test]
fn every_row_names_code_and_what_shows_it_or_says_why_not() {
    for (number, row) in register() {
        let excused = row.text.contains("*theory*");
        assert!(excused || !row.items.is_empty(), "({number}) names neither code nor a reason");
        assert!(excused || !row.shown_by.is_empty(), "({number}) names nothing that shows it");
    }
}

#[test]
fn every_item_exists() {
    for (number, row) in register() {
        for (path, name) in &row.items {
            let text = fs::read_to_string(root().join("src").join(path));
            let text = text.unwrap_or_else(|error| panic!("({number}): src/{path}: {error}"));
            assert!(defines(&text, name), "({number}): src/{path} does not define {name}");
        }
        for (path, name) in &row.shown_by {
            let text = fs::read_to_string(root().join(path));
            let text = text.unwrap_or_else(|error| panic!("({number}): {path}: {error}"));
            assert!(has_word(&text, name), "({number}): {path} does not name {name}");
        }
    }
}

/// The equations cited on lines of code (`// (55)`) and by `Eq. (55)` anywhere.
fn citations(source: &Source) -> Vec<usize> {
    let mut found = Vec::new();
    for line in source.text.lines() {
        let Some(at) = line.find("//") else { continue };
        let comment = &line[at..];
        let is_doc = comment.starts_with("///") || comment.starts_with("//!");
        let comment = if !is_doc {
            comment
        } else if let Some(at) = comment.find("Eq. (") {
            &comment[at..]
        } else {
            continue;
        };
        for piece in comment.split('(').skip(1) {
            let digits = piece.split(')').next().unwrap_or_default();
            found.extend(digits.parse::<usize>().ok().filter(|number| (1..=LAST).contains(number)));
        }
    }
    found
}

/// Parts that carry out equations; the others only speak of them.
fn computes(source: &Source) -> bool {
    !source.is_test() && !["case", "output", "verify", "preset"].contains(&source.part())
}

#[test]
fn every_citation_is_registered() {
    let (rows, mut count) = (register(), 0);
    for source in library().iter().filter(|source| computes(source)) {
        for number in citations(source) {
            count += 1;
            let named = rows[&number].items.iter().any(|(path, _)| *path == source.path);
            assert!(named, "{} cites ({number}), but row ({number}) does not name it", source.path);
        }
    }
    assert!(count > 25, "only {count} citations found");
}

#[test]
fn a_false_row_is_noticed() {
    let rows = rows("| (7) | a | `time/mod.rs::Evolve`, `time/mod.rs::Nothing` | `tests/suite/x.rs::y` | |");
    assert_eq!(rows[&7].items.len(), 2);
    let text = fs::read_to_string(root().join("src/time/mod.rs")).unwrap();
    assert!(defines(&text, "Evolve") && !defines(&text, "Nothing"));
    let source =
        Source { path: "x.rs".into(), text: "a(3); // (52), first\n/// as (9)\n/// Eq. (4), (5)\n".into() };
    assert_eq!(citations(&source), [52, 4, 5]);
}
