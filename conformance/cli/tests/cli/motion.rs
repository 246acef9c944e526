//! `gaugeblock plan` and `gaugeblock motion check`: samples of our planner keep the laws, violations are found, and
//! usage errors are reported.

use std::fs::Permissions;
use std::os::unix::fs::{FileTypeExt as _, PermissionsExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use gaugeblock_adapter::Adapter;
use gaugeblock_controllers::Production;
use gaugeblock_controllers::simulate::{RunConditions, plan_with};
use gaugeblock_vocabulary::Scenario;
use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript};
use rustix::fs::{CWD, FileType, Mode};

use crate::template::TEMPLATE;

/// A mill with three axes of 250 mm/s and 2000 mm/s².
const MILL: &str = "period = 0.001
[axes]
x = { velocity = 250, acceleration = 2000 }
y = { velocity = 250, acceleration = 2000 }
z = { velocity = 250, acceleration = 2000 }
";

/// Corners, an arc, a helix, a dwell, outputs, an offset, in inches and at rapid speed.
const PART: &str = "g21 g90 g17 g64 p0.05 f6000
g10 l2 p1 x1 y-2 z3 r30
g54 g0 x5 y5
g1 x10 y0
m62 p0
x20 y10
g3 x10 y20 i-10 j0
g4 p0.05
m65 p0
g2 x10 y20 z-5 i3 j0 p2
g61.1 g1 x0 y0
g20 g64 x1 f100
g43.1 z0.5
z0
m2
";

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    std::fs::write(folder.join("mill.toml"), MILL).expect("a file for the test");
    std::fs::write(folder.join("part.ngc"), PART).expect("a file for the test");
    folder
}

fn gaugeblock(folder: &Path, arguments: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
        .args(arguments.split_whitespace())
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .output()
        .expect("the command runs")
}

#[track_caller]
fn says(output: &Output, status: i32, words: &[&str]) {
    let text = String::from_utf8_lossy(&output.stdout).into_owned()
        + &String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{text}");
    for word in words {
        assert!(text.contains(word), "{word:?} is not in: {text}");
    }
}

#[test]
fn long_rest_between_segments_is_not_endless() {
    let folder = folder("nowhere");
    let part = format!("g21 g90 g94 g64 p0.01 f600\ng1 x1\n{}m2\n", "g1 x1\n".repeat(300));
    std::fs::write(folder.join("part.ngc"), part).expect("a file for the test");
    let output = gaugeblock(&folder, "plan part.ngc --machine mill.toml --feed-interval 80");
    says(&output, 0, &["holds       trajectory.order"]);
}

#[test]
fn a_planned_program_keeps_the_laws_however_it_is_fed() {
    let folder = folder("planned");
    for every in ["", "--feed-interval 1", "--feed-interval 31", "--feed-interval 80"] {
        let planned = gaugeblock(&folder, &format!("plan part.ngc --machine mill.toml {every}"));
        says(&planned, 0, &["holds       trajectory.acceleration", "holds       trajectory.ends"]);
        says(&planned, 0, &["holds       trajectory.outputs", "holds       trajectory.dwell"]);
    }
}

#[test]
fn an_operator_is_played_from_a_script() {
    let folder = folder("operated");
    let held = "events = [
  { cycle = 200, action = { hold = true } },
  { cycle = 500, action = { hold = false } },
  { cycle = 700, action = { feed_override = 0.5 } },
]\n";
    std::fs::write(folder.join("held.toml"), held).expect("a file");
    let aborted = "events = [{ cycle = 300, action = \"abort\" }]\n";
    std::fs::write(folder.join("aborted.toml"), aborted).expect("a file");
    let never = "events = [{ cycle = 300, action = { hold = true } }]\n";
    std::fs::write(folder.join("never.toml"), never).expect("a file");
    let plan = |script: &str| {
        gaugeblock(&folder, &format!("plan part.ngc --machine mill.toml --script {script}"))
    };
    says(&plan("held.toml"), 0, &["holds       trajectory.hold", "holds       trajectory.feed"]);
    says(&plan("aborted.toml"), 0, &["holds       trajectory.abort"]);
    says(&plan("never.toml"), 3, &["no event resumes it"]);
    says(&plan("mill.toml"), 2, &["mill.toml"]);
}

