//! What a restore brings back, item by item.

use gaugeblock_vocabulary::{Motion, Path, SpindleTurn, Switch};

use super::offsets::use_system;
use super::orient;
use super::tool_length::apply;
use super::units_planes::use_units;
use crate::rs274::modes::{Modes, Spindle};
use crate::rs274::quirks::{saved_state as quirks, settings};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// Brings back the saved state.
///
/// Rule saved-state.all-restored. All of it, not a part. Rule saved-state.units-before-feed. The length unit comes
/// first, so that feed, offsets and tolerances count in the unit in which they were saved. Rule
/// saved-state.not-listed. What the list leaves out stays: parameters and offset values, the prepared tool, the
/// position.
///
/// # Errors
/// None where the documents are followed; a restore as `rs274` does it can fail.
pub(crate) fn restore(saved: &Modes, state: &mut State) -> Result<(), StepError> {
    let changed: Vec<_> = ITEMS.iter().filter(|(_, same)| !same(&state.modes, saved)).collect();
    for (rule, _) in changed {
        state.coverage.accepted(rule);
    }
    use_units(saved.units, state);
    let disabled = quirks::disabled_by_path(saved, &state.modes, state);
    quirks::plane(saved, state)?;
    quirks::system(saved, state)?;
    coordinates(saved, state)?;
    state.modes.plane = saved.plane;
    state.modes.distance = saved.distance;
    state.modes.arc_distance = saved.arc_distance;
    quirks::retract(saved, state)?;
    state.modes.retract = saved.retract;
    state.modes.lathe = saved.lathe;
    quirks::path_refused(saved, state)?;
    path(saved, state);
    compensation(saved, state);
    feed(saved, state);
    spindles(saved, state)?;
    coolant(saved, state);
    overrides(saved, state);
    if let Some(control) = disabled {
        quirks::disable(control, state);
    }
    motion(saved, state);
    state.coverage.accepted("saved-state.all-restored");
    state.coverage.accepted("saved-state.not-listed");
    Ok(())
}

/// A rule about an item, and whether the item is the same in two states.
type Item = (&'static str, fn(&Modes, &Modes) -> bool);

/// The list of the saved state: a rule for each item. A rule is reached when a restore changes its item.
const ITEMS: &[Item] = &[
    ("saved-state.units", |a, b| a.units == b.units),
    ("saved-state.units-before-feed", |a, b| a.units == b.units),
    ("saved-state.plane", |a, b| a.plane == b.plane),
    ("saved-state.compensation", |a, b| a.compensation == b.compensation),
    ("saved-state.distance", |a, b| a.distance == b.distance),
    ("saved-state.feed-mode", |a, b| a.feed_mode == b.feed_mode),
    ("saved-state.feed-of-feed-mode", |a, b| a.feed_mode == b.feed_mode),
    ("saved-state.work-offset", |a, b| a.work_offset == b.work_offset),
    ("saved-state.tool-length", |a, b| {
        a.tool_length == b.tool_length && a.tool_offset == b.tool_offset
    }),
    ("saved-state.retract", |a, b| a.retract == b.retract),
    ("saved-state.spindle-mode", |a, b| same_spindles(a, b, |a, b| a.mode == b.mode)),
    ("saved-state.spindle-limit", |a, b| same_spindles(a, b, |a, b| a.limit == b.limit)),
    ("saved-state.arc-distance", |a, b| a.arc_distance == b.arc_distance),
    ("saved-state.lathe", |a, b| a.lathe == b.lathe),
    ("saved-state.path", |a, b| a.path == b.path),
    ("saved-state.path-tolerances", |a, b| {
        same(a.blend_tolerance, b.blend_tolerance)
            && same(a.naive_cam_tolerance, b.naive_cam_tolerance)
    }),
    ("saved-state.feed", |a, b| same(a.feed_rate, b.feed_rate)),
    ("saved-state.speed", |a, b| same_spindles(a, b, |a, b| same(a.speed, b.speed))),
    ("saved-state.spindle-status", |a, b| same_spindles(a, b, |a, b| a.turn == b.turn)),
    ("saved-state.each-spindle", |a, b| a.spindles[1..] == b.spindles[1..]),
    ("saved-state.mist", |a, b| a.mist == b.mist),
    ("saved-state.flood", |a, b| a.flood == b.flood),
    ("saved-state.feed-override", |a, b| a.feed_override == b.feed_override),
    ("saved-state.speed-override", |a, b| {
        same_spindles(a, b, |a, b| a.speed_override == b.speed_override)
    }),
    ("saved-state.mixed-overrides", |a, b| {
        a.feed_override == b.feed_override
            && same_spindles(a, b, |a, b| a.speed_override == b.speed_override)
    }),
    ("saved-state.adaptive-feed", |a, b| a.adaptive_feed == b.adaptive_feed),
    ("saved-state.feed-stop", |a, b| a.feed_stop == b.feed_stop),
];

/// Whether two numbers are the same, apart from what a change of the length unit there and back leaves.
pub(crate) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs())
}

fn same_spindles(a: &Modes, b: &Modes, same: impl Fn(&Spindle, &Spindle) -> bool) -> bool {
    a.spindles.iter().zip(&b.spindles).all(|(a, b)| same(a, b))
}

/// Rule saved-state.work-offset. The coordinate system comes back, with the origin that it has now.
/// Rule saved-state.tool-length. Tool length compensation comes back with the offset that was in force.
fn coordinates(saved: &Modes, state: &mut State) -> Result<(), StepError> {
    if state.modes.work_offset != saved.work_offset {
        use_system(saved.work_offset, state);
    }
    if state.choices.quirk("rs274.local-offset-restore") {
        quirks::local_offset(saved, state);
    }
    let cancelled = saved.tool_length == Switch::Off;
    if cancelled && state.choices.quirk("rs274.tool-offset-unit") {
        settings::tool_offset_as_programmed(state);
    }
    if state.choices.quirk("rs274.tool-offset-restore") {
        return quirks::tool_offset(saved, state);
    }
    apply((saved.tool_length == Switch::On).then_some(saved.tool_offset), state);
    Ok(())
}

