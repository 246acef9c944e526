//! Searches the text, or the compiled blocks, after the block in progress for a block with a label.

use gaugeblock_vocabulary::FaultKind;

use crate::control::{Cursor, Definition, LOOP, STREAM};
use crate::error::Error;
use crate::interpret::{Interpreter, segment};
use crate::parameters::NameId;
use crate::source::Source;
use crate::syntax::bytecode::{Block, Keyword, Kind, NONE, OWord};
use crate::syntax::{LineKind, LinePlace, PercentAlone, is_o_word, is_percent};

/// The target of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LabelTarget {
    /// The label.
    pub(crate) label: NameId,
    /// Whether a block with this keyword is the target.
    pub(crate) accept: fn(Keyword) -> bool,
}

/// The kind of a line of the main program, for a search.
enum ScannedLine {
    /// An o-word.
    Block,
    /// Another line.
    Other,
    /// A percent line.
    Percent,
}

impl Interpreter {
    /// Finds the next block of a target after the block in progress. That block is executed next.
    ///
    /// # Errors
    /// There is no such block: a condition or loop has no end.
    pub(crate) fn search_label<S: Source>(
        &mut self,
        at: Cursor,
        line: u32,
        target: LabelTarget,
        source: &mut S,
    ) -> Result<(Block, OWord), Error> {
        if at.segment != STREAM {
            if let Some((place, found, o_word)) = self.search_segment(at, target) {
                self.cursor = Cursor { place, ..at };
                return Ok((found, o_word));
            }
            if at.segment != LOOP || self.loop_ends_file() {
                return Err(self.label_not_found(at, line));
            }
        }
        match self.search_main(target, source)? {
            Some(found) => Ok(found),
            None => Err(self.label_not_found(at, line)),
        }
    }

    #[cold]
    fn label_not_found(&self, at: Cursor, line: u32) -> Error {
        let message = "nothing with this label follows".into();
        self.fault(at.segment, line, FaultKind::UnknownLabel, message, None)
    }

    /// Whether a percent line in the compiled loop ends the file: the text after it is not part of the file.
    fn loop_ends_file(&self) -> bool {
        let last = segment(&self.segments, LOOP).and_then(|code| code.blocks.last());
        last.is_some_and(|block| matches!(block.kind, Kind::Percent) && block.refused == NONE)
    }

    /// Skips the block that was found, whatever it holds.
    pub(crate) fn skip_found_block(&mut self) {
        self.line_pending = false;
        if self.cursor.segment != STREAM {
            self.cursor = self.cursor.after();
        }
    }

    /// Searches a segment of compiled blocks. Where no label must be computed, the blocks of one label are linked, and
    /// the search follows the links.
    fn search_segment(&mut self, at: Cursor, target: LabelTarget) -> Option<(u32, Block, OWord)> {
        let code = segment(&self.segments, at.segment)?;
        if code.computed || !self.compiler.choices.skipped_free {
            return self.search_each_block(at, target);
        }
        let mut place = at.place;
        loop {
            let block = code.block(place)?;
            let Kind::Control(o_word) = block.kind else { return None };
            if place != at.place && (target.accept)(o_word.keyword) {
                return Some((place, *block, o_word));
            }
            place = o_word.next;
        }
    }

    /// Searches a segment block by block.
    fn search_each_block(
        &mut self,
        at: Cursor,
        target: LabelTarget,
    ) -> Option<(u32, Block, OWord)> {
        let mut cursor = at.after();
        loop {
            let block = *segment(&self.segments, at.segment)?.block(cursor.place)?;
            if let Kind::Control(o_word) = block.kind {
                if let Some(o_word) = self.matching_o_word(cursor, &block, o_word, target) {
                    return Some((cursor.place, block, o_word));
                }
                self.define_skipped(cursor, &block, o_word);
            }
            cursor = cursor.after();
        }
    }

    /// The o-word of a block, if it has the label and a keyword of the target.
    fn matching_o_word(
        &mut self,
        at: Cursor,
        block: &Block,
        o_word: OWord,
        target: LabelTarget,
    ) -> Option<OWord> {
        if !(target.accept)(o_word.keyword) {
            return None;
        }
        let label = self.evaluate_label(at, block, o_word).ok()?;
        (label == target.label).then_some(o_word)
    }

    /// Searches the text of the main program line by line, except in bodies of subs.
    fn search_main<S: Source>(
        &mut self,
        target: LabelTarget,
        source: &mut S,
    ) -> Result<Option<(Block, OWord)>, Error> {
        self.cursor = Cursor::MAIN;
        self.line_pending = false;
        loop {
            let Some((block, o_word)) = self.next_o_word(source)? else { return Ok(None) };
            if let Some(o_word) = self.matching_o_word(Cursor::MAIN, &block, o_word, target) {
                self.line_pending = true;
                return Ok(Some((block, o_word)));
            }
            if o_word.keyword == Keyword::Sub {
                self.skip_sub(o_word.label, source)?;
            } else {
                self.define_skipped(Cursor::MAIN, &block, o_word);
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
    pub(crate) fn next_o_word<S: Source>(
        &mut self,
        source: &mut S,
    ) -> Result<Option<(Block, OWord)>, Error> {
        loop {
            if self.percent_closed {
                return Ok(None);
            }
            let Self { reader, segments, compiler, .. } = self;
            let Some(code) = segments.first_mut() else { return Ok(None) };
            let scanned = reader.next(source, |line, place| {
                if !is_o_word(line) {
                    return if is_percent(line) {
                        ScannedLine::Percent
                    } else {
                        ScannedLine::Other
                    };
                }
                code.clear();
                match compiler.compile_line(line, place, code) {
                    LineKind::Block => ScannedLine::Block,
                    LineKind::Nothing | LineKind::Percent => ScannedLine::Other,
                }
            })?;
            let ends = self.percent == Some(true)
                || self.compiler.choices.percent_alone == PercentAlone::Ends;
            match scanned {
                None => return Ok(None),
                Some(ScannedLine::Percent) if ends => {
                    self.percent_closed = true;
                    return Ok(None);
                }
                Some(ScannedLine::Percent | ScannedLine::Other) => {}
                Some(ScannedLine::Block) => {
                    self.finish_line(STREAM)?;
                    let block = segment(&self.segments, STREAM).and_then(|code| code.block(0));
                    if let Some(Block { kind: Kind::Control(o_word), .. }) = block
                        && let Some(block) = block
                    {
                        return Ok(Some((*block, *o_word)));
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
        while let Some((_, o_word)) = self.next_o_word(source)? {
            if o_word.keyword == Keyword::EndSub && o_word.label == label {
                break;
            }
        }
        Ok(())
    }

    /// Defines the label of a skipped block, under the option by which skipped blocks define labels. The rest of the
    /// block does not matter. A computed label is defined only when the block is executed.
    fn define_skipped(&mut self, at: Cursor, block: &Block, o_word: OWord) {
        let head =
            matches!(o_word.keyword, Keyword::If | Keyword::While | Keyword::Repeat | Keyword::Do);
        let label = o_word.label;
        if self.compiler.choices.skipped_free || !head || label == NONE {
            return;
        }
        if self.call_stack.find(label).is_none() {
            let definition = self.definition(at, block, label, o_word.keyword);
            self.call_stack.define(Definition { ended: true, ..definition });
        }
    }
}
