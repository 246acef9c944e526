//! `certify --assertions-only`: the verdict looks at the assertions of a case and at nothing else, and says so.

use std::num::NonZero;
use std::path::Path;

use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::Reference;
use gaugeblock_report::{Header, Report};
use gaugeblock_runner::certify::{Plan, Run, Scope, Verdict, certify};
use gaugeblock_runner::shard::Shard;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::{End, Outcome, Scenario};
use serde_json::Value;

use crate::command::gaugeblock;
use crate::report::folder;

/// The model, with a change in each outcome.
#[derive(Debug)]
struct Changed {
    model: Reference,
    observables: Capabilities,
    change: fn(&mut Outcome),
}

impl Adapter for Changed {
    fn capabilities(&self) -> &Capabilities {
        &self.observables
    }

    fn supports(&self, scenario: &Scenario) -> Result<(), String> {
        self.model.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> Result<Outcome, HarnessError> {
        let mut outcome = self.model.run(scenario)?;
        (self.change)(&mut outcome);
        Ok(outcome)
    }
}

/// Runs a few rules in a scope: the exit status, and the result.
fn certified<T>(change: fn(&mut Outcome), scope: Scope, result: impl Fn(&Run<'_>) -> T) -> (u8, T) {
    let suite = Suite::read(&gaugeblock_embedded_suite::files().expect("the suite"));
    let suite = suite.unwrap_or_else(|errors| panic!("{}", errors.join("\n")));
    let edition = suite.edition("linuxcnc-2.9").expect("an edition of the suite");
    let only = ["coolant", "splines.plane", "splines.xy-only"].map(str::to_owned);
    let plan = Plan { suite: &suite, edition, only: &only, jobs: NonZero::<usize>::MIN, scope };
    let observables = Capabilities::everything("changed", "1");
    let controller = Changed { model: Reference::default(), observables, change };
    let run = certify(plan, &controller, &|| {});
    let header = Header::of(plan, &controller, Shard::WHOLE);
    (Report::of(&suite, &run, header).exit_status(), result(&run))
}

#[test]
fn unasserted_difference_fails_the_full_scope_alone() {
    fn sets_a_parameter(outcome: &mut Outcome) {
        if let Some(parameters) = &mut outcome.parameters {
            parameters.0.insert(4999, 1.0);
        }
    }
    let verdicts = |run: &Run<'_>| {
        let passing = run.cases.iter().filter(|case| case.verdict == Verdict::Pass);
        let differing =
            run.cases.iter().filter(|case| matches!(case.verdict, Verdict::SideDifference(_)));
        (run.cases.len(), passing.count(), differing.count())
    };
    let (status, (all, passing, _)) = certified(sets_a_parameter, Scope::AssertionsOnly, verdicts);
    assert_eq!((status, passing), (0, all));
    let (status, (_, _, differing)) = certified(sets_a_parameter, Scope::Full, verdicts);
    assert_eq!(status, 1);
    assert!(differing > 10, "{differing}");
}

#[test]
fn failing_assertion_diverges_in_both_scopes() {
    fn refuses_nothing(outcome: &mut Outcome) {
        if matches!(outcome.end, End::Fault(_)) {
            outcome.end = End::ProgramEnd;
        }
    }
    let diverging = |run: &Run<'_>| {
        let diverging =
            run.cases.iter().filter(|case| matches!(case.verdict, Verdict::Diverges(_)));
        diverging.map(|case| format!("{} / {}", case.rule.id, case.name)).collect::<Vec<_>>()
    };
    let (status, alone) = certified(refuses_nothing, Scope::AssertionsOnly, diverging);
    assert_eq!(status, 1);
    assert!(alone.len() > 10, "{alone:?}");
    assert_eq!(certified(refuses_nothing, Scope::Full, diverging), (1, alone));
}

