//! What can run again is packed whole: loops and subs. Files and numbered subprograms: [`super::files`].

use alloc::collections::BTreeMap;

use gaugeblock_vocabulary::{End, FaultKind};

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
    /// Another one begins within it, at this line.
    Nested(u32),
    /// It does not end.
    Endless,
}

/// Where the last endsub of each label stands behind a place.
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

fn set_kind(code: &mut Segment, kind: Kind) {
    if let Some(block) = code.blocks.last_mut() {
        block.kind = kind;
    }
}

/// Refuses the last block, the head of a sub that does not end, unless it is refused anyway.
pub(super) fn refuse_endless(code: &mut Segment) {
    let Some(block) = code.blocks.last_mut().filter(|block| block.refused == NONE) else { return };
    block.refused = u32::try_from(code.refusals.len()).unwrap_or(NONE);
    let (kind, message) = (FaultKind::UnknownLabel, "the sub does not end");
    code.refusals.push(Refused { kind, message, start: 0, end: 1 });
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
                return (Taken::Nothing, place, false);
            }
            let taken = packer.pack(line, place, into);
            (taken, place, taken == Taken::Nothing && line.trim_ascii().is_empty())
        })?;
        self.after_packing(STREAM)?;
        // Behind anything but blank lines a percent line does not begin the file.
        if let Some((Taken::Block | Taken::Nothing, _, false)) = taken {
            self.percent = self.percent.or(Some(false));
        }
        Ok(match taken {
            None => Next::Over,
            Some((Taken::Nothing, ..)) => Next::Nothing,
            Some((Taken::Percent, place, _)) => Next::Percent(place),
            Some((Taken::Block, ..)) => {
                into.blocks.last().map_or(Next::Nothing, |block| Next::Block(*block))
            }
        })
    }

    /// Packs a loop of the main program whose head has just been read; the head becomes its first block. A loop
    /// within a loop or sub is packed already.
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

    /// Where a sub begins among packed blocks, it gets a segment of its own; one whose head is refused too, since who
    /// skips it looks at nothing else of it. False where it begins and is none, since it does not end.
    pub(super) fn sub_into<S: Source>(
        &mut self,
        head: &Block,
        source: &mut S,
        code: &mut Segment,
    ) -> Result<bool, Error> {
        let Kind::Control(OWord { keyword: Keyword::Sub, label, .. }) = head.kind else {
            return Ok(true);
        };
        let (inner, segment) = match self.gather_sub(label, code.file, source, true)? {
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
            // Whether it is defined twice counts before what is wrong within.
            self.segments.push(Segment { file: code.file, inner, ..Segment::default() });
            set_kind(code, Kind::Definition { label, segment: segment.unwrap_or(NONE) });
        }
        Ok(false)
    }

    /// Packs the body of a sub whose head has just been read, up to its end. Where another one begins within it that
    /// is as far as it is read, unless it is gathered through: then that one belongs to it, for who skips it.
    pub(super) fn gather_sub<S: Source>(
        &mut self,
        label: NameId,
        file: u32,
        source: &mut S,
        through: bool,
    ) -> Result<Result<u32, Bad>, Error> {
        let mut code = Segment { file, ..Segment::default() };
        loop {
            let endless = code.inner.map_or(Bad::Endless, Bad::Nested);
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
                        if !through {
                            return Ok(Err(Bad::Nested(line)));
                        }
                        code.inner = code.inner.or(Some(line));
                    }
                    let ends = oword.keyword == Keyword::EndSub;
                    if ends && (label == NONE || self.written_label(&code, oword) == Some(label)) {
                        break;
                    }
                }
                Next::Block(_) => {}
            }
            self.check_size(&code)?;
        }
        code.join_labels();
        let number = u32::try_from(self.segments.len()).unwrap_or(NONE);
        self.packed = self.packed.saturating_add(code.bytes());
        self.segments.push(code);
        Ok(Ok(number))
    }

    /// Where subs end in what follows; the source has been read to its end then.
    pub(super) fn ends<S: Source>(&mut self, file: u32, source: &mut S) -> Result<Ends, Error> {
        let mut code = Segment { file, ..Segment::default() };
        let mut ends = BTreeMap::new();
        loop {
            code.clear();
            match self.next_of(source, &mut code, true)? {
                Next::Over => return Ok(Ends(ends)),
                Next::Percent(place) if self.percent_into(place, &mut code) => {
                    return Ok(Ends(ends));
                }
                Next::Block(Block { kind: Kind::Control(oword), line, .. })
                    if oword.keyword == Keyword::EndSub =>
                {
                    if let Some(label) = self.written_label(&code, oword) {
                        ends.insert(label, line);
                    }
                }
                Next::Block(_) | Next::Nothing | Next::Percent(_) => {}
            }
        }
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
        match self.gather_sub(label, 0, source, false)? {
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
