//! A line becomes a block (11.4.2): block delete, line number, then words, settings of parameters and comments in any
//! order.

use alloc::string::String;

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};
use crate::syntax::bytecode::{Block, CodeSegment, Kind, NONE, Op, ParameterRef};
use crate::syntax::choices::LineNumbers;
use crate::syntax::code_number::{g_number, m_number};
use crate::syntax::compiler::LineCompiler;
use crate::syntax::cursor::Cursor;
use crate::syntax::parameter::is_machine_state;
use crate::syntax::{Parsed, comment, number};

/// The kind of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineKind {
    /// Nothing that is executed: it is blank, deleted, or a comment that does not act.
    Nothing,
    /// A block, which is the last one of the segment now.
    Block,
    /// A percent sign and nothing else.
    Percent,
}

/// The place of a line in its file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinePlace {
    /// From 1.
    pub(crate) line: u32,
    /// Bytes before it.
    pub(crate) offset: u64,
}

/// Most digits of a line number, where it has a greatest one.
const LINE_NUMBER_DIGITS_MAX: usize = 7;

/// A line that becomes a block.
#[derive(Clone, Copy, Debug)]
struct LineText<'a> {
    /// As it is written.
    written: &'a [u8],
    /// The same, with blanks in the place of removed comments.
    code: &'a [u8],
    /// The last removed comment.
    comment: Option<&'a [u8]>,
}

/// State that the items of a block share.
struct Items<'a> {
    /// Letters that were used, a bit each; 26 to 28 are `$`, `@` and `^`.
    letters: u32,
    /// The last comment.
    comment: Option<&'a [u8]>,
}

impl LineCompiler {
    /// Compiles a line and appends its block to a segment. A line that is not a valid block is compiled too: as one
    /// that is refused when it is executed.
    #[inline]
    pub(crate) fn compile_line(
        &mut self,
        line: &[u8],
        place: LinePlace,
        into: &mut CodeSegment,
    ) -> LineKind {
        if self.choices.comments_removed && line.iter().any(|byte| matches!(byte, b'(' | b';')) {
            return self.compile_without_comments(line, place, into);
        }
        self.compile_text(LineText { written: line, code: line, comment: None }, place, into)
    }

    /// Compiles a line whose comments count as blanks.
    #[cold]
    fn compile_without_comments(
        &mut self,
        line: &[u8],
        place: LinePlace,
        into: &mut CodeSegment,
    ) -> LineKind {
        let mut code = core::mem::take(&mut self.uncommented);
        code.clear();
        code.extend_from_slice(line);
        let comment = self.blank_comments(line, &mut code);
        let kind = self.compile_text(LineText { written: line, code: &code, comment }, place, into);
        self.uncommented = code;
        kind
    }

