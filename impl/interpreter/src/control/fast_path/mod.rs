//! The fast path for a plain line of the main program, which runs once: its words are evaluated while they are read,
//! in one pass. The complete path is [`LineCompiler::compile_line`](crate::syntax::LineCompiler), then
//! [`Evaluator::run`](crate::control::Evaluator).
//!
//! **Invariant:** it takes only what the complete path takes, with the same outcome. Whatever is unusual (an o-word,
//! a line that is too long, an active comment, a separate digit, a new name, and everything that is refused) is left
//! alone, and the complete path starts again.

mod operand;

use alloc::vec::Vec;

use crate::block_end::BlockKind;
use crate::canon::Sink;
use crate::control::Cursor;
use crate::control::evaluate::Setting;
use crate::control::reader::first_of;
use crate::error::Error;
use crate::faults::{PlantedFault, planted};
use crate::interpret::{Interpreter, Progress};
use crate::modal::Flow;
use crate::source::Source;
use crate::syntax::{ParameterRef, read_short_prefix};
use crate::words::Words;

/// Longest line that is taken; the documents' limit is not shorter.
const BYTES_MAX: usize = 255;
/// Places of letters from A.
const G: u8 = b'g' - b'a';
const M: u8 = b'm' - b'a';
/// N and O, which are allowed at the beginning of a line only.
const ELSEWHERE: u32 = 1 << (b'n' - b'a') | 1 << (b'o' - b'a');

impl Interpreter {
    /// Fast path of `read_block` and `execute_plain`. Reads and executes a plain line of the main program; none where
    /// the next line is another one. Comments that do not act are passed over.
    #[inline]
    pub(crate) fn execute_line_fast<S: Source, K: Sink>(
        &mut self,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Option<Progress>, Error> {
        if !self.reader.is_aligned() {
            return Ok(None);
        }
        let (mut line, mut bare);
        loop {
            line = self.reader.line();
            self.words.clear(line);
            self.evaluator.clear();
            let reading = FastLine {
                values: operand::Values { parameters: &self.parameters, compiler: &self.compiler },
                words: &mut self.words,
                settings: &mut self.evaluator.settings,
            };
            let Some((length, no_words)) = reading.line(source.text()?) else { return Ok(None) };
            bare = no_words;
            self.reader.consume_line(source, length);
            if self.percent.is_none() {
                self.percent = Some(false);
            }
            if !bare || self.compiler.report_comments {
                break;
            }
        }
        self.parameters.line = line;
        let empty = self.words.is_empty();
        let first = empty || self.compiler.choices.settings_first;
        if first {
            self.evaluator.apply(&mut self.parameters);
        }
        let flow = if empty {
            if !bare {
                self.modal.execute_wordless(line, sink);
            }
            Ok(Flow::More)
        } else {
            self.modal.execute(&self.words, &mut self.parameters.numbered, sink)
        };
        if !first && flow.is_ok() {
            self.evaluator.apply(&mut self.parameters);
        }
        match flow {
            Ok(flow) => self
                .after_words((Cursor::MAIN, line), BlockKind::Words, flow, source, sink)
                .map(Some),
            Err(refusal) => self.roll_back(Cursor::MAIN, line, refusal).map(Some),
        }
    }
}

/// A line that is being read. Every method takes the text before an element and returns the text after it; none where
/// the element is unusual.
struct FastLine<'a> {
    values: operand::Values<'a>,
    words: &'a mut Words,
    settings: &'a mut Vec<Setting>,
}

