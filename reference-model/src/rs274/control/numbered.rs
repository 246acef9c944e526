//! Fanuc-style numbered programs: M98, M99.

use gaugeblock_vocabulary::{End, FaultKind};

use super::loops::saturated;
use super::subs::{clear_value, deeper};
use super::{Call, Control, Frame, MAIN, Next, Place, SearchTarget, Style, o_word};
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::saved_state;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// The rules of numbered programs that a controller's dialect may replace.
pub(crate) trait NumberedRules {
    /// Rule fanuc-subs.repeat-count. How often L of M98 calls: a whole number of times.
    fn turns_of_call(&self, programmed: f64, _state: &State) -> Result<u64, StepError> {
        Ok(saturated(counted(programmed, "L of M98")?))
    }

    /// Rule fanuc-subs.zero-count. With L0 nothing is called.
    fn call_no_times(
        &self,
        _control: &mut Control,
        _label: String,
        _first: Place,
        state: &mut State,
    ) -> Result<Next, StepError> {
        state.coverage.accepted(rule::fanuc_subs::ZERO_COUNT);
        Ok(Next::Following)
    }

    /// Rule fanuc-subs.no-return-value. A call by M98 has no value.
    ///
    /// Choice fanuc-subs.value-after-call: whether it clears the value of an earlier call.
    fn clear_value_at_numbered_call(&self, state: &mut State) {
        if state.choices.is(choice::fanuc_subs::ValueAfterCall::Cleared) {
            clear_value(state);
        }
    }

    /// The first block of a numbered subprogram that this file has once.
    ///
    /// Rule fanuc-subs.sub-follows. It is later in the file than its call.
    ///
    /// Choice fanuc-subs.call-itself: whether it is enough that it follows an earlier call.
    fn number_of_call(
        &self,
        control: &Control,
        label: &str,
        state: &mut State,
    ) -> Result<Place, StepError> {
        let begins = control.files.labels(control.place.file).numbers(label);
        let later = begins.partition_point(|line| *line <= control.place.line);
        if let Some(line) = begins.get(later) {
            state.coverage.accepted(rule::fanuc_subs::SUB_FOLLOWS);
            return Ok(control.line(line + 1));
        }
        if let Some(line) = begins.last() {
            let first = control.line(line + 1);
            let known = control.called.contains(&first);
            if known && state.choices.is(choice::fanuc_subs::CallItself::Allowed) {
                return Ok(first);
            }
            let message = format!("the subprogram {label} is not after its call");
            return Err(refuse(rule::fanuc_subs::SUB_FOLLOWS, FaultKind::UnknownSub, message));
        }
        let message = format!("the file defines no subprogram {label}");
        Err(refuse(rule::fanuc_subs::UNKNOWN_NUMBER, FaultKind::UnknownSub, message))
    }

    /// A turn of a numbered subprogram ends.
    fn end_turn_of_numbered(
        &self,
        control: &Control,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        saved_state::restore_at_return(state, record)?;
        control.share_back(state);
        Ok(())
    }
}

