//! S, G96, G97, M3, M4, M5.

use gaugeblock_vocabulary::{FaultKind, Lathe, SpindleLimit, SpindleMode, SpindleTurn};

use super::{clear_orientation, whole, word};
use crate::ids::{Rule, choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::Spindle;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Sets the spindle mode and the speed.
///
/// Rule spindle.speed. S holds until another S, and neither starts nor stops the spindle
/// (spindle.speed-starts-nothing). Rule spindle.speed-selected. Without $ it is the speed of spindle 0. Rule
/// spindle.surface-speed. G96 with S selects constant surface speed; G97 selects revolutions per minute
/// (spindle.rpm-mode).
///
/// # Errors
/// Rules spindle.speed-negative, spindle.surface-speed-needs-speed, spindle.out-of-range.
pub fn set_speed(words: &Words, state: &mut State) -> Result<(), StepError> {
    let speed = word(words, 's');
    if let Some(speed) = speed.filter(|speed| *speed < 0.0) {
        let message = format!("the spindle speed S must not be negative: {speed}");
        return Err(refuse(rule::spindle::SPEED_NEGATIVE, FaultKind::WordOutOfRange, message));
    }
    let surface = words.g_tenths.contains(&960);
    let spindles = state.dialect().spindles_of_speed(words, state)?;
    if surface {
        surface_speed(words, speed, state)?;
    }
    let limit = word(words, 'd').filter(|_| surface);
    if limit.is_some_and(|limit| limit < 0.0) {
        return Err(StepError::Unspecified("a limit of G96 below zero".to_owned()));
    }
    let limit = limit.map_or(SpindleLimit::None, SpindleLimit::Rpm);
    if words.g_tenths.contains(&970) {
        rpm_mode(speed, state)?;
    }
    for place in spindles {
        let spindle = &mut state.modes.spindles[place];
        if surface {
            *spindle = Spindle { mode: SpindleMode::SurfaceSpeed, limit, ..*spindle };
        } else if words.g_tenths.contains(&970) {
            *spindle = Spindle { mode: SpindleMode::Rpm, limit, ..*spindle };
        }
        if let Some(speed) = speed {
            state.dialect().set_speed_of(place, speed, state);
        }
    }
    if let Some(speed) = speed {
        for rule in [
            rule::spindle::SPEED,
            rule::spindle::SPEED_SELECTED,
            rule::spindle::SPEED_STARTS_NOTHING,
        ] {
            state.coverage.accepted(rule);
        }
        if speed == 0.0 {
            state.coverage.accepted(rule::spindle::SPEED_ZERO);
        }
    }
    Ok(())
}

/// Rule spindle.rpm-mode-speed. Whether G97 needs S is a choice.
fn rpm_mode(speed: Option<f64>, state: &mut State) -> Result<(), StepError> {
    let rule = rule::spindle::RPM_MODE_SPEED;
    if speed.is_none() && state.choices.is(choice::spindle::RpmModeSpeed::Required) {
        return Err(refuse(rule, FaultKind::MissingWord, "G97 needs S"));
    }
    state.coverage.accepted(rule);
    state.coverage.accepted(rule::spindle::RPM_MODE);
    Ok(())
}

/// Rule spindle.surface-speed-needs-speed. G96 needs S.
/// Rule spindle.surface-speed-lathe. Diameter mode changes neither.
/// Rule spindle.surface-speed-limit. D is the highest speed in revolutions per minute, and optional.
fn surface_speed(words: &Words, speed: Option<f64>, state: &mut State) -> Result<(), StepError> {
    if speed.is_none() {
        let rule = rule::spindle::SURFACE_SPEED_NEEDS_SPEED;
        return Err(refuse(rule, FaultKind::MissingWord, "G96 needs S"));
    }
    state.coverage.accepted(rule::spindle::SURFACE_SPEED_NEEDS_SPEED);
    state.coverage.accepted(rule::spindle::SURFACE_SPEED);
    if state.modes.lathe == Lathe::Diameter {
        state.coverage.accepted(rule::spindle::SURFACE_SPEED_LATHE);
    }
    if word(words, 'd').is_some() {
        state.coverage.accepted(rule::spindle::SURFACE_SPEED_LIMIT);
    }
    if word(words, '$').is_some() {
        state.coverage.accepted(rule::spindle::SURFACE_SPEED_SELECTED);
    }
    Ok(())
}

/// Starts and stops spindles.
///
/// Rule spindle.start. M3 starts clockwise and M4 counterclockwise, at the S speed, which may be zero
/// (spindle.start-at-zero). Rule spindle.stop. M5 stops. Each is allowed in any state (spindle.repeated).
///
/// # Errors
/// Rules spindle.out-of-range and spindle.minus-one.
pub fn turn(words: &Words, state: &mut State) -> Result<(), StepError> {
    let (turn, rule) = if words.m.contains(&3) {
        (SpindleTurn::Clockwise, rule::spindle::START)
    } else if words.m.contains(&4) {
        (SpindleTurn::Counterclockwise, rule::spindle::START)
    } else {
        (SpindleTurn::Stopped, rule::spindle::STOP)
    };
    let spindles = match word(words, '$') {
        Some(number) => chosen(number, state)?,
        None => without_dollar(state),
    };
    state.coverage.accepted(rule);
    for place in spindles {
        let spindle = state.modes.spindles[place];
        let repeated = (spindle.turn == SpindleTurn::Stopped) == (turn == SpindleTurn::Stopped);
        state.dialect().set_turn(turn, place, state);
        let at_zero = turn != SpindleTurn::Stopped && spindle.speed == 0.0;
        if repeated {
            state.coverage.accepted(rule::spindle::REPEATED);
        }
        if at_zero {
            state.coverage.accepted(rule::spindle::START_AT_ZERO);
        }
    }
    Ok(())
}

/// Rule spindle.without-dollar. Which spindles M3, M4 and M5 without $ act on is a choice.
fn without_dollar(state: &mut State) -> Vec<usize> {
    state.coverage.accepted(rule::spindle::WITHOUT_DOLLAR);
    if state.choices.is(choice::spindle::WithoutDollar::All) {
        state.all_spindles()
    } else {
        vec![0]
    }
}

/// The spindles that $ names.
///
/// Rule spindle.minus-one. What -1 means is a choice. Rule spindle.selected. Any other number is that spindle.
fn chosen(number: f64, state: &mut State) -> Result<Vec<usize>, StepError> {
    if whole(number) == Some(-1) {
        let rule = rule::spindle::MINUS_ONE;
        if state.choices.is(choice::spindle::MinusOne::All) {
            state.coverage.accepted(rule);
            return Ok(state.all_spindles());
        }
        return Err(refuse(rule, FaultKind::SpindleOutOfRange, "$-1 names no spindle"));
    }
    Ok(vec![one(number, state)?])
}

/// The spindle that $ names. -1 is none to S, G96 and G97: only M3, M4 and M5 say what it means.
fn one(number: f64, state: &mut State) -> Result<usize, StepError> {
    let place = state.dialect().named_spindle(number, state, rule::spindle::OUT_OF_RANGE)?;
    state.coverage.accepted(rule::spindle::OUT_OF_RANGE);
    state.coverage.accepted(rule::spindle::SELECTED);
    Ok(place)
}

/// Operations on spindles that a dialect can replace.
pub(crate) trait SpindleRules {
    /// The spindles whose mode and speed a block sets: the one that $ names, or spindle 0.
    fn spindles_of_speed(&self, words: &Words, state: &mut State) -> Result<Vec<usize>, StepError> {
        Ok(vec![match word(words, '$') {
            Some(number) => one(number, state)?,
            None => 0,
        }])
    }

    /// Rule spindle.speed. The S of a spindle holds until another one.
    fn set_speed_of(&self, place: usize, speed: f64, state: &mut State) {
        state.modes.spindles[place].speed = speed;
    }

    /// Starts or stops a spindle, which ends an orientation.
    fn set_turn(&self, turn: SpindleTurn, place: usize, state: &mut State) {
        state.modes.spindles[place].turn = turn;
        clear_orientation(place, state);
    }

    /// Rule orient.replaces-turning. How a spindle is commanded to turn: one that is oriented is not.
    fn commanded_turn(&self, place: usize, state: &State) -> SpindleTurn {
        state.modes.spindles[place].turn
    }

    /// How a spindle turns, as far as the interpreter knows.
    fn known_turn(&self, place: usize, state: &State) -> SpindleTurn {
        state.modes.spindles[place].turn
    }

    /// Rule spindle.out-of-range. $ must be the number of a spindle that the machine has, from 0; the rule that refuses
    /// it is given, since other chapters say the same.
    fn named_spindle(&self, number: f64, state: &State, rule: Rule) -> Result<usize, StepError> {
        let place = whole(number).and_then(|whole| usize::try_from(whole).ok());
        place.filter(|place| *place < state.modes.spindles.len()).ok_or_else(|| {
            let message = format!("the machine has no spindle {number}");
            refuse(rule, FaultKind::SpindleOutOfRange, message)
        })
    }
}
