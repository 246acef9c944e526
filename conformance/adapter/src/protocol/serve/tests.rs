use std::io::Cursor;

use gaugeblock_compare::Capabilities;
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

fn said_by(offers: &[Offer], requests: &str) -> Vec<Value> {
    let mut answers = Vec::new();
    let served = Served {
        controller: Arc::new(Model(Capabilities::everything("reference", "1"))),
        languages: vec![Language::Rs274],
        offers: offers.iter().copied().collect(),
    };
    serve(&served, Box::new(Cursor::new(requests.to_owned())), &mut answers).unwrap();
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
fn what_is_not_understood_is_refused_and_the_session_goes_on() {
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
fn what_is_not_offered_is_refused() {
    let answers = said("{\"id\":1,\"op\":\"state\"}\n{\"id\":2,\"op\":\"outcome\"}\n");
    assert!(answers.iter().all(|answer| answer["refused"].is_string()), "{answers:?}");
}

#[test]
fn batches_wait_for_credit_and_make_the_whole() {
    let program = format!("{}m2\n", "g0 x1\n".repeat(350));
    let whole = said(&run(&program, &json!({})));
    let credit = "{\"id\":7,\"op\":\"credit\",\"batches\":5}\n";
    let streamed = run(&program, &json!({"stream": {"credit": 2}}));
    let told = said_by(&[Offer::Stream], &streamed);
    assert_eq!(told.len(), 2, "no more than there is credit for");
    let told = said_by(&[Offer::Stream], &format!("{streamed}{credit}{credit}"));
    let batches = told.iter().filter_map(|answer| answer["steps"].as_array()).flatten();
    assert_eq!(told.len(), 4, "credit that comes too late is not answered");
    let last = told.last().unwrap()["outcome"]["steps"].as_array().unwrap();
    let steps: Vec<&Value> = batches.chain(last).collect();
    let expected: Vec<&Value> = whole[0]["outcome"]["steps"].as_array().unwrap().iter().collect();
    assert_eq!(steps, expected);
}

#[test]
fn a_digest_is_that_of_the_outcome_which_can_be_asked_for() {
    let run = run("g0 x1.5\nm2\n", &json!({"digest": true}));
    let told = said_by(&[Offer::Digest], &format!("{run}{{\"id\":8,\"op\":\"outcome\"}}\n"));
    let outcome: Outcome = serde_json::from_value(told[1]["outcome"].clone()).unwrap();
    assert_eq!(told[0]["digest"], digest(&outcome));
}

#[test]
fn a_state_is_that_after_the_last_run_and_after_a_reset_that_of_the_beginning() {
    let state = "{\"id\":8,\"op\":\"state\"}\n";
    let run = run("g20 f7\n#31=5\nm2\n", &json!({}));
    let reset = "{\"id\":9,\"op\":\"reset\"}\n";
    let told = said_by(&[Offer::State], &format!("{state}{run}{state}{reset}{state}"));
    assert_eq!(told[2]["state"]["settings"]["units"], "inch");
    assert_eq!(told[2]["state"]["parameters"]["31"], 5.0);
    assert_eq!(told[0]["state"], told[4]["state"]);
    assert_eq!(told[0]["state"]["settings"]["units"], "mm");
}

#[test]
fn a_cancel_is_answered_whether_or_not_the_run_is_over() {
    let run = run("o1 while [1]\no1 endwhile\nm2\n", &json!({}));
    let after = "{\"id\":8,\"op\":\"cancel\"}\n{\"id\":9,\"op\":\"reset\"}\n";
    let told = said_by(&[Offer::Cancel], &format!("{run}{after}"));
    let ids: Vec<&Value> = told.iter().map(|answer| &answer["id"]).filter(|id| **id != 7).collect();
    assert_eq!(ids, [8, 9], "{told:?}");
}

#[test]
fn the_operators_events_are_asked_for_one_by_one() {
    let when = json!({"block": {"file": "main.ngc", "line": 2}, "execution": 1, "offset": 0.0});
    let run = run("g0 x1\ng0 x2\nm2\n", &json!({"live": [when]}));
    let event = json!({"id": 7, "op": "operator", "event": {"when": when, "action": "abort"}});
    let told = said_by(&[Offer::LiveOperator], &format!("{run}{event}\n"));
    assert_eq!(told[0], json!({"id": 7, "at": 0}));
    assert_eq!(told[1]["outcome"]["end"]["end"], "aborted", "{}", told[1]);
}
