//! Quirks of motion with the spindle.

use gaugeblock_vocabulary::{FaultKind, Position, Switch};

use crate::ids::quirk;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::end_point;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Quirk rs274.synchronised-feed-word. G33 and G33.1 do not stand in a block with F.
pub(crate) fn feed_word(words: &Words, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::SYNCHRONISED_FEED_WORD;
    if words.letters.contains_key(&'f') && state.choices.quirk(rule) {
        return Err(refuse(rule, FaultKind::UnusedWord, "F with a synchronised move"));
    }
    Ok(())
}

/// Quirk rs274.chosen-spindle. The spindle that an effect tells: spindle 0 where $ is left out, since nothing that
/// the controller shows tells which one it was.
pub(crate) fn reported_spindle(place: usize, words: &Words, state: &State) -> usize {
    let chosen =
        !words.letters.contains_key(&'$') && state.choices.quirk(quirk::rs274::CHOSEN_SPINDLE);
    if chosen { 0 } else { place }
}

/// Quirk rs274.thread-long-taper. Which way the tapers and the slide of a thread lead along Z: down where it leads
/// nowhere.
pub(crate) fn direction(way: f64, state: &State) -> f64 {
    let nowhere = way == 0.0 && state.choices.quirk(quirk::rs274::THREAD_LONG_TAPER);
    if nowhere { -1.0 } else { way.signum() }
}

/// Quirk rs274.thread-clearance. Each pass of G76 begins and ends as much further out than the drive line as it is
/// less deep than the last one.
pub(crate) fn clearance(less_deep: f64, state: &State) -> f64 {
    if state.choices.quirk(quirk::rs274::THREAD_CLEARANCE) { less_deep } else { 0.0 }
}

/// Quirk rs274.thread-clearance. A last traverse leads to the end of the drive line, even from there.
/// Quirk rs274.thread-other-axes. It leads to where X and Y, or polar words, of the block say.
pub(crate) fn after_thread(
    words: &Words,
    start: Position,
    end: f64,
    state: &mut State,
) -> Result<Option<Position>, StepError> {
    let other = state.choices.quirk(quirk::rs274::THREAD_OTHER_AXES)
        && ['x', 'y', '@', '^'].iter().any(|letter| words.letters.contains_key(letter));
    if !other && !state.choices.quirk(quirk::rs274::THREAD_CLEARANCE) {
        return Ok(None);
    }
    state.position = start;
    Ok(Some(Position { z: end, ..end_point(words, state)? }))
}

/// Quirk rs274.thread-feed-override. After a pass of G76 the feed override is enabled, whatever it was before.
pub(crate) fn feed_override_after(before: Switch, state: &State) -> Switch {
    if state.choices.quirk(quirk::rs274::THREAD_FEED_OVERRIDE) { Switch::On } else { before }
}
