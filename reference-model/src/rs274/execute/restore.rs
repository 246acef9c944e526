//! What a restore brings back, item by item.

use gaugeblock_vocabulary::{Motion, PathControlMode, SpindleTurn, Switch};

use super::clear_orientation;
use super::offsets::use_system;
use super::units_planes::use_units;
use crate::ids::{Rule, choice, rule};
use crate::rs274::modes::{Modes, Spindle};
use crate::rs274::refusal::StepError;
use crate::rs274::state::State;

/// The restore and its items: a controller may bring back some of them in another way.
pub(crate) trait RestoreRules {
    /// Brings back the saved state.
    ///
    /// Rule saved-state.all-restored. All of it, not a part. Rule saved-state.units-before-feed. The length unit comes
    /// first, so that feed, offsets and tolerances count in the unit in which they were saved. Rule
    /// saved-state.not-listed. What the list leaves out stays: parameters and offset values, the prepared tool, the
    /// position.
    fn restore(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        let changed: Vec<_> = ITEMS.iter().filter(|(_, same)| !same(&state.modes, saved)).collect();
        for (rule, _) in changed {
            state.coverage.accepted(*rule);
        }
        let dialect = state.dialect();
        use_units(saved.units, state);
        dialect.restore_work_offset(saved, state)?;
        dialect.restore_tool_length(saved, state)?;
        state.modes.plane = saved.plane;
        state.modes.distance = saved.distance;
        state.modes.arc_distance = saved.arc_distance;
        dialect.restore_retract(saved, state)?;
        state.modes.lathe = saved.lathe;
        dialect.restore_path(saved, state)?;
        dialect.restore_compensation(saved, state);
        dialect.restore_feed(saved, state);
        dialect.restore_spindles(saved, state)?;
        dialect.restore_switches(saved, state);
        dialect.restore_overrides(saved, state);
        restore_motion(saved, state);
        state.coverage.accepted(rule::saved_state::ALL_RESTORED);
        state.coverage.accepted(rule::saved_state::NOT_LISTED);
        Ok(())
    }

    /// Rule saved-state.work-offset. The coordinate system comes back, with the origin that it has now.
    fn restore_work_offset(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        if state.modes.work_offset != saved.work_offset {
            use_system(saved.work_offset, state);
        }
        Ok(())
    }

    /// Rule saved-state.tool-length. Tool length compensation comes back with the offset that was in force.
    fn restore_tool_length(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        let on = saved.tool_length == Switch::On;
        state.dialect().apply_tool_offset(on.then_some(saved.tool_offset), state);
        Ok(())
    }

    /// Rule saved-state.retract. The return mode of canned cycles comes back.
    fn restore_retract(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        state.modes.retract = saved.retract;
        Ok(())
    }

    /// Rule saved-state.path. The mode comes back.
    /// Rule saved-state.path-tolerances. G64 comes back with both tolerances; the other modes have none.
    fn restore_path(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        state.modes.path = saved.path;
        if saved.path == PathControlMode::Continuous {
            state.modes.blend_tolerance = saved.blend_tolerance;
            state.modes.naive_cam_tolerance = saved.naive_cam_tolerance;
        }
        Ok(())
    }

    /// Rule saved-state.compensation. Off, left and right come back, dynamic or not.
    fn restore_compensation(&self, saved: &Modes, state: &mut State) {
        state.modes.compensation = saved.compensation;
        state.modes.compensation_radius = saved.compensation_radius;
        state.modes.compensation_orientation = saved.compensation_orientation;
    }

    /// Rules saved-state.feed-mode and saved-state.feed.
    /// Rule saved-state.feed-of-feed-mode. The feed comes back together with the mode in which it was given.
    fn restore_feed(&self, saved: &Modes, state: &mut State) {
        state.modes.feed_mode = saved.feed_mode;
        state.modes.feed_rate = saved.feed_rate;
        state.modes.feed_awaited = saved.feed_awaited;
    }

    /// Rules saved-state.speed, saved-state.spindle-mode with saved-state.spindle-limit, and
    /// saved-state.spindle-status. Rule saved-state.each-spindle. Those of every spindle. Whichever of M3, M4 and M5
    /// comes back takes M19's place in their group, and unlocks the spindle (orient.cleared).
    fn restore_spindles(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        for (place, saved) in saved.spindles.iter().enumerate() {
            let spindle = &mut state.modes.spindles[place];
            let turn = restored_turn(saved.turn, spindle.turn);
            let was_oriented = spindle.turn == SpindleTurn::Oriented;
            *spindle = Spindle { speed_override: spindle.speed_override, turn, ..*saved };
            if saved.turn == SpindleTurn::Oriented {
                state.coverage.accepted(rule::saved_state::ORIENTATION_NOT_SAVED);
            }
            if was_oriented && turn != SpindleTurn::Oriented {
                clear_orientation(place, state);
            }
        }
        Ok(())
    }

    /// Rules saved-state.mist and saved-state.flood. Each comes back apart from the other.
    /// Rules saved-state.adaptive-feed and saved-state.feed-stop.
    fn restore_switches(&self, saved: &Modes, state: &mut State) {
        state.modes.mist = saved.mist;
        state.modes.flood = saved.flood;
        state.modes.adaptive_feed = saved.adaptive_feed;
        state.modes.feed_stop = saved.feed_stop;
    }