    /// Puts blanks in the place of a line's comments, and returns the last one. A comment that is not valid stays, and
    /// all after it, so that it is refused in its place.
    fn blank_comments<'a>(&self, line: &'a [u8], code: &mut [u8]) -> Option<&'a [u8]> {
        let mut items = Items { letters: 0, comment: None };
        let mut cursor = Cursor::new(line);
        while let Some(before) = cursor.rest().iter().position(|byte| matches!(byte, b'(' | b';')) {
            cursor.advance_to_next(before);
            let start = cursor.at();
            if self.comment(&mut cursor, &mut items).is_err() {
                break;
            }
            if let Some(comment) = code.get_mut(start..cursor.at()) {
                comment.fill(b' ');
            }
        }
        items.comment
    }

    /// Compiles a line as [`Self::compile_line`] does.
    #[inline]
    fn compile_text(
        &mut self,
        text: LineText<'_>,
        place: LinePlace,
        into: &mut CodeSegment,
    ) -> LineKind {
        let line = text.written;
        let is_removed = text.comment.is_some();
        let mut cursor = Cursor::new(text.code);
        if cursor.is_at_end() && !is_removed {
            return LineKind::Nothing;
        }
        if cursor.peek() == b'%' && is_percent(line) {
            return LineKind::Percent;
        }
        let slash = cursor.take(b'/');
        let behind = line.first() != Some(&b'/') && planted(PlantedFault::SlashBehindBlank);
        let stays = cursor.peek() == b'o' && planted(PlantedFault::OWordsNotDeleted);
        let skips = !planted(PlantedFault::NothingDeleted) && !stays;
        if slash && self.block_delete && skips && !behind {
            return LineKind::Nothing;
        }
        let alone = cursor.is_at_end() && !is_removed;
        if alone && !(slash && self.report_comments) {
            return LineKind::Nothing;
        }
        let first = u32::try_from(into.ops.len()).unwrap_or(NONE);
        let mut block = Block {
            line: place.line,
            first,
            end: first,
            kind: Kind::Plain,
            comment: NONE,
            bare: alone,
            refused: NONE,
            offset: place.offset,
        };
        let mut parsed = self.items(cursor, text.comment, &mut block, into);
        let within = self.within_length(line);
        if within.len() < line.len() && !planted(PlantedFault::AnyLength) {
            let within = text.code.get(..within.len()).unwrap_or(text.code);
            self.truncate_o_word(within, &mut block, into);
            parsed = cursor.refuse(FaultKind::LineTooLong, "a line has at most 256 characters");
        }
        if let Err(refused) = parsed {
            block.refused = u32::try_from(into.refusals.len()).unwrap_or(NONE);
            into.refusals.push(*refused);
        }
        if block.bare && block.comment == NONE && block.refused == NONE && !self.report_comments {
            return LineKind::Nothing;
        }
        block.end = u32::try_from(into.ops.len()).unwrap_or(NONE);
        into.blocks.push(block);
        LineKind::Block
    }

    /// Everything after the block delete character. `removed` is the last comment that the cursor does not meet.
    fn items<'a>(
        &mut self,
        mut cursor: Cursor<'a>,
        removed: Option<&'a [u8]>,
        block: &mut Block,
        into: &mut CodeSegment,
    ) -> Parsed<()> {
        let numbered = cursor.peek() == b'n';
        if numbered {
            self.line_number(&mut cursor)?;
        }
        let mut items = Items { letters: 0, comment: removed };
        let mut other = false;
        while !cursor.is_at_end() {
            match cursor.peek() {
                b'o' if !other => {
                    let commented = items.comment.is_some();
                    return self.o_word(&mut cursor, commented, block, into);
                }
                byte @ b'a'..=b'z' => {
                    other = true;
                    self.word(byte.wrapping_sub(b'a'), &mut cursor, &mut items, into)?;
                }
                b'(' | b';' => self.comment(&mut cursor, &mut items)?,
                byte => {
                    other = true;
                    self.item(byte, &mut cursor, &mut items, into)?;
                }
            }
        }
        if let Some(text) = items.comment {
            block.comment = comment::pack(self, text, into).unwrap_or(NONE);
            block.bare = !other && !numbered;
        }
        Ok(())
    }

    /// The part of a line within the 256 characters that it may have (11.4.2), of which the line end may be one. A
    /// character of several bytes counts once.
    #[inline]
    fn within_length<'a>(&self, line: &'a [u8]) -> &'a [u8] {
        let longest = if self.choices.line_end_free { 256 } else { 255 };
        if line.len() <= longest {
            return line;
        }
        let begins =
            |(_, byte): &(usize, &u8)| self.choices.emulates_rs274 || !matches!(byte, 0x80..=0xbf);
        let behind = line.iter().enumerate().filter(begins).nth(longest);
        line.get(..behind.map_or(line.len(), |(at, _)| at)).unwrap_or(line)
    }

    /// A line that is too long is the o-word of its first characters, or none: a search ignores a keyword after them.
    #[cold]
    fn truncate_o_word(&mut self, within: &[u8], block: &mut Block, into: &mut CodeSegment) {
        let Kind::Control(_) = core::mem::replace(&mut block.kind, Kind::Plain) else { return };
        into.ops.truncate(usize::try_from(block.first).unwrap_or(usize::MAX));
        let mut cursor = Cursor::new(within);
        cursor.take(b'/');
        // Why it is refused is known.
        let _refused = self.items(cursor, None, block, into);
    }

    /// A setting, or a word that has no letter.
    #[inline]
    fn item(
        &mut self,
        byte: u8,
        cursor: &mut Cursor<'_>,
        items: &mut Items<'_>,
        into: &mut CodeSegment,
    ) -> Parsed<()> {
        match byte {
            b'#' => self.setting(cursor, into),
            b'$' => self.sign_word(26, Op::Dollar, cursor, items, into),
            b'@' => self.sign_word(27, Op::At, cursor, items, into),
            b'^' => self.sign_word(28, Op::Caret, cursor, items, into),
            b'0'..=b'9' | b'.' | b'+' | b'-' | b'=' | b'[' => {
                cursor.refuse(FaultKind::BadBlock, "a word begins with a letter")
            }
            _ => cursor.refuse(FaultKind::BadCharacter, "this character belongs nowhere"),
        }
    }

    /// A letter and its value.
    #[inline]
    fn word(
        &mut self,
        letter: u8,
        cursor: &mut Cursor<'_>,
        items: &mut Items<'_>,
        into: &mut CodeSegment,
    ) -> Parsed<()> {
        let start = cursor.at();
        const G: u8 = b'g' - b'a';
        const M: u8 = b'm' - b'a';
        const N: u8 = b'n' - b'a';
        const O: u8 = b'o' - b'a';
        if letter == N || letter == O {
            return cursor
                .refuse(FaultKind::BadBlock, "it is allowed only at the beginning of a line");
        }
        // The usual word is a letter and a number; it never touches the stack.
        let short = number::read_short(cursor.rest().get(1..).unwrap_or(&[]));
        let known = if let Some(short) = short {
            cursor.advance_to_next(short.length.wrapping_add(1));
            Some(short.value())
        } else {
            cursor.step();
            self.value(cursor, into, self.bracket_depth)?;
            match into.ops.last().copied() {
                Some(Op::Number(number)) => {
                    into.ops.pop();
                    Some(number)
                }
                Some(_) | None => None,
            }
        };
        if letter == G
            && let Some(code @ 0..=99) = short.and_then(number::Short::integer)
        {
            into.ops.push(Op::GCode(u16::try_from(code).unwrap_or(0).wrapping_mul(10)));
            return Ok(());
        }
        if letter == G || letter == M {
            return code(into, letter == G, known, self.choices.code_hundredths)
                .or_else(|message| cursor.refuse_from(start, FaultKind::UnknownCode, message));
        }
        let bit = 1_u32.wrapping_shl(u32::from(letter));
        if items.letters & bit != 0 {
            return cursor.refuse_from(start, FaultKind::RepeatedWord, "a letter occurs twice");
        }
        items.letters |= bit;
        if let Some(number) = known {
            into.ops.push(Op::WordNumber(letter, number));
            return Ok(());
        }
        match into.ops.last_mut() {
            Some(last @ Op::Numbered(_)) => {
                if let Op::Numbered(number) = *last {
                    *last = Op::WordNumbered(letter, number);
                }
            }
            Some(_) | None => into.ops.push(Op::Word(letter)),
        }
        Ok(())
    }

    /// `$`, `@` or `^` and its value.
    fn sign_word(
        &mut self,
        place: u8,
        op: Op,
        cursor: &mut Cursor<'_>,
        items: &mut Items<'_>,
        into: &mut CodeSegment,
    ) -> Parsed<()> {
        let start = cursor.at();
        cursor.step();
        self.value(cursor, into, self.bracket_depth)?;
        let bit = 1_u32.wrapping_shl(u32::from(place));
        let polar = matches!(op, Op::At | Op::Caret);
        if items.letters & bit != 0 && !(polar && self.choices.emulates_rs274) {
            return cursor.refuse_from(start, FaultKind::RepeatedWord, "a word occurs twice");
        }
        items.letters |= bit;
        into.ops.push(op);
        Ok(())
    }

    /// `#…=value` (11.4.3.1).
    fn setting(&mut self, cursor: &mut Cursor<'_>, into: &mut CodeSegment) -> Parsed<()> {
        let start = cursor.at();
        let place = self.parameter(cursor, into, self.bracket_depth)?;
        if !cursor.take(b'=') {
            return cursor.refuse(FaultKind::BadBlock, "a setting needs =");
        }
        self.value(cursor, into, self.bracket_depth)?;
        let read_only = "this parameter is read-only";
        into.ops.push(match place {
            ParameterRef::Numbered(number) if self.is_read_only(number) => {
                return cursor.refuse_from(start, FaultKind::ReadOnlyParameter, read_only);
            }
            ParameterRef::Numbered(number) => Op::SetNumbered(number),
            ParameterRef::Indirect => Op::SetIndirect,
            ParameterRef::Local(id) => Op::SetLocal(id),
            ParameterRef::Global(id) => Op::SetGlobal(id),
            ParameterRef::Mode(_) if planted(PlantedFault::ReadOnlyAssigned) => {
                let ParameterRef::Global(id) = self.resolve(b"_lost") else { return Ok(()) };
                Op::SetGlobal(id)
            }
            ParameterRef::Mode(_)
            | ParameterRef::Internal(_)
            | ParameterRef::Entry(_)
            | ParameterRef::Absent => {
                return cursor.refuse_from(start, FaultKind::ReadOnlyParameter, read_only);
            }
        });
        Ok(())
    }

    /// Whether a numbered parameter reports state and cannot be set by programs.
    #[inline]
    pub(crate) fn is_read_only(&self, number: u16) -> bool {
        is_machine_state(number) && !self.choices.position_writable
    }

    /// A comment; its form is checked, and the last one of a block is kept.
    fn comment<'a>(&self, cursor: &mut Cursor<'a>, items: &mut Items<'a>) -> Parsed<()> {
        if cursor.peek() == b';' {
            // Quirk rs274.semicolon-plain.
            if !self.choices.emulates_rs274 {
                items.comment = Some(cursor.raw_after());
            }
            cursor.finish();
            return Ok(());
        }
        let text = cursor.raw_after();
        let Some(length) = text.iter().position(|byte| *byte == b')') else {
            if self.choices.comment_to_line_end {
                items.comment = Some(text);
                cursor.finish();
                return Ok(());
            }
            return cursor.refuse(FaultKind::BadComment, "a comment is not closed");
        };
        let text = text.get(..length).unwrap_or(&[]);
        if let Some(semicolon) = text.iter().position(|byte| *byte == b';')
            && planted(PlantedFault::SemicolonWithin)
        {
            items.comment = text.get(semicolon.wrapping_add(1)..);
            cursor.finish();
            return Ok(());
        }
        let nested = self.choices.comment_nested || self.choices.comment_to_line_end;
        if !nested && text.contains(&b'(') {
            return cursor.refuse(FaultKind::BadComment, "a comment within a comment");
        }
        if items.comment.is_none() || !planted(PlantedFault::FirstComment) {
            items.comment = Some(text);
        }
        cursor.skip_raw(length.wrapping_add(1));
        Ok(())
    }

    /// Comments after an o-word, which change nothing.
    pub(crate) fn comments_only(&self, cursor: &mut Cursor<'_>) -> Parsed<bool> {
        let commented = self.comments(cursor)?;
        if !cursor.is_at_end() {
            return cursor.refuse(FaultKind::BadBlock, "other words on the line of an o-word");
        }
        Ok(commented)
    }

    /// Comments that come next on the line of an o-word; whether there are any.
    #[inline]
    pub(crate) fn comments(&self, cursor: &mut Cursor<'_>) -> Parsed<bool> {
        let mut items = Items { letters: 0, comment: None };
        let mut any = false;
        while let b'(' | b';' = cursor.peek() {
            self.comment(cursor, &mut items)?;
            any = true;
        }
        Ok(any)
    }

    /// `N`, an unsigned integer, and possibly a point and another (11.4.2.2). Whether it has a bound is a choice.
    fn line_number(&self, cursor: &mut Cursor<'_>) -> Parsed<()> {
        let start = cursor.at();
        let mut text = String::new();
        cursor.step();
        number::read_digits(cursor, &mut text);
        let mut complete = !text.is_empty();
        let exceeds = match self.choices.line_numbers {
            LineNumbers::Any => false,
            LineNumbers::SevenDigits => text.trim_start_matches('0').len() > LINE_NUMBER_DIGITS_MAX,
            LineNumbers::FiveDigits => text.len() > 5 || cursor.peek() == b'.',
        };
        if cursor.take(b'.') {
            complete &= !planted(PlantedFault::LineNumberPoint);
            text.clear();
            number::read_digits(cursor, &mut text);
            complete &= !text.is_empty();
        }
        if exceeds {
            let message = "a line number is too great, or has too many digits";
            return cursor.refuse_from(start, FaultKind::WordOutOfRange, message);
        }
        if complete {
            return Ok(());
        }
        cursor.refuse(FaultKind::BadNumber, "a line number is an unsigned integer")
    }
}

