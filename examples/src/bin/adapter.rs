//! An adapter for Gaugeblock in Rust: one JSON object a line on standard input, one answer a line on standard output.
//!
//! ```sh
//! cargo build -p gaugeblock-examples --bin adapter
//! gaugeblock adapter check target/debug/adapter
//! gaugeblock certify exec:target/debug/adapter
//! ```
//!
//! The controller is a toy that knows G0, G1, G21, F and M2. Put yours in place of [`run`]. Scenarios and outcomes
//! are types of `gaugeblock-vocabulary`; the messages around them are described by `gaugeblock adapter protocol`.

use std::io::{self, BufRead as _, Write as _};

use gaugeblock_vocabulary::{
    BlockLocation, Effect, End, Event, Fault, Language, Motion, Outcome, Position, Rs274State,
    Scenario, Settings, State, Step,
};
use serde_json::{Value, json};

/// What the controller is, what it has, and what is observable of it. Nothing else is judged.
fn declaration() -> Value {
    json!({
        "protocol": 1,
        "name": "toy",
        "version": "0.1",
        "languages": ["rs274"],
        "units": ["mm", "inch"],
        "features": [],
        "observables": {
            "fields": ["motion", "position"],
            "fields_at_effects": [],
            "effects": ["straight_traverse", "straight_feed"],
            "moves_in_place": true,
            "fault_kinds": false,
            "final_parameters": false,
            "pins": [],
        },
        "resolution": 0.0,
        "clock": "virtual",
    })
}

/// The controller lacks what a scenario needs.
struct Unsupported(String);

/// The words of a block: letters with their numbers.
fn words(text: &str) -> Result<Vec<(char, f64)>, Unsupported> {
    let mut words = Vec::new();
    let mut rest = text.trim();
    while let Some(letter) = rest.chars().next() {
        let after = &rest[letter.len_utf8()..];
        let end = after.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c)));
        let (number, next) = after.split_at(end.unwrap_or(after.len()));
        match number.parse() {
            Ok(number) if letter.is_ascii_alphabetic() => words.push((letter, number)),
            _ => return Err(Unsupported("anything except plain words".to_owned())),
        }
        rest = next.trim_start();
    }
    Ok(words)
}

/// The state of the controller.
struct Controller {
    motion: Motion,
    feed_rate: f64,
    point: Position,
}

impl Controller {
    /// After power-on.
    fn new() -> Self {
        Self { motion: Motion::None, feed_rate: 0.0, point: Position::default() }
    }

    /// Executes a block, and returns its effect. The error of the inner result is an alarm.
    fn execute(
        &mut self,
        words: &[(char, f64)],
    ) -> Result<Result<Option<Effect>, String>, Unsupported> {
        let mut moves = false;
        for (letter, number) in words {
            match (letter, number) {
                ('g', number) if *number > 99.9 => {
                    return Ok(Err(format!("unknown code G{number}")));
                }
                ('g', 0.0) => self.motion = Motion::Traverse,
                ('g', 1.0) => self.motion = Motion::Feed,
                ('g', 21.0) | ('m', 2.0) => {}
                ('f', number) => self.feed_rate = *number,
                ('x', number) => self.point.x = *number,
                ('y', number) => self.point.y = *number,
                ('z', number) => self.point.z = *number,
                _ => return Err(Unsupported(format!("the word {letter}{number}"))),
            }
            moves |= matches!(letter, 'x' | 'y' | 'z');
        }
        if !moves {
            return Ok(Ok(None));
        }
        let end = self.point;
        let effect = if self.motion == Motion::Traverse {
            Effect::StraightTraverse { end }
        } else if self.motion == Motion::Feed && self.feed_rate > 0.0 {
            Effect::StraightFeed { end }
        } else {
            return Ok(Err("no motion mode, or no feed rate".to_owned()));
        };
        Ok(Ok(Some(effect)))
    }

    fn state(&self) -> State {
        State::Rs274(Rs274State {
            motion: Some(self.motion),
            position: Some(self.point),
            ..Rs274State::default()
        })
    }
}

/// Runs a scenario from power-on. Replace this with your controller.
fn run(scenario: &Scenario) -> Result<Outcome, Unsupported> {
    let mut controller = Controller::new();
    let mut outcome = Outcome {
        language: Language::Rs274,
        start: Settings::default(),
        steps: Vec::new(),
        end: End::ProgramEnd,
        parameters: None,
        pins: Vec::new(),
        samples: Vec::new(),
    };
    let text = scenario.program.main.to_ascii_lowercase();
    for (number, line) in (1..).zip(text.lines()) {
        let block = BlockLocation::new("main.ngc", number);
        let words = words(line)?;
        let effect = match controller.execute(&words)? {
            Ok(effect) => effect,
            Err(message) => {
                outcome.end =
                    End::Fault(Fault { kind: None, block: Some(block), span: None, message });
                return Ok(outcome);
            }
        };
        let is_end = words.contains(&('m', 2.0));
        if is_end {
            controller.motion = Motion::Feed;
        }
        let events = effect.into_iter().map(Event::Do).collect();
        outcome.steps.push(Step { block, events, state: Some(controller.state()) });
        if is_end {
            return Ok(outcome);
        }
    }
    Err(Unsupported("a program without M2".to_owned()))
}

/// Answers one request, without its id.
fn answer(request: &Value) -> Value {
    match request["op"].as_str() {
        Some("hello") => json!({ "hello": declaration() }),
        // Each run begins anew.
        Some("reset" | "bye") => json!({ "done": {} }),
        Some("run") => match serde_json::from_value(request["scenario"].clone()) {
            Ok(scenario) => match run(&scenario) {
                Ok(outcome) => json!({ "outcome": outcome }),
                Err(Unsupported(why)) => json!({ "unsupported": why }),
            },
            Err(error) => json!({ "refused": error.to_string() }),
        },
        _ => json!({ "refused": "unknown operation" }),
    }
}

fn main() -> io::Result<()> {
    let mut output = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        let request: Value = serde_json::from_str(&line?)?;
        let mut answer = answer(&request);
        answer["id"] = request["id"].clone();
        writeln!(output, "{answer}")?;
        output.flush()?;
        if request["op"] == "bye" {
            break;
        }
    }
    Ok(())
}
