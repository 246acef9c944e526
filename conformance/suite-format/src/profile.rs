//! Profiles: which rules a vendor claims together.

use super::{Edition, Profile, Rule, Suite};

impl Rule {
    /// Whether an edition has the rule and a case of it.
    pub fn is_judged_in(&self, edition: &Edition) -> bool {
        let has_cases = self.cases.iter().any(|case| case.runs_in(edition));
        self.exists_in(edition) && (has_cases || !self.motion.is_empty())
    }
}

impl Suite {
    /// The profile of an id.
    pub fn profile(&self, id: &str) -> Option<&Profile> {
        self.profiles.iter().find(|profile| profile.id == id)
    }

    /// The one profile that a rule counts for: one that all lineages share, or else that of its page.
    pub fn profile_of<'a>(&'a self, rule: &'a Rule) -> &'a str {
        let shared = self.profiles.iter().find(|profile| self.is_shared(rule, profile));
        shared.map_or(rule.profile.as_str(), |profile| profile.id.as_str())
    }

    /// The rules of a profile, ordered by id.
    pub fn rules_of<'a>(&'a self, profile: &Profile) -> Vec<&'a Rule> {
        self.rules.iter().filter(|rule| self.profile_of(rule) == profile.id).collect()
    }

    /// Whether all lineages of a profile require a rule, in the same way.
    fn is_shared(&self, rule: &Rule, profile: &Profile) -> bool {
        profile.drawn_from.contains(&rule.profile)
            && self.lineages(profile).all(|it| it.cites(&rule.sources) && rule.is_judged_in(it))
            && !self.differs_among_lineages(&rule.id, profile)
    }

    /// Whether the lineages of a profile have different options of the choice that a rule is about: it has its id.
    fn differs_among_lineages(&self, id: &str, profile: &Profile) -> bool {
        if self.choices.binary_search_by(|choice| choice.id.as_str().cmp(id)).is_err() {
            return false;
        }
        let mut options =
            self.lineages(profile).map(|it| self.options(it).get(id).map(str::to_owned));
        let first = options.next();
        options.any(|option| Some(option) != first)
    }

    fn lineages<'a>(&'a self, profile: &'a Profile) -> impl Iterator<Item = &'a Edition> {
        profile.lineages.iter().filter_map(|id| self.edition(id))
    }

    /// What is wrong with the page of profiles.
    pub(crate) fn problems_of_profiles(&self) -> Vec<String> {
        let mut problems = Vec::new();
        for Profile { id, lineages, drawn_from, .. } in &self.profiles {
            for edition in lineages.iter().filter(|edition| self.edition(edition).is_none()) {
                problems.push(format!("profiles.toml: profile {id}: unknown edition `{edition}`"));
            }
            for from in drawn_from.iter().filter(|from| self.profile(from).is_none()) {
                problems.push(format!("profiles.toml: profile {id}: unknown profile `{from}`"));
            }
            if lineages.is_empty() != drawn_from.is_empty() || lineages.len() == 1 {
                problems.push(format!(
                    "profiles.toml: profile {id}: expected two `lineages` or more with `drawn_from`, or neither"
                ));
            }
        }
        problems
    }
}
