//! What people who write programs see: `run`, `compare` and `shrink` of a program in a folder of others.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use gaugeblock_adapter::templates::PYTHON;
use gaugeblock_linuxcnc::Rs274;

/// An empty folder for each test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("programs").join(name);
    let _none_yet = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn write(folder: &Path, name: &str, text: impl AsRef<[u8]>) {
    std::fs::write(folder.join(name), text).expect("a file for the test");
}

/// Runs the command in a folder; a tilde is a blank within a word.
fn gaugeblock(folder: &Path, call: &str) -> Output {
    let words = call.split_whitespace().map(|word| word.replace('~', " "));
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaugeblock"));
    command.args(words).current_dir(folder).env("NO_COLOR", "1");
    command.output().expect("the command runs")
}

/// Asserts the status and that standard output and standard error have these parts; both of them.
#[track_caller]
fn says(folder: &Path, call: &str, status: i32, parts: &[&str]) -> String {
    let output = gaugeblock(folder, call);
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text).into_owned();
    assert_eq!(output.status.code(), Some(status), "{call}: {text}");
    for part in parts {
        assert!(text.contains(part), "{call}: {part:?} is not in: {text}");
    }
    text
}

/// Whether LinuxCNC's stand-alone interpreter is installed; where not, the test reports what it skips.
fn has_rs274(skipped: &str) -> bool {
    let found = Rs274::find(None);
    if let Err(error) = &found {
        // Written past the test runner, which keeps what passing tests print to itself.
        let notice = format!("left out: {skipped} ({error})\n");
        std::io::stderr().write_all(notice.as_bytes()).expect("standard error can be written");
    }
    found.is_ok()
}

/// A program, and neighbours that it does not call.
fn with_neighbours(name: &str) -> PathBuf {
    let here = folder(name);
    write(&here, "part.ngc", "g0 x1\nm2\n");
    write(&here, "pause.ngc", "o<pause> sub\nm60\no<pause> endsub\n");
    write(&here, "probe.ngc", "g38.2 z-1 f10\nm2\n");
    write(&here, "garbage.ngc", b"\x00\xff\xfe");
    write(&here, "long.ngc", "g0 x1 (o<pause> call)\n".repeat(20_000));
    here
}

#[test]
fn file_that_no_call_reaches_does_not_belong_to_a_program() {
    let here = with_neighbours("neighbours");
    write(&here, "adapter.py", PYTHON);
    for controller in ["reference", "production", "exec:python3~adapter.py"] {
        says(&here, &format!("run part.ngc --controller {controller}"), 0, &["end program_end"]);
    }
    says(&here, "shrink part.ngc --attempts 0", 1, &["do not differ"]);
}

#[test]
fn rs274_is_compared_next_to_other_programs() {
    if !has_rs274("a program next to others on rs274") {
        return;
    }
    let here = with_neighbours("neighbours-rs274");
    says(&here, "compare part.ngc --controller rs274", 0, &["part.ngc: no difference"]);
    write(&here, "calls.ngc", "o<pause> call\nm2\n");
    let refused = ["calls.ngc", "pauses do not pause (M60 at pause.ngc:2)"];
    says(&here, "compare calls.ngc --controller rs274", 3, &refused);
    says(&here, "shrink calls.ngc --controller rs274", 3, &refused);
}

#[test]
fn controller_has_its_own_edition_by_default() {
    if !has_rs274("a tool change under the edition of rs274") {
        return;
    }
    let here = folder("own-edition");
    write(&here, "part.ngc", "g21 g90\nt1 m6\ng0 x1\nm2\n");
    let call = "compare part.ngc --controller rs274";
    says(&here, call, 0, &["part.ngc:2: both refuse: T1, and the tool table holds no such tool"]);
    let choice =
        ["no difference that a quirk or a choice does not explain", "tool.empty-slot = refused"];
    says(&here, &format!("{call} --edition linuxcnc-2.8"), 0, &choice);
}