    /// Rules saved-state.feed-override and saved-state.speed-override. They are saved apart, so that each mixture
    /// comes back (saved-state.mixed-overrides).
    fn restore_overrides(&self, saved: &Modes, state: &mut State) {
        state.modes.feed_override = saved.feed_override;
        state.dialect().feed_override_is_set(state);
        for (spindle, saved) in state.modes.spindles.iter_mut().zip(&saved.spindles) {
            spindle.speed_override = saved.speed_override;
        }
    }
}

/// A rule about an item, and whether the item is the same in two states.
type Item = (Rule, fn(&Modes, &Modes) -> bool);

/// The list of the saved state: a rule for each item. A rule is reached when a restore changes its item.
const ITEMS: &[Item] = &[
    (rule::saved_state::UNITS, |a, b| a.units == b.units),
    (rule::saved_state::UNITS_BEFORE_FEED, |a, b| a.units == b.units),
    (rule::saved_state::PLANE, |a, b| a.plane == b.plane),
    (rule::saved_state::COMPENSATION, |a, b| a.compensation == b.compensation),
    (rule::saved_state::DISTANCE, |a, b| a.distance == b.distance),
    (rule::saved_state::FEED_MODE, |a, b| a.feed_mode == b.feed_mode),
    (rule::saved_state::FEED_OF_FEED_MODE, |a, b| a.feed_mode == b.feed_mode),
    (rule::saved_state::WORK_OFFSET, |a, b| a.work_offset == b.work_offset),
    (rule::saved_state::TOOL_LENGTH, |a, b| {
        a.tool_length == b.tool_length && a.tool_offset == b.tool_offset
    }),
    (rule::saved_state::RETRACT, |a, b| a.retract == b.retract),
    (rule::saved_state::SPINDLE_MODE, |a, b| same_spindles(a, b, |a, b| a.mode == b.mode)),
    (rule::saved_state::SPINDLE_LIMIT, |a, b| same_spindles(a, b, |a, b| a.limit == b.limit)),
    (rule::saved_state::ARC_DISTANCE, |a, b| a.arc_distance == b.arc_distance),
    (rule::saved_state::LATHE, |a, b| a.lathe == b.lathe),
    (rule::saved_state::PATH, |a, b| a.path == b.path),
    (rule::saved_state::PATH_TOLERANCES, |a, b| {
        same(a.blend_tolerance, b.blend_tolerance)
            && same(a.naive_cam_tolerance, b.naive_cam_tolerance)
    }),
    (rule::saved_state::FEED, |a, b| same(a.feed_rate, b.feed_rate)),
    (rule::saved_state::SPEED, |a, b| same_spindles(a, b, |a, b| same(a.speed, b.speed))),
    (rule::saved_state::SPINDLE_STATUS, |a, b| same_spindles(a, b, |a, b| a.turn == b.turn)),
    (rule::saved_state::EACH_SPINDLE, |a, b| a.spindles[1..] == b.spindles[1..]),
    (rule::saved_state::MIST, |a, b| a.mist == b.mist),
    (rule::saved_state::FLOOD, |a, b| a.flood == b.flood),
    (rule::saved_state::FEED_OVERRIDE, |a, b| a.feed_override == b.feed_override),
    (rule::saved_state::SPEED_OVERRIDE, |a, b| {
        same_spindles(a, b, |a, b| a.speed_override == b.speed_override)
    }),
    (rule::saved_state::MIXED_OVERRIDES, |a, b| {
        a.feed_override == b.feed_override
            && same_spindles(a, b, |a, b| a.speed_override == b.speed_override)
    }),
    (rule::saved_state::ADAPTIVE_FEED, |a, b| a.adaptive_feed == b.adaptive_feed),
    (rule::saved_state::FEED_STOP, |a, b| a.feed_stop == b.feed_stop),
];

/// Whether two numbers are the same, apart from what a change of the length unit there and back leaves.
pub(crate) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs())
}

fn same_spindles(a: &Modes, b: &Modes, same: impl Fn(&Spindle, &Spindle) -> bool) -> bool {
    a.spindles.iter().zip(&b.spindles).all(|(a, b)| same(a, b))
}

/// Rule saved-state.orientation-not-saved. Only M3, M4 and M5 are saved: a spindle that was oriented at the save is
/// stopped.
pub(crate) fn restored_turn(saved: SpindleTurn, now: SpindleTurn) -> SpindleTurn {
    match (saved, now) {
        (SpindleTurn::Oriented, SpindleTurn::Oriented) => SpindleTurn::Oriented,
        (SpindleTurn::Oriented, _) => SpindleTurn::Stopped,
        (turn, _) => turn,
    }
}

/// Rule saved-state.motion-mode. Only the draft lists the motion mode; there it comes back, and whether a mode comes
/// back that its list leaves out is a choice.
fn restore_motion(saved: &Modes, state: &mut State) {
    state.coverage.accepted(rule::saved_state::MOTION_MODE);
    let restored = state.choices.is(choice::saved_state::MotionMode::Restored);
    let every = state.choices.is(choice::saved_state::ListedMotion::Every);
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
