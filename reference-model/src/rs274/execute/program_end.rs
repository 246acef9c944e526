//! M2 and M30.

use gaugeblock_vocabulary::{
    Compensation, ControllerMode, Distance, Effect, FeedMode, Motion, Plane, SpindleTurn, Switch,
};

use super::offsets::use_system;
use super::outputs;
use super::spindle::{all, set_turn};
use crate::ids::{choice, quirk, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::quirks::{motion as motion_quirks, settings as quirks};
use crate::rs274::state::State;
use crate::rs274::task::Record;

/// Ends the program.
///
/// Rule program-end.pallet. M30 exchanges the pallet shuttles before it ends the program.
/// Rule program-end.mode. The controller changes from auto mode to MDI mode.
/// Quirk linuxcnc.auto-after-program-end. It stays in auto mode.
pub fn perform(words: &Words, state: &mut State, record: &mut Record) {
    if state.frames.iter().any(|frame| frame.restore_at_return.is_some()) {
        state.coverage.accepted(rule::saved_state::AUTORESTORE_PROGRAM_END);
    }
    reset(state);
    outputs::program_ends(state);
    state.coverage.accepted(rule::program_end::PALLET);
    if !words.m.contains(&2) {
        record.effect(state, Effect::PalletShuttle {});
    }
    state.coverage.accepted(rule::program_end::MODE);
    let changes = state.modes.controller_mode != ControllerMode::Mdi;
    if changes && !state.choices.quirk(quirk::linuxcnc::AUTO_AFTER_PROGRAM_END) {
        state.modes.controller_mode = ControllerMode::Mdi;
        record.effect(state, Effect::ChangeControllerMode { mode: ControllerMode::Mdi });
    }
    record.effect(state, Effect::ProgramEnd {});
}

/// The list of effects, in its order.
///
/// Rules program-end.work-offset, program-end.plane, program-end.distance, program-end.feed-mode,
/// program-end.overrides, program-end.compensation, program-end.spindle, program-end.motion, program-end.coolant. On
/// a machine with several spindles it is a choice which of them stop. Rules program-end.kept and
/// program-end.feed-kept. What the list leaves out stays. Rule offsets.local-persists. So does the local offset.
fn reset(state: &mut State) {
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
        state.coverage.accepted(rule::offsets::LOCAL_PERSISTS);
    }
    motion_quirks::turn_system(|state| use_system(1, state), state);
    let every = state.choices.is(choice::program_end::Spindles::All);
    let stopped = if every { all(state) } else { vec![0] };
    let speed_override = !state.choices.quirk(quirk::rs274::SPEED_OVERRIDE_AT_END);
    per_minute(state);
    let modes = &mut state.modes;
    modes.plane = Plane::Xy;
    modes.distance = Distance::Absolute;
    modes.feed_override = Switch::On;
    if speed_override {
        for spindle in &mut modes.spindles {
            spindle.speed_override = Switch::On;
        }
    }
    modes.compensation = Compensation::Off;
    modes.motion = Motion::Feed;
    modes.mist = Switch::Off;
    modes.flood = Switch::Off;
    for place in stopped {
        set_turn(SpindleTurn::Stopped, place, state);
    }
    quirks::program_end(state);
}

/// Rule program-end.feed-mode. The feed counts per minute.
/// Choice program-end.feed-after-mode-change: whether F keeps its number where it counted otherwise before.
fn per_minute(state: &mut State) {
    let switched = state.modes.feed_mode != FeedMode::PerMinute;
    if switched && state.choices.is(choice::program_end::FeedAfterModeChange::Zero) {
        state.modes.feed_rate = 0.0;
    }
    state.modes.feed_mode = FeedMode::PerMinute;
}
