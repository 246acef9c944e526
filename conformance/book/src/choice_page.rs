//! A page for each choice and each quirk, and the lists of them.

use std::collections::BTreeMap;

use gaugeblock_suite::{Choice, ChoiceKind, MotionChoice, Suite};
use serde::Serialize;

use super::address::{self, SourceLink};
use super::case::{CaseView, Cases};
use super::contents::Book;
use super::rule_page;
use super::site::{Link, Links, Listing, Site};

#[derive(Debug, Serialize)]
struct ChoicePage {
    id: String,
    kind: &'static str,
    sentence: String,
    sources: Vec<SourceLink>,
    /// The program of a choice of motion, whose options have no trace.
    program: String,
    options: Vec<OptionView>,
    /// Rules that depend on it.
    rules: Vec<Link>,
}

#[derive(Debug, Serialize)]
struct OptionView {
    name: String,
    means: String,
    is_default: bool,
    editions: Vec<Link>,
    assertions: Vec<String>,
    /// The program as the model runs it.
    case: Option<CaseView>,
}

pub(super) fn add(book: &Book<'_>, site: &mut Site) -> Result<(), String> {
    let suite = book.suite;
    let cases = Cases::new(suite);
    let editions = Editions::of(suite);
    for choice in &suite.choices {
        let page = page(book, choice, &cases, &editions);
        site.add(&address::choice(&choice.id), "choice.html", ["choices", &choice.id], page)?;
    }
    for choice in &suite.motion_choices {
        let page = motion_page(book, choice, &editions);
        site.add(&address::choice(&choice.id), "choice.html", ["choices", &choice.id], page)?;
    }
    let of_kind = |kind| suite.choices.iter().filter(move |it| it.kind == kind).map(link);
    let of_motion = suite.motion_choices.iter().map(|choice| Link {
        address: address::choice(&choice.id),
        name: choice.id.clone(),
        sentence: choice.sentence.clone(),
    });
    let groups = [
        ("Choices", of_kind(ChoiceKind::Choice).collect()),
        ("Choices of motion", of_motion.collect()),
        ("Quirks", of_kind(ChoiceKind::Quirk).collect::<Vec<_>>()),
    ];
    let about = "A choice is a point on which documents differ, or which they leave open. A quirk is a point on which \
        a controller differs from its own document."
        .to_owned();
    let groups = groups.map(|(title, links)| Links { title: title.to_owned(), links }).into();
    let listing = Listing { about, groups };
    site.add("choices/index.html", "list.html", ["choices", "Choices and quirks"], listing)
}

pub(super) fn link(choice: &Choice) -> Link {
    Link {
        address: address::choice(&choice.id),
        name: choice.id.clone(),
        sentence: choice.sentence.clone(),
    }
}

/// The options of each edition.
struct Editions<'a>(Vec<(&'a str, BTreeMap<String, String>)>);

impl<'a> Editions<'a> {
    fn of(suite: &'a Suite) -> Self {
        let options = suite.editions.iter().map(|edition| {
            let mut options = suite.motion_options(edition);
            let own = suite.options(edition);
            options.extend(own.0.iter().map(|(id, option)| (id.clone(), option.clone())));
            (edition.id.as_str(), options)
        });
        Self(options.collect())
    }

    /// The editions that have this option.
    fn with(&self, id: &str, option: &str) -> Vec<Link> {
        let has = |(_, options): &&(&str, BTreeMap<String, String>)| {
            options.get(id).is_some_and(|own| own == option)
        };
        let link = |(edition, _): &(&str, BTreeMap<String, String>)| Link {
            address: address::edition(edition),
            name: (*edition).to_owned(),
            sentence: String::new(),
        };
        self.0.iter().filter(has).map(link).collect()
    }
}

fn rules(suite: &Suite, id: &str) -> Vec<Link> {
    let depend = suite.rules.iter().filter(|rule| rule.options.iter().any(|it| it == id));
    depend.map(rule_page::link).collect()
}

fn page(
    book: &Book<'_>,
    choice: &Choice,
    cases: &Cases<'_>,
    editions: &Editions<'_>,
) -> ChoicePage {
    let option = |(place, option): (usize, &gaugeblock_suite::ChoiceOption)| {
        let mut options = choice.under.clone();
        options.insert(choice.id.clone(), option.name.clone());
        OptionView {
            name: option.name.clone(),
            means: option.means.clone(),
            is_default: place == 0,
            editions: editions.with(&choice.id, &option.name),
            assertions: option.assertions.clone(),
            case: Some(cases.view_under(choice.language, &choice.program, &choice.setup, &options)),
        }
    };
    ChoicePage {
        id: choice.id.clone(),
        kind: match choice.kind {
            ChoiceKind::Choice => "choice",
            ChoiceKind::Quirk => "quirk",
        },
        sentence: choice.sentence.clone(),
        sources: address::links(&choice.sources, book.ledgers),
        program: String::new(),
        options: choice.options.iter().enumerate().map(option).collect(),
        rules: rules(book.suite, &choice.id),
    }
}

fn motion_page(book: &Book<'_>, choice: &MotionChoice, editions: &Editions<'_>) -> ChoicePage {
    let option = |(place, option): (usize, &gaugeblock_suite::MotionChoiceOption)| OptionView {
        name: option.name.clone(),
        means: option.means.clone(),
        is_default: place == 0,
        editions: editions.with(&choice.id, &option.name),
        assertions: option.assertions.clone(),
        case: None,
    };
    ChoicePage {
        id: choice.id.clone(),
        kind: "choice of motion",
        sentence: choice.sentence.clone(),
        sources: address::links(&choice.sources, book.ledgers),
        program: choice.motion.program.clone(),
        options: choice.options.iter().enumerate().map(option).collect(),
        rules: rules(book.suite, &choice.id),
    }
}
