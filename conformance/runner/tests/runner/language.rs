//! Editions with a part of the language: cases that need more are left out.

use std::collections::BTreeSet;
use std::num::NonZero;

use gaugeblock_controllers::Reference;
use gaugeblock_runner::certify::{Plan, Scope, certify};
use gaugeblock_runner::language::{check_program, read_suite};
use gaugeblock_suite::{Suite, scenario_of};

fn suite() -> Suite {
    read_suite(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

/// The names of the cases of a rule that run under an edition.
fn names_run(suite: &Suite, edition: &str, rule: &str) -> BTreeSet<String> {
    let edition = suite.edition(edition).expect("an edition of the suite");
    let only = [rule.to_owned()];
    let jobs = NonZero::<usize>::MIN;
    let plan = Plan { suite, edition, only: &only, jobs, scope: Scope::AssertionsOnly };
    let run = certify(plan, &Reference::default(), &|| {});
    let of_rule = run.cases.iter().filter(|result| result.rule.id == rule);
    of_rule.map(|result| result.name.to_owned()).collect()
}

#[test]
fn case_beyond_the_language_of_an_edition_is_left_out() {
    let suite = suite();
    let grbl = names_run(&suite, "grbl-1.1", "offsets.set");
    let linuxcnc = names_run(&suite, "linuxcnc-2.9", "offsets.set");
    let beyond = "six axes";
    assert!(linuxcnc.contains(beyond) && !grbl.contains(beyond), "{grbl:?}");
    assert!(grbl.contains("from the machine origin"), "{grbl:?}");
}

#[test]
fn each_case_of_an_edition_is_in_its_language() {
    let suite = suite();
    for edition in &suite.editions {
        let Some(language) = &edition.has else { continue };
        let options = suite.options(edition);
        let rules = suite.rules.iter().filter(|rule| rule.exists_in(edition));
        let cases: Vec<_> =
            rules.flat_map(|rule| &rule.cases).filter(|case| case.runs_in(edition)).collect();
        assert!(cases.len() > 500, "{}: {} cases", edition.id, cases.len());
        for case in cases {
            let checked = check_program(language, &scenario_of(case, &options, edition));
            assert_eq!(checked, Ok(()), "{}: {}", edition.id, case.name);
        }
    }
}
