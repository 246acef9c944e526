//! How the rules about post-processors and custom macros are held, most of which refuse nothing themselves: by twins,
//! two programs that differ in one line, where what is asserted of the one does not hold of the other.

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZero;
use std::path::{Path, PathBuf};

use gaugeblock_controllers::Reference;
use gaugeblock_runner::certify::{Plan, Scope, Verdict, certify};
use gaugeblock_runner::suite_check::{editions_of, model_run};
use gaugeblock_suite::{Case, Edition, Rule, RuleOutcome, Setup, Suite, files};

/// The chapters, and for each the document whose sentences its page goes through.
const CHAPTERS: [(&str, &str); 2] = [("gpp", "gpp2"), ("nct", "nct-99m")];

/// Rules near which the documents demand no refusal: they say what is printed, or what may be done.
const NEVER_REFUSED: [&str; 3] = ["gpp.non-modal-off", "gpp.off-modal", "gpp.off-printed"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../suite")
}

fn suite() -> Suite {
    let files = files::of_folder(&folder()).expect("the suite can be read");
    Suite::read(&files).unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

fn rules(suite: &Suite) -> impl Iterator<Item = &Rule> {
    let is_here = |rule: &&Rule| CHAPTERS.iter().any(|(chapter, _)| rule.chapter() == *chapter);
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

/// Whether something that a case asserts does not hold of its twin, in an edition in which both run. `bare` is the
/// suite without its rules.
fn are_twins(bare: &Suite, rule: &Rule, case: &Case, twin: &Case) -> bool {
    if !differ_in_one_line(case, twin) {
        return false;
    }
    let told = Case { assertions: case.assertions.clone(), golden: None, ..twin.clone() };
    let alone = Rule { cases: vec![told], ..rule.clone() };
    let alone = Suite { rules: vec![alone], ..bare.clone() };
    let fails = |edition: &&Edition| {
        let plan = Plan {
            suite: &alone,
            edition,
            only: &[],
            jobs: NonZero::<usize>::MIN,
            scope: Scope::Full,
        };
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
fn declared_twins_are_twins() {
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

/// Where the sentences of a document stand that a rule carries, as the chapter's page writes it.
fn sentences(rule: &Rule, document: &str) -> String {
    let of_document = rule.sources.iter().filter(|source| source.document == document);
    let places = of_document.filter_map(|source| {
        let notes = if source.section.ends_with("Notes") { "note " } else { "" };
        source.ordinal.map(|ordinal| format!("{notes}{ordinal}"))
    });
    places.collect::<Vec<_>>().join(", ")
}

#[test]
fn page_of_a_chapter_leads_from_each_sentence_to_its_cases() {
    let suite = suite();
    let mut wrong = Vec::new();
    for (chapter, document) in CHAPTERS {
        let path = folder().join(chapter).join("README.md");
        let page = std::fs::read_to_string(path).expect("a chapter has a page");
        let (_, table) = page.split_once("## From sentence to case").expect("it has the table");
        let table = table.split("\n## ").next().unwrap_or_default();
        let mut told = BTreeSet::new();
        for row in table.lines().filter(|line| line.starts_with("| ") && line.contains('`')) {
            let id = row.split('`').nth(1).unwrap_or_default();
            let Some(rule) = suite.rules.iter().find(|rule| rule.id == id) else {
                wrong.push(format!("{row}: there is no such rule"));
                continue;
            };
            told.insert(id.to_owned());
            let places = sentences(rule, document);
            if !row.starts_with(&format!("| {places} |")) && !places.is_empty() {
                wrong.push(format!("{id}: its sentences are {places}"));
            }
            for name in row.split('*').skip(1).step_by(2) {
                if !rule.case_names().any(|case| case == name) {
                    wrong.push(format!("{id}: it has no case {name}"));
                }
            }
        }
        let here = suite.rules.iter().filter(|rule| rule.chapter() == chapter);
        let untold = here.filter(|rule| {
            !sentences(rule, document).is_empty() && !told.contains(rule.id.as_str())
        });
        wrong.extend(untold.map(|rule| format!("{}: it has no row", rule.id)));
    }
    assert!(wrong.is_empty(), "{} faults:\n{}", wrong.len(), wrong.join("\n"));
}