#[test]
fn requested_feed_includes_overrides() {
    let mut scenario = Scenario::default();
    "g21 g90 g94 g64 p0.01 f3000\nm52 p1\ng1 x100\nm2\n".clone_into(&mut scenario.program.main);
    let script = "events = [
  { cycle = 300, action = { feed_override = 1.5 } },
  { cycle = 600, action = { adaptive_feed = -1.0 } },
  { cycle = 900, action = { adaptive_feed = 1.0 } },
  { cycle = 1200, action = { hold = true } },
  { cycle = 1500, action = { hold = false } },
]\n";
    let script = MotionScript::from_text(script).expect("a script");
    let outcome = Production::default().run(&scenario).expect("a run");
    let circumstances = RunConditions { script, ..RunConditions::default() };
    let limits = MotionLimits::from_text(MILL).expect("limits");
    let planned = plan_with(&outcome, &limits, &circumstances).expect("a motion");
    for (cycle, speed) in [(250, 50.0), (550, 75.0), (850, 75.0), (1150, 75.0), (1450, 0.0)] {
        assert!(
            (planned.requested[cycle] - speed).abs() < 1e-9,
            "{cycle}: {}",
            planned.requested[cycle]
        );
        assert!((planned.speed[cycle] - speed).abs() < 1e-9, "{cycle}: {}", planned.speed[cycle]);
    }
}

#[test]
fn random_motions_keep_the_laws() {
    let folder = folder("random");
    let call = "motion fuzz --seed 4 --first 2100 --programs 40 --jobs 2 --report fuzzed";
    let fuzzed = gaugeblock(&folder, call);
    says(&fuzzed, 0, &["40 programs", "0 kinds of violations"]);
    let report = std::fs::read(folder.join("fuzzed/report.txt")).expect("a report");
    assert_eq!(report, fuzzed.stdout);
}

#[test]
fn no_random_motions_show_nothing() {
    let folder = folder("none");
    let none = gaugeblock(&folder, "motion fuzz --programs 0");
    says(&none, 3, &["0 programs", "nothing was judged"]);
    // The folder is tried first.
    let unwritable = gaugeblock(&folder, "motion fuzz --programs 0 --report part.ngc/report");
    says(&unwritable, 2, &["part.ngc/report", "hint: --report"]);
    assert!(unwritable.stdout.is_empty());
}

#[test]
fn inputs_are_never_overwritten() {
    let folder = folder("over");
    let script = "events = []\n";
    std::fs::write(folder.join("script.toml"), script).expect("a file");
    std::fs::write(folder.join("sub.ngc"), "o<sub> sub\no<sub> endsub\n").expect("a file");
    std::fs::write(folder.join("calls.ngc"), format!("o<sub> call\n{PART}")).expect("a file");
    std::fs::hard_link(folder.join("part.ngc"), folder.join("linked.svg"))
        .or_else(|error| if folder.join("linked.svg").exists() { Ok(()) } else { Err(error) })
        .expect("a link");
    for (program, written) in [
        ("part.ngc", "--svg part.ngc"),
        ("part.ngc", "--svg ./part.ngc"),
        ("part.ngc", "--svg linked.svg"),
        ("part.ngc", "--samples part.ngc"),
        ("part.ngc", "--samples mill.toml"),
        ("part.ngc", "--samples script.toml"),
        ("calls.ngc", "--svg sub.ngc"),
    ] {
        let call = format!("plan {program} --machine mill.toml --script script.toml {written}");
        let (option, name) = written.split_once(' ').expect("an option and a file");
        let output = gaugeblock(&folder, &call);
        assert!(output.stdout.is_empty(), "{call}");
        says(&output, 2, &[name, &format!("hint: name another file with {option}")]);
    }
    says(
        &gaugeblock(
            &folder,
            "motion check script.toml --program part.ngc --machine mill.toml --svg mill.toml",
        ),
        2,
        &["mill.toml: --svg would write over"],
    );
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("a file");
    assert_eq!([read("part.ngc"), read("mill.toml"), read("script.toml")], [PART, MILL, script]);
    // What is written is written again.
    for _ in 0..2 {
        let planned = gaugeblock(&folder, "plan part.ngc --machine mill.toml --svg part.svg");
        says(&planned, 0, &[]);
    }
}

