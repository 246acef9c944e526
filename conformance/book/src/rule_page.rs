//! A page for each rule, and one for each chapter.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_suite::{Grid, GridList, Rule, Suite, sections};
use serde::Serialize;

use super::address::{self, SourceLink, anchor};
use super::case::{CaseView, Cases, motion_view};
use super::code_page::Codes;
use super::contents::Book;
use super::site::{Link, Links, Listing, Site};

#[derive(Debug, Serialize)]
struct RulePage {
    id: String,
    sentence: String,
    chapter: Link,
    profile: String,
    sources: Vec<SourceLink>,
    void: Vec<Void>,
    choices: Vec<Link>,
    quirks: Vec<Link>,
    codes: Vec<Link>,
    controllers: Vec<Controller>,
    cases: Vec<CaseView>,
    grids: Vec<GridView>,
    /// Rules that a section of its sources has, too.
    neighbours: Vec<Link>,
}

/// Editions that do not have a rule, for one reason.
#[derive(Debug, Serialize)]
struct Void {
    editions: Vec<String>,
    why: String,
}

/// What a rule is for a controller.
#[derive(Debug, Serialize)]
struct Controller {
    name: String,
    edition: String,
    verdict: String,
    class: String,
    why: String,
}

/// A template of cases.
#[derive(Debug, Serialize)]
struct GridView {
    anchor: String,
    name: String,
    why: String,
    lists: Vec<List>,
    program: String,
    assertions: Vec<String>,
    /// The first of its cases, in full.
    first: Option<CaseView>,
    /// The names of the others.
    others: Vec<String>,
}

#[derive(Debug, Serialize)]
struct List {
    name: String,
    items: Vec<String>,
}

pub(super) fn add(book: &Book<'_>, site: &mut Site) -> Result<(), String> {
    let suite = book.suite;
    let cases = Cases::new(suite);
    let codes = Codes::of(suite);
    for rule in &suite.rules {
        let page = page(book, rule, &cases, &codes);
        site.add(&address::rule(&rule.id), "rule.html", ["rules", &rule.id], page)?;
    }
    let mut chapters: BTreeMap<&str, Vec<Link>> = BTreeMap::new();
    for rule in &suite.rules {
        chapters.entry(rule.chapter()).or_default().push(link(rule));
    }
    for (chapter, rules) in &chapters {
        let about = format!("{} rules.", rules.len());
        let groups = vec![Links { title: String::new(), links: rules.clone() }];
        let listing = Listing { about, groups };
        site.add(&address::chapter(chapter), "chapter.html", ["rules", chapter], listing)?;
    }
    Ok(())
}

pub(super) fn link(rule: &Rule) -> Link {
    Link {
        address: address::rule(&rule.id),
        name: rule.id.clone(),
        sentence: rule.sentence.clone(),
    }
}

/// The places of a page that no case may have.
const PLACES: [&str; 8] =
    ["search", "found", "sources", "controllers", "choices", "quirks", "cases", "grids"];

/// A place that no other case of the page has: the name of the case, with a number where it is taken.
fn unique(name: &str, taken: &mut BTreeSet<String>) -> String {
    let first = anchor(name);
    let further = (2..).map(|number| format!("{first}-{number}"));
    let mut names = std::iter::once(first.clone()).chain(further);
    names.find(|name| taken.insert(name.clone())).unwrap_or_default()
}

fn page(book: &Book<'_>, rule: &Rule, cases: &Cases<'_>, codes: &Codes) -> RulePage {
    let mut taken: BTreeSet<String> = PLACES.iter().map(|it| (*it).to_owned()).collect();
    let suite = book.suite;
    let (quirks, choices) = options(suite, rule);
    let chapter = rule.chapter();
    let literal = rule.cases.iter().filter(|case| case.grid.is_none());
    let motion = rule.motion.iter().map(|case| motion_view(rule, case));
    let literal = literal.map(|case| cases.view(rule, case)).chain(motion);
    let literal: Vec<CaseView> = literal
        .map(|it| {
            let place = unique(&it.name, &mut taken);
            it.at(place)
        })
        .collect();
    let grids = rule.grids.iter().enumerate().map(|(place, grid)| {
        let view = grid_view(suite, rule, place, grid, cases);
        GridView { anchor: unique(&view.name, &mut taken), ..view }
    });
    let grids = grids.collect();
    RulePage {
        id: rule.id.clone(),
        sentence: rule.sentence.clone(),
        chapter: Link {
            address: address::chapter(chapter),
            name: chapter.to_owned(),
            sentence: String::new(),
        },
        profile: suite.profile_of(rule).to_owned(),
        sources: address::links(&rule.sources, book.ledgers),
        void: void(rule),
        choices,
        quirks,
        codes: codes.of_rule(&rule.id),
        controllers: controllers(book, &rule.id),
        cases: literal,
        grids,
        neighbours: neighbours(suite, rule),
    }
}

