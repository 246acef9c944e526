//! Motion with the spindle: G33, G33.1 and the threading cycle G76.

pub(crate) mod cycle;

use gaugeblock_vocabulary::{
    Axis, Compensation, Effect, FaultKind, Motion, Position, SpindleMode, SpindleTurn,
};

use super::target::end_point;
use super::word;
use crate::ids::rule;
use crate::math;
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{converted, each, unit_size};
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;
pub(crate) use cycle::ThreadRules;
pub(super) use cycle::perform as thread;

/// Operations on spindle-synchronised motion that a dialect can replace.
pub(crate) trait ThreadingRules {
    /// Moves synchronised with a spindle.
    ///
    /// Rule threading.synchronised. G33 moves to its end point, K per revolution of the spindle, and ends there.
    /// Rule threading.rigid-tap. G33.1 moves there and back, and ends where it began.
    fn move_synchronised(
        &self,
        motion: Motion,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        if !has_axis_words(words) {
            let message = "a synchronised move without an axis word";
            return Err(refuse(
                rule::threading::AXIS_WORDS_MISSING,
                FaultKind::MissingWord,
                message,
            ));
        }
        if state.modes.compensation != Compensation::Off {
            return Err(StepError::Unspecified(
                "a synchronised move under cutter compensation".to_owned(),
            ));
        }
        let place = turning_spindle(words, state)?;
        let Some(pitch) = word(words, 'k') else {
            let message = "a synchronised move without K, its way per revolution";
            return Err(refuse(rule::threading::NEEDS_PITCH, FaultKind::MissingWord, message));
        };
        if pitch <= 0.0 || word(words, 'i').is_some_and(|factor| factor <= 0.0) {
            let what = "a way per revolution, or a factor of the way back, that is not positive";
            return Err(StepError::Unspecified(what.to_owned()));
        }
        let end = end_point(words, state)?;
        within_velocities(place, pitch, end, state)?;
        state.modes.motion = motion;
        let spindle = number(state.dialect().reported_spindle(place, words, state));
        record.effect(state, Effect::StartSpindleSynchronisation { spindle, pitch });
        if motion == Motion::SpindleSynchronised {
            state.position = end;
            record.effect(state, Effect::StraightFeed { end });
            state.coverage.accepted(rule::threading::SYNCHRONISED);
        } else {
            record.effect(state, Effect::RigidTap { end });
            state.coverage.accepted(rule::threading::RIGID_TAP);
        }
        record.effect(state, Effect::StopSpindleSynchronisation {});
        state.coverage.accepted(rule::threading::AXIS_WORDS_MISSING);
        Ok(())
    }

    /// The spindle that $ names, or spindle 0.
    ///
    /// Rule threading.spindle. It is one that the machine has.
    fn selected_spindle(&self, words: &Words, state: &mut State) -> Result<usize, StepError> {
        let Some(number) = word(words, '$') else { return Ok(0) };
        let place = state.dialect().named_spindle(number, state, rule::threading::SPINDLE)?;
        state.coverage.accepted(rule::threading::SPINDLE);
        Ok(place)
    }

    /// The spindle that an effect names: that one.
    fn reported_spindle(&self, place: usize, _words: &Words, _state: &State) -> usize {
        place
    }
}

/// The same, which must turn.
///
/// Rule threading.needs-spindle. It turns; whether G76 too needs that is choice threading.cycle-spindle.
fn turning_spindle(words: &Words, state: &mut State) -> Result<usize, StepError> {
    let place = state.dialect().selected_spindle(words, state)?;
    let turn = state.dialect().known_turn(place, state);
    if matches!(turn, SpindleTurn::Stopped | SpindleTurn::Oriented) {
        let message = "a synchronised move while the spindle does not turn";
        return Err(refuse(rule::threading::NEEDS_SPINDLE, FaultKind::ZeroSpeed, message));
    }
    state.coverage.accepted(rule::threading::NEEDS_SPINDLE);
    Ok(place)
}

/// The move lasts as long as the spindle takes for its revolutions: one for each K of the way in X, Y and Z.
///
/// Rule threading.velocity. In that time no axis goes further than its highest velocity brings it. Under constant
/// surface speed S does not say how fast the spindle turns.
fn within_velocities(
    place: usize,
    pitch: f64,
    end: Position,
    state: &mut State,
) -> Result<(), StepError> {
    let modes = &state.modes;
    let spindle = modes.spindles[place];
    if spindle.mode == SpindleMode::SurfaceSpeed {
        return Ok(());
    }
    let (here, there) = (modes.machine_point(state.position), modes.machine_point(end));
    let way = converted(
        each(there, here, |there, here| there - here),
        modes.units,
        state.machine.length_unit,
    );
    let pitch = pitch * unit_size(modes.units) / unit_size(state.machine.length_unit);
    let revolutions = math::hypotenuse(math::hypotenuse(way.x, way.y), way.z) / pitch;
    let seconds = revolutions / spindle.speed * 60.0;
    let too_fast = |axis: &Axis| {
        let limits = state.machine.limits.get(axis.word());
        let highest = limits.and_then(|limits| limits.velocity).unwrap_or(f64::INFINITY);
        // A velocity that equals the highest one does not exceed it, except by rounding.
        way.get(*axis).abs() > highest * seconds * (1.0 + 1e-9)
    };
    if revolutions > 0.0 && Axis::ALL.iter().any(too_fast) {
        let message = "a move in step with the spindle that is too fast for an axis";
        return Err(refuse(rule::threading::VELOCITY, FaultKind::BeyondLimit, message));
    }
    state.coverage.accepted(rule::threading::VELOCITY);
    Ok(())
}

/// A spindle's number, as effects report it.
fn number(place: usize) -> u32 {
    u32::try_from(place).expect("machine: spindles are few")
}
