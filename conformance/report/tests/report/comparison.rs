//! Several reports side by side.

use std::path::Path;

use gaugeblock_compare::Accuracy;
use gaugeblock_report::comparison::{
    CellVerdict, ComparedReport, Comparison, comparison, html, schema, terminal,
};
use gaugeblock_report::merge::VERSION;
use serde_json::{Value, json};

/// A report of one case for each rule.
fn report(controller: &str, edition: &str, rules: &[(&str, &str)]) -> Value {
    let core = rules.iter().filter(|(_, verdict)| *verdict != "void");
    let passing = core.clone().filter(|(_, verdict)| *verdict == "pass").count();
    let missing = core.clone().filter(|(_, verdict)| *verdict != "pass");
    let missing = missing.map(|(rule, verdict)| json!({ "rule": rule, "verdict": verdict }));
    let judged = core.clone().map(|(rule, verdict)| {
        json!({
            "rule": rule, "sentence": format!("About {rule}."), "profile": "rs274-core",
            "verdict": verdict, "cases": 1,
        })
    });
    let cases = core.clone().map(|(rule, verdict)| match *verdict {
        "pass" => json!({ "rule": rule, "case": "one", "verdict": "pass" }),
        "diverges" => json!({
            "rule": rule, "case": "one", "verdict": "diverges",
            "why": { "assertion": ["refused at 2", "<b>program end</b>"], "found": "accepted" },
        }),
        other => json!({
            "rule": rule, "case": "one", "verdict": other, "why": { "reason": "no such words" },
        }),
    });
    let void = rules.iter().filter(|(_, verdict)| *verdict == "void");
    let void = void.map(|(rule, _)| json!({ "rule": rule, "why": "its documents do not say so" }));
    json!({
        "gaugeblock": "report", "schema": VERSION, "controller": controller, "version": "1.0",
        "edition": edition, "options": {}, "scope": "full", "accuracy": Accuracy::default(),
        "suite": "0123456789abcdef", "gaugeblock_version": "0.1.0", "only": [], "laws": false,
        "shard": "1/1", "twice": 1, "exit_status": 1,
        "profiles": [{
            "profile": "rs274-core", "version": 0, "sentence": "What all share.", "claimed": false,
            "passes": passing == core.count(), "rules": judged.clone().count(), "pass": passing,
            "diverges": 0, "unsupported": 0, "not_judged": 0, "not_run": 0,
            "missing": missing.collect::<Vec<_>>(),
        }],
        "rules": judged.collect::<Vec<_>>(), "void": void.collect::<Vec<_>>(),
        "cases": cases.collect::<Vec<_>>(),
    })
}

fn read(report: &Value, date: &str) -> ComparedReport {
    let date = date.parse().expect("a day");
    ComparedReport::read(&report.to_string(), "a/report.json", None, date).expect("a report")
}

/// Three controllers, one of them under an edition with fewer rules.
fn three() -> Comparison {
    let mill = report(
        "mill",
        "linuxcnc-2.9",
        &[("arcs.radius", "pass"), ("feed.rate", "diverges"), ("text.case", "pass")],
    );
    let lathe = report(
        "lathe",
        "linuxcnc-2.9",
        &[("arcs.radius", "unsupported"), ("feed.rate", "pass"), ("text.case", "pass")],
    );
    let router = report(
        "router",
        "grbl-1.1",
        &[("arcs.radius", "unsupported"), ("feed.rate", "pass"), ("text.case", "void")],
    );
    let reports = [mill, lathe, router].map(|report| read(&report, "2026-11-29"));
    comparison(&reports).expect("reports that can be compared")
}

#[test]
fn rule_that_an_edition_lacks_is_void_there_and_counts_for_nothing() {
    let compared = three();
    let row = compared.rules.iter().find(|row| row.rule == "text.case").expect("a row");
    let verdicts: Vec<_> = row.cells.iter().map(|cell| cell.verdict).collect();
    assert_eq!(verdicts, [CellVerdict::Pass, CellVerdict::Pass, CellVerdict::Void]);
    assert!(!row.differs, "void is not a verdict");
    let text = compared.chapters.iter().find(|row| row.chapter == "text").expect("a chapter");
    let counts: Vec<_> = text.counts.iter().map(|it| (it.pass, it.rules, it.void)).collect();
    assert_eq!(counts, [(1, 1, 0), (1, 1, 0), (0, 0, 1)]);
}

