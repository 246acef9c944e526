//! What a call selects: rules, cases and profiles that exist.

use gaugeblock_report::profiles;
use gaugeblock_runner::certify::only_case;
use gaugeblock_suite::{Edition, Rule, Suite};

use super::arguments::Arguments;
use crate::error::CliError;

/// What a plan runs: the rules of --only, or their cases of --case.
pub(super) fn only(arguments: &Arguments, suite: &Suite) -> Result<Vec<String>, CliError> {
    known_rules(&arguments.only, suite)?;
    if arguments.case.is_empty() {
        return Ok(arguments.only.clone());
    }
    let wanted =
        |rule: &&Rule| arguments.only.iter().any(|only| rule.id.starts_with(only.as_str()));
    let rules: Vec<&Rule> = suite.rules.iter().filter(wanted).collect();
    let mut selected = Vec::new();
    for case in &arguments.case {
        let having = rules.iter().filter(|rule| rule.case_names().any(|name| name == case));
        let before = selected.len();
        selected.extend(having.map(|rule| only_case(&rule.id, case)));
        if selected.len() == before {
            return Err(unknown_case(case, &rules));
        }
    }
    Ok(selected)
}

/// An error that lists the names that are nearest to one that no case of these rules has.
fn unknown_case(case: &str, rules: &[&Rule]) -> CliError {
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
    CliError::usage(format!("invalid `--case {case}`: no case of --only has this name"), hint)
}

/// Refuses a prefix that no rule id has.
pub(crate) fn known_rules(only: &[String], suite: &Suite) -> Result<(), CliError> {
    let is_known = |only: &&String| suite.rules.iter().any(|rule| rule.id.starts_with(*only));
    match only.iter().find(|only| !is_known(only)) {
        None => Ok(()),
        Some(only) => Err(CliError::usage(
            format!("invalid `--only {only}`: no rule has an id that begins with it"),
            "`gaugeblock rules` lists the ids",
        )),
    }
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
