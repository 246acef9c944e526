//! Extensions of the protocol, and TCP: verdicts do not depend on them, and failures stay with their own case.

use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::time::Duration;

use gaugeblock_adapter::exec::Exec;
use gaugeblock_adapter::{Adapter, MotionRequest, NoSamples};
use gaugeblock_runner::certify::{RepeatSampling, Verdict};
use gaugeblock_runner::language::check_program;
use gaugeblock_suite::Suite;
use gaugeblock_vocabulary::Scenario;
use gaugeblock_vocabulary::motion::{MotionLimits, MotionScript};

use crate::command::gaugeblock;
use crate::template::{LOOP, TEMPLATE, changed, file, limits, text, verdicts_on};

const ALL: &str = "cancel,digest,files,fresh,live-operator,motion,shows,state,stream";

/// The command of a Python adapter that offers extensions and executes the statement `does` on one program.
fn offering(name: &str, offers: &str, does: &str) -> String {
    let (head, _) = TEMPLATE.split_once(LOOP).expect("the template has a loop");
    let offers: Vec<&str> = offers.split(',').filter(|offer| *offer != "-").collect();
    let offering = include_str!("offering.py");
    let (before, after) = offering.split_once("    pass\n").expect("a place for the statement");
    let adapter =
        format!("{head}DECLARATION[\"offers\"] = {offers:?}\n{before}    {does}\n{after}");
    format!("python3 {}", file(&format!("{}.py", name.replace(' ', "-")), &adapter))
}

/// Whether a verdict is as expected: not judged for this reason, or a pass if the reason is empty.
fn is_expected(verdict: &Verdict, reason: &str) -> bool {
    match verdict.undetermined_reason() {
        Some(why) => !reason.is_empty() && why.contains(reason) && !why.contains(char::is_control),
        None => reason.is_empty() && *verdict == Verdict::Pass,
    }
}