#[test]
fn what_only_one_does_is_among_those_that_were_judged() {
    let compared = three();
    let (mill, others) = (&compared.alone[0], &compared.alone[1..]);
    assert_eq!(mill.passes, ["arcs.radius"]);
    let fails: Vec<_> = mill.fails.iter().map(|it| (&it.rule[..], &it.verdict[..])).collect();
    assert_eq!(fails, [("feed.rate", "diverges")]);
    assert!(others.iter().all(|it| it.passes.is_empty() && it.fails.is_empty()), "{others:?}");
}

#[test]
fn page_is_self_contained_and_has_the_names_of_missing_rules() {
    let compared = three();
    let page = html(&compared).expect("a page");
    for external in ["http:", "https:", "src=", "@import", "url("] {
        assert!(!page.contains(external), "{external}");
    }
    assert!(page.contains("one: expected refused at 2, found &lt;b&gt;program end"), "escaped");
    assert!(page.contains(r##"<a href="#profile=rs274-core">"##));
    assert_eq!(page.matches("<tr class=\"row\"").count(), 3);
    let text = terminal(&compared);
    assert!(text.contains("mill against linuxcnc-2.9 passes alone: 1 (arcs.radius)"), "{text}");
}

#[test]
fn comparison_is_as_its_published_schema_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("schema/comparison.json");
    let now = serde_json::to_string_pretty(&schema()).expect("a schema is JSON") + "\n";
    if std::env::var_os("GAUGEBLOCK_BLESS").is_some() {
        std::fs::write(&path, &now).expect("schema/ can be written");
    }
    let published = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(published == now, "{}: run with GAUGEBLOCK_BLESS=1", path.display());
    let document = serde_json::to_value(three()).expect("JSON");
    let validator = jsonschema::validator_for(schema().as_value()).expect("a schema");
    assert!(validator.is_valid(&document), "{:?}", validator.validate(&document).err());
    assert_eq!(document["rules"][0]["cells"][1]["verdict"], "unsupported");
    assert_eq!(document["profiles"][0]["distances"][2]["pass"], 1);
}

#[test]
fn reports_of_one_controller_and_edition_are_a_trend_whatever_their_order() {
    let first = report("mill", "linuxcnc-2.9", &[("feed.rate", "pass"), ("text.case", "diverges")]);
    let last = report("mill", "linuxcnc-2.9", &[("feed.rate", "diverges"), ("text.case", "pass")]);
    let other = report("mill", "grbl-1.1", &[("feed.rate", "pass")]);
    let reports =
        [read(&last, "2026-11-29"), read(&first, "2026-10-01"), read(&other, "2026-11-01")];
    let compared = comparison(&reports).expect("reports that can be compared");
    let columns: Vec<_> =
        compared.controllers.iter().map(|it| (&it.edition[..], &it.date[..])).collect();
    assert_eq!(columns, [("linuxcnc-2.9", "2026-11-29"), ("grbl-1.1", "2026-11-01")]);
    let [trend] = &compared.trends[..] else { panic!("{:?}", compared.trends) };
    let [first, last] = &trend.runs[..] else { panic!("{trend:?}") };
    assert_eq!((first.date.as_str(), first.gained.len(), first.lost.len()), ("2026-10-01", 0, 0));
    assert_eq!(last.gained, ["text.case"]);
    let lost: Vec<_> = last.lost.iter().map(|it| (&it.rule[..], &it.verdict[..])).collect();
    assert_eq!(lost, [("feed.rate", "diverges")]);
    assert!(html(&compared).expect("a page").contains("2026-10-01"));
}

#[test]
fn reports_of_different_scopes_are_refused_with_their_files() {
    let mut other = report("mill", "linuxcnc-2.9", &[("feed.rate", "pass")]);
    other["scope"] = json!("assertions-only");
    let full = report("lathe", "linuxcnc-2.9", &[("feed.rate", "pass")]);
    let why = comparison(&[read(&full, "2026-11-29"), read(&other, "2026-11-29")])
        .expect_err("another scope");
    assert!(why.contains("a/report.json") && why.contains("assertions only"), "{why}");
}

#[test]
fn run_in_part_and_other_suites_are_noted() {
    let full = report("mill", "linuxcnc-2.9", &[("feed.rate", "pass"), ("text.case", "pass")]);
    let mut part = report("lathe", "linuxcnc-2.9", &[("feed.rate", "pass")]);
    part["only"] = json!(["feed"]);
    part["suite"] = json!("fedcba9876543210");
    let reports = [read(&full, "2026-11-29"), read(&part, "2026-11-29")];
    let compared = comparison(&reports).expect("reports that can be compared");
    assert_eq!(compared.notes.len(), 2, "{:?}", compared.notes);
    let row = compared.rules.iter().find(|row| row.rule == "text.case").expect("a row");
    assert_eq!(row.cells[1].verdict, CellVerdict::NotRun);
}
