//! Quirks of canned cycles.

use gaugeblock_vocabulary::{
    Axis, Distance, Effect, FaultKind, FeedMode, PathControlMode, Plane, Position,
};

use super::path::tolerances_as_numbers;
use super::task::machine_point_in_mm;
use super::{HasQuirk, Observed};
use crate::dialects::quirk;
use crate::ids::{Rule, rule};
use crate::rs274::dialect::Documented;
use crate::rs274::evaluate::Words;
use crate::rs274::execute::cycles::{Cycle, CycleRules, Kind, Places, traverse_along};
use crate::rs274::execute::{whole, word};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::task::Record;

impl CycleRules for Observed {
    /// Quirk rs274.cycle-dollar. $ in the block of a cycle has no effect.
    /// Quirk rs274.chosen-spindle. Without $ the cycle uses the spindle that an earlier block chose.
    fn spindle_of_cycle(&self, words: &Words, state: &mut State) -> Result<usize, StepError> {
        if word(words, '$').is_none() || state.has_quirk(quirk::rs274::CYCLE_DOLLAR) {
            return Ok(state.memory.chosen_spindle);
        }
        Documented.spindle_of_cycle(words, state)
    }

    /// Quirk rs274.tap-dwell-kept. A tap without P dwells as long as the last cycle that had a P.
    fn dwell_of_cycle(
        &self,
        kind: Kind,
        words: &Words,
        before: Option<f64>,
        state: &mut State,
    ) -> Result<Option<f64>, StepError> {
        let dwell = Documented.dwell_of_cycle(kind, words, before, state)?;
        if let Some(seconds) = dwell {
            state.memory.cycle_dwell = seconds;
        }
        let taps = matches!(kind, Kind::TapLeft | Kind::TapRight);
        let kept = (taps && state.has_quirk(quirk::rs274::TAP_DWELL_KEPT))
            .then_some(state.memory.cycle_dwell);
        Ok(dwell.or(kept))
    }

    /// Quirk rs274.cycle-negative-dwell. A negative dwell is accepted, unless it is -1.
    fn check_cycle_dwell(&self, seconds: f64, state: &State) -> Result<(), StepError> {
        if whole(seconds) != Some(-1) && state.has_quirk(quirk::rs274::CYCLE_NEGATIVE_DWELL) {
            return Ok(());
        }
        Documented.check_cycle_dwell(seconds, state)
    }

    /// Quirk rs274.peck-rounding. A stroke that ends above the bottom by a rounding error is not the last.
    fn is_last_peck(&self, left: f64, state: &State) -> bool {
        if state.has_quirk(quirk::rs274::PECK_ROUNDING) {
            return left <= 0.0;
        }
        Documented.is_last_peck(left, state)
    }

    /// Quirk rs274.unused-q-minus-one. In a cycle, too, Q-1 counts as no Q.
    fn programmed_peck(&self, words: &Words, state: &State) -> Option<f64> {
        let peck = Documented.programmed_peck(words, state);
        let is_none = peck == Some(-1.0) && state.has_quirk(quirk::rs274::UNUSED_Q_MINUS_ONE);
        peck.filter(|_| !is_none)
    }

    /// Quirk rs274.cycle-retract-from-initial. Incremental R is measured from the level at which the series of cycles
    /// began.
    fn incremental_retract_from(&self, current: f64, initial: f64, state: &State) -> f64 {
        if state.has_quirk(quirk::rs274::CYCLE_RETRACT_FROM_INITIAL) {
            return initial;
        }
        Documented.incremental_retract_from(current, initial, state)
    }

    /// Quirk rs274.cycle-rise. The level at which the series of cycles began decides whether the tool rises, not the
    /// current one. In a series that began above R, the first move in the plane rises to the clear height on its way if
    /// it begins at R or below.
    fn preliminary_motion(&self, cycle: &Cycle, state: &mut State, record: &mut Record) {
        if !state.has_quirk(quirk::rs274::CYCLE_RISE) {
            return Documented.preliminary_motion(cycle, state, record);
        }
        let [_, _, normal] = cycle.axes;
        if cycle.initial < cycle.retract {
            return traverse_along(normal, cycle.retract, state, record);
        }
        let height = state.position.get_mut(normal);
        if *height <= cycle.retract {
            *height = cycle.clear;
        }
    }

