//! The subroutine files that the calls of a program can reach: no other file of its folder belongs to it.
//!
//! The calls are read generously: a file that is reached too many changes nothing, one that is missing does. Names are
//! those of the documents: `o<bore> call` and `o100 call` look for `bore.ngc` and `100.ngc`, as `M98 P100` does.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use gaugeblock_vocabulary::Program;
use gaugeblock_vocabulary::scenario::{Action, OperatorEvent};

use crate::command::user_files;
use crate::streams::write_error;

/// What the name of a subroutine file ends with.
const EXTENSION: &str = "ngc";

/// What the blocks of one text call.
#[derive(Debug, Default, PartialEq, Eq)]
struct Calls {
    /// Names and numbers of subs that the text does not define before it calls them.
    subs: BTreeSet<String>,
    /// Whether a number is computed, so that any numbered file can be called.
    any_number: bool,
}

/// Adds to a program the files of its folder that its calls, or those of the operator, can reach. A file that the
/// program has already is kept. One that is not text is left out, with a note.
pub(crate) fn add_called_files(program: &mut Program, folder: &Path, operator: &[OperatorEvent]) {
    let by_hand = operator.iter().filter_map(|event| match &event.action {
        Action::Mdi(text) => Some(text),
        Action::CycleStart
        | Action::Pause
        | Action::Resume
        | Action::Abort
        | Action::Mode(_)
        | Action::OptionalStop(_)
        | Action::FeedOverride(_)
        | Action::RapidOverride(_)
        | Action::SpindleOverride { .. }
        | Action::FeedHold(_) => None,
    });
    let texts = std::iter::once(&program.main).chain(program.files.values()).chain(by_hand);
    let mut unread: Vec<Calls> = texts.map(|text| calls(text)).collect();
    let mut looked_for = BTreeSet::new();
    while let Some(calls) = unread.pop() {
        let numbered = if calls.any_number { numbered_files(folder) } else { BTreeSet::new() };
        for sub in calls.subs.into_iter().chain(numbered) {
            let name = format!("{sub}.{EXTENSION}");
            if program.files.contains_key(&name) || !looked_for.insert(name.clone()) {
                continue;
            }
            let path = folder.join(&name);
            if !path.is_file() {
                continue;
            }
            match user_files::read_program(&path) {
                Ok(text) => {
                    unread.push(self::calls(&text));
                    program.files.insert(name, text);
                }
                Err(error) => {
                    write_error(&format!("note: {}; the file is left out", error.message));
                }
            }
        }
    }
}

/// Where the files of a program are.
pub(crate) fn paths(program: &Program, folder: &Path) -> impl Iterator<Item = PathBuf> {
    program.files.keys().map(|name| folder.join(name))
}

