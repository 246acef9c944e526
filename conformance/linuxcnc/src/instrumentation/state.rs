//! Converts the values of a checkpoint to the fields of the vocabulary.

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{
    Compensation, Distance, Event, FeedMode, Indexed, Lathe, LengthUnit, Motion, Plane, Position,
    ReturnMode, Rs274State, Settings, SpindleMode, SpindleTurn, Switch,
};

use super::checkpoint::Checkpoint;
use super::instrument::Plan;

/// Takes over a setting: an event only where it changes something, and one for what changes between two effects.
pub(crate) fn set(now: &mut Settings, events: &mut Vec<Event>, change: &Settings) {
    let before = now.clone();
    now.overlay(change);
    let change = now.since(&before);
    if change.is_empty() {
        return;
    }
    match events.last_mut() {
        Some(Event::Set(last)) => last.overlay(&change),
        Some(Event::Do(_) | Event::Unknown(_)) | None => events.push(Event::Set(change.into())),
    }
}

/// Settings that canonical calls do not show, or show only in part. `was` is what was in force before, `block` the code
/// of the block: the parameters do not tell dynamic compensation from static.
///
/// # Errors
/// A mode that is not known.
pub(crate) fn modes(
    checkpoint: &Checkpoint,
    was: &Settings,
    block: &str,
) -> Result<Settings, HarnessError> {
    let absolute = |on| if on { Distance::Absolute } else { Distance::Incremental };
    let side = |side| compensation(side, was.compensation, block);
    let compensation = match checkpoint.mode("_ccomp") {
        400 => Compensation::Off,
        410 | 411 => side(Compensation::Left),
        420 | 421 => side(Compensation::Right),
        other => return Err(unknown("_ccomp", other)),
    };
    Ok(Settings {
        plane: Some(plane(checkpoint)?),
        distance: Some(absolute(checkpoint.is("_absolute"))),
        arc_distance: Some(absolute(checkpoint.is("_ijk_absolute_mode"))),
        feed_mode: Some(feed_mode(checkpoint)),
        retract: Some(if checkpoint.is("_retract_old_z") {
            ReturnMode::OldZ
        } else {
            ReturnMode::RPlane
        }),
        lathe: Some(if checkpoint.is("_lathe_diameter_mode") {
            Lathe::Diameter
        } else {
            Lathe::Radius
        }),
        compensation: Some(compensation),
        ..Settings::default()
    })
}

/// Compensation on a side, static or dynamic by the block's code or by what was in force before it.
pub(crate) fn compensation(
    side: Compensation,
    was: Option<Compensation>,
    block: &str,
) -> Compensation {
    let dynamic = block.contains("g41.1") || block.contains("g42.1");
    match (side, was) {
        (Compensation::Left, Some(Compensation::DynamicLeft)) => Compensation::DynamicLeft,
        (Compensation::Right, Some(Compensation::DynamicRight)) => Compensation::DynamicRight,
        (Compensation::Left, _) if dynamic => Compensation::DynamicLeft,
        (Compensation::Right, _) if dynamic => Compensation::DynamicRight,
        (side, _) => side,
    }
}

/// Settings that parameters expose of the first spindle and of the rest, in addition to the modes: all that is known
/// before the first block.
pub(crate) fn others(checkpoint: &Checkpoint) -> Settings {
    let switch = |name| Some(if checkpoint.is(name) { Switch::On } else { Switch::Off });
    let turn = match (checkpoint.is("_spindle_on"), checkpoint.is("_spindle_cw")) {
        (false, _) => SpindleTurn::Stopped,
        (true, true) => SpindleTurn::Clockwise,
        (true, false) => SpindleTurn::Counterclockwise,
    };
    let surface = checkpoint.is("_spindle_css_mode");
    let mode = if surface { SpindleMode::SurfaceSpeed } else { SpindleMode::Rpm };
    let speed_override = if checkpoint.is("_speed_override") { Switch::On } else { Switch::Off };
    Settings {
        units: Some(if checkpoint.is("_metric") {
            LengthUnit::Millimetre
        } else {
            LengthUnit::Inch
        }),
        feed_rate: Some(checkpoint.number("_feed")),
        mist: switch("_mist"),
        flood: switch("_flood"),
        feed_override: switch("_feed_override"),
        adaptive_feed: switch("_adaptive_feed"),
        feed_stop: switch("_feed_hold"),
        speed_override: Some(Indexed::one(0, speed_override)),
        spindle: Some(Indexed::one(0, turn)),
        spindle_mode: Some(Indexed::one(0, mode)),
        spindle_speed: Some(Indexed::one(0, checkpoint.number("_rpm"))),
        ..Settings::default()
    }
}

