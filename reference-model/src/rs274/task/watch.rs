//! The moves and waits of a phase, looked at one by one.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::{Effect, Event, Position};

use super::effects::Waiting;
use crate::rs274::environment::EnvironmentState;
use crate::rs274::execute::move_start::{Speed, is_held};
use crate::rs274::modes::Modes;
use crate::rs274::state::{Panel, State};

/// What has been observed of a block so far.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    pub(super) events: Vec<Event>,
    pub(super) modes: Modes,
    pub(super) effects: u32,
    pub(super) in_step: bool,
    pub(super) waiting: Vec<Waiting>,
}

/// The moves and dwells of a phase, looked at one by one.
#[derive(Clone, Debug)]
pub(super) struct Watch {
    /// How many of them there were so far.
    pub(super) place: usize,
    /// Those before this one have been waited for, or need not be.
    pub(super) from: usize,
    /// The result of each wait, by the place of its move or dwell.
    pub(super) waited: BTreeMap<usize, Waited>,
    /// Whether the program is to pause before the next move.
    pub(super) pause_asked: bool,
    /// Whether the operator may act in a dwell.
    pub(super) operator_is_due: bool,
    /// Where the controlled point is, program coordinates, active length unit.
    pub(super) position: Position,
    /// Where the phase waits; what it computes after that has not happened.
    pub(super) stop: Option<Stop>,
}

/// What a wait has changed.
#[derive(Clone, Debug)]
pub(super) struct Waited {
    pub(super) environment: EnvironmentState,
    pub(super) panel: Panel,
    /// What the controller refused meanwhile.
    pub(super) refused: Vec<Effect>,
}

/// Where a phase waits.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    /// The state there.
    pub(super) state: Box<State>,
    /// What is recorded of the block there.
    pub(super) record: Mark,
    pub(super) why: Why,
}

/// What a phase waits for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Why {
    /// That a move may begin.
    Move(Speed),
    /// That a dwell of so many seconds is over.
    Dwell(f64),
    /// That something outside is done, which takes so many seconds.
    Wait(f64),
}

/// When a move or a dwell begins.
#[derive(Clone, Debug)]
pub(super) enum Begins {
    /// Now: nothing holds it.
    AtOnce,
    /// After a wait that is over, in which the controller refused this; a dwell is over with it.
    After(Vec<Effect>),
    /// Not before it has been waited for.
    Later,
}

impl Watch {
    /// Whether the phase waits.
    pub(super) fn has_stopped(&self) -> bool {
        self.stop.is_some()
    }

    /// A move or a dwell begins. Where it has been waited for, that takes place.
    pub(super) fn comes_to(&mut self, why: Why, state: &mut State) -> Begins {
        let place = self.place;
        self.place += 1;
        if let Some(waited) = self.waited.get(&place) {
            state.environment.clone_from(&waited.environment);
            state.panel.clone_from(&waited.panel);
            state.pin_snapshot = None;
            return Begins::After(waited.refused.clone());
        }
        let waits = place >= self.from
            && match why {
                Why::Move(speed) => self.pause_asked || is_held(speed, state),
                Why::Dwell(_) | Why::Wait(_) => self.operator_is_due,
            };
        if waits { Begins::Later } else { Begins::AtOnce }
    }

    /// The phase waits here.
    pub(super) fn stops(&mut self, why: Why, record: Mark, state: &State) {
        let state = Box::new(State { position: self.position, ..state.clone() });
        self.stop = Some(Stop { state, record, why });
    }

    /// A move has been made.
    pub(super) fn moved(&mut self, state: &State) {
        self.position = state.position;
    }
}
