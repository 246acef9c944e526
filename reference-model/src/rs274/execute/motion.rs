//! G0, G1, G2, G3, G80, and axis words alone. G codes are in tenths: 530 is G53.

use gaugeblock_vocabulary::{
    Compensation, Distance, FaultKind, Motion, Position, SpindleMode, SpindleTurn,
};

use super::arc;
use super::feed::{check_feed_rate, check_rate};
use super::programmed_motion::{by_offsets_alone, is_arc, is_feed, is_spline, motion_of};
use super::straight::lead_to;
use super::target::{end_point, machine_end_point};
use super::{compensation, cycles, probe, splines, threading, turning};
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{ModalGroup, g_code, motion_mode};
use crate::rs274::order::{has_axis_words, moves_by_axis_words};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::{Curve, State};
use crate::rs274::task::Record;

/// Moves, or sets the motion mode.
///
/// Rule cycles.cancelled-by-motion. Any other motion ends a series of canned cycles.
///
/// # Errors
/// A move that the active modes do not allow.
pub fn perform(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    if !cycles::is_cycle(state.modes.motion) {
        state.series = None;
    }
    if turning::is_programmed(words) {
        return turn(words, state, record);
    }
    let Some(motion) = motion_of(words, state) else { return Ok(()) };
    let programmed = words.g_tenths.iter().any(|code| motion_mode(*code).is_some());
    accept_mode(motion, programmed, words, state);
    if words.g_tenths.contains(&530) {
        state.dialect().check_machine_coordinates(motion, words, state)?;
    }
    if state.curve.open.is_some() && !is_spline(motion) {
        return Err(StepError::Unspecified("another motion in an open data block".to_owned()));
    }
    let leads_away =
        !matches!(motion, Motion::None | Motion::Traverse | Motion::Feed) && !is_arc(motion);
    let is_synchronised = matches!(motion, Motion::SpindleSynchronised | Motion::RigidTap);
    if leads_away {
        state.dialect().lead_away_by_other_move(is_synchronised, state);
    }
    if cycles::is_cycle(motion) {
        state.curve = Curve::default();
        return cycles::perform(motion, words, state, record);
    }
    if state.series.take().is_some() {
        state.coverage.accepted(rule::cycles::CANCELLED_BY_MOTION);
    }
    if motion == Motion::Nurbs {
        return splines::nurbs(words, state, record);
    }
    let in_data_block = state.curve.open.take().is_some();
    let continues = std::mem::take(&mut state.curve.continues);
    if motion == Motion::None {
        cancel(words, programmed, state)
    } else if matches!(motion, Motion::CubicSpline | Motion::QuadraticSpline) {
        state.curve.continues = continues;
        splines::perform(motion, in_data_block, words, state, record)
    } else if is_synchronised {
        state.dialect().move_synchronised(motion, words, state, record)
    } else if motion == Motion::Thread76 {
        threading::thread(words, state, record)
    } else if probe::is_probing(motion) {
        probe::perform(motion, words, state, record)
    } else if has_axis_words(words) || is_arc(motion) {
        move_to(motion, words, state, record)
    } else {
        without_axis_words(motion, words, state, record)
    }
}

/// A lathe cycle, which ends series of other cycles as any motion does: its first motion, and once its profile has been
/// read the rest.
fn turn(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    if let Some(profile) = state.profile.take() {
        return turning::cut(&profile.moves, words, state, record);
    }
    if state.curve.open.is_some() {
        return Err(StepError::Unspecified("another motion in an open data block".to_owned()));
    }
    if state.series.take().is_some() {
        state.coverage.accepted(rule::cycles::CANCELLED_BY_MOTION);
    }
    state.curve = Curve::default();
    turning::begin(words, state, record)
}

