//! Laws of the repository: what the design promises about its crates and files, held by a test each.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Licences that a dependency may stand under, each of them alone.
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

fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().expect("the referee lies one folder below the root").to_owned()
}

/// Files of the repository below a folder, by path from the root; build products and version control left out.
fn files(folder: &str) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    let mut open = vec![root().join(folder)];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("a folder can be listed") {
            let path = entry.expect("an entry can be read").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                let ours = [".ci", ".github", ".clusterfuzzlite"];
                let foreign =
                    name == "target" || (name.starts_with('.') && !ours.contains(&name.as_str()));
                if !foreign {
                    open.push(path);
                }
            } else if let Ok(text) = fs::read_to_string(&path) {
                let place = path.strip_prefix(root()).expect("it lies below the root");
                found.insert(place.to_string_lossy().into_owned(), text);
            }
        }
    }
    assert!(!found.is_empty(), "{folder} is empty: the law would hold for nothing");
    found
}

fn sources(folder: &str) -> BTreeMap<String, String> {
    files(folder).into_iter().filter(|(path, _)| path.ends_with(".rs")).collect()
}

/// Places (`path:line`) at which one of these words stands.
fn places<'a>(files: &'a BTreeMap<String, String>, words: &[&str]) -> Vec<String> {
    let stands = |line: &str| words.iter().any(|word| line.contains(word));
    let in_file = |(path, text): (&'a String, &'a String)| {
        let lines = text.lines().enumerate().filter(|(_, line)| stands(line));
        lines
            .map(|(place, line)| format!("{path}:{}: {}", place + 1, line.trim()))
            .collect::<Vec<_>>()
    };
    files.iter().flat_map(in_file).collect()
}

#[track_caller]
fn nowhere(law: &str, places: &[String]) {
    assert!(places.is_empty(), "{law}, but:\n  {}", places.join("\n  "));
}

/// Packages that this machine builds, as cargo sees them.
fn packages() -> Vec<Value> {
    let host = Command::new("rustc").arg("-vV").output().expect("rustc runs");
    let host = String::from_utf8_lossy(&host.stdout).into_owned();
    let host = host.lines().find_map(|line| line.strip_prefix("host: ")).expect("rustc has a host");
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--offline", "--locked"])
        .args(["--filter-platform", host])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo writes JSON");
    metadata["packages"].as_array().expect("cargo lists packages").clone()
}

