//! Passes effects and settings from the interpreter to the machine, each at the time when the machine may have it.

use gaugeblock_vocabulary::{Effect, FaultKind, Settings};

use crate::block_end::BlockEnd;
use crate::block_start::BlockStart;
use crate::canon::{Reply, Sink, Waiting};
use crate::faults::{PlantedFault, planted};
use crate::probe_move::ProbeMove;

use super::machine::{ExternalOperation, Machine};
use super::motion_hold::{Motion, motion_of};
use super::pins::bit;
use super::state::{AbortCause, Pause, RunKind, TaskState};
use super::waits::Aborted;

impl<M: Machine> TaskState<M> {
    /// Performs a move: it begins when nothing holds it, and with it outputs change (`switches` is false only as a
    /// planted fault).
    fn perform_move(
        &mut self,
        motion: Motion,
        switches: bool,
        perform: impl FnOnce(&mut M) -> Reply,
    ) -> Reply {
        while self.holds(motion) || self.pause.is_some() {
            if self.wait_for_resume().is_err() {
                return self.abort_reply();
            }
        }
        self.release_place();
        let reply = perform(&mut self.machine);
        if switches && !matches!(reply, Reply::Failed(_) | Reply::Aborted | Reply::ReadOnly) {
            let digital = self.digital.begin_motion();
            let held = motion == Motion::Rapid && planted(PlantedFault::AnalogAtFeed);
            if !held && self.analog.begin_motion() || digital {
                self.update_pins();
            }
        }
        reply
    }

    /// The reply to an effect that was aborted. Where the interpreter reads ahead it continues, except for an effect
    /// that waits for the machine.
    pub(super) fn abort_reply(&mut self) -> Reply {
        if self.abort_cause == Some(AbortCause::Operator)
            && self.choices.read_ahead_on_abort
            && self.run_kind == RunKind::Program
        {
            self.reading_ahead = true;
            return Reply::ReadOnly;
        }
        Reply::Aborted
    }

    /// M0, M1, M60 (11.6.2, 11.6.4).
    fn stop(&mut self, optional: bool, effect: &Effect) -> Reply {
        let pallets = core::mem::take(&mut self.pallets_exchanged);
        let reply = self.machine.perform(self.line, effect);
        let switch = if planted(PlantedFault::SwitchAtStart) {
            self.optional_stop_before
        } else {
            self.panel.optional_stop
        };
        let ignores = optional && !switch;
        if ignores || reply != Reply::Done {
            return reply;
        }
        if self.run_kind == RunKind::Mdi {
            if self.call_level != 0 {
                return self.leave_unspecified("a pause in a sub that was called by hand");
            }
            return reply;
        }
        self.pause = Some(if pallets { Pause::Pallets } else { Pause::Stop });
        while self.pause.is_some() {
            if self.wait_for_resume().is_err() {
                return self.abort_reply();
            }
        }
        reply
    }

    /// The documents leave open what follows.
    pub(super) fn leave_unspecified(&mut self, why: &'static str) -> Reply {
        self.abort_cause = Some(AbortCause::Unspecified(why));
        Reply::Aborted
    }

    /// M6. Where a person changes tools, a prompt comes first.
    fn change_tool(&mut self, tool: i32, effect: &Effect) -> Reply {
        if self.machine.prompts_for_tools() {
            let prompt = Effect::PromptTool { tool };
            let reply = self.machine.perform(self.line, &prompt);
            if reply != Reply::Done {
                return reply;
            }
        }
        self.perform_operation(effect, ExternalOperation::ToolChange)
    }

    /// An effect that an external operation completes.
    fn perform_operation(&mut self, effect: &Effect, operation: ExternalOperation) -> Reply {
        let reply = self.machine.perform(self.line, effect);
        if matches!(reply, Reply::Failed(_) | Reply::Aborted) {
            return reply;
        }
        match self.wait_for(operation, None) {
            Ok(Reply::Done) => reply,
            Ok(other) => other,
            Err(Aborted) if operation == ExternalOperation::ToolChange => {
                self.abort_waiting_reply()
            }
            Err(Aborted) => self.abort_reply(),
        }
    }

    /// The reply to an aborted effect whose outcome the interpreter waits for (9.6.17.4).
    pub(super) fn abort_waiting_reply(&mut self) -> Reply {
        self.aborted_waiting = true;
        Reply::Aborted
    }

    /// Releases the place of what the interpreter has released: the machine is about to receive it, and nothing comes
    /// between.
    fn release_place(&mut self) {
        if let Some(place) = self.released.take() {
            self.machine.release(place);
        }
    }

