//! while, do, repeat, break, continue.

use gaugeblock_vocabulary::FaultKind;

use super::conditions::duplicate;
use super::labels::Definition;
use super::{Control, Next, Open, Structure, condition, o_word, single};
use crate::ids::choice::control::{DoLabel, RepeatFraction};
use crate::ids::{choice, quirk, rule};
use crate::math;
use crate::rs274::quirks;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Expression, Keyword};

fn is_while(structure: Structure) -> bool {
    structure == Structure::While
}

fn is_do(structure: Structure) -> bool {
    structure == Structure::Do
}

fn is_repeat(structure: Structure) -> bool {
    matches!(structure, Structure::Repeat { .. })
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
            self.not_of_skipped_do(label, state)?;
            self.defined_once(label, rule::control::DUPLICATE_WHILE, state)?;
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
        quirks::control::while_ends(self, label, line, state);
        Ok(Next::At(self.line(line + 1)))
    }

    /// Nothing says whose end a while is, or whether it is one, whose do is in the text and was not entered.
    fn not_of_skipped_do(&self, label: &str, state: &State) -> Result<(), StepError> {
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
        if !quirks::control::do_ends(self) && again {
            return Ok(Next::At(self.line(first + 1)));
        }
        self.leave(label, is_do, state)?;
        Ok(Next::Following)
    }

    /// The beginning of a do loop.
    ///
    /// Choice control.do-label: whether several do loops may carry the same label, which the list of errors does not
    /// name. What a do is whose label a condition or another loop defines, it does not tell at all; nor which while
    /// ends which of two, where one stands in the other.
    pub(super) fn do_(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        self.not_of_sub(label, rule::control::DO_WHILE, state)?;
        let first = self.defined_elsewhere(label, state);
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
        self.defined_once(label, rule::control::DUPLICATE_REPEAT, state)?;
        if state.choices.quirk(quirk::rs274::REPEAT_COUNTER_SHARED) {
            return quirks::control::shared_repeat(self, label, values, state);
        }
        let turns = turns(values, state)?;
        if turns == 0 {
            self.never_entered(label, Structure::Repeat { turns_left: 0 }, state);
            return self.past_repeat(label, state);
        }
        self.enter(label, Structure::Repeat { turns_left: turns - 1 }, state);
        Ok(Next::Following)
    }

    /// Rule control.repeat-recursion. The turns left belong to this invocation of the sub.
    pub(super) fn end_repeat(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        let Some(place) = state.frame().find_open(label, is_repeat) else {
            let first = self.followed(label, Keyword::Repeat, state);
            let first = first.ok_or_else(|| self.unmatched(label, Keyword::Repeat, state))?;
            return Ok(Next::At(self.line(first)));
        };
        let first = state.frame().open[place].line;
        if state.choices.quirk(quirk::rs274::REPEAT_COUNTER_SHARED) {
            self.leave(label, is_repeat, state)?;
            return Ok(Next::At(self.line(first)));
        }
        state.coverage.accepted(rule::control::REPEAT_RECURSION);
        match &mut state.frame_mut().open[place].structure {
            Structure::Repeat { turns_left } if *turns_left > 0 => {
                *turns_left -= 1;
                Ok(Next::At(self.line(first + 1)))
            }
            Structure::Repeat { .. } | Structure::If { .. } | Structure::While | Structure::Do => {
                self.leave(label, is_repeat, state)?;
                let again = quirks::control::begins_again(self);
                Ok(if again { Next::At(self.line(first)) } else { Next::Following })
            }
        }
    }

    /// A loop that makes no turn has ended with its first block.
    fn never_entered(&self, label: &str, structure: Structure, state: &mut State) {
        let open = Open { label: label.to_owned(), line: self.place.line, structure };
        state.frame_mut().end(open);
    }

    /// Choice control.ended-label: the first block of a loop that has ended, where its label is followed all the same.
    ///
    /// Choice control.do-label: where every while goes back to the first do, so does one without a do of its own.
    fn followed(&self, label: &str, head: Keyword, state: &State) -> Option<u32> {
        let last = state.frame().ended_loops.get(label).copied();
        let last = last.filter(|(keyword, _)| *keyword == head).map(|(_, line)| line);
        let to_first = head == Keyword::Do && state.choices.is(DoLabel::First);
        let followed = to_first || state.choices.is(choice::control::EndedLabel::Followed);
        // The text tells nothing of a label that must be computed.
        let last = last.filter(|_| followed)?;
        let earlier = |definition: &&Definition| {
            definition.keyword == head && definition.line < self.place.line
        };
        let first = self.definitions(label).iter().find(earlier).filter(|_| to_first);
        Some(first.map_or(last, |definition| definition.line))
    }

    /// The refusal of an endwhile or endrepeat without its head.
    ///
    /// Choice control.ended-label: where a label still points to a loop that has ended, nothing says whether it
    /// points to one that is in the text and was not entered.
    fn unmatched(&self, label: &str, head: Keyword, state: &State) -> StepError {
        let in_text = self
            .definitions(label)
            .iter()
            .any(|definition| definition.keyword == head && definition.line < self.place.line);
        let followed = state.choices.is(choice::control::EndedLabel::Followed);
        if in_text && followed && !quirks::control::is_left_behind(state) {
            let why = format!("the loop {} is in the text, but was not entered", o_word(label));
            return StepError::Unspecified(why);
        }
        let message = format!("{} is no open loop of this kind", o_word(label));
        refuse(rule::control::UNMATCHED_ENDWHILE, FaultKind::UnknownLabel, message)
    }

    /// Goes on after the endrepeat.
    pub(crate) fn past_repeat(
        &mut self,
        label: &str,
        state: &mut State,
    ) -> Result<Next, StepError> {
        if quirks::control::begins_again(self) {
            return Ok(Next::At(self.place));
        }
        let line = self.end_of_skipped(label, &[Keyword::EndRepeat], self.place.line, state)?;
        Ok(Next::At(self.line(line + 1)))
    }

    /// Rule control.break. It leaves the loop at once.
    pub(super) fn break_(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        let (place, structure, first) = self.loop_of(label, state)?;
        self.within(label, structure, first, state)?;
        let left = state.frame_mut().open.split_off(place);
        if left.iter().any(|open| is_repeat(open.structure)) {
            state.coverage.accepted(rule::control::BREAK_IN_REPEAT);
        }
        let ends = if structure == Structure::Do { Keyword::While } else { Keyword::EndWhile };
        self.break_remembered |=
            structure == Structure::While && state.choices.quirk(quirk::rs274::BREAK_REMEMBERED);
        if structure == Structure::While && quirks::control::begins_again(self) {
            state.frame_mut().open.truncate(place + 1);
            return Ok(Next::At(self.line(first)));
        }
        let line = self.end_of_skipped(label, &[ends], first, state)?;
        self.ends_before(&left[1..], line, state)?;
        left.into_iter().for_each(|open| state.frame_mut().end(open));
        state.coverage.accepted(rule::control::BREAK);
        Ok(Next::At(self.line(line + 1)))
    }

    /// A break or continue stands in the loop that it names. One behind it is reached only where a condition that was
    /// skipped overlaps the loop, which the documents do not know.
    fn within(
        &self,
        label: &str,
        structure: Structure,
        first: u32,
        state: &mut State,
    ) -> Result<(), StepError> {
        let end = self.find(label, &[structure.end()], first, state);
        if end.is_some_and(|end| end < self.place.line) {
            let why = format!("{} is named behind its end", o_word(label));
            return Err(StepError::Unspecified(why));
        }
        Ok(())
    }

    /// What a loop holds ends before it does: the documents do not know conditions and loops that overlap.
    fn ends_before(&self, inner: &[Open], end: u32, state: &mut State) -> Result<(), StepError> {
        for Open { label, line, structure } in inner {
            let own = self.find(label, &[structure.end()], *line, state);
            if own.is_some_and(|own| own > end) {
                let why = format!("{} ends behind the loop in which it began", o_word(label));
                return Err(StepError::Unspecified(why));
            }
        }
        Ok(())
    }

    /// Rule control.continue. It goes to the next test of the condition.
    ///
    /// Choice control.ended-label: where a label still points to a loop that has ended, nothing says whether that is
    /// tested again.
    ///
    /// Quirk rs274.continue-seeks-end. In a while it looks for the end of the loop before that, so that it is refused
    /// where there is none.
    pub(super) fn continue_(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        let ended = state.frame().ended_loops.get(label);
        let ended =
            ended.is_some_and(|(keyword, _)| matches!(keyword, Keyword::While | Keyword::Do));
        let open = state.frame().find_open(label, |_| true).is_some();
        if ended && !open && state.choices.is(choice::control::EndedLabel::Followed) {
            let why = format!("{} is named behind its end", o_word(label));
            return Err(StepError::Unspecified(why));
        }
        let (place, structure, first) = self.loop_of(label, state)?;
        self.within(label, structure, first, state)?;
        state.frame_mut().open.truncate(place + 1);
        state.coverage.accepted(rule::control::CONTINUE);
        if structure == Structure::Do {
            let line = self.end_of_skipped(label, &[Keyword::While], first, state)?;
            quirks::control::do_continues(self, label, line, state);
            return Ok(Next::At(self.line(line)));
        }
        if state.choices.quirk(quirk::rs274::CONTINUE_SEEKS_END) {
            self.end_of_skipped(label, &[Keyword::EndWhile], self.place.line, state)?;
        }
        Ok(Next::At(self.line(first)))
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
            format!("{} is no open while or do", o_word(label)),
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

/// A whole number, zero when it is negative; a count too large for the type is as good as endless.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates, which is what is meant"
)]
pub(super) fn saturated(whole: f64) -> u64 {
    whole as u64
}
