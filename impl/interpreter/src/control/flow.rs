//! O-words: labels and what they point to, conditions (11.7.6), and the errors of both (11.7.11).

use gaugeblock_vocabulary::FaultKind;

use crate::block_end::BlockKind;
use crate::canon::Sink;
use crate::control::seek::Wanted;
use crate::control::{Cursor, Definition, FrameKind, STREAM};
use crate::error::Error;
use crate::faults::{Fault, planted};
use crate::interpret::{Interpreter, Progress, segment};
use crate::modal::Refusal;
use crate::parameters::NameId;
use crate::source::Source;
use crate::syntax::label_ops;
use crate::syntax::packed::{Block, Keyword, NONE, OWord};

/// Why a control block does not go on as usual.
pub(crate) enum Halt {
    /// The block is refused.
    Refusal(Refusal),
    /// Something else is wrong, or the refusal belongs to another block.
    Error(Error),
}

impl From<Refusal> for Halt {
    fn from(refusal: Refusal) -> Self {
        Self::Refusal(refusal)
    }
}

impl From<Error> for Halt {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

/// A refusal of a label.
#[cold]
pub(crate) fn refuse<T>(kind: FaultKind, message: &'static str) -> Result<T, Halt> {
    Err(Halt::Refusal(Refusal::fault(kind, message)))
}

impl Interpreter {
    /// Executes an o-word.
    pub(crate) fn control<S: Source, K: Sink>(
        &mut self,
        at: Cursor,
        block: &Block,
        oword: OWord,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        if at.segment == STREAM {
            self.check_labels()?;
        }
        let mut kind = BlockKind::OWord;
        let result = match (self.label(at, block, oword), oword.keyword) {
            (Err(refusal), _) => Err(refusal.into()),
            (Ok(label), Keyword::Sub) => self.sub(at, block, label, source),
            (Ok(label), Keyword::EndSub | Keyword::Return) => {
                kind = BlockKind::Return;
                self.leave_sub(at, block, oword, label, sink)
            }
            (Ok(label), Keyword::Call) => {
                kind = BlockKind::Call;
                self.call(at, block, oword, label, source)
            }
            (Ok(_), Keyword::Program) => self.program(),
            (Ok(label), _) => self.structure(at, block, oword, label, source),
        };
        match result {
            Ok(()) => {
                self.report_block_end(at, block.line, kind, sink);
                Ok(Progress::More)
            }
            Err(Halt::Refusal(refusal)) => self.refuse(at, block.line, refusal),
            Err(Halt::Error(error)) => Err(error),
        }
    }

    /// Executes a part of a condition or loop.
    fn structure<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        oword: OWord,
        label: NameId,
        source: &mut S,
    ) -> Result<(), Halt> {
        let landed = core::mem::take(&mut self.landed);
        match oword.keyword {
            Keyword::If => self.begin_if(at, block, oword, label, source),
            Keyword::ElseIf if landed => {
                if self.condition(at, block, oword)? {
                    return Ok(());
                }
                self.next_branch(at, block, label, source)
            }
            Keyword::Else if landed && planted(Fault::ElseSkipped) => {
                self.next_branch(at, block, label, source)
            }
            Keyword::Else if landed => Ok(()),
            Keyword::ElseIf | Keyword::Else => {
                self.pointed(label, |keyword| keyword == Keyword::If)?;
                let end = Wanted { label, accept: |keyword| keyword == Keyword::EndIf };
                self.seek(at, block.line, end, source)?;
                Ok(())
            }
            Keyword::EndIf => {
                self.pointed(label, |keyword| keyword == Keyword::If)?.ended = true;
                Ok(())
            }
            Keyword::While => self.while_block(at, block, oword, label, source),
            Keyword::EndWhile => {
                let head = *self.pointed(label, |keyword| keyword == Keyword::While)?;
                self.jump(head, false, source)
            }
            Keyword::Do => self.begin_do(at, block, label, source),
            Keyword::Repeat => self.begin_repeat(at, block, oword, label, source),
            Keyword::EndRepeat => self.end_repeat(label, source),
            Keyword::Break => {
                let loops = |keyword| matches!(keyword, Keyword::While | Keyword::Do);
                let end = if self.pointed(label, loops)?.keyword == Keyword::Do {
                    |keyword| keyword == Keyword::While
                } else {
                    |keyword| keyword == Keyword::EndWhile
                };
                self.leave(at, block, label, end, source)
            }
            Keyword::Continue => self.continue_loop(at, block, label, source),
            Keyword::Sub
            | Keyword::EndSub
            | Keyword::Return
            | Keyword::Call
            | Keyword::Program
            | Keyword::Unknown => refuse(FaultKind::BadBlock, "no such o-word"),
        }
    }

