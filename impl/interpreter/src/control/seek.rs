//! The search for the block that a label leads to, further on in the text.

use gaugeblock_vocabulary::FaultKind;

use crate::control::{Cursor, Definition, LOOP, STREAM};
use crate::error::Error;
use crate::interpret::{Interpreter, segment};
use crate::parameters::NameId;
use crate::source::Source;
use crate::syntax::packed::{Block, Keyword, Kind, NONE, OWord};
use crate::syntax::{LinePlace, PercentAlone, Taken, is_oword, is_percent};

/// What a search looks for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    /// The label.
    pub(crate) label: NameId,
    /// What its o-word must ask for.
    pub(crate) accept: fn(Keyword) -> bool,
}

/// A line of the main program, as a search sees it.
enum Seen {
    Block,
    Other,
    Percent,
}

impl Interpreter {
    /// Finds the next block with a label, from the one that is being executed on, and makes it the next one to be
    /// executed.
    ///
    /// # Errors
    /// There is none: the label belongs to nothing that ends.
    pub(crate) fn seek<S: Source>(
        &mut self,
        at: Cursor,
        line: u32,
        wanted: Wanted,
        source: &mut S,
    ) -> Result<(Block, OWord), Error> {
        if at.segment != STREAM {
            if let Some((place, found, oword)) = self.seek_packed(at, wanted) {
                self.cursor = Cursor { place, ..at };
                return Ok((found, oword));
            }
            if at.segment != LOOP || self.ends_in_loop() {
                return Err(self.not_found(at, line));
            }
        }
        match self.seek_stream(wanted, source)? {
            Some(found) => Ok(found),
            None => Err(self.not_found(at, line)),
        }
    }

    #[cold]
    fn not_found(&self, at: Cursor, line: u32) -> Error {
        let message = "nothing with this label follows".into();
        self.fault(at.segment, line, FaultKind::UnknownLabel, message, None)
    }

    /// Whether a percent line in the packed loop is the end of the file: what stands behind is none of it.
    fn ends_in_loop(&self) -> bool {
        let last = segment(&self.segments, LOOP).and_then(|code| code.blocks.last());
        last.is_some_and(|block| matches!(block.kind, Kind::Percent) && block.refused == NONE)
    }

    /// Leaves the block that was found behind, whatever stands in it.
    pub(crate) fn pass_behind(&mut self) {
        self.held = false;
        if self.cursor.segment != STREAM {
            self.cursor = self.cursor.after();
        }
    }

    /// Within a segment. Where all labels are known the blocks of one label are joined, and the way is short.
    fn seek_packed(&mut self, at: Cursor, wanted: Wanted) -> Option<(u32, Block, OWord)> {
        let code = segment(&self.segments, at.segment)?;
        if code.computed || !self.packer.choices.skipped_free {
            return self.seek_each(at, wanted);
        }
        let mut place = at.place;
        loop {
            let block = code.block(place)?;
            let Kind::Control(oword) = block.kind else { return None };
            if place != at.place && (wanted.accept)(oword.keyword) {
                return Some((place, *block, oword));
            }
            place = oword.next;
        }
    }

    /// Within a segment, block after block.
    fn seek_each(&mut self, at: Cursor, wanted: Wanted) -> Option<(u32, Block, OWord)> {
        let mut cursor = at.after();
        loop {
            let block = *segment(&self.segments, at.segment)?.block(cursor.place)?;
            if let Kind::Control(oword) = block.kind {
                if let Some(oword) = self.matches(cursor, &block, oword, wanted) {
                    return Some((cursor.place, block, oword));
                }
                self.define_skipped(cursor, &block, oword);
            }
            cursor = cursor.after();
        }
    }

    /// The o-word, where a block is the wanted one.
    fn matches(
        &mut self,
        at: Cursor,
        block: &Block,
        oword: OWord,
        wanted: Wanted,
    ) -> Option<OWord> {
        if !(wanted.accept)(oword.keyword) {
            return None;
        }
        let label = self.label(at, block, oword).ok()?;
        (label == wanted.label).then_some(oword)
    }

    /// In the main program, line after line; bodies of subs are stepped over.
    fn seek_stream<S: Source>(
        &mut self,
        wanted: Wanted,
        source: &mut S,
    ) -> Result<Option<(Block, OWord)>, Error> {
        self.cursor = Cursor::MAIN;
        self.held = false;
        loop {
            let Some((block, oword)) = self.next_oword(source)? else { return Ok(None) };
            if let Some(oword) = self.matches(Cursor::MAIN, &block, oword, wanted) {
                self.held = true;
                return Ok(Some((block, oword)));
            }
            if oword.keyword == Keyword::Sub {
                self.skip_sub(oword.label, source)?;
            } else {
                self.define_skipped(Cursor::MAIN, &block, oword);
            }
        }
    }

    /// Goes back in the text, if the source can.
    pub(crate) fn rewind<S: Source>(
        &mut self,
        source: &mut S,
        place: LinePlace,
    ) -> Result<bool, Error> {
        self.percent_closed = false;
        Ok(self.reader.rewind(source, place)?)
    }

    /// The next o-word of the main program, in [`STREAM`]; none at the end of the file. No other line is looked at.
    pub(crate) fn next_oword<S: Source>(
        &mut self,
        source: &mut S,
    ) -> Result<Option<(Block, OWord)>, Error> {
        loop {
            if self.percent_closed {
                return Ok(None);
            }
            let Self { reader, segments, packer, .. } = self;
            let Some(code) = segments.first_mut() else { return Ok(None) };
            let seen = reader.next(source, |line, place| {
                if !is_oword(line) {
                    return if is_percent(line) { Seen::Percent } else { Seen::Other };
                }
                code.clear();
                match packer.pack(line, place, code) {
                    Taken::Block => Seen::Block,
                    Taken::Nothing | Taken::Percent => Seen::Other,
                }
            })?;
            let ends = self.percent == Some(true)
                || self.packer.choices.percent_alone == PercentAlone::Ends;
            match seen {
                None => return Ok(None),
                Some(Seen::Percent) if ends => {
                    self.percent_closed = true;
                    return Ok(None);
                }
                Some(Seen::Percent | Seen::Other) => {}
                Some(Seen::Block) => {
                    self.after_packing(STREAM)?;
                    let block = segment(&self.segments, STREAM).and_then(|code| code.block(0));
                    if let Some(Block { kind: Kind::Control(oword), .. }) = block
                        && let Some(block) = block
                    {
                        return Ok(Some((*block, *oword)));
                    }
                }
            }
        }
    }

    /// Steps over the body of a sub in the main program.
    pub(crate) fn skip_sub<S: Source>(
        &mut self,
        label: NameId,
        source: &mut S,
    ) -> Result<(), Error> {
        while let Some((_, oword)) = self.next_oword(source)? {
            if oword.keyword == Keyword::EndSub && oword.label == label {
                break;
            }
        }
        Ok(())
    }

    /// A block that is skipped defines its label too, where the option says so, whatever else stands in it; one that
    /// must be computed it has where it is come to.
    fn define_skipped(&mut self, at: Cursor, block: &Block, oword: OWord) {
        let head =
            matches!(oword.keyword, Keyword::If | Keyword::While | Keyword::Repeat | Keyword::Do);
        let label = oword.label;
        if self.packer.choices.skipped_free || !head || label == NONE {
            return;
        }
        if self.scopes.find(label).is_none() {
            let definition = self.definition(at, block, label, oword.keyword);
            self.scopes.define(Definition { ended: true, ..definition });
        }
    }
}
