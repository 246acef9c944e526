//! Any answer is judged: numbers that are not finite are results of the controller, with a verdict and in each report.

use std::num::NonZero;
use std::path::Path;

use gaugeblock_adapter::exec::Exec;
use gaugeblock_runner::certify::{Plan, Scope, certify};
use gaugeblock_runner::language::check_program;
use gaugeblock_suite::Suite;

use crate::command::gaugeblock;
use crate::template::{changed, file, limits, text};

/// A rule whose cases the template runs; all of them pass.
const RULE: &str = "motion.mode-holds";

/// The template, with another text in place of each X coordinate in an answer.
fn answering(name: &str, coordinate: &str) -> String {
    let print = "    print(json.dumps({\"id\": request[\"id\"], **answer}), flush=True)\n";
    let meddled = format!(
        "    print(re.sub(r'\"x\": [-+.0-9e]+', {coordinate:?}, json.dumps({{\"id\": request[\"id\"], **answer}}))\
         .replace('{{, ', '{{'), flush=True)\n"
    );
    changed(&format!("any-answer-{name}.py"), &[(print, &meddled)])
}

/// The suite.
pub(crate) fn suite() -> Suite {
    Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite")
}

/// The words of the verdicts on the cases of the rule that are run, and what was found.
pub(crate) fn verdicts(suite: &Suite, command: &str) -> Vec<(&'static str, String)> {
    let controller = Exec::start(command, limits()).expect("the adapter starts");
    let controller = controller.check_language_by(check_program);
    let edition = suite.edition("linuxcnc-2.9").expect("the edition");
    let only = [RULE.to_owned()];
    let plan =
        Plan { suite, edition, only: &only, jobs: NonZero::<usize>::MIN, scope: Scope::Full };
    let cases = certify(plan, &controller, &|| {}).cases.into_iter();
    cases.map(|case| (case.verdict.word(), case.verdict.to_string())).collect()
}

#[test]
fn each_number_gets_a_verdict() {
    let suite = suite();
    let judged = |command: &str| {
        let mut verdicts = verdicts(&suite, command);
        verdicts.retain(|(word, _)| *word != "unsupported");
        verdicts
    };
    let plain = judged(&changed("any-answer.py", &[]));
    assert!(!plain.is_empty() && plain.iter().all(|(word, _)| *word == "pass"), "{plain:?}");
    for (name, coordinate, found) in [
        ("python-nan", "\"x\": NaN", "xNaN"),
        ("text-nan", "\"x\": \"nan\"", "xNaN"),
        ("javascript-nan", "\"x\": null", "xNaN"),
        ("python-inf", "\"x\": -Infinity", "x-inf"),
        ("text-inf", "\"x\": \"inf\"", "xinf"),
        ("too-great", "\"x\": 1e400", "xinf"),
        ("too-small", "\"x\": 1e-400", ""),
        ("minus-zero", "\"x\": -0", ""),
        ("missing", "", ""),
    ] {
        let judged = judged(&answering(name, coordinate));
        assert_eq!(judged.len(), plain.len(), "{name}: {judged:?}");
        let differs =
            judged.iter().filter(|(word, why)| *word == "diverges" && why.contains(found));
        assert!(differs.count() > 0, "{name}: {judged:?}");
        let is_judged = |word: &str| matches!(word, "pass" | "diverges");
        assert!(judged.iter().all(|(word, _)| is_judged(word)), "{name}: {judged:?}");
    }
}

/// A template that never refuses, and its declaration of that.
fn never_refusing(name: &str, declared: &str) -> String {
    let accepts = ("if letter == \"g\" and number > 99.9:", "if False:");
    let runs_any = ("if letter not in \"xyzf\" and", "if letter not in \"xyzfg\" and");
    let without_mode = ("if moved and (motion[1]", "if False and (motion[1]");
    let moves = ("if letter in \"xyz\"}", "if letter in \"xyz\" and motion[1]}");
    let any_language = ("\"language\": {", "\"another\": {");
    let pins = ("\"pins\": []", declared);
    changed(name, &[accepts, runs_any, without_mode, moves, any_language, pins])
}

