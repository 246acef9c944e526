//! How far a controller is from each profile, claimed or not.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_runner::certify::{Run, Scope};
use gaugeblock_suite::{Edition, Profile, Rule, Suite};

use super::rule::{RuleVerdict, verdicts};

/// Most rules of a verdict that are named.
const NAMED: usize = 6;
/// The same for a profile that is claimed.
const NAMED_OF_CLAIMED: usize = 40;

/// A profile, judged.
#[derive(Clone, Debug)]
pub struct ProfileResult<'a> {
    /// The profile.
    pub profile: &'a Profile,
    /// Whether it was claimed.
    pub claimed: bool,
    /// Its rules that exist in the edition, each with its verdict; none for a rule that was not run at all.
    pub rules: Vec<(&'a Rule, Option<RuleVerdict>)>,
}

impl ProfileResult<'_> {
    /// Whether the controller passes it: every rule of it that exists in the edition was run and passes.
    pub fn passes(&self) -> bool {
        self.count(RuleVerdict::Pass) == self.rules.len() && !self.rules.is_empty()
    }

    /// How many of its rules have this verdict.
    pub fn count(&self, verdict: RuleVerdict) -> usize {
        self.rules.iter().filter(|(_, found)| *found == Some(verdict)).count()
    }

    /// How many of its rules were not run at all.
    pub fn not_run(&self) -> usize {
        self.rules.iter().filter(|(_, verdict)| verdict.is_none()).count()
    }

    /// Whether a report lists it for people: it was run in full, or is claimed.
    pub fn is_listed(&self) -> bool {
        self.claimed || self.not_run() == 0
    }

    /// Its rules that do not pass, by verdict: diverging rules first, those that were not run last.
    pub fn missing(&self) -> Vec<(&'static str, Vec<&str>)> {
        let order = [
            Some(RuleVerdict::Diverges),
            Some(RuleVerdict::NotJudged),
            Some(RuleVerdict::Unsupported),
            None,
        ];
        let with = |wanted: Option<RuleVerdict>| {
            let rules = self.rules.iter().filter(move |(_, verdict)| *verdict == wanted);
            let ids: Vec<&str> = rules.map(|(rule, _)| rule.id.as_str()).collect();
            (wanted.map_or("not run", RuleVerdict::word), ids)
        };
        order.into_iter().map(with).filter(|(_, ids)| !ids.is_empty()).collect()
    }

    /// Its rules that do not pass, in a line: `diverges: feed.rate; unsupported: feed.per-minute and 3 more`.
    pub fn missing_in_words(&self) -> String {
        let most = if self.claimed { NAMED_OF_CLAIMED } else { NAMED };
        let words = self.missing().into_iter().map(|(word, ids)| {
            let named = ids.iter().take(most).copied().collect::<Vec<_>>().join(", ");
            match ids.len().saturating_sub(most) {
                0 => format!("{word}: {named}"),
                more => format!("{word}: {named} and {more} more"),
            }
        });
        words.collect::<Vec<_>>().join("; ")
    }
}

/// Whether an edition has a rule of a profile: no claim of another one could pass or fail.
pub fn is_in_edition(suite: &Suite, profile: &str, edition: &Edition) -> bool {
    let mut rules = suite.rules.iter().filter(|rule| rule.is_judged_in(edition));
    rules.any(|rule| suite.profile_of(rule) == profile)
}

/// Each profile of the suite after a run; none if assertions only were judged, since a profile claims the whole outcome.
pub fn profiles<'a>(suite: &'a Suite, run: &Run<'a>, claimed: &[String]) -> Vec<ProfileResult<'a>> {
    if run.scope == Scope::AssertionsOnly {
        return Vec::new();
    }
    let judged: BTreeMap<&str, RuleVerdict> =
        verdicts(run).iter().map(|result| (result.rule.id.as_str(), result.verdict)).collect();
    let mut rules: BTreeMap<&str, Vec<(&Rule, Option<RuleVerdict>)>> = BTreeMap::new();
    for rule in suite.rules.iter().filter(|rule| rule.is_judged_in(run.edition)) {
        let verdict = judged.get(rule.id.as_str()).copied();
        rules.entry(suite.profile_of(rule)).or_default().push((rule, verdict));
    }
    let claimed: BTreeSet<&str> = claimed.iter().map(String::as_str).collect();
    let all = suite.profiles.iter().filter_map(|profile| {
        let rules = rules.remove(profile.id.as_str())?;
        Some(ProfileResult { profile, claimed: claimed.contains(profile.id.as_str()), rules })
    });
    all.collect()
}
