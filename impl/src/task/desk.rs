//! The desk between interpreter and machine: it takes every setting and effect, and hands each on when the machine may have it.

use alloc::vec::Vec;

use gaugeblock_trace::{ControllerMode, Effect, Pin, Position, Settings};

use crate::begun::BlockBegun;
use crate::canon::{Reply, Sink};
use crate::done::BlockDone;
use crate::error::Error;
use crate::faults::{Fault, planted};
use crate::interpret::Interpreter;
use crate::probing::Probing;

use super::choices::Choices;
use super::held::{Motion, motion_of};
use super::items;
use super::machine::{Machine, Work};
use super::outputs::Outputs;
use super::panel::Panel;
use super::pins::{Followed, bit};
use super::waits::Broken;

/// What the controller is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Doing {
    /// It is idle.
    Nothing,
    /// It runs a program.
    Program,
    /// It executes a block that was entered by hand.
    ByHand,
}

/// Why a program pauses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pause {
    /// M0 or M1.
    Stop,
    /// M60.
    Pallets,
    /// The operator asked for it.
    Asked,
}

/// What it waits for that will never come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stuck {
    /// That somebody lets the program go on, or motion.
    Paused,
    /// An input, or something else outside.
    Waiting,
}

/// How a block was broken off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Break {
    /// By the operator.
    Abort,
    /// The documents leave open what follows.
    Open(&'static str),
    /// Nothing will ever happen again.
    Stuck(Stuck),
}

/// The desk.
#[derive(Debug)]
pub(super) struct Desk<M> {
    pub(super) machine: M,
    pub(super) panel: Panel,
    pub(super) mode: ControllerMode,
    pub(super) doing: Doing,
    pub(super) pause: Option<Pause>,
    pub(super) broken: Option<Break>,
    pub(super) followed: Followed,
    pub(super) choices: Choices,
    /// HAL items as programs see them.
    pub(super) items: Vec<f64>,
    /// M66 has brought them up to date since the interpreter was told.
    pub(super) items_are_new: bool,
    digital: Outputs,
    analog: Outputs,
    /// How many spindles the machine has.
    spindles: usize,
    /// Inputs of each kind.
    inputs: (u16, u16),
    /// Each pin and its value, in the order of [`items::pins`].
    pins: Vec<(Pin, f64)>,
    /// Room for the values that they are to have.
    values: Vec<f64>,
    /// Between the start and the end of a synchronisation with a spindle.
    synchronised: bool,
    /// Pallets were exchanged last: a stop is the one of M60.
    pallets: bool,
    /// Depth of calls after the last block.
    level: u32,
    /// Line of the block that is being executed.
    pub(super) line: u32,
    /// What is read now was never to be executed.
    ahead: bool,
    /// Where the controlled point was after the last block, machine coordinates; kept where something can be read ahead.
    stands: Position,
}

impl<M: Machine> Desk<M> {
    pub(super) fn new(interpreter: &Interpreter, machine: M) -> Result<Self, Error> {
        let of = interpreter.machine();
        let mut desk = Self {
            machine,
            panel: Panel::new(),
            mode: ControllerMode::Auto,
            doing: Doing::Nothing,
            pause: None,
            broken: None,
            followed: Followed::new(&interpreter.settings()),
            choices: Choices::read(interpreter.options())?,
            items: Vec::new(),
            items_are_new: false,
            digital: Outputs::new(of.digital_io),
            analog: Outputs::new(of.analog_io),
            spindles: usize::from(of.spindles),
            inputs: (of.digital_io, of.analog_io),
            pins: items::pins(of).map(|pin| (pin, 0.0)).collect(),
            values: Vec::new(),
            synchronised: false,
            pallets: false,
            level: 0,
            line: 0,
            ahead: false,
            stands: interpreter.machine_point(),
        };
        // What they are before anything runs is no change.
        desk.values = desk.values_now().collect();
        for ((_, value), now) in desk.pins.iter_mut().zip(&desk.values) {
            *value = *now;
        }
        desk.items = alloc::vec![0.0; items::inputs(of.digital_io, of.analog_io).count().saturating_add(desk.pins.len())];
        desk.renew_items();
        Ok(desk)
    }

    /// The values that all pins are to have, in the order of [`items::pins`].
    fn values_now(&self) -> impl Iterator<Item = f64> {
        let (panel, choices) = (&self.panel, self.choices);
        let spindles = self.followed.spindles.iter().zip(panel.spindle_override);
        let spindles = (0_u16..).zip(spindles).take(self.spindles);
        let spindles = spindles.flat_map(move |(number, (spindle, factor))| {
            spindle.pins(number, factor, choices.brake_while_locked).map(|(_, value)| value)
        });
        let coolant = [bit(self.followed.mist), bit(self.followed.flood)];
        self.digital.values().chain(self.analog.values()).chain(spindles).chain(coolant)
    }

