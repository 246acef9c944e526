//! What each crate of the workspace has.

use std::collections::BTreeSet;
use std::fs;

use gaugeblock_laws::files;
use gaugeblock_laws::workspace;

use crate::holds;

#[test]
fn documents_name_each_direct_dependency() {
    let crates = workspace::crates();
    let mut documents = files::below("docs");
    documents.retain(|path, _| path.ends_with(".md"));
    for path in ["README.md", "ARCHITECTURE.md"] {
        documents.insert(path.to_owned(), fs::read_to_string(files::root().join(path)).unwrap());
    }
    let direct: BTreeSet<_> =
        crates.values().flat_map(workspace::Crate::all_dependencies).collect();
    let foreign = direct.into_iter().filter(|name| !crates.contains_key(*name));
    let missing: Vec<_> = foreign
        .filter(|name| !documents.values().any(|text| text.contains(&format!("`{name}`"))))
        .map(str::to_owned)
        .collect();
    holds(
        "README, ARCHITECTURE or docs say of each direct dependency, in one line, what it is for",
        &missing,
    );
}

/// The compiler forbids `unsafe` and requires documentation in every crate that takes the workspace's lints.
#[test]
fn every_crate_takes_the_lints_of_the_workspace() {
    let manifests = files::below("").into_iter().filter(|(path, _)| path.ends_with("Cargo.toml"));
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
    assert_eq!(crates, workspace::crates().len(), "a manifest that is no member of the workspace");
}
