//! A block's expressions evaluated: numbers for words.

mod codes;
mod expression;
mod operate;
#[cfg(test)]
mod tests;
mod words;

use gaugeblock_vocabulary::{Axis, FaultKind};

use super::parameters::{self, Name};
use super::refusal::{StepError, refuse_at};
use super::state::State;
use super::syntax::{Block, Expression, Setting, Word};
use crate::Choices;
use crate::ids::rule;
use crate::math;
pub use expression::value_of;
pub use words::Words;

/// Evaluates a block, from left to right.
///
/// Rule expressions.read-before-execution. The expressions of a line are evaluated when it is read, before anything on
/// it is executed.
/// Rule parameters.setting-last. A setting takes effect after all parameter values on its line have been found: here
/// nothing is assigned yet.
///
/// # Errors
/// An expression has no value, or a word's value is not allowed.
pub fn words(block: &Block, state: &mut State) -> Result<Words, StepError> {
    let mut words = Words { comment: block.comment.clone(), ..Words::default() };
    let mut settings = block.settings.iter().peekable();
    for word in &block.words {
        while let Some(setting) = settings.next_if(|setting| setting.span.start < word.span.start) {
            words.settings.push(read_setting(setting, state)?);
        }
        read_word(word, &mut words, state)?;
    }
    for setting in settings {
        words.settings.push(read_setting(setting, state)?);
    }
    extra_letter(block, &words, state)?;
    axis_letters(&words, state);
    reach_settings(&words, state);
    state.parameters.announce(&words.settings);
    Ok(words)
}

/// Rule modal-groups.repeated-letter. Every letter other than G and M appears at most once in a block.
fn read_word(word: &Word, words: &mut Words, state: &mut State) -> Result<(), StepError> {
    let value = value_of(&word.value, state)?;
    if !matches!(word.value, Expression::Number(_)) {
        state.coverage.accepted(rule::expressions::READ_BEFORE_EXECUTION);
    }
    match word.letter {
        'g' => words.g_tenths.push(codes::g_code(word, value, state)?),
        'm' => words.m.push(codes::m_code(word, value, state)?),
        letter => {
            let earlier = words.letters.insert(letter, value);
            let dialect = state.dialect();
            let counts = |value| !dialect.letter_may_be_repeated(letter, value, &state.choices);
            if earlier.is_some_and(counts) {
                let message = format!("the letter {} occurs twice", letter.to_ascii_uppercase());
                let kind = FaultKind::RepeatedWord;
                return Err(refuse_at(
                    rule::modal_groups::REPEATED_LETTER,
                    kind,
                    word.span,
                    message,
                ));
            }
        }
    }
    Ok(())
}

/// Rule parameters.assignment. The equals sign stores the number on its right in the parameter on its left.
fn read_setting(setting: &Setting, state: &mut State) -> Result<(Name, f64), StepError> {
    let name = expression::name(&setting.target, state)?;
    parameters::writable(&name, state)?;
    state.dialect().begin_setting(&name, state);
    let value = value_of(&setting.value, state)?;
    if !matches!(setting.value, Expression::Number(_)) {
        state.coverage.accepted(rule::expressions::READ_BEFORE_EXECUTION);
    }
    Ok((name, value))
}

/// How values are read.
pub(crate) trait EvaluationRules {
    /// Rule modal-groups.repeated-letter. Whether a letter may occur twice: it is refused. `earlier` is the first
    /// value.
    fn letter_may_be_repeated(&self, _letter: char, _earlier: f64, _choices: &Choices) -> bool {
        false
    }

    /// Rule parameters.setting-last. A setting takes effect after the values of its line: before its own value is read
    /// nothing is done.
    fn begin_setting(&self, _name: &Name, _state: &mut State) {}

    /// Rule text.word-letters. E is not a letter of the table: only G70, G76 and M66 to M68 have it.
    fn takes_e(&self, words: &Words, _state: &State) -> bool {
        words.m.iter().any(|code| (66..=68).contains(code))
            || words.g_tenths.iter().any(|code| [700, 760].contains(code))
    }

    /// Rule modal-groups.code-close-to-integer. The integer that ten times the number of a G code means.
    fn g_code_number(&self, tenfold: f64, _choices: &Choices) -> Option<i64> {
        math::near_integer(tenfold)
    }

    /// Rule modal-groups.code-decimals. The whole part of the number of a code, and its hundredths.
    fn parts_of_code(
        &self,
        _letter: char,
        (whole, hundredths): (i64, i64),
        _choices: &Choices,
    ) -> (i64, i64) {
        (whole, hundredths)
    }

    /// Rule parameters.position. Whether a parameter can be read now: any can.
    fn check_readable(&self, _name: &Name, _state: &State) -> Result<(), StepError> {
        Ok(())
    }

    /// Rule expressions.absolute. ABS gives the number without its sign.
    fn absolute(&self, argument: f64, _choices: &Choices) -> f64 {
        argument.abs()
    }

    /// Rule expressions.rounding-functions. What ROUND gives for a number that is rounded to `rounded`.
    fn sign_of_rounded(&self, rounded: f64, _choices: &Choices) -> f64 {
        rounded
    }
}

/// Rule text.word-letters. E in a line of no code that takes it is refused.
fn extra_letter(block: &Block, words: &Words, state: &State) -> Result<(), StepError> {
    match block.words.iter().find(|word| word.letter == 'e') {
        Some(word) if !state.dialect().takes_e(words, state) => {
            let message = "the letter E begins no word without G70, G76, M66, M67 or M68";
            Err(refuse_at(rule::text::WORD_LETTERS, FaultKind::BadCharacter, word.span, message))
        }
        _ => Ok(()),
    }
}

/// Rule text.absent-axis. The letter of an axis that the machine does not have is refused; `check` does that, by the
/// rule of what the axis is for.
fn axis_letters(words: &Words, state: &mut State) {
    let letters = words.letters.keys();
    let axes =
        letters.filter_map(|letter| Axis::ALL.iter().find(|axis| axis.word().starts_with(*letter)));
    for axis in axes {
        if state.machine.axes.contains(axis) {
            state.coverage.accepted(rule::text::ABSENT_AXIS);
        } else {
            state.coverage.refused(rule::text::ABSENT_AXIS);
        }
    }
    if !words.letters.is_empty() {
        state.coverage.accepted(rule::modal_groups::REPEATED_LETTER);
    }
}

/// Rule parameters.repeated-setting. When a line sets one parameter more than once, only the last setting takes effect.
fn reach_settings(words: &Words, state: &mut State) {
    let mut names: Vec<&Name> = words.settings.iter().map(|(name, _)| name).collect();
    names.sort_unstable();
    if names.windows(2).any(|pair| pair[0] == pair[1]) {
        state.coverage.accepted(rule::parameters::REPEATED_SETTING);
    }
}
