//! Loops: while, do, repeat, break, continue.

use gaugeblock_vocabulary::FaultKind;

use super::conditions::duplicate;
use super::labels::Definition;
use super::{Control, Next, Open, Structure, condition, o_word, single};
use crate::ids::choice::control::{DoLabel, RepeatFraction};
use crate::ids::{choice, rule};
use crate::math;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Expression, Keyword};

fn is_while(structure: Structure) -> bool {
    structure == Structure::While
}

fn is_do(structure: Structure) -> bool {
    structure == Structure::Do
}

pub(crate) fn is_repeat(structure: Structure) -> bool {
    matches!(structure, Structure::Repeat { .. })
}

/// The rules of loops that a controller's dialect may replace.
pub(crate) trait LoopRules {
    /// A while whose condition is false goes on after its endwhile.
    fn leave_while(
        &self,
        control: &mut Control,
        _label: &str,
        end: u32,
        _state: &mut State,
    ) -> Next {
        Next::At(control.line(end + 1))
    }

    /// Rule control.do-while. A do loop is executed again while its condition is true.
    fn repeats_do(&self, _control: &mut Control, condition: bool) -> bool {
        condition
    }

    /// Begins a repeat.
    fn begin_repeat(
        &self,
        control: &mut Control,
        label: &str,
        values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        let turns = turns(values, state)?;
        if turns == 0 {
            control.never_entered(label, Structure::Repeat { turns_left: 0 }, state);
            return state.dialect().skip_repeat(control, label, state);
        }
        control.enter(label, Structure::Repeat { turns_left: turns - 1 }, state);
        Ok(Next::Following)
    }

    /// Ends a turn of a repeat. `place` is the repeat's place among the open conditions and loops.
    ///
    /// Rule control.repeat-recursion. The turns left belong to this invocation of the sub.
    fn end_turn_of_repeat(
        &self,
        control: &mut Control,
        label: &str,
        place: usize,
        state: &mut State,
    ) -> Result<Next, StepError> {
        state.coverage.accepted(rule::control::REPEAT_RECURSION);
        let open = &mut state.frame_mut().open[place];
        let first = open.line;
        if let Structure::Repeat { turns_left } = &mut open.structure
            && *turns_left > 0
        {
            *turns_left -= 1;
            return Ok(Next::At(control.line(first + 1)));
        }
        control.leave(label, is_repeat, state)?;
        Ok(state.dialect().leave_repeat(control, first))
    }

    /// A repeat that has made all its turns goes on after its endrepeat.
    fn leave_repeat(&self, _control: &mut Control, _first: u32) -> Next {
        Next::Following
    }

    /// A repeat without a turn goes on after its endrepeat.
    fn skip_repeat(
        &self,
        control: &mut Control,
        label: &str,
        state: &mut State,
    ) -> Result<Next, StepError> {
        let ends = &[Keyword::EndRepeat];
        let line = control.end_of_skipped(label, ends, control.place.line, state)?;
        Ok(Next::At(control.line(line + 1)))
    }

    /// Leaves a loop by a break. `left` has the loop first, and then the open conditions and loops inside it.
    ///
    /// Rule control.break. It is left at once.
    fn leave_by_break(
        &self,
        control: &mut Control,
        left: Vec<Open>,
        state: &mut State,
    ) -> Result<Next, StepError> {
        let [Open { label, line: first, structure }, inner @ ..] = &left[..] else {
            return Ok(Next::Following);
        };
        let line = control.end_of_skipped(label, &[structure.end()], *first, state)?;
        control.ends_before(inner, line, state)?;
        left.into_iter().for_each(|open| state.frame_mut().end(open));
        state.coverage.accepted(rule::control::BREAK);
        Ok(Next::At(control.line(line + 1)))
    }

    /// Rule control.continue. A do loop goes on at its while, which is on this line.
    fn continue_do(
        &self,
        control: &mut Control,
        _label: &str,
        line: u32,
        _state: &mut State,
    ) -> Next {
        Next::At(control.line(line))
    }

    /// Rule control.continue. A while goes on at its first line.
    fn continue_while(
        &self,
        control: &mut Control,
        _label: &str,
        first: u32,
        _state: &mut State,
    ) -> Result<Next, StepError> {
        Ok(Next::At(control.line(first)))
    }
}

