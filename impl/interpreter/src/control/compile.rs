//! Compiles loops and subs as a whole, since their blocks can run again. [`super::files`] compiles files and numbered
//! subprograms.

use alloc::collections::BTreeMap;

use gaugeblock_vocabulary::{End, FaultKind};

use crate::control::o_words::ControlError;
use crate::control::{Cursor, Definition, LOOP, STREAM};
use crate::error::Error;
use crate::interpret::Interpreter;
use crate::limits::Limit;
use crate::parameters::NameId;
use crate::source::Source;
use crate::syntax::bytecode::{Block, Keyword, Kind, NONE, OWord};
use crate::syntax::{
    CodeSegment, LineError, LineKind, LinePlace, is_o_word, is_percent, label_ops,
};

/// Bytes of a label in addition to its characters.
const LABEL: usize = 32;

/// The kind of the next line of a file.
pub(super) enum Next {
    /// A block, the last one of the segment now.
    Block(Block),
    /// A line that is not a block.
    Nothing,
    /// A percent line.
    Percent(LinePlace),
    /// The file is over.
    Over,
}

/// A sub that cannot be compiled.
pub(super) enum Bad {
    /// Another one begins within it, at this line.
    Nested(u32),
    /// It does not end.
    Endless,
}

/// The line of the last endsub of each label after a place.
pub(super) struct Ends(BTreeMap<NameId, u32>);

impl Ends {
    /// Whether a sub with this label, whose head is at this line, ends; one whose label is not known ends at any
    /// endsub.
    pub(super) fn end(&self, label: NameId, head: u32) -> bool {
        if label == NONE {
            self.0.values().any(|line| *line > head)
        } else {
            self.0.get(&label).is_some_and(|line| *line > head)
        }
    }
}

fn set_kind(code: &mut CodeSegment, kind: Kind) {
    if let Some(block) = code.blocks.last_mut() {
        block.kind = kind;
    }
}

/// Refuses the last block, the head of a sub that does not end, unless it is refused anyway.
pub(super) fn refuse_endless(code: &mut CodeSegment) {
    let Some(block) = code.blocks.last_mut().filter(|block| block.refused == NONE) else { return };
    block.refused = u32::try_from(code.refusals.len()).unwrap_or(NONE);
    let (kind, message) = (FaultKind::UnknownLabel, "the sub does not end");
    code.refusals.push(LineError { kind, message, start: 0, end: 1 });
}

impl Interpreter {
    /// Reads the next line into a segment.
    pub(super) fn compile_next<S: Source>(
        &mut self,
        source: &mut S,
        into: &mut CodeSegment,
    ) -> Result<Next, Error> {
        self.compile_next_of(source, into, false)
    }

    /// Reads the next line into a segment; with `owords_only`, lines without o-words are skipped.
    pub(super) fn compile_next_of<S: Source>(
        &mut self,
        source: &mut S,
        into: &mut CodeSegment,
        owords_only: bool,
    ) -> Result<Next, Error> {
        let Self { reader, compiler, .. } = self;
        let taken = reader.next(source, |line, place| {
            if owords_only && !is_o_word(line) && !is_percent(line) {
                return (LineKind::Nothing, place, false);
            }
            let taken = compiler.compile_line(line, place, into);
            (taken, place, taken == LineKind::Nothing && line.trim_ascii().is_empty())
        })?;
        self.finish_line(STREAM)?;
        // After anything except blank lines a percent line does not begin the file.
        if let Some((LineKind::Block | LineKind::Nothing, _, false)) = taken {
            self.percent = self.percent.or(Some(false));
        }
        Ok(match taken {
            None => Next::Over,
            Some((LineKind::Nothing, ..)) => Next::Nothing,
            Some((LineKind::Percent, place, _)) => Next::Percent(place),
            Some((LineKind::Block, ..)) => {
                into.blocks.last().map_or(Next::Nothing, |block| Next::Block(*block))
            }
        })
    }

