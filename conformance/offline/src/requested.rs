//! The rules that a campaign exports.

use std::fmt;

use gaugeblock_suite::{Edition, Rule, Selection, Suite};

/// The rules that a campaign exports.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Requested {
    /// Only rules of these profiles; empty for all.
    pub profiles: Vec<String>,
    /// Only the rules and cases that these select, each as a [`Selector`](gaugeblock_suite::Selector) reads it; empty for
    /// all.
    pub only: Vec<String>,
}

impl Requested {
    /// What is requested of each rule of a suite in an edition: whether a case of this name is.
    pub(crate) fn cases<'a>(
        &'a self,
        suite: &'a Suite,
        edition: &'a Edition,
    ) -> impl Fn(&Rule, &str) -> bool + 'a {
        let selection = Selection::of(&self.only);
        move |rule, name| {
            let is_of = |profile: &String| suite.profile_of(rule) == profile;
            (self.profiles.is_empty() || self.profiles.iter().any(is_of))
                && selection.has_case(rule, name, edition)
        }
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
            only => write!(f, ", only: {}", only.join(", ")),
        }
    }
}
