//! Quirks of motion in step with a spindle.

use gaugeblock_vocabulary::{FaultKind, Motion, Position, Switch};

use super::overrides::override_flag;
use super::spindle::choose_spindle;
use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::target::end_point;
use crate::rs274::execute::threading::cycle::{Pass, Thread, pass, traverse};
use crate::rs274::execute::threading::{ThreadRules, ThreadingRules};
use crate::rs274::execute::word;
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

impl ThreadingRules for Observed {
    /// Quirk rs274.synchronised-feed-word. G33 and G33.1 are refused in a block with F.
    fn move_synchronised(
        &self,
        motion: Motion,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        let rule = quirk::rs274::SYNCHRONISED_FEED_WORD;
        if has_axis_words(words) && word(words, 'f').is_some() && state.has_quirk(rule) {
            return Err(refuse(rule, FaultKind::UnusedWord, "F with a synchronised move"));
        }
        Documented.move_synchronised(motion, words, state, record)
    }

    /// Quirk rs274.chosen-spindle. A $ selects the spindle of later blocks without $.
    fn selected_spindle(&self, words: &Words, state: &mut State) -> Result<usize, StepError> {
        if word(words, '$').is_none() {
            return Ok(state.memory.chosen_spindle);
        }
        let place = Documented.selected_spindle(words, state)?;
        choose_spindle(place, state);
        Ok(place)
    }

    /// Quirk rs274.chosen-spindle. Spindle 0 is reported if the block has no $: the controller does not report which
    /// spindle it used.
    fn reported_spindle(&self, place: usize, words: &Words, state: &State) -> usize {
        if word(words, '$').is_none() && state.has_quirk(quirk::rs274::CHOSEN_SPINDLE) {
            return 0;
        }
        Documented.reported_spindle(place, words, state)
    }
}

impl ThreadRules for Observed {
    /// Quirk rs274.thread-negative-springs. With a negative H the last pass is not cut.
    fn cut_passes(
        &self,
        thread: &Thread,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        if thread.springs >= 0 {
            return Documented.cut_passes(thread, state, record);
        }
        let mut count = 1.0;
        loop {
            if record.is_full() {
                return Err(StepError::TooManyEffects);
            }
            let depth = thread.depth(count);
            count += 1.0;
            if depth >= thread.full {
                return Ok(());
            }
            pass(thread, depth, state, record);
        }
    }

    /// Quirk rs274.thread-clearance. A last traverse leads to the end of the drive line, even if it starts there.
    /// Quirk rs274.thread-other-axes. The last traverse leads to the X and Y, or polar words, of the block.
    fn leave_thread(
        &self,
        thread: &Thread,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        let other = state.has_quirk(quirk::rs274::THREAD_OTHER_AXES)
            && ['x', 'y', '@', '^'].iter().any(|letter| word(words, *letter).is_some());
        if other || state.has_quirk(quirk::rs274::THREAD_CLEARANCE) {
            state.position = thread.start;
            let end = Position { z: thread.end, ..end_point(words, state)? };
            traverse(end, state, record);
        }
        Documented.leave_thread(thread, words, state, record)
    }

    /// Quirk rs274.thread-long-taper. If a thread has no length along Z, its tapers and its slide lead down.
    fn thread_direction(&self, way: f64, state: &State) -> f64 {
        if way == 0.0 && state.has_quirk(quirk::rs274::THREAD_LONG_TAPER) {
            return -1.0;
        }
        Documented.thread_direction(way, state)
    }

    /// Quirk rs274.thread-clearance. A pass begins and ends as much further out than the drive line as it is less deep
    /// than the last one.
    fn clearance_of_pass(&self, thread: &Thread, depth: f64, state: &State) -> f64 {
        if state.has_quirk(quirk::rs274::THREAD_CLEARANCE) {
            return thread.full - depth;
        }
        Documented.clearance_of_pass(thread, depth, state)
    }

    /// Quirk rs274.thread-clearance. A pass begins with a traverse to the drive line, even if it starts there.
    fn begin_pass(&self, line: Position, state: &mut State, record: &mut Record) {
        if state.has_quirk(quirk::rs274::THREAD_CLEARANCE) {
            return traverse(line, state, record);
        }
        Documented.begin_pass(line, state, record);
    }

    /// Quirk rs274.thread-feed-override. The feed override is disabled during a pass and enabled after it, even if it
    /// was disabled before. The flag of the interpreter stays.
    fn feed_pass(&self, thread: &Thread, pass: &Pass, state: &mut State, record: &mut Record) {
        let disables = state.has_quirk(quirk::rs274::THREAD_FEED_OVERRIDE);
        let flag = override_flag(&state.modes);
        if disables {
            state.modes.feed_override = Switch::Off;
        }
        Documented.feed_pass(thread, pass, state, record);
        if disables {
            state.modes.feed_override = Switch::On;
            state.modes.memory.get_mut().override_flag =
                (flag == Switch::Off).then_some(Switch::Off);
        }
    }

    /// Quirk rs274.thread-long-taper. No taper is too long.
    fn is_long_taper(&self, taper: f64, way: f64, state: &State) -> bool {
        !state.has_quirk(quirk::rs274::THREAD_LONG_TAPER)
            && Documented.is_long_taper(taper, way, state)
    }

    /// Quirk rs274.thread-any-plane. G76 is accepted in any plane.
    fn check_thread_plane(&self, state: &State) -> Result<(), StepError> {
        if state.has_quirk(quirk::rs274::THREAD_ANY_PLANE) {
            return Ok(());
        }
        Documented.check_thread_plane(state)
    }

    /// Quirk rs274.thread-other-axes. X and Y, and polar words, can be in the block.
    fn takes_axis_word(&self, letter: char, state: &State) -> bool {
        matches!(letter, 'x' | 'y' | '@' | '^') && state.has_quirk(quirk::rs274::THREAD_OTHER_AXES)
            || Documented.takes_axis_word(letter, state)
    }

    /// Quirk rs274.thread-negative-springs. H can be negative.
    fn not_negative(&self, state: &State) -> &'static str {
        if state.has_quirk(quirk::rs274::THREAD_NEGATIVE_SPRINGS) {
            return "pjk";
        }
        Documented.not_negative(state)
    }

    /// Quirk rs274.thread-low-degression. R below 1 counts as 1.
    fn thread_degression(&self, programmed: f64, state: &State) -> Result<f64, StepError> {
        if state.has_quirk(quirk::rs274::THREAD_LOW_DEGRESSION) {
            return Ok(programmed.max(1.0));
        }
        Documented.thread_degression(programmed, state)
    }
}
