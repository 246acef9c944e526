//! The command line: one clear message for each wrong call, and the exit status that the help promises.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::command::gaugeblock;

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

/// Asserts this status, one message that has all of the words, a hint, and no backtrace.
#[track_caller]
pub(crate) fn refused(arguments: &[&str], status: i32, words: &[&str]) {
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
fn invalid_input_is_reported_with_its_place() {
    let here = folder("wrong-input");
    let directory = here.to_str().expect("UTF-8");
    refused(&["run", "no-such-file.ngc"], 2, &["no-such-file.ngc", "hint:"]);
    refused(&["run", directory], 2, &["is a directory", "hint:"]);
    let binary = file(&here, "binary.ngc", b"g21\ng1 \0\xff\xfe x1\n");
    refused(&["run", &binary], 2, &["line 2", "hint:"]);
    let program = file(&here, "good.ngc", b"g21\nm2\n");
    refused(&["run", &program, "--edition", "linuxcnc-9"], 2, &["linuxcnc-9", "linuxcnc-2.8"]);
    refused(&["run", &program, "--option", "no.such=thing"], 2, &["no.such", "gaugeblock choices"]);
    refused(
        &["run", &program, "--option", "saved-state.motion-mode=maybe"],
        2,
        &["maybe", "restored"],
    );
    refused(&["run", &program, "--controller", "mill"], 2, &["mill", "reference"]);
    let scenario = file(&here, "scenario.toml", b"[machine]\nspindels = 2\n");
    refused(&["run", &program, "--scenario", &scenario], 2, &["scenario.toml: line 2", "spindels"]);
    let procedures = file(&here, "post.gpp", b"START:\n");
    file(&here, "post.toolpath", b"system X_CURPOS change COORDINATES\nblock START: Y=1\n");
    let output = gaugeblock(&["run", &procedures]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains("post.toolpath:2:"), "{told}");
    refused(
        &["certify", "--controller", "reference", "--only", "no-such-rule"],
        2,
        &["no-such-rule", "rules"],
    );
    let one_of_two =
        ["certify", "--controller", "reference", "--only", "text", "--only", "no-such-rule"];
    refused(&one_of_two, 2, &["no-such-rule"]);
}

#[test]
fn rs274_writes_over_nothing_that_it_reads() {
    let here = folder("rs274-over");
    let program = file(&here, "part.ngc", b"g0 x1\nm2\n");
    let table = file(&here, "tools.tbl", b"T1 P1 Z1\n");
    let linked = here.join("linked.txt");
    let _there_already = std::fs::hard_link(&program, &linked);
    let linked = linked.to_str().expect("UTF-8");
    for call in [
        ["-t", &table, &program, &program],
        ["-t", &table, &program, linked],
        ["-t", &table, &program, &table],
        ["-t", &table, "-v", &program],
    ] {
        let words = [["rs274", "-g"].as_slice(), &call].concat();
        let words = if call[2] == "-v" { [words.as_slice(), &[&program]].concat() } else { words };
        refused(&words, 1, &["would be written over"]);
    }
    assert_eq!(std::fs::read(&program).expect("a file"), b"g0 x1\nm2\n");
    assert_eq!(std::fs::read(&table).expect("a file"), b"T1 P1 Z1\n");
}

#[test]
fn claimed_profile_without_a_rule_in_the_edition_is_refused() {
    let call = ["certify", "--edition", "linuxcnc-2.8", "--only", "feed", "--profile", "gpp"];
    refused(&call, 2, &["no rule of profile gpp is in edition linuxcnc-2.8", "hint:"]);
}

#[test]
fn folder_without_editions_is_not_a_suite() {
    let here = folder("no-suite");
    file(&here, "page.toml", b"not = a page");
    let here = here.to_str().expect("UTF-8");
    refused(&["certify", "--suite", here], 2, &["is not a suite: it has no editions.toml"]);
}

#[test]
fn hint_names_the_role_of_a_missing_file() {
    let here = folder("absent");
    let program = file(&here, "good.ngc", b"g21\nm2\n");
    let absent = |arguments: &[&str], role: &str| {
        refused(arguments, 2, &["nofile", &format!("hint: check the path of the {role}\n")]);
    };
    absent(&["run", "nofile.ngc"], "program");
    absent(&["rs274", "-g", "nofile.ngc"], "program");
    absent(&["rs274", "-g", "-t", "nofile.tbl", &program], "tool table (-t)");
    absent(&["run", &program, "--tools", "nofile.tbl"], "tool table (--tools)");
    absent(&["run", &program, "--parameters", "nofile.var"], "parameter file (--parameters)");
    absent(&["certify", "--waivers", "nofile.toml"], "file of waivers (--waivers)");
    absent(&["run", &program, "--scenario", "nofile.toml"], "scenario (--scenario)");
    absent(&["fuzz", "--known", "nofile"], "earlier report (--known)");
    absent(&["fuzz", "--options", "from:nofile"], "fingerprint (--options)");
    absent(&["suite", "matrix", "--report", "nofile"], "report (--report)");
}

/// Runs the command where no file may be longer than some blocks, as on a disk that is nearly full.
fn limited(folder: &Path, blocks: u32, arguments: &[&str], into: Stdio) -> Output {
    // Whoever writes more is told, not killed.
    let limit = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    let mut shell = Command::new("sh");
    shell.args(["-c", &limit, env!("CARGO_BIN_EXE_gaugeblock")]).args(arguments);
    shell.current_dir(folder).stdout(into).output().expect("a shell")
}

#[test]
fn cut_off_output_is_reported() {
    let here = folder("full");
    let program = file(&here, "program.ngc", b"g21\nm2\n");
    let calls: &[&[&str]] = &[
        &["--help"],
        &["rules"],
        &["schema", "report"],
        &["adapter", "protocol"],
        &["run", &program],
        &["serve", "--tcp", "0"],
        &["certify", "--controller", "reference", "--only", "coolant"],
        &["certify", "--controller", "reference", "--only", "coolant", "--format", "json"],
    ];
    for arguments in calls {
        let out = std::fs::File::create(here.join("out")).expect("a file for the test");
        let output = limited(&here, 0, arguments, out.into());
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{arguments:?}: {message}");
        assert!(message.contains("error: standard output: "), "{arguments:?}: {message}");
        assert!(message.contains("hint: "), "{arguments:?}: {message}");
    }
}

#[test]
fn closed_reader_is_not_an_error() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaugeblock"));
    let piped = command.arg("rules").stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = piped.spawn().expect("the command runs");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("it ends");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), &*message), (Some(0), ""));
}

