//! What can run again is packed whole: loops and subs. Files and numbered subprograms: [`super::files`].

use gaugeblock_trace::{End, FaultKind};

use crate::control::flow::Halt;
use crate::control::{Cursor, Definition, LOOP, STREAM};
use crate::error::Error;
use crate::interpret::Interpreter;
use crate::limits::Limit;
use crate::parameters::NameId;
use crate::source::Source;
use crate::syntax::packed::{Block, Keyword, Kind, NONE, OWord};
use crate::syntax::{LinePlace, Refused, Segment, Taken, is_oword, is_percent, label_ops};

/// Bytes that a label takes beside its characters.
const LABEL: usize = 32;

/// What the next line of a file was.
pub(super) enum Next {
    /// A block, the last one of the segment now.
    Block(Block),
    /// Nothing that counts.
    Nothing,
    /// A percent line.
    Percent(LinePlace),
    /// The file is over.
    Over,
}

/// A sub that cannot be packed.
pub(super) enum Bad {
    /// Another one begins within it, at this line. Whether it ends: who skips it skips the other one, too.
    Nested { line: u32, ends: bool },
    /// It does not end.
    Endless,
}

impl Interpreter {
    /// Reads the next line into a segment.
    pub(super) fn next_into<S: Source>(
        &mut self,
        source: &mut S,
        into: &mut Segment,
    ) -> Result<Next, Error> {
        self.next_of(source, into, false)
    }

    /// Reads the next line into a segment; of no interest are, if it is asked so, lines without o-words.
    pub(super) fn next_of<S: Source>(
        &mut self,
        source: &mut S,
        into: &mut Segment,
        owords_only: bool,
    ) -> Result<Next, Error> {
        let Self { reader, packer, .. } = self;
        let taken = reader.next(source, |line, place| {
            if owords_only && !is_oword(line) && !is_percent(line) {
                return (Taken::Nothing, place);
            }
            (packer.pack(line, place, into), place)
        })?;
        self.after_packing(STREAM)?;
        Ok(match taken {
            None => Next::Over,
            Some((Taken::Nothing, _)) => Next::Nothing,
            Some((Taken::Percent, place)) => Next::Percent(place),
            Some((Taken::Block, _)) => {
                into.blocks.last().map_or(Next::Nothing, |block| Next::Block(*block))
            }
        })
    }

    /// Packs a loop of the main program whose head has just been read; the head becomes its first block. A loop within a loop or sub is packed
    /// already.
    pub(crate) fn gather_loop<S: Source>(
        &mut self,
        at: Cursor,
        label: NameId,
        end: Keyword,
        source: &mut S,
    ) -> Result<(), Halt> {
        if at.segment != STREAM {
            return Ok(());
        }
        self.segments.swap(0, 1);
        self.generation = self.generation.wrapping_add(1);
        let generation = self.generation;
        let head = Cursor { segment: LOOP, place: 0 };
        if let Some(definition) = self.scopes.find(label) {
            definition.at = head;
            definition.generation = generation;
        }
        let mut code = self.segments.get_mut(1).map(core::mem::take).unwrap_or_default();
        let gathered = self.gather_until(label, end, source, &mut code);
        code.join_labels();
        if let Some(slot) = self.segments.get_mut(1) {
            *slot = code;
        }
        gathered?;
        self.cursor = head.after();
        Ok(())
    }

    /// Packs lines up to the end of a loop.
    fn gather_until<S: Source>(
        &mut self,
        label: NameId,
        end: Keyword,
        source: &mut S,
        code: &mut Segment,
    ) -> Result<(), Error> {
        // A sub without an end may have come to the end of the file.
        while !self.percent_closed {
            match self.next_into(source, code)? {
                Next::Over => return Ok(()),
                Next::Nothing => {}
                Next::Percent(place) => {
                    if self.percent_into(place, code) {
                        return Ok(());
                    }
                }
                Next::Block(Block { kind: Kind::Control(oword), .. })
                    if oword.keyword == end && (oword.label == label || oword.label == NONE) =>
                {
                    return Ok(());
                }
                Next::Block(block) => {
                    self.sub_into(&block, source, code)?;
                }
            }
            self.check_size(code)?;
        }
        Ok(())
    }