impl Control {
    /// Rule control.while. It tests first and runs while its condition is true.
    ///
    /// A while with the label of an open do is that loop's end.
    pub(super) fn while_(
        &mut self,
        label: &str,
        values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        if let Some(place) = state.frame().find_open(label, is_do) {
            let first = state.frame().open[place].line;
            return self.while_of_do(label, first, values, state);
        }
        if let Some(first) = self.followed(label, Keyword::Do, state) {
            self.enter_at(first, label, Structure::Do, state);
            return self.while_of_do(label, first, values, state);
        }
        let again = state.frame().open.last().is_some_and(|open| {
            open.label == label && open.line == self.place.line && is_while(open.structure)
        });
        if !again {
            self.check_skipped_do(label, state)?;
            self.refuse_duplicate_label(label, rule::control::DUPLICATE_WHILE, state)?;
        }
        if condition(rule::control::WHILE, values, state)? {
            if !again {
                self.enter(label, Structure::While, state);
            }
            return Ok(Next::Following);
        }
        if again {
            self.leave(label, is_while, state)?;
        } else {
            self.never_entered(label, Structure::While, state);
        }
        state.coverage.accepted(rule::control::LOOP_AGAIN);
        let ends = &[Keyword::EndWhile];
        let line = self.end_of_skipped(label, ends, self.place.line, state)?;
        Ok(state.dialect().leave_while(self, label, line, state))
    }

    /// A while is unspecified if a do with its label is in the text before it and was not entered. The documents do not
    /// say whether such a while ends that do or begins a loop.
    fn check_skipped_do(&self, label: &str, state: &State) -> Result<(), StepError> {
        let ended = state.frame().ended_loops.get(label);
        let is_do = |keyword: Keyword| keyword == Keyword::Do;
        let in_text = self
            .definitions(label)
            .iter()
            .any(|definition| is_do(definition.keyword) && definition.line < self.place.line);
        if in_text && !ended.is_some_and(|(keyword, _)| is_do(*keyword)) {
            let why = format!("the do {} is in the text, but was not entered", o_word(label));
            return Err(StepError::Unspecified(why));
        }
        Ok(())
    }

    /// Rule control.do-while. A do loop runs once before its condition is tested, and again while that is true.
    fn while_of_do(
        &mut self,
        label: &str,
        first: u32,
        values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        let again = condition(rule::control::DO_WHILE, values, state)?;
        if state.dialect().repeats_do(self, again) {
            return Ok(Next::At(self.line(first + 1)));
        }
        self.leave(label, is_do, state)?;
        Ok(Next::Following)
    }

    /// The beginning of a do loop.
    ///
    /// Choice control.do-label: whether several do loops may carry the same label. The list of errors does not name it.
    ///
    /// Two cases stay unspecified: a do with the label of a condition or of a loop of another kind, and a do inside a do
    /// with the same label, where no sentence says which while ends which do.
    pub(super) fn do_(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        self.refuse_number_of_sub(label, rule::control::DO_WHILE, state)?;
        let first = self.find_other_definition(label, state);
        let of_do = |definition: &Definition| definition.keyword == Keyword::Do;
        if first.is_some() && !self.definitions(label).iter().all(of_do) {
            let why = format!(
                "a do whose label {} is that of a condition or another loop",
                o_word(label)
            );
            return Err(StepError::Unspecified(why));
        }
        let choice = state.choices.get::<DoLabel>();
        let frame = state.frame();
        let around = frame.find_open(label, is_do).map(|place| frame.open[place].line);
        if choice == DoLabel::Each && around.is_some_and(|around| around != self.place.line) {
            let why = format!("a do {} within one of the same label", o_word(label));
            return Err(StepError::Unspecified(why));
        }
        let line = match (first, choice) {
            (Some(_), DoLabel::Refused) => return Err(duplicate(label, rule::control::DO_WHILE)),
            (Some(first), DoLabel::First) => first,
            (Some(_), DoLabel::Each) | (None, _) => self.place.line,
        };
        self.enter_at(line, label, Structure::Do, state);
        Ok(Next::Following)
    }

    /// Rule control.unmatched-endwhile. An endwhile refers to a while, an endrepeat to a repeat.
    pub(super) fn end_while(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        let open = state.frame().find_open(label, is_while);
        let open = open.map(|place| state.frame().open[place].line);
        let first = open.or_else(|| self.followed(label, Keyword::While, state));
        let first = first.ok_or_else(|| self.unmatched(label, Keyword::While, state))?;
        Ok(Next::At(self.line(first)))
    }