/// Rule saved-state.path. The mode comes back.
/// Rule saved-state.path-tolerances. G64 comes back with both tolerances; the other modes have none.
fn path(saved: &Modes, state: &mut State) {
    if state.choices.quirk("rs274.tolerance-unit") {
        return quirks::path(saved, state);
    }
    state.modes.path = saved.path;
    if saved.path == Path::Continuous {
        state.modes.blend_tolerance = saved.blend_tolerance;
        state.modes.naive_cam_tolerance = saved.naive_cam_tolerance;
        state.modes.tolerance_unit = saved.tolerance_unit;
    }
}

/// Rule saved-state.compensation. Off, left and right come back, dynamic or not.
fn compensation(saved: &Modes, state: &mut State) {
    if state.choices.quirk("rs274.dynamic-compensation-restore") {
        return quirks::compensation(saved, state);
    }
    state.modes.compensation = saved.compensation;
    state.modes.compensation_radius = saved.compensation_radius;
}

/// Rules saved-state.feed-mode and saved-state.feed.
/// Rule saved-state.feed-of-feed-mode. The feed comes back together with the mode in which it was given.
fn feed(saved: &Modes, state: &mut State) {
    let choices = &state.choices;
    if quirks::FEED.iter().any(|quirk| choices.quirk(quirk)) {
        return quirks::feed(saved, state);
    }
    state.modes.feed_mode = saved.feed_mode;
    state.modes.feed_rate = saved.feed_rate;
    state.modes.feed_number = saved.feed_number;
    state.modes.feed_awaited = saved.feed_awaited;
}

/// Rules saved-state.speed, saved-state.spindle-mode with saved-state.spindle-limit, and saved-state.spindle-status.
/// Rule saved-state.each-spindle. Those of every spindle. Whichever of M3, M4 and M5 comes back takes M19's place in
/// their group, and unlocks the spindle (orient.cleared).
fn spindles(saved: &Modes, state: &mut State) -> Result<(), StepError> {
    if quirks::SPINDLES.iter().any(|quirk| state.choices.quirk(quirk)) {
        return quirks::spindles(saved, state);
    }
    for (place, saved) in saved.spindles.iter().enumerate() {
        let spindle = &mut state.modes.spindles[place];
        let turn = restored_turn(saved.turn, spindle.turn);
        let was_oriented = spindle.turn == SpindleTurn::Oriented;
        *spindle = Spindle { speed_override: spindle.speed_override, turn, ..*saved };
        if saved.turn == SpindleTurn::Oriented {
            state.coverage.accepted("saved-state.orientation-not-saved");
        }
        if was_oriented && turn != SpindleTurn::Oriented {
            orient::clear(place, state);
        }
    }
    Ok(())
}

/// Rule saved-state.orientation-not-saved. What is saved is M3, M4 or M5: a spindle that stood at an angle does not
/// turn.
pub(crate) fn restored_turn(saved: SpindleTurn, now: SpindleTurn) -> SpindleTurn {
    match (saved, now) {
        (SpindleTurn::Oriented, SpindleTurn::Oriented) => SpindleTurn::Oriented,
        (SpindleTurn::Oriented, _) => SpindleTurn::Stopped,
        (turn, _) => turn,
    }
}

/// Rules saved-state.mist and saved-state.flood. Each comes back apart from the other.
/// Rules saved-state.adaptive-feed and saved-state.feed-stop.
fn coolant(saved: &Modes, state: &mut State) {
    if state.choices.quirk("rs274.off-not-restored") {
        return quirks::switches(saved, state);
    }
    state.modes.mist = saved.mist;
    state.modes.flood = saved.flood;
    state.modes.adaptive_feed = saved.adaptive_feed;
    state.modes.feed_stop = saved.feed_stop;
}

/// Rules saved-state.feed-override and saved-state.speed-override. They are saved apart, so that each mixture comes
/// back (saved-state.mixed-overrides).
fn overrides(saved: &Modes, state: &mut State) {
    if state.choices.quirk("rs274.override-restore") {
        return quirks::overrides(saved, state);
    }
    state.modes.feed_override = saved.feed_override;
    for (spindle, saved) in state.modes.spindles.iter_mut().zip(&saved.spindles) {
        spindle.speed_override = saved.speed_override;
    }
}

/// Rule saved-state.motion-mode. Only the draft lists the motion mode; there it comes back, and whether a mode comes
/// back that its list leaves out is a choice.
fn motion(saved: &Modes, state: &mut State) {
    state.coverage.accepted("saved-state.motion-mode");
    let restored = state.choices.is("saved-state.motion-mode", "restored");
    let every = state.choices.is("saved-state.listed-motion", "every");
    if restored && (every || LISTED_MOTION.contains(&saved.motion)) {
        state.modes.motion = saved.motion;
    }
}

/// The motion modes that the draft lists: G1 G2 G3 G5.2 G73 G80 G82 G83 G86 G87 G88 G89.
const LISTED_MOTION: &[Motion] = &[
    Motion::Feed,
    Motion::ArcClockwise,
    Motion::ArcCounterclockwise,
    Motion::Nurbs,
    Motion::Cycle73,
    Motion::None,
    Motion::Cycle82,
    Motion::Cycle83,
    Motion::Cycle86,
    Motion::Cycle87,
    Motion::Cycle88,
    Motion::Cycle89,
];
