//! Moves are held where they begin, each for itself, and the operator acts in the dwells and waits between them.
//!
//! A canned cycle is its moves and dwells, and what it computes does not depend on how long they
//! take. So a phase that may be held is executed up to the first move or dwell that takes time; the operator acts
//! there; and then it is executed again, with that wait in its place.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::{Compensation, End};

use super::request::{Activity, Answer, By};
use super::run::ModelRun;
use super::watch::{Waited, Watch, Why};
use crate::rs274::evaluate::Words;
use crate::rs274::execute;
use crate::rs274::execute::move_start::{self, Speed};
use crate::rs274::order::{self, AfterPhase, Phase};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

impl ModelRun<'_> {
    /// Whether a move of the phase may be held, or somebody may act between its moves or its waits.
    pub(super) fn is_watched(&self, phase: Phase, words: &Words) -> bool {
        let environment = &self.state.environment;
        let may_be_held = self.pause_asked || move_start::may_be_held(&self.state);
        let acts_between = || self.operator.is_due() || environment.next_change_of_feed().is_some();
        let dwells = || phase == Phase::Motion && super::program::is_cycle(words, &self.state);
        let moves = matches!(phase, Phase::Motion | Phase::OffsetData | Phase::ChangeTool);
        let orients = phase == Phase::Spindle && words.m.contains(&19);
        let reads = phase == Phase::InputsOutputs && words.m.contains(&66);
        !self.ahead
            && (moves && (may_be_held || acts_between() && dwells())
                || (orients || reads) && self.operator.is_due())
    }

    /// Executes a phase whose moves may be held.
    ///
    /// Rules overrides.feed-influence, overrides.adaptive-feed-zero, overrides.feed-stop-holds. A move begins only
    /// once the feed is not held, and the program not paused. Until then the block stands, and the operator or an
    /// input may change what holds it.
    ///
    /// An abort leaves the point where the last move has led, and a spindle as it was told; the rest of the phase has
    /// not been done.
    ///
    /// `began` becomes the time of the last wait.
    pub(super) fn watched(
        &mut self,
        phase: Phase,
        words: &Words,
        began: &mut f64,
    ) -> Result<AfterPhase, StepError> {
        let before = self.without_coverage();
        let mark = self.record.mark();
        let mut watch = Watch {
            place: 0,
            from: 0,
            waited: BTreeMap::new(),
            pause_asked: self.pause_asked,
            operator_is_due: self.operator.is_due(),
            position: self.state.position,
            stop: None,
        };
        loop {
            self.record.watch = Some(watch);
            let done = order::execute_phase(phase, words, &mut self.state, &mut self.record);
            watch = self.record.watch.take().expect("moves: it was set for the phase");
            let Some(stop) = watch.stop.take() else { return done };
            self.state = *stop.state;
            self.record.back_to(stop.record.clone());
            self.update_pins(None);
            if let Err(error) = self.waits_for(stop.why) {
                if error == StepError::Ended(End::Aborted) {
                    self.breaks_off(phase, before);
                }
                return Err(error);
            }
            *began = self.state.environment.time();
            let waited = Waited {
                environment: self.state.environment.clone(),
                panel: self.state.panel.clone(),
                refused: self.record.effects_since(&stop.record),
            };
            watch.from = watch.place;
            watch.waited.insert(watch.place - 1, waited);
            watch = Watch {
                place: 0,
                pause_asked: self.pause_asked,
                operator_is_due: self.operator.is_due(),
                position: before.position,
                ..watch
            };
            let coverage = std::mem::take(&mut self.state.coverage);
            self.state = State { coverage, ..before.clone() };
            self.record.back_to(mark.clone());
        }
    }

    /// Waits until a move may begin or a dwell is over.
    fn waits_for(&mut self, why: Why) -> Result<(), StepError> {
        match why {
            Why::Move(speed) => self.may_move(speed),
            Why::Dwell(seconds) | Why::Wait(seconds) => {
                let end = self.state.environment.time() + seconds;
                let longer = self.meanwhile(end, matches!(why, Why::Dwell(_)))?;
                self.state.environment.within_wait(end + longer);
                execute::pass(0.0, &mut self.state);
                Ok(())
            }
        }
    }

    /// A move begins only once nothing holds it, and the program is not paused.
    ///
    /// # Errors
    /// An abort. A move under compensation is held: whether it or the one before it waits, the documents leave open.
    fn may_move(&mut self, speed: Speed) -> Result<(), StepError> {
        if self.state.modes.compensation != Compensation::Off
            && (self.pause_asked || move_start::is_held(speed, &mut self.state))
        {
            let why = "a compensated move that is held, while the one before it waits for it";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        if self.pause_asked {
            self.stand_paused(Activity::Paused(By::Operator))?;
        }
        while move_start::is_held(speed, &mut self.state) {
            self.state.dialect().motion_is_held(&mut self.state);
            let change = self.state.environment.next_change_of_feed();
            let now = self.state.environment.time();
            if let Some(happening) = self.operator.next(change.unwrap_or(f64::INFINITY)) {
                self.state.environment.within_wait(happening.time.max(now));
                if self.request(happening, Activity::Running)? == Answer::Pauses {
                    self.stand_paused(Activity::Paused(By::Operator))?;
                }
            } else if let Some(change) = change {
                self.state.environment.within_wait(change);
            } else {
                return Err(StepError::Ended(End::Paused));
            }
        }
        Ok(())
    }

    /// The phase has been broken off where it waited.
    fn breaks_off(&mut self, phase: Phase, before: State) {
        let after = std::mem::replace(&mut self.state, before);
        self.broken_off(phase, &after);
        self.state.position = after.position;
        self.state.environment = after.environment;
        self.state.panel = after.panel;
        self.state.coverage = after.coverage;
        self.state.dialect().axes_are_at(after.position, &mut self.state);
    }
}