    /// Rule control.repeat. The loop runs the given number of times; the count is evaluated once, at the beginning.
    ///
    /// Choice control.repeat-fraction: what a count means that is not an integer.
    pub(super) fn repeat(
        &mut self,
        label: &str,
        values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        self.refuse_duplicate_label(label, rule::control::DUPLICATE_REPEAT, state)?;
        state.dialect().begin_repeat(self, label, values, state)
    }

    /// An endrepeat refers to a repeat.
    pub(super) fn end_repeat(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        let Some(place) = state.frame().find_open(label, is_repeat) else {
            let first = self.followed(label, Keyword::Repeat, state);
            let first = first.ok_or_else(|| self.unmatched(label, Keyword::Repeat, state))?;
            return Ok(Next::At(self.line(first)));
        };
        state.dialect().end_turn_of_repeat(self, label, place, state)
    }

    /// A loop that is not executed even once ends at its first block.
    fn never_entered(&self, label: &str, structure: Structure, state: &mut State) {
        let open = Open { label: label.to_owned(), line: self.place.line, structure };
        state.frame_mut().end(open);
    }

    /// The line of the first block of a loop that has ended, where an option lets its label still point to it.
    ///
    /// Choice control.ended-label: whether the label of a loop that has ended points to it.
    ///
    /// Choice control.do-label: under one option each while goes back to the first do with its label, even if that do
    /// has ended.
    fn followed(&self, label: &str, head: Keyword, state: &State) -> Option<u32> {
        let last = state.frame().ended_loops.get(label).copied();
        let last = last.filter(|(keyword, _)| *keyword == head).map(|(_, line)| line);
        let to_first = head == Keyword::Do && state.choices.is(DoLabel::First);
        let followed = to_first || state.choices.is(choice::control::EndedLabel::Followed);
        // A label that must be computed is not found in the text.
        let last = last.filter(|_| followed)?;
        let earlier = |definition: &&Definition| {
            definition.keyword == head && definition.line < self.place.line
        };
        let first = self.definitions(label).iter().find(earlier).filter(|_| to_first);
        Some(first.map_or(last, |definition| definition.line))
    }

    /// The refusal of an endwhile or endrepeat without its head.
    ///
    /// Choice control.ended-label. Under one option a label still points to a loop that has ended. The documents do not
    /// say whether it then points to a loop, too, that is in the text and was not entered.
    fn unmatched(&self, label: &str, head: Keyword, state: &State) -> StepError {
        let in_text = self
            .definitions(label)
            .iter()
            .any(|definition| definition.keyword == head && definition.line < self.place.line);
        let followed = state.choices.is(choice::control::EndedLabel::Followed);
        if in_text && followed && state.dialect().labels_are_of_call(state) {
            let why = format!("the loop {} is in the text, but was not entered", o_word(label));
            return StepError::Unspecified(why);
        }
        let message = format!("{} is not an open loop of this kind", o_word(label));
        refuse(rule::control::UNMATCHED_ENDWHILE, FaultKind::UnknownLabel, message)
    }

    /// Rule control.break. It leaves the loop at once.
    ///
    /// Choice control.ended-label. Under one option a label still points to a loop that has ended. The documents do not
    /// say where a break of such a loop goes if an end of it follows.
    pub(super) fn break_(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        self.not_after_its_end(label, true, state)?;
        let (place, structure, first) = self.loop_of(label, state)?;
        self.within(label, structure, first, state)?;
        let left = state.frame_mut().open.split_off(place);
        if left.iter().any(|open| is_repeat(open.structure)) {
            state.coverage.accepted(rule::control::BREAK_IN_REPEAT);
        }
        state.dialect().leave_by_break(self, left, state)
    }

    /// Choice control.ended-label. A break or continue may name a loop that has ended, which the documents do not
    /// describe. With `to_end` that matters only where an end of the loop follows.
    ///
    /// Choice control.skipped-definition: whether a loop that was skipped counts, too.
    fn not_after_its_end(
        &self,
        label: &str,
        to_end: bool,
        state: &mut State,
    ) -> Result<(), StepError> {
        let followed = state.choices.is(choice::control::EndedLabel::Followed);
        if !followed || state.frame().find_open(label, |_| true).is_some() {
            return Ok(());
        }
        let is_loop = |keyword: Keyword| matches!(keyword, Keyword::While | Keyword::Do);
        let ended = state.frame().ended_loops.get(label).is_some_and(|(head, _)| is_loop(*head));
        let counts = state.choices.is(choice::control::SkippedDefinition::Counts);
        let in_text = || self.definitions(label).iter().any(|it| is_loop(it.keyword));
        let is_named = ended || counts && in_text();
        if !is_named {
            return Ok(());
        }
        let ends = [Keyword::EndWhile, Keyword::While];
        if to_end && self.find(label, &ends, self.place.line, state).is_none() {
            return Ok(());
        }
        let why = format!("{} is named after its end", o_word(label));
        Err(StepError::Unspecified(why))
    }

