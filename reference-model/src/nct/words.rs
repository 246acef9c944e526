//! The words of a block: evaluated, vacant ones left out, rounded and in range where their letter counts something.

use gaugeblock_vocabulary::FaultKind;

use super::evaluate::rounded;
use super::refusal::{StepError, refuse};
use super::state::Run;
use super::syntax::Word;
use crate::ids::rule;

/// The words of a block that have a value, in its order.
pub type Words = Vec<(char, f64)>;

/// Largest number of a G code, in tenths.
const LARGEST_G: i64 = 999;
/// Largest number of an M code.
const LARGEST_M: i64 = 999;

impl Run<'_> {
    /// The words of a block, evaluated from the left.
    ///
    /// Rule nct.vacant-word. A word with a vacant value is left out. Zero has no sign.
    pub(super) fn words(&mut self, words: &[Word]) -> Result<Words, StepError> {
        let mut valued = Vec::new();
        for word in words {
            match self.value(&word.value)? {
                Some(value) => valued.push((word.letter, value + 0.0)),
                None => self.coverage.accepted(rule::nct::VACANT_WORD),
            }
        }
        Ok(valued)
    }

    /// The G codes of a block, in tenths.
    pub(super) fn g_codes(&mut self, words: &Words) -> Result<Vec<i64>, StepError> {
        let of_g = words.iter().filter(|(letter, _)| *letter == 'G');
        of_g.map(|(_, value)| self.counted('G', value * 10.0, LARGEST_G)).collect()
    }

    /// The M codes of a block.
    pub(super) fn m_codes(&mut self, words: &Words) -> Result<Vec<i64>, StepError> {
        let of_m = words.iter().filter(|(letter, _)| *letter == 'M');
        of_m.map(|(_, value)| self.counted('M', *value, LARGEST_M)).collect()
    }

    /// Rule nct.word-rounding. A value is rounded to the digits that its letter has.
    /// Rule nct.word-range. One that is out of its letter's range is refused.
    pub(super) fn counted(
        &mut self,
        letter: char,
        value: f64,
        most: i64,
    ) -> Result<i64, StepError> {
        let number = Some(rounded(value)).filter(|number| (0..=most).contains(number));
        let message = format!("{letter} has no {value}");
        let rule = rule::nct::WORD_RANGE;
        let number = number.ok_or_else(|| refuse(rule, FaultKind::WordOutOfRange, message))?;
        self.coverage.accepted(rule);
        if value.round().to_bits() != value.to_bits() {
            self.coverage.accepted(rule::nct::WORD_ROUNDING);
        }
        Ok(number)
    }
}

/// The value of the first word with this letter.
pub(super) fn word(words: &Words, letter: char) -> Option<f64> {
    words.iter().find(|(other, _)| *other == letter).map(|(_, value)| *value)
}
