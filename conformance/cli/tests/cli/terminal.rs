//! What `certify` selects and prints, and what a shell and `man` know of the command.

use std::path::Path;

use crate::command::gaugeblock;

/// A call whose controller has more than ten findings.
const DIVERGES: &[&str] =
    &["certify", "--controller", "rs274", "--only", "threading", "--only", "splines"];

fn printed(arguments: &[&str], status: i32) -> String {
    let output = gaugeblock(arguments);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {text}{message}");
    text
}

#[test]
fn filter_selects_by_section_pattern_and_case() {
    let list = |filter: &str| printed(&["certify", "--only", filter, "--list"], 0);
    let dwell = list("dwell.seconds");
    assert!(dwell.lines().all(|line| line.starts_with("dwell.seconds / ")), "{dwell}");
    assert_eq!(list("dwell.second?"), dwell);
    assert_eq!(list("dwell.seconds/*"), dwell);
    let first = dwell.lines().next().expect("a case");
    assert_eq!(list(first), format!("{first}\n"));
    let arcs = list("11.5.5");
    assert!(arcs.contains("arcs.radius / ") && !arcs.contains("dwell."), "{arcs}");
    let json = printed(&["certify", "--only", first, "--list", "--format", "json"], 0);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["cases"][0]["rule"], "dwell.seconds");
    for (filter, hint) in
        [("no-such", "`gaugeblock rules`"), ("dwell.seconds/no", "prints its cases")]
    {
        let output = gaugeblock(&["certify", "--only", filter]);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(filter) && message.contains(hint), "{message}");
    }
}

#[test]
fn terminal_has_the_worst_findings_all_or_the_verdict() {
    let worst = printed(DIVERGES, 1);
    let all = printed(&[DIVERGES, &["--all"]].concat(), 1);
    let quiet = printed(&[DIVERGES, &["--quiet"]].concat(), 1);
    let numbered = |text: &str, number: usize| {
        text.lines().any(|line| line.starts_with(&format!("{number}. ")))
    };
    assert!(numbered(&worst, 10) && !numbered(&worst, 11), "{worst}");
    assert!(worst.contains(" more findings: --all prints them"), "{worst}");
    assert!(numbered(&all, 11) && !all.contains("more findings"), "{all}");
    assert!(quiet.lines().count() <= 4 && all.ends_with(&quiet), "{quiet}");
}

#[test]
fn run_stops_after_some_divergences_and_says_so() {
    let text = printed(&[DIVERGES, &["--max-fail", "1", "-j", "1"]].concat(), 1);
    assert!(text.contains("note stopped by --max-fail: "), "{text}");
    assert!(text.contains("findings: 1, "), "{text}");
    let output = gaugeblock(&[DIVERGES, &["--max-fail", "1", "--report", "x"]].concat());
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn shell_and_manual_know_every_command() {
    let help = printed(&["--help"], 0);
    let commands: Vec<&str> = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .collect();
    assert!(commands.contains(&"certify"), "{help}");
    let script = printed(&["completions", "bash"], 0);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("manual");
    let _absent = std::fs::remove_dir_all(&folder);
    printed(&["man", folder.to_str().expect("UTF-8")], 0);
    for command in commands {
        assert!(script.contains(command), "{command}");
        let page = std::fs::read_to_string(folder.join(format!("gaugeblock-{command}.1")));
        assert!(page.expect("a page").contains(".TH"), "{command}");
    }
}

#[test]
fn colours_are_as_the_call_says() {
    let certify = ["certify", "--only", "coolant.flood", "--color"];
    let always = printed(&[&certify[..], &["always"]].concat(), 0);
    let never = printed(&[&certify[..], &["never"]].concat(), 0);
    assert!(always.contains('\x1b') && !never.contains('\x1b'), "{always}{never}");
}
