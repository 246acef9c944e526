//! M2 and M30.

use gaugeblock_vocabulary::{
    Compensation, ControllerMode, Distance, Effect, FeedMode, Motion, Plane, SpindleTurn, Switch,
};

use super::local_offset::suspend_offset;
use super::offsets::use_system;
use super::outputs;
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Ends the program.
///
/// Rule program-end.pallet. M30 exchanges the pallet shuttles before it ends the program.
/// Rule program-end.mode. The controller changes from auto mode to MDI mode.
pub fn perform(words: &Words, state: &mut State, record: &mut Record) {
    if state.frames.iter().any(|frame| frame.restore_at_return.is_some()) {
        state.coverage.accepted(rule::saved_state::AUTORESTORE_PROGRAM_END);
    }
    state.dialect().reset_at_end(state);
    outputs::program_ends(state);
    state.coverage.accepted(rule::program_end::PALLET);
    if !words.m.contains(&2) {
        record.effect(state, Effect::PalletShuttle {});
    }
    state.coverage.accepted(rule::program_end::MODE);
    state.dialect().change_mode_at_end(state, record);
    record.effect(state, Effect::ProgramEnd {});
}

/// Operations of the program end that a dialect can replace.
pub(crate) trait ProgramEndRules {
    /// The list of effects, in its order.
    ///
    /// Rules program-end.work-offset, program-end.plane, program-end.distance, program-end.feed-mode,
    /// program-end.overrides, program-end.compensation, program-end.spindle, program-end.motion, program-end.coolant.
    /// On a machine with several spindles it is a choice which of them stop. Rules program-end.kept and
    /// program-end.feed-kept. What the list leaves out stays. Rule offsets.local-persists. So does the local offset,
    /// unless it is cancelled by choice: rule program-end.local-offset.
    fn reset_at_end(&self, state: &mut State) {
        for rule in [
            rule::program_end::WORK_OFFSET,
            rule::program_end::PLANE,
            rule::program_end::DISTANCE,
            rule::program_end::FEED_MODE,
            rule::program_end::OVERRIDES,
            rule::program_end::COMPENSATION,
            rule::program_end::SPINDLE,
            rule::program_end::MOTION,
            rule::program_end::COOLANT,
            rule::program_end::KEPT,
            rule::program_end::FEED_KEPT,
            rule::program_end::PARAMETERS_KEPT,
        ] {
            state.coverage.accepted(rule);
        }
        if state.modes.local_applies {
            state.coverage.accepted(rule::program_end::LOCAL_OFFSET);
            if state.choices.is(choice::program_end::LocalOffset::Suspended) {
                suspend_offset(state);
            } else {
                state.coverage.accepted(rule::offsets::LOCAL_PERSISTS);
            }
        }
        state.dialect().select_first_system(state);
        let every = state.choices.is(choice::program_end::Spindles::All);
        let stopped = if every { state.all_spindles() } else { vec![0] };
        per_minute(state);
        state.dialect().enable_overrides_at_end(state);
        let modes = &mut state.modes;
        modes.plane = Plane::Xy;
        modes.distance = Distance::Absolute;
        modes.compensation = Compensation::Off;
        modes.motion = Motion::Feed;
        modes.mist = Switch::Off;
        modes.flood = Switch::Off;
        for place in stopped {
            state.dialect().set_turn(SpindleTurn::Stopped, place, state);
        }
    }

    /// Rule program-end.work-offset. The first coordinate system is selected.
    fn select_first_system(&self, state: &mut State) {
        use_system(1, state);
    }

    /// Rule program-end.overrides. Feed override and speed overrides are enabled.
    fn enable_overrides_at_end(&self, state: &mut State) {
        state.modes.feed_override = Switch::On;
        state.dialect().feed_override_is_set(state);
        for spindle in &mut state.modes.spindles {
            spindle.speed_override = Switch::On;
        }
    }

    /// Rule program-end.mode. The controller changes from auto mode to MDI mode.
    fn change_mode_at_end(&self, state: &mut State, record: &mut Record) {
        if state.modes.controller_mode != ControllerMode::Mdi {
            state.modes.controller_mode = ControllerMode::Mdi;
            record.effect(state, Effect::ChangeControllerMode { mode: ControllerMode::Mdi });
        }
    }
}

/// Rule program-end.feed-mode. The feed counts per minute.
/// Choice program-end.feed-after-mode-change: what becomes of F where the feed mode was another one.
fn per_minute(state: &mut State) {
    if state.modes.feed_mode != FeedMode::PerMinute {
        state.modes.feed_rate = match state.choices.get() {
            choice::program_end::FeedAfterModeChange::Zero => 0.0,
            choice::program_end::FeedAfterModeChange::Kept => state.modes.feed_rate,
            choice::program_end::FeedAfterModeChange::OfLastMove => state.move_rate,
        };
    }
    state.modes.feed_mode = FeedMode::PerMinute;
}
