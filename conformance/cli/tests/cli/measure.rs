//! `gaugeblock measure`.

use std::path::Path;

use serde_json::Value;

use crate::command::gaugeblock;

fn json(arguments: &[&str]) -> Value {
    let output = gaugeblock(&[&["measure", "--format", "json"], arguments].concat());
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {output:?}"))
}

#[test]
fn production_has_the_limits_of_its_documents() {
    // 11.4.3.5 of the manual: ten levels of calls. 11.4.2: 255 characters. 11.5.4: a tenth of a millimetre and so on.
    let measured =
        json(&["--only", "call-depth", "--only", "line-length", "--only", "code-decimals"]);
    let edges: Vec<_> = measured["measurements"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|one| (one["id"].as_str().expect("a name"), &one["measured"]["edge"]["accepted"]))
        .collect();
    let expected = [("code-decimals", 1e-5), ("call-depth", 10.0), ("line-length", 255.0)];
    assert_eq!(edges.len(), expected.len());
    for ((id, found), (wanted, edge)) in edges.iter().zip(expected) {
        assert_eq!(*id, wanted);
        let found = found.as_f64().expect("a number");
        assert!((found - edge).abs() < edge * 0.01, "{id}: {found}");
    }
}

#[test]
fn rounded_corner_is_as_far_as_its_tolerance() {
    let measured = json(&["--only", "blend-0.1"]);
    let distance = measured["measurements"][0]["measured"]["value"].as_f64().expect("a value");
    // The way between two samples is taken as straight, so it is a little farther from the corner.
    assert!((0.09..=0.1001).contains(&distance), "{distance}");
}

#[test]
fn text_has_the_edge_and_the_program() {
    let output = gaugeblock(&["measure", "--only", "call-depth", "--verbose"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert!(text.contains("10 accepted, 11 not"), "{text}");
    assert!(text.contains("| o100 call [11]"), "{text}");
}

#[test]
fn what_a_controller_lacks_is_not_measured() {
    let output = gaugeblock(&["measure", "--only", "blend", "--controller", "reference"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("not measured: "), "{text}");
}

#[test]
fn unknown_measurement_is_a_wrong_call() {
    let output = gaugeblock(&["measure", "--only", "weight"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("no measurement begins with weight"));
}

#[test]
fn reports_and_comparisons_have_the_limits() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("measured");
    let _absent = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = |name: &str| folder.join(name).display().to_string();
    let only = ["certify", "--measure", "--only", "feed.mode-holds", "--fingerprint", "never"];
    let output = gaugeblock(&[&only[..], &["--report", &path("whole")]].concat());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let merged = gaugeblock(&["report", "merge", &path("whole"), "--report", &path("merged")]);
    assert_eq!(merged.status.code(), Some(0), "{merged:?}");
    for report in ["whole", "merged"] {
        for (file, limit) in [
            ("report.txt", "call-depth           10 accepted, 11 not"),
            ("report.html", "<summary>10 accepted, 11 not</summary>"),
            ("report.json", "\"id\": \"call-depth\""),
        ] {
            let text = std::fs::read_to_string(folder.join(report).join(file));
            assert!(text.expect("a report").contains(limit), "{report}/{file}");
        }
    }
    let compared = gaugeblock(&[
        "report",
        "compare",
        &path("whole"),
        &path("merged"),
        "--report",
        &path("side"),
    ]);
    assert_eq!(compared.status.code(), Some(0), "{compared:?}");
    let page = std::fs::read_to_string(folder.join("side/comparison.html")).expect("a page");
    assert!(page.contains("<td>10 accepted, 11 not</td>"), "{page}");
}
