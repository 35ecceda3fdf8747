//! Broken cases: each is one mistake in a good one, and has to be answered where it is.

use alluvium::case::Case;

/// One mistake: this text is replaced, the message names this key, value and these words.
pub struct Mistake {
    pub from: &'static str,
    pub to: &'static str,
    pub key: &'static str,
    pub value: &'static str,
    pub what: &'static str,
    pub allowed: &'static str,
}

/// The first line in which two texts differ, counted from one.
fn first_changed_line(good: &str, text: &str) -> usize {
    good.lines().zip(text.lines()).take_while(|(a, b)| a == b).count() + 1
}

/// Each mistake in the good case is found, shown at its place, and told what is allowed instead.
pub fn assert_named(good: &str, mistakes: &[Mistake]) {
    for Mistake { from, to, key, value, what, allowed } in mistakes {
        assert!(good.contains(from), "{from}");
        let text = good.replacen(from, to, 1);
        let error = Case::parse("case.toml", &text).expect_err(to);
        let shown = error.to_string();
        let found = error.problems.iter().find(|p| p.key == *key && p.what.contains(what));
        let found = found.unwrap_or_else(|| panic!("`{to}`: no `{what}` for `{key}` in\n{shown}"));
        assert!(found.value.contains(value), "`{to}`: value `{}`", found.value);
        assert!(found.allowed.contains(allowed), "`{to}`: allowed `{}`", found.allowed);
        if !key.is_empty() {
            assert!(found.what.contains(key.rsplit('.').next().unwrap()), "`{to}`: {}", found.what);
        }
        assert!(shown.contains(&format!("--> case.toml:{}:{}\n", found.line, found.column)), "{shown}");
        assert!(shown.contains(&format!("= allowed: {}", found.allowed)), "{shown}");
        assert_eq!(text.lines().nth(found.line - 1).map(str::trim_end), Some(found.text.as_str()), "{shown}");
        // Where two parts do not go together, either may be shown.
        let either = what.contains("overlaps") || what.contains("stands beside");
        if !value.is_empty() && !either {
            assert!(found.text.contains(value.lines().next().unwrap()), "`{to}`: line {}", found.line);
            let away = found.line.abs_diff(first_changed_line(good, &text));
            assert!(away <= 3 || to.contains("axes"), "{shown}");
        }
    }
}
