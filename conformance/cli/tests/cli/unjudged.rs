//! Cases that could not be judged: expectations, a baseline or a waiver can accept them, so that a gate can be green.

use std::path::Path;

use serde_json::Value;

use crate::command::gaugeblock;
use crate::template::{changed, file, text};

/// A rule whose cases the template runs.
const RULE: &str = "modal-groups.g-code-out-of-range";

/// The template that ends without an answer where it would refuse one of these codes.
fn crashing(name: &str, codes: &[&str]) -> String {
    let answer = "    print(json.dumps({\"id\": request[\"id\"], **answer}), flush=True)\n";
    let ends = format!(
        "    if any(\"code: \" + code + \"\\\"\" in json.dumps(answer) for code in {codes:?}):\n        raise SystemExit(1)\n{answer}"
    );
    format!("exec:{}", changed(name, &[(answer, &ends)]))
}

/// The report of a run with this exit status.
fn report(controller: &str, name: &str, status: i32, arguments: &[&str]) -> (Value, String) {
    let folder = Path::new(&file("unjudged", "")).with_file_name(name);
    let folder_name = folder.to_str().expect("a path in UTF-8");
    let call = ["certify", "--controller", controller, "--only", RULE, "--fingerprint", "never"];
    let arguments = [&["--report", folder_name], arguments].concat();
    let output = gaugeblock(&[&call[..], &arguments].concat());
    let said = format!("{}{}", text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {said}");
    let report = std::fs::read_to_string(folder.join("report.json")).expect("a report");
    (serde_json::from_str(&report).expect("JSON"), said)
}

#[test]
fn case_that_could_not_be_judged_can_be_accepted() {
    let controller = crashing("crashes.py", &["G1000"]);
    let (first, said) = report(&controller, "unjudged-first", 3, &[]);
    let count = first["counts"]["crash"].as_u64();
    assert!(count > Some(0) && first["counts"]["pass"].as_u64() > Some(0), "{said}");
    let named = first["cases"].as_array().expect("cases").iter();
    let crashes: Vec<_> = named.filter(|case| case["verdict"] == "crash").collect();

    let expectations = file("unjudged-expectations.toml", "");
    std::fs::remove_file(&expectations).expect("the file can be removed");
    report(&controller, "unjudged-write", 3, &["--write-expectations", &expectations]);
    let waivers: String = crashes
        .iter()
        .map(|case| {
            let case = case["case"].as_str().expect("a name");
            format!(
                "[[waiver]]\nrule = \"{RULE}\"\ncase = \"{case}\"\nreason = \"it crashes\"\nowner = \"Ada\"\nexpires = "
            ) + "\"2099-01-31\"\n"
        })
        .collect();
    let baseline = Path::new(&expectations).with_file_name("unjudged-first/report.json");
    let baseline = baseline.to_str().expect("a path in UTF-8");
    for (name, list, source) in [
        ("unjudged-expected", ["--expectations", &expectations], "listed in the expectations"),
        ("unjudged-baseline", ["--baseline", baseline], "as in the baseline"),
        (
            "unjudged-waived",
            ["--waivers", &file("unjudged-waivers.toml", &waivers)],
            "waived by Ada until 2099-01-31: it crashes",
        ),
    ] {
        let (accepted, said) = report(&controller, name, 0, &list);
        assert_eq!(
            accepted["counts"]["crash"].as_u64(),
            count,
            "{name}: an accepted crash is not a pass"
        );
        assert_eq!(accepted["counts"]["not_judged_accepted"].as_u64(), count, "{name}");
        assert!(said.contains(source), "{name}: {said}");
        let page = Path::new(&expectations).with_file_name(name).join("report.html");
        let page = std::fs::read_to_string(page).expect("a page");
        assert!(page.contains(source), "{name}: the page does not name what accepts the crash");
    }

    // Another crash is not accepted, and a crash that is over is not listed any more.
    let more = crashing("crashes-more.py", &["G1000", "G101"]);
    report(&more, "unjudged-more", 3, &["--expectations", &expectations]);
    let over = format!("exec:{}", changed("crashes-no-more.py", &[]));
    report(&over, "unjudged-over", 1, &["--expectations", &expectations]);
}
