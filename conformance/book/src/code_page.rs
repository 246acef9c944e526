//! A page for each G and M code: what it means here.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_suite::{ChoiceKind, Suite};
use serde::Serialize;

use super::address;
use super::code::{Code, Explanation};
use super::contents::Book;
use super::site::{Link, Links, Listing, Site};

#[derive(Debug, Serialize)]
struct CodePage {
    about: String,
    rules: Vec<Link>,
    choices: Vec<Link>,
    quirks: Vec<Link>,
    /// Ids of pages about something else that use it in a program.
    used: Vec<Link>,
}

pub(super) fn add(book: &Book<'_>, site: &mut Site) -> Result<(), String> {
    let codes = Codes::of(book.suite);
    let mut groups: BTreeMap<char, Vec<Link>> = BTreeMap::new();
    for (code, explanation) in &codes.0 {
        let name = code.to_string();
        groups.entry(name.chars().next().unwrap_or('G')).or_default().push(Link {
            address: address::code(&name),
            name: name.clone(),
            sentence: explanation.title.clone(),
        });
        let page = CodePage {
            about: explanation.title.clone(),
            rules: explanation.rules.clone(),
            choices: explanation.choices.clone(),
            quirks: explanation.quirks.clone(),
            used: explanation.used.clone(),
        };
        site.add(&address::code(&name), "code.html", ["codes", &name], page)?;
    }
    let about = "Each code with the rules that its sections of the documents state.".to_owned();
    let title = |letter: char| format!("{letter} codes");
    let groups = groups.into_iter().map(|(letter, links)| Links { title: title(letter), links });
    let listing = Listing { about, groups: groups.collect() };
    site.add("codes/index.html", "list.html", ["codes", "Codes"], listing)
}

/// What concerns each code that a section of a document names.
pub(super) struct Codes(Vec<(Code, CodeLinks)>);

struct CodeLinks {
    /// The section of the manual that is about it.
    title: String,
    rules: Vec<Link>,
    choices: Vec<Link>,
    quirks: Vec<Link>,
    used: Vec<Link>,
}

impl Codes {
    pub(super) fn of(suite: &Suite) -> Self {
        let sources = suite.rules.iter().flat_map(|rule| &rule.sources);
        let titles: BTreeSet<&str> = sources.map(|source| source.section.as_str()).collect();
        let words = titles
            .iter()
            .flat_map(|title| title.split(|c: char| !c.is_ascii_alphanumeric() && c != '.'));
        let mut codes: Vec<Code> = words.filter_map(Code::in_title).collect();
        codes.sort();
        codes.dedup();
        let links = codes.into_iter().filter_map(|code| {
            let links = CodeLinks::of(&code, suite, &titles);
            (!links.rules.is_empty()).then_some((code, links))
        });
        Self(links.collect())
    }

    /// The codes whose sections a rule is from.
    pub(super) fn of_rule(&self, id: &str) -> Vec<Link> {
        let of_code = |(code, links): &(Code, CodeLinks)| {
            links.rules.iter().any(|rule| rule.name == id).then(|| Link {
                address: address::code(&code.to_string()),
                name: code.to_string(),
                sentence: links.title.clone(),
            })
        };
        self.0.iter().filter_map(of_code).collect()
    }

    /// Name, title and address of each code.
    pub(super) fn all(&self) -> impl Iterator<Item = (String, &str)> {
        self.0.iter().map(|(code, links)| (code.to_string(), links.title.as_str()))
    }
}

impl CodeLinks {
    fn of(code: &Code, suite: &Suite, titles: &BTreeSet<&str>) -> Self {
        let about = Explanation::of(code, suite);
        let rule = |id: &str, sentence: &str| Link {
            address: address::rule(id),
            name: id.to_owned(),
            sentence: sentence.to_owned(),
        };
        let of_kind = |kind: ChoiceKind| {
            let of_kind =
                about.choices.iter().filter(move |it| it.kind == kind && it.is_documented);
            of_kind.map(|it| Link {
                address: address::choice(it.id),
                name: it.id.to_owned(),
                sentence: it.sentence.to_owned(),
            })
        };
        let title = titles.iter().filter(|title| code.is_in_title(title)).min_by_key(|it| it.len());
        let mut documented = about.documented.clone();
        documented.sort_by_key(|(id, _)| Reverse(share(code, suite, id)));
        Self {
            title: title.map(|it| without_number(it).to_owned()).unwrap_or_default(),
            rules: documented.iter().map(|(id, sentence)| rule(id, sentence)).collect(),
            choices: of_kind(ChoiceKind::Choice).collect(),
            quirks: of_kind(ChoiceKind::Quirk).collect(),
            used: about.used.iter().map(|id| rule(id, "")).collect(),
        }
    }
}

/// Share of the sources of a rule that are sections of the code, in percent.
fn share(code: &Code, suite: &Suite, rule: &str) -> usize {
    let sources = suite.rule(rule).map_or(&[][..], |rule| &rule.sources);
    let own = sources.iter().filter(|source| code.is_in_title(&source.section)).count();
    (100 * own).checked_div(sources.len()).unwrap_or_default()
}

/// A title without the number of its section.
fn without_number(title: &str) -> &str {
    title.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.').trim()
}
