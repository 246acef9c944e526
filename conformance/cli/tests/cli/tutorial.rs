//! The tutorial is true: its files are written, its commands are run as they stand, and what they print is what it
//! says.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const PAGE: &str = include_str!("../../../../docs/tutorial.md");

/// A fenced block of the page.
#[derive(Debug)]
enum Block<'a> {
    /// A file of this name.
    File(&'a str, &'a str),
    /// Commands of a shell.
    Shell(&'a str),
    /// What the commands before it print.
    Printed(&'a str),
}

fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut rest = page;
    while let Some((_, begun)) = rest.split_once("\n```") {
        let (info, body) = begun.split_once('\n').expect("a block has a first line");
        let end = body.find("```\n").expect("a block has an end");
        let text = &body[..end];
        blocks.push(match info.split_once(' ') {
            Some((_, name)) => Block::File(name, text),
            None if info == "sh" => Block::Shell(text),
            None => Block::Printed(text),
        });
        rest = &body[end + 3..];
    }
    blocks
}

/// A folder of its own, anew.
fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tutorial");
    let _fresh = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// Runs commands with ours on the path; what they print, errors too.
fn run(commands: &str, folder: &Path) -> String {
    let ours = Path::new(env!("CARGO_BIN_EXE_gaugeblock")).parent().expect("its folder").to_owned();
    let others = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(ours).chain(std::env::split_paths(&others)));
    let output = Command::new("sh")
        .args(["-c", &format!("exec 2>&1\n{commands}")])
        .current_dir(folder)
        .env("PATH", path.expect("a path"))
        .env("NO_COLOR", "1")
        .env("LC_ALL", "C")
        .stdin(Stdio::null())
        .output()
        .expect("a shell");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Whether the page's lines are these: a line `…` stands for any number of lines, and within a line for any text.
fn is_told(told: &[&str], printed: &[&str]) -> bool {
    match (told, printed) {
        ([], []) => true,
        (["…"], _) => true,
        (["…", rest @ ..], _) => (0..=printed.len()).any(|skip| is_told(rest, &printed[skip..])),
        ([line, rest @ ..], [first, others @ ..]) => is_line(line, first) && is_told(rest, others),
        _ => false,
    }
}

fn is_line(told: &str, printed: &str) -> bool {
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let (told, printed) = (words(told), words(printed));
    let mut parts = told.split('…');
    let Some(mut rest) = parts.next().and_then(|first| printed.strip_prefix(first)) else {
        return false;
    };
    let mut parts: Vec<_> = parts.collect();
    let Some(last) = parts.pop() else { return rest.is_empty() };
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[test]
fn the_tutorial_is_true() {
    let folder = folder();
    let mut printed = None;
    let mut compared = 0;
    for block in blocks(PAGE) {
        match block {
            Block::File(name, text) => {
                std::fs::write(folder.join(name), text).expect("a file of the page");
            }
            Block::Shell(commands) => printed = Some((commands, run(commands, &folder))),
            Block::Printed(told) => {
                let (commands, printed) = printed.take().expect("commands stand before it");
                let lines = |text| str::lines(text).map(str::trim_end).collect::<Vec<_>>();
                let holds = is_told(&lines(told), &lines(&printed));
                assert!(holds, "{commands}prints:\n{printed}\nand the page says:\n{told}");
                compared += 1;
            }
        }
    }
    assert!(compared >= 8, "{compared} outputs");
}

#[test]
fn what_is_left_out_is_all_that_may_differ() {
    for (told, printed, holds) in [
        ("a\n…\nz", "a\nz", true),
        ("a\n…\nz", "a\nb\nc\nz", true),
        ("a\n…\nz", "a\nb", false),
        ("a\n…", "a", true),
        ("a", "a\nb", false),
        ("… cases: … pass, 0 diverge", "31 cases: 7 pass, 0 diverge", true),
        ("… cases: … pass, 0 diverge", "31 cases: 7 pass, 10 diverge", false),
        ("modal-groups  …  1  …", "modal-groups    38   6   1   31", true),
    ] {
        let lines = |text| str::lines(text).collect::<Vec<_>>();
        assert_eq!(is_told(&lines(told), &lines(printed)), holds, "{told:?} {printed:?}");
    }
}
