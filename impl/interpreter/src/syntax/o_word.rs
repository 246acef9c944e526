//! O-words (11.7): a label, a keyword, and values in brackets.

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::parameters::NameId;
use crate::syntax::bytecode::{Block, CodeSegment, Keyword, Kind, NONE, OWord, Op};
use crate::syntax::compiler::LineCompiler;
use crate::syntax::cursor::Cursor;
use crate::syntax::{Parsed, arithmetic, number};

/// Most arguments of a call (11.7.4).
const ARGUMENTS: u8 = 30;

/// The keywords, the longer of two that begin alike first.
const KEYWORDS: [(&[u8], Keyword); 15] = [
    (b"sub", Keyword::Sub),
    (b"endsub", Keyword::EndSub),
    (b"return", Keyword::Return),
    (b"repeat", Keyword::Repeat),
    (b"call", Keyword::Call),
    (b"continue", Keyword::Continue),
    (b"if", Keyword::If),
    (b"elseif", Keyword::ElseIf),
    (b"else", Keyword::Else),
    (b"endif", Keyword::EndIf),
    (b"endwhile", Keyword::EndWhile),
    (b"endrepeat", Keyword::EndRepeat),
    (b"while", Keyword::While),
    (b"do", Keyword::Do),
    (b"break", Keyword::Break),
];

impl LineCompiler {
    /// An o-word and everything after it. The block has the label and the keyword even where the rest is refused, so
    /// that a search for them ends here.
    pub(crate) fn o_word(
        &mut self,
        cursor: &mut Cursor<'_>,
        commented: bool,
        block: &mut Block,
        into: &mut CodeSegment,
    ) -> Parsed<()> {
        let start = cursor.at();
        cursor.step();
        let named = cursor.peek() == b'<';
        let label = self.label(cursor, into)?;
        let mut o_word = OWord { keyword: Keyword::Unknown, label, values: 0, next: NONE };
        if label == NONE {
            into.computed = true;
            o_word.next = u32::try_from(into.ops.len()).unwrap_or(NONE);
        }
        o_word.keyword = keyword(cursor);
        block.kind = Kind::Control(o_word);
        if o_word.keyword == Keyword::Unknown {
            if named && !self.choices.emulates_rs274 || !matches!(cursor.peek(), 0 | b'(' | b';') {
                return cursor.refuse_from(start, FaultKind::BadBlock, "no such o-word");
            }
            o_word.keyword = Keyword::Program;
        }
        let between = self.values(cursor, &mut o_word, into)?;
        block.kind = Kind::Control(o_word);
        let ignores = o_word.keyword == Keyword::Else && planted(PlantedFault::WordsBehindElse);
        if ignores && !matches!(cursor.peek(), b'(' | b';') {
            cursor.finish();
        }
        let behind = self.comments_only(cursor)?;
        let commented = commented || between || behind;
        if commented && self.choices.oword_comment_refused && o_word.keyword != Keyword::Program {
            return cursor.refuse(FaultKind::BadComment, "a comment on the line of an o-word");
        }
        Ok(())
    }

    /// A number, a name in angle brackets, or what is computed (11.7.8): a parameter, an expression or a function of
    /// one, whose operations are emitted.
    fn label(&mut self, cursor: &mut Cursor<'_>, into: &mut CodeSegment) -> Parsed<NameId> {
        let mut text = core::mem::take(&mut self.scratch);
        text.clear();
        let first = into.ops.len();
        let start = *cursor;
        self.in_label = true;
        let result = match cursor.peek() {
            b'0'..=b'9' => {
                number::read_digits(cursor, &mut text);
                // A number of more digits than a float distinguishes is the nearest one.
                if cursor.peek() == b'.' || text.trim_start_matches('0').len() > 15 {
                    *cursor = start;
                    self.value(cursor, into, self.bracket_depth).map(|()| NONE)
                } else {
                    Ok(self.number_label(&text))
                }
            }
            b'.' | b'+' | b'-' | b'#' | b'a'..=b'z' => {
                self.value(cursor, into, self.bracket_depth).map(|()| NONE)
            }
            b'<' => self.read_name(cursor, &mut text).map(|()| self.labels.intern(text.as_bytes())),
            b'[' => self.expression(cursor, into, self.bracket_depth).map(|()| NONE),
            _ => cursor.refuse(FaultKind::BadBlock, "a label is missing"),
        };
        self.in_label = false;
        self.scratch = text;
        match result? {
            NONE => self.constant_label(&start, cursor, first, into),
            label => Ok(label),
        }
    }

