//! Tests the server side of the adapter protocol: a session is a text of requests, the test checks the answers.

use std::io::Cursor;

use gaugeblock_compare::Capabilities;
use gaugeblock_filesystem::PrivateFolder;
use serde_json::{Value, json};

use super::*;
use crate::HarnessError;

/// The reference model, in this process.
#[derive(Debug)]
struct Model(Capabilities);

impl Adapter for Model {
    fn capabilities(&self) -> &Capabilities {
        &self.0
    }

    fn supports(&self, _scenario: &Scenario) -> std::result::Result<(), String> {
        Ok(())
    }

    fn run(&self, scenario: &Scenario) -> std::result::Result<Outcome, HarnessError> {
        Ok(gaugeblock_reference::run(scenario).0)
    }
}

/// The model as the served controller.
fn served(caller: Caller, offers: &[Extension]) -> Served {
    Served {
        controller: Arc::new(Model(Capabilities::everything("reference", "1"))),
        languages: vec![Language::Rs274],
        offers: offers.iter().copied().collect(),
        caller,
    }
}

/// The answers to requests, with these extensions offered.
fn answers_with(offers: &[Extension], requests: &str) -> Vec<Value> {
    answers_for(Caller::Parent, offers, requests)
}

/// The answers to requests of a parent process or of the network.
fn answers_for(caller: Caller, offers: &[Extension], requests: &str) -> Vec<Value> {
    let mut answers = Vec::new();
    serve(&served(caller, offers), Box::new(Cursor::new(requests.to_owned())), &mut answers)
        .unwrap();
    let lines = String::from_utf8(answers).unwrap();
    lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// The answers to requests, without extensions.
fn answers(requests: &str) -> Vec<Value> {
    answers_with(&[], requests)
}

/// A request to run a program, with the fields of `more`.
fn run(program: &str, more: &Value) -> String {
    let mut request = json!({"id": 7, "op": "run", "scenario": {"program": {"main": program}}});
    for (name, value) in more.as_object().unwrap() {
        request[name] = value.clone();
    }
    format!("{request}\n")
}

#[test]
fn unknown_request_is_refused_and_the_session_goes_on() {
    let answers = answers(
        "{\"id\":1,\"op\":\"dance\"}\n\nno json\n{\"id\":3,\"op\":\"reset\",\"later\":1}\n{\"id\":4,\"op\":\"bye\"}\n{\"id\":5,\"op\":\"reset\"}\n",
    );
    assert_eq!(answers.len(), 4, "nothing is answered after bye");
    assert_eq!(answers[0]["id"], 1);
    assert!(answers[0]["refused"].as_str().unwrap().contains("dance"));
    assert_eq!(answers[1]["id"], 0);
    assert_eq!(answers[2], json!({"id": 3, "done": {}}));
    assert_eq!(answers[3], json!({"id": 4, "done": {}}));
}

#[test]
fn a_run_has_its_outcome() {
    let answers = answers(&run("g0 x1\nm2\n", &json!({})));
    assert_eq!(answers[0]["outcome"]["end"]["end"], "program_end", "{}", answers[0]);
}

#[test]
fn undeclared_extension_is_refused() {
    let answers = answers("{\"id\":1,\"op\":\"state\"}\n{\"id\":2,\"op\":\"outcome\"}\n");
    assert!(answers.iter().all(|answer| answer["refused"].is_string()), "{answers:?}");
}

#[test]
fn batches_wait_for_credit_and_make_the_whole() {
    let program = format!("{}m2\n", "g0 x1\n".repeat(350));
    let whole = answers(&run(&program, &json!({})));
    let credit = "{\"id\":7,\"op\":\"credit\",\"batches\":5}\n";
    let streamed = run(&program, &json!({"stream": {"credit": 2}}));
    let answers = answers_with(&[Extension::Stream], &streamed);
    assert_eq!(answers.len(), 2, "no more than there is credit for");
    let answers = answers_with(&[Extension::Stream], &format!("{streamed}{credit}{credit}"));
    let batches = answers.iter().filter_map(|answer| answer["steps"].as_array()).flatten();
    assert_eq!(answers.len(), 4, "credit that comes too late is not answered");
    let last = answers.last().unwrap()["outcome"]["steps"].as_array().unwrap();
    let steps: Vec<&Value> = batches.chain(last).collect();
    let expected: Vec<&Value> = whole[0]["outcome"]["steps"].as_array().unwrap().iter().collect();
    assert_eq!(steps, expected);
}

#[test]
fn digest_is_that_of_the_outcome_on_request() {
    let run = run("g0 x1.5\nm2\n", &json!({"digest": true}));
    let answers =
        answers_with(&[Extension::Digest], &format!("{run}{{\"id\":8,\"op\":\"outcome\"}}\n"));
    let outcome: Outcome = serde_json::from_value(answers[1]["outcome"].clone()).unwrap();
    assert_eq!(answers[0]["digest"], digest(&outcome));
}

#[test]
fn a_state_is_that_after_the_last_run_and_after_a_reset_that_of_the_beginning() {
    let state = "{\"id\":8,\"op\":\"state\"}\n";
    let run = run("g20 f7\n#31=5\nm2\n", &json!({}));
    let reset = "{\"id\":9,\"op\":\"reset\"}\n";
    let answers = answers_with(&[Extension::State], &format!("{state}{run}{state}{reset}{state}"));
    assert_eq!(answers[2]["state"]["settings"]["units"], "inch");
    assert_eq!(answers[2]["state"]["parameters"]["31"], 5.0);
    assert_eq!(answers[0]["state"], answers[4]["state"]);
    assert_eq!(answers[0]["state"]["settings"]["units"], "mm");
}

#[test]
fn a_cancel_is_answered_whether_or_not_the_run_is_over() {
    let run = run("o1 while [1]\no1 endwhile\nm2\n", &json!({}));
    let after = "{\"id\":8,\"op\":\"cancel\"}\n{\"id\":9,\"op\":\"reset\"}\n";
    let answers = answers_with(&[Extension::Cancel], &format!("{run}{after}"));
    let ids: Vec<&Value> =
        answers.iter().map(|answer| &answer["id"]).filter(|id| **id != 7).collect();
    assert_eq!(ids, [8, 9], "{answers:?}");
}

#[test]
fn operators_events_are_requested_one_by_one() {
    let when = json!({"block": {"file": "main.ngc", "line": 2}, "execution": 1, "offset": 0.0});
    let run = run("g0 x1\ng0 x2\nm2\n", &json!({"live": [when]}));
    let event = json!({"id": 7, "op": "operator", "event": {"when": when, "action": "abort"}});
    let answers = answers_with(&[Extension::LiveOperator], &format!("{run}{event}\n"));
    assert_eq!(answers[0], json!({"id": 7, "at": 0}));
    assert_eq!(answers[1]["outcome"]["end"]["end"], "aborted", "{}", answers[1]);
}

/// A program whose outcome is large enough for a file.
fn large() -> String {
    run(&format!("{}m2\n", "g0 x1\ng0 x2\n".repeat(400)), &json!({}))
}

/// The request that begins a session, with a folder for large answers.
fn hello(folder: &Path) -> String {
    let hello = json!({"id": 1, "op": "hello", "protocol": 1, "referee": "me", "folder": folder});
    format!("{hello}\n")
}

#[test]
fn a_large_answer_is_a_new_file_and_no_link_is_followed() {
    let folder = PrivateFolder::new("serve").unwrap();
    let requests = format!("{}{}", hello(folder.path()), large());
    let answers = answers_with(&[Extension::Files], &requests);
    assert_eq!(answers[1]["file"], "answer-1", "{}", answers[1]);
    let read = || std::fs::read_to_string(folder.path().join("answer-1"));
    assert!(serde_json::from_str::<Outcome>(&read().unwrap()).is_ok());

    std::fs::remove_file(folder.path().join("answer-1")).unwrap();
    folder.write("victim", "kept").unwrap();
    for target in ["victim", "absent"] {
        let link = folder.path().join("answer-1");
        std::os::unix::fs::symlink(target, &link).unwrap();
        let served = served(Caller::Parent, &[Extension::Files]);
        let requests = Box::new(Cursor::new(requests.clone()));
        assert!(serve(&served, requests, &mut Vec::new()).is_err(), "{target}");
        std::fs::remove_file(link).unwrap();
    }
    assert_eq!(std::fs::read_to_string(folder.path().join("victim")).unwrap(), "kept");
    assert!(!folder.path().join("absent").exists());
}

#[test]
fn network_session_writes_no_files_and_ends_at_invalid_json() {
    let folder = PrivateFolder::new("serve").unwrap();
    let requests = format!("{}{}", hello(folder.path()), large());
    let answers = answers_for(Caller::Network, &[Extension::Files, Extension::State], &requests);
    assert!(answers[0]["refused"].as_str().unwrap().contains("no folder"), "{}", answers[0]);
    assert!(answers[1]["outcome"].is_object(), "the outcome is in the answer itself");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    let plain = "{\"id\":1,\"op\":\"hello\",\"protocol\":1,\"referee\":\"me\"}\n";
    let answers = answers_for(Caller::Network, &[Extension::Files, Extension::State], plain);
    assert_eq!(answers[0]["hello"]["offers"], json!(["state"]));

    let post = format!("{{\"id\":1,\"op\":\"dance\"}}\nPOST / HTTP/1.1\nHost: x\n\n{plain}");
    let answers = answers_for(Caller::Network, &[], &post);
    assert_eq!(answers.len(), 2, "{answers:?}");
    assert!(answers.iter().all(|answer| answer["refused"].is_string()));
}

#[test]
fn a_line_is_not_read_beyond_its_limit() {
    let line = |text: &'static str, longest| {
        let mut requests = Requests::of(Box::new(Cursor::new(text)), longest, false);
        requests.next().map(|line| line.map(|line| line.len()))
    };
    assert_eq!(line("1234\n", 5).unwrap(), Some(5));
    assert_eq!(line("1234", 5).unwrap(), Some(4));
    assert!(line("12345\n", 5).is_err());
    assert!(line("12345", 5).is_err());
    assert_eq!(line("", 5).unwrap(), None);
}

#[test]
fn network_session_has_a_largest_budget() {
    let request = |steps: u32, effects: u32| {
        let budget = json!({"steps": steps, "effects": effects, "time": 1.0});
        let scenario = json!({"program": {"main": "m2\n"}, "budget": budget});
        run("", &json!({"scenario": scenario}))
    };
    let requests = [(1_000_000, 1_000_000), (1_000_001, 1), (1, u32::MAX)]
        .map(|(steps, effects)| request(steps, effects))
        .concat();
    let network = answers_for(Caller::Network, &[], &requests);
    assert!(network[0]["outcome"].is_object(), "{}", network[0]);
    for refused in &network[1..3] {
        assert!(refused["refused"].as_str().unwrap().contains("1000000 steps"), "{refused}");
        assert_eq!(refused["id"], 7);
    }
    let parent = answers(&requests);
    assert!(parent.iter().all(|answer| answer["outcome"].is_object()), "{parent:?}");
}
