//! No program makes the model panic, and none makes it run on.

use gaugeblock_reference::run;
use gaugeblock_vocabulary::Scenario;
use proptest::prelude::*;

/// Pieces that programs are made of, put together without care.
const PIECES: &[&str] = &[
    "o1 sub",
    "o1 endsub",
    "o1 endsub [#1]",
    "o1 call",
    "o1 call [1] [2]",
    "o1 return",
    "o2 sub",
    "o2 endsub",
    "o2 call",
    "o[#1] call",
    "o<cave> call",
    "o1 if [#1 lt 2]",
    "o1 elseif [#1]",
    "o1 else",
    "o1 endif",
    "o2 if [1]",
    "o2 endif",
    "o2 while [#2 lt 3]",
    "o2 endwhile",
    "o2 do",
    "o2 break",
    "o2 continue",
    "o3 repeat [2]",
    "o3 repeat [-1]",
    "o3 repeat [1e300]",
    "o3 endrepeat",
    "o3 break",
    "o[1e300] if [1]",
    "o#<x> endif",
    "o5",
    "m98 p5",
    "m98 p5 l3",
    "m98 p-1 l0.5",
    "m98 p1e300 l1e300",
    "m99",
    "m2",
    "%",
    "",
    "/g0 x1",
    "#1 = [#1 + 1]",
    "#2 = [#2 + 1]",
    "g0 x#1",
    "g1 f10 y1",
    "m70",
    "m72",
    "m73",
    "m71",
    "g20",
    "(MSG,#1)",
    "#[1e300] = 1",
    "#1 = [1 / 0]",
    "no block",
    "g91",
    "\u{e4}\u{1F600}",
    "o",
    "o<",
    "o[",
    "o1 if [",
    "n",
    "#",
    "(",
];

fn scenario(lines: &[&str], file: &[&str], block_delete: bool) -> Scenario {
    let mut scenario = Scenario::of(lines.join("\n"));
    scenario.program.files.insert("cave.ngc".to_owned(), file.join("\n"));
    scenario.program.block_delete = block_delete;
    scenario.budget.steps = 500;
    scenario
}

fn lines(most: usize) -> impl Strategy<Value = Vec<&'static str>> {
    proptest::collection::vec(proptest::sample::select(PIECES), 0..most)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_heap_of_pieces_makes_it_panic(main in lines(30), file in lines(8), block_delete: bool) {
        let _outcome = run(&scenario(&main, &file, block_delete));
    }

    #[test]
    fn no_text_makes_it_panic(text in "(?s).{0,200}") {
        let mut scenario = Scenario::of(text);
        scenario.budget.steps = 500;
        let _outcome = run(&scenario);
    }

    #[test]
    fn a_run_repeats_itself(main in lines(20)) {
        let scenario = scenario(&main, &[], false);
        prop_assert_eq!(run(&scenario), run(&scenario));
    }
}
