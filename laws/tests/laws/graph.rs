//! Which crate and which file may use which.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_laws::files;
use gaugeblock_laws::graph;
use gaugeblock_laws::report;
use gaugeblock_laws::workspace;

use crate::holds;

/// Form of the data of the laws.
const EXPECTED: &str = "a data file of the laws, in the form that its head describes";

/// Circles of files in the whole repository, each with its reason.
const CIRCLES_MAX: usize = 6;

fn table(path: &str) -> toml::Table {
    let text = std::fs::read_to_string(files::root().join(path)).expect(EXPECTED);
    text.parse().unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn words(value: &toml::Value) -> BTreeSet<String> {
    let words = value.as_array().expect(EXPECTED).iter();
    words.map(|word| word.as_str().expect(EXPECTED).to_owned()).collect()
}

#[test]
fn no_crate_builds_on_one_of_a_higher_layer() {
    let file = table("laws/layers.toml");
    let mut layer_of = BTreeMap::new();
    for (number, layer) in file["layer"].as_array().expect(EXPECTED).iter().enumerate() {
        for name in words(&layer["crates"]) {
            assert_eq!(layer_of.insert(name.clone(), number), None, "{name} is in two layers");
        }
    }
    let crates = workspace::crates();
    let listed: BTreeSet<_> = layer_of.keys().collect();
    assert_eq!(
        listed,
        crates.keys().collect(),
        "laws/layers.toml lists each crate of the workspace"
    );
    let mut upward = Vec::new();
    for (name, on) in graph::of_crates(&crates) {
        let above = on.iter().filter(|other| layer_of[*other] >= layer_of[&name]);
        upward.extend(above.map(|other| format!("{name} builds on {other}")));
    }
    holds("a crate builds on lower layers alone", &upward);
}

#[test]
fn each_circle_of_files_is_listed_with_its_reason() {
    let graphs = graph::of_files(&workspace::crates());
    let mut circles: BTreeSet<_> = graphs.values().flat_map(report::circles).collect();
    let file = table("laws/circles.toml");
    let none = Vec::new();
    let listed = file.get("circle").map_or(&none, |listed| listed.as_array().expect(EXPECTED));
    assert!(listed.len() <= CIRCLES_MAX, "laws/circles.toml lists more than {CIRCLES_MAX} circles");
    for circle in listed {
        assert!(
            circle["reason"].as_str().is_some_and(|reason| reason.len() > 20),
            "{circle:?} lacks its reason"
        );
        assert!(circles.remove(&words(&circle["files"])), "no such circle is left: {circle:?}");
    }
    let ceiling =
        file.get("ceiling").map_or(0, |ceiling| ceiling["files"].as_integer().expect(EXPECTED));
    let files: usize = circles.iter().map(BTreeSet::len).sum();
    let list: Vec<_> = circles.iter().map(|circle| format!("{circle:?}")).collect();
    assert!(
        files <= usize::try_from(ceiling).expect(EXPECTED),
        "{files} files are in circles that laws/circles.toml does not list, of {ceiling} granted; \
         `cargo run -p gaugeblock-laws -- graph` lists their edges:\n  {}",
        list.join("\n  "),
    );
}
