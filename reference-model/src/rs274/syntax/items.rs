//! Block delete, line number, words, settings, comments: the items of a line.

use std::borrow::Cow;

use gaugeblock_vocabulary::FaultKind;

use super::parser::Parser;
use super::value::Wanted;
use super::{Block, Comment, Setting, Word};
use crate::Choices;
use crate::ids::{choice, rule};
use crate::rs274::refusal::StepError;
use crate::rs274::text::Glyph;

/// Rule text.word-letters. The letters of the table begin words; no other letter does.
///
/// E belongs to M66 to M68 (see `evaluate`); `$` is a spindle, `@` and `^` are polar coordinates.
fn begins_word(letter: char) -> bool {
    matches!(letter, 'a'..='m' | 'p'..='z' | '$' | '@' | '^')
}

const AXIS_LETTERS: &str = "xyzabcuvw";

/// The greatest line number, where there is one.
const GREATEST_LINE_NUMBER: f64 = 9_999_999.0;

/// How the items of a line are read.
pub(crate) trait SyntaxRules {
    /// Rule text.item-order. Comments may occur anywhere in a line, before an O-word too: what follows those at its
    /// beginning is checked here.
    fn check_after_comment(&self, _parser: &Parser<'_>) -> Result<(), StepError> {
        Ok(())
    }

    /// Rule text.item-order. Whether an O-word may follow a comment at the beginning of a line.
    fn o_word_may_follow_comment(&self, _choices: &Choices) -> bool {
        true
    }

    /// Choice text.greatest-line-number. Whether a line number is above the greatest: it is if above 9,999,999.
    fn is_above_greatest_line_number(&self, number: f64, _choices: &Choices) -> bool {
        number > GREATEST_LINE_NUMBER
    }

    /// Choice text.greatest-line-number. Whether a line number has more than five digits.
    fn has_too_many_digits(&self, digits: &str, _choices: &Choices) -> bool {
        digits.len() > 5
    }

    /// Rule active-comments.last-comment. Of several comments on a line only the last can be active.
    /// Rule active-comments.semicolon. A semicolon comment is the last of its line and may be active.
    fn active_comment(&self, mut comments: Vec<Comment>, _choices: &Choices) -> Option<Comment> {
        comments.pop()
    }

    /// Rule numbers.many-digits. The digits of a number that count: all, as far as a double holds them.
    fn digits_that_count<'t>(&self, digits: &'t str, _choices: &Choices) -> Cow<'t, str> {
        Cow::Borrowed(digits)
    }

    /// Rule numbers.form. Whether a number may have a second sign: it is refused.
    fn second_sign_is_allowed(&self, _choices: &Choices) -> bool {
        false
    }

    /// Rule parameters.name-marks. Whether there may be nothing between < and >: it is refused.
    fn empty_name_is_allowed(&self, _choices: &Choices) -> bool {
        false
    }

    /// Rule expressions.exists-argument. Whether EXISTS takes a numbered parameter: it is refused.
    fn exists_takes_numbered(&self, _choices: &Choices) -> bool {
        false
    }
}

