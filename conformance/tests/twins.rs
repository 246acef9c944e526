//! How the rules about post-processors and custom macros are held, most of which refuse nothing themselves: by twins, two programs
//! that differ in one line, where what is asserted of the one does not hold of the other.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::path::{Path, PathBuf};

use gaugeblock::adapters::reference::Reference;
use gaugeblock::catalogue::{editions_of, model_run};
use gaugeblock::certify::{Plan, Verdict, certify};
use gaugeblock::suite::{Case, Edition, Rule, RuleOutcome, Setup, Suite, files};

/// The chapters.
const CHAPTERS: [&str; 2] = ["gpp", "nct"];

/// Rules near which the documents demand no refusal: they say what is printed, or what may be done.
const NEVER_REFUSED: [&str; 3] = ["gpp.non-modal-off", "gpp.off-modal", "gpp.off-printed"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("suite")
}

fn suite() -> Suite {
    let files = files::of_folder(&folder()).expect("the suite can be read");
    Suite::read(&files).unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

fn rules(suite: &Suite) -> impl Iterator<Item = &Rule> {
    let is_here = |rule: &&Rule| CHAPTERS.contains(&rule.chapter());
    suite.rules.iter().filter(is_here)
}

/// Everything that a case runs, line by line: the program, its files, and whether block delete is on.
fn lines(case: &Case) -> Vec<(&str, &str)> {
    let main = case.program.lines().map(|line| ("", line));
    let files = case.setup.files.iter();
    let files = files.flat_map(|(name, text)| text.lines().map(move |line| (name.as_str(), line)));
    let block_delete = if case.setup.block_delete { "on" } else { "off" };
    main.chain(files).chain([("block delete", block_delete)]).collect()
}

fn differ_in_one_line(one: &Case, other: &Case) -> bool {
    let rest = |case: &Case| {
        let setup = case.setup.clone();
        Setup { files: BTreeMap::new(), block_delete: false, ..setup }
    };
    let (lines, others) = (lines(one), lines(other));
    let apart = lines.iter().zip(&others).filter(|(line, other)| line != other).count();
    lines.len() == others.len() && apart == 1 && rest(one) == rest(other)
}

/// Whether something that a case asserts does not hold of its twin, in an edition in which both run. `bare` is the suite without
/// its rules.
fn are_twins(bare: &Suite, rule: &Rule, case: &Case, twin: &Case) -> bool {
    if !differ_in_one_line(case, twin) {
        return false;
    }
    let told = Case { assertions: case.assertions.clone(), golden: None, ..twin.clone() };
    let alone = Rule { cases: vec![told], ..rule.clone() };
    let alone = Suite { rules: vec![alone], ..bare.clone() };
    let fails = |edition: &&Edition| {
        let plan = Plan { suite: &alone, edition, only: &[], jobs: NonZero::<usize>::MIN };
        let run = certify(plan, &Reference::default(), &|| {});
        run.cases.iter().any(|case| matches!(case.verdict, Verdict::Diverges(_)))
    };
    editions_of(bare, rule, case).iter().any(fails)
}

/// Whether a case reaches its rule in the model.
fn reaches(bare: &Suite, rule: &Rule, case: &Case) -> bool {
    let reached = |edition: &&Edition| {
        model_run(bare, case, edition).1.contains(&(rule.id.clone(), RuleOutcome::Accepted))
    };
    editions_of(bare, rule, case).iter().any(reached)
}

fn without_rules(suite: &Suite) -> Suite {
    Suite { rules: Vec::new(), ..suite.clone() }
}

#[test]
fn every_rule_that_refuses_nothing_has_twins() {
    let suite = suite();
    let bare = without_rules(&suite);
    let mut missing = Vec::new();
    for rule in rules(&suite).filter(|rule| !rule.outcomes.contains(&RuleOutcome::Refused)) {
        let has_twin = |case: &Case| {
            reaches(&bare, rule, case)
                && rule.cases.iter().any(|twin| are_twins(&bare, rule, case, twin))
        };
        if !rule.cases.iter().any(has_twin) {
            missing.push(rule.id.as_str());
        }
    }
    assert!(missing.is_empty(), "{} rules:\n{}", missing.len(), missing.join("\n"));
}

#[test]
fn what_a_page_calls_twins_are_twins() {
    let suite = suite();
    let bare = without_rules(&suite);
    let mut wrong = Vec::new();
    for rule in rules(&suite) {
        for twin in &rule.cases {
            let Some(said) = twin.why.strip_prefix("Twin of '") else { continue };
            let name = said.split('\'').next().unwrap_or_default();
            let case = rule.cases.iter().find(|case| case.name == name);
            if !case.is_some_and(|case| are_twins(&bare, rule, case, twin)) {
                wrong.push(format!("{} / {}", rule.id, twin.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{} cases:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn every_rule_but_those_named_has_a_case_that_is_refused() {
    let suite = suite();
    let is_refused = |case: &Case| case.assertions.iter().any(|text| text.contains("refused at"));
    let without = rules(&suite).filter(|rule| !rule.cases.iter().any(is_refused));
    let without: Vec<&str> = without.map(|rule| rule.id.as_str()).collect();
    assert_eq!(without, NEVER_REFUSED);
}