    /// Compiles a loop of the main program whose head has just been read; the head becomes its first block. A loop
    /// within a loop or sub is compiled already.
    pub(crate) fn compile_loop<S: Source>(
        &mut self,
        at: Cursor,
        label: NameId,
        end: Keyword,
        source: &mut S,
    ) -> Result<(), ControlError> {
        if at.segment != STREAM {
            return Ok(());
        }
        self.segments.swap(0, 1);
        self.generation = self.generation.wrapping_add(1);
        let generation = self.generation;
        let head = Cursor { segment: LOOP, place: 0 };
        if let Some(definition) = self.call_stack.find(label) {
            definition.at = head;
            definition.generation = generation;
        }
        let mut code = self.segments.get_mut(1).map(core::mem::take).unwrap_or_default();
        let compiled = self.compile_until(label, end, source, &mut code);
        code.join_labels();
        if let Some(slot) = self.segments.get_mut(1) {
            *slot = code;
        }
        compiled?;
        self.cursor = head.after();
        Ok(())
    }

    /// Compiles lines up to the end of a loop.
    fn compile_until<S: Source>(
        &mut self,
        label: NameId,
        end: Keyword,
        source: &mut S,
        code: &mut CodeSegment,
    ) -> Result<(), Error> {
        // A sub without an end may have reached the end of the file.
        while !self.percent_closed {
            match self.compile_next(source, code)? {
                Next::Over => return Ok(()),
                Next::Nothing => {}
                Next::Percent(place) => {
                    if self.add_percent_line(place, code) {
                        return Ok(());
                    }
                }
                Next::Block(Block { kind: Kind::Control(o_word), .. })
                    if o_word.keyword == end && (o_word.label == label || o_word.label == NONE) =>
                {
                    return Ok(());
                }
                Next::Block(block) => {
                    self.compile_inner_sub(&block, source, code)?;
                }
            }
            self.check_size(code)?;
        }
        Ok(())
    }

    /// A percent line among compiled blocks; true where it ends the file.
    pub(super) fn add_percent_line(&mut self, place: LinePlace, code: &mut CodeSegment) -> bool {
        let first = u32::try_from(code.ops.len()).unwrap_or(NONE);
        let mut block = Block {
            line: place.line,
            first,
            end: first,
            kind: Kind::Percent,
            comment: NONE,
            bare: false,
            refused: NONE,
            offset: place.offset,
        };
        match self.percent_line(place.line) {
            Ok(Some(End::PercentEnd)) => code.blocks.push(block),
            Ok(_) => return false,
            Err(_) => {
                block.refused = u32::try_from(code.refusals.len()).unwrap_or(NONE);
                code.refusals.push(LineError {
                    kind: FaultKind::BadCharacter,
                    message: "a percent line in a file that does not begin with one",
                    start: 0,
                    end: 1,
                });
                code.blocks.push(block);
                return false;
            }
        }
        true
    }

    /// Compiles a sub that begins among compiled blocks into a segment of its own, even if its head is refused: the sub
    /// is skipped as a whole. False if it has no end, and is therefore not a sub.
    pub(super) fn compile_inner_sub<S: Source>(
        &mut self,
        head: &Block,
        source: &mut S,
        code: &mut CodeSegment,
    ) -> Result<bool, Error> {
        let Kind::Control(OWord { keyword: Keyword::Sub, label, .. }) = head.kind else {
            return Ok(true);
        };
        let (inner, segment) = match self.compile_sub(label, code.file, source, true)? {
            Ok(segment) => {
                set_kind(code, Kind::Definition { label, segment });
                return Ok(true);
            }
            Err(Bad::Nested(inner)) => (Some(inner), u32::try_from(self.segments.len())),
            Err(Bad::Endless) => (None, Ok(NONE)),
        };
        if inner.is_none() {
            refuse_endless(code);
        } else {
            // A second definition is refused before an error within the sub.
            self.segments.push(CodeSegment { file: code.file, inner, ..CodeSegment::default() });
            set_kind(code, Kind::Definition { label, segment: segment.unwrap_or(NONE) });
        }
        Ok(false)
    }