/// Settings whose calls wait under cutter compensation while a move does, as far as parameters expose them.
pub(crate) fn waiting(checkpoint: &Checkpoint) -> Settings {
    let Settings { feed_rate, mist, flood, spindle, spindle_mode, spindle_speed, .. } =
        others(checkpoint);
    Settings { feed_rate, mist, flood, spindle, spindle_mode, spindle_speed, ..Settings::default() }
}

/// The state after a block, as far as it is observable. The tool comes from the calls: its parameter keeps an old
/// value.
pub(crate) fn state(
    checkpoint: &Checkpoint,
    tool: i32,
    plan: &Plan,
) -> Result<Rs274State, HarnessError> {
    let whole = |name| {
        i32::try_from(checkpoint.mode(name)).map_err(|_| unknown(name, checkpoint.mode(name)))
    };
    let prepared =
        if checkpoint.mode("_selected_pocket") == -1 { -1 } else { whole("_selected_tool")? };
    Ok(Rs274State {
        motion: Some(motion(checkpoint)?),
        position: Some(position(checkpoint)),
        tool: Some(tool),
        prepared_tool: Some(prepared),
        controller_mode: None,
        call_level: Some(whole("_call_level")?.unsigned_abs()),
        parameter: Some(parameters(checkpoint, plan)),
    })
}

fn parameters(checkpoint: &Checkpoint, plan: &Plan) -> Indexed<String, f64> {
    let names = plan.parameters.iter().map(|name| name.trim_matches(['<', '>']).to_owned());
    let values = names.zip(&checkpoint.parameters);
    values.filter_map(|(name, value)| Some((name, (*value)?))).collect()
}

/// The controlled point; 0 for axes that are not printed.
pub(crate) fn position(checkpoint: &Checkpoint) -> Position {
    Position {
        x: checkpoint.number("_x"),
        y: checkpoint.number("_y"),
        z: checkpoint.number("_z"),
        a: checkpoint.number("_a"),
        b: checkpoint.number("_b"),
        c: checkpoint.number("_c"),
        u: checkpoint.number("_u"),
        v: checkpoint.number("_v"),
        w: checkpoint.number("_w"),
    }
}

fn unknown(name: &str, value: i64) -> HarnessError {
    HarnessError::Unreadable { what: "mode".to_owned(), line: format!("#<{name}> = {value}") }
}

/// The feed mode.
pub(crate) fn feed_mode(checkpoint: &Checkpoint) -> FeedMode {
    match (checkpoint.is("_inverse_time"), checkpoint.is("_units_per_minute")) {
        (true, _) => FeedMode::InverseTime,
        (false, true) => FeedMode::PerMinute,
        (false, false) => FeedMode::PerRevolution,
    }
}

fn plane(checkpoint: &Checkpoint) -> Result<Plane, HarnessError> {
    match checkpoint.mode("_plane") {
        170 => Ok(Plane::Xy),
        180 => Ok(Plane::Zx),
        190 => Ok(Plane::Yz),
        171 => Ok(Plane::Uv),
        181 => Ok(Plane::Wu),
        191 => Ok(Plane::Vw),
        other => Err(unknown("_plane", other)),
    }
}

fn motion(checkpoint: &Checkpoint) -> Result<Motion, HarnessError> {
    let motion = match checkpoint.mode("_motion_mode") {
        0 => Motion::Traverse,
        10 => Motion::Feed,
        20 => Motion::ArcClockwise,
        30 => Motion::ArcCounterclockwise,
        50 => Motion::CubicSpline,
        51 => Motion::QuadraticSpline,
        52 => Motion::Nurbs,
        330 => Motion::SpindleSynchronised,
        331 => Motion::RigidTap,
        382 => Motion::ProbeTowardError,
        383 => Motion::ProbeToward,
        384 => Motion::ProbeAwayError,
        385 => Motion::ProbeAway,
        730 => Motion::Cycle73,
        740 => Motion::Cycle74,
        760 => Motion::Thread76,
        // After G5.3 no code is active.
        800 | -1 => Motion::None,
        810 => Motion::Cycle81,
        820 => Motion::Cycle82,
        830 => Motion::Cycle83,
        840 => Motion::Cycle84,
        850 => Motion::Cycle85,
        860 => Motion::Cycle86,
        870 => Motion::Cycle87,
        880 => Motion::Cycle88,
        890 => Motion::Cycle89,
        other => return Err(unknown("_motion_mode", other)),
    };
    Ok(motion)
}
