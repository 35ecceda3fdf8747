//! What runs in SIMD lanes is `#[inline(always)]` and free of closures: a function that is neither
//! loses the instruction set it is called for, and is slow without being wrong.

use crate::source::library;

/// A function: where it is, what stands before its body, and the body.
struct Function {
    head: String,
    body: String,
}

/// All functions in some code that are generic over a number or its lanes, by their own signature or
/// that of the block around them.
fn lane_functions(code: &str) -> Vec<Function> {
    let mut functions = Vec::new();
    let mut open: Vec<(String, usize)> = Vec::new();
    let mut head_start = 0;
    for (at, c) in code.char_indices() {
        match c {
            '{' => {
                open.push((code[head_start..at].to_owned(), at + 1));
                head_start = at + 1;
            }
            '}' => {
                let (head, body_start) = open.pop().unwrap();
                let around = open.iter().any(|(head, _)| head.contains("impl") && in_lanes(head));
                if head.contains("fn ") && (in_lanes(&head) || around) {
                    functions.push(Function { body: code[body_start..at].to_owned(), head });
                }
                head_start = at + 1;
            }
            ';' if !inside_brackets(&code[head_start..at]) => head_start = at + 1,
            _ => {}
        }
    }
    functions
}

fn in_lanes(head: &str) -> bool {
    ["N: Num", "L: Lanes"].iter().any(|bound| head.contains(bound))
}

/// `[N; D]` and the like: a semicolon that ends nothing.
fn inside_brackets(text: &str) -> bool {
    text.matches('[').count() > text.matches(']').count()
}

/// Whether some code makes a closure: a bar where an expression begins.
fn has_closure(code: &str) -> bool {
    code.match_indices('|').any(|(at, _)| {
        let before = code[..at].trim_end();
        before.is_empty() || before.ends_with(['(', ',', '=', '{', ';', '>']) || before.ends_with("move")
    })
}

/// Where the pair loops and the formulas live.
const IN_LANES: [&str; 5] = ["kernel/", "lanes/", "mixture/", "summation/", "neighbours/sliced_list"];

#[test]
fn no_closures_in_lanes() {
    let (mut seen, mut wrong) = (0, Vec::new());
    for source in library().iter().filter(|s| IN_LANES.iter().any(|part| s.path.starts_with(part))) {
        for function in lane_functions(&source.code()) {
            seen += 1;
            let head = function.head.trim();
            if has_closure(&function.body) {
                wrong.push(format!("{}: a closure in {head}", source.path));
            }
            if !head.contains("#[inline(always)]") {
                wrong.push(format!("{}: no #[inline(always)] on {head}", source.path));
            }
        }
    }
    assert!(seen > 40, "only {seen} functions found");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn closures_are_noticed_and_bars_are_not() {
    assert!(
        has_closure("x.map(|y| y + 1)") && has_closure("let f = move |y| y;") && has_closure("g(a, || b)")
    );
    assert!(!has_closure("a | b") && !has_closure("if a || b") && !has_closure("(1u32 << k) | mask"));
    let code =
        "impl<N: Num> A<N> { #[inline(always)] fn f(x: [N; 2]) { x.map(|y| y) } } fn g<T>() { h(|| 1) }";
    let functions = lane_functions(code);
    assert_eq!(functions.len(), 1);
    assert!(has_closure(&functions[0].body) && functions[0].head.contains("inline"));
}