/// The folder of a program.
pub(crate) fn folder_of(file: &Path) -> &Path {
    file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Names, without the extension, of the files of a folder that are named by a number.
fn numbered_files(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let named = entries.filter_map(|entry| {
        let path = entry.path();
        let stem = path.file_stem()?.to_str()?.to_owned();
        let is_numbered = !stem.is_empty() && stem.bytes().all(|byte| byte.is_ascii_digit());
        (is_numbered && path.extension()? == EXTENSION).then_some(stem)
    });
    named.collect()
}

fn calls(text: &str) -> Calls {
    let mut calls = Calls::default();
    let mut defined = BTreeSet::new();
    for line in text.split(['\n', '\r']) {
        // Most lines of a part are moves.
        if !line.contains(['o', 'O', 'm', 'M']) {
            continue;
        }
        let code = code(line);
        let is_skipped = code.starts_with('/');
        let code = code.strip_prefix('/').unwrap_or(&code);
        let code = code
            .strip_prefix('n')
            .map_or(code, |rest| rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.'));
        match code.strip_prefix('o') {
            Some(o_word) => match (label(o_word), o_word) {
                (Some((label, "sub")), _) if !is_skipped => {
                    defined.insert(label);
                }
                (Some((label, rest)), _) if rest.starts_with("call") => {
                    if !defined.contains(&label) {
                        calls.subs.insert(label);
                    }
                }
                (None, o_word) => {
                    calls.any_number |= !o_word.starts_with('<') && o_word.contains("call");
                }
                (Some(_), _) => {}
            },
            None => m98(code, &mut calls),
        }
    }
    calls
}

/// The label of an o-word that is written plainly, and what follows it.
fn label(o_word: &str) -> Option<(String, &str)> {
    if let Some(named) = o_word.strip_prefix('<') {
        let (name, rest) = named.split_once('>')?;
        let leads_away = name.starts_with('.') || name.contains(['/', '\\']);
        return (!leads_away && !name.is_empty()).then(|| (name.to_owned(), rest));
    }
    let (number, rest) = leading_number(o_word)?;
    Some((number, rest))
}

/// A number without its leading zeros, and what follows it.
fn leading_number(text: &str) -> Option<(String, &str)> {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (digits, rest) = text.split_at(end);
    let number = digits.trim_start_matches('0');
    let number = if number.is_empty() && !digits.is_empty() { "0" } else { number };
    (!number.is_empty()).then(|| (number.to_owned(), rest))
}

/// Adds what M98 calls, if the block has it.
fn m98(code: &str, calls: &mut Calls) {
    let words = without_names(code);
    let is_m98 = |rest: &str| match leading_number(rest) {
        Some((number, rest)) => number == "98" && !rest.starts_with(|c| c == '.' && rest != "."),
        None => rest.starts_with(['[', '#']),
    };
    if !words.split('m').skip(1).any(is_m98) {
        return;
    }
    for rest in words.split('p').skip(1) {
        match leading_number(rest) {
            Some((number, _)) => {
                calls.subs.insert(number);
            }
            None => calls.any_number = true,
        }
    }
}

/// A line without comments and blanks, in lower case.
pub(crate) fn code(line: &str) -> String {
    let mut code = String::new();
    let mut in_comment = false;
    for c in line.chars() {
        match c {
            ')' if in_comment => in_comment = false,
            _ if in_comment => {}
            '(' => in_comment = true,
            ';' => break,
            c if c.is_whitespace() => {}
            c => code.push(c.to_ascii_lowercase()),
        }
    }
    code
}

/// The text without what is between `<` and `>`.
pub(crate) fn without_names(code: &str) -> String {
    let parts = code.split('<').enumerate();
    let outside = parts.map(|(index, part)| {
        if index == 0 { part } else { part.split_once('>').map_or("", |(_, rest)| rest) }
    });
    outside.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_are_found_in_each_form() {
        for (line, expected) in [
            ("o<Bore> call [1]", vec!["bore"]),
            ("N10 O0100 CALL", vec!["100"]),
            ("/o<a b>call", vec!["ab"]),
            ("g0 x1 m98 p20 l3", vec!["20"]),
            ("m 098 p007", vec!["7"]),
            ("o<../x> call", vec![]),
            ("(o<a> call) ; o<b> call", vec![]),
            ("o<a> if [1]", vec![]),
            ("m9 p98", vec![]),
            ("#<m98>=1 g4 p1", vec![]),
        ] {
            let found = calls(line);
            let names: Vec<_> = found.subs.iter().map(String::as_str).collect();
            assert_eq!((names, found.any_number), (expected, false), "{line}");
        }
    }

    #[test]
    fn computed_number_can_be_that_of_any_file() {
        for line in ["o[#1+1] call", "o#1 call [2]", "m98 p#1", "m98 p[2*3]", "m[90+8] p5"] {
            assert!(calls(line).any_number || calls(line).subs.contains("5"), "{line}");
        }
        assert!(!calls("g4 p#1").any_number);
    }

    #[test]
    fn sub_that_is_defined_before_its_call_needs_no_file() {
        let text = "o<a> sub\no<a> endsub\no<a> call\no<b> call\no<b> sub\no<b> endsub\n";
        assert_eq!(calls(text).subs, BTreeSet::from(["b".to_owned()]));
    }

    #[test]
    fn only_files_that_calls_reach_are_read() {
        let folder = std::env::temp_dir().join(format!("gaugeblock-called-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let write = |name: &str, bytes: &[u8]| {
            std::fs::write(folder.join(name), bytes).expect("a file for the test");
        };
        write("a.ngc", b"o<a> sub\no20 call\no<a> endsub\n");
        write("20.ngc", b"o20 sub\no20 endsub\n");
        write("b.ngc", b"o<b> sub\nm0\no<b> endsub\n");
        write("garbage.ngc", b"\x00\xff");
        let files = |main: &str| {
            let mut program = Program { main: main.to_owned(), ..Program::default() };
            add_called_files(&mut program, &folder, &[]);
            program.files.into_keys().collect::<Vec<_>>()
        };
        assert_eq!(files("o<a> call\nm2\n"), ["20.ngc", "a.ngc"]);
        assert_eq!(files("m98 p#1\nm2\n"), ["20.ngc"]);
        assert!(files("g0 x1 (o<b> call)\nm2\n").is_empty());
        assert!(files("o<garbage> call\nm2\n").is_empty());
        std::fs::remove_dir_all(&folder).expect("the folder goes away");
    }
}
