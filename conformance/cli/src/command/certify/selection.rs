//! What a call selects: rules, cases and profiles that exist.

use gaugeblock_report::profiles;
use gaugeblock_suite::{Edition, Rule, Selector, Suite, only_case};

use super::arguments::Arguments;
use crate::error::CliError;

/// What a plan runs: the rules of --only, or their cases of --case.
pub(super) fn only(arguments: &Arguments, suite: &Suite) -> Result<Vec<String>, CliError> {
    known_rules(&arguments.only, suite)?;
    if arguments.case.is_empty() {
        return Ok(arguments.only.clone());
    }
    let selectors: Vec<Selector> = arguments.only.iter().map(|only| Selector::of(only)).collect();
    let wanted = |rule: &&Rule| selectors.iter().any(|selector| selector.has_rule(rule, None));
    let rules: Vec<&Rule> = suite.rules.iter().filter(wanted).collect();
    let mut selected = Vec::new();
    for case in &arguments.case {
        let having = rules.iter().filter(|rule| rule.case_names().any(|name| name == case));
        let before = selected.len();
        selected.extend(having.map(|rule| only_case(&rule.id, case)));
        if selected.len() == before {
            return Err(unknown_case(&format!("--case {case}"), case, &rules));
        }
    }
    Ok(selected)
}

/// An error that lists the names that are nearest to one that no case of these rules has.
fn unknown_case(call: &str, case: &str, rules: &[&Rule]) -> CliError {
    const LISTED: usize = 5;
    let mut names: Vec<(usize, &str)> = rules
        .iter()
        .flat_map(|rule| rule.case_names())
        .map(|name| (strsim::damerau_levenshtein(name, case), name))
        .collect();
    names.sort_unstable();
    names.dedup();
    let close = |(distance, name): &&(usize, &str)| *distance <= 4 || name.contains(case);
    let near: Vec<_> = names.iter().filter(close).take(LISTED).map(|(_, name)| *name).collect();
    let hint = match (near.as_slice(), rules) {
        ([_, ..], _) => format!("did you mean `{}`?", near.join("`, `")),
        ([], [rule]) => format!("`gaugeblock explain {}` prints its cases", rule.id),
        ([], _) => "`gaugeblock explain RULE` prints the cases of a rule".to_owned(),
    };
    CliError::usage(format!("invalid `{call}`: no case of --only has this name"), hint)
}

/// Refuses a filter that selects nothing in any edition.
pub(crate) fn known_rules(only: &[String], suite: &Suite) -> Result<(), CliError> {
    only.iter().try_for_each(|only| {
        let selector = Selector::of(only);
        let has = |rule: &&Rule| selector.has_rule(rule, None);
        let rules: Vec<&Rule> = suite.rules.iter().filter(has).collect();
        let has_case = |rule: &&Rule| rule.case_names().any(|name| selector.has_case(name));
        if rules.iter().any(has_case) {
            return Ok(());
        }
        let call = format!("--only {only}");
        if let ([_, ..], Some((_, case))) = (rules.as_slice(), only.split_once('/')) {
            return Err(unknown_case(&call, case.trim_start(), &rules));
        }
        Err(CliError::usage(
            format!(
                "invalid `{call}`: no rule has an id or a section that begins with it or fits it"
            ),
            "`gaugeblock rules` lists the ids; sections are those of documents, such as 11.5.5",
        ))
    })
}

/// Refuses an unknown profile.
pub(crate) fn known_profiles(profiles: &[String], suite: &Suite) -> Result<(), CliError> {
    match profiles.iter().find(|id| suite.profile(id).is_none()) {
        None => Ok(()),
        Some(unknown) => {
            let known: Vec<_> = suite.profiles.iter().map(|profile| profile.id.as_str()).collect();
            Err(CliError::usage(
                format!("unknown profile `{unknown}`"),
                format!("expected one of: {}", known.join(", ")),
            ))
        }
    }
}

/// Refuses a claimed profile that has no rule in the edition, since nothing could pass or fail it.
pub(super) fn profiles_in_edition(
    profiles: &[String],
    suite: &Suite,
    edition: &Edition,
) -> Result<(), CliError> {
    let is_absent = |id: &&String| !profiles::is_in_edition(suite, id, edition);
    match profiles.iter().find(is_absent) {
        None => Ok(()),
        Some(id) => Err(CliError::usage(
            format!("no rule of profile {id} is in edition {}", edition.id),
            "choose another edition with --edition, or remove --profile",
        )),
    }
}
