//! The operator's events while a block begins, waits or is stopped, and while the program pauses.

use gaugeblock_vocabulary::{BlockLocation, End};

use super::request::{Activity, Answer, By};
use super::run::ModelRun;
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::order::Phase;
use crate::rs274::refusal::StepError;

impl ModelRun<'_> {
    /// A block begins: what the operator does at that moment comes before the block.
    pub(super) fn begins(&mut self, block: &BlockLocation) -> Result<(), StepError> {
        self.record.begin();
        self.waits_for_machine = false;
        self.at_block = None;
        self.is_within_block = false;
        self.before_block = None;
        if !self.operator.is_done() || self.pause_asked || self.ahead {
            let now = self.state.environment.time();
            let (events, pauses) = (self.operator.events_left(), self.pause_asked);
            // A dwell before the block may have to wait, so that the time of its begin is open.
            if self.operator.begins(block, now) && self.record.waits() {
                let why = "when a block begins while a compensated move waits for the next one";
                return Err(StepError::Unspecified(why.to_owned()));
            }
            self.between()?;
            if pauses || self.operator.events_left() < events {
                self.before_block = Some(Box::new(self.without_coverage()));
            }
        }
        Ok(())
    }

    /// Between two blocks, and where the text ends: what the operator has done by now, and the pause that was asked
    /// for.
    pub(super) fn between(&mut self) -> Result<(), StepError> {
        // Only what is read ahead begins again where the block did, or where a block of it is refused.
        let may_be_broken_off = self.ahead || self.operator.may_abort();
        if may_be_broken_off && self.state.choices.is(choice::abort::ReadAhead::ReadOn) {
            self.at_block = Some(Box::new(self.without_coverage()));
        }
        loop {
            self.meanwhile(self.state.environment.time(), false)?;
            if !self.pause_asked {
                return Ok(());
            }
            self.stand_paused(Activity::Paused(By::Operator))?;
        }
    }

    /// A phase of the block has taken the time since it began: what the operator did meanwhile.
    ///
    /// Choice pause.during-dwell. A dwell stands still with its program, or goes on. What something outside takes
    /// goes on.
    pub(super) fn took_time_since(&mut self, began: f64, phase: Phase) -> Result<(), StepError> {
        let end = self.state.environment.time();
        if end <= began || self.operator.is_done() {
            return Ok(());
        }
        self.state.environment.within_wait(began);
        let longer = self.meanwhile(end, phase == Phase::Dwell)?;
        self.state.environment.within_wait(end + longer);
        Ok(())
    }

    /// What the operator does up to a time while a block is executed; the seconds by which a pause makes it longer,
    /// where it is a dwell.
    pub(super) fn meanwhile(&mut self, until: f64, dwells: bool) -> Result<f64, StepError> {
        let mut longer = 0.0;
        while let Some(happening) = self.operator.next(until + longer) {
            let now = self.state.environment.time();
            self.state.environment.within_wait(happening.time.max(now));
            if self.request(happening, Activity::Running)? == Answer::Pauses {
                self.pause_asked = true;
                if dwells {
                    longer += self.stand_in_dwell()?;
                }
            }
        }
        Ok(longer)
    }

    /// A dwell of a program that is paused: where it stands still it does so until the program goes on; the seconds
    /// that it took.
    pub(super) fn stand_in_dwell(&mut self) -> Result<f64, StepError> {
        let rule = rule::pause::DURING_DWELL;
        if !self.pause_asked {
            return Ok(0.0);
        }
        self.state.coverage.accepted(rule);
        if self.state.choices.is(choice::pause::DuringDwell::GoesOn) {
            return Ok(0.0);
        }
        self.stand_paused(Activity::Paused(By::Operator))
    }

    /// Rules pause.always, pause.optional, pause.pallet. The program pauses at the end of a block, which
    /// is over once it goes on.
    ///
    /// Rule pause.by-hand. A block entered by hand is followed by a stop anyway: the next one can be entered.
    pub(super) fn paused(&mut self, words: &Words) -> Result<(), StepError> {
        if self.ahead {
            return Ok(());
        }
        if self.by_hand && self.state.call_level() == 0 {
            self.state.coverage.accepted(rule::pause::BY_HAND);
            return Ok(());
        }
        if self.by_hand {
            let why = "a pause in a sub that was called by hand";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        let pallets = words.m.iter().any(|code| matches!(code, 30 | 60));
        let by = if pallets { By::Pallets } else { By::Stop };
        self.stand_paused(Activity::Paused(by)).map(|_| ())
    }

    /// Stands until the operator lets the program go on; the seconds that it took.
    ///
    /// Where the operator does nothing more the run ends here.
    pub(super) fn stand_paused(&mut self, activity: Activity) -> Result<f64, StepError> {
        self.pause_asked = false;
        let began = self.state.environment.time();
        while let Some(happening) = self.operator.next(f64::INFINITY) {
            let now = self.state.environment.time();
            self.state.environment.within_wait(happening.time.max(now));
            if self.request(happening, activity)? == Answer::GoesOn {
                return Ok(self.state.environment.time() - began);
            }
        }
        Err(StepError::Ended(End::Paused))
    }

    /// A block waits for something that never comes: the operator alone can end that.
    pub(super) fn waits_for_ever(&mut self) -> StepError {
        while let Some(happening) = self.operator.next(f64::INFINITY) {
            let now = self.state.environment.time();
            self.state.environment.within_wait(happening.time.max(now));
            match self.request(happening, Activity::Running) {
                Ok(answer) => self.pause_asked |= answer == Answer::Pauses,
                Err(error) => return error,
            }
        }
        StepError::WaitsForEver
    }
}
