//! Effects and settings on their way from the interpreter to the machine: each is handed on when the machine may have
//! it.

use gaugeblock_vocabulary::{Effect, FaultKind, Settings};

use crate::begun::BlockBegun;
use crate::canon::{Reply, Sink};
use crate::done::BlockDone;
use crate::faults::{Fault, planted};
use crate::probing::Probing;

use super::desk::{Break, Desk, Doing, Pause};
use super::held::{Motion, motion_of};
use super::machine::{Machine, Work};
use super::pins::bit;
use super::waits::Broken;

impl<M: Machine> Desk<M> {
    /// Performs a move: it begins when nothing holds it, and with it outputs change.
    fn move_(&mut self, motion: Motion, perform: impl FnOnce(&mut M) -> Reply) -> Reply {
        while self.holds(motion) || self.pause.is_some() {
            if self.wait_to_go_on().is_err() {
                return self.broken_off();
            }
        }
        let reply = perform(&mut self.machine);
        if !matches!(reply, Reply::Failed(_) | Reply::Broken | Reply::Ahead) {
            let digital = self.digital.begin_motion();
            if self.analog.begin_motion() || digital {
                self.renew_pins();
            }
        }
        reply
    }

    /// What is answered to an effect that was broken off; where the interpreter reads ahead it goes on, but for what
    /// waits for the machine.
    pub(super) fn broken_off(&mut self) -> Reply {
        if self.broken == Some(Break::Abort) && self.choices.read_on && self.doing == Doing::Program
        {
            self.ahead = true;
            return Reply::Ahead;
        }
        Reply::Broken
    }

    /// M0, M1, M60 (11.6.2, 11.6.4).
    fn stop(&mut self, optional: bool, effect: &Effect) -> Reply {
        let pallets = core::mem::take(&mut self.pallets);
        let reply = self.machine.perform(self.line, effect);
        let ignores = optional && !self.panel.optional_stop;
        if ignores || reply != Reply::Done {
            return reply;
        }
        if self.doing == Doing::ByHand {
            if self.level != 0 {
                return self.leave_open("a pause in a sub that was called by hand");
            }
            return reply;
        }
        self.pause = Some(if pallets { Pause::Pallets } else { Pause::Stop });
        while self.pause.is_some() {
            if self.wait_to_go_on().is_err() {
                return self.broken_off();
            }
        }
        reply
    }

    /// The documents leave open what follows.
    pub(super) fn leave_open(&mut self, why: &'static str) -> Reply {
        self.broken = Some(Break::Open(why));
        Reply::Broken
    }

    /// M6: where a person changes tools, that person is asked first.
    fn change_tool(&mut self, tool: i32, effect: &Effect) -> Reply {
        if self.machine.prompts_for_tools() {
            let prompt = Effect::PromptTool { tool };
            let reply = self.machine.perform(self.line, &prompt);
            if reply != Reply::Done {
                return reply;
            }
        }
        self.work(effect, Work::ToolChange)
    }

    /// An effect that is over when the outside says so.
    fn work(&mut self, effect: &Effect, work: Work) -> Reply {
        let reply = self.machine.perform(self.line, effect);
        if matches!(reply, Reply::Failed(_) | Reply::Broken) {
            return reply;
        }
        match self.wait_for(work, None) {
            Ok(Reply::Done) => reply,
            Ok(other) => other,
            Err(Broken) if work == Work::ToolChange => self.broken_waiting(),
            Err(Broken) => self.broken_off(),
        }
    }

    /// What is answered to an effect for whose outcome the interpreter waits (9.6.17.4), where it was broken off.
    pub(super) fn broken_waiting(&mut self) -> Reply {
        self.awaited = true;
        Reply::Broken
    }

