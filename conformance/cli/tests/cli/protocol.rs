//! The adapter protocol: the page and the schemas hold, and whatever an adapter does, the run is whole and nothing is
//! left behind.

use std::process::Command;
use std::time::Duration;

use gaugeblock_adapter::exec::{Exec, Limits};
use gaugeblock_adapter::protocol::{Answer, Request};
use gaugeblock_runner::certify::{RepeatSampling, Verdict};
use gaugeblock_runner::language::check_program;
use gaugeblock_suite::Suite;

use crate::command::gaugeblock;
use crate::template::{LOOP, TEMPLATE, changed, file, limits, text, verdicts_on};

pub(crate) const PAGE: &str = include_str!("../../../adapter/PROTOCOL.md");
const TEMPLATE_C: &str = include_str!("../../../adapter/templates/template.c");
const TEMPLATE_CPP: &str = include_str!("../../../adapter/templates/template.cpp");
const TEMPLATE_RUST: &str = include_str!("../../../adapter/templates/template.rs");

#[test]
fn the_examples_of_the_page_are_requests_and_answers() {
    let blocks = PAGE.split("```json\n").skip(1).filter_map(|rest| rest.split("```").next());
    let mut read = 0;
    for line in blocks.flat_map(str::lines) {
        let value: serde_json::Value = serde_json::from_str(line).expect(line);
        if value["op"] == "something-new" {
            assert!(serde_json::from_str::<Request>(line).is_err());
        } else if value.get("op").is_some() {
            let request: Request = serde_json::from_str(line).expect(line);
            let written = serde_json::to_string(&request).expect(line);
            assert_eq!(serde_json::from_str::<Request>(&written).expect(&written), request);
        } else {
            let answer: Answer = serde_json::from_str(line).expect(line);
            let written = serde_json::to_string(&answer).expect(line);
            // A number that is not a number differs from itself.
            let again: Answer = serde_json::from_str(&written).expect(&written);
            assert_eq!(serde_json::to_string(&again).expect(line), written);
        }
        read += 1;
    }
    assert!(read >= 25, "{read} examples");
}

/// Version 1 is frozen: what stands in it stays, and what comes is optional. Where the vocabulary has grown by
/// something optional, `gaugeblock adapter schema` prints what is to be committed.
#[test]
fn the_schemas_are_those_of_version_1() {
    for (what, frozen) in [
        ("request", include_str!("../../../adapter/schema/request.json")),
        ("answer", include_str!("../../../adapter/schema/answer.json")),
    ] {
        let output = gaugeblock(&["adapter", "schema", what]);
        let schema = text(&output.stdout);
        let other = schema.lines().zip(frozen.lines()).find(|(now, before)| now != before);
        assert_eq!((schema.len(), other), (frozen.len(), None), "{what}");
    }
}

/// Compiles a template.
fn compiled(name: &str, template: &str, compiler: &[&str]) -> String {
    let source = file(name, template);
    let binary = format!("{source}-binary");
    let built = Command::new(compiler[0])
        .args(&compiler[1..])
        .args(["-Wall", "-Werror", "-o", &binary, &source])
        .status();
    assert!(built.expect("a compiler").success());
    binary
}

/// Compiles the template in Rust, as a package with the libraries of this workspace.
fn compiled_by_cargo() -> String {
    let manifest = "[package]\nname = \"adapter\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\
                    [dependencies]\nserde_json = \"1\"\n[workspace]\n";
    let manifest = file("rust/Cargo.toml", manifest);
    file("rust/src/main.rs", TEMPLATE_RUST);
    file("rust/Cargo.lock", include_str!("../../../../Cargo.lock"));
    let built = Command::new(env!("CARGO"))
        .args(["build", "--offline", "--quiet", "--manifest-path", &manifest])
        .env_remove("CARGO_TARGET_DIR")
        .status();
    assert!(built.expect("cargo").success());
    manifest.replace("Cargo.toml", "target/debug/adapter")
}

