//! M66.

use gaugeblock_vocabulary::{Effect, FaultKind, WaitMode};

use super::{whole, word};
use crate::ids::{choice, rule};
use crate::rs274::environment::{Awaited, Input, stub};
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// The parameter that holds what M66 found.
pub(crate) const RESULT: u32 = 5399;

/// What the parameter holds after a time-out.
const TIMED_OUT: f64 = -1.0;

/// Reads an input, or waits for it.
///
/// Rule inputs.immediate. Under L0 it does not wait. Rules inputs.rise, inputs.fall, inputs.high, inputs.low. Otherwise
/// nothing further is executed until the input does what L says (inputs.waits).
/// Rule parameters.hal-time. What a program reads of HAL afterwards is as it is now.
/// Rule inputs.result. #5399 holds the value of the input then, or -1 when it did not come in time (inputs.timeout).
///
/// # Errors
/// Rules inputs.one-input, inputs.number-range, inputs.mode-range, inputs.analog-immediate, inputs.zero-timeout,
/// inputs.without-timeout, inputs.under-compensation.
pub fn perform(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    super::not_under_compensation(
        rule::inputs::UNDER_COMPENSATION,
        choice::inputs::UnderCompensation::Refused,
        state,
    )?;
    let input = input(words, state)?;
    let mode = mode(input, words, state)?;
    if matches!(input, Input::Analog(_)) {
        analog_mode(mode, state)?;
    }
    let timeout = timeout(mode, words, state)?;
    let (seconds, read) = match state.dialect().awaited(input, mode, timeout, words, state) {
        Awaited::Comes { after, value } => (after, Some(value)),
        Awaited::TimesOut { after } => (after, None),
        Awaited::Never => return Err(StepError::WaitsForEver),
    };
    if read.is_none() {
        state.coverage.accepted(rule::inputs::TIMEOUT);
    }
    let read = read.unwrap_or(TIMED_OUT);
    accepted(input, mode, state);
    let (digital, analog) = match input {
        Input::Digital(number) => (i32::try_from(number).ok(), None),
        Input::Analog(number) => (None, i32::try_from(number).ok()),
    };
    record.effect(state, Effect::WaitInput { digital, analog, mode, timeout, read });
    if seconds > 0.0 {
        record.wait(state, seconds);
    }
    state.parameters.store(RESULT, read);
    state.environment.synchronise();
    Ok(())
}

/// Which inputs there are, and how they are awaited.
pub(crate) trait InputRules {
    /// Rule inputs.waits. When the input does what is awaited, and what is read then.
    fn awaited(
        &self,
        input: Input,
        mode: WaitMode,
        timeout: Option<f64>,
        _words: &Words,
        state: &State,
    ) -> Awaited {
        if state.environment.is_stand_alone() {
            let value = stub::answer(input, state.parameters.stored(RESULT));
            return Awaited::Comes { after: 0.0, value };
        }
        state.environment.awaited(input, mode, timeout)
    }

    /// Rule inputs.number-range. The number of an input, an integer.
    fn input_number(&self, value: f64, _state: &State) -> Option<i32> {
        whole(value)
    }

    /// Rule inputs.number-range. Whether every number is that of an input: nothing limits them for the stand-alone
    /// interpreter.
    fn has_every_input(&self, state: &State) -> bool {
        state.environment.is_stand_alone()
    }

    /// Rule inputs.mode-range. L is 0 to 4.
    fn wait_mode(&self, value: f64, _input: Input, _state: &State) -> Result<WaitMode, StepError> {
        match whole(value) {
            Some(0) => Ok(WaitMode::Immediate),
            Some(1) => Ok(WaitMode::Rise),
            Some(2) => Ok(WaitMode::Fall),
            Some(3) => Ok(WaitMode::High),
            Some(4) => Ok(WaitMode::Low),
            _ => {
                let message = format!("L{value} is not a wait mode; expected 0 to 4");
                Err(refuse(rule::inputs::MODE_RANGE, FaultKind::WordOutOfRange, message))
            }
        }
    }
}

fn accepted(input: Input, mode: WaitMode, state: &mut State) {
    let rule = match mode {
        WaitMode::Immediate => rule::inputs::IMMEDIATE,
        WaitMode::Rise => rule::inputs::RISE,
        WaitMode::Fall => rule::inputs::FALL,
        WaitMode::High => rule::inputs::HIGH,
        WaitMode::Low => rule::inputs::LOW,
    };
    state.coverage.accepted(rule);
    state.coverage.accepted(rule::inputs::RESULT);
    if mode != WaitMode::Immediate {
        state.coverage.accepted(rule::inputs::WAITS);
    }
    if state.environment.is_connected(input) {
        state.coverage.accepted(rule::inputs::CONNECTED);
    } else {
        state.coverage.accepted(rule::inputs::UNCONNECTED);
    }
}

