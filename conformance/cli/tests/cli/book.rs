//! The suite as a site: its pages, its search, and what it says of controllers.

use std::path::{Path, PathBuf};

use crate::command::{browser, gaugeblock, rendered};

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book").join(name);
    let _absent = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path in UTF-8")
}

/// Runs a call that has to end with this status, and gives what it complained of.
fn run(call: &[&str], status: i32) -> String {
    let output = gaugeblock(call);
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{call:?}: {complaint}");
    complaint
}

#[test]
fn rule_has_its_program_and_the_controllers_that_keep_it() {
    let here = folder("site");
    let (reports, site) = (here.join("reports"), here.join("site"));
    let certify = ["certify", "--controller", "production", "--only", "dwell", "--measure"];
    run(&[&certify[..], &["--report", text(&reports)]].concat(), 0);
    let compared = format!("mill={}", text(&reports));
    run(&["book", text(&site), "--compared", &compared], 0);
    let page = |path: &str| std::fs::read_to_string(site.join(path)).expect("a page");
    let rule = page("rules/dwell.seconds.html");
    assert!(rule.contains("<td>mill</td>"), "the controller");
    assert!(rule.contains("<td class=\"pass\">pass</td>"), "its verdict");
    assert!(rule.contains("do</b> dwell"), "what a block does");
    assert!(!page("rules/arcs.centre.html").contains("<td>mill</td>"), "a rule that was not run");
    assert!(page("index.html").contains("<td>10 accepted, 11 not</td>"), "its measured limits");
    let Some(browser) = browser() else { return };
    let address = format!("{}?q=dwell.seconds", text(&site.join("index.html")));
    let found = rendered(browser, &here, &address);
    assert!(found.contains("href=\"rules/dwell.seconds.html\""), "the search finds a rule");
}

#[test]
fn nothing_is_written_where_the_call_is_wrong() {
    let here = folder("wrong");
    let (site, file) = (here.join("site"), here.join("file"));
    std::fs::write(&file, "mine").expect("a file");
    run(&["book", text(&site), "--compared", text(&here.join("no-report.json"))], 2);
    assert!(!site.exists(), "no part of a book");
    let complaint = run(&["book", text(&file)], 2);
    assert!(complaint.contains("file"), "{complaint}");
    assert_eq!(std::fs::read_to_string(&file).expect("the file"), "mine");
}
