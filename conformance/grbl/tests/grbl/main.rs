//! The adapter against a simulator of the protocol, at a pseudo-terminal and at a socket.

mod misbehaviour;
mod motion;
mod programs;
mod recorded;
mod simulator;
mod transcripts;

use std::time::Duration;

use gaugeblock_adapter::{Adapter as _, ControllerError, HarnessError};
use gaugeblock_grbl::{Grbl, Limits, Setup};
use gaugeblock_vocabulary::{Outcome, Rs274State, Scenario, Settings, State};

use simulator::Running;

/// So long that only a controller that never answers reaches them.
const PATIENT: Limits = Limits {
    answer: Duration::from_secs(300),
    start: Duration::from_secs(300),
    motion: Duration::from_secs(300),
};

/// Short waits, for controllers that do not answer.
const IMPATIENT: Limits = Limits { answer: Duration::from_secs(3), ..PATIENT };

/// Opens a running simulator.
fn open(running: &Running, options: &str, limits: Limits) -> Result<Grbl, ControllerError> {
    let setup = Setup::read(&format!("{}?{options}", running.address)).expect("a setup");
    Grbl::open(setup, limits)
}

fn opened(running: &Running, options: &str) -> Grbl {
    opened_at(&running.address, options)
}

fn opened_at(address: &str, options: &str) -> Grbl {
    let setup = Setup::read(&format!("{address}?{options}")).expect("a setup");
    Grbl::open(setup, PATIENT).unwrap_or_else(|error| panic!("{error}"))
}

fn run(grbl: &Grbl, program: &str) -> Result<Outcome, HarnessError> {
    grbl.run(&Scenario::of(program))
}

fn outcome(grbl: &Grbl, program: &str) -> Outcome {
    run(grbl, program).unwrap_or_else(|error| panic!("{error}"))
}

/// Settings and state after all steps, with the settings at the start.
fn last(outcome: &Outcome) -> (Settings, Rs274State) {
    let (mut settings, mut state) = (outcome.start.clone(), Rs274State::default());
    for step in &outcome.steps {
        for event in &step.events {
            if let gaugeblock_vocabulary::Event::Set(change) = event {
                settings.overlay(change);
            }
        }
        if let Some(State::Rs274(change)) = &step.state {
            state.overlay(change);
        }
    }
    (settings, state)
}
