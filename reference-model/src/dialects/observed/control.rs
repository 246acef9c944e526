//! Quirks of subroutines, conditions and loops.

use gaugeblock_vocabulary::FaultKind;

use super::values::{count_too_large, known_number, set_returned, value_after, with_zeros};
use super::{HasQuirk, Observed, skipping};
use crate::dialects::quirk;
use crate::ids::rule;
use crate::rs274::control::loops::{is_repeat, turns};
use crate::rs274::control::numbered::shared_frame;
use crate::rs274::control::subs::{clear_value, deeper, keep_value};
use crate::rs274::control::{
    Call, ConditionRules, Control, ControlRules, Frame, LoopRules, Next, NumberedRules, Open,
    Place, SearchTarget, Structure, Style, SubroutineRules, o_word,
};
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Expression, Keyword};
use crate::rs274::task::Record;
use crate::rs274::text::Line;

impl ControlRules for Observed {
    fn pass_over(
        &self,
        control: &mut Control,
        target: SearchTarget<'_>,
        end: Option<u32>,
        state: &mut State,
    ) -> Result<(), StepError> {
        skipping::pass_over(control, target, end, state)
    }

    /// Quirk rs274.ends-in-other-subs. The end of a condition or loop can be in any sub that follows, up to the next
    /// numbered program.
    fn end_further_on(
        &self,
        control: &Control,
        label: &str,
        keywords: &[Keyword],
        after: u32,
        state: &mut State,
    ) -> Option<u32> {
        if state.has_quirk(quirk::rs274::ENDS_IN_OTHER_SUBS) {
            return skipping::end_in_any_sub(control, label, keywords, after, state);
        }
        Documented.end_further_on(control, label, keywords, after, state)
    }

    /// Quirk rs274.ends-in-other-subs. The search for an end ignores where subs end.
    fn has_computed_subs(&self, control: &Control, after: u32, until: u32, state: &State) -> bool {
        !state.has_quirk(quirk::rs274::ENDS_IN_OTHER_SUBS)
            && Documented.has_computed_subs(control, after, until, state)
    }
}

impl SubroutineRules for Observed {
    /// Quirk rs274.file-with-two-subs. In a called file the head of another sub has no effect: the block after it is
    /// executed.
    ///
    /// Quirk rs274.sub-found-later. The head of another sub has no effect either in a sub of the main program that a
    /// call found further on. The definition of the found sub is refused when it is reached.
    ///
    /// Quirk rs274.sub-reached-again. A definition that is reached a second time, as in a loop, is refused.
    fn define_sub(
        &self,
        control: &mut Control,
        label: &str,
        state: &mut State,
    ) -> Result<Next, StepError> {
        if is_head_within(control, state) {
            return Ok(Next::Following);
        }
        let rule = quirk::rs274::SUB_REACHED_AGAIN;
        if control.subs.get(label) == Some(&control.place) && state.has_quirk(rule) {
            let message = format!("{} is known already", o_word(label));
            return Err(refuse(rule, FaultKind::BadBlock, message));
        }
        if control.memory.found_later.contains(&control.place) {
            let message = format!("{} was found by a call before it", o_word(label));
            return Err(refuse(quirk::rs274::SUB_FOUND_LATER, FaultKind::BadBlock, message));
        }
        Documented.define_sub(control, label, state)
    }

    /// Quirk rs274.value-at-definition. The value of an endsub is evaluated when the sub is defined.
    ///
    /// Quirk rs274.return-after-call. After a definition no call counts that was before it.
    fn skip_body(
        &self,
        control: &mut Control,
        end: u32,
        state: &mut State,
    ) -> Result<Next, StepError> {
        control.memory.has_called = false;
        if state.has_quirk(quirk::rs274::VALUE_AT_DEFINITION) {
            value_at_definition(control, end, state)?;
        }
        Documented.skip_body(control, end, state)
    }

    /// Quirk rs274.any-endsub. An endsub ends the sub that is executed, whatever its number or name.
    fn ends_sub(&self, own: &str, label: &str, state: &State) -> bool {
        state.has_quirk(quirk::rs274::ANY_ENDSUB) || Documented.ends_sub(own, label, state)
    }

