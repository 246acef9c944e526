//! The list of equivalent mutants names lines of its targets; the script `.ci/mutants` stops at an outdated entry.

use std::fs;

use gaugeblock_laws::files;

use crate::holds;

#[test]
fn equivalent_mutants_name_lines_of_their_files() {
    let list = fs::read_to_string(files::root().join(".ci/mutants.toml")).unwrap();
    let list: toml::Table = list.parse().unwrap();
    // Files of other targets are named by their whole paths.
    let targets = ["reference-model/src/", "impl/planner/src/"];
    let sources = files::root().join("impl/interpreter/src");
    let mut outdated = Vec::new();
    for entry in list["equivalent"].as_array().unwrap() {
        let (file, line) = (entry["file"].as_str().unwrap(), entry["line"].as_str().unwrap());
        let is_whole = targets.iter().any(|target| file.starts_with(target));
        let path = if is_whole { files::root().join(file) } else { sources.join(file) };
        let text = fs::read_to_string(path).unwrap_or_default();
        if !text.lines().any(|found| found.trim() == line) {
            outdated.push(format!("{file}: {line}"));
        }
    }
    holds("each entry of .ci/mutants.toml names a line of its file", &outdated);
}
