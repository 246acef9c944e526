//! Checks what a statement says against the suite, and against itself.
//!
//! Only the verdicts of the cases are taken from it. Everything that follows from them is derived again.

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZero;

use gaugeblock_report::{Report, profiles};
use gaugeblock_runner::certify::{CaseResult, Plan, Run, Verdict, cases, not_applicable};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::{Edition, Rule, Suite};

use super::digest::is_sha256;
use super::make::{coverage, profiles as certified_profiles, result, subjects};
use super::shards::merged_shards;
use super::statement::{CertifiedRule, Predicate, Seeds, Statement};
use super::time::is_time;

/// Most problems of one kind that are listed one by one.
const LISTED_MAX: usize = 5;

/// What a check found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checked {
    /// What is wrong, each in a sentence with its place. Without any, the certificate is what a run of this suite can
    /// have found.
    pub problems: Vec<String>,
    /// What a reader should know, and is not wrong.
    pub notes: Vec<String>,
}

impl Checked {
    fn problem(&mut self, problem: impl Into<String>) {
        self.problems.push(problem.into());
    }

    /// Compares a value of the certificate with the one that follows from the rest of it.
    fn derived<T: PartialEq>(&mut self, what: &str, found: &T, derived: &T) {
        if found != derived {
            self.problem(format!("{what}: not what follows from the verdicts of the cases"));
        }
    }

    /// Lists the first few problems of one kind, and counts the rest.
    fn several(&mut self, found: &[String]) {
        self.problems.extend(found.iter().take(LISTED_MAX).cloned());
        if let more @ 1.. = found.len().saturating_sub(LISTED_MAX) {
            self.problem(format!("… {more} more of this kind"));
        }
    }
}

/// Checks a statement. `now` is the present point in time, as [`utc_time`](super::utc_time) writes it.
pub fn check(statement: &Statement, suite: &Suite, now: &str) -> Checked {
    let mut checked = Checked::default();
    let predicate = &statement.predicate;
    subject(&mut checked, statement);
    facts(&mut checked, predicate, now);
    versions(&mut checked, predicate);
    if let Some(edition) = suite_and_edition(&mut checked, predicate, suite) {
        verdicts(&mut checked, predicate, suite, edition);
    }
    checked
}

/// The files of the controller: at least one, and the same ones in both places.
fn subject(checked: &mut Checked, statement: &Statement) {
    let run = &statement.predicate.run;
    if run.controller_files.is_empty() {
        checked.problem("subject: no file of the controller is named");
    }
    if statement.subject != subjects(run) {
        checked.problem("subject: not the controller, version and files of the run");
    }
    if let Some(file) = run.controller_files.iter().find(|file| !is_sha256(&file.sha256)) {
        checked.problem(format!("subject: the digest of {} is not a SHA-256", file.name));
    }
}

/// Times, seeds, digests, lists and shards.
fn facts(checked: &mut Checked, predicate: &Predicate, now: &str) {
    let started = predicate.started.as_ref();
    let times = started.into_iter().chain([&predicate.made]);
    for time in times.filter(|time| !is_time(time)) {
        checked
            .problem(format!("time: {time} is not a point in time such as 2026-11-30T09:05:00Z"));
    }
    if started.is_some_and(|started| *started > predicate.made) {
        checked.problem("time: the run began after the certificate was made");
    }
    if predicate.made.as_str() > now {
        checked.problem(format!("time: made in the future ({})", predicate.made));
    }
    if predicate.seeds != Seeds::default() {
        checked.problem("seeds: not those of a run of this version");
    }
    let lists = predicate.lists.iter().map(|list| &list.sha256);
    let digests = lists.chain([&predicate.report_sha256, &predicate.tool.sha256]);
    for digest in digests.filter(|digest| !is_sha256(digest)) {
        checked.problem(format!("digest: {digest:?} is not a SHA-256"));
    }
    if predicate.lists.is_empty() == predicate.mismatches.is_some() {
        checked.problem("lists: mismatches without a list, or a list without mismatches");
    }
    checked.several(&merged_shards(&predicate.shards, predicate.run.shard));
    if predicate.coverage != coverage(&predicate.run) {
        checked.problem("coverage: not what the selection of the run gives");
    }
}

/// The tool: one version throughout, and whether it is this one.
fn versions(checked: &mut Checked, predicate: &Predicate) {
    let (tool, own) = (&predicate.tool, env!("CARGO_PKG_VERSION"));
    if tool.name != "gaugeblock" || tool.version != predicate.run.gaugeblock_version {
        checked.problem(format!(
            "tool: {} {} did not run gaugeblock {}",
            tool.name, tool.version, predicate.run.gaugeblock_version
        ));
    }
    if tool.version != own {
        checked.notes.push(format!("made with gaugeblock {}; this is {own}", tool.version));
    }
    let tolerances = gaugeblock_compare::tolerance::VERSION;
    if predicate.tolerances != tolerances {
        checked.notes.push(format!(
            "compared by version {} of the tolerances; this gaugeblock has version {tolerances}",
            predicate.tolerances
        ));
    }
}

/// The edition, if the suite is this one and has it.
fn suite_and_edition<'a>(
    checked: &mut Checked,
    predicate: &Predicate,
    suite: &'a Suite,
) -> Option<&'a Edition> {
    let run = &predicate.run;
    if run.suite != suite.digest || predicate.suite_sha256 != suite.sha256 {
        checked.problem(format!(
            "suite: the certificate is of suite {} (SHA-256 {}); this one is {} (SHA-256 {})",
            run.suite, predicate.suite_sha256, suite.digest, suite.sha256
        ));
        return None;
    }
    let is_known = |(id, option): &(&String, &String)| {
        let mut choices = suite.choices.iter().filter(|choice| choice.id == **id);
        choices.any(|choice| choice.options.iter().any(|known| known.name == **option))
    };
    if let Some((id, option)) = run.options.0.iter().find(|option| !is_known(option)) {
        checked.problem(format!("options: the suite has no option {option} of {id}"));
    }
    let edition = suite.edition(&run.edition);
    if edition.is_none() {
        checked.problem(format!("edition: the suite has no edition {}", run.edition));
    }
    edition
}

