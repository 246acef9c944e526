//! Canned cycles, G73, G74 and G81 to G89: each is rewritten into traverses, feeds, dwells and
//! settings.
//!
//! A cycle works along three axes of the selected plane, its first, second and normal axis. Heights are positions on
//! the normal axis in program coordinates, active length unit.

mod allowed;
mod cycle;
mod heights;
mod places;
mod strokes;
mod tapping;

use gaugeblock_vocabulary::{Axis, Effect, FaultKind, Motion, PathControlMode, Position};

use super::{feed, word};
use crate::ids::{Rule, choice, rule};
use crate::math::near_integer;
use crate::rs274::evaluate::Words;
use crate::rs274::modes::motion_mode;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;
pub(crate) use cycle::{Cycle, Kind, feed_along, traverse_along};
pub(crate) use places::Places;

/// Each cycle with its kind and its rule.
const KINDS: &[(Motion, Kind, Rule)] = &[
    (Motion::Cycle73, Kind::ChipBreaking, rule::cycles::CHIP_BREAKING),
    (Motion::Cycle74, Kind::TapLeft, rule::cycles::TAP_LEFT),
    (Motion::Cycle81, Kind::Drill, rule::cycles::DRILL),
    (Motion::Cycle82, Kind::DrillDwell, rule::cycles::DRILL_DWELL),
    (Motion::Cycle83, Kind::Peck, rule::cycles::PECK),
    (Motion::Cycle84, Kind::TapRight, rule::cycles::TAP_RIGHT),
    (Motion::Cycle85, Kind::Bore, rule::cycles::BORE),
    (Motion::Cycle86, Kind::BoreSpindleStop, rule::cycles::BORE_SPINDLE_STOP),
    (Motion::Cycle87, Kind::Undefined, rule::cycles::DRILL),
    (Motion::Cycle88, Kind::Undefined, rule::cycles::DRILL),
    (Motion::Cycle89, Kind::BoreDwell, rule::cycles::BORE_DWELL),
];

/// The kind of a motion mode that is a cycle, with the cycle's rule.
fn kind_of(motion: Motion) -> Option<(Kind, Rule)> {
    let found = KINDS.iter().find(|(cycle, ..)| *cycle == motion);
    found.map(|(_, kind, rule)| (*kind, *rule))
}

/// Whether a motion mode is a canned cycle.
pub(crate) fn is_cycle(motion: Motion) -> bool {
    kind_of(motion).is_some()
}

/// Executes a cycle as often as L says, and remembers its sticky numbers.
///
/// Rule cycles.plane. A cycle acts along the normal axis of the selected plane.
/// Rule cycles.repeats-itself. Axis words alone repeat the cycle that is the motion mode.
///
/// # Errors
/// What a cycle is refused for: see `allowed` and `heights`.
pub(super) fn perform(
    motion: Motion,
    words: &Words,
    state: &mut State,
    record: &mut Record,
) -> Result<(), StepError> {
    let (kind, rule) = kind_of(motion).expect("motion: a cycle has a kind");
    if kind == Kind::Undefined {
        let what = "what G87 and G88 do, which the manual calls undefined";
        return Err(StepError::Unspecified(what.to_owned()));
    }
    allowed::check(words, state)?;
    let repeats = repeats(words, state)?;
    let (series, cycle) = heights::find(motion, kind, words, state)?;
    let mut places = Places::new(words, state, &cycle, repeats)?;
    state.dialect().check_cycle_feed(words, state)?;
    strokes::check_spindle(&cycle, state)?;
    state.modes.motion = motion;
    state.series = Some(series);
    accepted(words, rule, state);
    state.coverage.accepted(rule::cycles::PRELIMINARY_MOTION);
    state.dialect().preliminary_motion(&cycle, state, record);
    state.dialect().perform_repeats(&cycle, &mut places, state, record)
}

/// The rules of canned cycles that a controller may follow differently.
pub(crate) trait CycleRules {
    /// Rule cycles.spindle. $ names the spindle of G74, G84 and G86; without it that is spindle 0.
    fn spindle_of_cycle(&self, words: &Words, state: &mut State) -> Result<usize, StepError> {
        let rule = rule::cycles::SPINDLE;
        let Some(number) = word(words, '$') else { return Ok(0) };
        let place = state.dialect().named_spindle(number, state, rule)?;
        state.coverage.accepted(rule);
        Ok(place)
    }

    /// P of a cycle that dwells, as its block or an earlier one of the row has it; none where it does not dwell, or for
    /// zero seconds without P.
    fn dwell_of_cycle(
        &self,
        kind: Kind,
        words: &Words,
        before: Option<f64>,
        state: &mut State,
    ) -> Result<Option<f64>, StepError> {
        strokes::dwell(kind, words, before, state)
    }

    /// Rule cycles.negative-dwell. P is not negative.
    fn check_cycle_dwell(&self, seconds: f64, _state: &State) -> Result<(), StepError> {
        if seconds < 0.0 {
            let message = format!("the dwell P must not be negative: {seconds} seconds");
            return Err(refuse(rule::cycles::NEGATIVE_DWELL, FaultKind::WordOutOfRange, message));
        }
        Ok(())
    }

