//! M2 and M30.

use gaugeblock_vocabulary::{
    Compensation, ControllerMode, Distance, Effect, FeedMode, Motion, Plane, SpindleTurn, Switch,
};

use super::offsets::use_system;
use super::outputs;
use super::spindle::{all, set_turn};
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
        state.coverage.accepted("saved-state.autorestore-program-end");
    }
    reset(state);
    outputs::program_ends(state);
    state.coverage.accepted("program-end.pallet");
    if !words.m.contains(&2) {
        record.effect(state, Effect::PalletShuttle {});
    }
    state.coverage.accepted("program-end.mode");
    let changes = state.modes.controller_mode != ControllerMode::Mdi;
    if changes && !state.choices.quirk("linuxcnc.auto-after-program-end") {
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
        "program-end.work-offset",
        "program-end.plane",
        "program-end.distance",
        "program-end.feed-mode",
        "program-end.overrides",
        "program-end.compensation",
        "program-end.spindle",
        "program-end.motion",
        "program-end.coolant",
        "program-end.kept",
        "program-end.feed-kept",
        "program-end.parameters-kept",
    ] {
        state.coverage.accepted(rule);
    }
    if state.modes.local_applies {
        state.coverage.accepted("offsets.local-persists");
    }
    motion_quirks::turn_system(|state| use_system(1, state), state);
    let every = state.choices.is("program-end.spindles", "all");
    let stopped = if every { all(state) } else { vec![0] };
    let speed_override = !state.choices.quirk("rs274.speed-override-at-end");
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
    if switched && state.choices.is("program-end.feed-after-mode-change", "zero") {
        state.modes.feed_rate = 0.0;
    }
    state.modes.feed_mode = FeedMode::PerMinute;
}