    /// Tells the machine the pins that have changed.
    pub(super) fn renew_pins(&mut self) {
        // Both lists are borrowed apart: the machine hears of a pin while the next value is computed.
        let mut pins = core::mem::take(&mut self.pins);
        let mut values = core::mem::take(&mut self.values);
        for (slot, value) in values.iter_mut().zip(self.values_now()) {
            *slot = value;
        }
        for ((pin, old), new) in pins.iter_mut().zip(&values) {
            if old != new {
                *old = *new;
                self.machine.pin(*pin, *new);
            }
        }
        (self.pins, self.values) = (pins, values);
    }

    /// HAL items have the values now that pins and inputs have (11.4.3.7).
    pub(super) fn renew_items(&mut self) {
        let mut all = core::mem::take(&mut self.items);
        let (digital, analog) = self.inputs;
        let inputs = items::inputs(digital, analog).map(|input| self.machine.input(input));
        let pins = self.pins.iter().map(|(_, value)| *value);
        for (item, value) in all.iter_mut().zip(inputs.chain(pins)) {
            *item = value;
        }
        self.items = all;
    }

    /// A program or a block by hand begins.
    pub(super) fn begin(&mut self, doing: Doing) {
        self.doing = doing;
        self.pause = None;
        self.broken = None;
        self.ahead = false;
        self.synchronised = false;
        self.pallets = false;
        self.level = 0;
        self.renew_items();
    }

    /// Nothing is being executed any more.
    pub(super) fn rest(&mut self) {
        self.doing = Doing::Nothing;
        self.pause = None;
        self.ahead = false;
        self.synchronised = false;
    }

    /// What waits for a motion is gone with the motions that were queued.
    pub(super) fn forget_waiting(&mut self) {
        self.digital.forget_waiting();
        self.analog.forget_waiting();
    }

    pub(super) fn is_broken(&self) -> bool {
        self.broken.is_some()
    }

    /// Takes an abort that the operator asked for.
    pub(super) fn take_abort(&mut self) -> bool {
        let aborted = self.broken == Some(Break::Abort);
        if aborted {
            self.broken = None;
        }
        aborted
    }

    /// What the documents leave open.
    pub(super) fn take_open(&mut self) -> Option<&'static str> {
        let Some(Break::Open(why)) = self.broken else { return None };
        self.broken = None;
        Some(why)
    }

    pub(super) fn stuck(&self) -> Option<Stuck> {
        let Some(Break::Stuck(stuck)) = self.broken else { return None };
        Some(stuck)
    }

    /// After an abort: where the point stands, if the interpreter shall read ahead.
    pub(super) fn reads_ahead(&mut self) -> Option<Position> {
        if self.choices.read_on && self.doing == Doing::Program {
            self.ahead = true;
            return Some(self.stands);
        }
        None
    }

    /// Performs a move: it begins when nothing holds it, and with it outputs change.
    fn move_(&mut self, motion: Motion, perform: impl FnOnce(&mut M) -> Reply) -> Reply {
        while self.holds(motion) || self.pause.is_some() {
            if self.wait_to_go_on().is_err() {
                return self.broken_off();
            }
        }
        let reply = perform(&mut self.machine);
        if !matches!(reply, Reply::Failed(_) | Reply::Broken) {
            let digital = self.digital.begin_motion();
            if self.analog.begin_motion() || digital {
                self.renew_pins();
            }
        }
        reply
    }

    /// What is answered to an effect that was broken off; where the interpreter reads ahead it goes on, but for what waits for the machine.
    fn broken_off(&mut self) -> Reply {
        if self.broken == Some(Break::Abort) && self.choices.read_on && self.doing == Doing::Program
        {
            self.ahead = true;
            return Reply::Done;
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
            Err(Broken) => Reply::Broken,
        }
    }

    /// An effect that is no motion.
    #[expect(clippy::wildcard_enum_match_arm, reason = "the other effects take no time here")]
    fn perform_still(&mut self, effect: &Effect) -> Reply {
        match effect {
            Effect::Dwell { seconds } => {
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
    fn pass_over(effect: &Effect) -> Reply {
        match effect {
            Effect::WaitInput { .. }
            | Effect::StraightProbe { .. }
            | Effect::ChangeTool { .. }
            | Effect::WaitOrient { .. }
            | Effect::UserCode { .. } => Reply::Broken,
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
            return Self::pass_over(effect);
        }
        self.line = line;
        match motion_of(effect, self.synchronised) {
            Some(motion) => self.move_(motion, |machine| machine.perform(line, effect)),
            None => self.perform_still(effect),
        }
    }

    fn probe(&mut self, line: u32, effect: &Effect, probing: &Probing) -> Reply {
        if self.ahead {
            return Reply::Broken;
        }
        self.line = line;
        self.move_(Motion::Feed, |machine| machine.probe(line, effect, probing))
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
        self.level = done.call_level();
        if self.choices.read_on {
            self.stands = done.machine_point();
        }
        self.machine.block_done(done);
    }
}