/// Every case once, and everything that follows from the verdicts.
fn verdicts(checked: &mut Checked, predicate: &Predicate, suite: &Suite, edition: &Edition) {
    let run = &predicate.run;
    let plan =
        Plan { suite, edition, only: &run.only, jobs: NonZero::<usize>::MIN, scope: run.scope };
    let before = checked.problems.len();
    let expected = cases(plan, run.laws, run.shard);
    checked.several(&incomplete(&predicate.rules, &expected));
    let (results, wrong) = results(&predicate.rules, suite);
    checked.several(&wrong);
    if checked.problems.len() > before {
        return;
    }
    if expected.is_empty() {
        checked.problem("completeness: no case of the suite is selected");
    }
    let derived = Run {
        edition,
        scope: run.scope,
        cases: results,
        not_applicable: not_applicable(plan),
        fingerprint: None,
    };
    checked.several(&unlisted(predicate, &derived));
    let claimed = claimed(predicate);
    if !claimed.is_empty() && run.shard != Shard::WHOLE {
        checked.problem("profiles: a shard claims none");
    }
    let derived_report = Report {
        mismatches: predicate.mismatches.clone(),
        profiles: profiles::profiles(suite, &derived, &claimed),
        ..Report::of(suite, &derived, run.clone())
    };
    checked.derived("counts", &predicate.counts, &derived_report.counts());
    let verdicts: Vec<_> = predicate.rules.iter().map(|rule| (&rule.rule, rule.verdict)).collect();
    let rules = derived_report.rules();
    let rules: Vec<_> = rules.iter().map(|result| (&result.rule.id, result.verdict)).collect();
    checked.derived("verdicts of the rules", &verdicts, &rules);
    let profiles = certified_profiles(&derived_report.profiles);
    checked.derived("profiles", &predicate.profiles, &profiles);
    checked.derived("result", &predicate.result, &result(&derived_report));
}

fn claimed(predicate: &Predicate) -> Vec<String> {
    let claimed = predicate.profiles.iter().filter(|profile| profile.claimed);
    claimed.map(|profile| profile.profile.clone()).collect()
}

/// In what the cases are not those of the run: each once, in its order.
fn incomplete(rules: &[CertifiedRule], expected: &[(&str, &str)]) -> Vec<String> {
    let named = rules
        .iter()
        .flat_map(|rule| rule.cases.iter().map(|case| (rule.rule.as_str(), case.case.as_str())));
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    let found: Vec<_> = named.collect();
    for case in &found {
        *counts.entry(*case).or_default() += 1;
    }
    let known: BTreeSet<_> = expected.iter().copied().collect();
    let missing = expected.iter().filter(|case| !counts.contains_key(*case));
    let missing = missing.map(|(rule, case)| format!("completeness: {rule} / {case} is missing"));
    let twice = counts.iter().filter(|(_, count)| **count > 1);
    let twice =
        twice.map(|((rule, case), _)| format!("completeness: {rule} / {case} is there twice"));
    let foreign = counts.keys().filter(|case| !known.contains(*case));
    let foreign = foreign
        .map(|(rule, case)| format!("completeness: {rule} / {case} does not belong to this run"));
    let problems: Vec<String> = missing.chain(twice).chain(foreign).collect();
    if problems.is_empty() && found != expected {
        return vec!["completeness: the cases are in another order than the suite's".to_owned()];
    }
    problems
}

/// The results of the cases, and what is wrong about some.
fn results<'a>(rules: &[CertifiedRule], suite: &'a Suite) -> (Vec<CaseResult<'a>>, Vec<String>) {
    let (mut results, mut wrong) = (Vec::new(), Vec::new());
    for certified in rules {
        let place = suite.rules.binary_search_by(|rule| rule.id.cmp(&certified.rule));
        // An unknown rule, or case, does not belong to the run and is listed as such.
        let Some(rule) = place.ok().and_then(|place| suite.rules.get(place)) else { continue };
        let names: BTreeSet<&'a str> = names(rule);
        for case in &certified.cases {
            let Some(name) = names.get(case.case.as_str()).copied() else { continue };
            match case.result(rule, name) {
                Ok(result) => results.push(result),
                Err(why) => wrong.push(format!("verdict: {} / {name}: {why}", rule.id)),
            }
        }
    }
    (results, wrong)
}

/// Names of the cases of a rule, those of motion too.
fn names(rule: &Rule) -> BTreeSet<&str> {
    rule.case_names().collect()
}

/// Divergences that a run with lists must have counted as known, waived or mismatches, and did not.
fn unlisted(predicate: &Predicate, run: &Run<'_>) -> Vec<String> {
    let Some(mismatches) = &predicate.mismatches else { return Vec::new() };
    let named: BTreeSet<_> = mismatches.iter().map(|mismatch| mismatch.place()).collect();
    let is_open = |case: &&CaseResult<'_>| {
        matches!(case.verdict, Verdict::Diverges(_) | Verdict::SideDifference(_))
            && !named.contains(&(case.rule.id.as_str(), case.name))
    };
    let open = run.cases.iter().filter(is_open);
    let problem = open.map(|case| {
        format!("lists: {} / {} differs, and no mismatch names it", case.rule.id, case.name)
    });
    problem.collect()
}
