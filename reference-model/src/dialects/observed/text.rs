//! Quirks of reading text and lines.

use std::borrow::Cow;

use gaugeblock_vocabulary::FaultKind;

use super::{HasQuirk, Observed};
use crate::Choices;
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::word;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Comment, Parser, SyntaxRules};
use crate::rs274::text::{Line, Source, TextRules, within};
use crate::rs274::{check, evaluate, syntax};

impl TextRules for Observed {
    /// Quirk rs274.shorter-lines. A line has at most 252 bytes without its line end.
    /// Quirk nist.shorter-lines. A line has at most 253 bytes without its line end.
    fn check_line_length(&self, line: &str, choices: &Choices) -> Result<(), StepError> {
        if choices.has_quirk(quirk::nist::SHORTER_LINES) {
            return within(253, line.len());
        }
        if choices.has_quirk(quirk::rs274::SHORTER_LINES) {
            return within(252, line.len());
        }
        Documented.check_line_length(line, choices)
    }

    /// Quirk rs274.lone-return. A carriage return alone does not end a line.
    fn with_line_feeds(&self, text: &str, choices: &Choices) -> String {
        if choices.has_quirk(quirk::rs274::LONE_RETURN) {
            return text.replace("\r\n", "\n");
        }
        Documented.with_line_feeds(text, choices)
    }

    /// Quirk rs274.percent-in-file. If the main program has no percent lines, those of a called file have no meaning.
    fn percent_line<'a>(&self, line: &'a str, source: &Source, state: &mut State) -> Line<'a> {
        if source.memory.ignores_percent {
            return Line::Block(line);
        }
        Documented.percent_line(line, source, state)
    }

    /// Quirk nist.skipped-line-is-read. A line that block delete skips is read and checked. NIST's language has no
    /// O-words.
    fn pass_over_skipped(&self, text: &str, state: &mut State) -> Result<(), StepError> {
        let quirk = quirk::nist::SKIPPED_LINE_IS_READ;
        if !state.has_quirk(quirk) {
            return Documented.pass_over_skipped(text, state);
        }
        let block = syntax::parse(text, state)?;
        if block.o_word.is_some() {
            return Err(refuse(quirk, FaultKind::BadCharacter, "an O-word in a skipped line"));
        }
        let words = evaluate::words(&block, state)?;
        check::check(&words, state)?;
        if let Some(message) = incomplete(&words) {
            return Err(refuse(quirk, FaultKind::MissingWord, message));
        }
        Ok(())
    }

    /// Quirk rs274.percent-in-file. If the main program begins with a percent line, the first percent line of a called
    /// file ends that file.
    fn begin_called_file(&self, called: &mut Source, main: &Source, choices: &Choices) {
        if !choices.has_quirk(quirk::rs274::PERCENT_IN_FILE) {
            return Documented.begin_called_file(called, main, choices);
        }
        called.first = 0;
        called.percent = main.percent;
        called.memory.ignores_percent = !main.percent;
    }
}

/// Quirk nist.skipped-line-is-read. What a code of a line that is not executed lacks.
fn incomplete(words: &Words) -> Option<&'static str> {
    let has = |wanted: &[u32]| words.g_tenths.iter().any(|code| wanted.contains(code));
    let is_system = |number: f64| (1.0..=9.0).contains(&number) && number.fract() == 0.0;
    let sets_system = word(words, 'l') == Some(2.0) && word(words, 'p').is_some_and(is_system);
    let moves = has(&[0, 10, 20, 30, 810, 820, 830, 840, 850, 860, 870, 880, 890]);
    if has(&[100]) && !sets_system {
        Some("G10 without L2 and a P from 1 to 9 in a skipped line")
    } else if (moves || has(&[920])) && !has_axis_words(words) {
        Some("a code without an axis word in a skipped line")
    } else {
        None
    }
}

/// Of a number without a sign eight digits, whether or not zeros before the first other digit are among them. Further
/// ones before the decimal point become zeros: the eight are multiplied by ten for each, in single precision.
fn eight_digits(number: &str, after_zeros: bool) -> String {
    let (mut kept, mut count, mut zeros, mut is_fraction) = (String::new(), 0, 0, false);
    for digit in number.chars() {
        is_fraction |= digit == '.';
        if digit.is_ascii_digit() && (count > 0 || digit != '0' || !after_zeros) {
            count += 1;
        }
        if count <= 8 || digit == '.' {
            kept.push(digit);
        } else if !is_fraction {
            zeros += 1;
        }
    }
    match kept.parse() {
        Ok(eight) if zeros > 0 => {
            (0..zeros).fold(eight, |number: f32, _| number * 10.0).to_string()
        }
        _ => kept,
    }
}