/// The editions without the rule, by their reasons.
fn void(rule: &Rule) -> Vec<Void> {
    let mut by_reason: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (edition, why) in &rule.void {
        by_reason.entry(why).or_default().push(edition.clone());
    }
    let void = |(why, editions): (&str, _)| Void { editions, why: why.to_owned() };
    by_reason.into_iter().map(void).collect()
}

/// The quirks and the choices on which a rule depends.
fn options(suite: &Suite, rule: &Rule) -> (Vec<Link>, Vec<Link>) {
    let (mut quirks, mut choices) = (Vec::new(), Vec::new());
    for id in &rule.options {
        let choice = suite.choices.iter().find(|choice| choice.id == *id);
        let of_motion = suite.motion_choices.iter().find(|choice| choice.id == *id);
        let sentence = choice.map(|it| &it.sentence).or(of_motion.map(|it| &it.sentence));
        let is_quirk = choice.is_some_and(|it| it.kind == gaugeblock_suite::ChoiceKind::Quirk);
        let link = Link {
            address: address::choice(id),
            name: id.clone(),
            sentence: sentence.cloned().unwrap_or_default(),
        };
        if is_quirk { quirks.push(link) } else { choices.push(link) }
    }
    (quirks, choices)
}

/// The other rules of the sections that a rule is from.
fn neighbours(suite: &Suite, rule: &Rule) -> Vec<Link> {
    let is_near = |other: &&Rule| {
        other.id != rule.id
            && other.sources.iter().any(|it| {
                rule.sources
                    .iter()
                    .any(|own| own.document == it.document && own.section == it.section)
            })
    };
    suite.rules.iter().filter(is_near).map(link).collect()
}

/// What the rule is on each controller of the comparison.
fn controllers(book: &Book<'_>, id: &str) -> Vec<Controller> {
    let Some(comparison) = book.comparison else { return Vec::new() };
    let Some(row) = comparison.rules.iter().find(|row| row.rule == id) else { return Vec::new() };
    let controller = |(column, cell): (
        &gaugeblock_report::comparison::Column,
        &gaugeblock_report::comparison::Cell,
    )| {
        let verdict = cell.verdict.word();
        Controller {
            name: column.name.clone(),
            edition: column.edition.clone(),
            verdict: verdict.to_owned(),
            class: anchor(verdict),
            why: cell.why.clone().unwrap_or_default(),
        }
    };
    comparison.controllers.iter().zip(&row.cells).map(controller).collect()
}

fn grid_view(suite: &Suite, rule: &Rule, place: usize, grid: &Grid, cases: &Cases<'_>) -> GridView {
    let mut of_grid = rule.cases.iter().filter(|case| case.grid == Some(place));
    let first = of_grid.next().map(|case| cases.view(rule, case));
    let lists = grid.each.iter().map(|(name, list)| {
        let items = match list {
            GridList::Named(named) => suite.lists.get(named).map(Vec::as_slice).unwrap_or_default(),
            GridList::Items(items) => items.as_slice(),
        };
        let names = items.iter().filter_map(|item| item.get("name").cloned());
        List { name: name.clone(), items: names.collect() }
    });
    GridView {
        anchor: String::new(),
        name: grid.name.clone(),
        why: grid.why.clone(),
        lists: lists.collect(),
        program: grid.program.clone(),
        assertions: grid.assertions.clone(),
        first,
        others: of_grid.map(|case| case.name.clone()).collect(),
    }
}

/// The sections of the sources of a rule, for the search.
pub(super) fn places(rule: &Rule) -> String {
    sections(&rule.sources).join("; ")
}
