//! The way there and back on paper: what is exported tells nothing of what is expected, what comes back gets the
//! verdicts that the same controller gets directly, and what does not come back is no pass.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use gaugeblock_linuxcnc::Rs274;
use gaugeblock_offline::{ExportedProgram, Manifest};
use gaugeblock_suite::Suite;
use serde_json::Value;

use crate::command::gaugeblock;

/// Rules with programs that are refused, show messages, set variables and move.
const RULES: &str = "saved-state.s";
/// Rules; rs274 breaks some of them.
const OF_NUMBERS: &str = "numbers.";
/// Rules of motion.
const OF_MOTION: &str = "trajectory.";

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs the command, which ends with this status, and tells what it said on both streams.
#[track_caller]
fn ends_with(status: i32, arguments: &[&str]) -> String {
    let output = gaugeblock(arguments);
    let said = text(&output.stdout) + &text(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{said}");
    said
}

/// A campaign that was exported for this test.
fn campaign(name: &str, only: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("offline").join(name);
    let _none_yet = fs::remove_dir_all(&folder);
    let out = format!("{}/", path(&folder));
    let asked = ["--edition", "linuxcnc-2.9", "--only", only, "--out", &out];
    ends_with(0, &[&["offline", "export"], asked.as_slice()].concat());
    folder
}

fn path(folder: &Path) -> &str {
    folder.to_str().expect("UTF-8")
}

fn controller(folder: &Path) -> String {
    format!("offline:{}", path(folder))
}

fn manifest(folder: &Path) -> Manifest {
    Manifest::read(folder).unwrap_or_else(|error| panic!("{error}"))
}

/// Changes a file of the first program.
fn change(folder: &Path, file: &str, old: &str, new: &str) {
    change_in(&folder.join("0001"), file, old, new);
}

/// Changes a file in the folder of a program.
fn change_in(folder: &Path, file: &str, old: &str, new: &str) {
    let file = folder.join(file);
    let before = fs::read_to_string(&file).expect("a file of the campaign");
    assert!(before.contains(old), "{old:?} is not in {before}");
    fs::write(&file, before.replacen(old, new, 1)).expect("it can be written");
}

/// Says what the control is.
fn name_control(folder: &Path) {
    let control = "name = \"a mill\"\nversion = \"3\"\nresolution = 0.001\n";
    fs::write(folder.join("control.toml"), control).expect("it can be written");
}

/// What came of each case: the verdict, what was found, and why it was not judged, by rule and case.
fn verdicts(arguments: &[&str]) -> BTreeMap<(String, String), (String, Value)> {
    let output =
        gaugeblock(&[&["certify", "--format", "json", "--controller"], arguments].concat());
    let report: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {}", text(&output.stderr)));
    let cases = report["cases"].as_array().expect("cases").iter();
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let told = cases.map(|case| {
        let why = &case["why"];
        let why = if why["found"].is_null() { &why["reason"] } else { &why["found"] };
        ((word(&case["rule"]), word(&case["case"])), (word(&case["verdict"]), why.clone()))
    });
    told.collect()
}

fn count(verdicts: &BTreeMap<(String, String), (String, Value)>, word: &str) -> usize {
    verdicts.values().filter(|(verdict, _)| verdict == word).count()
}

/// Fills a campaign in from a controller, and holds what comes back to what the controller gets directly, shown no
/// more.
fn there_and_back(folder: &Path, name: &str, more: &[&str], (chapter, least): (&str, usize)) {
    ends_with(0, &[&["offline", "answer", path(folder), "--controller", name], more].concat());
    let paper = controller(folder);
    let back = verdicts(&[&paper, "--only", chapter]);
    let direct = verdicts(&[name, "--restrict-to", &paper, "--only", chapter]);
    let other = back.iter().find(|(case, verdict)| direct.get(*case) != Some(verdict));
    assert_eq!(other, None, "directly: {:?}", other.and_then(|(case, _)| direct.get(case)));
    assert_eq!(back.len(), direct.len());
    let asked: usize = manifest(folder).programs.iter().map(|asked| asked.cases).sum();
    let judged = count(&back, "pass") + count(&back, "side difference") + count(&back, "diverges");
    assert!(judged >= least, "{judged} of {asked} judged");
}

#[test]
fn production_gets_the_same_verdicts_on_paper() {
    let of_blocks = campaign("production-blocks", RULES);
    there_and_back(&campaign("production", RULES), "production", &[], (RULES, 20));
    there_and_back(&of_blocks, "production", &["--blocks"], (RULES, 10));
    there_and_back(&campaign("production-moves", OF_MOTION), "production", &[], (OF_MOTION, 10));
}

#[test]
fn rs274_gets_the_same_verdicts_on_paper() {
    if let Err(error) = Rs274::find(None) {
        eprintln!("left out: rs274 on paper ({error})");
        return;
    }
    let folder = campaign("rs274", OF_NUMBERS);
    there_and_back(&folder, "rs274", &[], (OF_NUMBERS, 40));
    let back = verdicts(&[&controller(&folder), "--only", OF_NUMBERS]);
    assert!(count(&back, "diverges") > 0, "none of its departures shows on paper");
}

#[test]
fn nothing_that_is_expected_is_exported() {
    let suite =
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite");
    let folder = campaign("blind", RULES);
    let mut names: Vec<&str> = Vec::new();
    for rule in suite.rules.iter().filter(|rule| rule.id.starts_with(RULES)) {
        names.extend([rule.id.as_str(), rule.sentence.as_str()]);
        let long = rule.case_names().filter(|name| name.len() > 12 && name.contains(' '));
        names.extend(long);
        names.extend(rule.cases.iter().flat_map(|case| &case.assertions).map(String::as_str));
    }
    names.retain(|name| *name != "accepted" && *name != "refused");
    names.sort_unstable();
    names.dedup();
    let whole = fs::read_to_string(folder.join("manifest.json")).expect("the manifest")
        + &fs::read_to_string(folder.join("README.md")).expect("the page");
    let blind = |page: &str, place: &str| {
        let told = names.iter().find(|name| page.contains(**name));
        assert_eq!(told, None, "in {place}");
    };
    blind(&whole, "the campaign's own pages");
    for asked in manifest(&folder).programs {
        let read = |file: &str| {
            fs::read_to_string(folder.join(&asked.folder).join(file)).expect("a file of it")
        };
        blind(&(read("operator.md") + &read("answer.toml") + &read("blocks.csv")), &asked.folder);
    }
}

#[test]
fn missing_sheet_is_not_run_and_empty_fields_are_not_judged() {
    let folder = campaign("partial", RULES);
    let paper = controller(&folder);
    ends_with(2, &["certify", "--controller", &paper]);
    name_control(&folder);
    let asked = manifest(&folder).programs;
    let none = verdicts(&[&paper, "--only", RULES]);
    assert_eq!((count(&none, "pass"), count(&none, "diverges")), (0, 0));
    let cases: usize = asked.iter().map(|asked| asked.cases).sum();
    // A case of another rule may have a program of these.
    let open = count(&none, "not run");
    assert!(open >= cases, "{open} of {cases}");
    let said = ends_with(3, &["certify", "--controller", &paper]);
    assert!(said.contains("0 of "), "{said}");
    // A program that is accepted and sets #31.
    let program = |asked: &ExportedProgram| {
        let file = folder.join(&asked.folder).join("main.ngc");
        fs::read_to_string(file).expect("the program")
    };
    let sets = "#<absolute> = #<_absolute>\ng91 f5";
    let asked = asked.iter().find(|asked| program(asked).contains(sets)).expect("the program");
    let sheet = folder.join(&asked.folder);
    // How it ended says nothing of what this rule demands.
    change_in(&sheet, "answer.toml", "ended = \"\"", "ended = \"program end\"");
    let one = verdicts(&[&paper, "--only", RULES]);
    assert_eq!((count(&one, "pass"), count(&one, "diverges")), (0, 0), "{one:?}");
    assert_eq!(count(&one, "not run"), open - asked.cases);
    // With its variable it is judged; a wrong one departs.
    change_in(&sheet, "answer.toml", "\"#31\" = \"\"", "\"#31\" = \"0.0004\"");
    let judged = verdicts(&[&paper, "--only", RULES]);
    let counted = ["pass", "diverges", "side difference"].map(|word| count(&judged, word));
    assert_eq!(counted.iter().sum::<usize>(), asked.cases, "{judged:?}");
    change_in(&sheet, "answer.toml", "\"#31\" = \"0.0004\"", "\"#31\" = 77");
    let wrong = verdicts(&[&paper, "--only", RULES]);
    assert_eq!(count(&wrong, "diverges") + count(&wrong, "side difference"), asked.cases);
}

#[test]
fn unreadable_answer_is_not_judged_and_reported_with_its_place() {
    for (name, old, new, words) in [
        ("form", "ended = \"\"", "ended = program end", "0001/answer.toml): line 12"),
        ("word", "ended = \"\"", "ended = \"fine\"", "\"fine\" is none of: program end, "),
        (
            "comma",
            "x = \"\"",
            "x = \"1,5\"",
            "[position] x: \"1,5\" is not a number (write a point",
        ),
        ("half", "x = \"\"", "x = 1", "[position] y is empty"),
        ("mode", "units = \"\"", "units = \"cm\"", "[modes] units: \"cm\" is not understood"),
        ("key", "ended = \"\"", "endet = \"alarm\"", "unknown field `endet`"),
        ("line", "line = \"\"", "line = \"four\"", "[alarm] line: \"four\" is not a line number"),
    ] {
        let folder = campaign(&format!("unreadable-{name}"), RULES);
        name_control(&folder);
        change(&folder, "answer.toml", old, new);
        if !new.contains("end") {
            change(&folder, "answer.toml", "ended = \"\"", "ended = \"alarm\"");
        }
        let said =
            ends_with(3, &["certify", "--controller", &controller(&folder), "--only", RULES]);
        assert!(said.contains(words), "{name}: {words} is not in\n{said}");
    }
}

#[test]
fn a_program_that_was_changed_is_not_judged() {
    let folder = campaign("changed", RULES);
    ends_with(0, &["offline", "answer", path(&folder), "--controller", "production"]);
    change(&folder, "main.ngc", "m2", "m30");
    let said = ends_with(3, &["certify", "--controller", &controller(&folder), "--only", RULES]);
    assert!(said.contains("0001/main.ngc): the program has changed since the export"), "{said}");
}

#[test]
fn sheets_of_another_suite_or_edition_are_refused() {
    let folder = campaign("other", RULES);
    name_control(&folder);
    let paper = controller(&folder);
    let said = ends_with(2, &["certify", "--controller", &paper, "--edition", "linuxcnc-2.8"]);
    assert!(said.contains("are for edition linuxcnc-2.9") && said.contains("hint:"), "{said}");
    let file = folder.join("manifest.json");
    let before = fs::read_to_string(&file).expect("the manifest");
    let suite = manifest(&folder).suite;
    fs::write(&file, before.replace(&suite, &"0".repeat(64))).expect("it can be written");
    for call in [
        vec!["certify", "--controller", &paper],
        vec!["offline", "answer", path(&folder), "--controller", "production"],
    ] {
        let said = ends_with(2, &call);
        assert!(said.contains("another suite") && said.contains("hint:"), "{said}");
    }
    fs::write(&file, before.replace("\"0001\"", "\"../0001\"")).expect("it can be written");
    assert!(
        ends_with(2, &["certify", "--controller", &paper])
            .contains("is not a valid folder of a program")
    );
    fs::remove_file(&file).expect("it can be removed");
    assert!(ends_with(2, &["certify", "--controller", &paper]).contains("manifest.json"));
}

#[test]
fn nothing_is_overwritten_and_nothing_half_written() {
    let folder = campaign("kept", RULES);
    let export = |more: &[&str]| ends_with(2, &[&["offline", "export"], more].concat());
    let said = export(&["--out", path(&folder)]);
    assert!(said.contains("is not empty") && said.contains("hint:"), "{said}");
    let new = folder.join("new");
    for (more, words) in [
        (["--profile", "no-such"], "unknown profile `no-such`"),
        (["--only", "no-such"], "invalid `--only no-such`"),
        (["--edition", "no-such"], "unknown edition `no-such`"),
        (["--edition", "nct-99m"], "another language"),
    ] {
        let said = export(&[&["--out", path(&new)], more.as_slice()].concat());
        assert!(said.contains(words) && said.contains("hint:"), "{said}");
        assert!(!new.exists());
    }
    // A sheet that is filled in stays as it is.
    change(&folder, "answer.toml", "not_possible = \"\"", "not_possible = \"no such machine\"");
    let said = ends_with(0, &["offline", "answer", path(&folder), "--controller", "production"]);
    assert!(said.contains("1 were filled in before"), "{said}");
    let sheet = fs::read_to_string(folder.join("0001/answer.toml")).expect("the sheet");
    assert!(sheet.contains("no such machine"), "{sheet}");
    let told = verdicts(&[&controller(&folder), "--only", RULES]);
    assert!(
        told.values().any(|(verdict, why)| verdict == "unsupported" && why == "no such machine")
    );
}

#[test]
fn filters_select_what_is_exported() {
    let count = |name: &str, only: &str| {
        let folder = campaign(name, only);
        let entries = fs::read_dir(folder).expect("the campaign").flatten();
        entries.filter(|entry| entry.path().join("main.ngc").exists()).count()
    };
    let all = count("filter-prefix", "dwell.seconds");
    assert!(all > 2, "{all} programs");
    assert_eq!(count("filter-pattern", "dwell.second?"), all);
    assert_eq!(count("filter-case", "dwell.seconds/a fraction"), 1);
}

#[test]
fn file_of_a_campaign_that_is_not_a_regular_file_is_refused() {
    let folder = campaign("fifo", RULES);
    let fifo = |name: &str| {
        let _not_there = fs::remove_file(folder.join(name));
        let mode = rustix::fs::Mode::from_raw_mode(0o600);
        let fifo = rustix::fs::FileType::Fifo;
        rustix::fs::mknodat(rustix::fs::CWD, folder.join(name), fifo, mode, 0).expect("a FIFO");
    };
    let answer = ["offline", "answer", path(&folder), "--controller", "production"];
    let certify = ["certify", "--controller", &controller(&folder), "--only", RULES];
    name_control(&folder);
    fifo("0001/answer.toml");
    let said = ends_with(3, &certify);
    assert!(said.contains("0001/answer.toml): it is not a regular file"), "{said}");
    let said = ends_with(2, &answer);
    assert!(said.contains("0001/answer.toml: it is not a regular file"), "{said}");
    fs::remove_file(folder.join("0001/answer.toml")).expect("it is removed");
    ends_with(0, &answer);
    fifo("0001/main.ngc");
    let said = ends_with(3, &certify);
    assert!(said.contains("0001/main.ngc): it is not a regular file"), "{said}");
    for name in ["control.toml", "manifest.json"] {
        fifo(name);
        let said = ends_with(2, &certify);
        assert!(said.contains(&format!("{name}: it is not a regular file")), "{said}");
    }
}

#[test]
fn name_of_the_control_is_requested_where_it_belongs() {
    let folder = campaign("unnamed", RULES);
    let said = ends_with(2, &["certify", "--controller", &controller(&folder)]);
    assert!(
        said.contains("`name` is empty") && said.contains("hint: complete control.toml"),
        "{said}"
    );
}
