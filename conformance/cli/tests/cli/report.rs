//! Reports: their verdicts by name, their form, and that nothing in them obeys a controller.

use std::num::NonZero;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::Reference;
use gaugeblock_report::grouping::size;
use gaugeblock_report::merge::Stored;
use gaugeblock_report::stored::StoredCase;
use gaugeblock_report::terminal::Detail;
use gaugeblock_report::{Header, Report, html, json, junit, markdown, terminal};
use gaugeblock_runner::certify::{
    CaseResult, Plan, RepeatSampling, Run, RunOptions, Scope, certify, run_plan,
};
use gaugeblock_runner::findings::{Finding, Severity};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::{Channel, Effect, End, Event, Outcome, Scenario};
use serde_json::Value;

use crate::command::{browser, gaugeblock, rendered};

/// What a controller could say to a terminal, a page, a table or a reader.
const EVIL: &str = "\u{1b}]0;owned\u{7}\u{1b}[2J<script>document.title='owned'</script>]]><![CDATA[ & \"' \u{202e}| `x`";

/// A text of programs, and what becomes of the outcome of those that have it.
type Meddle = (&'static str, fn(Outcome) -> Result<Outcome, HarnessError>);

/// The model, but for programs that have a text in them.
#[derive(Debug)]
struct Meddled {
    model: Reference,
    observables: Capabilities,
    of: &'static [Meddle],
}

impl Adapter for Meddled {
    fn capabilities(&self) -> &Capabilities {
        &self.observables
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.model.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let outcome = self.model.run(scenario)?;
        let main = &scenario.program.main;
        match self.of.iter().find(|(text, _)| main.contains(text)) {
            Some((_, meddle)) => meddle(outcome),
            None => Ok(outcome),
        }
    }
}

/// Something else than what the documents say, told with a text that means harm.
fn departs(mut outcome: Outcome) -> Result<Outcome, HarnessError> {
    outcome.steps.truncate(1);
    outcome.end = End::ProgramEnd;
    for step in &mut outcome.steps {
        let (channel, text) = (Channel::Display, EVIL.to_owned());
        step.events.push(Event::Do(Effect::Message { channel, text }));
    }
    Ok(outcome)
}

fn crashes(_: Outcome) -> Result<Outcome, HarnessError> {
    Err(HarnessError::Crashed { status: "signal 11".to_owned(), stderr: EVIL.to_owned() })
}

fn suite() -> Suite {
    Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"))
        .unwrap_or_else(|errors| panic!("{}", errors.join("\n")))
}

pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report").join(name);
    let _absent = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// The report of a controller on some rules.
fn reported<T>(controller: &dyn Adapter, only: &[String], made: impl Fn(&Report<'_>) -> T) -> T {
    let suite = suite();
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let plan =
        Plan { suite: &suite, edition, only, jobs: NonZero::<usize>::MIN, scope: Scope::Full };
    let run: Run<'_> = certify(plan, controller, &|| {});
    let header = Header::of(plan, controller, Shard::WHOLE);
    let header = Header { controller: EVIL.to_owned(), version: EVIL.to_owned(), ..header };
    let notes = vec![EVIL.to_owned()];
    made(&Report { notes, ..Report::of(&suite, &run, header) })
}

/// A controller that departs in words that mean harm, and crashes with them.
fn evil() -> (Meddled, Vec<String>) {
    let of: &[Meddle] = &[("m73", crashes), ("m70", departs)];
    let observables = Capabilities::everything("meddled", "1");
    (Meddled { model: Reference::default(), observables, of }, vec!["saved-state.f".to_owned()])
}

#[test]
fn controller_text_is_escaped_in_every_report() {
    let (controller, only) = evil();
    let texts = reported(&controller, &only, |report| {
        let counts = report.counts();
        assert!(counts.diverges > 3 && counts.crash > 3, "{counts:?}");
        let page = html::html(report).expect("a page");
        (terminal::terminal(report, Detail::Everything), junit::junit(report).expect("XML"), page)
    });
    let (text, xml, page) = texts;
    let plain = anstream::adapter::strip_str(&text).to_string();
    assert!(plain.contains("\\u001b]0;owned\\u0007"), "it is written out");
    // What is left of orders to a terminal are the colours of the report itself.
    assert!(!text.contains("\u{1b}]") && !text.contains("\u{1b}[2J") && !text.contains('\u{7}'));
    for (name, report) in [("text", &plain), ("XML", &xml), ("page", &page)] {
        let orders = ['\u{7}', '\u{1b}', '\u{202e}'];
        assert!(!report.contains(orders), "{name}: it is read as it is written");
    }
    assert!(!xml.contains("<script") && xml.contains("&lt;script"), "{xml}");
    assert_eq!(page.matches("<script").count(), 1, "the page's own");
    let read = quick_junit::Report::deserialize_from_str(&xml).expect("it is XML");
    assert!(read.test_suites.iter().any(|suite| suite.errors > 3 && suite.failures > 3));
    let chapter = read.test_suites.first().expect("a chapter");
    let has = |name| chapter.properties.iter().any(|property| property.name.as_str() == name);
    assert!(["controller", "version", "edition", "suite"].into_iter().all(has), "{chapter:?}");
}

/// A controller that refuses nothing breaks each rule that refuses: a finding each.
#[test]
fn each_divergence_belongs_to_one_finding_in_every_report() {
    fn accepts(mut outcome: Outcome) -> Result<Outcome, HarnessError> {
        if matches!(outcome.end, End::Fault(_)) {
            outcome.end = End::ProgramEnd;
        }
        Ok(outcome)
    }
    let observables = Capabilities::everything("accepts", "1");
    let controller = Meddled { model: Reference::default(), observables, of: &[("", accepts)] };
    let only = ["modal-groups".to_owned(), "feed".to_owned()];
    reported(&controller, &only, |report| {
        let findings = report.findings();
        let cases = findings.iter().flat_map(Finding::divergent).count();
        assert_eq!(cases, report.divergences().len(), "each is somewhere");
        assert!(findings.len() < cases / 2, "{} of {cases}", findings.len());
        let first = findings.first().expect("a finding");
        assert!(findings.iter().all(|finding| finding.severity == Severity::Accepted));
        let hanging = findings.iter().map(|finding| finding.divergent().count());
        assert!(hanging.is_sorted_by(|more, less| more >= less), "what most hangs on first");
        for finding in findings {
            let sizes = finding.cases.iter().map(|(case, _)| case.program.len());
            assert!(sizes.is_sorted(), "the smallest program first");
            assert!(finding.cases.iter().all(|(case, _)| Some(case.rule) == finding.rule));
        }
        let page = html::html(report).expect("a page");
        assert_eq!(page.matches("<section class=\"kind\"").count(), findings.len());
        let named = ["<article", "<li class=\"row\""].map(|one| page.matches(one).count());
        assert_eq!(named[0] + named[1], cases, "every one has its card or is named");
        let text = terminal::terminal(report, Detail::Findings);
        let summary = markdown::markdown(report);
        for told in [&page, &text, &summary] {
            assert!(told.contains(&size(first)), "{}: {told}", size(first));
        }
    });
}

#[test]
fn smallest_program_of_a_divergence_is_found_on_request() {
    let (controller, only) = evil();
    let suite = suite();
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let only = [format!("{}eed", only[0])];
    let plan = Plan {
        suite: &suite,
        edition,
        only: &only,
        jobs: NonZero::<usize>::MIN,
        scope: Scope::Full,
    };
    let mut each = |_: &CaseResult<'_>| ControlFlow::Continue(());
    let twice = RepeatSampling::default();
    let run_options = RunOptions {
        shard: Shard::WHOLE,
        options: controller.options(),
        finished: Vec::new(),
        repeat: twice,
        shrink_attempts: 200,
        model: None,
        on_result: &mut each,
    };
    let run = run_plan(plan, &controller, run_options);
    let shrunk = |case: &CaseResult<'_>| {
        let smallest = case.verdict.divergence()?.shrunk.clone()?;
        Some((smallest, case.program.len()))
    };
    let shrunk: Vec<_> = run.cases.iter().filter_map(shrunk).collect();
    assert!(!shrunk.is_empty());
    for (smallest, size) in shrunk {
        assert!(smallest.contains("m70") && smallest.len() < size, "{smallest}");
    }
}

#[test]
fn the_published_schema_is_what_the_types_generate_and_reports_fit_it() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../report/schema/report.json");
    let schema = json::schema();
    let now = serde_json::to_string_pretty(&schema).expect("a schema is JSON") + "\n";
    if std::env::var_os("GAUGEBLOCK_BLESS").is_some() {
        std::fs::write(&path, &now).expect("schema/ can be written");
    }
    let published = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(published == now, "{}: run with GAUGEBLOCK_BLESS=1", path.display());
    let printed = gaugeblock(&["schema", "report"]).stdout;
    let printed: Value = serde_json::from_slice(&printed).expect("JSON");
    assert_eq!(Some(&printed), Some(schema.as_value()));

    let validator = jsonschema::validator_for(schema.as_value()).expect("a schema");
    let (controller, only) = evil();
    let document = reported(&controller, &only, json::json);
    let wrong: Vec<_> = validator.iter_errors(&document).map(|error| error.to_string()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let mut other = document.clone();
    other["cases"][0]["verdict"] = "excellent".into();
    assert!(!validator.is_valid(&other), "the schema lets everything through");
    let stored = Stored::read(&document.to_string()).expect("it can be read again");
    assert_eq!(stored.cases.len(), document["cases"].as_array().expect("cases").len());
}

#[test]
fn a_report_of_another_version_is_refused() {
    let here = folder("version-0");
    for (text, words) in [
        ("{\"gaugeblock\":\"report\",\"schema\":0,\"cases\":[]}", "version 0"),
        ("{\"gaugeblock\":\"fuzz\",\"schema\":1}", "`fuzz`"),
    ] {
        std::fs::write(here.join("report.json"), text).expect("a file");
        let path = here.to_str().expect("UTF-8");
        for call in [
            vec!["report", "merge", path],
            vec!["certify", "--controller", "reference", "--baseline", path],
        ] {
            let output = gaugeblock(&call);
            let message = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{message}");
            assert!(message.contains(words) && message.contains("hint:"), "{message}");
        }
    }
}

fn verdicts(folder: &Path) -> Vec<(String, String, String)> {
    let text = std::fs::read_to_string(folder.join("report.json")).expect("a report");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let cases = report["cases"].as_array().expect("cases").iter();
    cases.map(|case| (word(&case["rule"]), word(&case["case"]), word(&case["verdict"]))).collect()
}

/// A toy that accepts every code.
#[test]
fn known_and_waived_divergences_do_not_fail() {
    let (before, now, merged) = (folder("before"), folder("now"), folder("merged"));
    let [before_path, now_path, merged_path] =
        [&before, &now, &merged].map(|folder| folder.to_str().expect("UTF-8"));
    let adapter = Path::new(env!("CARGO_MANIFEST_DIR")).join("../adapter/templates/template.py");
    let toy = folder("toy").join("toy.py");
    let text = std::fs::read_to_string(&adapter).expect("the template");
    let alarm =
        "{\"end\": \"fault\", \"block\": block, \"message\": f\"no such code: G{number:g}\"}";
    assert!(text.contains(alarm));
    std::fs::write(&toy, text.replace(alarm, "{\"end\": \"program_end\"}")).expect("a toy");
    let toy = format!("exec:python3 {}", toy.display());
    let call = [
        "certify",
        "--controller",
        &toy,
        "--edition",
        "linuxcnc-2.9",
        "--only",
        "modal-groups.g-code-out",
    ];
    let status = |more: &[&str]| gaugeblock(&[&call[..], more].concat()).status.code();
    assert_eq!(status(&["--report", before_path]), Some(1));
    let departing: Vec<_> =
        verdicts(&before).into_iter().filter(|(_, _, word)| word == "diverges").collect();
    assert!(departing.len() > 1, "{departing:?}");

    assert_eq!(status(&["--baseline", before_path, "--report", now_path]), Some(0));
    let known = verdicts(&now).into_iter().filter(|(_, _, word)| word == "known").count();
    assert_eq!(known, departing.len());

    let (rule, case, _) = &departing[0];
    let waivers = folder("waivers").join("waivers.toml");
    let text = format!(
        "[[waiver]]\nrule = \"{rule}\"\ncase = \"{case}\"\nreason = \"agreed\"\nowner = \"Ann\"\nexpires = \"2027-01-31\"\n"
    );
    std::fs::write(&waivers, text).expect("waivers");
    let waivers = waivers.to_str().expect("UTF-8");
    let more = ["--waivers", waivers, "--today", "2027-01-31", "--report", now_path];
    assert_eq!(status(&more), Some(1), "the others are new");
    let words = |word: &str| verdicts(&now).iter().filter(|(_, _, own)| own == word).count();
    assert_eq!((words("waived"), words("diverges")), (1, departing.len() - 1));

    // What a part was held against is no part of it.
    let output = gaugeblock(&["report", "merge", now_path, "--report", merged_path]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(verdicts(&merged), verdicts(&before));
}

/// The template, with all that it can do left out where it is mute.
fn template(name: &str, mute: bool) -> String {
    const RUN: &str = "def run(scenario):\n";
    let adapter = Path::new(env!("CARGO_MANIFEST_DIR")).join("../adapter/templates/template.py");
    let text = std::fs::read_to_string(&adapter).expect("the template");
    assert!(text.contains(RUN));
    let without = format!("{RUN}    raise Unsupported('everything')\n");
    let toy = folder(name).join("adapter.py");
    std::fs::write(&toy, if mute { text.replace(RUN, &without) } else { text }).expect("a toy");
    format!("exec:python3 {}", toy.display())
}

/// Calls `certify` on one rule, with a report: the exit status, what is printed, and the text of a file of the report.
fn certified(controller: &str, into: &Path, more: &[&str]) -> (Option<i32>, String, [String; 3]) {
    let into_path = into.to_str().expect("UTF-8");
    let only = "modal-groups.g-code-out-of-range";
    let call = ["certify", "--controller", controller, "--edition", "linuxcnc-2.9", "--only", only];
    let output = gaugeblock(&[&call[..], &["--report", into_path], more].concat());
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let read = |name: &str| std::fs::read_to_string(into.join(name)).expect("a report");
    let files = ["report.html", "summary.md", "report.json"].map(read);
    (output.status.code(), said, files)
}

#[test]
fn nothing_judged_is_not_certified() {
    const SAYS: &str = "Nothing was judged: nothing is certified.";
    let (mute, into) = (template("mute", true), folder("nothing-judged"));
    let own = folder("nothing-judged-before");
    let (status, said, [page, summary, json]) = certified(&mute, &own, &[]);
    assert_eq!(status, Some(3), "{said}");
    assert!(said.ends_with("nothing was judged: nothing is certified\n"), "{said}");
    assert!(summary.starts_with(&format!("## {SAYS}\n")), "{summary}");
    assert!(page.contains(&format!("<p class=\"says inconclusive\">{SAYS}</p>")), "{page}");
    assert!(!page.contains("<p class=\"pass\">"), "nothing on the page is green");
    let json: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((&json["exit_status"], &json["counts"]["diverges"]), (&3.into(), &0.into()));
    assert_eq!(json["counts"]["unsupported"], json["counts"]["cases"]);

    // That it was so before makes it no better.
    let own = own.to_str().expect("UTF-8");
    let (status, said, [page, ..]) = certified(&mute, &into, &["--baseline", own]);
    assert_eq!(status, Some(3), "{said}");
    assert!(page.contains(SAYS) && !page.contains("<p class=\"pass\">"));
    // One case that is judged is something; that others are unsupported is counted.
    let (status, said, _) = certified(&template("some", false), &into, &[]);
    assert_eq!(status, Some(0), "{said}");
    assert!(said.ends_with("as the documents say\n"), "{said}");
}

#[test]
fn pass_that_is_not_judged_now_is_a_change() {
    let (before, now) = (folder("passed"), folder("passed-no-more"));
    let (status, ..) = certified(&template("whole", false), &before, &[]);
    assert_eq!(status, Some(0));
    let passed = verdicts(&before).into_iter().filter(|(_, _, word)| word == "pass");
    let passed: Vec<_> = passed.collect();
    assert!(!passed.is_empty());
    let path = before.to_str().expect("UTF-8");
    let call = ["--baseline", path];
    let (status, said, [page, summary, _]) = certified(&template("gone", true), &now, &call);
    assert_eq!(status, Some(1), "{said}");
    let count = format!("0 new, {} changed, 0 fixed", passed.len());
    assert!(summary.contains(&count), "{summary}");
    for (rule, case, _) in &passed {
        let told = format!("**changed** ` {rule} / {case} `: was ` pass `, now ` unsupported: ");
        assert!(summary.contains(&told), "{told:?} is not in: {summary}");
    }
    assert!(!page.contains("nothing that is known has changed"), "{page}");
}

#[test]
fn unsuitable_expectations_are_a_usage_error() {
    let (here, now) = (folder("coolant"), folder("coolant-now"));
    let [path, now_path] = [&here, &now].map(|folder| folder.to_str().expect("UTF-8"));
    let call = ["certify", "--controller", "reference", "--only", "coolant"];
    let certify = |more: &[&str]| {
        let output = gaugeblock(&[&call[..], more].concat());
        let [said, why] =
            [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
        (output.status.code(), said, why)
    };
    assert_eq!(certify(&["--report", path]).0, Some(0));
    assert_eq!(certify(&["--baseline", path]).0, Some(0));
    let (status, _, why) = certify(&["--baseline", path, "--edition", "linuxcnc-2.9"]);
    assert_eq!(status, Some(2), "{why}");
    assert!(
        why.contains("not of reference against linuxcnc-2.9") && why.contains("hint:"),
        "{why}"
    );
    let output = gaugeblock(&["report", "merge", path, "--baseline", path, "--report", now_path]);
    assert_eq!(output.status.code(), Some(0));
    let json = std::fs::read_to_string(here.join("report.json")).expect("a report");
    let versions = json.replacen("\"version\": \"", "\"version\": \"older than ", 1);
    assert_ne!(versions, json);
    std::fs::write(now.join("report.json"), versions).expect("a report");
    let (status, said, why) = certify(&["--baseline", now_path]);
    assert_eq!(status, Some(0), "{why}");
    assert!(said.contains("note the baseline is of version older than "), "{said}");

    let waivers = now.join("waivers.toml");
    let waives = |rule: &str| {
        let text = format!(
            "[[waiver]]\nrule = \"{rule}\"\nreason = \"a\"\nowner = \"Ann\"\nexpires = \"2027-01-31\"\n"
        );
        std::fs::write(&waivers, text).expect("waivers");
        certify(&["--waivers", waivers.to_str().expect("UTF-8"), "--today", "2027-01-01"])
    };
    let (status, _, why) = waives("coolant.no-such");
    assert_eq!(status, Some(2), "{why}");
    assert!(
        why.contains("coolant.no-such: there is no such rule") && why.contains("hint:"),
        "{why}"
    );
    assert_eq!(waives("saved-state.feed").0, Some(0), "nobody has asked for that rule");
    assert_eq!(waives("coolant.off").0, Some(1), "there is nothing to waive");
}

#[test]
fn the_page_of_two_thousand_divergences_is_small_enough() {
    let suite = suite();
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let traces = "block main.ngc:1\n  state motion=none\n".repeat(600);
    let departed = |rule: &str, case: &str| {
        let why = serde_json::json!({
            "found": "x", "assertion": ["a", "b"], "divergence": "main.ngc:1: motion: expected none, found feed",
            "explanation": [], "program": "", "traces": { "expected": traces, "found": traces },
        });
        let case = serde_json::json!({
            "rule": rule, "case": case, "verdict": "diverges", "why": why, "compared": {}, "masked": [], "repeated": false,
        });
        serde_json::from_value::<StoredCase>(case).expect("a case")
    };
    let all = suite.rules.iter().flat_map(|rule| rule.cases.iter().map(move |case| (rule, case)));
    let cases = all.take(2000).map(|(rule, case)| {
        departed(&rule.id, &case.name).result(&suite).expect("a case of the suite")
    });
    let run = Run {
        edition,
        scope: Scope::Full,
        cases: cases.collect(),
        not_applicable: Vec::new(),
        fingerprint: None,
    };
    let plan =
        Plan { suite: &suite, edition, only: &[], jobs: NonZero::<usize>::MIN, scope: Scope::Full };
    let header = Header::of(plan, &Reference::default(), Shard::WHOLE);
    let page = html::html(&Report::of(&suite, &run, header)).expect("a page");
    let (cards, others) =
        (page.matches("<article").count(), page.matches("<li class=\"row\"").count());
    assert_eq!(cards + others, 2000, "every one has its card or is named: {cards}");
    assert!(page.len() < 3 << 20, "{} bytes", page.len());
    assert!(page.contains("both traces are in report.json"), "and says what is not on it");
}

#[test]
fn links_of_the_page_lead_to_findings_rules_and_chapters() {
    let (controller, only) = evil();
    let page = reported(&controller, &only, |report| html::html(report).expect("a page"));
    let links: Vec<&str> =
        page.split("href=\"#").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    for link in &links {
        // A filter does not name an element.
        let is_filter = link.contains('=');
        assert!(is_filter || page.contains(&format!("id=\"{link}\"")), "{link}");
    }
    for beginning in ["finding-1", "rule-", "q=", "chapters"] {
        assert!(links.iter().any(|link| link.starts_with(beginning)), "{beginning}: {links:?}");
    }
    assert!(page.contains("--only &#x27;"), "the call that runs a case again");
}

/// Runs the page's own script where there is a browser.
#[test]
fn the_page_runs_in_a_browser_without_an_error() {
    let Some(browser) = browser() else { return };
    let (controller, only) = evil();
    let page = reported(&controller, &only, |report| html::html(report).expect("a page"));
    let here = folder("browser");
    let file = here.join("report.html");
    std::fs::write(&file, &page).expect("a page");
    let page = rendered(browser, &here, &format!("{}#q=m70&v=diverges", file.display()));
    assert!(!page.contains("<title>owned"), "and no other script did");
    assert!(page.contains(" hidden=\"\""), "it filters");
}
