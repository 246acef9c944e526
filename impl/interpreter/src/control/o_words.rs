//! Executes o-words: labels and the blocks that they point to, conditions (11.7.6), and the errors of both (11.7.11).

use gaugeblock_vocabulary::FaultKind;

use crate::block_end::BlockKind;
use crate::canon::Sink;
use crate::control::label_search::LabelTarget;
use crate::control::{Cursor, Definition, FrameKind, STREAM};
use crate::error::Error;
use crate::faults::{PlantedFault, planted};
use crate::interpret::{Interpreter, Progress, segment};
use crate::modal::Refusal;
use crate::parameters::NameId;
use crate::source::Source;
use crate::syntax::bytecode::{Block, Keyword, Kind, NONE, OWord};
use crate::syntax::label_ops;

/// Message where a label points to no condition in progress.
const NO_IF: &str = "no open if has this label";
/// Message where a label points to no loop that break and continue can refer to.
pub(crate) const NO_LOOP: &str = "no open while or do has this label";

/// Why a control block fails.
pub(crate) enum ControlError {
    /// The block is refused.
    Refusal(Refusal),
    /// Something else is wrong, or the refusal belongs to another block.
    Error(Error),
}

impl From<Refusal> for ControlError {
    fn from(refusal: Refusal) -> Self {
        Self::Refusal(refusal)
    }
}

impl From<Error> for ControlError {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

/// Refuses a block of control.
#[cold]
pub(crate) fn refuse<T>(kind: FaultKind, message: &'static str) -> Result<T, ControlError> {
    Err(ControlError::Refusal(Refusal::fault(kind, message)))
}

impl Interpreter {
    /// Executes an o-word.
    pub(crate) fn execute_o_word<S: Source, K: Sink>(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        if at.segment == STREAM {
            self.check_labels()?;
        }
        let mut kind = BlockKind::OWord;
        let result = match (self.evaluate_label(at, block, o_word), o_word.keyword) {
            (Err(refusal), _) => Err(refusal.into()),
            (Ok(label), Keyword::Sub) => self.define_main_sub(at, block, label, source),
            (Ok(label), Keyword::EndSub | Keyword::Return) => {
                kind = BlockKind::Return;
                self.leave_sub(at, block, o_word, label, sink)
            }
            (Ok(label), Keyword::Call) => {
                kind = BlockKind::Call;
                self.call_sub(at, block, o_word, label, source)
            }
            (Ok(_), Keyword::Program) => self.check_program_number(),
            (Ok(label), _) => self.execute_structure(at, block, o_word, label, source),
        };
        match result {
            Ok(()) => {
                self.report_block_end(at, block.line, kind, sink);
                Ok(Progress::More)
            }
            Err(ControlError::Refusal(refusal)) => self.refuse(at, block.line, refusal),
            Err(ControlError::Error(error)) => Err(error),
        }
    }

    /// Executes a part of a condition or loop.
    #[inline]
    fn execute_structure<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        let at_branch = core::mem::take(&mut self.at_branch);
        match o_word.keyword {
            Keyword::If => self.begin_if(at, block, o_word, label, source),
            Keyword::ElseIf if at_branch => {
                if self.evaluate_condition(at, block, o_word)? {
                    return Ok(());
                }
                self.next_branch(at, block, label, source)
            }
            Keyword::Else if at_branch && planted(PlantedFault::ElseSkipped) => {
                self.next_branch(at, block, label, source)
            }
            Keyword::Else if at_branch => Ok(()),
            Keyword::ElseIf | Keyword::Else => {
                if o_word.keyword == Keyword::ElseIf && planted(PlantedFault::LaterConditions) {
                    self.evaluate_condition(at, block, o_word)?;
                }
                self.find_structure(label, |keyword| keyword == Keyword::If, NO_IF)?;
                let end = LabelTarget { label, accept: |keyword| keyword == Keyword::EndIf };
                self.search_label(at, block.line, end, source)?;
                Ok(())
            }
            Keyword::EndIf => self.end_if(label),
            Keyword::While => self.execute_while(at, block, o_word, label, source),
            Keyword::EndWhile => {
                let head = *self.find_structure(
                    label,
                    |keyword| keyword == Keyword::While,
                    "no open while has this label",
                )?;
                self.jump_to(head, false, source)
            }
            Keyword::Do => self.begin_do(at, block, label, source),
            Keyword::Repeat => self.begin_repeat(at, block, o_word, label, source),
            Keyword::EndRepeat => self.end_repeat(label, source),
            Keyword::Break => self.break_loop(at, block, label, source),
            Keyword::Continue => self.continue_loop(at, block, label, source),
            Keyword::Sub
            | Keyword::EndSub
            | Keyword::Return
            | Keyword::Call
            | Keyword::Program
            | Keyword::Unknown => refuse(FaultKind::BadBlock, "no such o-word"),
        }
    }

    /// The label of a block. A label that is an expression is evaluated.
    #[inline]
    pub(crate) fn evaluate_label(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
    ) -> Result<NameId, Refusal> {
        if o_word.label != NONE {
            return Ok(o_word.label);
        }
        let Self { segments, evaluator, parameters, modal, compiler, words, .. } = self;
        let Some(code) = segment(segments, at.segment) else { return Ok(NONE) };
        evaluator.clear();
        evaluator.run(label_ops(code, block, o_word), parameters, modal, compiler, words)?;
        let value = evaluator.stack.first().copied().unwrap_or(0.0);
        compiler
            .computed_label(value)
            .ok_or_else(|| Refusal::fault(FaultKind::NotAnInteger, "an o-number is an integer"))
    }

