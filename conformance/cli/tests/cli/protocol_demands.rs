//! Demands of PROTOCOL.md that no other test has: what a declaration selects, and in which order requests come.
//! `protocol_sentences.txt` names the test of each sentence.

use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};

use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::exec::{Exec, Limits};
use gaugeblock_adapter::protocol::{Answer, DeclaredLanguage};
use gaugeblock_runner::language::check_program;
use gaugeblock_vocabulary::{End, Language, LengthUnit, Scenario};
use serde_json::Value;

use crate::any_answer::{suite, verdicts};
use crate::command::gaugeblock;
use crate::protocol::PAGE;
use crate::template::{LOOP, changed, file, limits, text};

#[test]
fn member_of_a_declaration_is_required_unless_the_page_says_optional() {
    let example = PAGE.lines().find(|line| line.starts_with("{\"id\":1,\"hello\"")).expect("hello");
    let rows = PAGE.lines().filter_map(|line| line.strip_prefix("| `"));
    let mut members = 0;
    for row in rows.take_while(|row| !row.starts_with("g`")) {
        let (names, says) = row.split_once(" | ").expect("a row");
        for name in names.split(", ").map(|name| name.trim_matches('`')) {
            let mut answer: Value = serde_json::from_str(example).expect("an answer");
            let parent = match name.strip_prefix("observables.") {
                Some(_) => &mut answer["hello"]["observables"],
                None => &mut answer["hello"],
            };
            let key = name.strip_prefix("observables.").unwrap_or(name);
            parent.as_object_mut().expect("an object").remove(key);
            let read = serde_json::from_value::<Answer>(answer);
            assert_eq!(read.is_ok(), says.starts_with("optional"), "{name}: {read:?}");
            members += 1;
        }
    }
    assert!(members >= 25, "{members} members");
}

#[test]
fn declaration_selects_scenarios() {
    let metric = ("[\"mm\", \"inch\"]", "[\"mm\"]");
    let language = (
        "\"clock\": \"virtual\"",
        "\"clock\": \"virtual\", \"observed\": \"rs274-2.9-observed\", \"options\": {\"modal-groups.initial-motion\": \"traverse\"}",
    );
    let controller =
        Exec::start(&changed("selects.py", &[metric, language]), limits()).expect("it starts");
    let controller = controller.check_language_by(check_program);
    assert_eq!(controller.observed_edition(), Some("rs274-2.9-observed"));
    assert_eq!(controller.options().get("modal-groups.initial-motion"), Some("traverse"));
    let plain = Scenario::of("g0 x1\nm2\n");
    assert_eq!(controller.supports(&plain), Ok(()));
    let change = |change: fn(&mut Scenario)| {
        let mut scenario = plain.clone();
        change(&mut scenario);
        controller.supports(&scenario).expect_err("it is not run")
    };
    for (reason, words) in [
        (change(|it| it.program.language = Language::Nct), "the language nct is not supported"),
        (change(|it| it.machine.length_unit = LengthUnit::Inch), "no unit inch"),
        (change(|it| it.machine.spindles = 2), "it declares no feature `spindles`"),
    ] {
        assert!(reason.contains(words), "{reason}");
    }
}

#[test]
fn edition_of_a_declaration_is_used_unless_the_call_names_one() {
    let declared =
        [("\"clock\": \"virtual\"", "\"clock\": \"virtual\", \"edition\": \"emc2-2.5\"")];
    for (name, changes, call, edition) in [
        ("edition-none.py", &[][..], &[][..], "linuxcnc-2.8"),
        ("edition-own.py", &declared[..], &[], "emc2-2.5"),
        ("edition-called.py", &declared[..], &["--edition", "linuxcnc-2.9"], "linuxcnc-2.9"),
    ] {
        let controller = format!("exec:{}", changed(name, changes));
        let certify = ["certify", "--only", "motion.mode-holds", "--controller", &controller];
        let output = gaugeblock(&[&certify[..], call].concat());
        let said = text(&output.stdout);
        assert!(said.starts_with(&format!("toy 0.1 against {edition}\n")), "{name}: {said}");
    }
    let listed = gaugeblock(&["certify", "--edition", "x"]);
    assert_eq!(listed.status.code(), Some(2));
    assert!(text(&listed.stderr).contains("linuxcnc-2.8"), "{}", text(&listed.stderr));
}

