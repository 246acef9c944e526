//! The list of equivalent mutants names lines of the interpreter; the script `.ci/mutants` stops at an outdated entry.

use std::fs;

use gaugeblock_laws::files;

use crate::holds;

#[test]
fn equivalent_mutants_name_lines_of_the_interpreter() {
    let list = fs::read_to_string(files::root().join(".ci/mutants.toml")).unwrap();
    let list: toml::Table = list.parse().unwrap();
    let sources = files::root().join("impl/interpreter/src");
    let mut outdated = Vec::new();
    for entry in list["equivalent"].as_array().unwrap() {
        let (file, line) = (entry["file"].as_str().unwrap(), entry["line"].as_str().unwrap());
        let text = fs::read_to_string(sources.join(file)).unwrap_or_default();
        if !text.lines().any(|found| found.trim() == line) {
            outdated.push(format!("{file}: {line}"));
        }
    }
    holds("each entry of .ci/mutants.toml names a line of its file", &outdated);
}
