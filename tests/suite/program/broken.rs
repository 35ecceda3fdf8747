//! Broken case files, through the program: exit code 3, and who reads the message finds the mistake.

use super::{TINY, errors, program, scratch};
use crate::case_soil::Mistake;
use std::path::Path;

/// What `alluvium check` says of a case that cannot be run.
fn refused(file: &Path, text: &str) -> String {
    std::fs::write(file, text).unwrap();
    let output = program(&["check".as_ref(), file.as_os_str()]);
    let shown = errors(&output);
    assert_eq!(output.status.code(), Some(3), "{shown}");
    shown
}

/// The number of the line that a message points to in `file`, after the file's name.
fn pointed_to(message: &str, file: &Path) -> Option<usize> {
    let place = message.split_once(&format!("--> {}:", file.display()))?.1;
    place.split(':').next()?.parse().ok()
}

/// Whether the message names file, line, key, value and what is allowed, each as far as the mistake has one; the
/// answer is what is missing.
fn left_out(mistake: &Mistake, text: &str, message: &str, file: &Path) -> Option<String> {
    let last = mistake.key.rsplit('.').next().unwrap_or("");
    let name = last.split('[').next().unwrap_or("");
    let value = mistake.value.lines().next().unwrap_or("");
    let Some(line) = pointed_to(message, file) else { return Some("file and line".to_owned()) };
    let Some(there) = text.lines().nth(line - 1) else { return Some(format!("line {line}")) };
    let Some((what, allowed)) = message.split_once("= allowed: ") else {
        return Some("what is allowed".to_owned());
    };
    let shows = |part: &str| what.contains(part);
    // A value stands on the line pointed to, behind its key.
    let is_there = value.is_empty() || (there.contains(value) && there.contains(name));
    let parts = [
        (shows(last), "key"),
        (shows(value), "value"),
        (is_there, "the right line"),
        (shows(&format!("{line} | {}", there.trim_end())), "the line itself"),
        (allowed.contains(mistake.allowed), "what is allowed"),
    ];
    parts.into_iter().find(|(named, _)| !named).map(|(_, part)| part.to_owned())
}

/// The message about one mistake among all that are shown.
fn about<'a>(shown: &'a str, what: &str) -> &'a str {
    let found =
        shown.split("error: ").find(|message| message.contains(what) && message.contains("= allowed: "));
    found.unwrap_or_else(|| panic!("no `{what}` in\n{shown}"))
}

#[test]
fn every_broken_case_is_answered_with_3_and_all_five_parts() {
    let folder = scratch("broken-cases");
    let file = folder.join("case.toml");
    let cases = [
        (crate::case::GOOD, crate::case::MISTAKES),
        (crate::case_soil::SAND, crate::case_soil::MISTAKES),
        (crate::case_mixture::JET, crate::case_mixture::MISTAKES),
    ];
    let mut whole = 0;
    for (good, mistakes) in cases {
        for mistake in mistakes {
            let text = good.replacen(mistake.from, mistake.to, 1);
            let shown = refused(&file, &text);
            let missing = left_out(mistake, &text, about(&shown, mistake.what), &file);
            assert_eq!(missing, None, "`{}` is answered with\n{shown}", mistake.to);
            whole += usize::from(!mistake.key.is_empty() && !mistake.value.is_empty());
        }
    }
    assert!(whole >= 60, "{whole} mistakes have a key and a value");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// What a message leaves out is found: the check above is no mere form.
#[test]
fn a_message_without_one_of_the_parts_is_found() {
    let folder = scratch("broken-words");
    let file = folder.join("case.toml");
    let mistake =
        crate::case_soil::MISTAKES.iter().find(|it| it.key == "soil.bulk_modulus_pa" && it.to == "-0.7e6");
    let mistake = mistake.unwrap();
    let text = crate::case_soil::SAND.replacen(mistake.from, mistake.to, 1);
    let shown = refused(&file, &text);
    let message = about(&shown, mistake.what);
    let line = pointed_to(message, &file).unwrap();
    let without = |from: &str, to: &str| left_out(mistake, &text, &message.replace(from, to), &file);
    assert_eq!(without("", ""), None);
    assert_eq!(without(&file.display().to_string(), "case").unwrap(), "file and line");
    assert_eq!(without(&format!("toml:{line}:"), &format!("toml:{}:", line + 1)).unwrap(), "the right line");
    assert_eq!(without("bulk_modulus_pa", "modulus").unwrap(), "key");
    assert_eq!(without("-0.7e6", "it").unwrap(), "value");
    assert_eq!(without("above", "over").unwrap(), "what is allowed");
    assert_eq!(without("= allowed: ", "= only: ").unwrap(), "what is allowed");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// What only the program or the case's precision refuses is shown in the file, too, whether it is checked or run.
#[test]
fn what_the_program_lacks_is_shown_where_it_stands() {
    let folder = scratch("refused");
    let file = folder.join("case.toml");
    let kernel = TINY.replace("[particles]", "[particles]\nkernel = \"cubic-spline\"");
    let small = format!("precision = \"f32\"\n{TINY}")
        .replace("spacing_m = 0.02", "spacing_m = 1e-12")
        .replace("[0.1, 0.1]", "[1e-11, 1e-11]")
        .replace("[0.2, 0.2]", "[2e-11, 2e-11]")
        .replace("[0.05, 0.01]", "[0.0, 0.0]");
    let weightless =
        TINY.replace("end_time_s", "precision = \"f32\"\ngravity_m_per_s2 = [0.0, 0.0]\nend_time_s");
    let silent = weightless.replace("sound_speed_m_per_s = 20.0", "sound_speed_m_per_s = 1e-60");
    let run = |text: &str| {
        let output = super::run(&folder, text);
        assert_eq!(output.status.code(), Some(3), "{}", errors(&output));
        assert!(!folder.join("out").exists(), "nothing was begun");
        errors(&output)
    };
    let lines = |text: &str, key: &str| text.lines().position(|line| line.starts_with(key)).unwrap() + 1;
    for shown in [refused(&file, &kernel), run(&kernel)] {
        assert_eq!(pointed_to(&shown, &file), Some(lines(&kernel, "kernel")), "{shown}");
        assert!(shown.contains("`particles.kernel = \"cubic-spline\"` is the library's alone"), "{shown}");
        assert!(shown.contains("= allowed: \"wendland-c2\", \"wendland-c4\""), "{shown}");
    }
    for shown in [refused(&file, &small), run(&small)] {
        assert_eq!(pointed_to(&shown, &file), Some(lines(&small, "spacing_m")), "{shown}");
        assert!(
            shown.contains("`particles.spacing_m = 1e-12` makes the smoothing length 1.300e-12 m"),
            "{shown}"
        );
        assert!(
            shown.contains("too short for f32 numbers") && shown.contains("= allowed: at least 1.0"),
            "{shown}"
        );
    }
    let shown = run(&silent);
    assert_eq!(pointed_to(&shown, &file), Some(lines(&silent, "precision")), "{shown}");
    assert!(shown.contains("`precision = \"f32\"` makes sound_speed = 0 of the case's value"), "{shown}");
    assert!(shown.contains("= allowed: a positive speed [m/s]; or precision = \"f64\""), "{shown}");
    std::fs::remove_dir_all(&folder).unwrap();
}
