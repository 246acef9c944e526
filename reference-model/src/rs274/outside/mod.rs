//! The outside of the controller: its clock, its pins, and how a bench answers.
//!
//! Time is virtual, in seconds since the start. Only dwells and waits move it, so that a run is the same on every day.

use std::collections::BTreeMap;

use gaugeblock_trace::scenario::Bench;
use gaugeblock_trace::{Pin, PinChange};

/// The named bench that answers as the stand-alone interpreter's stubs do.
const STAND_ALONE: &str = "stand-alone rs274";

/// What is outside of the controller, and what it shows there.
#[derive(Clone, Debug)]
pub struct Outside {
    /// How inputs answer.
    bench: Bench,
    /// Seconds since the start.
    time: f64,
    /// The value of each pin that is not zero, or was not.
    levels: BTreeMap<Pin, f64>,
    /// Every change of a pin so far.
    changes: Vec<PinChange>,
}

impl Outside {
    /// The outside before the first block: all outputs are off.
    pub fn new(bench: &Bench) -> Self {
        Self { bench: bench.clone(), time: 0.0, levels: BTreeMap::new(), changes: Vec::new() }
    }

    /// Whether everything outside answers as the stand-alone interpreter's stubs do.
    pub fn is_stand_alone(&self) -> bool {
        self.bench.name.as_deref() == Some(STAND_ALONE)
    }

    /// Seconds since the start.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Lets time go by.
    pub fn advance(&mut self, seconds: f64) {
        self.time += seconds.max(0.0);
    }

    /// Goes back to a moment within a wait that was counted as a whole, for what the operator did meanwhile.
    pub fn within_wait(&mut self, time: f64) {
        self.time = time;
    }

    /// The value of a pin.
    pub fn level(&self, pin: Pin) -> f64 {
        self.levels.get(&pin).copied().unwrap_or(0.0)
    }

    /// Gives a pin a value, now.
    pub fn set(&mut self, pin: Pin, value: f64) {
        if (self.level(pin) - value).abs() > 0.0 {
            self.levels.insert(pin, value);
            self.changes.push(PinChange { time: self.time, pin, value });
        }
    }

    /// Every change of a pin, in order.
    pub fn into_changes(self) -> Vec<PinChange> {
        self.changes
    }

    /// The value of the adaptive feed input now; full speed until it is listed.
    pub fn adaptive_feed(&self) -> f64 {
        self.value("adaptive_feed").unwrap_or(1.0)
    }

    /// Whether the feed stop input asks for a stop now.
    pub fn feed_stop(&self) -> bool {
        self.value("feed_hold").unwrap_or(0.0) != 0.0
    }

    fn value(&self, name: &str) -> Option<f64> {
        let changes = self.bench.inputs.iter();
        let past = changes.filter(|change| change.input == name && change.time <= self.time);
        past.map(|change| change.value).next_back()
    }

    /// When an input that concerns the feed changes next.
    pub fn next_change_of_feed(&self) -> Option<f64> {
        let names = ["adaptive_feed", "feed_hold"];
        let changes = self.bench.inputs.iter();
        let later = changes
            .filter(|change| names.contains(&change.input.as_str()) && change.time > self.time);
        later.map(|change| change.time).min_by(f64::total_cmp)
    }
}