impl SyntaxRules for Observed {
    /// Quirk grbl.line-number-limit. The greatest is 10,000,000, and what 32 bits do not hold is not above it.
    /// Quirk grblhal.line-number-limit. The greatest line number is 10,000,000.
    fn is_above_greatest_line_number(&self, number: f64, choices: &Choices) -> bool {
        if choices.has_quirk(quirk::grblhal::LINE_NUMBER_LIMIT) {
            return number >= 10_000_001.0;
        }
        if choices.has_quirk(quirk::grbl::LINE_NUMBER_LIMIT) {
            return number >= 10_000_001.0 && number <= f64::from(u32::MAX);
        }
        Documented.is_above_greatest_line_number(number, choices)
    }

    /// Quirk nist.five-digits. A number above 99999 has too many digits; leading zeros do not count. Of the number, 64
    /// bits are read and 32 kept, with a sign.
    fn has_too_many_digits(&self, digits: &str, choices: &Choices) -> bool {
        if choices.has_quirk(quirk::nist::FIVE_DIGITS) {
            let [a, b, c, d, ..] = digits.parse().unwrap_or(i64::MAX).to_le_bytes();
            return i32::from_le_bytes([a, b, c, d]) > 99_999;
        }
        Documented.has_too_many_digits(digits, choices)
    }

    /// Quirk rs274.comment-before-o-word. A comment at the beginning of a block is followed by neither an O-word nor
    /// M98.
    fn check_after_comment(&self, parser: &Parser<'_>) -> Result<(), StepError> {
        if !parser.choices.has_quirk(quirk::rs274::COMMENT_BEFORE_O_WORD) {
            return Documented.check_after_comment(parser);
        }
        let is_number = |next: char| next.is_numeric();
        let calls = parser.sees("m98") && !parser.peek_after(3).is_some_and(is_number);
        let (kind, message) = match parser.peek() {
            Some('o') => (FaultKind::BadCharacter, "an O-word after a comment"),
            Some('m') if calls => (FaultKind::UnknownCode, "M98 after a comment"),
            _ => return Ok(()),
        };
        Err(parser.refuse(quirk::rs274::COMMENT_BEFORE_O_WORD, kind, message))
    }

    /// Quirk rs274.comment-before-o-word. An O-word after a comment is refused.
    fn o_word_may_follow_comment(&self, choices: &Choices) -> bool {
        !choices.has_quirk(quirk::rs274::COMMENT_BEFORE_O_WORD)
    }

    /// Quirk rs274.semicolon-plain. Only the last comment in parentheses can be active. A semicolon comment is never
    /// active, and does not make an active comment before it inactive.
    fn active_comment(&self, comments: Vec<Comment>, choices: &Choices) -> Option<Comment> {
        if choices.has_quirk(quirk::rs274::SEMICOLON_PLAIN) {
            return comments.into_iter().rfind(|comment| !comment.semicolon);
        }
        Documented.active_comment(comments, choices)
    }

    /// Quirk grbl.eight-digits. Eight count, zeros before them too.
    /// Quirk grblhal.eight-digits. Eight count, without zeros before the first other digit.
    fn digits_that_count<'t>(&self, digits: &'t str, choices: &Choices) -> Cow<'t, str> {
        let leading = choices.has_quirk(quirk::grblhal::EIGHT_DIGITS);
        if leading || choices.has_quirk(quirk::grbl::EIGHT_DIGITS) {
            return Cow::Owned(eight_digits(digits, leading));
        }
        Documented.digits_that_count(digits, choices)
    }

    /// Quirk rs274.repeated-signs. A number may have any number of signs; each further minus sign negates.
    fn second_sign_is_allowed(&self, choices: &Choices) -> bool {
        choices.has_quirk(quirk::rs274::REPEATED_SIGNS)
    }

    /// Quirk rs274.empty-name. A named parameter may have no name.
    fn empty_name_is_allowed(&self, choices: &Choices) -> bool {
        choices.has_quirk(quirk::rs274::EMPTY_NAME)
    }

    /// Quirk rs274.exists-numbered. EXISTS of a numbered parameter is accepted.
    fn exists_takes_numbered(&self, choices: &Choices) -> bool {
        choices.has_quirk(quirk::rs274::EXISTS_NUMBERED)
    }
}