    /// Rules cycles.peck and cycles.chip-breaking. Whether so little is left above the bottom that the next stroke ends
    /// there: not more than a rounding error.
    fn is_last_peck(&self, left: f64, _state: &State) -> bool {
        left <= strokes::REACHED
    }

    /// Q as a block of G73 or G83 programs it.
    fn programmed_peck(&self, words: &Words, _state: &State) -> Option<f64> {
        word(words, 'q')
    }

    /// Rule cycles.incremental. The position on the normal axis that R counts from in incremental distance mode: the
    /// current one, not the initial level of the row.
    fn incremental_retract_from(&self, current: f64, _initial: f64, _state: &State) -> f64 {
        current
    }

    /// Rule cycles.preliminary-motion. Where the controlled point is below R it first rises to R, once for all repeats.
    fn preliminary_motion(&self, cycle: &Cycle, state: &mut State, record: &mut Record) {
        let [_, _, normal] = cycle.axes;
        if state.position.get(normal) < cycle.retract {
            traverse_along(normal, cycle.retract, state, record);
        }
    }

    /// Whether the controller accepts a cycle that this rule refuses.
    fn accepts_cycle(&self, _against: Rule, _state: &State) -> bool {
        false
    }

    /// Checks that a cycle has a feed rate, as other feed moves have. Choice cycles.feed-rate: or that needs none.
    ///
    /// # Errors
    /// The feed mode needs a rate, and none is programmed.
    fn check_cycle_feed(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        if state.choices.is(choice::cycles::FeedRate::Any) {
            return Ok(());
        }
        feed::check_feed_rate(words, state)
    }

    /// Rule cycles.incremental. The number that a block has for an axis of the plane: that of its word.
    fn increment_in_plane(&self, _axis: Axis, word: Option<f64>, _state: &State) -> Option<f64> {
        word
    }

    /// Rule cycles.repeat. Executes a cycle at each of its places.
    /// Choice cycles.path-mode. It may do so on the exact path, whatever the mode of the program.
    fn perform_repeats(
        &self,
        cycle: &Cycle,
        places: &mut Places<'_>,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        let path = state.modes.path;
        if state.choices.is(choice::cycles::PathMode::ExactPath) {
            state.modes.path = PathControlMode::ExactPath;
        }
        while let Some(place) = places.next(state)? {
            if record.is_full() {
                return Err(StepError::TooManyEffects);
            }
            in_between_motion(cycle, place, state, record);
            strokes::perform(cycle, state, record)?;
        }
        state.modes.path = path;
        Ok(())
    }

    /// Rules cycles.tap-right and cycles.tap-left. A tap feeds along the normal axis.
    fn feed_tap(&self, normal: Axis, to: f64, state: &mut State, record: &mut Record) {
        feed_along(normal, to, state, record);
    }
}

/// Rule cycles.repeat-count. L is a positive integer, however large: the budget bounds what is executed of it.
/// Rule cycles.repeat-not-sticky. Without it the cycle is executed once.
fn repeats(words: &Words, state: &mut State) -> Result<u64, StepError> {
    let rule = rule::cycles::REPEAT_COUNT;
    let Some(value) = word(words, 'l') else {
        state.coverage.accepted(rule::cycles::REPEAT_NOT_STICKY);
        return Ok(1);
    };
    let number = near_integer(value).ok_or_else(|| {
        refuse(rule, FaultKind::NotAnInteger, format!("L{value} is not a number of repeats"))
    })?;
    let count = u64::try_from(number).ok().filter(|count| *count > 0).ok_or_else(|| {
        refuse(rule, FaultKind::WordOutOfRange, format!("{number} repeats of a cycle"))
    })?;
    state.coverage.accepted(rule);
    Ok(count)
}

/// Rule cycles.in-between-motion. Each repeat begins with a traverse in the plane, and one along the normal axis to R,
/// unless it is there already.
fn in_between_motion(cycle: &Cycle, place: [f64; 2], state: &mut State, record: &mut Record) {
    let [first, second, normal] = cycle.axes;
    let mut end = state.position;
    *end.get_mut(first) = place[0];
    *end.get_mut(second) = place[1];
    traverse(end, state, record);
    if (end.get(normal) - cycle.retract).abs() > 0.0 {
        traverse_along(normal, cycle.retract, state, record);
    }
    state.coverage.accepted(rule::cycles::IN_BETWEEN_MOTION);
}

fn traverse(end: Position, state: &mut State, record: &mut Record) {
    state.position = end;
    record.effect(state, Effect::StraightTraverse { end });
}

/// The rules that an accepted cycle follows.
fn accepted(words: &Words, rule: Rule, state: &mut State) {
    if words.g_tenths.iter().all(|code| motion_mode(*code).is_none()) {
        state.coverage.accepted(rule::cycles::REPEATS_ITSELF);
    }
    let of_all = [
        rule::cycles::PLANE,
        rule::cycles::RETURN_LEVEL,
        rule::cycles::INITIAL_LEVEL,
        rule::cycles::REPEAT,
    ];
    state.coverage.accepted(rule);
    for rule in of_all {
        state.coverage.accepted(rule);
    }
}
