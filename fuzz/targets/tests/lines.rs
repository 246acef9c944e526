//! Programs of a few lines that have to do with each other: subs, conditions, loops and calls, whole and broken, of few labels.
//!
//! Generated programs are right for the most part, and bytes are not: neither has a broken sub in a skipped condition in a loop.

use gaugeblock_fuzz_targets::any_bytes;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

const LABELS: &[&str] = &["1", "1", "2", "2", "3", "100", "#2"];
const KEYWORDS: &[&str] = &[
    "sub",
    "endsub",
    "return",
    "call",
    "if [0]",
    "if [#3 lt 2]",
    "elseif [1]",
    "else",
    "endif",
    "do",
    "while [0]",
    "while [#3 lt 2]",
    "endwhile",
    "repeat [2]",
    "endrepeat",
    "break",
    "continue",
    "",
];
const BROKEN: &[&str] = &[" !", " x1", " [", " (", " #"];
const OTHERS: &[&str] = &["#3=[#3+1]", "m98 p1", "m98 p100", "m99", "%", "m8", "m2", "#2=1", "!"];

/// How many programs; the nightly run asks for more.
fn programs() -> u32 {
    let asked = std::env::var("GAUGEBLOCK_LINES").ok();
    asked.map_or(20_000, |count| count.parse().expect("GAUGEBLOCK_LINES is a number"))
}

fn line() -> impl Strategy<Value = String> {
    let broken = prop_oneof![6 => Just(""), 1 => select(BROKEN)];
    let word = (select(LABELS), select(KEYWORDS), broken)
        .prop_map(|(label, keyword, rest)| format!("o{label} {keyword}{rest}"));
    prop_oneof![5 => word, 1 => select(OTHERS).prop_map(str::to_owned)]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: programs(), ..ProptestConfig::default() })]

    /// Model and production do the same with them.
    #[test]
    fn lines_that_have_to_do_with_each_other_do_the_same(lines in vec(line(), 2..12)) {
        any_bytes((lines.join("\n") + "\nm9\nm2\n").as_bytes());
    }
}