#[test]
fn commands_of_the_page_print_what_it_says() {
    for (call, words) in [
        (&["schema", "scenario"][..], "\"default\""),
        (&["schema", "outcome"], "\"steps\""),
        (&["adapter", "vocabulary"], "block-delete"),
        (&["adapter", "protocol"], "# The adapter protocol, version 1"),
    ] {
        let output = gaugeblock(call);
        assert_eq!(output.status.code(), Some(0), "{call:?}: {}", text(&output.stderr));
        assert!(text(&output.stdout).contains(words), "{call:?}");
    }
    for language in ["python", "c"] {
        let path = file(&format!("new-adapter-{language}"), "");
        std::fs::remove_file(&path).expect("the file of the test");
        let output = gaugeblock(&["adapter", "new", "--lang", language, &path]);
        assert_eq!(output.status.code(), Some(0), "{language}: {}", text(&output.stderr));
        let template = std::fs::read_to_string(&path).expect("the template");
        assert!(template.lines().count() <= 60, "{language}");
    }
}

#[test]
fn adapter_that_supports_nothing_passes_nothing() {
    let answer = format!(
        "{LOOP}    if request[\"op\"] == \"run\":
        print(json.dumps({{\"id\": request[\"id\"], \"unsupported\": \"it has no spline\"}}), flush=True)
        continue\n"
    );
    let found = verdicts(&suite(), &changed("supports-nothing.py", &[(LOOP, &answer)]));
    let is_right =
        |(word, why): &(&str, String)| *word == "unsupported" && why.contains("no spline");
    assert!(!found.is_empty() && found.iter().any(is_right), "{found:?}");
    assert!(found.iter().all(|(word, _)| *word == "unsupported"), "{found:?}");
}

#[test]
fn no_pass_for_acceptance_alone() {
    let blind = [
        ("[\"motion\", \"position\"]", "[]"),
        ("[\"straight_traverse\", \"straight_feed\"]", "[]"),
        ("\"pins\": []", "\"pins\": [], \"blocks\": False"),
    ];
    let found = verdicts(&suite(), &changed("blind.py", &blind));
    let words = "nothing was reported that its assertions check";
    assert!(found.iter().any(|(_, why)| why.contains(words)), "{found:?}");
    assert!(found.iter().all(|(word, _)| *word == "unsupported"), "{found:?}");
}

#[test]
fn wrong_digest_is_reported_with_its_text() {
    let answer = format!(
        "{LOOP}    if request.get(\"digest\"):
        print(json.dumps({{\"id\": request[\"id\"], \"digest\": \"00\"}}), flush=True)
        continue\n"
    );
    let offers = ("\"clock\": \"virtual\"", "\"clock\": \"virtual\", \"offers\": [\"digest\"]");
    let command = changed("wrong-digest.py", &[(LOOP, answer.as_str()), offers]);
    let output = gaugeblock(&["adapter", "check", &command]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("is not the SHA-256 of the outcome as canonical JSON: {\"end\""),
        "{said}"
    );
}

#[test]
fn part_of_the_language_excludes_what_it_does_not_list() {
    let words = "{\"words\":{\"G2\":\"XYIJ\",\"G10 L2\":\"PXYZ\"}}";
    for (language, program, missing) in [
        ("{\"g\":[\"0\",\"38.2\"]}", "g1 x1", Some("G1")),
        ("{\"g\":[\"0\",\"38.2\"]}", "g0 x1 m8", None),
        ("{\"g\":[\"0\"]}", "g[#1] x1", Some("G with a number that depends on a parameter")),
        ("{\"g\":[\"0\"]}", "g999", None),
        ("{\"m\":[\"2\"]}", "m8", Some("M8")),
        (words, "g2 x1 i1", None),
        (words, "g2 x1 r1", Some("G2 with R")),
        (words, "g2 x1 i1\nx2 k1", Some("G2 with K")),
        (words, "g3 x1 r1 p2", None),
        (words, "g10 l2 p1 x1", None),
        (words, "g10 l20 p1 x1", Some("G10")),
        ("{\"axes\":\"XY\"}", "g0 z1", Some("the axis word Z")),
        ("{\"axes\":\"XY\"}", "g0 @1", Some("the axis word @")),
        ("{\"letters\":\"F\"}", "s100", Some("the word S")),
        ("{\"parameters\":[\"numbered\"]}", "#31=1 #<a>=2", Some("a named parameter")),
        ("{\"parameters\":[\"named\"]}", "#31=1", Some("a numbered parameter")),
        ("{\"expressions\":false}", "g0 x[1]", Some("an expression")),
        ("{\"o_words\":false}", "o1 if [1]\no1 endif", Some("an O-word")),
        ("{\"comments\":[\"semicolon\"]}", "g0 x1 (on)", Some("a comment in parentheses")),
        ("{\"comments\":[\"parentheses\"]}", "g0 x1 ; on", Some("a comment after a semicolon")),
        ("{\"comments\":[\"parentheses\"]}", "(msg,on)", Some("a message")),
        ("{\"comments\":[\"parentheses\"]}", "(debug,on)", Some("an active comment")),
        ("{\"comments\":[\"parentheses\",\"message\"]}", "(msg,on)", None),
        ("{\"comments\":[\"parentheses\",\"message\"]}", "(debug,on)", Some("an active comment")),
        ("{\"comments\":[\"parentheses\",\"active\"]}", "(msg,on)\n(debug,on)", None),
        ("{\"greatest_parameter\":5399}", "#31=#5400", Some("a parameter of a greater number")),
        ("{\"greatest_parameter\":5399}", "#31=#5399", None),
        ("{\"comparisons\":false}", "#31=[1 eq 2]", Some("a comparison")),
        ("{\"comparisons\":false}", "#31=[1 and 2]", None),
        ("{}", "g2 x1 r[#1] (msg,on)\no1 if [1]\no1 endif", None),
    ] {
        let declared: DeclaredLanguage = serde_json::from_str(language).expect(language);
        let found = check_program(&declared, &Scenario::of(format!("{program}\nm2\n")));
        match missing {
            None => assert_eq!(found, Ok(()), "{language}: {program:?}"),
            Some(what) => {
                let why = found.expect_err(program);
                assert!(why.starts_with(what), "{language}: {program:?}: {why}");
                assert!(why.ends_with(": not in the declared language"), "{why}");
            }
        }
    }
}

/// An adapter that notes each request in a file, and whether another one was there before it had answered.
fn noting(name: &str, changes: &[(&str, &str)]) -> (String, String) {
    let notes = file(&format!("{name}.notes"), "");
    let lines = format!(
        "import os, select
def requests():
    rest = b''
    while True:
        line, newline, more = rest.partition(b'\\n')
        if not newline:
            read = os.read(0, 1 << 20)
            if not read:
                open({notes:?}, 'a').write('{{\"op\":\"input ended\"}}\\n')
                return
            rest += read
            continue
        early = bool(more) or bool(select.select([0], [], [], 0)[0])
        rest = more
        with open({notes:?}, 'a') as file:
            file.write(json.dumps({{**json.loads(line), 'early': early}}) + '\\n')
        yield line.decode()
for request in map(json.loads, requests()):\n"
    );
    let changes = [&[(LOOP, lines.as_str())], changes].concat();
    (changed(&format!("{name}.py"), &changes), notes)
}

/// What an adapter was asked in a run of a rule.
fn requests(name: &str, changes: &[(&str, &str)]) -> Vec<Value> {
    // Without a declared language it runs more than one program of the rule.
    let any_language = ("\"language\": {", "\"another\": {");
    let (command, notes) = noting(name, &[changes, &[any_language]].concat());
    assert!(verdicts(&suite(), &command).iter().any(|(word, _)| *word == "pass"));
    let notes = std::fs::read_to_string(notes).expect("the notes");
    notes.lines().map(|line| serde_json::from_str(line).expect(line)).collect()
}

#[test]
fn requests_come_in_the_order_of_the_page() {
    let requests = requests("noting", &[]);
    let op = |request: &Value| request["op"].as_str().unwrap_or_default().to_owned();
    let mut sessions = 0;
    for (place, request) in requests.iter().enumerate() {
        assert!(request["id"].is_u64(), "{request}");
        let next = requests.get(place + 1).map(op);
        let may_follow = op(request) == "reset" && next.as_deref() == Some("bye");
        assert!(request["early"] == false || may_follow, "{request}, then {next:?}");
        match op(request).as_str() {
            "hello" => {
                sessions += 1;
                assert_eq!(request["protocol"], 1, "{request}");
                assert!(request["folder"].is_string() && request["referee"].is_string());
            }
            "reset" => assert!(matches!(next.as_deref(), Some("run" | "bye")), "{next:?}"),
            "run" => {
                assert!(place > 0 && op(&requests[place - 1]) == "reset", "{request}");
                assert!(request["scenario"]["program"]["main"].is_string(), "{request}");
                assert_eq!(next.as_deref(), Some("reset"), "{request}");
            }
            "bye" => assert!(next.is_none_or(|next| next == "hello"), "{request}"),
            other => panic!("an adapter without extensions is asked {other}"),
        }
    }
    assert!(sessions > 0 && requests.len() > 6, "{requests:?}");
    assert_eq!(op(&requests[0]), "hello");
}

#[test]
fn fresh_adapter_is_reset_once() {
    let offers = ("\"clock\": \"virtual\"", "\"clock\": \"virtual\", \"offers\": [\"fresh\"]");
    let requests = requests("noting-fresh", &[offers]);
    let count = |op: &str| requests.iter().filter(|request| request["op"] == op).count();
    assert_eq!(count("reset"), count("hello"), "{requests:?}");
    assert!(count("run") > count("reset"), "{requests:?}");
}

#[test]
fn adapter_that_does_not_exit_is_killed() {
    let process = file("stays.pid", "");
    let stays = format!(
        "import os, time\nopen({process:?}, 'w').write(str(os.getpid()))\n{LOOP}    request[\"op\"] == \"bye\" and time.sleep(600)\n"
    );
    let controller = Exec::start(&changed("stays.py", &[(LOOP, &stays)]), limits())
        .expect("it starts")
        .check_language_by(check_program);
    assert_eq!(
        controller.run(&Scenario::of("g0 x1\nm2\n")).expect("an outcome").end,
        End::ProgramEnd
    );
    drop(controller);
    let process = std::fs::read_to_string(process).expect("the id of its process");
    assert!(!std::path::Path::new(&format!("/proc/{process}/cmdline")).exists());
}

#[test]
fn template_exits_when_its_input_ends() {
    let command = changed("input-ends.py", &[]);
    let mut adapter = std::process::Command::new("/bin/sh");
    let adapter = adapter.args(["-c", &command]).stdin(std::process::Stdio::null());
    assert!(adapter.status().expect("it starts").success());
}

#[test]
fn limits_are_those_of_the_page() {
    let usual = Limits::default();
    assert_eq!((usual.time.as_secs(), usual.bytes, usual.whole), (10, 64 << 20, 256 << 20));
    assert_eq!((usual.memory, usual.file, usual.objects), (4 << 30, 1 << 30, 2_000_000));
}

#[test]
fn adapter_runs_in_the_working_folder_of_the_referee() {
    let version = ("\"version\": \"0.1\"", "\"version\": __import__(\"os\").getcwd()");
    let controller = Exec::start(&changed("folder.py", &[version]), limits())
        .expect("it starts")
        .check_language_by(check_program);
    let folder = std::env::current_dir().expect("a working folder");
    assert_eq!(controller.declaration().version, folder.to_str().expect("a path in UTF-8"));
}

#[test]
fn parameters_that_an_outcome_leaves_out_are_queried() {
    let answers = format!(
        "{LOOP}    if request[\"op\"] == \"state\":
        print(json.dumps({{\"id\": request[\"id\"], \"state\": {{\"settings\": {{}}, \"parameters\": {{\"31\": 5.0}}}}}}), flush=True)
        continue\n"
    );
    let all = ("\"final_parameters\": False", "\"final_parameters\": True");
    let offers = ("\"clock\": \"virtual\"", "\"clock\": \"virtual\", \"offers\": [\"state\"]");
    let command = changed("queried.py", &[(LOOP, answers.as_str()), all, offers]);
    let controller =
        Exec::start(&command, limits()).expect("it starts").check_language_by(check_program);
    let outcome = controller.run(&Scenario::of("g0 x1\nm2\n")).expect("an outcome");
    assert_eq!(outcome.parameters.and_then(|all| all.0.get(&31).copied()), Some(5.0));
}

/// Answers `hello` and `reset`, answers `run` with what is not JSON, and returns what the referee sends after a `reset`.
fn last_request(listener: &TcpListener, declaration: &str) -> String {
    let (mut connection, _) = listener.accept().expect("a connection");
    let requests = BufReader::new(connection.try_clone().expect("the same"));
    let mut failed = false;
    for line in requests.lines() {
        let request: Value = serde_json::from_str(&line.expect("a line")).expect("a request");
        let op = request["op"].as_str().unwrap_or_default();
        if failed && op != "reset" {
            return op.to_owned();
        }
        let answer = match op {
            "hello" => format!("{{\"id\":{},\"hello\":{declaration}}}\n", request["id"]),
            "run" => {
                failed = true;
                "not JSON\n".to_owned()
            }
            _ => format!("{{\"id\":{},\"done\":{{}}}}\n", request["id"]),
        };
        connection.write_all(answer.as_bytes()).expect("it is read");
    }
    "closed".to_owned()
}

#[test]
fn failed_session_over_tcp_ends_with_bye() {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = listener.local_addr().expect("its address").to_string();
    let example = PAGE.lines().find(|line| line.starts_with("{\"id\":1,\"hello\"")).expect("hello");
    let example: Value = serde_json::from_str(example).expect("an answer");
    let mut declaration = example["hello"].clone();
    // Without a part of the language, the referee needs no parser here.
    declaration.as_object_mut().expect("an object").remove("language");
    let declaration = declaration.to_string();
    let served = std::thread::spawn(move || {
        let last = last_request(&listener, &declaration);
        // A new session is a new connection.
        (last, last_request(&listener, &declaration))
    });
    let controller =
        Exec::connect(&address, limits()).expect("it answers").check_language_by(check_program);
    for _again in 0..2 {
        let error = controller.run(&Scenario::of("g0 x1\nm2\n")).expect_err("it is not JSON");
        assert!(error.to_string().contains("unreadable"), "{error}");
    }
    drop(controller);
    let (first, second) = served.join().expect("the listener");
    assert_eq!((first.as_str(), second.as_str()), ("bye", "bye"));
    // The listener is gone.
    assert!(TcpStream::connect(&address).is_err());
}
