//! While no program runs: blocks entered by hand, and cycle start.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_vocabulary::scenario::Action;
use gaugeblock_vocabulary::{ControllerMode, End};

use super::request::{Activity, Answer};
use super::run::{ModelRun, open_entries};
use crate::ids::rule;
use crate::rs274::control::{Control, Frame, MAIN, Place};
use crate::rs274::execute;
use crate::rs274::refusal::StepError;
use crate::rs274::text::Line;

/// What comes after the controller was idle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Then {
    /// Nothing: the operator does nothing more.
    Nothing,
    /// The program, from its first block.
    Begin,
}

impl ModelRun<'_> {
    /// The controller waits for the operator. A block by hand that ends a program, or is broken off, is how the run
    /// ended.
    pub(super) fn idle(&mut self, end: &mut End) -> Result<Then, StepError> {
        self.pause_asked = false;
        while let Some(happening) = self.operator.next(f64::INFINITY) {
            let now = self.state.environment.time();
            self.state.environment.within_wait(happening.time.max(now));
            match self.request(happening, Activity::Idle)? {
                Answer::Begins => {
                    self.begin_again(*end == End::Aborted);
                    return Ok(Then::Begin);
                }
                Answer::Executes(event) => {
                    if let Some(ended) = self.entry(event)? {
                        *end = ended;
                    }
                }
                Answer::Nothing | Answer::Pauses | Answer::GoesOn => {}
            }
        }
        // An orientation that was in progress at an abort is completed.
        while let Some(time) = self.state.environment.next_orientation() {
            self.state.environment.within_wait(time);
            self.update_pins(None);
        }
        Ok(Then::Nothing)
    }

    /// Rule program-end.restart. Cycle start starts the program at the beginning of the file, in auto mode.
    /// Rule abort.restart. After an abort too.
    /// Rule parameters.returned-value. What the last program's subs have returned is 0 then.
    fn begin_again(&mut self, aborted: bool) {
        let rule = if aborted { rule::abort::RESTART } else { rule::program_end::RESTART };
        self.state.coverage.accepted(rule);
        if !aborted {
            self.state.coverage.accepted(rule::task::MODES_CARRY_OVER);
            self.state.coverage.accepted(rule::task::PARAMETERS_CARRY_OVER);
        }
        self.change_mode_to(ControllerMode::Auto);
        self.begin_anew();
        execute::saved_state::run_is_over(&mut self.state);
        self.state.dialect().forget_returned_value(&mut self.state);
        self.read_from_the_beginning();
    }

    /// Reads the program from its first line and forgets its definitions.
    pub(super) fn read_from_the_beginning(&mut self) {
        self.control = Control::new(&self.scenario.program, &mut self.state);
        self.entries = open_entries(self.scenario, &mut self.control, &mut self.state);
        self.forget_structures();
    }

    /// Forgets the conditions and loops of the main program.
    fn forget_structures(&mut self) {
        let main = &mut self.state.frames[0];
        *main = Frame {
            call: None,
            open: Vec::new(),
            ended_conditions: BTreeSet::new(),
            ended_loops: BTreeMap::new(),
            ..std::mem::take(main)
        };
    }

    /// What ran before is over: with it every call, and every condition and loop; HAL is seen as it is now
    /// (parameters.hal-time).
    ///
    /// Rule task.parameters-carry-over. What is local to the main program has its value again in the next run, as all
    /// that is global has.
    ///
    /// Rule saved-state.main-level. What a block by hand has saved is saved for the next one.
    fn begin_anew(&mut self) {
        if self.state.call_level() > 0 {
            self.record.leads_elsewhere();
        }
        self.leave_calls();
        self.state.environment.synchronise();
        self.forget_structures();
    }

    /// A block that the operator enters by hand; how it ended when it ended the program.
    fn entry(&mut self, event: usize) -> Result<Option<End>, StepError> {
        let earlier = self.scenario.operator.iter().take(event);
        let entered = earlier.filter(|event| matches!(event.action, Action::Mdi(_))).count();
        let line = u32::try_from(entered).unwrap_or(u32::MAX).saturating_add(1);
        let back = self.control.place;
        let end = self.by_hand(Place { line, ..self.entries })?;
        self.control.place = back;
        Ok(end)
    }

    /// Executes a block entered by hand, with all that it calls.
    ///
    /// How it ended when it ended the program; an abort leaves the controller idle.
    fn by_hand(&mut self, place: Place) -> Result<Option<End>, StepError> {
        self.begin_anew();
        self.by_hand = true;
        self.control.begin_by_hand(place);
        let after = Place { line: place.line + 1, ..place };
        let end = loop {
            if let Some(bound) = self.exhausted() {
                return Err(StepError::Ended(End::BudgetExhausted { bound }));
            }
            match self.next() {
                Ok(None) if self.control.place == after && self.state.call_level() == 0 => {
                    break None;
                }
                Ok(None) => {}
                Ok(Some(end)) => break Some(end),
                Err(error @ StepError::Ended(End::Aborted)) => break Some(self.end_after(error)),
                Err(error) => return Err(error),
            }
        };
        self.by_hand = false;
        Ok(end)
    }

    /// Each line of the main program, entered by hand one after the other.
    ///
    /// A session that does not end with a program end waits for the operator.
    pub(super) fn lines_by_hand(&mut self) -> End {
        let mut place = Place { file: MAIN, line: 1 };
        let mut end = End::Paused;
        while let Some(line) = self.control.files.line(place, &mut self.state) {
            let done = match line {
                Line::Nothing | Line::Skipped(_) => Ok(None),
                Line::Block(_) | Line::End => {
                    self.by_hand(place).map(|end| Some(end.unwrap_or(End::Paused)))
                }
            };
            match done {
                Ok(None) => {}
                Ok(Some(after)) => end = after,
                Err(error) => {
                    return self.end_after(error);
                }
            }
            place.line += 1;
        }
        end
    }
}
