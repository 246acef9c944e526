//! The state after an abort.

use gaugeblock_vocabulary::{End, SpindleTurn, Switch};

use super::operator::Operator;
use super::{ModelRun, Record};
use crate::ids::{choice, rule};
use crate::rs274::execute;
use crate::rs274::modes::converted;
use crate::rs274::state::State;

impl ModelRun<'_> {
    /// Rule abort.ends. The run is over, whatever block was broken off.
    ///
    /// Rule abort.autorestore. In a sub with M73 nothing is restored.
    ///
    /// How it ends: what was read ahead may be what the documents leave open.
    pub(super) fn aborted(&mut self) -> End {
        self.state.coverage.accepted(rule::abort::ENDS);
        if self.state.frames.iter().any(|frame| frame.restore_at_return.is_some()) {
            self.state.coverage.accepted(rule::abort::AUTORESTORE);
        }
        self.state.coverage.accepted(rule::abort::READ_AHEAD);
        let reads_on = self.state.choices.is(choice::abort::ReadAhead::ReadOn);
        let end = if reads_on && !self.by_hand && !self.waits_for_machine {
            self.read_on()
        } else {
            End::Aborted
        };
        self.record.put_out();
        execute::compensation::end_of_run(&mut self.state);
        execute::saved_state::run_is_over(&mut self.state);
        self.forget_waiting();
        self.switch_off();
        if self.state.dialect().change_modes_at_abort(&mut self.state) {
            self.switch_off();
        }
        end
    }

    /// Choice outputs.waiting-after-abort. What waits for a motion is gone with the motions that were queued, or
    /// waits for the next one.
    pub(super) fn forget_waiting(&mut self) {
        if self.state.environment.awaits_motion() {
            let choice = rule::outputs::WAITING_AFTER_ABORT;
            self.state.coverage.accepted(choice);
            if self.state.choices.is(choice::outputs::WaitingAfterAbort::Forgotten) {
                self.state.environment.forget_all_with_motion();
            }
        }
    }

    /// Choice abort.spindle-and-coolant. An abort stops all spindles and switches coolant off, as M5 and M9 do
    /// (orient.cleared), or leaves them alone.
    pub(super) fn switch_off(&mut self) {
        self.state.coverage.accepted(rule::abort::SPINDLE_AND_COOLANT);
        if self.state.choices.is(choice::abort::SpindleAndCoolant::SwitchedOff) {
            let modes = &mut self.state.modes;
            modes.mist = Switch::Off;
            modes.flood = Switch::Off;
            for place in self.state.all_spindles() {
                let dialect = self.state.dialect();
                dialect.set_turn(SpindleTurn::Stopped, place, &mut self.state);
            }
        }
        self.update_pins(None);
        self.record.settle(&self.state);
    }

    /// Choice abort.read-ahead. The interpreter has read the block that is broken off as a whole, and on to the next
    /// one that waits for the machine, or to the end: what it made of modes and parameters on the way stays, although
    /// nothing of it was executed.
    ///
    /// Where the documents leave open what a block means that is read ahead, or where nothing ends the reading, they
    /// do not say which state the abort leaves.
    fn read_on(&mut self) -> End {
        let Some(mut state) = self.at_block.take().map(|state| *state) else {
            return End::Aborted;
        };
        state.coverage = crate::RuleCoverage::default();
        state.environment.answers_at_once();
        let control = self.control.clone();
        let mut ahead = ModelRun {
            scenario: self.scenario,
            record: Record::new(&state),
            state,
            control,
            operator: Operator::new(&[]),
            entries: self.entries,
            by_hand: false,
            ahead: true,
            turns: 0,
            pause_asked: false,
            at_block: None,
            waits_for_machine: false,
            is_within_block: false,
            before_block: None,
        };
        let how_far = ahead.program();
        let refused = matches!(how_far, End::Fault(_));
        match ahead.at_block.filter(|_| refused) {
            // A refused block has done nothing.
            Some(before) => self.take_over(*before),
            None => self.take_over(ahead.state),
        }
        match how_far {
            left_open @ (End::Unspecified { .. } | End::Unsupported { .. }) => left_open,
            End::BudgetExhausted { .. } => {
                let block = self.control.files.block(self.control.place);
                End::Unspecified {
                    block,
                    why: "how far an endless program is read ahead".to_owned(),
                }
            }
            End::ProgramEnd
            | End::PercentEnd
            | End::StreamEnd
            | End::Endless
            | End::Aborted
            | End::Paused => End::Aborted,
            End::Fault(fault) => {
                let is_first = self.record.is_empty();
                self.state.dialect().end_before_fault(fault, is_first, &self.state)
            }
        }
    }

    /// Takes over modes and parameters, but not the machine as it is: where it stands, which tools it has and in
    /// which mode the controller is.
    fn take_over(&mut self, ahead: State) {
        let machine = self.state.modes.machine_point(self.state.position);
        let machine = converted(machine, self.state.modes.units, ahead.modes.units);
        let controller_mode = self.state.modes.controller_mode;
        self.state.modes = ahead.modes;
        self.state.modes.controller_mode = controller_mode;
        self.state.parameters = ahead.parameters;
        // Local ones are those of the calls in progress.
        self.state.frames = ahead.frames;
        self.state.position = self.state.modes.program_point(machine);
    }
}
