//! The state between interpreter and machine: what the controller is doing, and the values from which pins follow.

use alloc::vec;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{ControllerMode, Pin, Settings};

use crate::interpret::Interpreter;

use super::choices::Choices;
use super::items;
use super::machine::Machine;
use super::outputs::Outputs;
use super::panel::Panel;
use super::pins::{TrackedSettings, bit};

/// The kind of run that the controller executes, or executed before it became idle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RunKind {
    /// It runs a program.
    Program,
    /// It executes an MDI block.
    Mdi,
}

/// Why a program pauses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pause {
    /// M0 or M1.
    Stop,
    /// M60.
    Pallets,
    /// A request of the operator.
    Requested,
}

/// A wait for something that never happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deadlock {
    /// A resume of the program or of motion.
    Paused,
    /// An input, or an external operation.
    Waiting,
}

/// Why a block was aborted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AbortCause {
    /// By the operator.
    Operator,
    /// The documents leave open what follows.
    Unspecified(&'static str),
    /// Nothing will ever happen.
    Deadlock(Deadlock),
}

/// The state of a task.
#[derive(Debug)]
pub(super) struct TaskState<M> {
    pub(super) machine: M,
    pub(super) panel: Panel,
    /// The optional stop switch when the run began.
    pub(super) optional_stop_before: bool,
    pub(super) mode: ControllerMode,
    pub(super) run_kind: RunKind,
    pub(super) pause: Option<Pause>,
    pub(super) abort_cause: Option<AbortCause>,
    pub(super) tracked: TrackedSettings,
    pub(super) choices: Choices,
    /// HAL items as programs see them.
    pub(super) items: Vec<f64>,
    /// M66 has updated them, and the interpreter does not have them yet.
    pub(super) items_changed: bool,
    pub(super) digital: Outputs,
    pub(super) analog: Outputs,
    /// How many spindles the machine has.
    spindles: usize,
    /// Inputs of each kind.
    inputs: (u16, u16),
    /// Each pin and its value, in the order of [`items::pins`].
    pins: Vec<(Pin, f64)>,
    /// Scratch memory for their next values.
    values: Vec<f64>,
    /// Between the start and the end of a synchronisation with a spindle.
    pub(super) synchronised: bool,
    /// Pallets were exchanged last: a stop is the one of M60.
    pub(super) pallets_exchanged: bool,
    /// Depth of calls after the last block.
    pub(super) call_level: u32,
    /// A block has begun.
    pub(super) within_block: bool,
    /// Line of the block that is being executed.
    pub(super) line: u32,
    /// The place of what the interpreter puts out next, where that has waited.
    pub(super) released: Option<u64>,
    /// Blocks are only read and not executed.
    pub(super) reading_ahead: bool,
    /// Settings that these blocks have changed.
    pub(super) settings_ahead: Settings,
    /// The aborted effect waits for the machine: nothing after it has been read.
    pub(super) aborted_waiting: bool,
}

impl<M: Machine> TaskState<M> {
    pub(super) fn new(interpreter: &Interpreter, machine: M) -> Self {
        let of = interpreter.machine();
        let mut state = Self {
            machine,
            panel: Panel::new(),
            optional_stop_before: false,
            mode: ControllerMode::Auto,
            run_kind: RunKind::Program,
            pause: None,
            abort_cause: None,
            tracked: TrackedSettings::new(&interpreter.settings()),
            choices: interpreter.dialect.task,
            items: Vec::new(),
            items_changed: false,
            digital: Outputs::new(of.digital_io),
            analog: Outputs::new(of.analog_io),
            spindles: usize::from(of.spindles),
            inputs: (of.digital_io, of.analog_io),
            pins: items::pins(of).map(|pin| (pin, 0.0)).collect(),
            values: Vec::new(),
            synchronised: false,
            pallets_exchanged: false,
            call_level: 0,
            within_block: false,
            line: 0,
            released: None,
            reading_ahead: false,
            settings_ahead: Settings::default(),
            aborted_waiting: false,
        };
        // The initial values are not changes.
        state.values = state.current_pins().collect();
        for ((_, value), now) in state.pins.iter_mut().zip(&state.values) {
            *value = *now;
        }
        state.items =
            vec![
                0.0;
                items::inputs(of.digital_io, of.analog_io).count().saturating_add(state.pins.len())
            ];
        state.update_items();
        state
    }

