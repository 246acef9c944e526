//! Licences of dependencies.

use gaugeblock_laws::workspace;

use crate::holds;

/// Licences that a dependency may have, each of them alone.
const LICENCES: &[&str] = &[
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

#[test]
fn licences_of_dependencies_are_allowed() {
    let foreign = workspace::packages().into_iter().filter(|package| !package.is_ours);
    let refused: Vec<_> = foreign
        .filter(|package| !allowed(&package.license))
        .map(|package| format!("{}: {}", package.name, package.license))
        .collect();
    holds("dependencies have permissive licences", &refused);
}

/// Whether an SPDX expression can be met by allowed licences: one of each `OR`, all of each `AND`.
fn allowed(expression: &str) -> bool {
    let expression = expression.trim();
    let inner = expression.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
    match (split(expression, " OR "), split(expression, " AND "), inner) {
        (Some((one, other)), _, _) => allowed(one) || allowed(other),
        (None, Some((one, other)), _) => allowed(one) && allowed(other),
        (None, None, Some(inner)) => allowed(inner),
        (None, None, None) => match expression.split_once('/') {
            Some((one, other)) => allowed(one) || allowed(other),
            None => LICENCES.contains(&expression),
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
    for good in ["MIT", "MIT/GPL-2.0", "GPL-2.0 OR MIT", "(MIT OR GPL-2.0) AND Unicode-3.0"] {
        assert!(allowed(good), "{good}");
    }
    for bad in ["", "GPL-2.0", "MIT AND GPL-2.0", "(MIT OR ISC) AND GPL-2.0", "Apache-2.0 WITH x"] {
        assert!(!allowed(bad), "{bad}");
    }
}
