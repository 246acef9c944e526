//! What each file of the repository has and has not.

use gaugeblock_laws::files::{below, lines_with, sources};

use crate::holds;

/// A longer file is split by meaning.
const LINES_MAX: usize = 500;

#[test]
fn no_source_file_is_longer_than_500_lines() {
    let long = sources("").into_iter().map(|(path, text)| (path, text.lines().count()));
    let long: Vec<_> = long
        .filter(|(_, lines)| *lines > LINES_MAX)
        .map(|(path, lines)| format!("{path}: {lines}"))
        .collect();
    holds("a source file has 500 lines at most", &long);
}

#[test]
fn no_test_is_ignored() {
    let ignored = [concat!("#[", "ignore"), concat!(", ", "ignore)")];
    holds("every test runs", &lines_with(&sources(""), &ignored));
}

/// `clippy.toml` sets the longest function, and no exception is granted.
#[test]
fn no_function_is_excused_from_its_greatest_length() {
    let excused = [concat!("clippy::", "too_many_lines")];
    holds("a function has 80 lines at most", &lines_with(&sources(""), &excused));
    let clippy = below("")["clippy.toml"].clone();
    assert!(
        clippy.contains("too-many-lines-threshold = 80"),
        "clippy.toml allows longer functions"
    );
}

/// A path that exists on one machine helps on no other.
#[test]
fn no_file_names_a_place_on_some_machine() {
    let homes = [
        concat!("/wo", "rk/"),
        concat!("/ro", "ot/"),
        concat!("/ho", "me/"),
        concat!("/Us", "ers/"),
    ];
    holds("files name places within the repository alone", &lines_with(&below(""), &homes));
}

/// `gaugeblock-filesystem` replaces no device and follows no link to a file of its own. Programs that write sources of
/// this repository are no part of the referee.
#[test]
fn the_referee_writes_files_through_one_crate() {
    let of_the_referee = |path: &str| {
        path.contains("/src/")
            && !path.contains("/src/bin/")
            && !path.starts_with("conformance/filesystem/")
            && !path.ends_with("tests.rs")
    };
    let before_tests = |(path, text): (String, String)| {
        let code = text.split("#[cfg(test)]").next().unwrap_or_default().to_owned();
        (path, code)
    };
    let sources = sources("conformance").into_iter().filter(|(path, _)| of_the_referee(path));
    let writes =
        ["fs::write(", "File::create(", "File::create_new(", "fs::rename(", "DirBuilder::"];
    let found = lines_with(&sources.map(before_tests).collect(), &writes);
    holds("the referee writes files through gaugeblock-filesystem", &found);
}
