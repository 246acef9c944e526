//! The book of this repository's suite: each page is there, and each link leads to a page.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use gaugeblock_book::{Book, GUIDE, anchor, choice_address, code_address, render, rule_address};
use gaugeblock_suite::Suite;
use gaugeblock_suite::ledger::Ledger;

/// The pages by their path. They are rendered once for all tests.
fn pages() -> &'static (Suite, BTreeMap<String, String>) {
    static PAGES: LazyLock<(Suite, BTreeMap<String, String>)> = LazyLock::new(rendered);
    &PAGES
}

fn rendered() -> (Suite, BTreeMap<String, String>) {
    let files = gaugeblock_embedded_suite::files().expect("the suite");
    let suite = Suite::read(&files).unwrap_or_else(|errors| panic!("{}", errors.join("\n")));
    let documents = files.iter().filter(|(path, _)| path.starts_with("documents/"));
    let ledgers: Vec<Ledger> = documents
        .map(|(path, text)| Ledger::parse(text).unwrap_or_else(|e| panic!("{path}: {e}")))
        .collect();
    let book = Book {
        suite: &suite,
        ledgers: &ledgers,
        comparison: None,
        guide: &GUIDE,
        repository: Some("https://example.org/"),
    };
    let pages = render(&book).expect("every template fits");
    let pages = pages.into_iter().map(|page| (page.path, page.text)).collect();
    (suite, pages)
}

/// The values of an attribute in a page.
fn attributes<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let begin = format!(" {name}=\"");
    let ends = page.split(&begin).skip(1);
    ends.filter_map(|rest| rest.split_once('"').map(|(value, _)| value)).collect()
}

/// A link of a page, as a path within the site and a place.
fn resolved(from: &str, link: &str) -> (String, String) {
    let (path, place) = link.split_once('#').unwrap_or((link, ""));
    if path.is_empty() {
        return (from.to_owned(), place.to_owned());
    }
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in path.split('/') {
        if part == ".." {
            parts.pop();
        } else {
            parts.push(part);
        }
    }
    (parts.join("/"), place.to_owned())
}

#[test]
fn every_link_leads_to_a_page_and_a_place_in_it() {
    let (_, pages) = pages();
    let mut places: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (path, text) in pages {
        places.insert(path, attributes(text, "id").into_iter().collect());
    }
    let mut broken = Vec::new();
    for (path, text) in pages.iter().filter(|(path, _)| path.ends_with(".html")) {
        let links = attributes(text, "href").into_iter().chain(attributes(text, "src"));
        for link in links.filter(|link| !link.contains("://") && !link.starts_with("mailto:")) {
            let (to, place) = resolved(path, link);
            let has = places
                .get(to.as_str())
                .is_some_and(|all| place.is_empty() || all.contains(place.as_str()));
            if !has {
                broken.push(format!("{path}: {link}"));
            }
        }
    }
    broken.dedup();
    let count = broken.len();
    broken.truncate(20);
    assert!(broken.is_empty(), "{count} links lead nowhere: {broken:#?}");
}

#[test]
fn every_rule_choice_and_edition_has_a_page_at_the_address_of_its_id() {
    let (suite, pages) = pages();
    for rule in &suite.rules {
        let page = &pages[&rule_address(&rule.id)];
        assert!(page.contains(&rule.id), "{}", rule.id);
    }
    for choice in &suite.choices {
        assert!(pages.contains_key(&choice_address(&choice.id)), "{}", choice.id);
    }
    for choice in &suite.motion_choices {
        assert!(pages.contains_key(&choice_address(&choice.id)), "{}", choice.id);
    }
    for edition in &suite.editions {
        assert!(pages.contains_key(&format!("editions/{}.html", edition.id)), "{}", edition.id);
    }
    for code in ["M73", "G2", "G5.2", "G43", "M19"] {
        assert!(pages[&code_address(code)].contains("rules/"), "{code}");
    }
}

#[test]
fn no_place_is_in_a_page_twice() {
    let (_, pages) = pages();
    for (path, text) in pages {
        let mut all = attributes(text, "id");
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count, "{path}");
    }
}

#[test]
fn case_has_its_place_its_program_and_what_each_block_does() {
    let (_, pages) = pages();
    let page = &pages["rules/cycles.bore-return.html"];
    assert!(page.contains(&format!("id=\"{}\"", anchor("under G98"))), "its place");
    assert!(page.contains("g85 x4 z1 r2"), "its program");
    assert!(page.contains("straight_feed end=(x4 z1)"), "what it does");
    assert!(page.contains("when cycles.bore-return = feed:"), "what is checked");
}

#[test]
fn option_of_a_choice_has_what_each_block_does_under_it() {
    let (_, pages) = pages();
    for path in
        ["choices/rs274.feed-unit.html", "choices/nct.depth.html", "choices/gpp.newline.html"]
    {
        let page = &pages[path];
        assert!(page.contains("<table class=\"trace\">"), "{path}");
        assert!(!page.contains("no choice or quirk"), "{path}");
    }
}

#[test]
fn text_of_a_program_is_escaped() {
    let (_, pages) = pages();
    for (path, text) in pages.iter().filter(|(path, _)| path.starts_with("rules/")) {
        assert!(!text.contains("<_"), "{path}: `<` of a named parameter");
    }
}

#[test]
fn addresses_of_an_earlier_book_stay() {
    // Pages of others link to these. An id that goes needs a page that says so.
    for (id, address) in [
        ("saved-state.feed", "rules/saved-state.feed.html"),
        ("arcs.equal-radii", "rules/arcs.equal-radii.html"),
    ] {
        assert_eq!(rule_address(id), address);
    }
    assert_eq!(choice_address("rs274.feed-zero-at-end"), "choices/rs274.feed-zero-at-end.html");
    assert_eq!(code_address("M73"), "codes/M73.html");
}
