//! O-words: a label, a keyword, values in brackets.

use gaugeblock_vocabulary::FaultKind;

use super::parser::Parser;
use super::value::Wanted;
use super::{Expression, Keyword, Label, OWord};
use crate::ids::rule;
use crate::rs274::refusal::StepError;

/// `elseif` precedes `else`, which is a prefix of it.
const KEYWORDS: [(&str, Keyword); 15] = [
    ("sub", Keyword::Sub),
    ("endsub", Keyword::EndSub),
    ("call", Keyword::Call),
    ("return", Keyword::Return),
    ("if", Keyword::If),
    ("elseif", Keyword::ElseIf),
    ("else", Keyword::Else),
    ("endif", Keyword::EndIf),
    ("while", Keyword::While),
    ("endwhile", Keyword::EndWhile),
    ("do", Keyword::Do),
    ("repeat", Keyword::Repeat),
    ("endrepeat", Keyword::EndRepeat),
    ("break", Keyword::Break),
    ("continue", Keyword::Continue),
];

impl Parser<'_> {
    /// An O-word and the end of its line.
    ///
    /// Rule control.unrelated-words. Other words on the line of an O-word are refused.
    /// Rule control.comment-after. Comments may separate the values of a call.
    pub(super) fn o_word(&mut self) -> Result<OWord, StepError> {
        let start = self.place();
        let mut o_word = self.label_and_keyword()?;
        self.comments_of_call(&o_word);
        while self.peek() == Some('[') && o_word.arguments.len() < most_arguments(o_word.keyword) {
            o_word.arguments.push(self.bracketed()?);
            self.comments_of_call(&o_word);
        }
        if o_word.arguments.len() < fewest_arguments(o_word.keyword) {
            let message = "a value in brackets is missing after the keyword";
            return Err(self.refuse(
                rule::expressions::INCOMPLETE,
                FaultKind::BadExpression,
                message,
            ));
        }
        o_word.span = self.span_from(start);
        if o_word.keyword == Keyword::Call && !o_word.arguments.is_empty() {
            self.reach(rule::subroutines::ARGUMENTS_IN_BRACKETS);
        }
        self.comments();
        match self.peek() {
            None => Ok(o_word),
            Some('0'..='9' | '#' | '.' | '+' | '-') if o_word.keyword == Keyword::Call => {
                let message = "an argument without brackets";
                Err(self.refuse(
                    rule::subroutines::ARGUMENTS_IN_BRACKETS,
                    FaultKind::BadBlock,
                    message,
                ))
            }
            Some(_) => {
                let message = "other words on the line of an O-word";
                Err(self.refuse(rule::control::UNRELATED_WORDS, FaultKind::BadBlock, message))
            }
        }
    }

    /// Skips the comments around a value of a call.
    fn comments_of_call(&mut self, o_word: &OWord) {
        if o_word.keyword == Keyword::Call {
            self.comments();
        }
    }

    /// The O-word with which a line begins, as far as it can be read; what stands behind its keyword only where it
    /// matters or is asked for.
    pub(super) fn leading_o_word(&mut self, with_arguments: bool) -> Option<OWord> {
        self.block_delete();
        self.line_number().ok()?;
        if self.is_led_by_comment() {
            return None;
        }
        self.comments();
        if self.peek() != Some('o') {
            return None;
        }
        let start = self.place();
        let mut o_word = self.label_and_keyword().ok()?;
        if o_word.keyword == Keyword::ProgramNumber {
            // With anything else it is a line that is refused, and no program begins there.
            self.comments();
            o_word.span = self.span_from(start);
            return self.peek().is_none().then_some(o_word);
        }
        while with_arguments && self.peek() == Some('[') {
            let Ok(argument) = self.bracketed() else { break };
            o_word.arguments.push(argument);
        }
        o_word.span = self.span_from(start);
        Some(o_word)
    }

    /// Rule subroutines.numbered-o-words, subroutines.named-o-words, subroutines.computed-o-words: what stands behind
    /// the letter O is a number, perhaps computed, or a name in angle brackets.
    pub(crate) fn label(&mut self) -> Result<Label, StepError> {
        self.advance();
        Ok(if self.peek() == Some('<') {
            Label::Name(self.name()?)
        } else {
            Label::Number(self.value(Wanted::Label)?)
        })
    }

    /// A label with its keyword.
    fn label_and_keyword(&mut self) -> Result<OWord, StepError> {
        let start = self.place();
        let label = self.label()?;
        self.keyword(label, start)
    }

    /// The keyword after a label. A number without a keyword is that of a program.
    pub(crate) fn keyword(&mut self, label: Label, start: usize) -> Result<OWord, StepError> {
        let keyword = match KEYWORDS.iter().find(|(spelling, _)| self.sees(spelling)) {
            Some((spelling, keyword)) => {
                self.take(spelling);
                *keyword
            }
            None if matches!(label, Label::Number(_)) => Keyword::ProgramNumber,
            None => {
                let message = "an O-word with a name has a keyword, which does not begin";
                return Err(self.refuse(
                    rule::control::UNRELATED_WORDS,
                    FaultKind::BadBlock,
                    message,
                ));
            }
        };
        Ok(OWord {
            label,
            keyword,
            arguments: Vec::<Expression>::new(),
            span: self.span_from(start),
        })
    }
}

/// How many values in brackets a keyword needs.
fn fewest_arguments(keyword: Keyword) -> usize {
    match keyword {
        Keyword::If | Keyword::ElseIf | Keyword::While | Keyword::Repeat => 1,
        Keyword::Sub
        | Keyword::EndSub
        | Keyword::Call
        | Keyword::Return
        | Keyword::Else
        | Keyword::EndIf
        | Keyword::EndWhile
        | Keyword::Do
        | Keyword::EndRepeat
        | Keyword::Break
        | Keyword::Continue
        | Keyword::ProgramNumber => 0,
    }
}

/// How many values in brackets a keyword takes; how many a call may pass is a rule of calls.
fn most_arguments(keyword: Keyword) -> usize {
    match keyword {
        Keyword::Call => usize::MAX,
        Keyword::EndSub | Keyword::Return => 1,
        Keyword::If
        | Keyword::Sub
        | Keyword::ElseIf
        | Keyword::While
        | Keyword::Repeat
        | Keyword::Else
        | Keyword::EndIf
        | Keyword::EndWhile
        | Keyword::Do
        | Keyword::EndRepeat
        | Keyword::Break
        | Keyword::Continue
        | Keyword::ProgramNumber => fewest_arguments(keyword),
    }
}
