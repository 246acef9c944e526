//! The profile of a lathe cycle (11.5.38, 11.5.39): its sub runs as a call does, and its blocks are read and not
//! executed. The sink receives the cycle's own block only.

use gaugeblock_vocabulary::{Effect, Settings};

use crate::block_end::BlockKind;
use crate::canon::{Reply, Sink};
use crate::control::Cursor;
use crate::control::o_words::ControlError;
use crate::error::Error;
use crate::interpret::{Interpreter, Progress, segment};
use crate::modal::{ProfileStage, Refusal};
use crate::source::Source;
use crate::syntax::bytecode::{Block, Kind, NONE};

/// Discards what the blocks of a profile would report.
struct DiscardingSink;

impl Sink for DiscardingSink {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, _effect: &Effect) -> Reply {
        Reply::Done
    }
}

impl Interpreter {
    /// Calls the sub of the cycle in progress, or reads the next block of it.
    pub(crate) fn read_profile<S: Source>(
        &mut self,
        cycle: (Cursor, u32, BlockKind),
        stage: ProfileStage,
        source: &mut S,
    ) -> Result<Progress, Error> {
        self.parameters.numbered.suspend_notes();
        let read = match stage {
            ProfileStage::Call(number) => self.call_profile(cycle, number, source),
            ProfileStage::Blocks => self.read_profile_block(source),
        };
        self.parameters.numbered.resume_notes();
        match read {
            Ok(Progress::More) => {
                if self.call_stack.frames.len() <= self.call_stack.outside_profile {
                    self.modal.end_profile();
                    self.parameters.line = cycle.1;
                }
                self.pending = Some(cycle);
            }
            Ok(Progress::Stopped | Progress::Aborted | Progress::Ended(_)) | Err(_) => {
                self.modal.abandon_profile(&mut self.parameters.numbered);
            }
        }
        read
    }

    fn call_profile<S: Source>(
        &mut self,
        (at, line, _): (Cursor, u32, BlockKind),
        number: f64,
        source: &mut S,
    ) -> Result<Progress, Error> {
        self.call_stack.outside_profile = self.call_stack.frames.len();
        match self.call_by_number(number, source) {
            Ok(()) => {
                self.modal.begin_profile();
                Ok(Progress::More)
            }
            Err(ControlError::Refusal(refusal)) => self.refuse(at, line, refusal),
            Err(ControlError::Error(error)) => Err(error),
        }
    }

    /// Reads the next block. Blocks of a sub are compiled, so that none comes from the text of the main program.
    fn read_profile_block<S: Source>(&mut self, source: &mut S) -> Result<Progress, Error> {
        let at = self.cursor;
        let block = segment(&self.segments, at.segment).and_then(|code| code.block(at.place));
        let Some(block) = block.copied() else { return Err(self.file_ended()) };
        self.cursor = at.after();
        self.parameters.line = block.line;
        if block.refused != NONE {
            return Err(self.refused(at, &block));
        }
        match block.kind {
            Kind::Plain => match self.read_profile_words(at, &block) {
                Ok(()) => Ok(Progress::More),
                Err(refusal) => self.roll_back(at, block.line, refusal),
            },
            Kind::Control(o_word) => {
                self.execute_o_word(at, &block, o_word, source, &mut DiscardingSink)
            }
            Kind::Definition { label, segment } => {
                self.define_sub(at, &block, label, segment)?;
                Ok(Progress::More)
            }
            Kind::Percent => Err(self.file_ended()),
        }
    }

    /// Evaluates a block of words and hands it to the cycle; its parameters are set.
    fn read_profile_words(&mut self, at: Cursor, block: &Block) -> Result<(), Refusal> {
        let Self { segments, evaluator, parameters, modal, compiler, words, .. } = self;
        let Some(code) = segment(segments, at.segment) else { return Ok(()) };
        words.clear(block.line);
        evaluator.clear();
        evaluator.run(code.ops_of(block), parameters, modal, compiler, words)?;
        evaluator.apply(parameters);
        modal.add_to_profile(words)
    }
}