    /// The next values of all pins, in the order of [`items::pins`].
    fn current_pins(&self) -> impl Iterator<Item = f64> {
        let (panel, choices) = (&self.panel, self.choices);
        let spindles = self.tracked.spindles.iter().zip(panel.spindle_override);
        let spindles = (0_u16..).zip(spindles).take(self.spindles);
        let spindles = spindles.flat_map(move |(number, (spindle, factor))| {
            spindle.pins(number, factor, choices.brake_while_locked).map(|(_, value)| value)
        });
        let coolant = [bit(self.tracked.mist), bit(self.tracked.flood)];
        self.digital.values().chain(self.analog.values()).chain(spindles).chain(coolant)
    }

    /// Sets the machine's pins that have changed.
    pub(super) fn update_pins(&mut self) {
        // Both lists are borrowed separately: the machine sets a pin while the next value is computed.
        let mut pins = core::mem::take(&mut self.pins);
        let mut values = core::mem::take(&mut self.values);
        for (slot, value) in values.iter_mut().zip(self.current_pins()) {
            *slot = value;
        }
        for ((pin, old), new) in pins.iter_mut().zip(&values) {
            // A value that is not a number means that motion sets the pin.
            if (*old - *new).abs() > 0.0 {
                *old = *new;
                self.machine.set_pin(*pin, *new);
            }
        }
        (self.pins, self.values) = (pins, values);
    }

    /// HAL items have the values now that pins and inputs have (11.4.3.7).
    pub(super) fn update_items(&mut self) {
        let mut all = core::mem::take(&mut self.items);
        let (digital, analog) = self.inputs;
        let inputs = items::inputs(digital, analog).map(|input| self.machine.input(input));
        let pins = self.pins.iter().map(|(_, value)| *value);
        for (item, value) in all.iter_mut().zip(inputs.chain(pins)) {
            *item = value;
        }
        self.items = all;
    }

    /// Begins a program or an MDI block, without the state of the one before.
    pub(super) fn begin(&mut self, run_kind: RunKind) {
        self.run_kind = run_kind;
        self.optional_stop_before = self.panel.optional_stop;
        self.pause = None;
        self.abort_cause = None;
        self.reading_ahead = false;
        self.aborted_waiting = false;
        self.synchronised = false;
        self.pallets_exchanged = false;
        self.call_level = 0;
        self.update_items();
    }

    /// After an abort: outputs that wait for a motion are dropped with the queued motions, or wait for the next one.
    pub(super) fn forget_waiting(&mut self) {
        if self.choices.waits_after_abort {
            return;
        }
        self.digital.forget_waiting();
        self.analog.forget_waiting();
    }

    /// The program has ended.
    pub(super) fn end_program(&mut self) {
        if self.choices.forgets_at_end {
            self.digital.forget_waiting();
            self.analog.forget_waiting();
        }
    }

    pub(super) fn is_aborted(&self) -> bool {
        self.abort_cause.is_some()
    }

    /// Takes the operator's abort.
    pub(super) fn take_abort(&mut self) -> bool {
        let aborted = self.abort_cause == Some(AbortCause::Operator);
        if aborted {
            self.abort_cause = None;
        }
        aborted
    }

    /// Takes the reason why the documents leave the outcome open.
    pub(super) fn take_unspecified(&mut self) -> Option<&'static str> {
        let Some(AbortCause::Unspecified(why)) = self.abort_cause else { return None };
        self.abort_cause = None;
        Some(why)
    }

    pub(super) fn deadlock(&self) -> Option<Deadlock> {
        let Some(AbortCause::Deadlock(deadlock)) = self.abort_cause else { return None };
        Some(deadlock)
    }

    /// After an abort: whether the interpreter reads ahead.
    pub(super) fn begin_read_ahead(&mut self) -> bool {
        let reads = self.choices.read_ahead_on_abort
            && self.run_kind == RunKind::Program
            && !self.aborted_waiting;
        self.reading_ahead |= reads;
        reads
    }

    /// Puts the settings that were read ahead into force, although nothing was executed.
    pub(super) fn apply_read_ahead(&mut self) {
        self.reading_ahead = false;
        let set = core::mem::take(&mut self.settings_ahead);
        if set != Settings::default() {
            self.tracked.apply_read_ahead(&set);
            self.machine.set(self.line, &set);
        }
    }
}
