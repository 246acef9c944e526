//! What is refused before anything of the block is done: what its words alone show.
//!
//! What depends on the modes in force is refused by the phase that meets it (`execute`).

pub(crate) mod codes;
pub(crate) mod needed;
pub(crate) mod words;

use super::evaluate::Words;
use super::refusal::StepError;
use super::state::State;
pub(crate) use codes::has_later_codes;

/// Refuses a block that cannot be executed, before anything of it is done.
///
/// # Errors
/// The rule that refuses it, or a code that this edition of the model does not specify.
pub fn check(words: &Words, state: &mut State) -> Result<(), StepError> {
    codes::check(words, state)?;
    words::check(words, state)?;
    needed::check(words, state)
}
