//! Programs of a few lines that have to do with each other: subs, conditions, loops and calls, whole and broken.
//!
//! Generated programs are right for the most part, and bytes are not: neither has a broken sub in a skipped condition in a loop.

use gaugeblock_fuzz_targets::any_bytes;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

const LINES: &[&str] = &[
    "o7 do",
    "o7 while [0]",
    "o7 break",
    "o1 while [0]",
    "o1 while !",
    "o1 endwhile",
    "o1 endwhile !",
    "o2 if [0]",
    "o2 else",
    "o2 endif",
    "o2 endif !",
    "o3 repeat [2]",
    "o3 endrepeat",
    "o3 endrepeat !",
    "o5 sub",
    "o5 sub !",
    "o5 endsub",
    "o5 return !",
    "o5 call",
    "o5 call !",
    "o6 sub !",
    "o6 endsub",
    "o6 endsub !",
    "o#2 sub",
    "o#2 sub !",
    "o0 endsub",
    "o100",
    "o100 !",
    "m98 p100",
    "m99",
    "%",
    "m8",
    "m2",
];

/// How many programs; the nightly run asks for more.
fn programs() -> u32 {
    let asked = std::env::var("GAUGEBLOCK_LINES").ok();
    asked.map_or(20_000, |count| count.parse().expect("GAUGEBLOCK_LINES is a number"))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: programs(), ..ProptestConfig::default() })]

    /// Model and production do the same with them.
    #[test]
    fn lines_that_have_to_do_with_each_other_do_the_same(lines in vec(select(LINES), 2..12)) {
        any_bytes((lines.join("\n") + "\nm9\nm2\n").as_bytes());
    }
}
