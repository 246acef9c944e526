//! The rules that a campaign exports.

use std::fmt;

use gaugeblock_suite::{Rule, Suite};

/// The rules that a campaign exports.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Requested {
    /// Only rules of these profiles; empty for all.
    pub profiles: Vec<String>,
    /// Only rules whose id begins with one of these; empty for all.
    pub only: Vec<String>,
}

impl Requested {
    /// Whether a rule is requested.
    pub(crate) fn includes(&self, suite: &Suite, rule: &Rule) -> bool {
        let Self { profiles, only } = self;
        let is_of = |profile: &String| suite.profile_of(rule) == profile;
        (profiles.is_empty() || profiles.iter().any(is_of))
            && (only.is_empty() || only.iter().any(|prefix| rule.id.starts_with(prefix)))
    }
}

impl fmt::Display for Requested {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.profiles.as_slice() {
            [] => write!(f, "all profiles")?,
            profiles => write!(f, "profiles: {}", profiles.join(", "))?,
        }
        match self.only.as_slice() {
            [] => Ok(()),
            only => write!(f, ", only rules: {}", only.join(", ")),
        }
    }
}