/// Names the rule by which a block has its motion: by its own code, or by the mode in force.
fn accept_mode(motion: Motion, programmed: bool, words: &Words, state: &mut State) {
    if programmed {
        state.coverage.accepted(rule::motion::MODE_CHANGE);
        return;
    }
    state.coverage.accepted(rule::motion::MODE_HOLDS);
    if is_arc(motion) {
        let alone = by_offsets_alone(words, state) && !moves_by_axis_words(words);
        let rule = if alone { rule::arcs::OFFSETS_ALONE } else { rule::arcs::MODE_HOLDS };
        state.coverage.accepted(rule);
    }
}

/// Rule motion.cancel. G80 cancels the motion mode. Rule motion.cancel-with-axis-words. Axis words have no place in
/// its block. Rule modal-groups.axis-words-without-mode and rule motion.axis-words-after-cancel. Nor have they in a
/// block that does not use them while no motion mode is active.
fn cancel(words: &Words, programmed: bool, state: &mut State) -> Result<(), StepError> {
    if has_axis_words(words) && moves_by(words) {
        let message = "axis words, and no motion mode";
        if programmed {
            return Err(refuse(
                rule::motion::CANCEL_WITH_AXIS_WORDS,
                FaultKind::AxisWords,
                message,
            ));
        }
        state.coverage.refused(rule::motion::AXIS_WORDS_AFTER_CANCEL);
        let rule = rule::modal_groups::AXIS_WORDS_WITHOUT_MODE;
        return Err(refuse(rule, FaultKind::AxisWords, message));
    }
    state.coverage.accepted(rule::motion::CANCEL);
    state.modes.motion = Motion::None;
    Ok(())
}

/// Whether the axis words of a block are the motion's.
fn moves_by(words: &Words) -> bool {
    let others = words.g_tenths.iter().filter_map(|code| g_code(*code));
    !others.filter(|code| code.group != Some(ModalGroup::Motion)).any(|code| code.axis_words)
}

/// The rules of moves that a controller may follow differently.
pub(crate) trait MotionRules {
    /// A straight move leads from one programmed point to another.
    fn straight_move_leads(
        &self,
        _motion: Motion,
        _start: Position,
        _end: Position,
        _state: &mut State,
    ) {
    }

    /// Rule motion.offset-words-after-cancel. Whether axis words that a code uses are refused while G80 is active.
    fn refuses_words_after_cancel(&self, _words: &Words, state: &State) -> bool {
        state.choices.is(choice::motion::OffsetWordsAfterCancel::Refused)
    }

    /// Rule offsets.machine-needs-motion. G53 needs G0 or G1 to be active, in its block or before
    /// (offsets.machine-motion).
    /// Rule offsets.machine-under-compensation. It is refused while cutter compensation is on.
    fn check_machine_coordinates(
        &self,
        motion: Motion,
        words: &Words,
        state: &mut State,
    ) -> Result<(), StepError> {
        if !matches!(motion, Motion::Traverse | Motion::Feed) {
            let rule = rule::offsets::MACHINE_NEEDS_MOTION;
            return Err(refuse(rule, FaultKind::ModalConflict, "G53 needs G0 or G1"));
        }
        if !state.dialect().names_machine_point(words, state) {
            let rule = rule::offsets::MACHINE_NEEDS_AXES;
            return Err(refuse(rule, FaultKind::MissingWord, "G53 needs an axis word"));
        }
        if state.dialect().is_compensated(state) {
            let rule = rule::offsets::MACHINE_UNDER_COMPENSATION;
            let message = "G53 while cutter compensation is on";
            return Err(refuse(rule, FaultKind::CompensationActive, message));
        }
        state.dialect().check_machine_distance(state)?;
        if !words.g_tenths.iter().any(|code| [0, 10].contains(code)) {
            state.coverage.accepted(rule::offsets::MACHINE_MOTION);
        }
        state.coverage.accepted(rule::offsets::MACHINE_COORDINATES);
        state.coverage.accepted(rule::offsets::MACHINE_ONCE);
        Ok(())
    }