    /// Compiles the body of a sub whose head has just been read, up to its end. Reading stops where another sub
    /// begins within it; with `through`, the inner one belongs to the body, because skipping passes over both.
    pub(super) fn compile_sub<S: Source>(
        &mut self,
        label: NameId,
        file: u32,
        source: &mut S,
        through: bool,
    ) -> Result<Result<u32, Bad>, Error> {
        let mut code = CodeSegment { file, ..CodeSegment::default() };
        loop {
            let endless = code.inner.map_or(Bad::Endless, Bad::Nested);
            match self.compile_next(source, &mut code)? {
                // A sub of a file is executed up to its last block; only there its missing endsub is refused.
                Next::Over if file != 0 => break,
                Next::Over => return Ok(Err(endless)),
                Next::Percent(place) => {
                    if self.add_percent_line(place, &mut code) {
                        if file != 0 {
                            code.blocks.pop();
                            break;
                        }
                        return Ok(Err(endless));
                    }
                }
                Next::Nothing => {}
                Next::Block(Block { kind: Kind::Control(o_word), line, .. }) => {
                    if o_word.keyword == Keyword::Sub {
                        if !through {
                            return Ok(Err(Bad::Nested(line)));
                        }
                        code.inner = code.inner.or(Some(line));
                    }
                    let ends = o_word.keyword == Keyword::EndSub;
                    if ends && (label == NONE || self.written_label(&code, o_word) == Some(label)) {
                        break;
                    }
                }
                Next::Block(_) => {}
            }
            self.check_size(&code)?;
        }
        code.join_labels();
        let number = u32::try_from(self.segments.len()).unwrap_or(NONE);
        self.code_bytes = self.code_bytes.saturating_add(code.bytes());
        self.segments.push(code);
        Ok(Ok(number))
    }

    /// The ends of the subs in the rest of the text; the source is at its end after it.
    pub(super) fn ends<S: Source>(&mut self, file: u32, source: &mut S) -> Result<Ends, Error> {
        let mut code = CodeSegment { file, ..CodeSegment::default() };
        let mut ends = BTreeMap::new();
        loop {
            code.clear();
            match self.compile_next_of(source, &mut code, true)? {
                Next::Over => return Ok(Ends(ends)),
                Next::Percent(place) if self.add_percent_line(place, &mut code) => {
                    return Ok(Ends(ends));
                }
                Next::Block(Block { kind: Kind::Control(o_word), line, .. })
                    if o_word.keyword == Keyword::EndSub =>
                {
                    if let Some(label) = self.written_label(&code, o_word) {
                        ends.insert(label, line);
                    }
                }
                Next::Block(_) | Next::Nothing | Next::Percent(_) => {}
            }
        }
    }

    /// The label of the last block of a segment, computed where it is not written out; none where it has none.
    fn written_label(&mut self, code: &CodeSegment, o_word: OWord) -> Option<NameId> {
        if o_word.label != NONE {
            return Some(o_word.label);
        }
        let Self { evaluator, parameters, modal, compiler, words, .. } = self;
        let ops = label_ops(code, code.blocks.last()?, o_word);
        evaluator.clear();
        evaluator.run(ops, parameters, modal, compiler, words).ok()?;
        compiler.computed_label(evaluator.stack.first().copied()?)
    }

    /// Refuses more compiled code than the limit allows.
    pub(super) fn check_size(&self, code: &CodeSegment) -> Result<(), Error> {
        let labels = self.label_bytes();
        let bytes = self.code_bytes.saturating_add(code.bytes()).saturating_add(labels);
        if usize::try_from(self.limits.code_bytes).is_ok_and(|most| bytes > most) {
            return Err(self.limit_exceeded(STREAM, Limit::CodeBytes));
        }
        Ok(())
    }

    /// How many bytes the labels and their targets take.
    fn label_bytes(&self) -> usize {
        let definitions = self.call_stack.definitions().saturating_mul(size_of::<Definition>());
        let labels = self.compiler.labels.len().saturating_mul(LABEL);
        self.compiler.labels.bytes().saturating_add(labels).saturating_add(definitions)
    }

    /// Refuses more labels than the limit allows: a program may be longer than memory, but then its labels must
    /// repeat.
    pub(crate) fn check_labels(&self) -> Result<(), Error> {
        self.check_size(&CodeSegment::default())
    }

    /// Compiles a sub of the main program whose head is being executed.
    pub(crate) fn compile_main_sub<S: Source>(
        &mut self,
        block: &Block,
        label: NameId,
        source: &mut S,
    ) -> Result<u32, Error> {
        match self.compile_sub(label, 0, source, false)? {
            Ok(segment) => Ok(segment),
            Err(Bad::Nested(line)) => Err(self.fault(
                STREAM,
                line,
                FaultKind::NestedSub,
                "a sub within a sub".into(),
                None,
            )),
            Err(Bad::Endless) => Err(self.fault(
                STREAM,
                block.line,
                FaultKind::UnknownLabel,
                "the sub does not end".into(),
                None,
            )),
        }
    }
}
