//! The command line: one clear message for each wrong call, and the exit status that the help promises.

mod common;

use std::path::{Path, PathBuf};

use common::gaugeblock;

/// A folder of its own for each test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn file(folder: &Path, name: &str, bytes: &[u8]) -> String {
    let path = folder.join(name);
    std::fs::write(&path, bytes).expect("a file for the test");
    path.to_str().expect("a path in UTF-8").to_owned()
}

/// Refused with this status, one message that has all of the words, a hint, and no backtrace.
#[track_caller]
fn refused(arguments: &[&str], status: i32, words: &[&str]) {
    let output = gaugeblock(arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {message}");
    for word in words {
        assert!(message.contains(word), "{arguments:?}: {word:?} is not in: {message}");
    }
    assert!(!message.contains("panicked") && !message.contains("RUST_BACKTRACE"), "{message}");
    assert!(output.stdout.is_empty(), "{}", String::from_utf8_lossy(&output.stdout));
}

#[test]
fn wrong_input_is_told_with_its_place() {
    let here = folder("wrong-input");
    let directory = here.to_str().expect("UTF-8");
    refused(&["run", "no-such-file.ngc"], 2, &["no-such-file.ngc", "hint:"]);
    refused(&["run", directory], 2, &["is a directory", "hint:"]);
    let binary = file(&here, "binary.ngc", b"g21\ng1 \xff\xfe x1\n");
    refused(&["run", &binary], 2, &["line 2", "hint:"]);
    let program = file(&here, "good.ngc", b"g21\nm2\n");
    refused(&["run", &program, "--edition", "linuxcnc-9"], 2, &["linuxcnc-9", "linuxcnc-2.8"]);
    refused(&["run", &program, "--option", "no.such=thing"], 2, &["no.such", "--choices"]);
    refused(
        &["run", &program, "--option", "saved-state.motion-mode=maybe"],
        2,
        &["maybe", "restored"],
    );
    refused(&["run", &program, "--iut", "mill"], 2, &["mill", "reference"]);
    let scenario = file(&here, "scenario.toml", b"[machine]\nspindels = 2\n");
    refused(&["run", &program, "--scenario", &scenario], 2, &["scenario.toml", "spindels"]);
    refused(&["certify", "reference", "--only", "no-such-rule"], 2, &["no-such-rule", "rules"]);
    let one_of_two = ["certify", "reference", "--only", "text", "--only", "no-such-rule"];
    refused(&one_of_two, 2, &["no-such-rule"]);
}

#[test]
fn options_and_files_of_a_scenario_count() {
    let here = folder("scenario-options");
    let program = file(&here, "main.ngc", b"g1 f100\nm70\ng0\nm72\no<elsewhere> call\nm2\n");
    let scenario = b"[options]\n\"saved-state.motion-mode\" = \"restored\"\n[program.files]\n\"elsewhere.ngc\" = \"o<elsewhere> sub\\n#<_seen>=1\\no<elsewhere> endsub\\n\"\n";
    let scenario = file(&here, "scenario.toml", scenario);
    let said = |more: &[&str]| {
        let arguments =
            [&["run", program.as_str(), "--scenario", scenario.as_str()], more].concat();
        String::from_utf8(gaugeblock(&arguments).stdout).expect("text")
    };
    let restored = said(&[]);
    assert!(restored.contains("block main.ngc:4\n  state motion=feed"), "{restored}");
    assert!(restored.contains("end program_end"), "{restored}");
    let called_otherwise = said(&["--option", "saved-state.motion-mode=not-restored"]);
    assert!(
        !called_otherwise.contains("block main.ngc:4\n  state motion=feed"),
        "{called_otherwise}"
    );
    let wrong = file(&here, "wrong.toml", b"[options]\n\"no.such\" = \"thing\"\n");
    refused(&["run", &program, "--scenario", &wrong], 2, &["no.such", "--choices"]);
}

#[test]
fn a_wrong_suite_is_told_with_its_page() {
    let here = folder("wrong-suite");
    std::fs::create_dir_all(here.join("feed")).expect("a folder for the test");
    file(&here.join("feed"), "odd.toml", b"id = \"feed.odd\"\nsentence = \"x\"\ncolour = 3\n");
    let path = here.to_str().expect("UTF-8");
    refused(&["--suite", path, "certify", "reference"], 2, &["feed/odd.toml", "colour", "hint:"]);
    refused(&["--suite", "no-such-folder", "rules"], 2, &["no-such-folder", "hint:"]);
}

#[test]
fn an_absent_controller_could_not_finish() {
    refused(&["certify", "rs274:/no/such/rs274"], 3, &["/no/such/rs274", "hint:"]);
    refused(&["certify", "exec:./no-such-adapter"], 3, &["no-such-adapter: not found", "hint:"]);
    refused(&["certify", "exec:"], 2, &["names no command", "hint:"]);
}

#[test]
fn production_is_held_to_no_quirks() {
    let observed = ["--edition", "rs274-2.9-observed"];
    for command in ["certify", "fingerprint"] {
        let call = [command, "production", observed[0], observed[1]];
        refused(&call, 2, &["no quirk of other controllers: rs274.", "hint:"]);
    }
}

#[test]
fn a_report_folder_that_cannot_be_written_is_told_before_anything_runs() {
    let here = folder("report");
    let blocked = file(&here, "a-file", b"");
    let inside = format!("{blocked}/report");
    refused(
        &["certify", "reference", "--only", "coolant", "--report", &inside],
        2,
        &["a-file", "--report"],
    );
}

#[test]
fn a_report_is_written_whole() {
    let here = folder("written").join("new");
    let path = here.to_str().expect("UTF-8");
    let output = gaugeblock(&["certify", "reference", "--only", "coolant", "--report", path]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |name: &str| std::fs::read_to_string(here.join(name)).expect("written");
    let report: serde_json::Value = serde_json::from_str(&read("report.json")).expect("JSON");
    assert_eq!(report["counts"]["diverges"], 0);
    assert!(read("junit.xml").contains("<testsuite "));
    assert!(!read("report.txt").contains('\u{1b}'), "no colours in a file");
}

#[test]
fn the_production_interpreter_is_certified_where_none_is_named() {
    let output = gaugeblock(&["certify", "--only", "coolant"]);
    assert_eq!(output.status.code(), Some(0));
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(report.starts_with("production "), "{report}");
}

#[test]
fn a_program_that_faults_is_an_answer() {
    let here = folder("faults");
    let program = file(&here, "fault.ngc", b"g21\nm72\nm2\n");
    let output = gaugeblock(&["run", &program]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("end fault kind=nothing_saved"), "{text}");
    let pointer = String::from_utf8_lossy(&output.stderr);
    assert!(pointer.contains("fault.ngc:2"), "{pointer}");
}

#[test]
fn a_run_is_the_same_each_time_in_both_forms() {
    let here = folder("twice");
    let program = file(
        &here,
        "program.ngc",
        b"g21 f100\no1 repeat [3]\ng91 g1 x[sin[30]] (print,x=#<_x>)\no1 endrepeat\nm2\n",
    );
    for format in ["text", "json"] {
        let once = || gaugeblock(&["run", &program, "--format", format]).stdout;
        assert_eq!(once(), once());
    }
    let json = gaugeblock(&["run", &program, "--format", "json"]).stdout;
    let outcome: gaugeblock_trace::Outcome = serde_json::from_slice(&json).expect("an outcome");
    let text = gaugeblock(&["run", &program]).stdout;
    assert_eq!(outcome.to_text().as_bytes(), text);
}

#[test]
fn each_command_has_help_with_examples() {
    for command in ["certify", "run", "rs274", "compare", "fingerprint", "rules", "schema"] {
        let output = gaugeblock(&[command, "--help"]);
        assert_eq!(output.status.code(), Some(0));
        assert!(String::from_utf8_lossy(&output.stdout).contains("Example"), "{command}");
    }
}

#[test]
fn a_parameter_file_is_written_back_and_kept() {
    let here = folder("parameter-file");
    let program = file(&here, "program.ngc", b"g20\n#31=[#31+1]\ng10 l2 p1 x2\nm2\n");
    let parameters = file(&here, "mill.var", b"31 4\n5220 1\n");
    let output = gaugeblock(&["rs274", "-g", "-v", &parameters, &program]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |name: &str| std::fs::read_to_string(here.join(name)).expect("written");
    let written = read("mill.var");
    assert!(written.starts_with("31\t5.000000\n5161\t0.000000\n"), "{written}");
    assert!(written.contains("\n5221\t2.000000\n"), "{written}");
    assert_eq!(read("mill.var.bak"), "31 4\n5220 1\n");
}

#[test]
fn what_rs274_would_load_is_refused() {
    let here = folder("rs274-refused");
    let program = file(&here, "program.ngc", b"m2\n");
    refused(&["rs274", "-p", "other.so", &program], 1, &["-p", "hint:"]);
    refused(&["rs274", "-g", "no-such-file.ngc"], 1, &["no-such-file.ngc", "hint:"]);
    refused(&["rs274", "-g", "-i", "no-such-file.ini", &program], 1, &["no-such-file.ini"]);
    let parameters = file(&here, "odd.var", b"5220 1\n31 4\n");
    refused(&["rs274", "-g", "-v", &parameters, &program], 1, &["31 is out of order"]);
}

#[test]
fn the_matrix_has_a_column_for_each_report() {
    let here = folder("matrix");
    let directory = here.to_str().expect("UTF-8");
    let arguments = ["certify", "reference", "--only", "coolant", "--report", directory];
    assert_eq!(gaugeblock(&arguments).status.code(), Some(0));
    let report = here.join("report.json");
    let report = report.to_str().expect("UTF-8");
    let output = gaugeblock(&["rules", "--matrix", "--judged", report]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{text}");
    let section = text.lines().find(|line| line.starts_with("M7, M8, M9")).expect("the section");
    // The model's column and the report's, both judged by more than acceptance.
    assert_eq!(section.matches(" haest").count(), 2, "{section}");
    let json = gaugeblock(&["rules", "--matrix", "--judged", report, "--format", "json"]).stdout;
    let json: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    assert_eq!(json["controllers"][0]["edition"], "linuxcnc-2.8");
    let other = file(&here, "other.json", b"{}");
    refused(&["rules", "--matrix", "--judged", &other], 2, &["other.json", "--report"]);
    refused(&["rules", "--judged", report], 2, &["--matrix"]);
}