#[test]
fn nothing_stays_of_a_file_that_cannot_be_written() {
    let here = folder("cut-off");
    let names = || {
        let entries = std::fs::read_dir(&here).expect("a folder");
        entries.map(|entry| entry.expect("an entry").file_name()).collect::<Vec<_>>()
    };
    let output = limited(&here, 4, &["adapter", "new", "adapter.py"], Stdio::piped());
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(message.contains("adapter.py: "), "{message}");
    assert!(names().is_empty(), "{:?}", names());

    let directory = folder("cut-off/directory");
    let directory = directory.to_str().expect("UTF-8");
    let call = [
        "certify",
        "--controller",
        "reference",
        "--only",
        "coolant",
        "--write-expectations",
        directory,
    ];
    refused(&call, 2, &["directory: ", "hint:"]);
    assert_eq!(names(), ["directory"]);
    std::fs::remove_dir(directory).expect("for the next time");
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
    assert!(restored.contains("block main.ngc:4  # m72\n  state motion=feed"), "{restored}");
    assert!(restored.contains("end program_end"), "{restored}");
    let called_otherwise = said(&["--option", "saved-state.motion-mode=not-restored"]);
    assert!(
        !called_otherwise.contains("block main.ngc:4  # m72\n  state motion=feed"),
        "{called_otherwise}"
    );
    let wrong = file(&here, "wrong.toml", b"[options]\n\"no.such\" = \"thing\"\n");
    refused(&["run", &program, "--scenario", &wrong], 2, &["no.such", "gaugeblock choices"]);
}

#[test]
fn faulty_suite_is_reported_with_its_page() {
    let here = folder("wrong-suite");
    std::fs::create_dir_all(here.join("feed")).expect("a folder for the test");
    file(&here, "editions.toml", b"");
    file(&here.join("feed"), "odd.toml", b"id = \"feed.odd\"\nsentence = \"x\"\ncolour = 3\n");
    let path = here.to_str().expect("UTF-8");
    refused(
        &["--suite", path, "certify", "--controller", "reference"],
        2,
        &["feed/odd.toml", "colour", "hint:"],
    );
    refused(&["--suite", "no-such-folder", "rules"], 2, &["no-such-folder", "hint:"]);
}