    /// Quirk rs274.return-after-call. After a call, and until a sub is defined, a return in the main program is
    /// not an error: it sets the value parameters like the return of a sub, and the next block is executed.
    fn return_from(
        &self,
        control: &mut Control,
        label: &str,
        values: &[Expression],
        state: &mut State,
        record: &mut Record,
    ) -> Result<Next, StepError> {
        let in_main = state.frame().call.is_none();
        if in_main && control.memory.has_called && state.has_quirk(quirk::rs274::RETURN_AFTER_CALL)
        {
            keep_value(values, state)?;
            return Ok(Next::Following);
        }
        Documented.return_from(control, label, values, state, record)
    }

    /// Quirk rs274.value-cleared-at-return. A call does not clear the value parameters.
    fn clear_value_at_call(&self, state: &mut State) {
        if !state.has_quirk(quirk::rs274::VALUE_CLEARED_AT_RETURN) {
            Documented.clear_value_at_call(state);
        }
    }

    fn enter_call(
        &self,
        control: &mut Control,
        frame: Frame,
        first: Place,
        state: &mut State,
    ) -> Next {
        control.memory.has_called = true;
        match &frame.call {
            Some(Call { label, style: Style::Numbered { .. }, .. }) => {
                control.memory.numbers_called.insert(label.clone(), first);
            }
            Some(_) | None if state.call_level() == 0 => {
                control.memory.at_last_call = state.frame().arguments;
            }
            Some(_) | None => {}
        }
        Documented.enter_call(control, frame, first, state)
    }

    /// Quirk rs274.sub-found-later. A call finds a sub that the program defines further on, before a numbered
    /// program of the same number.
    fn sub_after_call(
        &self,
        control: &mut Control,
        label: &str,
        arguments: &[f64],
        state: &mut State,
    ) -> Result<Place, StepError> {
        let (later, number) = control.further_on(label);
        let first = later.filter(|sub| number.is_none_or(|number| *sub < number));
        let found = if control.is_numbered(label) { first } else { later };
        if let Some(line) = found.filter(|_| state.has_quirk(quirk::rs274::SUB_FOUND_LATER)) {
            let target = SearchTarget::Called { label, arguments };
            state.dialect().pass_over(control, target, later, state)?;
            let sub = Place { line, ..control.place };
            control.subs.insert(label.to_owned(), sub);
            control.memory.found_later.insert(sub);
            return Ok(sub);
        }
        Documented.sub_after_call(control, label, arguments, state)
    }

    /// Quirk rs274.file-with-two-subs. A called file can define further subs.
    fn allows_other_subs(&self, state: &State) -> bool {
        state.has_quirk(quirk::rs274::FILE_WITH_TWO_SUBS) || Documented.allows_other_subs(state)
    }

    /// Quirk rs274.unpassed-arguments-zero. Parameters that a call does not pass are zero.
    fn unpassed_arguments(&self, state: &State) -> [f64; 30] {
        if state.has_quirk(quirk::rs274::UNPASSED_ARGUMENTS_ZERO) {
            return [0.0; 30];
        }
        Documented.unpassed_arguments(state)
    }

    /// Quirk rs274.nine-levels. The main program counts as a level.
    fn most_levels(&self, state: &State) -> u32 {
        let levels = Documented.most_levels(state);
        if state.has_quirk(quirk::rs274::NINE_LEVELS) { levels - 1 } else { levels }
    }
}

impl NumberedRules for Observed {
    fn turns_of_call(&self, programmed: f64, state: &State) -> Result<u64, StepError> {
        count_too_large(programmed, state)?;
        Documented.turns_of_call(programmed, state)
    }

    /// Quirk rs274.fanuc-zero-loops. A call with L0 opens a call level that is not closed: the blocks after it
    /// are executed as if they were part of the subprogram.
    fn call_no_times(
        &self,
        control: &mut Control,
        label: String,
        first: Place,
        state: &mut State,
    ) -> Result<Next, StepError> {
        if !state.has_quirk(quirk::rs274::FANUC_ZERO_LOOPS) {
            return Documented.call_no_times(control, label, first, state);
        }
        deeper(rule::fanuc_subs::LEVEL_LIMIT, state)?;
        state.coverage.accepted(rule::fanuc_subs::NO_RETURN_VALUE);
        state.dialect().clear_value_at_numbered_call(state);
        let back = Place { line: control.place.line + 1, ..control.place };
        let style = Style::Numbered { first, turns_left: 0 };
        let frame = shared_frame(Call { label, back, style }, state);
        state.coverage.accepted(rule::fanuc_subs::ZERO_COUNT);
        state.frames.push(frame);
        Ok(Next::At(back))
    }