#[test]
fn a_file_that_cannot_be_written_leaves_nothing() {
    let folder = folder("unwritten");
    std::fs::create_dir_all(folder.join("there")).expect("a folder");
    for option in ["--samples", "--svg"] {
        let call = format!("plan part.ngc --machine mill.toml {option} there");
        says(&gaugeblock(&folder, &call), 2, &["there: ", "hint:"]);
        assert!(!folder.join("there.partial").exists());
    }
}

/// The calls that write an output, with `OUT` for its path.
const OUTPUTS: [&str; 7] = [
    "plan part.ngc --machine mill.toml --samples OUT",
    "plan part.ngc --machine mill.toml --svg OUT",
    "motion check samples.csv --program part.ngc --machine mill.toml --svg OUT",
    "certify --controller reference --only coolant --write-expectations OUT",
    "rs274 -g part.ngc OUT",
    "rs274 -g -v OUT part.ngc",
    "shrink small.ngc --controller exec:./wrong.py --against reference --output OUT",
];

#[test]
fn an_output_replaces_no_device_and_no_link_and_keeps_permissions() {
    let here = folder("outputs");
    let wrong = TEMPLATE.replace("{letter: number for", "{letter: number + 1 for");
    std::fs::write(here.join("wrong.py"), wrong).expect("a file");
    let executable = Permissions::from_mode(0o755);
    std::fs::set_permissions(here.join("wrong.py"), executable).expect("a mode");
    std::fs::write(here.join("small.ngc"), "g21 f600\ng1 x1\nm2\n").expect("a file");
    let run = |call: &str, output: &str| {
        let done = gaugeblock(&here, &call.replace("OUT", output));
        says(&done, 0, &[]);
        done.stdout
    };
    run(OUTPUTS[0], "samples.csv");
    for call in OUTPUTS {
        for name in ["file", "link", "dangling", "device"] {
            let _none = std::fs::remove_file(here.join(name));
        }
        std::fs::write(here.join("file"), "").expect("a file");
        std::fs::set_permissions(here.join("file"), Permissions::from_mode(0o600)).expect("a mode");
        symlink("file", here.join("link")).expect("a link");
        run(call, "link");
        assert!(here.join("link").is_symlink(), "{call:?}");
        let file = here.join("file").symlink_metadata().expect("the file");
        assert_eq!(file.permissions().mode() & 0o777, 0o600, "{call:?}");
        assert!(file.is_file() && file.len() > 0, "{call:?}");

        std::fs::remove_file(here.join("file")).expect("it is there");
        run(call, "link");
        assert!(here.join("link").is_symlink() && here.join("file").exists(), "{call:?}");

        // Only root may make a device; it has the number of /dev/null.
        let (kind, null) = (FileType::CharacterDevice, rustix::fs::makedev(1, 3));
        let mode = Mode::from_raw_mode(0o666);
        if rustix::fs::mknodat(CWD, here.join("device"), kind, mode, null).is_ok() {
            run(call, "device");
            let device = here.join("device").symlink_metadata().expect("the device");
            assert!(device.file_type().is_char_device(), "{call:?}");
        }
        if call.contains("-v") {
            // It is read first, and nobody writes into standard output.
            continue;
        }
        let text = std::fs::read(here.join("file")).expect("the output");
        let printed = run(call, "/dev/stdout");
        let has = printed.windows(text.len()).any(|part| part == text);
        assert!(has, "{call:?}: {}", String::from_utf8_lossy(&printed));
    }
}

#[test]
fn samples_come_back_in_both_forms_and_one_wrong_number_is_found() {
    let folder = folder("samples");
    for file in ["part.csv", "part.bin"] {
        let plan = format!("plan part.ngc --machine mill.toml --samples {file} --svg part.svg");
        let planned = gaugeblock(&folder, &plan);
        let judged = gaugeblock(
            &folder,
            &format!("motion check {file} --program part.ngc --machine mill.toml"),
        );
        assert_eq!(planned.stdout, judged.stdout);
    }
    let svg = std::fs::read_to_string(folder.join("part.svg")).expect("a picture");
    assert!(svg.starts_with("<svg"), "{svg:.80}");

    let samples = std::fs::read_to_string(folder.join("part.csv")).expect("samples");
    let mut lines: Vec<String> = samples.lines().map(str::to_owned).collect();
    let middle = lines.len() / 2;
    let (x, rest) = lines[middle].split_once(',').expect("a row");
    let x: f64 = x.parse().expect("a number");
    lines[middle] = format!("{},{rest}", x + 0.01);
    std::fs::write(folder.join("bent.csv"), lines.join("\n") + "\n").expect("a file");
    let judged =
        gaugeblock(&folder, "motion check bent.csv --program part.ngc --machine mill.toml");
    says(&judged, 1, &["broken      trajectory.acceleration", "trajectory.acceleration at cycle"]);
}