    /// Quirk nist.cycle-under-compensation. A cycle is accepted while the cutter is compensated.
    /// Quirk nist.inverse-time-cycle. A cycle is accepted under inverse time.
    fn accepts_cycle(&self, against: Rule, state: &State) -> bool {
        let quirks = [
            (rule::cycles::UNDER_COMPENSATION, quirk::nist::CYCLE_UNDER_COMPENSATION),
            (rule::cycles::INVERSE_TIME, quirk::nist::INVERSE_TIME_CYCLE),
        ];
        quirks.iter().any(|(rule, quirk)| *rule == against && state.has_quirk(*quirk))
    }

    /// Quirk nist.inverse-time-cycle. A cycle under inverse time needs no F, and feeds at the earlier rate.
    fn check_cycle_feed(&self, words: &Words, state: &mut State) -> Result<(), StepError> {
        let is_inverse_time = state.modes.feed_mode == FeedMode::InverseTime;
        if is_inverse_time && state.has_quirk(quirk::nist::INVERSE_TIME_CYCLE) {
            return Ok(());
        }
        Documented.check_cycle_feed(words, state)
    }

    /// Quirk nist.cycle-repeats-last-word. In incremental distance mode an axis without a word repeats the number of
    /// its last word, from any block.
    fn increment_in_plane(&self, axis: Axis, word: Option<f64>, state: &State) -> Option<f64> {
        let place = [Axis::X, Axis::Y, Axis::Z].iter().position(|known| *known == axis);
        let is_incremental = state.modes.distance == Distance::Incremental;
        let repeats = word.is_none()
            && is_incremental
            && state.has_quirk(quirk::nist::CYCLE_REPEATS_LAST_WORD);
        match place {
            Some(place) if repeats => Some(state.memory.last_words[place]),
            _ => Documented.increment_in_plane(axis, word, state),
        }
    }

    /// Quirk rs274.cycle-exact-path. A cycle is executed on the exact path, and G64 is programmed again after it.
    /// Quirk linuxcnc.tap-in-parallel-plane. Taps are refused in the planes of U, V and W.
    fn perform_repeats(
        &self,
        cycle: &Cycle,
        places: &mut Places<'_>,
        state: &mut State,
        record: &mut Record,
    ) -> Result<(), StepError> {
        let taps = matches!(cycle.kind, Kind::TapLeft | Kind::TapRight);
        let is_parallel = matches!(state.modes.plane, Plane::Uv | Plane::Wu | Plane::Vw);
        if taps && is_parallel && state.has_quirk(quirk::linuxcnc::TAP_IN_PARALLEL_PLANE) {
            let message = "no tap in the planes of U, V and W".to_owned();
            return Err(refuse(rule::cycles::PLANE, FaultKind::ModalConflict, message));
        }
        let is_exact = state.has_quirk(quirk::rs274::CYCLE_EXACT_PATH);
        let path =
            is_exact.then(|| std::mem::replace(&mut state.modes.path, PathControlMode::ExactPath));
        Documented.perform_repeats(cycle, places, state, record)?;
        if taps && has_other_axes(state) {
            state.memory.led_to = Some(machine_point_in_mm(&state.modes, in_other_order(state)));
        }
        if let Some(path) = path {
            if path == PathControlMode::Continuous {
                tolerances_as_numbers(state);
            }
            state.modes.path = path;
        }
        Ok(())
    }

    /// Quirk rs274.tap-axes. Outside of the XY plane the reported end point has its axes in another order. The
    /// controlled point is nevertheless correct.
    fn feed_tap(&self, normal: Axis, to: f64, state: &mut State, record: &mut Record) {
        if !has_other_axes(state) {
            return Documented.feed_tap(normal, to, state, record);
        }
        *state.position.get_mut(normal) = to;
        record.effect(state, Effect::StraightFeed { end: in_other_order(state) });
    }
}

/// Quirk rs274.tap-axes. Whether the end points of taps have their axes in another order.
fn has_other_axes(state: &State) -> bool {
    matches!(state.modes.plane, Plane::Zx | Plane::Yz) && state.has_quirk(quirk::rs274::TAP_AXES)
}

/// The controlled point, with its axes in another order.
fn in_other_order(state: &State) -> Position {
    let Position { x, y, z, .. } = state.position;
    let [x, y, z] = if state.modes.plane == Plane::Zx { [y, z, x] } else { [z, x, y] };
    Position { x, y, z, ..state.position }
}