impl FastLine<'_> {
    /// Fast path of `LineCompiler::items`. Reads a line; its length with its end, and whether it holds comments only.
    #[inline]
    fn line(mut self, whole: &[u8]) -> Option<(usize, bool)> {
        let mut text = whole;
        let mut bare = true;
        if let [b'n' | b'N', digits @ ..] = text {
            bare = false;
            text = line_number(digits)?;
        }
        let mut commented = false;
        loop {
            let (byte, behind) = text.split_first()?;
            let letter = (byte | 0x20).wrapping_sub(b'a');
            if matches!(byte, b' ' | b'\t') {
                text = behind;
                continue;
            }
            text = match byte {
                _ if letter < 26 => {
                    bare = false;
                    self.word(letter, behind)?
                }
                b'#' => {
                    bare = false;
                    self.setting(behind)?
                }
                b'(' | b';' => {
                    commented = true;
                    comment(*byte, behind)?
                }
                b'\n' | b'\r' if !bare || commented => break,
                _ => return None,
            };
        }
        let length = whole.len().wrapping_sub(text.len());
        let end = match text {
            [b'\r', b'\n', ..] => 2,
            [b'\r'] => return None,
            _ => 1,
        };
        (length <= BYTES_MAX).then_some((length.wrapping_add(end), bare))
    }

    /// Fast path of `LineCompiler::word`. A word, after its letter.
    #[inline]
    fn word<'t>(&mut self, letter: u8, text: &'t [u8]) -> Option<&'t [u8]> {
        let (negative, digits) = match text {
            [b'-', digits @ ..] => (true, digits),
            _ => (false, text),
        };
        let Some(number) = read_short_prefix(digits) else {
            return self.unusual_word(letter, text);
        };
        let text = digits.get(number.length..)?;
        match letter {
            G | M if negative => return None,
            G => {
                let tenths = match number.integer() {
                    Some(code) => code.wrapping_mul(10),
                    None if self.values.compiler.choices.code_hundredths => return None,
                    None => number.tenths()?,
                };
                let code = u16::try_from(tenths).ok().filter(|tenths| *tenths <= 999)?;
                let added = self.words.push_g(code);
                return added.then_some(text);
            }
            M => {
                let code = number.integer().filter(|code| !matches!(code, 98 | 99 | 1000..))?;
                let added = self.words.push_m(u16::try_from(code).ok()?);
                return added.then_some(text);
            }
            _ => {}
        }
        let value = number.value();
        self.set(letter, if negative { -value } else { value }).then_some(text)
    }

    /// A word whose value is not a short number, after its letter.
    #[inline(never)]
    fn unusual_word<'t>(&mut self, letter: u8, text: &'t [u8]) -> Option<&'t [u8]> {
        if matches!(letter, G | M) {
            return None;
        }
        let (value, text) = self.values.outermost(text)?;
        self.set(letter, value).then_some(text)
    }

    /// Sets a word; false where its letter has one already, or is not allowed there.
    #[inline]
    fn set(&mut self, letter: u8, value: f64) -> bool {
        let bit = 1_u32.wrapping_shl(u32::from(letter));
        let free = (self.words.present | ELSEWHERE) & bit == 0;
        if free {
            self.words.set(letter, value);
        }
        free
    }

    /// Fast path of `LineCompiler::setting`. `#…=value`, after the number sign.
    fn setting<'t>(&mut self, text: &'t [u8]) -> Option<&'t [u8]> {
        let depth = self.values.compiler.bracket_depth;
        let (place, text) = self.values.place(text, depth)?;
        let [b'=', text @ ..] = operand::after_blanks(text) else { return None };
        let (value, text) = self.values.outermost(text)?;
        self.settings.push(match place {
            ParameterRef::Numbered(number) if !self.values.compiler.is_read_only(number) => {
                Setting::Numbered(number, value)
            }
            ParameterRef::Local(id) => Setting::Local(id, value),
            ParameterRef::Global(id) => Setting::Global(id, value),
            ParameterRef::Numbered(_)
            | ParameterRef::Indirect
            | ParameterRef::Mode(_)
            | ParameterRef::Internal(_)
            | ParameterRef::Entry(_)
            | ParameterRef::Absent => return None,
        });
        Some(text)
    }
}

/// The text after the digits of a line number; they have no point and no blanks, and are few enough for every choice.
fn line_number(text: &[u8]) -> Option<&[u8]> {
    let digits = text.iter().position(|byte| !byte.is_ascii_digit())?;
    let behind = text.get(digits..)?;
    ((1..=5).contains(&digits) && behind.first() != Some(&b'.')).then_some(behind)
}

/// The text after a plain comment. One that begins like the name of an active one is not looked at any further.
fn comment(begin: u8, text: &[u8]) -> Option<&[u8]> {
    let mut letters = text.iter().filter(|byte| **byte > b' ').map(|byte| byte | 0x20);
    match letters.next()? {
        b'm' | b'd' | b'p' | b'l' | b'a' => match (letters.next()?, letters.next()?) {
            (b's', b'g') | (b'e', b'b') | (b'r', b'i' | b'o') | (b'o', b'g') | (b'b', b'o') => {
                return None;
            }
            _ => {}
        },
        _ => {}
    }
    if begin == b';' {
        return text.get(first_of([b'\n', b'\r'], text)?..);
    }
    let end = first_of([b'(', b')', b'\n', b'\r'], text)?;
    if planted(PlantedFault::SemicolonWithin) && text.get(..end)?.contains(&b';') {
        return None;
    }
    match text.get(end..)? {
        [b')', behind @ ..] => Some(behind),
        _ => None,
    }
}