#[test]
fn declared_extensions_do_not_change_other_verdicts() {
    let suite =
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite");
    let start = |command: &str| {
        Exec::start(command, limits())
            .unwrap_or_else(|error| panic!("{command}: {error}"))
            .check_language_by(check_program)
    };
    let (plain, usual) =
        verdicts_on(&start(&changed("offers-none.py", &[])), &suite, RepeatSampling(0));
    assert_eq!(plain, (Verdict::Pass, false));
    let mut wrong = Vec::new();
    let entries = include_str!("offering.txt").split("\n\n").skip(1);
    for entry in entries {
        let mut lines = entry.lines();
        let mut next = || lines.next().unwrap_or_default().trim();
        let (name, offers, does) = (next(), next(), next());
        let reason = next().trim_start_matches("> ");
        let controller = start(&offering(name, offers, does));
        let (verdict, others) = verdicts_on(&controller, &suite, RepeatSampling(0));
        if !is_expected(&verdict.0, reason) || others != usual {
            wrong
                .push(format!("{name}: {verdict:?}, the others are the same: {}", others == usual));
        }
        let is_spoilt = !controller.notes().is_empty();
        // Without a reset between two runs, the next run may detect an adapter that ended after its answer.
        let may_be = offers == "fresh" && does.contains("_exit");
        if is_spoilt != (offers == "state") && !may_be {
            wrong.push(format!("{name}: {:?}", controller.notes()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let left = std::fs::read_dir(std::env::temp_dir()).expect("the folder of temporary files");
    let own = format!("gaugeblock-answers-{}-", std::process::id());
    let left = left.flatten().filter(|entry| entry.file_name().to_string_lossy().starts_with(&own));
    for left in left.map(|entry| entry.path()) {
        // One of the adapters renames its folder.
        assert_eq!(left.extension().and_then(|end| end.to_str()), Some("moved"));
        std::fs::remove_dir_all(left).expect("it can be removed");
    }
}

/// A cancelled run costs no new session, but the one in which it is run again alone: each one leaves a mark in a file.
#[test]
fn a_session_goes_on_after_a_cancelled_run() {
    let suite =
        Suite::read(&gaugeblock_embedded_suite::files().expect("the suite")).expect("the suite");
    let count = file("sessions", "");
    let does = "assert lines.get()['op'] == 'cancel'; say(request['id'] + 1, done={}); return True";
    for (offers, does, sessions) in
        [("cancel", does, 2), ("cancel", "import time; time.sleep(60)", 3)]
    {
        std::fs::write(&count, "").expect("a file for the test");
        let command = offering("counted", offers, does);
        let path = command.strip_prefix("python3 ").expect("its command");
        let adapter = std::fs::read_to_string(path).expect("the adapter");
        std::fs::write(path, format!("open({count:?}, 'a').write('x')\n{adapter}"))
            .expect("the adapter");
        let controller =
            Exec::start(&command, limits()).expect("it starts").check_language_by(check_program);
        let (verdict, _) = verdicts_on(&controller, &suite, RepeatSampling(0));
        assert!(is_expected(&verdict.0, "no end after 1 s"), "{verdict:?}");
        assert_eq!(std::fs::read_to_string(&count).expect("the count").len(), sessions);
    }
}

#[test]
fn invalid_samples_are_reported_and_not_judged() {
    let limits_of_motion =
        MotionLimits::from_text("period = 0.001\n[axes.x]\nvelocity = 1.0\n").expect("limits");
    let scenario = Scenario::of("g0 x1\nm2\n");
    let script = MotionScript::default();
    let motion = MotionRequest {
        scenario: &scenario,
        limits: &limits_of_motion,
        script: &script,
        feed_interval: None,
    };
    for (name, answer, why) in [
        ("no-table", "samples='x'", Err("unreadable output (samples)")),
        ("no-samples", "unsupported='it does not move'", Err("it does not move")),
        ("failed-samples", "refused='it burnt'", Err("it burnt")),
        ("no-answer", "done={}", Err("`move` answered with `done`")),
        ("wrong-file", "file='../x'", Err("not that of a file in the folder")),
        ("table", "samples='# gaugeblock samples 0 period=0.001 resolution=0\\nx\\n0\\n'", Ok(1)),
    ] {
        let command = offering(name, "motion,files", "pass");
        let path = command.strip_prefix("python3 ").expect("its command");
        let adapter = std::fs::read_to_string(path).expect("the adapter");
        let answering = format!(
            "    elif op == \"move\":\n        say(id, {answer})\n    elif op == \"state\":"
        );
        std::fs::write(path, adapter.replace("    elif op == \"state\":", &answering))
            .expect("the adapter");
        let controller =
            Exec::start(&command, limits()).expect("it starts").check_language_by(check_program);
        let said = controller.record_motion(&motion).map_err(|none| match none {
            NoSamples::Unsupported(said) => said,
            NoSamples::Failed(error) => error.to_string(),
        });
        match (said, why) {
            (Ok(samples), Ok(rows)) => assert_eq!(samples.len(), rows, "{name}"),
            (Err(said), Err(why)) => {
                assert!(said.contains(why), "{name}: {said}");
            }
            (found, _) => panic!("{name}: {found:?}"),
        }
    }
}

/// What is done with a connection on which a run was asked for.
type Then = fn(&mut TcpStream);

/// Answers `hello` and `reset` of each connection, and leaves the rest to somebody else.
fn answering(then: Then) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = listener.local_addr().expect("its address").to_string();
    let (_, declaration) = TEMPLATE.split_once("DECLARATION = ").expect("a declaration");
    let (declaration, _) = declaration.split_once("\nMOTIONS").expect("its end");
    let declaration: Vec<&str> =
        declaration.lines().map(|line| line.split("  #").next().unwrap_or_default()).collect();
    let declaration = declaration.join(" ").replace("True", "true").replace("False", "false");
    std::thread::spawn(move || {
        for connection in listener.incoming() {
            let mut connection = connection.expect("a connection");
            let requests = BufReader::new(connection.try_clone().expect("the same"));
            for line in requests.lines() {
                let request: serde_json::Value =
                    serde_json::from_str(&line.expect("a line")).expect("a request");
                let answer = match request["op"].as_str() {
                    Some("hello") => format!("\"hello\":{declaration}"),
                    Some("run") => {
                        then(&mut connection);
                        break;
                    }
                    _ => "\"done\":{}".to_owned(),
                };
                let line = format!("{{\"id\":{},{answer}}}\n", request["id"]);
                connection.write_all(line.as_bytes()).expect("it is read");
            }
        }
    });
    address
}

#[test]
fn connection_failures_are_reported() {
    let scenario = Scenario::of("g0 x1\nm2\n");
    let limits = limits();
    let cases: [(Then, &str); 3] = [
        (|_| (), "ended without an answer (the connection was closed, after the request `run`"),
        (
            |connection| {
                // One byte a time, for as long as it is read.
                for byte in b"{\"id\":3,\"outcome\":{}}\n".iter().cycle() {
                    if connection.write_all(&[*byte]).is_err() {
                        break;
                    }
                    std::thread::sleep(Duration::from_millis(150));
                }
            },
            "no end after 1 s",
        ),
        (
            |connection| {
                let _cut = connection.write_all(b"{\"id\":3,");
            },
            "ended without an answer (the connection was closed",
        ),
    ];
    for (then, why) in cases {
        let controller = Exec::connect(&answering(then), limits)
            .expect("it answers")
            .check_language_by(check_program);
        for _again in 0..2 {
            let error = controller.run(&scenario).expect_err(why).to_string();
            assert!(error.starts_with(why), "{error}");
        }
    }
}

#[test]
fn refused_connection_has_a_hint() {
    let free = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = free.local_addr().expect("its address").to_string();
    drop(free);
    for (controller, status, words) in [
        (format!("tcp:{address}"), 3, "no connection to"),
        ("tcp:127.0.0.1".to_owned(), 2, "expected tcp:HOST:PORT"),
        ("tcp:no-such-host.invalid:1".to_owned(), 3, "no connection to"),
    ] {
        let output = gaugeblock(&["certify", "--controller", &controller]);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{said}");
        assert!(said.contains(words) && said.contains("hint:"), "{said}");
    }
}

#[test]
fn adapter_check_covers_each_declared_extension() {
    let command = env!("CARGO_BIN_EXE_gaugeblock");
    let adapter = format!("{command} serve --controller production --offer {ALL}");
    let output = gaugeblock(&["adapter", "check", &adapter]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", text(&output.stderr));
    for what in ["cancel", "digest", "files", "live-operator", "motion", "state", "stream"] {
        assert!(said.contains(&format!("offer {what}")), "{what}: {said}");
    }
    let refusing = "lines.get(); say(request['id'] + 1, refused='never'); return True";
    let command = offering("refuses-to-be-cancelled", "cancel", refusing);
    let path = command.strip_prefix("python3 ").expect("its command");
    let adapter = std::fs::read_to_string(path).expect("the adapter");
    let adapter = adapter.replace("(\"reset\", \"cancel\", \"bye\")", "(\"reset\", \"bye\")");
    std::fs::write(path, adapter).expect("the adapter");
    let output = gaugeblock(&["adapter", "check", &command]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    assert!(text(&output.stdout).contains("`cancel` must be answered with `done`"));
}