    /// The label of a block; computed ones are evaluated.
    #[inline]
    pub(crate) fn label(
        &mut self,
        at: Cursor,
        block: &Block,
        oword: OWord,
    ) -> Result<NameId, Refusal> {
        if oword.label != NONE {
            return Ok(oword.label);
        }
        let Self { segments, calculator, parameters, modal, packer, words, .. } = self;
        let Some(code) = segment(segments, at.segment) else { return Ok(NONE) };
        calculator.clear();
        calculator.run(label_ops(code, block, oword), parameters, modal, packer, words)?;
        let value = calculator.stack.first().copied().unwrap_or(0.0);
        packer
            .computed_label(value)
            .ok_or_else(|| Refusal::fault(FaultKind::NotAnInteger, "an o-number is an integer"))
    }

    /// Evaluates the values behind a keyword; they stand on the stack then.
    #[inline]
    pub(crate) fn values(
        &mut self,
        at: Cursor,
        block: &Block,
        oword: OWord,
    ) -> Result<(), Refusal> {
        let Self { segments, calculator, parameters, modal, packer, words, .. } = self;
        let Some(code) = segment(segments, at.segment) else { return Ok(()) };
        let first = if oword.label == NONE { oword.next } else { block.first };
        let values = Block { first, ..*block };
        calculator.clear();
        calculator.run(code.ops_of(&values), parameters, modal, packer, words)
    }

    /// Evaluates a condition: any number but zero is true.
    #[inline]
    pub(crate) fn condition(
        &mut self,
        at: Cursor,
        block: &Block,
        oword: OWord,
    ) -> Result<bool, Refusal> {
        self.values(at, block, oword)?;
        let value = self.calculator.stack.first().copied().unwrap_or(0.0);
        if planted(Fault::NegativeFalse) && value < 0.0 {
            return Ok(false);
        }
        Ok(value.to_bits() << 1 != 0)
    }

    /// What a label points to, where that is of the right kind.
    pub(crate) fn pointed(
        &mut self,
        label: NameId,
        right: fn(Keyword) -> bool,
    ) -> Result<&mut Definition, Halt> {
        let followed = self.packer.choices.ended_followed;
        match self.scopes.find(label) {
            Some(definition) if right(definition.keyword) && (followed || !definition.ended) => {
                Ok(definition)
            }
            Some(_) | None => {
                refuse(FaultKind::UnknownLabel, "the label points to no such structure")
            }
        }
    }

    /// A definition of a label by the block that is being executed.
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

    /// Refuses a label that is defined elsewhere.
    pub(crate) fn check_label(&mut self, block: &Block, label: NameId) -> Result<(), Halt> {
        let elsewhere = self.scopes.find(label).is_some_and(|defined| defined.line != block.line);
        if elsewhere && !planted(Fault::LabelTwice) {
            return refuse(FaultKind::DuplicateLabel, "the label is defined elsewhere");
        }
        let own = self.scopes.frames.last().is_some_and(|frame| frame.label == label);
        if own && !self.packer.choices.sub_number_free {
            return refuse(FaultKind::DuplicateLabel, "the label is the number of the sub");
        }
        Ok(())
    }

    /// `if`: the first branch whose condition is true is the one that is executed.
    fn begin_if<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        oword: OWord,
        label: NameId,
        source: &mut S,
    ) -> Result<(), Halt> {
        self.check_label(block, label)?;
        let holds = self.condition(at, block, oword)?;
        let definition = self.definition(at, block, label, Keyword::If);
        self.scopes.define(definition);
        if holds {
            return Ok(());
        }
        self.next_branch(at, block, label, source)
    }

    /// Goes to the next branch of a condition, which is executed as one that was searched for: an elseif is asked, an
    /// else is taken.
    fn next_branch<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        source: &mut S,
    ) -> Result<(), Halt> {
        let branch = |keyword| matches!(keyword, Keyword::ElseIf | Keyword::Else | Keyword::EndIf);
        self.seek(at, block.line, Wanted { label, accept: branch }, source)?;
        self.landed = true;
        Ok(())
    }

    /// Leaves a loop: goes behind the block that ends it.
    pub(crate) fn leave<S: Source>(
        &mut self,
        at: Cursor,
        block: &Block,
        label: NameId,
        accept: fn(Keyword) -> bool,
        source: &mut S,
    ) -> Result<(), Halt> {
        self.seek(at, block.line, Wanted { label, accept }, source)?;
        // The end of a loop is not executed by who goes behind it, so that nothing in it is refused.
        self.pass_behind();
        if let Some(definition) = self.scopes.find(label) {
            definition.ended = true;
        }
        Ok(())
    }

    /// A number alone begins a numbered program (11.7.4.1); it does nothing.
    fn program(&self) -> Result<(), Halt> {
        if !self.machine.fanuc_subs {
            return refuse(FaultKind::FanucDisabled, "numbered programs are disabled");
        }
        match self.scopes.frames.last().map(|frame| frame.kind) {
            Some(FrameKind::Sub) => {
                refuse(FaultKind::MixedStyles, "a numbered program within a sub")
            }
            Some(FrameKind::Numbered { .. }) | None => Ok(()),
        }
    }
}