    /// An effect that is not a motion.
    #[expect(clippy::wildcard_enum_match_arm, reason = "the other effects take no time here")]
    fn perform_motionless(&mut self, effect: &Effect) -> Reply {
        match effect {
            Effect::Dwell { seconds } => {
                if self.pause_dwell().is_err() {
                    return self.abort_reply();
                }
                if planted(PlantedFault::DwellIsMotion) && self.digital.begin_motion() {
                    self.update_pins();
                }
                self.release_place();
                let reply = self.machine.perform(self.line, effect);
                match self.dwell(*seconds) {
                    Ok(()) => reply,
                    Err(Aborted) => self.abort_reply(),
                }
            }
            Effect::Stop { optional } => self.stop(*optional, effect),
            Effect::WaitInput { digital, analog, mode, timeout, .. } => {
                let reply = self.machine.perform(self.line, effect);
                if reply != Reply::Done {
                    return reply;
                }
                self.wait_input((*digital, *analog), *mode, *timeout)
            }
            Effect::ChangeTool { tool } => self.change_tool(*tool, effect),
            Effect::OrientSpindle { spindle, angle, direction } => {
                self.release_place();
                let reply = self.machine.perform(self.line, effect);
                self.tracked.orient(*spindle, *angle, *direction);
                self.update_pins();
                reply
            }
            Effect::WaitOrient { spindle, timeout } => {
                self.release_place();
                self.wait_orient(*spindle, *timeout, effect)
            }
            Effect::UserCode { .. } => {
                self.perform_operation(effect, ExternalOperation::UserProgram)
            }
            Effect::SetDigitalOutput { output, on, timing } => {
                self.release_place();
                self.digital.set(*output, bit(*on), *timing, self.choices.at_once_replaces);
                self.update_pins();
                self.machine.perform(self.line, effect)
            }
            Effect::SetAnalogOutput { output, to, timing } => {
                self.release_place();
                self.analog.set(*output, *to, *timing, self.choices.at_once_replaces);
                self.update_pins();
                self.machine.perform(self.line, effect)
            }
            Effect::ChangeControllerMode { mode } => {
                self.mode = *mode;
                self.machine.perform(self.line, effect)
            }
            _ => {
                match effect {
                    Effect::PalletShuttle {} => self.pallets_exchanged = true,
                    Effect::StartSpindleSynchronisation { .. } => self.synchronised = true,
                    Effect::StopSpindleSynchronisation {} => self.synchronised = false,
                    _ => {}
                }
                self.machine.perform(self.line, effect)
            }
        }
    }

    /// Replies to an effect that is only read. Reading ends at an effect that the machine would have to answer.
    #[expect(clippy::wildcard_enum_match_arm, reason = "only these wait for the machine")]
    fn reply_read_only(&mut self, effect: &Effect) -> Reply {
        match effect {
            Effect::WaitInput { .. } | Effect::StraightProbe { .. } | Effect::ChangeTool { .. } => {
                self.abort_waiting_reply()
            }
            Effect::UserCode { code, .. } if !self.machine.has_user_program(*code) => {
                Reply::Failed(FaultKind::UnknownCode)
            }
            _ => Reply::Done,
        }
    }

    /// M66 has read an input; HAL items are brought up to date with it.
    pub(super) fn finish_input(&mut self, value: f64) -> Reply {
        self.machine.record_input(value);
        self.update_items();
        self.items_changed = !planted(PlantedFault::ItemsNeverNew);
        Reply::Input(value)
    }
}

impl<M: Machine> Sink for TaskState<M> {
    fn set(&mut self, line: u32, changed: &Settings) {
        if self.reading_ahead {
            self.released = None;
            self.settings_ahead.overlay(changed);
            return;
        }
        self.line = line;
        self.release_place();
        self.machine.set(line, changed);
        if self.tracked.set(changed) {
            self.update_pins();
        }
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        if self.reading_ahead {
            self.released = None;
            return self.reply_read_only(effect);
        }
        self.line = line;
        let reply = match motion_of(effect, self.synchronised) {
            Some(motion) => {
                self.perform_move(motion, true, |machine| machine.perform(line, effect))
            }
            None => self.perform_motionless(effect),
        };
        self.released = None;
        reply
    }

    fn hold(&mut self, line: u32, waiting: Waiting<'_>) -> u64 {
        if self.reading_ahead { 0 } else { self.machine.hold(line, waiting) }
    }

    fn release(&mut self, place: u64) {
        self.released = Some(place);
    }

    fn probe(&mut self, line: u32, effect: &Effect, probe_move: &ProbeMove) -> Reply {
        if self.reading_ahead {
            return self.abort_waiting_reply();
        }
        self.line = line;
        let switches = !planted(PlantedFault::ProbeSwitchesNothing);
        let probe = |machine: &mut M| machine.probe(line, effect, probe_move);
        let reply = self.perform_move(Motion::Feed, switches, probe);
        self.aborted_waiting = self.abort_cause.is_some();
        if self.aborted_waiting { Reply::Aborted } else { reply }
    }

    fn start_block(&mut self, start: &BlockStart<'_>) {
        if !self.reading_ahead {
            self.machine.start_block(start);
        }
    }

    fn end_block(&mut self, end: &mut BlockEnd<'_>) {
        if core::mem::take(&mut self.items_changed) {
            end.set_items(&self.items);
        }
        if self.reading_ahead {
            return;
        }
        self.within_block = false;
        self.call_level = end.call_level();
        self.machine.end_block(end);
    }
}