    /// Quirk rs274.value-cleared-at-return. A call by M98 does not clear the value of an earlier call.
    fn clear_value_at_numbered_call(&self, state: &mut State) {
        if !state.has_quirk(quirk::rs274::VALUE_CLEARED_AT_RETURN) {
            Documented.clear_value_at_numbered_call(state);
        }
    }

    /// Quirk rs274.numbers-of-all-files. M98 calls the program of this number that was called first, in whatever file
    /// it is.
    fn number_of_call(
        &self,
        control: &Control,
        label: &str,
        state: &mut State,
    ) -> Result<Place, StepError> {
        if let Some(first) = known_number(control, label, state) {
            return Ok(first);
        }
        Documented.number_of_call(control, label, state)
    }

    /// Quirk rs274.value-cleared-at-return. The end of a numbered program clears the value of an earlier call.
    fn end_turn_of_numbered(
        &self,
        control: &Control,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        Documented.end_turn_of_numbered(control, state, record)?;
        if state.has_quirk(quirk::rs274::VALUE_CLEARED_AT_RETURN) {
            clear_value(state);
        }
        Ok(())
    }
}

impl ConditionRules for Observed {
    /// Quirk rs274.later-conditions-evaluated. The condition of an elseif is evaluated even after a true one.
    fn skip_elseif(
        &self,
        control: &mut Control,
        label: &str,
        values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        if !state.has_quirk(quirk::rs274::LATER_CONDITIONS_EVALUATED) {
            return Documented.skip_elseif(control, label, values, state);
        }
        values.iter().try_for_each(|value| evaluate::value_of(value, state).map(|_| ()))?;
        control.at_branch(label, state)
    }

    /// Quirk rs274.fanuc-zero-loops. The blocks that are executed can be part of a level that was not closed, in
    /// which the labels of the surrounding program are unknown.
    fn labels_are_of_call(&self, state: &State) -> bool {
        let in_unclosed_level =
            state.frame().shares_parameters() && state.has_quirk(quirk::rs274::FANUC_ZERO_LOOPS);
        !in_unclosed_level && Documented.labels_are_of_call(state)
    }
}

/// Quirk rs274.continue-remembered. A continue in a do loop is remembered until a while or repeat loop ends; that loop
/// begins again then. A while loop tests its condition again, which makes a difference only after a break.
///
/// Quirk rs274.break-remembered. A break of a while loop is remembered until a do loop tests its condition; the do loop
/// ends then.
impl LoopRules for Observed {
    fn leave_while(&self, control: &mut Control, label: &str, end: u32, state: &mut State) -> Next {
        control.memory.continue_remembered = false;
        breaks_skipped(control, label, end, state);
        Documented.leave_while(control, label, end, state)
    }

    fn repeats_do(&self, control: &mut Control, condition: bool) -> bool {
        let ends = std::mem::take(&mut control.memory.break_remembered);
        !ends && Documented.repeats_do(control, condition)
    }

    /// Quirk rs274.repeat-counter-shared. All invocations of a sub share the counter of a repeat. The head counts down
    /// the existing counter, whichever invocation created it. A counter of zero ends the loop and is removed, so that
    /// the head creates a new one when it is reached again.
    fn begin_repeat(
        &self,
        control: &mut Control,
        label: &str,
        values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        if !state.has_quirk(quirk::rs274::REPEAT_COUNTER_SHARED) {
            return Documented.begin_repeat(control, label, values, state);
        }
        let turns_left = match control.memory.shared_counters.remove(&control.place) {
            Some(left) => left,
            None => turns(values, state)?,
        };
        if turns_left == 0 {
            return state.dialect().skip_repeat(control, label, state);
        }
        control.memory.shared_counters.insert(control.place, turns_left - 1);
        control.enter(label, Structure::Repeat { turns_left: 0 }, state);
        Ok(Next::Following)
    }