/// Rule inputs.one-input. P names a digital input or E an analog one: one of them, and not both.
fn input(words: &Words, state: &mut State) -> Result<Input, StepError> {
    let rule = rule::inputs::ONE_INPUT;
    let input = match (word(words, 'p'), word(words, 'e')) {
        (Some(_), Some(_)) => {
            let message = "M66 with both a digital and an analog input";
            return Err(refuse(rule::inputs::BOTH, FaultKind::ModalConflict, message));
        }
        (None, None) => {
            let message = "M66 needs P or E, the number of the input";
            return Err(refuse(rule, FaultKind::MissingWord, message));
        }
        (Some(value), None) => Input::Digital(number(value, 'P', state.machine.digital_io, state)?),
        (None, Some(value)) => Input::Analog(number(value, 'E', state.machine.analog_io, state)?),
    };
    state.coverage.accepted(rule);
    Ok(input)
}

/// Rule inputs.number-range. Inputs are counted from 0, as many as the machine has, which may be more or fewer than
/// four (inputs.count).
fn number(value: f64, letter: char, of_machine: u16, state: &mut State) -> Result<u32, StepError> {
    let any = state.dialect().has_every_input(state);
    let number = state.dialect().input_number(value, state);
    let number = number.and_then(|number| u32::try_from(number).ok());
    let number = number.filter(|number| any || *number < of_machine.into()).ok_or_else(|| {
        let what = if letter == 'P' { "input" } else { "analog input" };
        let message = super::no_such(what, value, of_machine);
        refuse(rule::inputs::NUMBER_RANGE, FaultKind::NoSuchInputOrOutput, message)
    })?;
    state.coverage.accepted(rule::inputs::NUMBER_RANGE);
    if of_machine != 4 {
        state.coverage.accepted(rule::inputs::COUNT);
    }
    Ok(number)
}

/// Rule inputs.mode-optional. Without L, M66 does not wait.
fn mode(input: Input, words: &Words, state: &mut State) -> Result<WaitMode, StepError> {
    let Some(value) = word(words, 'l') else {
        state.coverage.accepted(rule::inputs::MODE_OPTIONAL);
        return Ok(WaitMode::Immediate);
    };
    let mode = state.dialect().wait_mode(value, input, state)?;
    state.coverage.accepted(rule::inputs::MODE_RANGE);
    Ok(mode)
}

/// Rule inputs.analog-immediate. An analog input is read at once and never awaited.
fn analog_mode(mode: WaitMode, state: &mut State) -> Result<(), StepError> {
    let rule = rule::inputs::ANALOG_IMMEDIATE;
    if mode != WaitMode::Immediate {
        let message = "M66 waits for digital inputs only";
        return Err(refuse(rule, FaultKind::WordOutOfRange, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// Rule inputs.zero-timeout. Q is the longest wait in seconds, and not zero, except where nothing is awaited and Q is
/// ignored (inputs.ignored-timeout).
/// Rule inputs.without-timeout. Whether a wait needs Q is a choice.
fn timeout(mode: WaitMode, words: &Words, state: &mut State) -> Result<Option<f64>, StepError> {
    let timeout = word(words, 'q');
    if mode == WaitMode::Immediate {
        if timeout.is_some() {
            state.coverage.accepted(rule::inputs::IGNORED_TIMEOUT);
        }
        return Ok(None);
    }
    match timeout {
        None => {
            let rule = rule::inputs::WITHOUT_TIMEOUT;
            if state.choices.is(choice::inputs::WithoutTimeout::Refused) {
                let message = "M66 that waits needs Q, the longest wait in seconds";
                return Err(refuse(rule, FaultKind::MissingWord, message));
            }
            state.coverage.accepted(rule);
        }
        Some(0.0) => {
            let message = "a longest wait of zero seconds";
            return Err(refuse(rule::inputs::ZERO_TIMEOUT, FaultKind::WordOutOfRange, message));
        }
        Some(seconds) if seconds < 0.0 => {
            return Err(StepError::Unspecified(format!("a wait of at most {seconds} seconds")));
        }
        Some(_) => {}
    }
    Ok(timeout)
}