#[test]
fn machine_is_read_from_the_files_of_linuxcnc() {
    let here = folder("machine");
    write(&here, "part.ngc", "g21 g90\nt1 m6\ng43 h1\ng0 x1\nm2\n");
    write(&here, "tool.tbl", "; a comment\nT1 P1 Z25.4 D6 ; end mill\n");
    write(&here, "mill.var", "5221\t12.5\n");
    write(&here, "mill.ini", "[TRAJ]\nLINEAR_UNITS = mm\nCOORDINATES = X Y Z\n");
    let call = "run part.ngc --edition linuxcnc-2.9";
    says(&here, call, 0, &["end fault kind=tool_not_found"]);
    let text = says(&here, &format!("{call} -t tool.tbl"), 0, &["end program_end"]);
    assert!(text.contains("tool_offset=(x0 y0 z25.4 a0 b0 c0)"), "{text}");
    let files = "--tools tool.tbl --parameters mill.var --ini mill.ini";
    let text = says(&here, &format!("{call} {files}"), 0, &["end program_end"]);
    for part in ["g5x_offset=(x12.5 y0 z0)", "tool_offset=(x0 y0 z25.4)", "end=(x1 y0 z-25.4)"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn faulty_machine_file_is_refused_with_its_place() {
    let here = folder("faulty-machine");
    write(&here, "part.ngc", "m2\n");
    write(&here, "tool.tbl", "T1 P1\nT2 P2 K5\n");
    write(&here, "mill.var", "5221 1\n31 4\n");
    write(&here, "mill.ini", "[TRAJ]\nLINEAR_UNITS = cubit\n");
    for (option, parts) in [
        ("--tools tool.tbl", ["tool.tbl: line 2: `K5`", "hint: for example `T1"]),
        ("--parameters mill.var", ["mill.var: line 2: 31 is out of order", "hint:"]),
        ("--ini mill.ini", ["mill.ini: [TRAJ]LINEAR_UNITS is `cubit`", "hint:"]),
    ] {
        for command in ["run", "compare", "shrink"] {
            says(&here, &format!("{command} part.ngc {option}"), 2, &parts);
        }
    }
}

#[test]
fn metric_tool_table_is_converted_for_rs274() {
    if !has_rs274("a metric tool table on rs274") {
        return;
    }
    let here = folder("metric-tools");
    write(&here, "part.ngc", "g21 g90\nt1 m6\ng43 h1\ng0 x1 z5\nm2\n");
    write(&here, "reads.ngc", "t1 m6\ng0 x#5403\nm2\n");
    write(&here, "tool.tbl", "T1 P1 Z25.4 D6 ; end mill\n");
    write(&here, "mill.ini", "[TRAJ]\nCOORDINATES = XYZ\n");
    let with = "--controller rs274 --tools tool.tbl --ini mill.ini";
    let parts = ["part.ngc: no difference", "note: rs274 stores inches"];
    says(&here, &format!("compare part.ngc {with}"), 0, &parts);
    let parts = ["cannot be converted to inches", "#5403 at reads.ngc:2", "hint:"];
    says(&here, &format!("compare reads.ngc {with}"), 3, &parts);
}

#[test]
fn text_that_is_not_utf8_is_read_as_latin1_with_a_note() {
    let here = folder("latin1");
    write(&here, "part.ngc", b"g0 x1\n(caf\xe9)\nm2\n");
    let parts = ["note: part.ngc: not UTF-8: read as Latin-1", "end program_end"];
    says(&here, "run part.ngc", 0, &parts);
    says(&here, "compare part.ngc", 0, &["part.ngc: no difference", parts[0]]);
}

#[test]
fn hyphen_is_standard_input() {
    let here = folder("stdin");
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaugeblock"));
    command.args(["run", "-"]).current_dir(&here).env("NO_COLOR", "1");
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command runs");
    let mut input = child.stdin.take().expect("its input");
    input.write_all(b"g0 x1\nm72\nm2\n").expect("written");
    drop(input);
    let output = child.wait_with_output().expect("an end");
    let text = [output.stdout, output.stderr].concat();
    let text = String::from_utf8_lossy(&text);
    assert!(text.contains("block <stdin>:1  # g0 x1"), "{text}");
    assert!(text.contains("--> <stdin>:2"), "{text}");
    says(&here, "compare - -", 2, &["named twice", "hint:"]);
}

#[test]
fn run_prints_names_blocks_and_axes() {
    let here = folder("run");
    write(&here, "part.ngc", "g21 (metric)\no<hole> call\nm72\nm2\n");
    write(&here, "hole.ngc", "o<hole> sub\ng0 y40 z-1\no<hole> endsub\n");
    let text = says(&here, "run part.ngc", 0, &["-->"]);
    for part in [
        "block part.ngc:1  # g21 (metric)\n",
        "block hole.ngc:2  # g0 y40 z-1\n  do straight_traverse end=(x0 y40 z-1 a0 b0 c0)",
        "end fault kind=nothing_saved file=\"part.ngc\" line=3",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!text.contains("main.ngc"), "{text}");
}

#[test]
fn check_ends_with_a_status_for_scripts() {
    let here = folder("check");
    // On which side of one piece a distance is, the manual does not say.
    let one_piece = "o1 sub\ng1 x8 z0\nz-5\no1 endsub\ng18 f9 g0 x10 z1\ng70 q1 e1\nm2\n";
    for (name, program, status, parts) in [
        ("whole", "g0 x1\nm2\n", 0, ["end program_end", ""]),
        ("endless", "g0 x1\nm99\n", 0, ["end endless", ""]),
        ("refused", "m72\nm2\n", 1, ["--> refused.ngc:1", "error: "]),
        ("open", "g0 x1\n", 1, ["--> open.ngc:1", "the file ends without M2 or M30"]),
        ("pauses", "g0 x1\nm60\nm2\n", 1, ["note: pauses.ngc:2: the program pauses", "hint: add"]),
        ("turning", one_piece, 3, ["--> turning.ngc:6", "not specified"]),
    ] {
        write(&here, &format!("{name}.ngc"), program);
        says(&here, &format!("run {name}.ngc --check"), status, &parts);
        says(&here, &format!("run {name}.ngc"), 0, &parts);
    }
}

#[test]
fn main_program_that_m99_repeats_is_endless_in_its_tenth_turn() {
    let here = folder("endless");
    write(&here, "counts.ngc", "#31 = [#31 + 1]\nm99\n");
    write(&here, "ends.ngc", "#31 = [#31 + 1]\no1 if [#31 eq 10]\nm2\no1 endif\nm99\n");
    for controller in ["production", "reference"] {
        let text = says(&here, &format!("run counts.ngc -c {controller}"), 0, &["end endless"]);
        assert_eq!(text.matches("# m99").count(), 10, "{text}");
        says(&here, &format!("run ends.ngc -c {controller}"), 0, &["end program_end"]);
    }
}

#[test]
fn hint_of_a_pause_lets_the_program_go_on() {
    let here = folder("pause");
    write(&here, "part.ngc", "g0 x1\nm60\ng0 x2\nm2\n");
    let text = says(&here, "run part.ngc", 0, &["end paused"]);
    let line = text.lines().find_map(|line| line.split_once("--scenario: ")).expect("a hint").1;
    write(&here, "operator.toml", line);
    says(&here, "run part.ngc --check --scenario operator.toml", 0, &["end program_end"]);
}

#[test]
fn tool_that_the_table_does_not_have_is_remarked() {
    let here = folder("unknown-tool");
    write(&here, "part.ngc", "t99 m6\nm2\n");
    write(&here, "tool.tbl", "T99 P1 Z5\n");
    let remark = "note: part.ngc:1: tool 99 is not in the tool table";
    says(&here, "run part.ngc", 0, &[remark, "hint: --tools FILE"]);
    let text = says(&here, "run part.ngc --tools tool.tbl", 0, &[]);
    assert!(!text.contains("note:"), "{text}");
}

#[test]
fn types_of_the_source_are_in_no_message_about_a_file() {
    let here = folder("types");
    write(&here, "part.ngc", "m2\n");
    for (scenario, part) in [
        ("machine = 3\n", "expected a table"),
        ("[machine]\nspindles = \"a\"\n", "expected a whole number from 0 to 255"),
        ("[machine]\ntools = 3\n", "expected a list"),
        ("operator = [{ when = 3, action = \"resume\" }]\n", "expected a table"),
    ] {
        write(&here, "scenario.toml", scenario);
        let parts = ["scenario.toml: line", part, "hint:"];
        let text = says(&here, "run part.ngc --scenario scenario.toml", 2, &parts);
        for ours in ["struct", "u8", "sequence"] {
            assert!(!text.contains(ours), "{text}");
        }
    }
}

#[test]
fn file_that_holds_no_samples_is_refused_with_its_beginning() {
    let here = folder("no-samples");
    write(&here, "part.ngc", "g21 g90\nm2\n");
    write(&here, "mill.toml", "period = 0.001\n[axes]\nx = { velocity = 1, acceleration = 1 }\n");
    let call = "motion check part.ngc --program part.ngc --machine mill.toml";
    let parts = ["part.ngc: line 1: not a table of samples", "`g21 g90`", "gaugeblock samples 0"];
    says(&here, call, 2, &parts);
}

#[test]
fn compare_lists_each_difference_at_its_block() {
    let here = folder("differences");
    write(&here, "wrong.py", PYTHON.replace("{letter: number for", "{letter: number + 1 for"));
    write(&here, "part.ngc", "g21 f600\ng1 x1\ng1 x2\nm2\n");
    let call = "compare part.ngc --controller exec:python3~wrong.py";
    let text = says(&here, call, 1, &["part.ngc: 4 differences\n"]);
    for part in [
        "part.ngc:2: effect\n      | g1 x1\n",
        "part.ngc:2: position\n",
        "part.ngc:3: effect\n      | g1 x2\n",
        "  reference              straight_feed end=(x2)\n",
        "  exec:python3 wrong.py  straight_feed end=(x3)\n",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let output = gaugeblock(&here, &format!("{call} --format json"));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let file = &document["files"][0];
    assert_eq!(file["differences"].as_array().map(Vec::len), Some(4));
    assert_eq!((&file["block"]["file"], &file["block"]["line"]), (&"part.ngc".into(), &2.into()));
}

#[test]
fn two_refusals_of_a_block_are_no_difference_and_have_the_reason() {
    let here = folder("both-refuse");
    write(&here, "part.ngc", "g21\nm72\nm2\n");
    let parts = ["part.ngc:2: both refuse: nothing is saved at this call level"];
    says(&here, "compare part.ngc", 0, &parts);
}

#[test]
fn known_quirks_are_named_and_passed_over() {
    if !has_rs274("quirks of rs274 in a comparison") {
        return;
    }
    let here = folder("quirks");
    write(&here, "part.ngc", "g21 g90 g17 g94 g98 f100\ng81 x1 y1 z-1 r1\ng80\nm2\n");
    let text = says(
        &here,
        "compare part.ngc --controller rs274",
        0,
        &[
            "part.ngc: no difference that a quirk or a choice does not explain",
            "quirk rs274.cycle-exact-path, first at part.ngc:2\n    A canned cycle is executed in exact path mode.",
            "quirk rs274.feed-zero-at-end, first at part.ngc:4",
        ],
    );
    assert!(!text.contains("reference "), "{text}");
    let output = gaugeblock(&here, "compare part.ngc --controller rs274 --format json");
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let file = &document["files"][0];
    assert_eq!(file["equal"], false);
    assert_eq!(file["explained_by"][0]["id"], "rs274.cycle-exact-path");
}

#[test]
fn block_that_one_side_refuses_is_the_difference() {
    if !has_rs274("a block that only the reference refuses") {
        return;
    }
    let here = folder("one-refuses");
    write(&here, "part.ngc", "s100 $0\ns200 $1\nm3 $-1\nm5\nm2\n");
    write(&here, "mill.toml", "[machine]\nspindles = 2\n");
    let call = "compare part.ngc --scenario mill.toml --controller rs274 --edition linuxcnc-2.8";
    says(&here, call, 0, &["choice spindle.minus-one = all, first at part.ngc:3"]);
    let of_production = format!("{call} --against production");
    let text = says(&here, &of_production, 1, &["part.ngc:3: end\n      | m3 $-1\n"]);
    assert!(text.contains("production  refuses this block"), "{text}");
}

#[test]
fn system_variables_are_not_supported_and_not_refused() {
    let here = folder("system-variables");
    for (name, program, line) in [
        ("alarm.nct", "#3000=121 (text)\nM30\n", 1),
        ("read.nct", "O1\n#1=#4012\nM30\n", 2),
        ("many-digits.nct", "O1\n#[10000000000*10000000000]=1\nM30\n", 2),
    ] {
        write(&here, name, program);
        for controller in ["reference", "production"] {
            let end =
                format!("end unsupported file=\"{name}\" line={line} what=\"the system variable #");
            says(&here, &format!("run {name} --controller {controller}"), 0, &[&end]);
        }
    }
}

#[test]
fn rs274_is_known_around_m61() {
    if !has_rs274("programs with M61 on rs274") {
        return;
    }
    let here = folder("m61");
    write(&here, "mill.tbl", "T1 P1 Z0.5\nT2 P2 Z1.5\n");
    for (at, program) in [
        "m61 q1 g43\ng0 x1",
        "m61 q1\ng43\ng0 x1",
        "t1 m6\nm61 q2\ng43\ng0 x1",
        "t1 m6\nm61 q2 g43\ng0 x1",
        "t1 m6\nm61 q0 g43\ng0 x1",
        "t1 m6\nt2 m6 g43\ng0 x1",
        "t1 m6\nm61 q0\ng49\ng10 l0",
        "t1 m6\nm61 q2\ng10 l0",
        "m61 q2\ng10 l0",
        "t1 m6\nt0 m6\ng10 l0",
    ]
    .iter()
    .enumerate()
    {
        let name = format!("{at}.ngc");
        write(&here, &name, format!("g20 g90\n{program}\nm2\n"));
        let call = "-t mill.tbl --controller rs274 --edition rs274-2.9-observed";
        says(&here, &format!("compare {name} {call}"), 0, &[]);
    }
}