#[test]
fn divergence_that_is_not_a_number_is_printed_and_can_be_expected() {
    let controller = format!("exec:{}", answering("gate", "\"x\": NaN"));
    let expectations = file("any-answer.toml", "");
    std::fs::remove_file(&expectations).expect("the file can be removed");
    let folder = Path::new(&expectations).with_file_name("any-answer-report");
    let _first_time = std::fs::remove_dir_all(&folder);
    let report = folder.to_str().expect("a path in UTF-8");
    let call = ["certify", "--controller", &controller, "--only", RULE];
    let first = gaugeblock(
        &[&call[..], &["--write-expectations", &expectations, "--report", report]].concat(),
    );
    assert!(text(&first.stdout).contains("xNaN"), "{}{}", text(&first.stdout), text(&first.stderr));
    for name in ["report.json", "junit.xml", "report.html", "summary.md"] {
        let page = std::fs::read_to_string(folder.join(name)).expect(name);
        assert!(page.contains("xNaN"), "{name}: {page}");
    }
    let gate = gaugeblock(&[&call[..], &["--expectations", &expectations]].concat());
    assert_eq!(gate.status.code(), Some(0), "{}{}", text(&gate.stdout), text(&gate.stderr));
}

#[test]
fn case_about_a_refusal_is_unsupported_on_a_controller_that_never_refuses() {
    let only = ["certify", "--only", "modal-groups.g-code-out-of-range", "--controller"];
    for (name, declared, status, words) in [
        ("never-refuses.py", "\"pins\": [], \"refusals\": False", 0, "never refuses"),
        ("refuses-nothing.py", "\"pins\": []", 1, "diverges modal-groups.g-code-out-of-range"),
    ] {
        let command = never_refusing(name, declared);
        let output = gaugeblock(&[&only[..], &[&format!("exec:{command}"), "-v"]].concat());
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(status), "{name}: {said}{}", text(&output.stderr));
        assert!(said.contains(words), "{name}: {said}");
    }
}

#[test]
fn adapter_check_requires_a_refusal_unless_there_is_none() {
    let refuses = "\"pins\": [], \"refusals\": False";
    for (name, command, status, words) in [
        ("refuses-none", never_refusing("checked-never.py", refuses), 0, "never refuses a block"),
        ("no-word", never_refusing("checked.py", "\"pins\": []"), 1, "expected a fault"),
        (
            "refuses-all-the-same",
            changed("checked-refuses.py", &[("\"pins\": []", refuses)]),
            1,
            "expected no fault: `observables.refusals` is false",
        ),
    ] {
        let output = gaugeblock(&["adapter", "check", &command]);
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(status), "{name}: {said}{}", text(&output.stderr));
        assert!(said.contains(words), "{name}: {said}");
    }
}

#[test]
fn reason_of_an_expectation_is_kept_and_reported() {
    let controller = format!("exec:{}", answering("reasons", "\"x\": NaN"));
    let expectations = file("any-answer-reasons.toml", "");
    let call = ["certify", "--controller", &controller, "--only", RULE];
    let write = [&call[..], &["--write-expectations", &expectations]].concat();
    let first = gaugeblock(&write);
    assert_eq!(first.status.code(), Some(1), "{}", text(&first.stderr));
    let written = std::fs::read_to_string(&expectations).expect("the file");
    let reason = "reason = \"It knows no coordinates.\"";
    let with_reason = written.replacen("\nfound", &format!("\n{reason}\nfound"), 1);
    std::fs::write(&expectations, with_reason).expect("the file");
    gaugeblock(&write);
    let kept = std::fs::read_to_string(&expectations).expect("the file");
    assert_eq!(kept.matches(reason).count(), 1, "{kept}");
    let folder = Path::new(&expectations).with_file_name("any-answer-reasons");
    let report = folder.to_str().expect("a path in UTF-8");
    let gate =
        [&call[..], &["--expectations", &expectations, "--report", report, "--verbose"]].concat();
    let gate = gaugeblock(&gate);
    assert_eq!(gate.status.code(), Some(0), "{}{}", text(&gate.stdout), text(&gate.stderr));
    let source = "listed in the expectations: It knows no coordinates.";
    assert!(text(&gate.stdout).contains(source), "{}", text(&gate.stdout));
    for name in ["report.json", "junit.xml", "report.html", "report.txt"] {
        let page = std::fs::read_to_string(folder.join(name)).expect(name);
        assert!(page.contains(source), "{name}");
    }
    // A file with something else is not written over.
    std::fs::write(&expectations, "controller = 5\n").expect("the file");
    let refused = gaugeblock(&write);
    assert_eq!(refused.status.code(), Some(2), "{}", text(&refused.stderr));
    assert!(text(&refused.stderr).contains("--write-expectations"), "{}", text(&refused.stderr));
}