#[test]
fn the_templates_are_short_and_nothing_is_wrong_with_them() {
    for template in [TEMPLATE, TEMPLATE_C, TEMPLATE_CPP, TEMPLATE_RUST] {
        assert!(template.lines().count() <= 60, "{}", template.lines().count());
    }
    for command in [
        changed("template.py", &[]),
        compiled("adapter.c", TEMPLATE_C, &["cc", "-std=c99"]),
        compiled("adapter.cpp", TEMPLATE_CPP, &["c++", "-std=c++17"]),
        compiled_by_cargo(),
    ] {
        let output = gaugeblock(&["adapter", "check", &command]);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{}{}",
            text(&output.stdout),
            text(&output.stderr)
        );
        let controller = format!("exec:{command}");
        let call =
            ["fuzz", "--controller", &controller, "--programs", "200", "--min-compared", "50"];
        let output = gaugeblock(&call);
        let said = text(&output.stdout);
        assert!(
            !said.contains("too little was compared") && said.contains(" programs in "),
            "{said}"
        );
    }
}

#[test]
fn check_has_a_hint_where_no_language_is_declared() {
    let check = |name: &str, changes: &[(&str, &str)]| {
        text(&gaugeblock(&["adapter", "check", &changed(name, changes)]).stdout)
    };
    let hint = "it declares no `language`";
    assert!(check("no-language.py", &[("\"language\": {", "\"another\": {")]).contains(hint));
    assert!(!check("with-language.py", &[]).contains(hint));
}

/// What an adapter does on one program, and the verdict of its case with its reason; it passes where nothing is said.
fn misbehaviours(text: &'static str) -> Vec<(&'static str, &'static str, &'static str)> {
    let entries = text.split("\n\n").skip(1);
    let entry = |text: &'static str| {
        let (name, rest) = text.split_once('\n').unwrap_or((text, ""));
        let (does, expected) = rest.split_once("  > ").unwrap_or((rest, ""));
        (name.trim(), does, expected.trim())
    };
    entries.map(entry).collect()
}

fn verdicts_of(
    command: &str,
    suite: &Suite,
    twice: RepeatSampling,
    seconds: u64,
) -> ((Verdict, bool), Vec<Verdict>) {
    let limits = Limits { time: Duration::from_secs(seconds), ..limits() };
    let controller =
        Exec::start(command, limits).unwrap_or_else(|error| panic!("{command}: {error}"));
    let controller = controller.check_language_by(check_program);
    verdicts_on(&controller, suite, twice)
}

/// Whether a verdict is the one that is expected: its word, and what its reason says.
fn is_right((verdict, alone): &(Verdict, bool), expected: &str) -> bool {
    let expected = if expected.is_empty() { "pass" } else { expected };
    let (word, reason) = expected.split_once(": ").unwrap_or((expected, ""));
    let (word, is_alone) = word.strip_suffix(", alone").map_or((word, false), |word| (word, true));
    let why = verdict.reason().unwrap_or_default();
    let is_inert = !why.contains(char::is_control);
    verdict.word() == word && *alone == is_alone && why.contains(reason) && is_inert
}

