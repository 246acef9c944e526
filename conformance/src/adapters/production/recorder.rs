//! Writes down what the production interpreter does: settings and effects as it tells them, and the state after each block.

use std::collections::BTreeMap;

use gaugeblock_impl::{BlockDone, Executed, Interpreter, Probing, Reply, Sink};
use gaugeblock_trace::{
    Block, Effect, End, Event, Indexed, Language, Outcome, Rs274State, Settings, State, Step,
};

use super::outside::{Answer, Outside};
use crate::observe::is_local_name;

/// Why nothing goes on, though the interpreter could.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Halt {
    /// The program pauses, and nobody is there to let it go on.
    Pauses,
    /// It waits for what never comes.
    WaitsForEver,
}

/// What has been seen so far.
#[derive(Debug)]
pub(super) struct Recorder<'a> {
    outside: Outside<'a>,
    start: Settings,
    steps: Vec<Step>,
    /// What the block that is being executed has done.
    events: Vec<Event>,
    effects: u32,
    /// State as recorded last.
    state: Rs274State,
    /// Numbered parameters as recorded last; those that are not among them are zero.
    numbered: BTreeMap<u32, f64>,
    /// Named parameters as recorded last.
    named: BTreeMap<String, f64>,
    /// Numbered parameters that were set since a state was recorded last.
    written: BTreeMap<u32, f64>,
    /// Whether a call or return has led elsewhere since a state was recorded last.
    elsewhere: bool,
    halt: Option<Halt>,
}

impl<'a> Recorder<'a> {
    /// Nothing has happened yet.
    pub(super) fn new(interpreter: &mut Interpreter, outside: Outside<'a>) -> Self {
        let numbered = interpreter.parameters().into_iter().collect();
        Self {
            outside,
            start: interpreter.settings(),
            steps: Vec::new(),
            events: Vec::new(),
            effects: 0,
            state: Rs274State::default(),
            numbered,
            named: BTreeMap::new(),
            written: BTreeMap::new(),
            elsewhere: false,
            halt: None,
        }
    }

    /// Executed blocks so far.
    pub(super) fn steps(&self) -> u32 {
        u32::try_from(self.steps.len()).unwrap_or(u32::MAX)
    }

    /// Effects so far.
    pub(super) fn effects(&self) -> u32 {
        self.effects
    }

    /// Seconds since the start.
    pub(super) fn time(&self) -> f64 {
        self.outside.time()
    }

    /// Why nothing goes on.
    pub(super) fn halt(&self) -> Option<Halt> {
        self.halt
    }

    /// The whole outcome. What a block did that was not finished is left out.
    pub(super) fn outcome(self, end: End, parameters: Indexed<u32, f64>) -> Outcome {
        Outcome {
            language: Language::Rs274,
            start: self.start,
            steps: self.steps,
            end,
            parameters: Some(parameters),
            pins: Vec::new(),
            samples: Vec::new(),
        }
    }

    /// What changed since a state was recorded last. After a call or return the level is recorded anew, and with it the local
    /// named parameters that exist.
    fn changes(&mut self, done: &BlockDone<'_>) -> Rs274State {
        if std::mem::take(&mut self.elsewhere) {
            self.state.call_level = None;
            self.named.retain(|name, _| !is_local_name(name));
        }
        let now = done.state();
        let mut changes = now.since(&self.state);
        self.state = now;
        let mut changed = BTreeMap::new();
        for (number, value) in std::mem::take(&mut self.written) {
            if self.numbered.insert(number, value).or(Some(0.0)) != Some(value) {
                changed.insert(number.to_string(), value);
            }
        }
        for (name, value) in done.named() {
            if self.named.get(name) != Some(&value) {
                self.named.insert(name.to_owned(), value);
                changed.insert(name.to_owned(), value);
            }
        }
        changes.parameter = (!changed.is_empty()).then_some(Indexed(changed));
        changes
    }
}

impl Sink for Recorder<'_> {
    fn set(&mut self, _line: u32, changed: &Settings) {
        self.events.push(Event::Set(changed.clone()));
    }

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        if self.halt.is_some() {
            return Reply::Stop;
        }
        let mut effect = effect.clone();
        let reply = match self.outside.perform(&effect) {
            Answer::Reply(reply) => reply,
            Answer::Never => {
                self.halt = Some(Halt::WaitsForEver);
                return Reply::Stop;
            }
        };
        if let (Effect::WaitInput { read, .. }, Reply::Input(value)) = (&mut effect, reply) {
            *read = value;
        }
        // The switch for M1 is the operator's, and off where there is none.
        let pauses = matches!(effect, Effect::Stop { optional: false });
        self.events.push(Event::Do(effect));
        self.effects = self.effects.saturating_add(1);
        if pauses {
            self.halt = Some(Halt::Pauses);
            return Reply::Stop;
        }
        reply
    }

    fn probe(&mut self, _line: u32, effect: &Effect, probing: &Probing) -> Reply {
        if self.halt.is_some() {
            return Reply::Stop;
        }
        let found = match self.outside.probe(probing) {
            Ok(found) => found,
            Err(kind) => return Reply::Failed(kind),
        };
        let mut effect = effect.clone();
        let mut touched = None;
        if let Effect::StraightProbe { end, contact } = &mut effect {
            touched = found.map(
                |point| {
                    if point == probing.to() { *end } else { probing.program(point) }
                },
            );
            *contact = touched;
        }
        self.events.push(Event::Do(effect));
        self.effects = self.effects.saturating_add(1);
        Reply::Contact(touched)
    }

    fn block_done(&mut self, done: &mut BlockDone<'_>) {
        if self.halt == Some(Halt::WaitsForEver) {
            return;
        }
        let written = &mut self.written;
        done.take_numbered(|number, value| {
            written.insert(number, value);
        });
        let with_state = match done.executed() {
            // A pause is over, and the block with it, once somebody lets the program go on.
            Executed::Words => self.halt.is_none(),
            // A comment that says nothing is no block.
            Executed::Comment if self.events.is_empty() => return,
            Executed::Comment => true,
            Executed::End => {
                self.elsewhere |= self.state.call_level != Some(0);
                true
            }
            Executed::OWord => false,
            Executed::Call
            | Executed::Return
            | Executed::NumberedCall
            | Executed::NumberedReturn => {
                self.elsewhere = true;
                false
            }
        };
        let state = with_state.then(|| State::Rs274(self.changes(done)));
        let events = std::mem::take(&mut self.events);
        self.steps.push(Step { block: Block::new(done.file(), done.line()), events, state });
    }
}
