//! M62 to M65, M67, M68.

use gaugeblock_vocabulary::{Effect, FaultKind, OutputTiming, Pin, Position};

use super::{whole, word};
use crate::ids::{Rule, choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Switches an output.
///
/// Rules outputs.on-at-once (M64) and outputs.off-at-once (M65). The output switches when the block is executed.
/// Rules outputs.on-with-motion (M62) and outputs.off-with-motion (M63). It switches when the next motion begins.
///
/// # Errors
/// Rules outputs.needs-number, outputs.number-range, outputs.under-compensation.
pub fn digital(
    code: u32,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    super::not_under_compensation(
        rule::outputs::UNDER_COMPENSATION,
        choice::outputs::UnderCompensation::Refused,
        state,
    )?;
    let Some(value) = word(words, 'p') else {
        let message = format!("M{code} needs P, the number of the output");
        return Err(refuse(rule::outputs::NEEDS_NUMBER, FaultKind::MissingWord, message));
    };
    let timing = timing(code);
    let of_machine = state.machine.digital_io;
    let output = number(value, 'P', of_machine, timing, rule::outputs::NUMBER_RANGE, state)?;
    let on = [62, 64].contains(&code);
    let pin = pin(output, of_machine).map(Pin::DigitalOut);
    switch(pin, if on { 1.0 } else { 0.0 }, timing, state);
    state.coverage.accepted(match code {
        62 => rule::outputs::ON_WITH_MOTION,
        63 => rule::outputs::OFF_WITH_MOTION,
        64 => rule::outputs::ON_AT_ONCE,
        _ => rule::outputs::OFF_AT_ONCE,
    });
    record.effect(state, Effect::SetDigitalOutput { output, on, timing });
    Ok(())
}

/// Sets an analog output.
///
/// Rule outputs.analog-at-once. M68 sets it when the block is executed.
/// Rule outputs.analog-with-motion. M67 sets it when the next motion begins.
///
/// # Errors
/// Rules outputs.analog-needs-number, outputs.analog-needs-value, outputs.analog-number-range,
/// outputs.under-compensation.
pub fn analog(
    code: u32,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    super::not_under_compensation(
        rule::outputs::UNDER_COMPENSATION,
        choice::outputs::UnderCompensation::Refused,
        state,
    )?;
    let Some(value) = word(words, 'e') else {
        let message = format!("M{code} needs E, the number of the output");
        return Err(refuse(rule::outputs::ANALOG_NEEDS_NUMBER, FaultKind::MissingWord, message));
    };
    let timing = timing(code);
    let of_machine = state.machine.analog_io;
    let output = number(value, 'E', of_machine, timing, rule::outputs::ANALOG_NUMBER_RANGE, state)?;
    let to = match word(words, 'q') {
        Some(to) => to,
        None => state.dialect().value_of_no_word(code, state)?,
    };
    switch(pin(output, of_machine).map(Pin::AnalogOut), to, timing, state);
    let rule =
        if code == 67 { rule::outputs::ANALOG_WITH_MOTION } else { rule::outputs::ANALOG_AT_ONCE };
    state.coverage.accepted(rule);
    record.effect(state, Effect::SetAnalogOutput { output, to, timing });
    Ok(())
}

/// Which outputs there are, and what they are set to.
pub(crate) trait OutputRules {
    /// Rule outputs.analog-needs-value. M67 and M68 have Q: the value where there is none.
    fn value_of_no_word(&self, code: u32, _state: &State) -> Result<f64, StepError> {
        let message = format!("M{code} needs Q, the value of the output");
        Err(refuse(rule::outputs::ANALOG_NEEDS_VALUE, FaultKind::MissingWord, message))
    }

    /// Rule outputs.at-next-motion. Whether a move to this point is a motion; program coordinates, active length unit.
    fn is_motion_to(&self, _end: Position, _state: &State) -> bool {
        true
    }

    /// Records where the axes are; program coordinates, active length unit. The documents need no such record.
    fn axes_are_at(&self, _point: Position, _state: &mut State) {}

    /// Rule outputs.at-next-motion. A motion that is held has not begun: what waits for it goes on waiting.
    fn motion_is_held(&self, _state: &mut State) {}

    /// Rules outputs.number-range and outputs.analog-number-range. The number of an output, an integer.
    fn output_number(
        &self,
        (_letter, value): (char, f64),
        _timing: OutputTiming,
        _state: &State,
    ) -> Option<i32> {
        whole(value)
    }

    /// Rules outputs.number-range and outputs.analog-number-range. Whether every number is that of an output: nothing
    /// limits them for the stand-alone interpreter.
    fn has_every_output(&self, _timing: OutputTiming, state: &State) -> bool {
        state.environment.is_stand_alone()
    }
}

fn timing(code: u32) -> OutputTiming {
    if [62, 63, 67].contains(&code) { OutputTiming::WithMotion } else { OutputTiming::AtOnce }
}

/// Rules outputs.number-range and outputs.analog-number-range. Outputs are counted from 0, as many as the machine has,
/// which may be more or fewer than four (outputs.count).
fn number(
    value: f64,
    letter: char,
    of_machine: u16,
    timing: OutputTiming,
    rule: Rule,
    state: &mut State,
) -> Result<i32, StepError> {
    let whole = state.dialect().output_number((letter, value), timing, state);
    let any = state.dialect().has_every_output(timing, state);
    let unchecked = any && (letter == 'P' || value >= 0.0);
    let fits = |number: &i32| unchecked || (0..i32::from(of_machine)).contains(number);
    let number = whole.filter(fits).ok_or_else(|| {
        let what = if letter == 'P' { "output" } else { "analog output" };
        let message = super::no_such(what, value, of_machine);
        refuse(rule, FaultKind::NoSuchInputOrOutput, message)
    })?;
    state.coverage.accepted(rule);
    if of_machine != 4 {
        state.coverage.accepted(rule::outputs::COUNT);
    }
    Ok(number)
}

/// The index of an output's pin; none for an output that the machine does not have.
fn pin(output: i32, of_machine: u16) -> Option<u16> {
    u16::try_from(output).ok().filter(|output| *output < of_machine)
}

/// Rule outputs.latest-counts. A later code for the same output replaces what it was to become. Rule outputs.several.
/// Several outputs may wait for one motion. Rule outputs.at-once-over-waiting. Whether a code that switches at once
/// takes back what the output was to become is a choice.
fn switch(pin: Option<Pin>, value: f64, timing: OutputTiming, state: &mut State) {
    let Some(pin) = pin else { return };
    if timing == OutputTiming::WithMotion {
        let others = state.environment.awaits_motion();
        if state.environment.set_with_motion(pin, value) {
            state.coverage.accepted(rule::outputs::LATEST_COUNTS);
        } else if others {
            state.coverage.accepted(rule::outputs::SEVERAL);
        }
        return;
    }
    if state.environment.awaits_motion_with(pin) {
        let rule = rule::outputs::AT_ONCE_OVER_WAITING;
        state.coverage.accepted(rule);
        if state.choices.is(choice::outputs::AtOnceOverWaiting::Replaces) {
            state.environment.forget_with_motion(pin);
        }
    }
    state.environment.set(pin, value);
}

/// Rule outputs.without-motion. When no motion follows, what waits for one never switches.
pub(crate) fn program_ends(state: &mut State) {
    if state.environment.awaits_motion() {
        state.coverage.accepted(rule::outputs::WITHOUT_MOTION);
    }
}