impl Parser<'_> {
    /// A whole block. Its order is: slash, line number, then an O-word or words, settings and comments.
    pub(super) fn block(&mut self, comments: Vec<Comment>) -> Result<Block, StepError> {
        let mut block = Block { block_delete: self.block_delete(), ..Block::default() };
        block.line_number = self.line_number()?;
        let led = self.peek() == Some(Glyph::COMMENT);
        self.comments();
        if led {
            self.choices.dialect().check_after_comment(self)?;
        }
        if self.peek() == Some('o') {
            block.o_word = Some(self.o_word()?);
        } else {
            self.items(&mut block)?;
        }
        if comments.len() > 1 {
            self.reach(rule::active_comments::LAST_COMMENT);
        }
        block.comment = self.choices.dialect().active_comment(comments, self.choices);
        if block.comment.as_ref().is_some_and(|comment| comment.semicolon) {
            self.reach(rule::active_comments::SEMICOLON);
        }
        self.reach_items(&block);
        Ok(block)
    }

    /// Rule text.block-delete-off. While block delete is off, a line that begins with a slash is executed like any
    /// other.
    pub(crate) fn block_delete(&mut self) -> bool {
        let slash = self.take("/");
        if slash {
            self.reach(rule::text::BLOCK_DELETE_OFF);
            self.fail(rule::text::BLOCK_DELETE_OFF);
            self.reach(rule::text::BLOCK_DELETE_PLACE);
        }
        slash
    }

    /// Rule text.line-number. A line number is N and an unsigned integer, and may go on with a period and another
    /// unsigned integer.
    /// Rule text.line-number-form. One with a sign, without digits on either side of its period, or computed, is
    /// refused.
    /// Rule text.greatest-line-number. Whether one above 9,999,999 is refused is a choice.
    pub(crate) fn line_number(&mut self) -> Result<Option<String>, StepError> {
        if !self.take("n") {
            return Ok(None);
        }
        let wrong = |parser: &Self| {
            Err(parser.refuse(
                rule::text::LINE_NUMBER_FORM,
                FaultKind::BadNumber,
                "a line number has digits only; unexpected text",
            ))
        };
        let mut number = self.take_while(|character| character.is_ascii_digit());
        if number.is_empty() {
            return wrong(self);
        }
        self.check_digits(&number)?;
        if self.take(".") {
            let second = self.take_while(|character| character.is_ascii_digit());
            if second.is_empty() || self.peek() == Some('.') {
                return wrong(self);
            }
            number = format!("{number}.{second}");
        }
        let is_bounded = self.choices.is(choice::text::GreatestLineNumber::SevenDigits);
        let dialect = self.choices.dialect();
        let is_above = |number: f64| dialect.is_above_greatest_line_number(number, self.choices);
        if is_bounded && number.parse::<f64>().is_ok_and(is_above) {
            let message = "a line number above 9999999 ends";
            return Err(self.refuse(
                rule::text::GREATEST_LINE_NUMBER,
                FaultKind::WordOutOfRange,
                message,
            ));
        }
        self.reach(rule::text::GREATEST_LINE_NUMBER);
        self.reach(rule::text::LINE_NUMBER);
        self.reach(rule::text::LINE_NUMBER_ORDER);
        Ok(Some(number))
    }

    /// Rule text.greatest-line-number. By a choice a line number has five digits at most, and no second number.
    fn check_digits(&mut self, digits: &str) -> Result<(), StepError> {
        let is_five_digits = self.choices.is(choice::text::GreatestLineNumber::FiveDigits);
        let dialect = self.choices.dialect();
        let is_too_long = || dialect.has_too_many_digits(digits, self.choices);
        if is_five_digits && (is_too_long() || self.peek() == Some('.')) {
            return Err(self.refuse(
                rule::text::GREATEST_LINE_NUMBER,
                FaultKind::WordOutOfRange,
                "a line number has one to five digits; more of it ends",
            ));
        }
        Ok(())
    }

    /// Skips comments.
    pub(crate) fn comments(&mut self) {
        while self.peek() == Some(Glyph::COMMENT) {
            self.advance();
        }
    }

    /// Whether a comment comes next that no O-word may follow.
    pub(crate) fn is_led_by_comment(&self) -> bool {
        self.peek() == Some(Glyph::COMMENT)
            && !self.choices.dialect().o_word_may_follow_comment(self.choices)
    }

    /// Rule text.items-optional. A line needs neither words nor settings.
    fn items(&mut self, block: &mut Block) -> Result<(), StepError> {
        while let Some(next) = self.peek() {
            match next {
                Glyph::COMMENT => self.advance(),
                '#' => block.settings.push(self.setting()?),
                letter if begins_word(letter) => block.words.push(self.word(letter)?),
                _ => return Err(self.misplaced(next)),
            }
        }
        Ok(())
    }

    /// Rule text.word-value. A word is a letter and a number, or something that evaluates to a number.
    /// Rule motion.axis-without-value. An axis letter without a number is refused.
    fn word(&mut self, letter: char) -> Result<Word, StepError> {
        let start = self.place();
        self.advance();
        let value = self.value(Wanted::Word(letter));
        if value.is_err() {
            let stopped = self.place();
            self.go_back(start);
            if self.follows_value() && self.operator().is_some() {
                return Err(self.operator_outside());
            }
            self.go_back(stopped);
        }
        if value.is_err() && AXIS_LETTERS.contains(letter) {
            self.fail(rule::motion::AXIS_WITHOUT_VALUE);
        }
        Ok(Word { letter, value: value?, span: self.span_from(start) })
    }

    /// Rule parameters.assignment. The equals sign stores the number on its right in the parameter on its left.
    /// Rule parameters.assignment-form. A parameter alone, or a setting without a value, is refused.
    fn setting(&mut self) -> Result<Setting, StepError> {
        let start = self.place();
        let target = self.parameter()?;
        if !self.take("=") {
            let message = "a parameter alone: an equals sign is missing";
            return Err(self.refuse(
                rule::parameters::ASSIGNMENT_FORM,
                FaultKind::BadBlock,
                message,
            ));
        }
        let value = self.value(Wanted::Setting)?;
        Ok(Setting { target, value, span: self.span_from(start) })
    }

    /// Rule text.illegal-item. What is neither a word, a parameter setting nor a comment is refused.
    /// Rule text.illegal-input. Characters that no rule allows are refused.
    ///
    /// Other rules say more of what stands where an item should stand.
    fn misplaced(&self, next: char) -> StepError {
        let follows = self.follows_value();
        let ends = matches!(self.peek_after(1), None | Some(Glyph::COMMENT));
        let (rule, kind, message) = match next {
            '%' => (
                rule::text::PERCENT_LINE,
                FaultKind::BadCharacter,
                "a percent sign together with other text",
            ),
            'o' => (
                rule::control::UNRELATED_WORDS,
                FaultKind::BadBlock,
                "other words before an O-word",
            ),
            'n' => (
                rule::text::LINE_NUMBER_PLACE,
                FaultKind::BadBlock,
                "a line number that is not first",
            ),
            '.' => {
                (rule::numbers::FORM, FaultKind::BadNumber, "a number has a second decimal point")
            }
            '+' | '-' if follows && ends => {
                (rule::numbers::FORM, FaultKind::BadNumber, "a sign after its number")
            }
            '+' | '-' | '*' if follows => return self.operator_outside(),
            '/' if follows
                && self.peek_after(1).is_some_and(|next| "#[.0123456789".contains(next)) =>
            {
                return self.operator_outside();
            }
            '/' => {
                (rule::text::BLOCK_DELETE_PLACE, FaultKind::BadBlock, "a slash that is not first")
            }
            ']' => {
                (rule::expressions::UNBALANCED, FaultKind::BadExpression, "no bracket was opened")
            }
            '[' | '=' | '<' | '>' | '+' | '-' | '*' | '0'..='9' => (
                rule::text::ILLEGAL_ITEM,
                FaultKind::BadBlock,
                "no word, setting or comment begins",
            ),
            '_' => (rule::text::WORD_LETTERS, FaultKind::BadCharacter, "no word begins"),
            _ => (
                rule::text::ILLEGAL_INPUT,
                FaultKind::BadCharacter,
                "a character that is not allowed",
            ),
        };
        self.refuse(rule, kind, message)
    }

    /// Whether a value ends before the next character.
    fn follows_value(&self) -> bool {
        self.last()
            .is_some_and(|last| last.is_ascii_digit() || last == ']' || last == '>' || last == '.')
    }

    /// Rule expressions.operators-in-brackets. Binary operators occur inside expressions only.
    fn operator_outside(&self) -> StepError {
        let message = "an operator outside of brackets";
        self.refuse(rule::expressions::OPERATORS_IN_BRACKETS, FaultKind::BadExpression, message)
    }

    fn reach_items(&mut self, block: &Block) {
        if !block.words.is_empty() {
            self.reach(rule::text::WORD_LETTERS);
            self.reach(rule::text::WORD_VALUE);
        }
        if block.words.is_empty() && block.settings.is_empty() && block.o_word.is_none() {
            self.reach(rule::text::ITEMS_OPTIONAL);
        }
        if !block.words.is_empty() && !block.settings.is_empty() {
            self.reach(rule::text::ITEM_ORDER);
            self.reach(rule::parameters::SETTING_ORDER);
        }
        if !block.settings.is_empty() {
            self.reach(rule::parameters::ASSIGNMENT);
            self.reach(rule::parameters::SETTING_LAST);
        }
    }
}
