//! Quirks of inputs and outputs.

use gaugeblock_vocabulary::{Axis, OutputTiming, Position, WaitMode};

use super::task::machine_point_in_mm;
use super::{HasQuirk, Observed, Quirk};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::environment::{Awaited, Input};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::inputs::InputRules;
use crate::rs274::execute::move_start;
use crate::rs274::execute::outputs::OutputRules;
use crate::rs274::execute::{whole, word};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// The largest number of an input that M66 accepts by quirk linuxcnc.input-number.
const INPUT_NUMBER_MAX: i32 = 63;

/// The least move along an axis that is a motion by quirk linuxcnc.move-in-place, millimetres or degrees. Observed:
/// 1e-8 is none, 2e-7 is one.
const IN_PLACE_MM: f64 = 1e-7;

impl InputRules for Observed {
    /// Quirk linuxcnc.wait-mode-times-out. With L above 4, M66 always ends with its time-out, whatever the input does.
    fn awaited(
        &self,
        input: Input,
        mode: WaitMode,
        timeout: Option<f64>,
        words: &Words,
        state: &State,
    ) -> Awaited {
        let is_unknown = word(words, 'l').is_some_and(is_above_four);
        if is_unknown && state.has_quirk(quirk::linuxcnc::WAIT_MODE_TIMES_OUT) {
            return Awaited::TimesOut { after: word(words, 'q').unwrap_or(0.0) };
        }
        Documented.awaited(input, mode, timeout, words, state)
    }

    /// Quirk rs274.io-number-rounded. A fractional input number is rounded.
    /// Quirk linuxcnc.input-number. Above 63 it is refused.
    fn input_number(&self, value: f64, state: &State) -> Option<i32> {
        let number = if state.has_quirk(quirk::rs274::IO_NUMBER_ROUNDED) {
            rounded(value)
        } else {
            Documented.input_number(value, state)
        };
        let is_limited = state.has_quirk(quirk::linuxcnc::INPUT_NUMBER);
        number.filter(|number| !is_limited || *number <= INPUT_NUMBER_MAX)
    }

    /// Quirk linuxcnc.input-number. Any input number up to 63 is accepted; M66 reads zero from an input that does not
    /// exist.
    fn has_every_input(&self, state: &State) -> bool {
        state.has_quirk(quirk::linuxcnc::INPUT_NUMBER) || Documented.has_every_input(state)
    }

    /// Quirk rs274.wait-mode-any. L above 4 waits; the awaited level is unknown.
    /// Quirk linuxcnc.wait-mode-times-out. The whole controller does not wait for a level of a digital input then.
    fn wait_mode(&self, value: f64, input: Input, state: &State) -> Result<WaitMode, StepError> {
        let is_digital = matches!(input, Input::Digital(_));
        if is_digital
            && is_above_four(value)
            && state.has_quirk(quirk::linuxcnc::WAIT_MODE_TIMES_OUT)
        {
            return Ok(WaitMode::Immediate);
        }
        if is_above_four(value) && state.has_quirk(quirk::rs274::WAIT_MODE_ANY) {
            return Ok(WaitMode::Low);
        }
        Documented.wait_mode(value, input, state)
    }
}

impl OutputRules for Observed {
    /// Quirk rs274.output-value-optional. M67 and M68 without Q output -1.
    fn value_of_no_word(&self, code: u32, state: &State) -> Result<f64, StepError> {
        if state.has_quirk(quirk::rs274::OUTPUT_VALUE_OPTIONAL) {
            return Ok(-1.0);
        }
        Documented.value_of_no_word(code, state)
    }

    /// Quirk linuxcnc.move-in-place. A move in place is dropped: nothing holds it, and no output switches with it.
    fn is_motion_to(&self, end: Position, state: &State) -> bool {
        let (from, to) = (state.memory.axes, machine_point_in_mm(&state.modes, end));
        let is_there = |axis: &Axis| (from.get(*axis) - to.get(*axis)).abs() < IN_PLACE_MM;
        !state.has_quirk(quirk::linuxcnc::MOVE_IN_PLACE) || !Axis::ALL.iter().all(is_there)
    }

    /// Quirk linuxcnc.move-in-place. The dialect remembers where the axes are.
    fn axes_are_at(&self, point: Position, state: &mut State) {
        state.memory.axes = machine_point_in_mm(&state.modes, point);
    }

    /// Quirk linuxcnc.output-while-held. What waits for a motion switches when that is queued, although it is held.
    fn motion_is_held(&self, state: &mut State) {
        if state.has_quirk(quirk::linuxcnc::OUTPUT_WHILE_HELD) {
            move_start::motion_begins(state);
        }
    }

    /// Quirk rs274.io-number-rounded. A fractional output number is rounded.
    /// Quirks linuxcnc.output-number-with-motion and linuxcnc.output-number-at-once. Eight bits of a larger number are
    /// kept; P beyond 32 bits is 0.
    fn output_number(
        &self,
        (letter, value): (char, f64),
        timing: OutputTiming,
        state: &State,
    ) -> Option<i32> {
        let number = if state.has_quirk(quirk::rs274::IO_NUMBER_ROUNDED) {
            rounded(value)
        } else {
            Documented.output_number((letter, value), timing, state)
        };
        let is_narrow = state.has_quirk(output_number_quirk(timing));
        if is_narrow && letter == 'P' && value.abs() > f64::from(i32::MAX) {
            return Some(0);
        }
        number.map(|number| if is_narrow && number > 0xff { number & 0xff } else { number })
    }

    /// Quirks linuxcnc.output-number-with-motion and linuxcnc.output-number-at-once. The number of an output
    /// that does not exist is accepted.
    fn has_every_output(&self, timing: OutputTiming, state: &State) -> bool {
        state.has_quirk(output_number_quirk(timing)) || Documented.has_every_output(timing, state)
    }
}

/// The quirk of the numbers of outputs that a code has.
fn output_number_quirk(timing: OutputTiming) -> Quirk {
    match timing {
        OutputTiming::WithMotion => quirk::linuxcnc::OUTPUT_NUMBER_WITH_MOTION,
        OutputTiming::AtOnce => quirk::linuxcnc::OUTPUT_NUMBER_AT_ONCE,
    }
}

/// The number of an input or output, rounded to an integer; halves go to the even one.
fn rounded(value: f64) -> Option<i32> {
    whole(value.round_ties_even())
}

/// Whether an L of M66 is above the greatest that is documented.
fn is_above_four(value: f64) -> bool {
    whole(value).is_some_and(|mode| mode > 4)
}
