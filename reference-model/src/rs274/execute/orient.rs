//! M19.

use gaugeblock_vocabulary::scenario::OrientAnswer;
use gaugeblock_vocabulary::{Effect, FaultKind, OrientDirection, Pin, SpindleTurn};

use super::time::{brake, index, pass, turns};
use super::{whole, word};
use crate::ids::{choice, rule};
use crate::rs274::environment::Orientation;
use crate::rs274::evaluate::Words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Operations of M19 that a dialect can replace.
pub(crate) trait OrientRules {
    /// Turns a spindle to an angle.
    ///
    /// Rule orient.angle. R is the angle in degrees; the machine's offset is added to it (orient.offset).
    /// Rule orient.direction. P says which way: 0 the shortest, 1 clockwise, 2 counterclockwise; 0 when it is not
    /// given. Rule orient.wait. Q is how long the run waits for the spindle, in seconds.
    /// Rule orient.replaces-turning. M19 belongs to the group of M3, M4 and M5: it takes the place of the one in force.
    fn orient(
        &self,
        words: &Words,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        let spindles = spindles(words, state)?;
        let angle = angle(words, state)?;
        let direction = direction(words, state)?;
        let timeout = timeout(words, state)?;
        turn_to(&spindles, angle, direction, state, record);
        pass(0.0, state);
        wait_for(&spindles, timeout, state, record)
    }

    /// Rule orient.pins. The request is set. On its way a spindle is neither locked nor braked, however short the way
    /// is.
    fn request_orientation(&self, place: usize, state: &mut State) {
        let Some(spindle) = index(place) else { return };
        state.environment.set(Pin::SpindleLocked(spindle), 0.0);
        state.environment.set(Pin::SpindleOrient(spindle), 1.0);
        state.environment.begin_orientation(place);
        brake(place, state);
    }

    /// Whether the brake of a spindle is applied: of one that is locked.
    ///
    /// Rule orient.brake-otherwise. Whether it is applied to any other stopped spindle is a choice.
    fn applies_brake(&self, place: usize, locked: bool, state: &State) -> bool {
        let stands = !turns(place, state) && state.environment.orientation(place).is_none();
        locked || stands && state.choices.is(choice::orient::BrakeOtherwise::WhileStanding)
    }
}

/// The spindles begin to turn to the angle.
pub(crate) fn turn_to(
    spindles: &[usize],
    angle: f64,
    direction: OrientDirection,
    state: &mut State,
    record: &mut Record,
) {
    for place in spindles {
        state.modes.spindles[*place].turn = SpindleTurn::Oriented;
    }
    for place in spindles {
        // The machine has no more than 255 spindles.
        let Ok(spindle) = u8::try_from(*place) else { continue };
        state.coverage.accepted(rule::orient::REPLACES_TURNING);
        begin(*place, angle, direction, state);
        let spindle = u32::from(spindle);
        record.effect(state, Effect::OrientSpindle { spindle, angle, direction });
    }
}

/// The run waits until each spindle is at its angle.
pub(crate) fn wait_for(
    spindles: &[usize],
    timeout: f64,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    for place in spindles {
        let Ok(spindle) = u32::try_from(*place) else { continue };
        record.effect(state, Effect::WaitOrient { spindle, timeout });
        wait(*place, timeout, state, record)?;
    }
    Ok(())
}

/// Rule orient.spindle. $ says whose pins carry the orientation.
/// Choice orient.without-dollar: without $ it is the first spindle or every one.
pub(crate) fn spindles(words: &Words, state: &mut State) -> Result<Vec<usize>, StepError> {
    let Some(value) = word(words, '$') else {
        let rule = rule::orient::WITHOUT_DOLLAR;
        state.coverage.accepted(rule);
        return Ok(if state.choices.is(choice::orient::WithoutDollar::All) {
            state.all_spindles()
        } else {
            vec![0]
        });
    };
    let place = state.dialect().named_spindle(value, state, rule::orient::SPINDLE_RANGE)?;
    state.coverage.accepted(rule::orient::SPINDLE_RANGE);
    state.coverage.accepted(rule::orient::SPINDLE);
    Ok(vec![place])
}

