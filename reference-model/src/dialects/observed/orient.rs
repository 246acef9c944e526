//! Quirks of M19.

use gaugeblock_vocabulary::{Pin, SpindleTurn};

use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::orient::{
    OrientRules, angle, direction, spindles, timeout, turn_to, wait_for,
};
use crate::rs274::execute::{pass, word};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;
use crate::rs274::task::Record;

impl OrientRules for Observed {
    /// Quirk rs274.orient-without-angle. Without R and with P the angle is zero. Without both the spindle is not
    /// oriented.
    /// Quirk rs274.orient-without-timeout. Without Q the run does not wait.
    /// Quirk rs274.orient-forgets-turning. After M19 the interpreter regards every spindle as stopped, until the
    /// spindle is started again.
    fn orient(
        &self,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        let has = |letter| word(words, letter).is_some();
        let spindles = spindles(words, state)?;
        let angle = if !has('r') && state.has_quirk(quirk::rs274::ORIENT_WITHOUT_ANGLE) {
            has('p').then_some(state.machine.orient_offset)
        } else {
            Some(angle(words, state)?)
        };
        let direction = direction(words, state)?;
        let timeout = if !has('q') && state.has_quirk(quirk::rs274::ORIENT_WITHOUT_TIMEOUT) {
            None
        } else {
            Some(timeout(words, state)?)
        };
        if state.has_quirk(quirk::rs274::ORIENT_FORGETS_TURNING) {
            state.modes.memory.get_mut().regarded_as_stopped =
                state.all_spindles().into_iter().collect();
        }
        if let Some(angle) = angle {
            remember_turning(&spindles, state);
            turn_to(&spindles, angle, direction, state, record);
        }
        pass(0.0, state);
        match timeout {
            Some(timeout) => wait_for(&spindles, timeout, state, record),
            None => Ok(()),
        }
    }

    /// Quirk linuxcnc.orient-while-locked. No orientation is requested of a spindle that is locked already.
    fn request_orientation(&self, place: usize, state: &mut State) {
        let pin = u16::try_from(place).map(Pin::SpindleLocked);
        let locked = pin.is_ok_and(|pin| state.environment.level(pin) != 0.0);
        if !locked || !state.has_quirk(quirk::linuxcnc::ORIENT_WHILE_LOCKED) {
            Documented.request_orientation(place, state);
        }
    }

    /// Quirk linuxcnc.speed-releases-brake. An S word has released the brake.
    fn applies_brake(&self, place: usize, locked: bool, state: &State) -> bool {
        let released = state.modes.memory.get().brake_released.contains(&place);
        (locked || !released) && Documented.applies_brake(place, locked, state)
    }
}

/// Quirk linuxcnc.speed-while-oriented. Records how spindles turn before M19. The record of an oriented spindle does
/// not change.
fn remember_turning(spindles: &[usize], state: &mut State) {
    for place in spindles {
        let turn = state.dialect().commanded_turn(*place, state);
        state.memory.turning_again.remove(place);
        if turn != SpindleTurn::Oriented {
            state.memory.turned_before.insert(*place, turn);
        }
    }
}
