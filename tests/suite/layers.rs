//! Arrows only down: who may use whom inside the library, and what may be named in one file only.

use crate::source::{Source, has_word, library};

/// Each part with the parts it may use, beside itself and the ground. Summation, material and time do
/// not see each other; a material sees no kernel, time no particle, a search no mass.
const MAY_USE: [(&str, &[&str]); 15] = [
    ("kernel", &[]),
    ("neighbours", &[]),
    ("summation", &["kernel", "neighbours"]),
    ("material", &[]),
    ("driver", &["material"]),
    ("time", &[]),
    ("budget", &["material"]),
    ("setup", &[]),
    ("mixture", METHOD),
    ("preset", &["mixture", "kernel", "material", "time"]),
    ("simulation", &["mixture", "kernel", "neighbours", "summation", "material", "time", "budget", "setup"]),
    ("snapshot", DRIVEN),
    ("output", DRIVEN),
    ("case", DRIVEN),
    ("verify", DRIVEN),
];
const METHOD: &[&str] = &["kernel", "neighbours", "summation", "material", "time", "budget", "setup"];
const DRIVEN: &[&str] = &[
    "kernel",
    "neighbours",
    "summation",
    "material",
    "driver",
    "time",
    "budget",
    "mixture",
    "setup",
    "preset",
    "simulation",
    "snapshot",
    "output",
];
/// What everybody may use.
const GROUND: [&str; 5] = ["real", "space", "lanes", "parallel", "error"];
/// What the crate's root gives under its own name, and whose it is.
const AT_THE_ROOT: [(&str, &str); 8] = [
    ("InstructionSet", "lanes"),
    ("UnknownInstructionSet", "lanes"),
    ("Num", "real"),
    ("Real", "real"),
    ("SymTensor", "space"),
    ("Tensor", "space"),
    ("Vector", "space"),
    ("Preset", "preset"),
];

fn may_use(part: &str, other: &str) -> bool {
    let listed = MAY_USE.iter().find(|(name, _)| *name == part);
    let allowed: &[&str] = if GROUND.contains(&part) {
        &[]
    } else {
        listed.unwrap_or_else(|| panic!("`{part}` has no place in the layers: give it one above")).1
    };
    other == part || GROUND.contains(&other) || allowed.contains(&other)
}

/// The parts named by `crate::…` in some code.
fn used_parts(code: &str) -> Vec<String> {
    let name_at = |text: &str| -> String {
        text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let mut names = Vec::new();
    for (at, found) in code.match_indices("crate::") {
        let rest = &code[at + found.len()..];
        match rest.strip_prefix('{') {
            None => names.push(name_at(rest)),
            Some(list) => {
                // `crate::{a::{b, c}, d}`: the names at depth one.
                let mut depth = 1;
                names.push(name_at(list));
                for (at, c) in list.char_indices() {
                    match c {
                        '{' => depth += 1,
                        '}' => depth -= 1,
                        ',' if depth == 1 => names.push(name_at(&list[at + 1..])),
                        _ => {}
                    }
                    if depth == 0 {
                        break;
                    }
                }
            }
        }
    }
    names.retain(|name| !name.is_empty());
    for name in &mut names {
        if let Some((_, owner)) = AT_THE_ROOT.iter().find(|(at_root, _)| at_root == name) {
            *name = (*owner).to_owned();
        }
    }
    names
}

#[test]
fn arrows_point_down() {
    let mut wrong = Vec::new();
    for source in library().iter().filter(|source| source.path != "lib.rs") {
        for other in used_parts(&source.code()) {
            if !may_use(source.part(), &other) {
                wrong.push(format!("{} uses {other}", source.path));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn an_arrow_up_is_noticed() {
    assert_eq!(used_parts("use crate::{real::{Num, Real}, mixture::Phase};"), ["real", "mixture"]);
    assert_eq!(used_parts("fn f(x: crate::time::Limit) -> crate::Vector<f64, 2>"), ["time", "space"]);
    assert!(!may_use("kernel", "mixture") && !may_use("material", "kernel") && !may_use("time", "summation"));
    assert!(!may_use("real", "kernel") && !may_use("neighbours", "material"));
    assert!(may_use("mixture", "summation") && may_use("kernel", "real"));
}

/// The files whose code has the word, but should not.
fn strangers(word: &str, home: &[&str]) -> Vec<String> {
    let knows = |source: &Source| has_word(&source.code(), word);
    let files: Vec<String> = library().into_iter().filter(knows).map(|source| source.path).collect();
    assert!(!files.is_empty(), "nobody says `{word}`: the test is blind");
    files.into_iter().filter(|path| !home.iter().any(|home| path.starts_with(home))).collect()
}

#[test]
fn each_dependency_has_one_home() {
    assert_eq!(strangers("rayon", &["parallel.rs"]), [""; 0]);
    assert_eq!(strangers("kiddo", &["neighbours/kd_tree.rs"]), [""; 0]);
    assert_eq!(strangers("faer", &["mixture/implicit_drag/cholesky.rs"]), [""; 0]);
    assert_eq!(strangers("nalgebra", &["space/dense.rs"]), [""; 0]);
}

#[test]
fn unsafe_has_three_homes() {
    let homes = ["lanes", "summation/pair_sum", "neighbours/sliced_list"];
    assert_eq!(strangers("unsafe", &homes), [""; 0]);
}

#[test]
fn nothing_prints() {
    for source in library() {
        for word in ["println", "eprintln", "print", "eprint", "dbg"] {
            assert!(!source.code().contains(&format!("{word}!(")), "{} prints", source.path);
        }
    }
}