#[test]
fn usage_errors_are_reported_with_their_place() {
    let folder = folder("wrong");
    std::fs::write(folder.join("bad.toml"), "period = 0.001\n[axes]\nx = { velocity = -1 }\n")
        .expect("a file");
    std::fs::write(
        folder.join("bad.csv"),
        "# gaugeblock samples 0 period=0.001 resolution=0\nx\n1e\n",
    )
    .expect("a file");
    std::fs::write(folder.join("far.ngc"), "g1 f1 a5\nm2\n").expect("a file");
    std::fs::write(folder.join("torn.ngc"), "g1 f1 x5\ng1 x\nm2\n").expect("a file");
    let says = |arguments: &str, status, words: &[&str]| {
        let output = gaugeblock(&folder, arguments);
        assert!(output.stdout.is_empty());
        says(&output, status, words);
    };
    says("plan part.ngc --machine bad.toml", 2, &["bad.toml", "velocity"]);
    let hint = "hint: check the path of the machine file (--machine)";
    says("plan part.ngc --machine none.toml", 2, &["none.toml", hint]);
    std::fs::write(folder.join("zero.csv"), "# gaugeblock samples 0 period=0 resolution=0\nx\n1\n")
        .expect("a file");
    says(
        "motion check zero.csv --program part.ngc --machine mill.toml",
        2,
        &["zero.csv: line 1: a period"],
    );
    std::fs::write(folder.join("empty.ngc"), "").expect("a file");
    let ends = ["the file ends without M2", "empty.ngc:1:1", "empty.ngc does not reach its end"];
    says("plan empty.ngc --machine mill.toml", 2, &ends);
    for start in ["nan,0,0", "0,inf", "1,2,3,4,5,6,7,8,9,10"] {
        says(&format!("plan part.ngc --machine mill.toml --start {start}"), 2, &["--start"]);
    }
    says("plan far.ngc --machine mill.toml", 3, &["far.ngc:1: axis", "no limits for it", "[axes]"]);
    says("plan torn.ngc --machine mill.toml", 2, &["torn.ngc", "does not reach its end"]);
    for (action, words) in [
        ("{ feed_override = -3.0 }", "odd.toml: event 1: an override of -3"),
        ("{ feed_override = inf }", "odd.toml: line 2: not a finite number"),
        ("{ feed_override = \"fast\" }", "odd.toml: line 2: "),
    ] {
        let script = format!("events = [\n  {{ cycle = 3, action = {action} }},\n]\n");
        std::fs::write(folder.join("odd.toml"), script).expect("a file");
        says("plan part.ngc --machine mill.toml --script odd.toml", 2, &[words, "hint: "]);
    }
    says("motion check bad.csv --program part.ngc --machine mill.toml", 2, &["bad.csv", "line 3"]);
    let head = "# gaugeblock samples 0 period=0.001 resolution=0\nx,y,z,line\n";
    std::fs::write(folder.join("empty.csv"), head).expect("a file");
    let words = ["empty.csv", "no sample", "hint"];
    says("motion check empty.csv --program part.ngc --machine mill.toml", 2, &words);
}

#[test]
fn an_axis_without_a_limit_leaves_a_law_open_and_the_others_are_judged() {
    let folder = folder("without-limit");
    let open = MILL.replace(", acceleration = 2000", "");
    std::fs::write(folder.join("open.toml"), open).expect("a file");
    std::fs::write(folder.join("line.ngc"), "g21 g90 f600\ng1 x1\nm2\n").expect("a file");
    says(&gaugeblock(&folder, "plan line.ngc --machine mill.toml --samples line.csv"), 0, &[]);
    let judged =
        gaugeblock(&folder, "motion check line.csv --program line.ngc --machine open.toml");
    let open = "not judged  trajectory.acceleration: x moves and no limit of it is stated";
    says(&judged, 0, &[open, "holds       trajectory.velocity"]);
}
