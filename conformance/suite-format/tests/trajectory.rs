//! The pages of the laws of motion: each law has one, with good and bad samples and a program, and the table of
//! faults is theirs.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use gaugeblock_reference::Choices;
use gaugeblock_reference::motion::laws::Law;
use gaugeblock_suite::files::of_folder;
use gaugeblock_suite::{MotionAssertion, MotionCase, Rule, Suite};

fn suite() -> Suite {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../suite");
    Suite::read(&of_folder(&folder).expect("the folder of the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

fn pages(suite: &Suite) -> impl Iterator<Item = (&Rule, Law)> {
    let law = |rule: &Rule| Law::ALL.iter().copied().find(|law| law.id() == rule.id);
    suite.rules.iter().filter_map(move |rule| Some((rule, law(rule)?)))
}

fn breaks(case: &MotionCase, law: &str) -> bool {
    let of_law = |found: &MotionAssertion| matches!(found, MotionAssertion::Breaks { law: id, .. } if id == law);
    case.is_recorded() && case.parsed().iter().any(of_law)
}

#[test]
fn each_law_has_a_page_with_good_and_bad_samples_and_a_program() {
    let suite = suite();
    let of_pages: BTreeSet<&str> = pages(&suite).map(|(_, law)| law.id()).collect();
    let all: BTreeSet<&str> = Law::ALL.iter().map(|law| law.id()).collect();
    assert_eq!(of_pages, all);
    for (rule, law) in pages(&suite) {
        let id = law.id();
        let (recorded, planned): (Vec<_>, Vec<_>) =
            rule.motion.iter().partition(|case| case.is_recorded());
        assert!(!planned.is_empty(), "{id} has no program for a planner");
        let good = recorded.iter().filter(|case| case.parsed().contains(&MotionAssertion::Holds));
        assert!(good.count() > 0, "{id} has no samples that keep it");
        assert!(recorded.iter().any(|case| breaks(case, id)), "{id} has no samples that break it");
        assert_eq!(rule.profile, "motion");
    }
}

#[test]
fn a_law_that_is_named_is_one() {
    let suite = suite();
    let cases = suite.rules.iter().flat_map(|rule| &rule.motion);
    for (case, assertion) in
        cases.flat_map(|case| case.parsed().into_iter().map(move |s| (case, s)))
    {
        let (MotionAssertion::Breaks { law, .. }
        | MotionAssertion::NotApplicable { law }
        | MotionAssertion::NotJudged { law }) = assertion
        else {
            continue;
        };
        assert!(Law::ALL.iter().any(|known| known.id() == law), "{}: {law}", case.name);
    }
}

#[test]
fn the_laws_take_each_option_of_the_pages_and_no_other() {
    for choice in &suite().motion_choices {
        let id = choice.id.as_str();
        for option in &choice.options {
            Choices::of_motion([(id, option.name.as_str())]).expect("an option of a page");
        }
        let first = choice.options[0].name.as_str();
        assert_eq!(Choices::of_motion([(id, first)]), Ok(Choices::default()), "{id}");
        assert!(Choices::of_motion([(id, "another")]).is_err());
    }
    assert!(Choices::of_motion([("nct.dwell", "seconds")]).is_err());
}

/// Each fault that the pages plant, and the laws that must find it, as the table of the room's README has it.
#[test]
fn the_table_of_planted_faults_is_that_of_the_pages() {
    let suite = suite();
    let mut table = "| law | fault | found by |\n| --- | --- | --- |\n".to_owned();
    let mut faults = 0;
    for (rule, law) in pages(&suite) {
        for case in rule.motion.iter().filter(|case| breaks(case, law.id())) {
            let found = case.assertions.join("; ").replace("trajectory.", "");
            writeln!(table, "| `{}` | {} | {found} |", law.id(), case.name).expect("a text");
            faults += 1;
        }
    }
    assert!(faults >= 25, "{faults} faults are planted");
    let readme = include_str!("../../suite/trajectory/README.md");
    assert!(readme.contains(&table), "the table of the README is not this one:\n{table}");
}