    /// The label of operations without parameters: it is known before anything is executed. Other labels are computed
    /// then.
    fn constant_label(
        &mut self,
        start: &Cursor<'_>,
        cursor: &Cursor<'_>,
        first: usize,
        into: &mut CodeSegment,
    ) -> Parsed<NameId> {
        let ops = into.ops.get(first..).unwrap_or(&[]);
        let Some(value) = arithmetic::constant(ops, &self.choices) else { return Ok(NONE) };
        let value = match value {
            Ok(value) => value,
            Err((kind, message)) => return cursor.refuse_from(start.at(), *kind, message),
        };
        let Some(label) = self.computed_label(value) else {
            let message = "an o-number is an integer";
            return cursor.refuse_from(start.at(), FaultKind::NotAnInteger, message);
        };
        into.ops.truncate(first);
        Ok(label)
    }

    /// The label that is written as digits; leading zeros mean nothing.
    pub(crate) fn number_label(&mut self, digits: &str) -> NameId {
        if planted(PlantedFault::LabelWraps) {
            let number = digits.parse::<u64>().unwrap_or(0) & 0xffff;
            return self.labels.intern(alloc::format!("{number}").as_bytes());
        }
        let digits = digits.trim_start_matches('0');
        self.labels.intern(if digits.is_empty() { b"0" } else { digits.as_bytes() })
    }

    /// The label that a computed number is; none where it is not an integer. No document bounds it.
    pub(crate) fn computed_label(&mut self, value: f64) -> Option<NameId> {
        match math::near_integer(value) {
            Some(number) => Some(self.label_of(format_args!("{number}"))),
            // There are no other numbers so far away; all their digits are written.
            None if value.is_finite() && value.abs() > 9.0e15 => {
                Some(self.label_of(format_args!("{value:.0}")))
            }
            None => None,
        }
    }

    /// The label that an integer is.
    pub(crate) fn label_of(&mut self, number: core::fmt::Arguments<'_>) -> NameId {
        use core::fmt::Write as _;
        let mut text = core::mem::take(&mut self.scratch);
        text.clear();
        // Writing into a text cannot fail.
        let label = match text.write_fmt(number) {
            Ok(()) => self.labels.intern(text.as_bytes()),
            Err(core::fmt::Error) => NONE,
        };
        self.scratch = text;
        label
    }

    /// The values that the keyword takes; comments are allowed between those of a call, as between words (11.4.23).
    /// Whether there are any.
    fn values(
        &mut self,
        cursor: &mut Cursor<'_>,
        o_word: &mut OWord,
        into: &mut CodeSegment,
    ) -> Parsed<bool> {
        let (least, most) = match o_word.keyword {
            Keyword::If | Keyword::ElseIf | Keyword::While | Keyword::Repeat => (1, 1),
            Keyword::EndSub | Keyword::Return => (0, 1),
            Keyword::Call => (0, ARGUMENTS),
            Keyword::Sub
            | Keyword::Else
            | Keyword::EndIf
            | Keyword::EndWhile
            | Keyword::Do
            | Keyword::EndRepeat
            | Keyword::Break
            | Keyword::Continue
            | Keyword::Program
            | Keyword::Unknown => (0, 0),
        };
        let calls = o_word.keyword == Keyword::Call;
        let mut commented = calls && self.comments(cursor)?;
        while cursor.peek() == b'[' {
            if o_word.values == most {
                if calls {
                    return cursor.refuse(FaultKind::TooManyArguments, "a call takes 30 arguments");
                }
                return cursor.refuse(FaultKind::BadBlock, "one value too many");
            }
            self.expression(cursor, into, self.bracket_depth)?;
            o_word.values = o_word.values.wrapping_add(1);
            commented |= calls && self.comments(cursor)?;
        }
        if o_word.values < least {
            return cursor.refuse(FaultKind::BadExpression, "an expression is missing");
        }
        Ok(commented)
    }
}

/// The keyword of an o-word.
fn keyword(cursor: &mut Cursor<'_>) -> Keyword {
    KEYWORDS
        .iter()
        .find(|(word, _)| cursor.take_word(word))
        .map_or(Keyword::Unknown, |(_, keyword)| *keyword)
}

/// Where the operations of a computed label end.
pub(crate) fn label_ops<'a>(segment: &'a CodeSegment, block: &Block, o_word: OWord) -> &'a [Op] {
    let first = usize::try_from(block.first).unwrap_or(usize::MAX);
    let end = usize::try_from(o_word.next).unwrap_or(usize::MAX);
    segment.ops.get(first..end).unwrap_or(&[])
}