/// Runs the behaviours of a list: each gets its verdict, and the others theirs.
fn each_gets_its_verdict(list: &'static str, twice: RepeatSampling) {
    let suite =
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite");
    let (plain, usual) = verdicts_of(&changed("well-behaved.py", &[]), &suite, twice, 20);
    assert_eq!(plain, (Verdict::Pass, false));
    assert!(usual.iter().filter(|verdict| **verdict == Verdict::Pass).count() >= 3);
    let mut wrong = Vec::new();
    for (name, does, expected) in misbehaviours(list) {
        let when =
            "    if request['op'] == 'run' and 'g101' in request['scenario']['program']['main']:\n";
        let does = if does.trim().is_empty() { "  pass" } else { does };
        let does = does.replace("\n  ", "\n        ");
        let meddled = format!("{LOOP}{when}      {does}\n");
        // Only what hangs is waited for in vain.
        let hangs = does.contains("no end after") || expected.contains("no end after");
        let seconds = if hangs { 2 } else { 20 };
        let file = format!("{}-{}.py", name.replace(' ', "-"), twice.0);
        let (found, others) =
            verdicts_of(&changed(&file, &[(LOOP, &meddled)]), &suite, twice, seconds);
        if !is_right(&found, expected) || others != usual {
            let same = others == usual;
            wrong.push(format!(
                "{name}: {found:?}, not {expected}; the others are the same: {same}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let left = Command::new("pgrep").args(["-f", "sleep 4321"]).output().expect("pgrep");
    assert_eq!(text(&left.stdout), "", "processes are left behind");
}

#[test]
fn misbehaving_controller_does_not_change_other_verdicts() {
    let list = include_str!("misbehaviours.txt");
    assert!(misbehaviours(list).len() > 50, "{}", misbehaviours(list).len());
    each_gets_its_verdict(list, RepeatSampling(0));
}

#[test]
fn repeated_runs_find_a_nondeterministic_controller() {
    each_gets_its_verdict(include_str!("asked_twice.txt"), RepeatSampling(100));
}

#[test]
fn crash_is_not_a_pass() {
    let meddled = format!("{LOOP}    request['op'] == 'run' and sys.exit(3)\n");
    let controller = format!("exec:{}", changed("crashes.py", &[(LOOP, &meddled)]));
    let output = gaugeblock(&[
        "certify",
        "--controller",
        &controller,
        "--only",
        "modal-groups.g-code-out-of-range",
    ]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stdout));
    let said = text(&output.stdout);
    assert!(
        said.contains("ended without an answer (exit status 3, after the request `run`"),
        "{said}"
    );
    assert!(said.contains("crash modal-groups.g-code-out-of-range / g101"), "{said}");
}

#[test]
fn unusable_controller_is_refused_before_any_run() {
    for (name, changes, words) in [
        ("no-start.py", vec![("import json, re, sys\n", "raise SystemExit(7)\n")], "exit status 7"),
        (
            "silent.py",
            vec![(LOOP, "import time\ntime.sleep(60)\nfor request in []:\n")],
            "no answer to `hello` within 1 s",
        ),
        ("old.py", vec![("\"protocol\": 1,", "\"protocol\": 2,")], "version 2"),
        ("lacking.py", vec![("\"resolution\": 0.0, ", "")], "resolution"),
        (
            "coarse.py",
            vec![("\"resolution\": 0.0", "\"resolution\": 1e300")],
            "invalid `resolution`: 1e300; expected 0 to 0.1 millimetres or degrees",
        ),
        (
            "relative.py",
            vec![("\"resolution\": 0.0", "\"resolution\": 0.0, \"relative_resolution\": 0.5")],
            "invalid `relative_resolution`: 0.5; expected 0 to 1e-6",
        ),
        (
            "slow-clock.py",
            vec![("\"clock\": \"virtual\"", "\"clock\": {\"wall\": 1e300}")],
            "invalid `clock.wall`: 1e300; expected 0 to 1.0 seconds",
        ),
        (
            "carried.py",
            vec![("\"pins\": []", "\"pins\": [], \"carried\": {\"feed_rate\": 5.0}")],
            "invalid error of `feed_rate` in `observables.carried`: 5.0; expected 0 to 0.1",
        ),
        (
            "slip.py",
            vec![("\"motion\", \"position\"", "\"motion\", \"positon\"")],
            "invalid name \"positon\" in `observables.fields`: the vocabulary does not have it: did you mean \"position\"?",
        ),
        (
            "options.py",
            vec![(
                "\"clock\": \"virtual\"",
                "\"clock\": \"virtual\", \"options\": {\"no.such\": \"thing\"}",
            )],
            "no.such",
        ),
        (
            "edition.py",
            vec![("\"clock\": \"virtual\"", "\"clock\": \"virtual\", \"edition\": \"linuxcnc-9\"")],
            "linuxcnc-9",
        ),
    ] {
        let controller = format!("exec:{}", changed(name, &changes));
        // Whoever answers may take as long as a busy machine lets it.
        let limit = if name == "silent.py" { "1" } else { "60" };
        let output = gaugeblock(&["certify", "--controller", &controller, "--time-limit", limit]);
        let message = text(&output.stderr);
        let status = if name == "edition.py" { 2 } else { 3 };
        assert_eq!(output.status.code(), Some(status), "{name}: {message}");
        assert!(message.contains(words) && message.contains("hint:"), "{name}: {message}");
        assert!(output.stdout.is_empty(), "{name}");
    }
}

/// Whatever it is: a name, an alarm, a reason, what it wrote before it died.
#[test]
fn nothing_that_a_controller_says_moves_a_cursor() {
    const EVIL: &str = "a\\rb\\x1b[2J\\x9b2Jc";
    let program = file("evil.ngc", "g999\nm2\n");
    let dies =
        format!("import json\nsys = __import__('sys')\nsys.stderr.write('{EVIL}')\nsys.exit(3)\n");
    let mut shown = 0;
    for (name, old, new) in [
        ("evil-version.py", "\"version\": \"0.1\"", format!("\"version\": \"{EVIL}\"")),
        ("evil-alarm.py", "no such code: ", EVIL.to_owned()),
        (
            "evil-reason.py",
            "if letter == \"g\" and number > 99.9:",
            format!("if number > 99: raise Unsupported('{EVIL}')\n            if False:"),
        ),
        ("evil-end.py", "import json, re, sys\n", dies),
    ] {
        let command = changed(name, &[(old, new.as_str())]);
        let controller = format!("exec:{command}");
        let only = "modal-groups.g-code-out-of-range";
        for call in [
            vec!["adapter", "check", &command],
            vec!["certify", "--controller", &controller, "-v", "--only", only],
            vec!["run", &program, "--controller", &controller],
            vec!["compare", &program, "--controller", &controller],
        ] {
            let output = gaugeblock(&call);
            for said in [text(&output.stdout), text(&output.stderr)] {
                let plain = anstream::adapter::strip_str(&said).to_string();
                assert!(
                    !said.contains("\u{1b}[2J") && !plain.contains(['\r', '\u{1b}', '\u{9b}']),
                    "{name}, {call:?}: {said:?}"
                );
                shown += usize::from(plain.contains("\\u000d"));
            }
        }
    }
    assert!(shown > 3, "it is written out");
}

#[test]
fn adapter_check_reports_each_fault() {
    const ALARM: &str = "\"end\": {\"end\": \"fault\", \"block\": block, \"message\": f\"no such code: G{number:g}\"}";
    let fault = "if letter == \"g\" and number > 99.9:";
    for (name, changes, words) in [
        (
            "refuses-all.py",
            vec![(fault, "if True:")],
            "a broken adapter rather than a broken controller",
        ),
        (
            "accepts-all.py",
            vec![(ALARM, "\"end\": {\"end\": \"program_end\"}")],
            "an alarm is reported as a fault",
        ),
        (
            "refused-step.py",
            vec![(
                fault,
                "if letter == \"g\" and number > 99.9 and not steps.append({\"block\": block, \"events\": []}):",
            )],
            "a refused block is not a step",
        ),
        (
            "unknown.py",
            vec![("{\"refused\": \"unknown operation\"}", "{\"done\": {}}")],
            "must be answered with `refused`",
        ),
        (
            "strict.py",
            vec![(
                LOOP,
                "for request in map(json.loads, sys.stdin):\n    request[\"op\"] == \"reset\" and len(request) > 2 and sys.exit(3)\n",
            )],
            "an unknown member be ignored",
        ),
        (
            "slip-in-effect.py",
            vec![("(\"feed\", \"straight_feed\")", "(\"feed\", \"straight_fed\")")],
            "`straight_fed` (did you mean `straight_feed`?)",
        ),
        (
            "never-told.py",
            vec![("\"fields\": [", "\"fields\": [\"feed_rate\", ")],
            "`feed_rate` is declared",
        ),
        (
            "leaks.py",
            vec![
                (
                    "steps, motion, feed, point = [],",
                    "global kept\n    kept = globals().get(\"kept\", 0) + 1\n    steps, motion, feed, point = [],",
                ),
                ("\"x\": 0.0", "\"x\": 0.0, \"y\": 0.0 * kept, \"a\": 1.0 * (kept > 2)"),
            ],
            "gives another outcome",
        ),
    ] {
        let output = gaugeblock(&["adapter", "check", &changed(name, &changes)]);
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "{name}: {said}{}", text(&output.stderr));
        assert!(said.contains(words), "{name}: {said}");
    }
}