/// Calls `certify` on a few cases: the exit status, and what was printed.
fn call(into: &Path, more: &[&str]) -> (Option<i32>, String) {
    let into = into.to_str().expect("UTF-8");
    let call = ["certify", "--controller", "reference", "--only", "coolant", "--report", into];
    let output = gaugeblock(&[&call[..], more].concat());
    let said = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8_lossy(&said).into_owned())
}

#[test]
fn every_report_names_the_scope() {
    let (own, full) = (folder("assertions-only"), folder("assertions-and-all"));
    let (status, said) = call(&own, &["--assertions-only"]);
    assert_eq!(status, Some(0), "{said}");
    assert!(said.starts_with("reference ") && said.contains(", assertions only\n"), "{said}");
    assert!(said.ends_with("every judged assertion holds; nothing else was compared\n"), "{said}");
    assert!(!said.contains("passes these profiles"), "{said}");
    let (status, said) = call(&full, &[]);
    assert_eq!(status, Some(0), "{said}");
    assert!(!said.contains("assertions only"), "{said}");
    for file in ["report.html", "junit.xml", "report.txt", "summary.md"] {
        let names = |folder: &Path| {
            let text = std::fs::read_to_string(folder.join(file)).expect("a report");
            text.contains(", assertions only")
        };
        assert!(names(&own) && !names(&full), "{file}");
    }
    for (folder, scope) in [(&own, "assertions-only"), (&full, "full")] {
        let text = std::fs::read_to_string(folder.join("report.json")).expect("a report");
        let json: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(json["scope"], scope);
        let profiles = json["profiles"].as_array().expect("profiles");
        assert_eq!(profiles.is_empty(), scope != "full", "no profile is passed by assertions only");
    }
}

#[test]
fn reports_of_two_scopes_are_not_mixed() {
    let (one, two, own) = (folder("scope-1"), folder("scope-2"), folder("scope-own"));
    let (baseline, merged) = (folder("scope-baseline"), folder("scope-merged"));
    assert_eq!(call(&one, &["--shard", "1/2"]).0, Some(0));
    assert_eq!(call(&two, &["--shard", "2/2"]).0, Some(0));
    assert_eq!(call(&own, &["--shard", "2/2", "--assertions-only"]).0, Some(0));
    let [one, two, own] = [&one, &two, &own].map(|folder| folder.to_str().expect("UTF-8"));
    let refused = |arguments: &[&str], words: &str| {
        let output = gaugeblock(arguments);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(words), "{words:?} is not in: {message}");
    };
    let into = merged.to_str().expect("UTF-8");
    refused(
        &["report", "merge", one, own, "--report", into],
        "scope \"full\" and \"assertions only\"",
    );
    assert!(!merged.join("report.json").exists());
    assert_eq!(gaugeblock(&["report", "merge", one, two]).status.code(), Some(0));

    let certify = ["certify", "--controller", "reference", "--only", "coolant"];
    let with = |more: &[&'static str]| [&certify[..], more].concat();
    assert_eq!(call(&baseline, &["--assertions-only"]).0, Some(0));
    let baseline = baseline.to_str().expect("UTF-8");
    let same = [&with(&["--assertions-only", "--baseline"])[..], &[baseline]].concat();
    assert_eq!(gaugeblock(&same).status.code(), Some(0));
    let other = [&with(&["--baseline"])[..], &[baseline]].concat();
    refused(&other, "the scope of this baseline is \"assertions only\"");
    refused(
        &["suite", "matrix", "--report", &format!("{baseline}/report.json")],
        "assertions only",
    );
    for claim in
        [["--profile", "modal-save"], ["--write-expectations", "x.toml"], ["--shrink", "3"]]
    {
        refused(&[&with(&["--assertions-only"])[..], &claim].concat(), "cannot be used with");
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../expectations/rs274-2.9.toml");
    let file = file.to_str().expect("UTF-8");
    let listed = [&with(&["--assertions-only", "--expectations"])[..], &[file]].concat();
    refused(&listed, "--expectations do not apply");
}
