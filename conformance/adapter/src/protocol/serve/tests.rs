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

fn served(caller: Caller, offers: &[Extension]) -> Served {
    Served {
        controller: Arc::new(Model(Capabilities::everything("reference", "1"))),
        languages: vec![Language::Rs274],
        offers: offers.iter().copied().collect(),
        caller,
    }
}

fn said_by(offers: &[Extension], requests: &str) -> Vec<Value> {
    said_to(Caller::Parent, offers, requests)
}

fn said_to(caller: Caller, offers: &[Extension], requests: &str) -> Vec<Value> {
    let mut answers = Vec::new();
    serve(&served(caller, offers), Box::new(Cursor::new(requests.to_owned())), &mut answers)
        .unwrap();
    let lines = String::from_utf8(answers).unwrap();
    lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn said(requests: &str) -> Vec<Value> {
    said_by(&[], requests)
}

fn run(program: &str, more: &Value) -> String {
    let mut request = json!({"id": 7, "op": "run", "scenario": {"program": {"main": program}}});
    for (name, value) in more.as_object().unwrap() {
        request[name] = value.clone();
    }
    format!("{request}\n")
}

#[test]
fn unknown_request_is_refused_and_the_session_goes_on() {
    let answers = said(
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
    let answers = said(&run("g0 x1\nm2\n", &json!({})));
    assert_eq!(answers[0]["outcome"]["end"]["end"], "program_end", "{}", answers[0]);
}

#[test]
fn undeclared_extension_is_refused() {
    let answers = said("{\"id\":1,\"op\":\"state\"}\n{\"id\":2,\"op\":\"outcome\"}\n");
    assert!(answers.iter().all(|answer| answer["refused"].is_string()), "{answers:?}");
}

#[test]
fn batches_wait_for_credit_and_make_the_whole() {
    let program = format!("{}m2\n", "g0 x1\n".repeat(350));
    let whole = said(&run(&program, &json!({})));
    let credit = "{\"id\":7,\"op\":\"credit\",\"batches\":5}\n";
    let streamed = run(&program, &json!({"stream": {"credit": 2}}));
    let told = said_by(&[Extension::Stream], &streamed);
    assert_eq!(told.len(), 2, "no more than there is credit for");
    let told = said_by(&[Extension::Stream], &format!("{streamed}{credit}{credit}"));
    let batches = told.iter().filter_map(|answer| answer["steps"].as_array()).flatten();
    assert_eq!(told.len(), 4, "credit that comes too late is not answered");
    let last = told.last().unwrap()["outcome"]["steps"].as_array().unwrap();
    let steps: Vec<&Value> = batches.chain(last).collect();
    let expected: Vec<&Value> = whole[0]["outcome"]["steps"].as_array().unwrap().iter().collect();
    assert_eq!(steps, expected);
}

#[test]
fn digest_is_that_of_the_outcome_on_request() {
    let run = run("g0 x1.5\nm2\n", &json!({"digest": true}));
    let told = said_by(&[Extension::Digest], &format!("{run}{{\"id\":8,\"op\":\"outcome\"}}\n"));
    let outcome: Outcome = serde_json::from_value(told[1]["outcome"].clone()).unwrap();
    assert_eq!(told[0]["digest"], digest(&outcome));
}

#[test]
fn a_state_is_that_after_the_last_run_and_after_a_reset_that_of_the_beginning() {
    let state = "{\"id\":8,\"op\":\"state\"}\n";
    let run = run("g20 f7\n#31=5\nm2\n", &json!({}));
    let reset = "{\"id\":9,\"op\":\"reset\"}\n";
    let told = said_by(&[Extension::State], &format!("{state}{run}{state}{reset}{state}"));
    assert_eq!(told[2]["state"]["settings"]["units"], "inch");
    assert_eq!(told[2]["state"]["parameters"]["31"], 5.0);
    assert_eq!(told[0]["state"], told[4]["state"]);
    assert_eq!(told[0]["state"]["settings"]["units"], "mm");
}

#[test]
fn a_cancel_is_answered_whether_or_not_the_run_is_over() {
    let run = run("o1 while [1]\no1 endwhile\nm2\n", &json!({}));
    let after = "{\"id\":8,\"op\":\"cancel\"}\n{\"id\":9,\"op\":\"reset\"}\n";
    let told = said_by(&[Extension::Cancel], &format!("{run}{after}"));
    let ids: Vec<&Value> = told.iter().map(|answer| &answer["id"]).filter(|id| **id != 7).collect();
    assert_eq!(ids, [8, 9], "{told:?}");
}

#[test]
fn operators_events_are_requested_one_by_one() {
    let when = json!({"block": {"file": "main.ngc", "line": 2}, "execution": 1, "offset": 0.0});
    let run = run("g0 x1\ng0 x2\nm2\n", &json!({"live": [when]}));
    let event = json!({"id": 7, "op": "operator", "event": {"when": when, "action": "abort"}});
    let told = said_by(&[Extension::LiveOperator], &format!("{run}{event}\n"));
    assert_eq!(told[0], json!({"id": 7, "at": 0}));
    assert_eq!(told[1]["outcome"]["end"]["end"], "aborted", "{}", told[1]);
}

/// A program whose outcome is large enough for a file.
fn large() -> String {
    run(&format!("{}m2\n", "g0 x1\ng0 x2\n".repeat(400)), &json!({}))
}

fn hello(folder: &Path) -> String {
    let hello = json!({"id": 1, "op": "hello", "protocol": 1, "referee": "me", "folder": folder});
    format!("{hello}\n")
}

#[test]
fn a_large_answer_is_a_new_file_and_no_link_is_followed() {
    let folder = PrivateFolder::new("serve").unwrap();
    let requests = format!("{}{}", hello(folder.path()), large());
    let told = said_by(&[Extension::Files], &requests);
    assert_eq!(told[1]["file"], "answer-1", "{}", told[1]);
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
    let told = said_to(Caller::Network, &[Extension::Files, Extension::State], &requests);
    assert!(told[0]["refused"].as_str().unwrap().contains("no folder"), "{}", told[0]);
    assert!(told[1]["outcome"].is_object(), "it is told in its line");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    let plain = "{\"id\":1,\"op\":\"hello\",\"protocol\":1,\"referee\":\"me\"}\n";
    let told = said_to(Caller::Network, &[Extension::Files, Extension::State], plain);
    assert_eq!(told[0]["hello"]["offers"], json!(["state"]));

    let post = format!("{{\"id\":1,\"op\":\"dance\"}}\nPOST / HTTP/1.1\nHost: x\n\n{plain}");
    let told = said_to(Caller::Network, &[], &post);
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told.iter().all(|answer| answer["refused"].is_string()));
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