fn is_ours(package: &Value) -> bool {
    package["source"].is_null()
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// Crates of this workspace by name, each with the names of all that it depends on.
fn workspace() -> BTreeMap<String, BTreeSet<String>> {
    let ours = packages().into_iter().filter(is_ours);
    ours.map(|package| {
        let on = package["dependencies"].as_array().expect("a package lists dependencies").iter();
        let names = on.map(|dependency| text(dependency, "name").to_owned()).collect();
        (text(&package, "name").to_owned(), names)
    })
    .collect()
}

/// A bug could hide on both sides if the two sides shared more than the vocabulary.
#[test]
fn model_and_production_share_the_vocabulary_alone() {
    let workspace = workspace();
    let shared = |name: &str| -> BTreeSet<&str> {
        let on = workspace.get(name).unwrap_or_else(|| panic!("{name} is not in the workspace"));
        on.iter().map(String::as_str).filter(|on| workspace.contains_key(*on)).collect()
    };
    let vocabulary = BTreeSet::from(["gaugeblock-vocabulary"]);
    assert_eq!(shared("gaugeblock-reference"), vocabulary);
    assert_eq!(shared("gaugeblock-impl"), vocabulary);
    assert_eq!(shared("gaugeblock-vocabulary"), BTreeSet::new());
}

#[test]
fn adapter_of_a_real_controller_knows_no_model() {
    let adapter = sources("conformance/src/adapters/rs274");
    nowhere(
        "it uses what an adapter in another language could use",
        &places(&adapter, &["gaugeblock_reference", "gaugeblock_impl"]),
    );
}

/// Two runs give the same bytes.
#[test]
fn nothing_is_read_but_the_scenario() {
    let outside = ["fs", "env", "time", "net", "process", "thread", "io"];
    let words: Vec<_> = outside.iter().map(|module| format!("std::{module}")).collect();
    let words: Vec<_> = words.iter().map(String::as_str).collect();
    for folder in ["reference-model/src", "vocabulary/src", "impl/src"] {
        nowhere("the scenario is all that a run depends on", &places(&sources(folder), &words));
    }
    let production = fs::read_to_string(root().join("impl/src/lib.rs")).unwrap();
    assert!(production.contains("#![no_std]"), "production has no std");
}

/// A rule that is not listed would be put down nowhere.
#[test]
fn each_id_in_the_text_of_the_model_is_listed() {
    use gaugeblock_reference::{RULES, gpp, nct, rs274};
    let choices = [rs274::readings::CHOICES, gpp::readings::CHOICES, nct::readings::CHOICES];
    let choices = choices.into_iter().flatten().map(|(id, _)| *id);
    let ids = RULES.lines().chain(choices).chain(rs274::readings::QUIRKS.iter().copied());
    let ids: BTreeSet<&str> = ids.collect();
    let chapters: BTreeSet<_> = ids.iter().filter_map(|id| id.split('.').next()).collect();
    let mut model = sources("reference-model/src");
    // Names of HAL look like ids.
    model.retain(|path, _| !path.ends_with("outside/hal.rs"));
    let mut found = 0;
    for (path, text) in &model {
        let text = text.split("#[cfg(test)]").next().unwrap_or_default();
        // What stands between two quotation marks is a literal, or what is between two of them; no id has a blank.
        for id in text.split('"').filter(|piece| !piece.contains([' ', '\n', '…'])) {
            let chapter = id.split_once('.').map(|(chapter, _)| chapter);
            if chapter.is_some_and(|chapter| chapters.contains(chapter)) {
                assert!(ids.contains(id), "{id} in {path}");
                found += 1;
            }
        }
    }
    assert!(found > 1000, "{found}");
}

#[test]
fn licences_of_dependencies_are_allowed() {
    let foreign = packages().into_iter().filter(|package| !is_ours(package));
    let refused: Vec<_> = foreign
        .filter(|package| !allowed(text(package, "license")))
        .map(|package| format!("{}: {}", text(&package, "name"), package["license"]))
        .collect();
    nowhere("dependencies stand under permissive licences", &refused);
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

#[test]
fn readme_names_each_direct_dependency() {
    let workspace = workspace();
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let direct: BTreeSet<_> = workspace.values().flatten().collect();
    let foreign = direct.into_iter().filter(|name| !workspace.contains_key(*name));
    let missing: Vec<_> =
        foreign.filter(|name| !readme.contains(&format!("`{name}`"))).cloned().collect();
    nowhere("the README says of each direct dependency, in one line, what it is for", &missing);
}

/// A room that grew beyond this is split by meaning.
#[test]
fn no_source_file_is_longer_than_500_lines() {
    let long = sources("").into_iter().map(|(path, text)| (path, text.lines().count()));
    let long: Vec<_> =
        long.filter(|(_, lines)| *lines > 500).map(|(path, n)| format!("{path}: {n}")).collect();
    nowhere("a source file has 500 lines at most", &long);
}

#[test]
fn no_test_is_ignored() {
    let ignored = [concat!("#[", "ignore"), concat!(", ", "ignore)")];
    nowhere("every test runs", &places(&sources(""), &ignored));
}

/// The compiler forbids `unsafe` and asks for documentation, in every crate that takes the workspace's lints.
#[test]
fn every_crate_takes_the_lints_of_the_workspace() {
    let manifests = files("").into_iter().filter(|(path, _)| path.ends_with("Cargo.toml"));
    let mut crates = 0;
    for (path, text) in manifests {
        let manifest: toml::Table = text.parse().unwrap();
        if let Some(workspace) = manifest.get("workspace") {
            let lints = &workspace["lints"]["rust"];
            assert_eq!(lints["unsafe_code"].as_str(), Some("forbid"), "{path}");
            assert_eq!(lints["missing_docs"].as_str(), Some("warn"), "{path}");
        } else {
            let lints = manifest.get("lints").and_then(|lints| lints.get("workspace"));
            assert_eq!(lints.and_then(toml::Value::as_bool), Some(true), "{path}");
            crates += 1;
        }
    }
    assert_eq!(crates, workspace().len());
}

/// A path that exists on one machine helps nobody else.
#[test]
fn no_file_names_a_place_on_some_machine() {
    let homes = [
        concat!("/wo", "rk/"),
        concat!("/ro", "ot/"),
        concat!("/ho", "me/"),
        concat!("/Us", "ers/"),
    ];
    nowhere("files name places within the repository alone", &places(&files(""), &homes));
}