/// Rule orient.needs-angle. R is needed. Rule orient.angle-range. It is 0 to 360 degrees.
pub(crate) fn angle(words: &Words, state: &mut State) -> Result<f64, StepError> {
    let offset = state.machine.orient_offset;
    let Some(angle) = word(words, 'r') else {
        let rule = rule::orient::NEEDS_ANGLE;
        return Err(refuse(rule, FaultKind::MissingWord, "M19 needs R, the angle"));
    };
    let rule = rule::orient::ANGLE_RANGE;
    if !(0.0..=360.0).contains(&angle) {
        let message = format!("R{angle} is not between 0 and 360 degrees");
        return Err(refuse(rule, FaultKind::WordOutOfRange, message));
    }
    state.coverage.accepted(rule);
    state.coverage.accepted(rule::orient::ANGLE);
    if offset != 0.0 {
        state.coverage.accepted(rule::orient::OFFSET);
    }
    Ok(angle + offset)
}

/// Rule orient.direction-range. P is 0, 1 or 2.
pub(crate) fn direction(words: &Words, state: &mut State) -> Result<OrientDirection, StepError> {
    let value = word(words, 'p').unwrap_or(0.0);
    let direction = match whole(value) {
        Some(0) => OrientDirection::Shortest,
        Some(1) => OrientDirection::Clockwise,
        Some(2) => OrientDirection::Counterclockwise,
        _ => {
            let message = format!("P{value} is not a direction; expected 0, 1 or 2");
            let rule = rule::orient::DIRECTION_RANGE;
            return Err(refuse(rule, FaultKind::WordOutOfRange, message));
        }
    };
    state.coverage.accepted(rule::orient::DIRECTION_RANGE);
    state.coverage.accepted(rule::orient::DIRECTION);
    Ok(direction)
}

/// Rule orient.needs-timeout. Q is needed. Rule orient.zero-timeout. Whether it may be zero is a choice.
pub(crate) fn timeout(words: &Words, state: &mut State) -> Result<f64, StepError> {
    let Some(seconds) = word(words, 'q') else {
        let rule = rule::orient::NEEDS_TIMEOUT;
        return Err(refuse(rule, FaultKind::MissingWord, "M19 needs Q, the longest wait"));
    };
    let rule = rule::orient::ZERO_TIMEOUT;
    if seconds < 0.0 || seconds == 0.0 && state.choices.is(choice::orient::ZeroTimeout::Refused) {
        let message = format!("M19 with a longest wait of {seconds} seconds");
        return Err(refuse(rule, FaultKind::WordOutOfRange, message));
    }
    if seconds == 0.0 {
        state.coverage.accepted(rule);
    }
    Ok(seconds)
}

/// Rule orient.pins. The angle and the direction are on their pins, and the request is set.
fn begin(place: usize, angle: f64, direction: OrientDirection, state: &mut State) {
    let Some(spindle) = index(place) else { return };
    let direction = match direction {
        OrientDirection::Shortest => 0.0,
        OrientDirection::Clockwise => 1.0,
        OrientDirection::Counterclockwise => 2.0,
    };
    state.environment.set(Pin::SpindleOrientAngle(spindle), angle);
    state.environment.set(Pin::SpindleOrientMode(spindle), direction);
    state.coverage.accepted(rule::orient::PINS);
    state.dialect().request_orientation(place, state);
}

/// Rule orient.timeout. A spindle that does not reach its angle within Q seconds is an error.
/// Rule orient.fault. So is a fault that its encoder reports.
fn wait(
    place: usize,
    timeout: f64,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let Some(orientation) = state.environment.orientation(place) else { return Ok(()) };
    if let Some(fault) = orientation.fault() {
        let message = format!("spindle {place} reports the fault {fault} on its way to its angle");
        return Err(refuse(rule::orient::FAULT, FaultKind::Orient, message));
    }
    state.coverage.accepted(rule::orient::FAULT);
    let now = state.environment.time();
    match orientation.done().filter(|done| *done <= now + timeout) {
        Some(done) => {
            record.wait(state, (done - now).max(0.0));
            state.coverage.accepted(rule::orient::WAIT);
            state.coverage.accepted(rule::orient::TIMEOUT);
            Ok(())
        }
        None => {
            record.wait(state, timeout);
            let message = format!("spindle {place} is not at its angle after {timeout} seconds");
            Err(refuse(rule::orient::TIMEOUT, FaultKind::Orient, message))
        }
    }
}

impl Orientation {
    /// The fault that the encoder reports, if it does.
    fn fault(self) -> Option<i32> {
        match self.answer {
            OrientAnswer::Fault(fault) => Some(fault).filter(|fault| *fault != 0),
            OrientAnswer::After(_) | OrientAnswer::Never => None,
        }
    }
}