/// A G or M code: its number where that is known, and what takes it from the stack where it is not.
#[inline]
fn code(
    into: &mut CodeSegment,
    is_g: bool,
    known: Option<f64>,
    hundredths: bool,
) -> Result<(), &'static str> {
    into.ops.push(match (known, is_g) {
        (Some(value), true) => Op::GCode(g_number(value, hundredths).ok_or("no such G code")?),
        (Some(value), false) => Op::MCode(m_number(value, hundredths).ok_or("no such M code")?),
        (None, true) => Op::G,
        (None, false) => Op::M,
    });
    Ok(())
}

/// Whether a line is a percent sign, possibly between blanks.
pub(crate) fn is_percent(line: &[u8]) -> bool {
    let mut cursor = Cursor::new(line);
    cursor.take(b'%') && cursor.is_at_end()
}

/// Whether a line may hold an o-word: a quick look that passes over lines that are skipped.
#[inline]
pub(crate) fn is_o_word(line: &[u8]) -> bool {
    let mut cursor = Cursor::new(line);
    cursor.take(b'/');
    if cursor.take(b'n') {
        while cursor.peek().is_ascii_digit() || cursor.peek() == b'.' {
            cursor.step();
        }
    }
    matches!(cursor.peek(), b'o' | b'(')
}