    /// A percent line among packed blocks; true where it ends the file.
    pub(super) fn percent_into(&mut self, place: LinePlace, code: &mut Segment) -> bool {
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
                code.refusals.push(Refused {
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

    /// Where a sub begins among packed blocks, it gets a segment of its own; one whose head is refused too, since who skips it looks at nothing else
    /// of it. False where it begins and is none.
    pub(super) fn sub_into<S: Source>(
        &mut self,
        head: &Block,
        source: &mut S,
        code: &mut Segment,
    ) -> Result<bool, Error> {
        let Kind::Control(oword) = head.kind else { return Ok(true) };
        if oword.keyword != Keyword::Sub {
            return Ok(true);
        }
        let gathered = self.gather_sub(oword.label, code.file, source)?;
        let is_it = |block: &Block| matches!(block.kind, Kind::Definition { label, .. } if label == oword.label);
        let known = oword.label != NONE;
        let defined =
            known && (self.segment_of(oword.label).is_some() || code.blocks.iter().any(is_it));
        let is_sub = matches!(gathered, Ok(_) | Err(Bad::Nested { ends: true, .. }));
        let Some(block) = code.blocks.last_mut() else { return Ok(is_sub) };
        match gathered {
            Ok(segment) => block.kind = Kind::Definition { label: oword.label, segment },
            Err(_) if block.refused != NONE => {}
            // What its number is counts before what is wrong within.
            Err(Bad::Nested { .. }) if !known => {
                block.kind = Kind::Definition { label: NONE, segment: NONE };
            }
            Err(bad) => {
                let (kind, message) = match bad {
                    // Its head is come to before what is wrong within.
                    _ if defined => (FaultKind::DuplicateSub, "the sub is defined twice"),
                    Bad::Nested { line, .. } => {
                        block.line = line;
                        (FaultKind::NestedSub, "a sub within a sub")
                    }
                    Bad::Endless => (FaultKind::UnknownLabel, "the sub does not end"),
                };
                block.refused = u32::try_from(code.refusals.len()).unwrap_or(NONE);
                code.refusals.push(Refused { kind, message, start: 0, end: 1 });
            }
        }
        Ok(is_sub)
    }

    /// Packs the body of a sub whose head has just been read, up to its end.
    pub(super) fn gather_sub<S: Source>(
        &mut self,
        label: NameId,
        file: u32,
        source: &mut S,
    ) -> Result<Result<u32, Bad>, Error> {
        let mut code = Segment { file, ..Segment::default() };
        // Where another one begins.
        let mut inner = None;
        loop {
            let endless = inner.map_or(Bad::Endless, |line| Bad::Nested { line, ends: false });
            match self.next_into(source, &mut code)? {
                // A sub of a file is executed as far as it goes: it is refused where its endsub is missed.
                Next::Over if file != 0 => break,
                Next::Over => return Ok(Err(endless)),
                Next::Percent(place) => {
                    if self.percent_into(place, &mut code) {
                        if file != 0 {
                            code.blocks.pop();
                            break;
                        }
                        return Ok(Err(endless));
                    }
                }
                Next::Nothing => {}
                Next::Block(Block { kind: Kind::Control(oword), line, .. }) => {
                    if oword.keyword == Keyword::Sub {
                        inner = inner.or(Some(line));
                    }
                    let ends = oword.keyword == Keyword::EndSub;
                    if ends && (label == NONE || self.written_label(&code, oword) == Some(label)) {
                        break;
                    }
                }
                Next::Block(_) => {}
            }
            if inner.is_some() {
                code.clear();
            }
            self.check_size(&code)?;
        }
        if let Some(line) = inner {
            return Ok(Err(Bad::Nested { line, ends: true }));
        }
        code.join_labels();
        let number = u32::try_from(self.segments.len()).unwrap_or(NONE);
        self.packed = self.packed.saturating_add(code.bytes());
        self.segments.push(code);
        Ok(Ok(number))
    }

    /// The label of the last block of a segment, computed where it is not written out; none where it has none.
    fn written_label(&mut self, code: &Segment, oword: OWord) -> Option<NameId> {
        if oword.label != NONE {
            return Some(oword.label);
        }
        let Self { calculator, parameters, modal, packer, words, .. } = self;
        let ops = label_ops(code, code.blocks.last()?, oword);
        calculator.clear();
        calculator.run(ops, parameters, modal, packer, words).ok()?;
        packer.computed_label(calculator.stack.first().copied()?)
    }

    /// Refuses more packed blocks than there may be.
    pub(super) fn check_size(&self, code: &Segment) -> Result<(), Error> {
        let labels = self.label_bytes();
        let bytes = self.packed.saturating_add(code.bytes()).saturating_add(labels);
        if usize::try_from(self.limits.packed_bytes).is_ok_and(|most| bytes > most) {
            return Err(self.beyond(STREAM, Limit::PackedBytes));
        }
        Ok(())
    }

    /// Bytes that labels and what they point to take.
    fn label_bytes(&self) -> usize {
        let definitions = self.scopes.definitions().saturating_mul(size_of::<Definition>());
        let labels = self.packer.labels.len().saturating_mul(LABEL);
        self.packer.labels.bytes().saturating_add(labels).saturating_add(definitions)
    }

    /// Refuses more labels than there may be: a program may be longer than memory, but then its labels must repeat.
    pub(crate) fn check_labels(&self) -> Result<(), Error> {
        self.check_size(&Segment::default())
    }

    /// Packs a sub of the main program whose head is being executed.
    pub(crate) fn sub_of_main<S: Source>(
        &mut self,
        block: &Block,
        label: NameId,
        source: &mut S,
    ) -> Result<u32, Error> {
        match self.gather_sub(label, 0, source)? {
            Ok(segment) => Ok(segment),
            Err(Bad::Nested { line, .. }) => Err(self.fault(
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