    /// Quirk rs274.repeat-counter-shared. The end returns to the head, which tests the counter.
    fn end_turn_of_repeat(
        &self,
        control: &mut Control,
        label: &str,
        place: usize,
        state: &mut State,
    ) -> Result<Next, StepError> {
        if !state.has_quirk(quirk::rs274::REPEAT_COUNTER_SHARED) {
            return Documented.end_turn_of_repeat(control, label, place, state);
        }
        let first = state.frame().open[place].line;
        control.leave(label, is_repeat, state)?;
        Ok(Next::At(control.line(first)))
    }

    fn leave_repeat(&self, control: &mut Control, first: u32) -> Next {
        if std::mem::take(&mut control.memory.continue_remembered) {
            return Next::At(control.line(first));
        }
        Documented.leave_repeat(control, first)
    }

    fn skip_repeat(
        &self,
        control: &mut Control,
        label: &str,
        state: &mut State,
    ) -> Result<Next, StepError> {
        if std::mem::take(&mut control.memory.continue_remembered) {
            return Ok(Next::At(control.place));
        }
        Documented.skip_repeat(control, label, state)
    }

    fn leave_by_break(
        &self,
        control: &mut Control,
        left: Vec<Open>,
        state: &mut State,
    ) -> Result<Next, StepError> {
        if let Some(Open { structure: Structure::While, line, .. }) = left.first() {
            control.memory.break_remembered |= state.has_quirk(quirk::rs274::BREAK_REMEMBERED);
            if std::mem::take(&mut control.memory.continue_remembered) {
                return Ok(Next::At(control.line(*line)));
            }
        }
        Documented.leave_by_break(control, left, state)
    }

    fn continue_do(
        &self,
        control: &mut Control,
        label: &str,
        line: u32,
        state: &mut State,
    ) -> Next {
        control.memory.continue_remembered = state.has_quirk(quirk::rs274::CONTINUE_REMEMBERED);
        breaks_skipped(control, label, line, state);
        Documented.continue_do(control, label, line, state)
    }

    /// Quirk rs274.continue-seeks-end. A continue in a while loop first searches for the end of the loop, and is
    /// refused if there is none.
    fn continue_while(
        &self,
        control: &mut Control,
        label: &str,
        first: u32,
        state: &mut State,
    ) -> Result<Next, StepError> {
        if state.has_quirk(quirk::rs274::CONTINUE_SEEKS_END) {
            control.end_of_skipped(label, &[Keyword::EndWhile], control.place.line, state)?;
        }
        Documented.continue_while(control, label, first, state)
    }
}

/// Quirks rs274.file-with-two-subs and rs274.sub-found-later. Whether the head of a sub is within another sub that is
/// being executed.
fn is_head_within(control: &Control, state: &State) -> bool {
    let quirk = if control.place.file == 0 {
        state.frame().is_sub() && state.has_quirk(quirk::rs274::SUB_FOUND_LATER)
    } else {
        state.has_quirk(quirk::rs274::FILE_WITH_TWO_SUBS)
    };
    state.call_level() > 0 && quirk
}

/// Quirk rs274.break-remembered. A break that is skipped before line `end` is remembered, too.
fn breaks_skipped(control: &mut Control, label: &str, end: u32, state: &mut State) {
    if state.has_quirk(quirk::rs274::BREAK_REMEMBERED) {
        let skipped = control.find(label, &[Keyword::Break], control.place.line, state);
        control.memory.break_remembered |= skipped.is_some_and(|line| line < end);
    }
}

/// Quirk rs274.value-at-definition. The value of an endsub is evaluated when the sub is defined. Named parameters that
/// do not exist then have the value zero.
fn value_at_definition(
    control: &mut Control,
    end: u32,
    state: &mut State,
) -> Result<(), StepError> {
    control.place.line = end;
    let Some(Line::Block(text)) = control.files.line(control.place, state) else { return Ok(()) };
    let value = value_after(text, state)?.map(|value| with_zeros(&value, state));
    set_returned(value.as_ref(), state)
}
