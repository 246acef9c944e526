//! The rules and cases that a text selects.

use wildmatch::WildMatch;

use crate::{Edition, Rule};

/// Between the rule and the name of a case, as verdicts print them.
const CASE_SEPARATOR: &str = " / ";

/// The text that selects one case.
pub fn only_case(rule: &str, name: &str) -> String {
    format!("{rule}{CASE_SEPARATOR}{name}")
}

/// The rules and cases that some texts select; all of them without a text.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection(Vec<Selector>);

impl Selection {
    /// What these texts select, each as a [`Selector`] reads it.
    pub fn of(texts: &[String]) -> Self {
        Self(texts.iter().map(|text| Selector::of(text)).collect())
    }

    /// Whether a rule, or a case of it, is selected in an edition.
    pub fn has_rule(&self, rule: &Rule, edition: &Edition) -> bool {
        self.0.is_empty() || self.0.iter().any(|it| it.has_rule(rule, Some(edition)))
    }

    /// Whether a case of a rule is selected in an edition.
    pub fn has_case(&self, rule: &Rule, name: &str, edition: &Edition) -> bool {
        let has = |it: &Selector| it.has_rule(rule, Some(edition)) && it.has_case(name);
        self.0.is_empty() || self.0.iter().any(has)
    }
}

/// The rules and cases that a text selects.
///
/// | text | selects |
/// | --- | --- |
/// | `saved-state`, `feed.zero` | rules whose id begins with it |
/// | `cycles.*-dwell` | rules whose whole id fits; `*` is any text, `?` any character |
/// | `11.5.5` | rules with a source in this section, or in one below it, of the edition's documents |
/// | `feed.zero / at once` | the case of exactly this name, as verdicts print it |
/// | `feed.zero/at*` | cases whose name fits, of the rule of this id, or of rules whose id fits |
#[derive(Clone, Debug, PartialEq)]
pub struct Selector {
    rules: Rules,
    case: Option<Name>,
}

#[derive(Clone, Debug, PartialEq)]
enum Rules {
    Prefix(String),
    Id(Name),
    /// A number of a section, such as `11.5.5`.
    Section(String),
}

/// A whole name.
#[derive(Clone, Debug, PartialEq)]
enum Name {
    Exactly(String),
    Fits(WildMatch),
}

impl Name {
    /// A name, or a pattern where the text has a wildcard.
    fn of(text: &str) -> Self {
        match is_pattern(text) {
            true => Self::Fits(WildMatch::new(text)),
            false => Self::Exactly(text.to_owned()),
        }
    }

    fn is(&self, name: &str) -> bool {
        match self {
            Self::Exactly(text) => text == name,
            Self::Fits(pattern) => pattern.matches(name),
        }
    }
}

fn is_pattern(text: &str) -> bool {
    text.contains(['*', '?'])
}

/// Whether a text is the number of a section: digits with points between them.
fn is_section(text: &str) -> bool {
    text.split('.').all(|part| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()))
}

impl Selector {
    /// What a text selects. No id has a slash, and none begins with a digit.
    pub fn of(text: &str) -> Self {
        if let Some((rule, case)) = text.split_once(CASE_SEPARATOR) {
            let case = Some(Name::Exactly(case.to_owned()));
            return Self { rules: Rules::Id(Name::of(rule)), case };
        }
        if let Some((rule, case)) = text.split_once('/') {
            return Self { rules: Rules::Id(Name::of(rule)), case: Some(Name::of(case)) };
        }
        let rules = match text {
            _ if is_section(text) => Rules::Section(text.to_owned()),
            _ if is_pattern(text) => Rules::Id(Name::of(text)),
            _ => Rules::Prefix(text.to_owned()),
        };
        Self { rules, case: None }
    }

    /// Whether a rule, or a case of it, can be selected. Without an edition, a section is one of any document.
    pub fn has_rule(&self, rule: &Rule, edition: Option<&Edition>) -> bool {
        match &self.rules {
            Rules::Prefix(prefix) => rule.id.starts_with(prefix.as_str()),
            Rules::Id(name) => name.is(&rule.id),
            Rules::Section(number) => rule.sources.iter().any(|source| {
                let is_cited = edition.is_none_or(|it| it.documents.contains(&source.document));
                is_cited && is_within(&source.section, number)
            }),
        }
    }

    /// Whether a case of a rule that it has is selected.
    pub fn has_case(&self, name: &str) -> bool {
        self.case.as_ref().is_none_or(|case| case.is(name))
    }
}

/// Whether a section, which begins with its number, is this one or below it.
fn is_within(section: &str, number: &str) -> bool {
    section.strip_prefix(number).is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', '.']))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rules and cases of a small catalogue that a text selects.
    fn selected(text: &str) -> String {
        let page = |id: &str, section: &str| {
            let text = format!(
                "id = \"{id}\"\nsentence = \"A sentence.\"\nprofile = \"p\"\n[[sources]]\ndocument = \"manual\"\n\
                 section = \"{section}\"\n"
            );
            (toml::from_str::<Rule>(&text).expect("a page"), ["a", "a*b", "b c"])
        };
        let rules = [
            page("arcs.end", "11.5.5 Arcs"),
            page("arcs.end-point", "11.5.5.1 Centre format"),
            page("feed.zero", "11.5 Codes"),
            page("feed.rate", "11.5.55 Feed"),
        ];
        let selector = Selector::of(text);
        let mut names = Vec::new();
        for (rule, cases) in rules.iter().filter(|(rule, _)| selector.has_rule(rule, None)) {
            let cases = cases.iter().filter(|case| selector.has_case(case)).copied();
            names.push(format!("{}: {}", rule.id, cases.collect::<Vec<_>>().join(", ")));
        }
        names.join("; ")
    }

    #[test]
    fn text_selects_by_prefix_pattern_section_and_case() {
        let all = "a, a*b, b c";
        assert_eq!(selected("arcs.end"), format!("arcs.end: {all}; arcs.end-point: {all}"));
        assert_eq!(selected("arcs.e??"), format!("arcs.end: {all}"));
        assert_eq!(selected("*.end*"), format!("arcs.end: {all}; arcs.end-point: {all}"));
        assert_eq!(selected("11.5.5"), format!("arcs.end: {all}; arcs.end-point: {all}"));
        assert_eq!(selected("11.5.5.1"), format!("arcs.end-point: {all}"));
        assert_eq!(selected("feed.zero / a*b"), "feed.zero: a*b");
        assert_eq!(selected("feed.zero/a*"), "feed.zero: a, a*b");
        assert_eq!(selected("feed.*/b c"), "feed.zero: b c; feed.rate: b c");
        assert_eq!(selected("arcs.end/a"), "arcs.end: a");
        assert_eq!(selected("tool"), "");
    }
}
