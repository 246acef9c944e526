//! What people who write programs see: `run`, `compare` and `shrink` of a program in a folder of others.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

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
    says(&here, call, 0, &["part.ngc: no difference"]);
    says(&here, &format!("{call} --edition linuxcnc-2.8"), 1, &["prepare_tool"]);
}
