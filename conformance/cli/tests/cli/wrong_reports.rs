//! What is given in the place of a report of an earlier run, and is none.

use std::path::Path;

use crate::command::gaugeblock;

#[test]
fn a_wrong_file_in_the_place_of_a_report_is_named_as_such() {
    let here = Path::new(env!("CARGO_TARGET_TMPDIR")).join("no-report");
    std::fs::create_dir_all(&here).expect("a folder for the test");
    let path = |name: &str| here.join(name).to_str().expect("UTF-8").to_owned();
    let binary = b"\xff\xfe\0".as_slice();
    let files: [(&str, &[u8]); 5] = [
        ("empty", b""),
        ("program.ngc", b"g0 x1\nm2\n"),
        ("cut-off.json", b"{\"gaugeblock\":\"report\",\"sch"),
        ("other.json", b"{\"cases\":[]}"),
        ("binary", binary),
    ];
    for (name, content) in files {
        std::fs::write(here.join(name), content).expect("a file");
    }
    let is_refused = |call: &[&str], words: &[&str]| {
        let message = gaugeblock(call).stderr;
        let message = String::from_utf8_lossy(&message);
        assert!(words.iter().all(|word| message.contains(word)), "{call:?}: {message}");
        assert!(!message.contains("shard"), "{call:?}: {message}");
    };
    let hint = "hint: name the report.json of an earlier run";
    let commands: [&[&str]; 4] = [
        &["certify", "--controller", "reference", "--only", "coolant", "--baseline"],
        &["report", "merge"],
        &["suite", "matrix", "--report"],
        &["fuzz", "--programs", "1", "--known"],
    ];
    for command in commands {
        for (name, _) in files {
            // Plain text is asked for by these two before anything else.
            if name == "binary" && ["suite", "fuzz"].contains(&command[0]) {
                continue;
            }
            let of_fuzz = format!("{name} is not a report of `gaugeblock fuzz` (JSON)");
            let of_certify = format!("{name} is not a Gaugeblock report (JSON)");
            let message = if command[0] == "fuzz" { of_fuzz } else { of_certify };
            is_refused(&[command, &[path(name).as_str()]].concat(), &[&message, hint]);
        }
        if ["certify", "report"].contains(&command[0]) {
            is_refused(&[command, &[path("absent").as_str()]].concat(), &["absent: No such", hint]);
        }
    }
}