    /// Evaluates the values after a keyword and leaves them on the stack.
    #[inline]
    pub(crate) fn evaluate_values(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
    ) -> Result<(), Refusal> {
        let Self { segments, evaluator, parameters, modal, compiler, words, .. } = self;
        let Some(code) = segment(segments, at.segment) else { return Ok(()) };
        let first = if o_word.label == NONE { o_word.next } else { block.first };
        let values = Block { first, ..*block };
        evaluator.clear();
        evaluator.run(code.ops_of(&values), parameters, modal, compiler, words)
    }

    /// Evaluates a condition: any number but zero is true.
    #[inline]
    pub(crate) fn evaluate_condition(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
    ) -> Result<bool, Refusal> {
        self.evaluate_values(at, block, o_word)?;
        let value = self.evaluator.stack.first().copied().unwrap_or(0.0);
        if planted(PlantedFault::NegativeFalse) && value < 0.0 {
            return Ok(false);
        }
        Ok(value.to_bits() << 1 != 0)
    }

    /// The condition or loop that a label points to. `is_kind` accepts the keyword that began it; `missing` is the
    /// message where the label points to none of this kind.
    #[inline]
    pub(crate) fn find_structure(
        &mut self,
        label: NameId,
        is_kind: fn(Keyword) -> bool,
        missing: &'static str,
    ) -> Result<&mut Definition, ControlError> {
        let followed = self.compiler.choices.ended_followed;
        match self.call_stack.find(label) {
            Some(definition) if is_kind(definition.keyword) && (followed || !definition.ended) => {
                Ok(definition)
            }
            Some(_) | None => refuse(FaultKind::UnknownLabel, missing),
        }
    }

    /// The definition that the block in progress gives to a label.
    #[inline]
    pub(crate) fn definition(
        &self,
        at: Cursor,
        block: &Block,
        label: NameId,
        keyword: Keyword,
    ) -> Definition {
        Definition {
            label,
            keyword,
            ended: false,
            line: block.line,
            offset: block.offset,
            at,
            generation: self.generation,
            left: 0,
        }
    }

    /// Refuses a label that another block defines, or that is the number of the sub in progress.
    #[inline]
    pub(crate) fn check_label(&mut self, block: &Block, label: NameId) -> Result<(), ControlError> {
        let elsewhere =
            self.call_stack.find(label).is_some_and(|defined| defined.line != block.line);
        if elsewhere && !planted(PlantedFault::LabelTwice) {
            return refuse(FaultKind::DuplicateLabel, "the label is defined elsewhere");
        }
        let own = self.call_stack.frames.last().is_some_and(|frame| frame.label == label);
        if own && !self.compiler.choices.sub_number_free {
            return refuse(FaultKind::DuplicateLabel, "the label is the number of the sub");
        }
        Ok(())
    }

    /// `if`: its blocks are executed if its condition is true; else the search goes to the next branch.
    #[inline]
    fn begin_if<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        self.check_label(block, label)?;
        let holds = self.evaluate_condition(at, block, o_word)?;
        let definition = self.definition(at, block, label, Keyword::If);
        self.call_stack.define(definition);
        if holds {
            return Ok(());
        }
        self.next_branch(at, block, label, source)
    }

    /// Goes to the next branch of a condition and sets `at_branch`. The branch is then executed as one that was
    /// searched for: an elseif evaluates its condition, an else is taken.
    #[inline]
    fn next_branch<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        source: &mut S,
    ) -> Result<(), ControlError> {
        let mut branch: fn(Keyword) -> bool =
            |keyword| matches!(keyword, Keyword::ElseIf | Keyword::Else | Keyword::EndIf);
        if planted(PlantedFault::OneElseIf)
            && matches!(block.kind, Kind::Control(OWord { keyword: Keyword::ElseIf, .. }))
        {
            branch = |keyword| matches!(keyword, Keyword::Else | Keyword::EndIf);
        }
        self.search_label(at, block.line, LabelTarget { label, accept: branch }, source)?;
        self.at_branch = true;
        Ok(())
    }

    /// `endif`.
    #[inline]
    fn end_if(&mut self, label: NameId) -> Result<(), ControlError> {
        match self.find_structure(label, |keyword| keyword == Keyword::If, NO_IF) {
            Ok(definition) => definition.ended = true,
            Err(_) if planted(PlantedFault::StrayEndIf) => {}
            Err(error) => return Err(error),
        }
        Ok(())
    }

    /// Leaves a loop: goes to the block after its end.
    #[inline]
    pub(crate) fn leave_loop<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        accept: fn(Keyword) -> bool,
        source: &mut S,
    ) -> Result<(), ControlError> {
        self.search_label(at, block.line, LabelTarget { label, accept }, source)?;
        // The end of a loop is skipped and not executed, so that nothing in it is refused.
        self.skip_found_block();
        if let Some(definition) = self.call_stack.find(label) {
            definition.ended = true;
        }
        Ok(())
    }

    /// A number alone begins a numbered program (11.7.4.1); it does nothing.
    fn check_program_number(&self) -> Result<(), ControlError> {
        if !self.machine.fanuc_subs {
            return refuse(FaultKind::FanucDisabled, "numbered programs are disabled");
        }
        match self.call_stack.frames.last().map(|frame| frame.kind) {
            Some(FrameKind::Sub) => {
                refuse(FaultKind::MixedStyles, "a numbered program within a sub")
            }
            Some(FrameKind::Numbered { .. }) | None => Ok(()),
        }
    }
}
