//! The suite as it is built in: in its form, complete, and in agreement with the model.

use std::num::NonZero;
use std::ops::ControlFlow;

use gaugeblock_controllers::Reference;
use gaugeblock_runner::certify::{CaseResult, Plan, RepeatSampling, RunOptions, Scope, run_plan};
use gaugeblock_runner::fingerprint::{ObservedOption, fingerprint};
use gaugeblock_runner::shard::Shard;
use gaugeblock_runner::suite_check;
use gaugeblock_suite::{Suite, scenario_of};
use gaugeblock_vocabulary::Options;

fn suite() -> Suite {
    gaugeblock_runner::language::read_suite(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

#[test]
fn every_declared_outcome_is_reached_and_every_golden_is_current() {
    let faults = suite_check::faults(&suite());
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn model_has_each_option_that_it_is_given() {
    let suite = suite();
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let controller = Reference::default();
    let mut wrong = Vec::new();
    for choice in &suite.choices {
        for option in &choice.options {
            let mut options = suite.options(edition);
            options.0.insert(choice.id.clone(), option.name.clone());
            options.0.extend(choice.under.clone());
            let mut alone = suite.clone();
            alone.choices.retain(|other| other.id == choice.id);
            for (_, shown) in fingerprint(&alone, &options, None, &controller) {
                if shown != ObservedOption::Option(option.name.clone()) {
                    wrong.push(format!("{} = {}: shows {shown:?}", choice.id, option.name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} options:\n{}", wrong.len(), wrong.join("\n"));
}

/// A case counts as refused if one of its assertions says so under any option, and as accepted otherwise.
/// The cells of grids do not count: a grid varies the values of one sentence. `twins` checks that each rule has a case
/// that is accepted and one that is refused.
#[test]
fn at_least_as_many_cases_assert_a_refusal_as_do_not() {
    let suite = suite();
    let (refused, accepted): (Vec<_>, Vec<_>) = suite
        .rules
        .iter()
        .flat_map(|rule| rule.cases.iter().filter(|case| case.grid.is_none()))
        .partition(|case| case.assertions.iter().any(|text| text.contains("refused")));
    let (refused, accepted) = (refused.len(), accepted.len());
    assert!(refused >= accepted, "{refused} cases are refused, {accepted} are accepted");
}

/// Cases are written for the options of the documents' editions. Under another option of a choice that no document
/// decides, no rule diverges by them.
#[test]
fn no_rule_is_broken_by_an_option_that_documents_leave_open() {
    let suite = suite();
    for (edition, choice, option) in [
        ("linuxcnc-2.9", "pause.pallet-codes", "table"),
        ("linuxcnc-2.9", "units-planes.feed-over-unit-change", "kept"),
        ("nct-99m", "nct.loops", "refused"),
    ] {
        let edition = suite.edition(edition).expect("the edition");
        let choices = suite.choices.iter().find(|it| it.id == choice).expect(choice);
        assert!(
            suite.is_open(choices, edition) && !suite.options(edition).is(choice, option),
            "{choice}"
        );
        let options = Options([(choice.to_owned(), option.to_owned())].into());
        let plan = Plan {
            suite: &suite,
            edition,
            only: &[],
            jobs: NonZero::<usize>::MIN,
            scope: Scope::Full,
        };
        let run_options = RunOptions {
            shard: Shard::WHOLE,
            options,
            finished: Vec::new(),
            repeat: RepeatSampling(0),
            shrink_attempts: 0,
            model: None,
            on_result: &mut |_| ControlFlow::Continue(()),
        };
        let run = run_plan(plan, &Reference::default(), run_options);
        let broken = run.cases.iter().filter(|case| case.verdict.own_divergence().is_some());
        let broken: Vec<_> = broken.map(|case| (&case.rule.id, case.name)).collect();
        assert!(broken.is_empty(), "{choice} = {option}: {broken:?}");
        let spared =
            |case: &&CaseResult<'_>| case.masked.contains("an assertion for another option");
        assert!(run.cases.iter().filter(spared).count() > 0, "{choice} = {option}");
    }
}

/// The search for the cause of a divergence leaves out options that the program does not consult. Each option is tried
/// on a few cases, other ones for each option.
#[test]
fn an_option_that_a_run_does_not_consult_changes_nothing() {
    const CASES: usize = 12;
    let suite = suite();
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let language = edition.language;
    let rules = suite.rules.iter().filter(|rule| rule.language == language);
    let cases: Vec<_> = rules.flat_map(|rule| &rule.cases).collect();
    let own = suite.options(edition);
    let mut seed = 0;
    for choice in suite.choices.iter().filter(|choice| choice.language == language) {
        for option in choice.options.iter().filter(|it| own.get(&choice.id) != Some(&it.name)) {
            for _ in 0..CASES {
                seed += 7_919;
                let scenario = scenario_of(cases[seed % cases.len()], &own, edition);
                let (expected, consulted) = gaugeblock_reference::run_consulting(&scenario);
                assert_eq!(expected, gaugeblock_reference::run(&scenario).0);
                let mut other = scenario.clone();
                other.options.0.insert(choice.id.clone(), option.name.clone());
                if !consulted.expect("known for RS-274").contains(choice.id.as_str()) {
                    let found = gaugeblock_reference::run(&other).0;
                    assert_eq!(
                        found, expected,
                        "{} = {}: {}",
                        choice.id, option.name, scenario.program.main
                    );
                }
            }
        }
    }
}
