//! What a crate must not know of: model and production of each other, and both of the machine that they run on.

use std::collections::BTreeSet;
use std::fs;

use gaugeblock_laws::files::{self, lines_with, sources};
use gaugeblock_laws::workspace::{self, Crate};

use crate::holds;

/// Sources of the model, and the folder of what real controllers do differently, which a build can leave out.
const MODEL_SOURCES: &str = "reference-model/src";
const DIALECTS: &str = "reference-model/src/dialects/";

/// Folder of the production side; each crate below it is written without the model.
const PRODUCTION: &str = "impl";

const VOCABULARY: &str = "gaugeblock-vocabulary";
const MODEL: &str = "gaugeblock-reference";

fn is_production(found: &Crate) -> bool {
    found.folder == PRODUCTION || found.folder.starts_with(&format!("{PRODUCTION}/"))
}

/// A bug could hide on both sides if the two sides shared more than the vocabulary.
#[test]
fn model_and_production_share_the_vocabulary_alone() {
    let crates = workspace::crates();
    let production: BTreeSet<_> = crates
        .values()
        .filter(|found| is_production(found))
        .map(|found| found.name.as_str())
        .collect();
    assert!(!production.is_empty(), "no crate is below {PRODUCTION}");
    let ours = |found: &Crate| -> BTreeSet<String> {
        let on = found.all_dependencies().into_iter().filter(|name| crates.contains_key(*name));
        on.map(str::to_owned).collect()
    };
    assert_eq!(ours(&crates[MODEL]), BTreeSet::from([VOCABULARY.to_owned()]));
    assert_eq!(ours(&crates[VOCABULARY]), BTreeSet::new());
    for name in &production {
        let mut others = ours(&crates[*name]);
        others.retain(|other| other != VOCABULARY && !production.contains(other.as_str()));
        assert_eq!(
            others,
            BTreeSet::new(),
            "{name} depends on more than production and the vocabulary"
        );
    }
}

/// The main path of the model says what the documents say, and a build without the dialects says all of it.
#[test]
fn main_path_of_the_model_knows_no_quirk() {
    let mut main_path = sources(MODEL_SOURCES);
    let all = main_path.len();
    main_path.retain(|path, _| !path.starts_with(DIALECTS));
    assert!(main_path.len() < all, "no source is below {DIALECTS}");
    let named: Vec<_> = main_path
        .iter()
        .flat_map(|(path, text)| text.lines().enumerate().map(move |(at, line)| (path, at, line)))
        .filter(|(_, _, line)| line.to_lowercase().contains("quirk"))
        .map(|(path, at, line)| format!("{path}:{}: {}", at + 1, line.trim()))
        .collect();
    holds("quirks are in the model's dialects alone", &named);
}

/// An adapter uses what an adapter in another language could use.
#[test]
fn adapter_of_a_real_controller_imports_no_model() {
    let mut adapter = sources("conformance/linuxcnc/src");
    adapter.extend(sources("conformance/grbl/src"));
    let imported = lines_with(
        &adapter,
        &["gaugeblock_reference", "gaugeblock_interpreter", "gaugeblock_planner"],
    );
    holds("the adapters of LinuxCNC and Grbl import neither model nor production", &imported);
}

/// Two runs give the same bytes.
#[test]
fn nothing_is_read_but_the_scenario() {
    let outside = ["fs", "env", "time", "net", "process", "thread", "io"];
    let words: Vec<_> = outside.iter().map(|module| format!("std::{module}")).collect();
    let words: Vec<_> = words.iter().map(String::as_str).collect();
    for found in workspace::crates().values() {
        if is_production(found) || [VOCABULARY, MODEL].contains(&found.name.as_str()) {
            let read = lines_with(&sources(&found.sources()), &words);
            holds("the scenario is all that a run depends on", &read);
        }
    }
}

#[test]
fn production_has_no_std() {
    for found in workspace::crates().values().filter(|found| is_production(found)) {
        let library = found.targets.iter().find(|target| target.kind == "lib").unwrap();
        let text = fs::read_to_string(files::root().join(&library.source)).unwrap();
        assert!(text.contains("#![no_std]"), "{} lacks #![no_std]", library.source);
    }
}