/// A ledger says of each sentence who carries it: a page that is deleted carries none.
#[test]
fn ledger_with_unknown_page_is_reported_with_its_line() {
    let here = folder("deleted-page");
    let suite = Path::new(env!("CARGO_MANIFEST_DIR")).join("../suite");
    let gone = "coolant/off.toml";
    for (path, text) in gaugeblock_suite::files::of_folder(&suite).expect("the suite") {
        let file = here.join(&path);
        std::fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        let _absent = std::fs::remove_file(&file);
        if path != gone {
            std::fs::write(&file, text).expect("a page");
        }
    }
    let output = gaugeblock(&["--suite", here.to_str().expect("UTF-8"), "suite", "check"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    let unknown = said.lines().filter(|line| line.ends_with(": unknown rule `coolant.off`"));
    let unknown: Vec<_> = unknown.collect();
    assert!(!unknown.is_empty(), "{said}");
    for line in unknown {
        let mut place = line.splitn(3, ':');
        let document = place.next().expect("a file");
        let number: usize = place.next().and_then(|line| line.parse().ok()).expect("a line");
        let ledger = std::fs::read_to_string(suite.join(document)).expect(document);
        let named = ledger.lines().nth(number - 1).expect("the line");
        assert!(named.contains("\"coolant.off\""), "{line}: {named}");
    }
}

#[test]
fn a_day_that_is_none_is_a_wrong_call() {
    let call = ["certify", "--controller", "reference", "--only", "coolant"];
    refused(&[&call[..], &["--today", "2026-02-30"]].concat(), 2, &["2026-02-30", "is not a day"]);
    let waiver = b"[[waiver]]\nrule = \"coolant.off\"\nreason = \"a\"\nowner = \"b\"\nexpires = \"2027-02-31\"\n";
    let waivers = file(&folder("no-day"), "waivers.toml", waiver);
    let words = ["waivers.toml", "2027-02-31", "is not a day", "hint:"];
    refused(&[&call[..], &["--waivers", &waivers]].concat(), 2, &words);
}

#[test]
fn an_absent_controller_could_not_finish() {
    refused(&["certify", "--controller", "rs274:/no/such/rs274"], 3, &["/no/such/rs274", "hint:"]);
    refused(
        &["certify", "--controller", "exec:./no-such-adapter"],
        3,
        &["cannot be started: ./no-such-adapter: not found", "hint: check the path"],
    );
    refused(&["certify", "--controller", "exec:"], 2, &["missing command", "hint:"]);
}

#[test]
fn production_accepts_no_quirks() {
    let observed = ["--edition", "rs274-2.9-observed"];
    for command in ["certify", "fingerprint"] {
        let call = [command, "--controller", "production", observed[0], observed[1]];
        refused(&call, 2, &["no quirk of other controllers: rs274.", "hint:"]);
    }
}

#[test]
fn unwritable_report_folder_is_refused_before_any_run() {
    let here = folder("report");
    let blocked = file(&here, "a-file", b"");
    let inside = format!("{blocked}/report");
    refused(
        &["certify", "--controller", "reference", "--only", "coolant", "--report", &inside],
        2,
        &["a-file", "--report"],
    );
}

#[test]
fn a_report_is_written_whole() {
    let here = folder("written").join("new");
    let path = here.to_str().expect("UTF-8");
    let output = gaugeblock(&[
        "certify",
        "--controller",
        "reference",
        "--only",
        "coolant",
        "--report",
        path,
    ]);
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
    let outcome: gaugeblock_vocabulary::Outcome =
        serde_json::from_slice(&json).expect("an outcome");
    assert_eq!(outcome.steps[0].block.file, "program.ngc");
}

#[test]
fn each_command_has_help_with_examples() {
    let commands = [
        "adapter",
        "adapter check",
        "certify",
        "choices",
        "compare",
        "explain",
        "fingerprint",
        "fuzz",
        "measure",
        "motion check",
        "motion fuzz",
        "offline",
        "offline answer",
        "offline export",
        "plan",
        "report merge",
        "rs274",
        "rules",
        "run",
        "schema",
        "serve",
        "shrink",
        "suite",
    ];
    for command in commands {
        let call: Vec<&str> = command.split(' ').chain(["--help"]).collect();
        let output = gaugeblock(&call);
        assert_eq!(output.status.code(), Some(0), "{command}");
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
    refused(&["rs274", "-g", "no-such-file.ngc"], 2, &["no-such-file.ngc", "hint:"]);
    refused(&["rs274", "-g", "-i", "no-such-file.ini", &program], 2, &["no-such-file.ini"]);
    let parameters = file(&here, "odd.var", b"5220 1\n31 4\n");
    refused(&["rs274", "-g", "-v", &parameters, &program], 1, &["31 is out of order"]);
}

#[test]
fn the_matrix_has_a_column_for_each_report() {
    let here = folder("matrix");
    let directory = here.to_str().expect("UTF-8");
    let arguments =
        ["certify", "--controller", "reference", "--only", "coolant", "--report", directory];
    assert_eq!(gaugeblock(&arguments).status.code(), Some(0));
    let report = here.join("report.json");
    let report = report.to_str().expect("UTF-8");
    let output = gaugeblock(&["suite", "matrix", "--document", "linuxcnc-2.8", "--report", report]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{text}");
    let section = text.lines().find(|line| line.starts_with("M7, M8, M9")).expect("the section");
    // The model's column and the report's, both judged by more than acceptance.
    assert_eq!(section.matches(" haest").count(), 2, "{section}");
    let json = ["suite", "matrix", "--document", "gpp2", "--report", report, "--format", "json"];
    let json = gaugeblock(&json).stdout;
    let json: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    assert_eq!(json["controllers"][0]["edition"], "linuxcnc-2.8");
    refused(&["suite", "matrix", "--document", "no-such"], 2, &["no-such", "linuxcnc-2.8"]);
    let other = file(&here, "other.json", b"{}");
    refused(&["suite", "matrix", "--report", &other], 2, &["other.json", "--report"]);
}

#[test]
fn a_misspelt_controller_gets_a_suggestion() {
    refused(
        &["certify", "--controller", "rs27"],
        2,
        &["unknown controller", "did you mean `rs274`?"],
    );
}

#[test]
fn a_prefix_selects_choices() {
    let output = gaugeblock(&["choices", "saved-state."]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("saved-state.motion-mode"), "{text}");
    assert!(!text.contains("abort."), "{text}");
    refused(&["choices", "no-such."], 2, &["no choice or quirk", "hint:"]);
}