    /// An effect that is no motion.
    #[expect(clippy::wildcard_enum_match_arm, reason = "the other effects take no time here")]
    fn perform_still(&mut self, effect: &Effect) -> Reply {
        match effect {
            Effect::Dwell { seconds } => {
                if self.stand_in_dwell().is_err() {
                    return self.broken_off();
                }
                let reply = self.machine.perform(self.line, effect);
                match self.pass(*seconds) {
                    Ok(()) => reply,
                    Err(Broken) => self.broken_off(),
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
                let reply = self.machine.perform(self.line, effect);
                self.followed.orient(*spindle, *angle, *direction);
                self.renew_pins();
                reply
            }
            Effect::WaitOrient { spindle, timeout } => self.wait_orient(*spindle, *timeout, effect),
            Effect::UserCode { .. } => self.work(effect, Work::UserProgram),
            Effect::SetDigitalOutput { output, on, timing } => {
                self.digital.set(*output, bit(*on), *timing, self.choices.at_once_replaces);
                self.renew_pins();
                self.machine.perform(self.line, effect)
            }
            Effect::SetAnalogOutput { output, to, timing } => {
                self.analog.set(*output, *to, *timing, self.choices.at_once_replaces);
                self.renew_pins();
                self.machine.perform(self.line, effect)
            }
            Effect::ChangeControllerMode { mode } => {
                self.mode = *mode;
                self.machine.perform(self.line, effect)
            }
            _ => {
                match effect {
                    Effect::PalletShuttle {} => self.pallets = true,
                    Effect::StartSpindleSynchronisation { .. } => self.synchronised = true,
                    Effect::StopSpindleSynchronisation {} => self.synchronised = false,
                    _ => {}
                }
                self.machine.perform(self.line, effect)
            }
        }
    }

    /// What is read ahead does nothing; it ends where the machine would have to answer.
    #[expect(clippy::wildcard_enum_match_arm, reason = "only these wait for the machine")]
    fn pass_over(&mut self, effect: &Effect) -> Reply {
        match effect {
            Effect::WaitInput { .. } | Effect::StraightProbe { .. } | Effect::ChangeTool { .. } => {
                self.broken_waiting()
            }
            Effect::UserCode { code, .. } if !self.machine.has_user_program(*code) => {
                Reply::Failed(FaultKind::UnknownCode)
            }
            _ => Reply::Done,
        }
    }

    /// M66 has read an input; HAL items are brought up to date with it.
    pub(super) fn read(&mut self, value: f64) -> Reply {
        self.machine.has_read(value);
        self.renew_items();
        self.items_are_new = !planted(Fault::ItemsNeverNew);
        Reply::Input(value)
    }
}

impl<M: Machine> Sink for Desk<M> {
    fn set(&mut self, line: u32, changed: &Settings) {
        if self.ahead {
            self.set_ahead.overlay(changed);
            return;
        }
        self.line = line;
        self.machine.set(line, changed);
        if self.followed.set(changed) {
            self.renew_pins();
        }
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        if self.ahead {
            return self.pass_over(effect);
        }
        self.line = line;
        match motion_of(effect, self.synchronised) {
            Some(motion) => self.move_(motion, |machine| machine.perform(line, effect)),
            None => self.perform_still(effect),
        }
    }

    fn probe(&mut self, line: u32, effect: &Effect, probing: &Probing) -> Reply {
        if self.ahead {
            return self.broken_waiting();
        }
        self.line = line;
        let reply = self.move_(Motion::Feed, |machine| machine.probe(line, effect, probing));
        self.awaited = self.broken.is_some();
        if self.awaited { Reply::Broken } else { reply }
    }

    fn block_begun(&mut self, begun: &BlockBegun<'_>) {
        if !self.ahead {
            self.machine.block_begun(begun);
        }
    }

    fn block_done(&mut self, done: &mut BlockDone<'_>) {
        if core::mem::take(&mut self.items_are_new) {
            done.set_items(&self.items);
        }
        if self.ahead {
            return;
        }
        self.within = false;
        self.level = done.call_level();
        self.machine.block_done(done);
    }
}