    /// A break or continue is inside the loop that it names. It is reached after the end of that loop only if a skipped
    /// condition overlaps the loop, and the documents do not describe overlaps.
    fn within(
        &self,
        label: &str,
        structure: Structure,
        first: u32,
        state: &mut State,
    ) -> Result<(), StepError> {
        let end = self.find(label, &[structure.end()], first, state);
        if end.is_some_and(|end| end < self.place.line) {
            let why = format!("{} is named after its end", o_word(label));
            return Err(StepError::Unspecified(why));
        }
        Ok(())
    }

    /// Conditions and loops inside a loop end before the loop does: the documents do not describe overlaps.
    fn ends_before(&self, inner: &[Open], end: u32, state: &mut State) -> Result<(), StepError> {
        for Open { label, line, structure } in inner {
            let own = self.find(label, &[structure.end()], *line, state);
            if own.is_some_and(|own| own > end) {
                let why = format!("{} ends after the loop in which it began", o_word(label));
                return Err(StepError::Unspecified(why));
            }
        }
        Ok(())
    }

    /// Rule control.continue. It goes to the next test of the condition.
    ///
    /// Choice control.ended-label. Under one option a label still points to a loop that has ended. The documents do not
    /// say whether the condition of such a loop is tested again.
    pub(super) fn continue_(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        self.not_after_its_end(label, false, state)?;
        let (place, structure, first) = self.loop_of(label, state)?;
        self.within(label, structure, first, state)?;
        state.frame_mut().open.truncate(place + 1);
        state.coverage.accepted(rule::control::CONTINUE);
        if structure == Structure::Do {
            let line = self.end_of_skipped(label, &[Keyword::While], first, state)?;
            return Ok(state.dialect().continue_do(self, label, line, state));
        }
        state.dialect().continue_while(self, label, first, state)
    }

    /// The open loop with this label: its place among what is open, its kind, its first line.
    ///
    /// Rule control.stray-break. A break or continue whose label does not point to a matching while or do is refused.
    ///
    /// Rule control.break-in-repeat. A repeat is no target of break or continue.
    fn loop_of(&self, label: &str, state: &State) -> Result<(usize, Structure, u32), StepError> {
        let frame = state.frame();
        if let Some(place) = frame.find_open(label, |kind| is_while(kind) || is_do(kind)) {
            return Ok((place, frame.open[place].structure, frame.open[place].line));
        }
        let repeat = frame.find_open(label, is_repeat).is_some();
        let rule = if repeat { rule::control::BREAK_IN_REPEAT } else { rule::control::STRAY_BREAK };
        Err(refuse(
            rule,
            FaultKind::UnknownLabel,
            format!("{} is not an open while or do", o_word(label)),
        ))
    }
}

/// How many turns a repeat makes.
///
/// Choice control.repeat-negative: whether a count below zero means no turn or is refused.
pub(crate) fn turns(values: &[Expression], state: &mut State) -> Result<u64, StepError> {
    let count = single(rule::control::REPEAT, values, state)?;
    if count < 0.0 && state.choices.is(choice::control::RepeatNegative::Refused) {
        let message = format!("a repeat of {count} turns");
        return Err(refuse(rule::control::REPEAT, FaultKind::WordOutOfRange, message));
    }
    let whole = match state.choices.get::<RepeatFraction>() {
        RepeatFraction::RoundedToEven => count.round_ties_even(),
        RepeatFraction::RoundedDown => count.floor(),
        RepeatFraction::RoundedUp => count.ceil(),
        RepeatFraction::Refused if math::near_integer(count).is_none() => {
            let message = format!("a repeat of {count} turns");
            return Err(refuse(rule::control::REPEAT, FaultKind::NotAnInteger, message));
        }
        RepeatFraction::Refused | RepeatFraction::Rounded => count.round(),
    };
    state.coverage.accepted(rule::control::REPEAT);
    Ok(saturated(whole))
}

/// A whole number as a count: zero if it is negative, the largest count if it is larger than that.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates, which is what is meant"
)]
pub(super) fn saturated(whole: f64) -> u64 {
    whole as u64
}
