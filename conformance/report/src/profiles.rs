//! Which profiles a controller passes, claimed or not.

use std::collections::BTreeMap;

use gaugeblock_runner::certify::{Run, Scope};
use gaugeblock_suite::{Edition, Profile, Rule, Suite};

use super::rule::{RuleVerdict, verdicts};

/// A profile, judged.
#[derive(Clone, Debug)]
pub struct ProfileResult<'a> {
    /// The profile.
    pub profile: &'a Profile,
    /// Whether it was claimed.
    pub claimed: bool,
    /// How many of its rules came to what.
    pub verdicts: BTreeMap<RuleVerdict, usize>,
    /// Its rules that exist in the edition and were not run at all.
    pub not_run: usize,
}

impl ProfileResult<'_> {
    /// Whether the controller passes it: every rule of it that exists in the edition was run and passes.
    pub fn passes(&self) -> bool {
        let only_passes = self.verdicts.keys().all(|verdict| *verdict == RuleVerdict::Pass);
        only_passes && !self.verdicts.is_empty() && self.not_run == 0
    }

    /// How many of its rules exist in the edition.
    pub fn rules(&self) -> usize {
        self.verdicts.values().sum::<usize>() + self.not_run
    }

    /// How many of its rules have this verdict.
    pub fn count(&self, verdict: RuleVerdict) -> usize {
        self.verdicts.get(&verdict).copied().unwrap_or_default()
    }
}

/// Whether an edition has a rule: in its language, not void there, and with a case.
pub fn is_in_edition(rule: &Rule, edition: &Edition) -> bool {
    let has_cases = rule.cases.iter().any(|case| case.runs_in(edition)) || !rule.motion.is_empty();
    rule.exists_in(edition) && has_cases
}

/// Each profile of the suite after a run; none if assertions only were judged, since a profile claims the whole outcome.
pub fn profiles<'a>(suite: &'a Suite, run: &Run<'a>, claimed: &[String]) -> Vec<ProfileResult<'a>> {
    if run.scope == Scope::AssertionsOnly {
        return Vec::new();
    }
    let judged = verdicts(run);
    let all = suite.profiles.iter().map(|profile| {
        let mut result = ProfileResult {
            profile,
            claimed: claimed.contains(&profile.id),
            verdicts: BTreeMap::new(),
            not_run: 0,
        };
        let of_profile = suite.rules.iter().filter(|rule| rule.profile == profile.id);
        for rule in of_profile.filter(|rule| is_in_edition(rule, run.edition)) {
            match judged.iter().find(|judged| judged.rule.id == rule.id) {
                Some(judged) => *result.verdicts.entry(judged.verdict).or_default() += 1,
                None => result.not_run += 1,
            }
        }
        result
    });
    all.filter(|result| result.rules() > 0).collect()
}
