//! Every relative link of the documents leads to a file of the repository, and every `#anchor` to a
//! heading or an `<a id>` in it.

use crate::source::root;
use std::fs;
use std::path::{Path, PathBuf};

/// README, changelog and all that is in `docs/`.
fn documents() -> Vec<PathBuf> {
    let mut files = vec![root().join("README.md"), root().join("CHANGELOG.md")];
    let mut folders = vec![root().join("docs")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// Where the links `[…](target)` of some Markdown lead, code left out.
fn targets(text: &str) -> Vec<&str> {
    let mut fenced = false;
    let mut found = Vec::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            for prose in line.split('`').step_by(2) {
                let targets = prose.split("](").skip(1).filter_map(|rest| rest.split([')', ' ']).next());
                found.extend(targets);
            }
        }
    }
    found
}

/// The name of a heading in a link, as the forges make it.
fn anchor(heading: &str) -> String {
    let kept = |c: char| c.is_alphanumeric() || c == '-' || c == '_' || c == ' ';
    heading.trim().to_lowercase().chars().filter(|c| kept(*c)).collect::<String>().replace(' ', "-")
}

fn has_anchor(text: &str, name: &str) -> bool {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    text.contains(&format!("<a id=\"{name}\">"))
        || headings.map(|line| anchor(line.trim_start_matches('#'))).any(|heading| heading == name)
}

/// What is wrong with a link of the document at `path`.
fn wrong(path: &Path, text: &str, target: &str) -> Option<String> {
    let (file, name) = target.split_once('#').map_or((target, None), |(file, name)| (file, Some(name)));
    let other = path.parent().unwrap().join(file);
    if !file.is_empty() && !other.exists() {
        return Some(format!("{}: `{target}` leads nowhere", path.display()));
    }
    let there = if file.is_empty() { text.to_owned() } else { fs::read_to_string(other).unwrap_or_default() };
    let lost = name.is_some_and(|name| !has_anchor(&there, name));
    lost.then(|| format!("{}: nothing is called `{target}`", path.display()))
}

#[test]
fn every_relative_link_resolves() {
    let (mut count, mut lost) = (0, Vec::new());
    for path in documents() {
        let text = fs::read_to_string(&path).unwrap();
        for target in targets(&text).into_iter().filter(|target| !target.contains("://")) {
            count += 1;
            lost.extend(wrong(&path, &text, target));
        }
    }
    assert!(lost.is_empty(), "{lost:#?}");
    assert!(count > 20, "only {count} links found");
}

#[test]
fn a_lost_link_is_noticed() {
    let text =
        "See [a](b.md), ![c](d.png \"e\") and `[no](link)`.\n```\n[no](link)\n```\n[f](#a-step-twice)\n";
    assert_eq!(targets(text), ["b.md", "d.png", "#a-step-twice"]);
    let readme = root().join("README.md");
    assert!(wrong(&readme, "", "docs/errata.md#a1").is_none() && wrong(&readme, "", "src").is_none());
    assert!(wrong(&readme, "", "docs/nothing.md").is_some());
    assert!(wrong(&readme, "", "docs/errata.md#a99").is_some());
    assert!(wrong(&readme, "## A step, twice\n", "#a-step-twice").is_none());
}
