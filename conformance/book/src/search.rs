//! The index that the search of the site reads.

use serde::Serialize;

use super::address;
use super::code_page::Codes;
use super::contents::Book;
use super::guide;
use super::rule_page::places;
use super::site::Site;

/// A page, as the search finds it.
#[derive(Debug, Serialize)]
struct Entry<'a> {
    #[serde(rename = "k")]
    kind: &'static str,
    #[serde(rename = "n")]
    name: &'a str,
    #[serde(rename = "s")]
    sentence: &'a str,
    #[serde(rename = "w")]
    words: String,
    #[serde(rename = "a")]
    address: String,
}

/// Adds the index as a script, which a page from a folder can load, too.
pub(super) fn add(book: &Book<'_>, site: &mut Site) {
    let suite = book.suite;
    let codes = Codes::of(suite);
    let codes: Vec<(String, &str)> = codes.all().collect();
    let titles: Vec<(String, &str)> =
        book.guide.iter().map(|guide| (guide.title(), guide.path)).collect();
    let entry =
        |kind, name, sentence, words, address| Entry { kind, name, sentence, words, address };
    let mut entries = Vec::new();
    for (code, title) in &codes {
        entries.push(entry("code", code, title, String::new(), address::code(code)));
    }
    for rule in &suite.rules {
        let address = address::rule(&rule.id);
        entries.push(entry("rule", &rule.id, &rule.sentence, places(rule), address));
    }
    for choice in &suite.choices {
        let address = address::choice(&choice.id);
        entries.push(entry("choice", &choice.id, &choice.sentence, String::new(), address));
    }
    for choice in &suite.motion_choices {
        let address = address::choice(&choice.id);
        entries.push(entry("choice", &choice.id, &choice.sentence, String::new(), address));
    }
    for (title, path) in &titles {
        entries.push(entry("guide", title, "", String::new(), guide::address(path)));
    }
    let json = serde_json::to_string(&entries).unwrap_or_default();
    site.add_file("search-index.js", format!("window.searchIndex = {json};\n"));
}
