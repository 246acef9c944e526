//! The environment of the controller: its clock, its pins, and how what is connected to it answers.
//!
//! Time is virtual, in seconds since the start. Only dwells and waits move it, so that a run is the same on every day.

mod feed;
mod hal;
mod inputs;
mod orientation;
mod probe;
mod programs;
mod state;
pub(crate) mod stub;

use std::collections::BTreeMap;

use gaugeblock_vocabulary::scenario::Environment;
use gaugeblock_vocabulary::{Pin, PinChange, Shared};

use crate::Choices;
use crate::ids::choice;
pub(crate) use hal::Item;
pub(crate) use inputs::{Awaited, Input};
pub(crate) use probe::Wanted;
pub(crate) use programs::Missing;
pub use state::EnvironmentState;
pub(crate) use state::Orientation;
use state::{Stub, Synchronised};

/// The name of the environment that behaves like the stubs of the interpreter program `rs274`.
const STAND_ALONE: &str = "stand-alone rs274";

impl EnvironmentState {
    /// The environment before the first block: all outputs are off.
    ///
    /// Choice orient.brake-otherwise: whether the brake of a stopped spindle is applied.
    pub fn new(environment: &Environment, spindles: usize, choices: &Choices) -> Self {
        let braked = choices.is(choice::orient::BrakeOtherwise::WhileStanding);
        let brakes = (0..if braked { spindles } else { 0 })
            .filter_map(|spindle| Some((Pin::SpindleBrake(u16::try_from(spindle).ok()?), 1.0)));
        let mut state = Self {
            scenario: environment.clone().into(),
            time: 0.0,
            levels: brakes.collect(),
            changes: Shared::default(),
            awaiting_motion: BTreeMap::new(),
            orienting: BTreeMap::new(),
            is_asked: false,
            last_orientations: BTreeMap::new(),
            probed: None,
            synchronised: Synchronised::default(),
            stub: Stub::default(),
        };
        state.synchronise();
        state
    }

    /// Whether the environment behaves like the stubs of the interpreter program `rs274`.
    pub fn is_stand_alone(&self) -> bool {
        self.scenario.name.as_deref() == Some(STAND_ALONE)
    }

    /// Seconds since the start.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Seconds that the tool changer takes.
    pub fn tool_change_time(&self) -> f64 {
        self.scenario.tool_change_time.max(0.0)
    }

    /// Whether a person changes the tools, after a prompt.
    pub fn tools_are_changed_by_hand(&self) -> bool {
        self.scenario.manual_tool_change
    }

    /// Lets time go by.
    pub fn advance(&mut self, seconds: f64) {
        self.time += seconds.max(0.0);
    }

    /// Goes to a moment of a wait that was counted as a whole, for what the operator did meanwhile.
    pub fn within_wait(&mut self, time: f64) {
        self.time = time;
    }

    /// A wait that was counted as a whole is broken off now: what would have come about by its end has not, neither
    /// on the pins nor with spindles on their way.
    ///
    /// There were so many changes of pins when the wait was counted; what has changed since is what somebody did
    /// meanwhile.
    pub(crate) fn drop_what_was_to_come(&mut self, before: &Self, counted: usize) {
        let known = before.changes.len();
        let (began, now) = (before.time, self.time);
        let meanwhile = self.changes.split_off(counted);
        let later = self.changes.split_off(known);
        self.levels.clone_from(&before.levels);
        let has_come = |change: &PinChange| change.time < now || change.time <= began;
        for change in later.into_iter().filter(has_come).chain(meanwhile) {
            self.levels.insert(change.pin, change.value);
            self.changes.push(change);
        }
        for (spindle, orientation) in self.last_orientations.clone() {
            let pin = u16::try_from(spindle).ok().map(Pin::SpindleOrient);
            if pin.is_some_and(|pin| self.level(pin) != 0.0) {
                self.orienting.insert(spindle, orientation);
            }
        }
    }

    /// The value of a pin.
    pub fn level(&self, pin: Pin) -> f64 {
        self.levels.get(&pin).copied().unwrap_or(0.0)
    }

    /// Gives a pin a value, now.
    pub fn set(&mut self, pin: Pin, value: f64) {
        self.set_at(self.time, pin, value);
    }

    /// Gives a pin a value at a time that has just gone by.
    pub(crate) fn set_at(&mut self, time: f64, pin: Pin, value: f64) {
        if (self.level(pin) - value).abs() > 0.0 {
            self.levels.insert(pin, value);
            self.changes.push(PinChange { time, pin, value });
        }
    }

    /// Gives an output a value when the next motion begins. Of several values the last one counts; returns whether
    /// there was an earlier one.
    pub fn set_with_motion(&mut self, pin: Pin, value: f64) -> bool {
        self.awaiting_motion.insert(pin, value).is_some()
    }

    /// Takes back what an output was to become.
    pub fn forget_with_motion(&mut self, pin: Pin) {
        self.awaiting_motion.remove(&pin);
    }

    /// Takes back what every output was to become.
    pub fn forget_all_with_motion(&mut self) {
        self.awaiting_motion.clear();
    }

    /// Whether an output is to become something when the next motion begins.
    pub fn awaits_motion_with(&self, pin: Pin) -> bool {
        self.awaiting_motion.contains_key(&pin)
    }

    /// A motion begins: the outputs that wait for one switch. Tells whether there were any.
    pub fn motion_begins(&mut self) -> bool {
        let waiting = std::mem::take(&mut self.awaiting_motion);
        for (pin, value) in &waiting {
            self.set(*pin, *value);
        }
        !waiting.is_empty()
    }

    /// Whether an output waits for a motion.
    pub fn awaits_motion(&self) -> bool {
        !self.awaiting_motion.is_empty()
    }

    /// Every change of a pin so far.
    pub fn changes(&self) -> &[PinChange] {
        &self.changes
    }
}