impl Control {
    /// Rule fanuc-subs.main-number. A block with a number alone may begin the main program; a comment after it has no
    /// meaning.
    ///
    /// The documents do not describe a numbered program that is reached without M98.
    pub(super) fn program_number(&self, state: &mut State) -> Result<Next, StepError> {
        if self.begun || state.call_level() > 0 {
            let why = "a numbered program that is reached without a call";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        enabled(state)?;
        state.coverage.accepted(rule::fanuc_subs::MAIN_NUMBER);
        Ok(Next::Following)
    }

    /// Whether a block has M98 or M99.
    pub fn asks(words: &Words) -> bool {
        words.m.iter().any(|code| matches!(code, 98 | 99))
    }

    /// Executes a block with M98 or M99.
    ///
    /// # Errors
    /// The rule that refuses the block.
    pub fn numbered(
        &mut self,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) -> Result<Next, StepError> {
        enabled(state)?;
        let own = |letter: &char| matches!(letter, 'p' | 'l') && words.m == [98];
        let alone =
            words.m.len() == 1 && words.g_tenths.is_empty() && words.letters.keys().all(own);
        if !alone {
            let why = "M98 or M99 in a block with other words";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        if words.m == [98] {
            self.call_numbered(words, state)
        } else {
            self.end_numbered(state, record)
        }
    }

    /// Rule fanuc-subs.call. M98 P calls the numbered subprogram, which M99 ends; the program goes on after the call.
    ///
    /// Rule fanuc-subs.number-missing. M98 without P is refused.
    ///
    /// Rules fanuc-subs.repeat-count, fanuc-subs.zero-count. L is the number of calls; without L there is one.
    ///
    /// Choice fanuc-subs.zero-count-unknown: whether the subprogram must exist although L0 does not execute it.
    fn call_numbered(&mut self, words: &Words, state: &mut State) -> Result<Next, StepError> {
        let Some(number) = words.letters.get(&'p') else {
            let message = "M98 without P";
            return Err(refuse(rule::fanuc_subs::NUMBER_MISSING, FaultKind::MissingWord, message));
        };
        let turns = words.letters.get(&'l').copied().unwrap_or(1.0);
        let turns = state.dialect().turns_of_call(turns, state)?;
        // The number may be larger than an integer type.
        let label = format!("{:.0}", counted(*number, "P of M98")?);
        let back = Place { line: self.place.line + 1, ..self.place };
        let free = turns == 0 && state.choices.is(choice::fanuc_subs::ZeroCountUnknown::Accepted);
        if turns > 0 {
            let target = SearchTarget::Numbered { label: &label };
            state.dialect().pass_over(self, target, None, state)?;
        }
        let first = match self.numbered_program(&label, state) {
            Err(_) if free => back,
            first => first?,
        };
        if turns == 0 {
            return state.dialect().call_no_times(self, label, first, state);
        }
        deeper(rule::fanuc_subs::LEVEL_LIMIT, state)?;
        state.coverage.accepted(rule::fanuc_subs::NO_RETURN_VALUE);
        state.dialect().clear_value_at_numbered_call(state);
        let style = Style::Numbered { first, turns_left: turns - 1 };
        let frame = shared_frame(Call { label, back, style }, state);
        let nested = state.call_level() > 0;
        state.coverage.accepted(if nested {
            rule::fanuc_subs::NESTED
        } else {
            rule::fanuc_subs::CALL
        });
        state.coverage.accepted(rule::fanuc_subs::REPEAT_COUNT);
        self.called.insert(first);
        Ok(state.dialect().enter_call(self, frame, first, state))
    }

    /// The first block of a numbered subprogram.
    ///
    /// Rule fanuc-subs.mixed-m98. A sub that begins with sub is called by an O-word only, and a numbered program
    /// cannot take its number.
    fn numbered_program(&self, label: &str, state: &mut State) -> Result<Place, StepError> {
        let labels = self.files.labels(self.place.file);
        let begins = labels.numbers(label);
        let is_sub = self.subs.contains_key(label);
        if is_sub || begins.is_empty() && !labels.subs(label).is_empty() {
            let message = format!("{} begins with sub: M98 does not call it", o_word(label));
            return Err(refuse(rule::fanuc_subs::MIXED_M98, FaultKind::MixedStyles, message));
        }
        if self.place.file != MAIN && !begins.is_empty() {
            let why = "a numbered program in the file of a sub";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        if begins.iter().any(|line| labels.is_inside_sub(*line)) {
            let why = "a numbered program that begins inside a sub";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        let later = begins.iter().copied().find(|line| *line > self.place.line);
        if later.is_some_and(|number| labels.subs(label).iter().any(|sub| *sub < number)) {
            let why = "which one M98 calls of a sub and a numbered program of the same number";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        if !begins.is_empty() && self.files.has(&format!("{label}.ngc")) {
            let why = format!("which one M98 calls of the number {label} and a file of that name");
            return Err(StepError::Unspecified(why));
        }
        if begins.len() > 1 {
            let why = format!("which program M98 calls if the number {label} occurs several times");
            return Err(StepError::Unspecified(why));
        }
        state.dialect().number_of_call(self, label, state)
    }

    /// M99: the end of a numbered subprogram.
    ///
    /// Rule fanuc-subs.endless. M99 in the main program repeats it from its first block. The run counts the
    /// repeats.
    ///
    /// Rule fanuc-subs.mixed-m99. M99 cannot end a sub that begins with sub.
    fn end_numbered(&mut self, state: &mut State, record: &mut Record) -> Result<Next, StepError> {
        let Some(call) = state.frame().call.clone() else {
            state.coverage.accepted(rule::fanuc_subs::ENDLESS);
            return Ok(Next::End(End::Endless));
        };
        let Style::Numbered { first, turns_left } = call.style else {
            let message = format!("{} ends with endsub", o_word(&call.label));
            return Err(refuse(rule::fanuc_subs::MIXED_M99, FaultKind::MixedStyles, message));
        };
        state.dialect().end_turn_of_numbered(self, state, record)?;
        if turns_left == 0 {
            return Ok(Next::At(call.back));
        }
        let style = Style::Numbered { first, turns_left: turns_left - 1 };
        let frame = shared_frame(Call { style, ..call }, state);
        state.frames.push(frame);
        Ok(Next::At(first))
    }

    /// Rule fanuc-subs.shared-parameters. The caller keeps what the subprogram changed of #1 to #30.
    ///
    /// Choice fanuc-subs.named-locals: whether the caller keeps changes of local named parameters, too.
    pub(crate) fn share_back(&self, state: &mut State) {
        let left = state.frames.pop().expect("control: only a called frame is left");
        let shared = state.choices.is(choice::fanuc_subs::NamedLocals::Shared);
        let caller = state.frame_mut();
        caller.arguments = left.arguments;
        if shared {
            caller.locals = left.locals;
        }
    }
}

/// Rule fanuc-subs.disabled. Numbered programs can be disabled: their calls, their ends and their numbers alone.
pub(crate) fn enabled(state: &mut State) -> Result<(), StepError> {
    if !state.machine.fanuc_subs {
        let message = "numbered programs are disabled";
        return Err(refuse(rule::fanuc_subs::DISABLED, FaultKind::FanucDisabled, message));
    }
    state.coverage.accepted(rule::fanuc_subs::DISABLED);
    Ok(())
}

/// Rule fanuc-subs.shared-parameters. A subprogram works on its caller's #1 to #30.
/// Rule fanuc-subs.named-locals. Whether it sees the caller's local named parameters is a choice.
pub(crate) fn shared_frame(call: Call, state: &mut State) -> Frame {
    state.coverage.accepted(rule::fanuc_subs::SHARED_PARAMETERS);
    state.coverage.accepted(rule::fanuc_subs::NAMED_LOCALS);
    let shared = state.choices.is(choice::fanuc_subs::NamedLocals::Shared);
    let caller = state.frame();
    let locals = if shared { caller.locals.clone() } else { Default::default() };
    Frame { arguments: caller.arguments, locals, call: Some(call), ..Frame::default() }
}

/// A program number, or a number of calls. The documents do not say what one means that is not a whole number.
pub(crate) fn counted(number: f64, what: &str) -> Result<f64, StepError> {
    let whole = number.round() + 0.0;
    if (number - whole).abs() > 0.0001 || whole < 0.0 {
        return Err(StepError::Unspecified(format!("{what} is {number}")));
    }
    Ok(whole)
}
