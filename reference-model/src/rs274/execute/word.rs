//! The values of a block's words.

use crate::math::near_integer;
use crate::rs274::evaluate::Words;

/// The value of a word, if the block has it.
pub(crate) fn word(words: &Words, letter: char) -> Option<f64> {
    words.letters.get(&letter).copied()
}

/// The integer that a value is close to: within 0.0001, as everywhere in the language.
pub(crate) fn whole(value: f64) -> Option<i32> {
    near_integer(value).and_then(|nearest| i32::try_from(nearest).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_close_to_integers_are_integers() {
        assert_eq!(whole(2.00005), Some(2));
        assert_eq!(whole(-1.0), Some(-1));
        assert_eq!(whole(2.5), None);
        assert_eq!(whole(1e300), None);
    }
}
