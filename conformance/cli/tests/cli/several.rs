//! Several controllers: in one call of `certify`, and their reports side by side.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::command::{browser, gaugeblock, rendered};

/// Two controllers of this process, on one chapter.
const BOTH: &[&str] =
    &["certify", "--controller", "reference", "--controller", "production", "--only", "coolant"];

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("several").join(name);
    let _absent = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path in UTF-8")
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).expect("a file")).expect("JSON")
}

/// Runs a call that has to end with this status, and gives what it printed and complained of.
fn run(call: &[&str], status: i32) -> (String, String) {
    let output = gaugeblock(call);
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{call:?}: {complaint}{printed}");
    (printed, complaint)
}

#[test]
fn each_of_several_controllers_has_its_own_report_and_all_a_comparison() {
    let here = folder("certified");
    let (printed, _) = run(&[BOTH, &["--report", text(&here)]].concat(), 0);
    assert!(printed.contains("reference 0.1.0 against") && printed.contains("rs274-core"));
    let alone = folder("alone");
    let call = ["certify", "--controller", "production", "--only", "coolant"];
    run(&[&call[..], &["--report", text(&alone)]].concat(), 0);
    let (own, other) = (here.join("production/report.json"), alone.join("report.json"));
    assert_eq!(json(&own), json(&other), "a report does not depend on the other controllers");
    let comparison = json(&here.join("comparison.json"));
    let names: Vec<_> = comparison["controllers"].as_array().expect("columns").iter().collect();
    assert_eq!((names.len(), &names[1]["report"]), (2, &Value::from("production/report.html")));
    let page = std::fs::read_to_string(here.join("comparison.html")).expect("a page");
    assert!(page.contains(r#"href="production&#x2f;report.html""#));
    let (printed, _) = run(&[BOTH, &["--format", "json"]].concat(), 0);
    let printed: Value = serde_json::from_str(&printed).expect("one JSON document");
    assert_eq!(printed["gaugeblock"], "comparison");
}

#[test]
fn options_of_one_controller_are_refused_for_several() {
    for option in [
        &["--baseline", "report.json"][..],
        &["--expectations", "known.toml"],
        &["--waivers", "waivers.toml"],
        &["--write-expectations", "known.toml"],
        &["--options", "options.json"],
        &["--restrict-to", "reference"],
        &["--shard", "1/2"],
        &["--report", "out", "--resume"],
    ] {
        let (_, complaint) = run(&[BOTH, option].concat(), 2);
        let name = option[option.len().saturating_sub(if option.len() == 3 { 1 } else { 2 })];
        assert!(complaint.contains(name) && complaint.contains("hint:"), "{complaint}");
        assert!(complaint.contains("report compare"), "{complaint}");
    }
    assert!(!Path::new("out").exists());
}

#[test]
fn comparison_of_reports_is_written_and_a_report_that_cannot_be_read_leaves_nothing() {
    let here = folder("compared");
    run(&[BOTH, &["--report", text(&here)]].concat(), 0);
    let (one, other) = (here.join("reference"), here.join("production/report.json"));
    let out = here.join("2026-11-29");
    let named = format!("mill={}", text(&other));
    run(&["report", "compare", text(&one), &named, "--report", text(&out)], 0);
    assert_eq!(json(&out.join("comparison.json"))["controllers"][1]["name"], "mill");
    let nothing = here.join("nothing");
    let absent = here.join("absent");
    let no_report = here.join("comparison.json");
    let no_json = here.join("comparison.html");
    for (bad, why) in [
        (text(&absent), "No such file"),
        (text(&no_report), "is not a Gaugeblock report (JSON)"),
        (text(&no_json), "is not a Gaugeblock report (JSON)"),
    ] {
        let call = ["report", "compare", text(&one), bad, "--report", text(&nothing)];
        let (_, complaint) = run(&call, 2);
        assert!(complaint.contains(bad) && complaint.contains(why), "{complaint}");
        assert!(complaint.contains("hint:"), "{complaint}");
        assert!(!nothing.exists(), "nothing is written");
    }
    run(&["report", "compare", text(&one)], 2);
}

#[test]
fn date_of_a_report_is_the_last_one_in_its_path() {
    let here = folder("trend");
    let call = ["certify", "--controller", "production", "--only", "coolant.off"];
    let runs = ["2026-10-01", "2026-11-02"].map(|day| {
        let folder = here.join(day).join("mill");
        run(&[&call[..], &["--report", text(&folder)]].concat(), 0);
        folder
    });
    let (printed, _) =
        run(&["report", "compare", text(&runs[1]), text(&runs[0]), "--format", "json"], 0);
    let comparison: Value = serde_json::from_str(&printed).expect("JSON");
    assert_eq!(comparison["controllers"].as_array().map(Vec::len), Some(1));
    let dates = comparison["trends"][0]["runs"].as_array().expect("runs");
    let dates: Vec<_> = dates.iter().map(|run| run["date"].as_str().expect("a date")).collect();
    assert_eq!(dates, ["2026-10-01", "2026-11-02"]);
}

#[test]
fn profiles_are_listed_and_a_report_names_the_rules_that_are_missing() {
    let (printed, _) = run(&["suite", "profiles", "--edition", "grbl-1.1"], 0);
    assert!(printed.starts_with("rs274-core") && !printed.contains("cycles "), "{printed}");
    let (printed, _) = run(&["rules", "--profile", "rs274-core", "--format", "json"], 0);
    let rules: Value = serde_json::from_str(&printed).expect("JSON");
    let rules = rules["rules"].as_array().expect("rules");
    assert!(rules.iter().all(|rule| rule["profile"] == "rs274-core"));
    run(&["rules", "--profile", "no-such"], 2);
    let call = [
        "certify",
        "--controller",
        "production",
        "--only",
        "coolant.off",
        "--profile",
        "rs274-core",
    ];
    let (printed, _) = run(&call, 1);
    assert!(printed.contains("not run: arcs.centre, "), "{printed}");
    assert!(printed.contains("fails the claimed profile rs274-core (version 0)"), "{printed}");
}

/// Runs the page's own script where there is a browser.
#[test]
fn page_of_several_filters_by_its_address() {
    let Some(browser) = browser() else { return };
    let here = folder("browser");
    run(&[BOTH, &["--only", "feed.rate", "--report", text(&here)]].concat(), 0);
    let address = format!("{}/comparison.html#chapter=feed&verdict=pass", here.display());
    let page = rendered(browser, &here, &address);
    let hidden = page.matches("hidden=\"\"").count();
    let rows = page.matches("<tr class=\"row\"").count();
    let of_chapter = page.matches("data-chapter=\"feed\"").count();
    assert!(of_chapter > 0 && of_chapter < rows, "{of_chapter} of {rows}");
    assert_eq!(hidden, rows - of_chapter, "hidden rows");
}
