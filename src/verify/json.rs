//! The little JSON a report needs.

/// A text in quotes.
pub(super) fn text(out: &mut String, text: &str) {
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            c if c < ' ' => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
}

/// A number with all its digits; `null` where JSON has none.
pub(super) fn number(out: &mut String, x: f64) {
    if x.is_finite() { out.push_str(&format!("{x:e}")) } else { out.push_str("null") }
}

/// Items between brackets, with commas.
pub(super) fn list<X>(
    out: &mut String,
    items: impl IntoIterator<Item = X>,
    mut write: impl FnMut(&mut String, X),
) {
    out.push('[');
    for (k, item) in items.into_iter().enumerate() {
        if k > 0 {
            out.push(',');
        }
        write(out, item);
    }
    out.push(']');
}

/// `"name":`, after a comma unless it is the first.
pub(super) fn name(out: &mut String, name: &str) {
    if !out.ends_with('{') {
        out.push(',');
    }
    text(out, name);
    out.push(':');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_needs_escaping_is_escaped() {
        let mut out = String::from("{");
        name(&mut out, "a");
        text(&mut out, "\"\\\n\u{1}é");
        name(&mut out, "b");
        list(&mut out, [1.5e-10, f64::NAN], number);
        assert_eq!(out, "{\"a\":\"\\\"\\\\\\n\\u0001é\",\"b\":[1.5e-10,null]");
    }
}