    /// Rule offsets.machine-needs-axes. Whether a block names a point for G53: by its axis words.
    fn names_machine_point(&self, words: &Words, _state: &State) -> bool {
        has_axis_words(words)
    }

    /// Rule offsets.machine-incremental. In incremental distance mode too G53 goes to the absolute point.
    fn check_machine_distance(&self, state: &mut State) -> Result<(), StepError> {
        state.coverage.accepted(rule::offsets::MACHINE_INCREMENTAL);
        Ok(())
    }

    /// Whether the cutter is compensated, so that machine coordinates are refused.
    fn is_compensated(&self, state: &State) -> bool {
        state.modes.compensation != Compensation::Off
    }

    /// Whether a block that feeds needs a feed rate: each does.
    fn needs_feed_rate(&self, _words: &Words, _state: &State) -> bool {
        true
    }

    /// Rule spindle.surface-speed-while-stopped. Under constant surface speed the spindle must turn.
    fn check_spindle_of_feed(&self, _words: &Words, state: &mut State) -> Result<(), StepError> {
        let rule = rule::spindle::SURFACE_SPEED_WHILE_STOPPED;
        if state.dialect().surface_speed_stands(state) {
            let message = "a feed move under constant surface speed while the spindle is stopped";
            return Err(refuse(rule, FaultKind::ZeroSpeed, message));
        }
        state.coverage.accepted(rule);
        Ok(())
    }

    /// Whether a spindle under constant surface speed does not turn.
    fn surface_speed_stands(&self, state: &State) -> bool {
        let surface = |mode| mode == SpindleMode::SurfaceSpeed;
        let mut spindles = state.modes.spindles.iter().filter(|spindle| surface(spindle.mode));
        spindles.any(|spindle| matches!(spindle.turn, SpindleTurn::Stopped | SpindleTurn::Oriented))
    }

    /// Whether an axis that G53 does not move stays where it is to the last bit.
    fn keeps_unmoved_axes(&self, _state: &State) -> bool {
        true
    }

    /// Rule motion.polar-from-origin. An incremental polar move has no angle at the origin.
    fn check_polar(&self, _words: &Words, state: &State) -> Result<(), StepError> {
        let here = compensation::programmed_point(state);
        let incremental = state.modes.distance == Distance::Incremental;
        if incremental && here.x == 0.0 && here.y == 0.0 {
            let message = "an incremental polar move from the origin, which has no angle";
            return Err(refuse(rule::motion::POLAR_FROM_ORIGIN, FaultKind::AxisWords, message));
        }
        Ok(())
    }
}

/// Rule motion.without-axis-words. Whether a motion code alone makes a move of no length, or is refused, is a choice.
fn without_axis_words(
    motion: Motion,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    use choice::motion::WithoutAxisWords::{MoveInPlace, Refused};
    let rule = rule::motion::WITHOUT_AXIS_WORDS;
    if state.choices.is(Refused) {
        return Err(refuse(rule, FaultKind::MissingWord, "a motion code without an axis word"));
    }
    if state.choices.is(MoveInPlace) {
        state.coverage.accepted(rule);
        return move_to(motion, words, state, record);
    }
    // Rule feed.move-without-rate. G1 needs a feed rate, also where it only sets the mode.
    if motion == Motion::Feed {
        check_rate(words, state)?;
    }
    state.coverage.accepted(rule);
    state.modes.motion = motion;
    Ok(())
}

/// Rule motion.traverse. G0 moves at rapid speed to the point that the axis words name.
/// Rule motion.feed. G1 moves there at the feed rate that is current (feed.applies-to-feed-moves).
fn move_to(
    motion: Motion,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    if is_feed(motion) {
        check_feed_rate(words, state)?;
    }
    if is_arc(motion) {
        return arc::perform(motion, words, state, record);
    }
    let end = if words.g_tenths.contains(&530) {
        machine_end_point(words, state)
    } else {
        end_point(words, state)?
    };
    lead_to(motion, end, words, state, record)
}
