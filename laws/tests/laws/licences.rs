//! Licences of dependencies.

use gaugeblock_laws::{files, workspace};

use crate::holds;

/// Licences that a dependency may have, each of them alone; `cargo deny` reads the same list.
fn licences() -> Vec<String> {
    let text =
        std::fs::read_to_string(files::root().join("deny.toml")).expect("deny.toml can be read");
    let file: toml::Table = text.parse().expect("deny.toml is TOML");
    let list = file["licenses"]["allow"].as_array().expect("deny.toml lists licences").iter();
    list.filter_map(toml::Value::as_str).map(str::to_owned).collect()
}

#[test]
fn licences_of_dependencies_are_allowed() {
    let licences = licences();
    let foreign = workspace::packages().into_iter().filter(|package| !package.is_ours);
    let refused: Vec<_> = foreign
        .filter(|package| !allowed(&licences, &package.license))
        .map(|package| format!("{}: {}", package.name, package.license))
        .collect();
    holds("dependencies have permissive licences", &refused);
}

/// Whether an SPDX expression can be met by allowed licences: one of each `OR`, all of each `AND`.
fn allowed(licences: &[String], expression: &str) -> bool {
    let expression = expression.trim();
    let inner = expression.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
    match (split(expression, " OR "), split(expression, " AND "), inner) {
        (Some((one, other)), _, _) => allowed(licences, one) || allowed(licences, other),
        (None, Some((one, other)), _) => allowed(licences, one) && allowed(licences, other),
        (None, None, Some(inner)) => allowed(licences, inner),
        (None, None, None) => match expression.split_once('/') {
            Some((one, other)) => allowed(licences, one) || allowed(licences, other),
            None => licences.iter().any(|licence| licence == expression),
        },
    }
}

/// Splits at the first operator outside of parentheses.
fn split<'a>(expression: &'a str, operator: &str) -> Option<(&'a str, &'a str)> {
    let outside = |place: &usize| {
        let before = &expression[..*place];
        before.matches('(').count() == before.matches(')').count()
    };
    let place = expression.match_indices(operator).map(|(place, _)| place).find(outside)?;
    Some((&expression[..place], &expression[place + operator.len()..]))
}

#[test]
fn licence_expressions_are_understood() {
    let licences = ["MIT", "ISC", "Apache-2.0", "Unicode-3.0"].map(str::to_owned);
    for good in ["MIT", "MIT/GPL-2.0", "GPL-2.0 OR MIT", "(MIT OR GPL-2.0) AND Unicode-3.0"] {
        assert!(allowed(&licences, good), "{good}");
    }
    for bad in ["", "GPL-2.0", "MIT AND GPL-2.0", "(MIT OR ISC) AND GPL-2.0", "Apache-2.0 WITH x"] {
        assert!(!allowed(&licences, bad), "{bad}");
    }
}
