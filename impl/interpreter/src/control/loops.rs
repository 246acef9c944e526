//! Executes loops (11.7.5, 11.7.7): their beginning, their repetition, and leaving them.

use gaugeblock_vocabulary::FaultKind;

use crate::control::label_search::LabelTarget;
use crate::control::o_words::{ControlError, NO_LOOP, refuse};
use crate::control::{Cursor, Definition, LOOP};
use crate::faults::{PlantedFault, planted};
use crate::interpret::Interpreter;
use crate::math;
use crate::modal::Refusal;
use crate::parameters::NameId;
use crate::source::Source;
use crate::syntax::bytecode::{Block, Keyword, OWord};
use crate::syntax::{DoLabel, LinePlace, RepeatFraction};

impl Interpreter {
    /// `while`: the head of a loop, or the end of a do.
    #[inline]
    pub(crate) fn execute_while<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        let followed = self.compiler.choices.ended_followed;
        if let Some(head) = self.call_stack.find(label).copied()
            && head.keyword == Keyword::Do
            && (followed || !head.ended || self.compiler.choices.do_label == DoLabel::First)
        {
            if self.evaluate_condition(at, block, o_word)? {
                return self.jump_to(head, true, source);
            }
            if let Some(head) = self.call_stack.find(label) {
                head.ended = true;
            }
            return Ok(());
        }
        self.check_label(block, label)?;
        let holds = self.evaluate_condition(at, block, o_word)?;
        let definition = self.definition(at, block, label, Keyword::While);
        self.call_stack.define(definition);
        if holds {
            return self.compile_loop(at, label, Keyword::EndWhile, source);
        }
        self.leave_loop(at, block, label, |keyword| keyword == Keyword::EndWhile, source)
    }

    /// `do`.
    pub(crate) fn begin_do<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        if let Some(defined) = self.call_stack.find(label).copied()
            && defined.line != block.line
        {
            match self.compiler.choices.do_label {
                DoLabel::Each => {}
                DoLabel::First if defined.keyword == Keyword::Do => return Ok(()),
                DoLabel::First => {}
                DoLabel::Refused => self.check_label(block, label)?,
            }
        } else {
            self.check_label(block, label)?;
        }
        let definition = self.definition(at, block, label, Keyword::Do);
        self.call_stack.define(definition);
        self.compile_loop(at, label, Keyword::While, source)
    }

    /// `repeat`.
    #[inline]
    pub(crate) fn begin_repeat<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        self.check_label(block, label)?;
        self.evaluate_values(at, block, o_word)?;
        let count = self.evaluator.stack.first().copied().unwrap_or(0.0);
        let mut left = self.repeat_count(count)?;
        if let Some(before) = self.call_stack.find(label).filter(|before| before.ended)
            && before.keyword == Keyword::Repeat
            && planted(PlantedFault::RepeatKeepsCount)
        {
            left = left.min(before.left);
        }
        let definition = self.definition(at, block, label, Keyword::Repeat);
        self.call_stack.define(Definition { left, ..definition });
        if left != 0 {
            return self.compile_loop(at, label, Keyword::EndRepeat, source);
        }
        self.leave_loop(at, block, label, |keyword| keyword == Keyword::EndRepeat, source)
    }

    /// How many turns a repeat makes.
    fn repeat_count(&self, count: f64) -> Result<u64, ControlError> {
        if count < 0.0 && self.compiler.choices.negative_refused {
            return refuse(FaultKind::WordOutOfRange, "a count is not negative");
        }
        let near = math::near_integer(count);
        let turns = match self.compiler.choices.repeat_fraction {
            RepeatFraction::Rounded => math::round_away(count),
            RepeatFraction::RoundedToEven => math::round_even(count),
            RepeatFraction::RoundedDown => math::floor(count),
            RepeatFraction::RoundedUp => math::ceil(count),
            RepeatFraction::Refused if near.is_none() => {
                return refuse(FaultKind::NotAnInteger, "a count is an integer");
            }
            RepeatFraction::Refused => math::round_even(count),
        };
        let more = if planted(PlantedFault::RepeatOnceMore) { 1.0 } else { 0.0 };
        Ok(math::to_count(turns + more))
    }

    /// `endrepeat`.
    #[inline]
    pub(crate) fn end_repeat<S: Source>(
        &mut self,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        let head = self.find_structure(
            label,
            |keyword| keyword == Keyword::Repeat,
            "no open repeat has this label",
        )?;
        if head.ended {
            let head = *head;
            return self.jump_to(head, false, source);
        }
        if head.left <= 1 {
            head.ended = true;
            return Ok(());
        }
        head.left = head.left.saturating_sub(1);
        let head = *head;
        self.jump_to(head, true, source)
    }

    /// `break`.
    pub(crate) fn break_loop<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        let loops = |keyword| {
            matches!(keyword, Keyword::While | Keyword::Do)
                || keyword == Keyword::Repeat && planted(PlantedFault::RepeatBreaks)
        };
        let head = self.find_structure(label, loops, NO_LOOP)?.keyword;
        if head == Keyword::Do && planted(PlantedFault::BreakTestsDo) {
            return self.continue_loop(at, block, label, source);
        }
        let end: fn(Keyword) -> bool = if head == Keyword::Do {
            |keyword| keyword == Keyword::While
        } else if head == Keyword::Repeat {
            |keyword| keyword == Keyword::EndRepeat
        } else {
            |keyword| keyword == Keyword::EndWhile
        };
        self.leave_loop(at, block, label, end, source)
    }

    /// `continue`.
    pub(crate) fn continue_loop<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        let loops = |keyword| matches!(keyword, Keyword::While | Keyword::Do);
        let head = *self.find_structure(label, loops, NO_LOOP)?;
        if head.keyword == Keyword::While {
            if planted(PlantedFault::ContinueLeaves) {
                let end = |keyword| keyword == Keyword::EndWhile;
                return self.leave_loop(at, block, label, end, source);
            }
            if self.compiler.choices.emulates_rs274 {
                let target = LabelTarget { label, accept: |keyword| keyword == Keyword::EndWhile };
                self.search_label(at, block.line, target, source)?;
            }
            return self.jump_to(head, false, source);
        }
        if planted(PlantedFault::ContinueUntested) {
            return self.jump_to(head, true, source);
        }
        let target = LabelTarget { label, accept: |keyword| keyword == Keyword::While };
        self.search_label(at, block.line, target, source)?;
        Ok(())
    }

    /// Goes back to the head of a loop; if `behind`, to the block after the head.
    pub(crate) fn jump_to<S: Source>(
        &mut self,
        head: Definition,
        behind: bool,
        source: &mut S,
    ) -> Result<(), ControlError> {
        // After the loop in LOOP the text continues at the source's place; nothing else jumps back into that loop.
        let in_segment = head.at.segment > LOOP
            || head.at.segment == LOOP
                && self.cursor.segment == LOOP
                && head.generation == self.generation;
        if in_segment {
            self.cursor = if behind { head.at.after() } else { head.at };
            return Ok(());
        }
        let place = LinePlace { line: head.line, offset: head.offset };
        if !self.rewind(source, place)? {
            let what = "a jump back to a loop that has ended, in a source that cannot go back";
            return Err(ControlError::Refusal(Refusal::Unsupported(what.into())));
        }
        self.cursor = Cursor::MAIN;
        self.line_pending = false;
        if behind {
            self.read_block(source)?;
        }
        Ok(())
    }
}
