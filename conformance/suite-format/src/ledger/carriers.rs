//! Checks that the pages which a ledger names exist: a sentence whose page is gone is no longer carried.

use serde::Deserialize;
use toml::Spanned;

use crate::{ChoiceKind, Suite};

/// As much of a ledger as names pages, each name with its place.
#[derive(Deserialize)]
struct Names {
    #[serde(default, rename = "section")]
    sections: Vec<Section>,
}

#[derive(Deserialize)]
struct Section {
    items: Vec<Item>,
    #[serde(default)]
    grids: Vec<Grid>,
}

#[derive(Deserialize)]
struct Grid {
    name: Spanned<String>,
}

#[derive(Deserialize)]
struct Item {
    #[serde(default)]
    rules: Vec<Spanned<String>>,
    #[serde(default)]
    choices: Vec<Spanned<String>>,
    #[serde(default)]
    quirks: Vec<Spanned<String>>,
}

/// The rules, grids, choices and quirks that a ledger names and the suite does not have, each with its line. A text
/// that is not a ledger has none.
pub fn absent(text: &str, suite: &Suite) -> Vec<(usize, String)> {
    let Ok(names) = toml::from_str::<Names>(text) else { return Vec::new() };
    let is_choice = |id: &str, kind: ChoiceKind| {
        suite.choices.iter().any(|choice| choice.kind == kind && choice.id == id)
    };
    // A choice of motion carries a sentence as a rule does.
    let is_rule = |id: &str| {
        suite.rule(id).is_some() || suite.motion_choices.iter().any(|choice| choice.id == id)
    };
    let is_grid = |name: &str| {
        let Some((rule, name)) = name.split_once(" / ") else { return false };
        suite.rule(rule).is_some_and(|rule| {
            rule.grids.iter().any(|grid| grid.name == name)
                || rule.case_names().any(|case| case == name)
        })
    };
    let mut absent = Vec::new();
    let mut look = |what: &str, ids: &[Spanned<String>], is_there: &dyn Fn(&str) -> bool| {
        for id in ids.iter().filter(|id| !is_there(id.get_ref())) {
            let line = text[..id.span().start].matches('\n').count() + 1;
            absent.push((line, format!("unknown {what} `{}`", id.get_ref())));
        }
    };
    for grid in names.sections.iter().flat_map(|section| &section.grids) {
        look("grid or case", std::slice::from_ref(&grid.name), &is_grid);
    }
    for item in names.sections.iter().flat_map(|section| &section.items) {
        look("rule", &item.rules, &is_rule);
        look("choice", &item.choices, &|id| is_choice(id, ChoiceKind::Choice));
        look("quirk", &item.quirks, &|id| is_choice(id, ChoiceKind::Quirk));
    }
    absent
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::Files;

    fn files() -> Files {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../suite");
        crate::files::of_folder(&folder).expect("the folder of the suite")
    }

    #[test]
    fn missing_page_is_reported_with_its_ledger_line() {
        let suite = Suite::read(&files()).expect("the suite");
        let text = r#"
[[section]]
name = "Feed"
items = [
  { n = 1, rules = ["saved-state.feed", "trajectory.motion-start"] },
  { n = 2, rules = ["saved-state.feed", "no.such"], choices = ["pause.pallet-codes"] },
  { n = 3, choices = ["rs274.feed-zero-at-end"], quirks = ["rs274.feed-zero-at-end", "pause.pallet-codes"] },
]
grids = [
  { n = [1], name = "saved-state.feed / with decimals" },
  { n = [2], name = "saved-state.feed / unknown" },
]
"#;
        let found = absent(text, &suite);
        let expected = [
            (11, "unknown grid or case `saved-state.feed / unknown`"),
            (6, "unknown rule `no.such`"),
            (7, "unknown choice `rs274.feed-zero-at-end`"),
            (7, "unknown quirk `pause.pallet-codes`"),
        ];
        assert_eq!(found, expected.map(|(line, fault)| (line, fault.to_owned())));
    }

    #[test]
    fn a_page_that_is_deleted_leaves_its_sentences_without_a_carrier() {
        let files = files();
        let mut suite = Suite::read(&files).expect("the suite");
        let ledgers = || files.iter().filter(|(path, _)| path.starts_with("documents/"));
        let absent = |suite: &Suite| -> Vec<(usize, String)> {
            ledgers().flat_map(|(_, text)| absent(text, suite)).collect()
        };
        assert_eq!(absent(&suite), []);
        suite.rules.retain(|rule| rule.id != "saved-state.feed");
        let left = absent(&suite);
        assert!(!left.is_empty());
        assert!(left.iter().all(|(_, fault)| fault == "unknown rule `saved-state.feed`"));
    }
}
