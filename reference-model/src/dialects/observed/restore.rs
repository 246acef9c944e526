//! Quirks of restoring.
//!
//! `rs274` restores by programming codes again for the modes that it regards as changed. What no code can express is
//! not restored.

use gaugeblock_vocabulary::{
    Compensation, FaultKind, FeedMode, PathControlMode, Plane, Position, SpindleLimit, SpindleMode,
    SpindleTurn, Switch,
};

use super::overrides::override_flag;
use super::path::path_under;
use super::spindle::{choose_spindle, known_turn, send_speed, set_released};
use super::tool_length::tool_offset_as_programmed;
use super::units_planes::retract_under_compensation;
use super::{HasQuirk, Observed};
use crate::dialects::{Quirk, quirk};
use crate::rs274::dialect::Documented;
use crate::rs274::execute::compensation::mode::use_tool;
use crate::rs274::execute::restore::{RestoreRules, restored_turn, same};
use crate::rs274::execute::tool_length::table_offset;
use crate::rs274::modes::{Modes, Spindle, unit_size};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

impl RestoreRules for Observed {
    /// Quirk rs274.shared-p. The P of G64 can disable a control.
    fn restore(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        let disabled = disabled_by_path(saved, &state.modes, state);
        Documented.restore(saved, state)?;
        if let Some(control) = disabled {
            disable(control, state);
        }
        Ok(())
    }

    /// Quirks rs274.plane-restore, rs274.system-restore and rs274.local-offset-restore.
    fn restore_work_offset(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        check_plane_restore(saved, state)?;
        check_system_restore(saved, state)?;
        Documented.restore_work_offset(saved, state)?;
        if state.has_quirk(quirk::rs274::LOCAL_OFFSET_RESTORE) {
            restore_local_offset(saved, state);
        }
        Ok(())
    }

    /// Quirk rs274.tool-offset-unit. An offset that is switched off is removed as the number that was programmed.
    /// Quirk rs274.tool-offset-restore. If the offset is off, G43 is programmed for the tool in the spindle. An offset
    /// that is on does not change. An offset of zero counts as off.
    fn restore_tool_length(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        if saved.tool_length == Switch::Off && state.has_quirk(quirk::rs274::TOOL_OFFSET_UNIT) {
            tool_offset_as_programmed(state);
        }
        let rule = quirk::rs274::TOOL_OFFSET_RESTORE;
        if !state.has_quirk(rule) {
            return Documented.restore_tool_length(saved, state);
        }
        let is_on = |modes: &Modes| modes.tool_offset != Position::default();
        match (is_on(&state.modes), is_on(saved)) {
            (_, false) => state.dialect().apply_tool_offset(None, state),
            (true, true) => {}
            (false, true) => {
                let offset = table_offset(state.known_tool, rule.into(), state)?;
                state.dialect().apply_tool_offset(Some(offset), state);
            }
        }
        Ok(())
    }

    /// Quirk rs274.retract-under-compensation. G98 or G99 is programmed in a block with the G40, G41 or G42 that was
    /// active at the save, and takes effect after it.
    fn restore_retract(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        if saved.retract != state.modes.retract && saved.compensation != Compensation::Off {
            retract_under_compensation(state)?;
        }
        Documented.restore_retract(saved, state)
    }

    /// Quirk rs274.path-under-compensation. G61, G61.1 or G64 is programmed after the G41 or G42 that was active at the
    /// save. Quirk rs274.tolerance-unit. The tolerances of G64 are restored as the numbers that were programmed,
    /// whatever the length unit was.
    fn restore_path(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        let programs = programs_path(saved, &state.modes);
        if programs {
            path_under(saved.compensation, state)?;
        }
        let unit = saved.memory.get().tolerance_unit;
        if !state.has_quirk(quirk::rs274::TOLERANCE_UNIT) {
            if saved.path == PathControlMode::Continuous {
                state.modes.memory.get_mut().tolerance_unit = unit;
            }
            return Documented.restore_path(saved, state);
        }
        let modes = &mut state.modes;
        if programs && saved.path == PathControlMode::Continuous {
            let factor = unit_size(saved.units) / unit_size(unit);
            modes.blend_tolerance = saved.blend_tolerance * factor;
            modes.naive_cam_tolerance = saved.naive_cam_tolerance * factor;
            modes.memory.get_mut().tolerance_unit = saved.units;
        }
        modes.path = saved.path;
        Ok(())
    }

    /// Quirk rs274.dynamic-compensation-restore. G41.1 is restored as G41 and G42.1 as G42, for the tool in the
    /// spindle.
    fn restore_compensation(&self, saved: &Modes, state: &mut State) {
        if !state.has_quirk(quirk::rs274::DYNAMIC_COMPENSATION_RESTORE) {
            return Documented.restore_compensation(saved, state);
        }
        let by_tool = |compensation| match compensation {
            Compensation::Left | Compensation::DynamicLeft => Compensation::Left,
            Compensation::Right | Compensation::DynamicRight => Compensation::Right,
            Compensation::Off => Compensation::Off,
        };
        if by_tool(saved.compensation) != by_tool(state.modes.compensation) {
            state.modes.compensation = by_tool(saved.compensation);
            let tool = state.loaded_tool().cloned();
            use_tool(tool.as_ref().filter(|_| saved.compensation != Compensation::Off), state);
        }
    }

    /// The quirks of the feed are those of [`restore_feed_as_programmed`].
    fn restore_feed(&self, saved: &Modes, state: &mut State) {
        if FEED.iter().any(|quirk| state.has_quirk(*quirk)) {
            return restore_feed_as_programmed(saved, state);
        }
        Documented.restore_feed(saved, state);
        state.modes.memory.get_mut().feed_number = saved.memory.get().feed_number;
    }

    /// Quirk rs274.first-spindle-saved. Spindles after the first are not restored.
    fn restore_spindles(&self, saved: &Modes, state: &mut State) -> Result<(), StepError> {
        if !SPINDLES.iter().any(|quirk| state.has_quirk(*quirk)) {
            for place in 0..saved.spindles.len() {
                set_released(saved.memory.get().brake_released.contains(&place), place, state);
            }
            let spindles = saved.memory.get().regarded_as_stopped.clone();
            state.modes.memory.get_mut().regarded_as_stopped = spindles;
            return Documented.restore_spindles(saved, state);
        }
        let first_only = state.has_quirk(quirk::rs274::FIRST_SPINDLE_SAVED);
        let count = if first_only { 1 } else { saved.spindles.len() };
        if saved.spindles[0].mode != state.modes.spindles[0].mode {
            choose_spindle(0, state);
        }
        for place in 0..count {
            let (turn, regarded_as_stopped) = restored_spindle_turn(place, saved, state);
            let now = state.modes.spindles[place];
            let restored = restored_speed(&saved.spindles[place], &now, state)?;
            state.modes.spindles[place] = Spindle { turn, ..restored };
            if !same(restored.speed, now.speed) {
                send_speed(place, state);
            }
            if turn != now.turn {
                set_released(false, place, state);
            }
            let all = &mut state.modes.memory.get_mut().regarded_as_stopped;
            if regarded_as_stopped {
                all.insert(place)
            } else {
                all.remove(&place)
            };
        }
        Ok(())
    }

    /// Quirk rs274.off-not-restored. Saved switches that were on are switched on. Nothing is switched off, except
    /// both coolants together by M9.
    fn restore_switches(&self, saved: &Modes, state: &mut State) {
        if !state.has_quirk(quirk::rs274::OFF_NOT_RESTORED) {
            return Documented.restore_switches(saved, state);
        }
        let modes = &mut state.modes;
        let no_coolant = saved.mist == Switch::Off && saved.flood == Switch::Off;
        for (now, saved) in [
            (&mut modes.mist, saved.mist),
            (&mut modes.flood, saved.flood),
            (&mut modes.adaptive_feed, saved.adaptive_feed),
            (&mut modes.feed_stop, saved.feed_stop),
        ] {
            if saved == Switch::On {
                *now = Switch::On;
            }
        }
        if no_coolant {
            modes.mist = Switch::Off;
            modes.flood = Switch::Off;
        }
    }

    /// Quirk rs274.override-restore. If the feed override has changed, the speed overrides are enabled: by M48 if the
    /// feed override was saved as enabled, by M51 if it was not.
    fn restore_overrides(&self, saved: &Modes, state: &mut State) {
        if !state.has_quirk(quirk::rs274::OVERRIDE_RESTORE) {
            return Documented.restore_overrides(saved, state);
        }
        if override_flag(saved) == override_flag(&state.modes) {
            return;
        }
        if override_flag(saved) == Switch::On {
            state.modes.feed_override = Switch::On;
            state.dialect().feed_override_is_set(state);
        }
        for spindle in &mut state.modes.spindles {
            spindle.speed_override = Switch::On;
        }
    }
}

/// Quirk rs274.plane-restore. G17, G18 or G19 is programmed before G40, and refused if the cutter is compensated.
fn check_plane_restore(saved: &Modes, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::PLANE_RESTORE;
    let compensated = state.modes.compensation != Compensation::Off;
    let three = matches!(saved.plane, Plane::Xy | Plane::Zx | Plane::Yz);
    if compensated && three && saved.plane != state.modes.plane && state.has_quirk(rule) {
        let message = "a restore of the plane while the cutter is compensated";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    Ok(())
}

/// Quirk rs274.system-restore. G54 to G59.3 is programmed after G41 or G42, and is refused there.
fn check_system_restore(saved: &Modes, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::SYSTEM_RESTORE;
    let selected = saved.work_offset != state.modes.work_offset;
    if selected && saved.compensation != Compensation::Off && state.has_quirk(rule) {
        let message = "a restore of the coordinate system together with that of the compensation";
        return Err(refuse(rule, FaultKind::CompensationActive, message));
    }
    Ok(())
}

/// Quirk rs274.local-offset-restore. A local offset that did not apply at the save is suspended, and one that did
/// apply is resumed, with the present values of its parameters.
fn restore_local_offset(saved: &Modes, state: &mut State) {
    if state.modes.local_applies == saved.local_applies {
        return;
    }
    let machine = state.modes.machine_point(state.position);
    state.parameters.store(5210, if saved.local_applies { 1.0 } else { 0.0 });
    let parameters = &state.parameters;
    let unit = state.stored_unit();
    state.modes.load_local_offset(|number| parameters.stored(number), unit);
    state.position = state.modes.program_point(machine);
}

/// The quirks that concern the feed.
const FEED: &[Quirk] =
    &[quirk::rs274::FEED_MODE_FEED, quirk::rs274::FEED_SPEED_ROUNDED, quirk::rs274::FEED_UNIT];

/// Quirk rs274.feed-speed-rounded. A feed that changed is restored with one decimal.
///
/// Quirk rs274.feed-mode-feed. A feed is lost if the feed mode changes: G93 ignores F, and G94 and G95 reset the feed
/// to zero if F has not changed and is therefore not programmed again.
///
/// Quirk rs274.feed-unit. F is restored as the number that was programmed, whatever the length unit was.
fn restore_feed_as_programmed(saved: &Modes, state: &mut State) {
    let by_number = state.has_quirk(quirk::rs274::FEED_UNIT);
    let number =
        |modes: &Modes| if by_number { modes.memory.get().feed_number } else { modes.feed_rate };
    let is_same = same(number(&state.modes), number(saved));
    let rounded = state.has_quirk(quirk::rs274::FEED_SPEED_ROUNDED);
    let programmed = if rounded { rounded_to_decimals(number(saved), 1) } else { number(saved) };
    let mode_changed = saved.feed_mode != state.modes.feed_mode;
    let lost = state.has_quirk(quirk::rs274::FEED_MODE_FEED);
    let ignored = lost && saved.feed_mode == FeedMode::InverseTime;
    if !ignored && (!is_same || lost && mode_changed) {
        let number = if is_same { 0.0 } else { programmed };
        state.modes.feed_rate = number;
        state.modes.memory.get_mut().feed_number = number;
    }
    if mode_changed {
        choose_spindle(0, state);
    }
    state.modes.feed_mode = saved.feed_mode;
    state.modes.feed_awaited = saved.feed_awaited;
}

/// The quirks that concern spindles.
const SPINDLES: &[Quirk] = &[
    quirk::rs274::FEED_SPEED_ROUNDED,
    quirk::rs274::SURFACE_SPEED_RESTORE,
    quirk::rs274::FIRST_SPINDLE_SAVED,
    quirk::rs274::ORIENTED_AS_STOPPED,
];

/// Quirk rs274.feed-speed-rounded. A speed that changed is restored as an integer. Quirk rs274.surface-speed-restore.
/// G96 is restored without D. It is refused if S has not changed and is therefore not programmed again.
fn restored_speed(saved: &Spindle, now: &Spindle, state: &State) -> Result<Spindle, StepError> {
    let is_same = same(saved.speed, now.speed);
    let rounded = state.has_quirk(quirk::rs274::FEED_SPEED_ROUNDED);
    let speed = match (is_same, rounded) {
        (true, _) => now.speed,
        (false, true) => rounded_to_decimals(saved.speed, 0),
        (false, false) => saved.speed,
    };
    let mut limit = saved.limit;
    if state.has_quirk(quirk::rs274::SURFACE_SPEED_RESTORE) {
        let to_surface = saved.mode == SpindleMode::SurfaceSpeed;
        limit = if saved.mode == now.mode { now.limit } else { SpindleLimit::None };
        if to_surface && saved.mode != now.mode && is_same {
            let message = "G96 is programmed again without S";
            return Err(refuse(
                quirk::rs274::SURFACE_SPEED_RESTORE,
                FaultKind::MissingWord,
                message,
            ));
        }
    }
    Ok(Spindle { speed, mode: saved.mode, limit, ..*now })
}

/// The turning of a restored spindle, and whether the interpreter regards the spindle as stopped.
///
/// Quirk rs274.oriented-as-stopped. If the spindle was stopped at the save and is oriented now, it stays oriented: the
/// interpreter regards it as stopped. Quirk rs274.orient-forgets-turning. A turning spindle that the interpreter
/// regards as stopped is not stopped either.
fn restored_spindle_turn(place: usize, saved: &Modes, state: &State) -> (SpindleTurn, bool) {
    let as_stopped = state.has_quirk(quirk::rs274::ORIENTED_AS_STOPPED);
    let was_stopped = regarded_turn(place, saved, state) == SpindleTurn::Stopped;
    let now = state.modes.spindles[place].turn;
    let regarded_as_stopped = state.modes.memory.get().regarded_as_stopped.contains(&place);
    if was_stopped && (now == SpindleTurn::Oriented && as_stopped || regarded_as_stopped) {
        return (now, regarded_as_stopped);
    }
    (restored_turn(known_turn(place, saved), now), false)
}

/// Quirk rs274.oriented-as-stopped. The turning of a spindle as the interpreter regards it.
fn regarded_turn(place: usize, modes: &Modes, state: &State) -> SpindleTurn {
    let as_stopped = state.has_quirk(quirk::rs274::ORIENTED_AS_STOPPED);
    let turn = known_turn(place, modes);
    if turn == SpindleTurn::Oriented && as_stopped { SpindleTurn::Stopped } else { turn }
}

/// A number, rounded to `count` decimals.
fn rounded_to_decimals(number: f64, count: usize) -> f64 {
    format!("{number:.count$}").parse().unwrap_or(number)
}

/// Whether a restore programs the path control mode again.
fn programs_path(saved: &Modes, now: &Modes) -> bool {
    let programmed = |modes: &Modes| {
        let factor = unit_size(modes.units) / unit_size(modes.memory.get().tolerance_unit);
        (modes.blend_tolerance * factor, modes.naive_cam_tolerance * factor)
    };
    let ((blend, naive_cam), (blend_now, naive_cam_now)) = (programmed(saved), programmed(now));
    saved.path != now.path || !same(blend, blend_now) || !same(naive_cam, naive_cam_now)
}

/// A control that a restore enables by an M code without P.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Control {
    /// M51.
    SpeedOverride,
    /// M52.
    AdaptiveFeed,
    /// M53.
    FeedStop,
}

/// Quirk rs274.shared-p. A restore programs its first M code in the block of its G codes. If G64 P0 is in that block,
/// the M code reads that P, and disables its control. Returns that control.
fn disabled_by_path(saved: &Modes, now: &Modes, state: &State) -> Option<Control> {
    let has_p = saved.path == PathControlMode::Continuous && programs_path(saved, now);
    let is_zero = same(saved.blend_tolerance, 0.0);
    if !(has_p && is_zero && state.has_quirk(quirk::rs274::SHARED_P)) {
        return None;
    }
    let comes_on = |saved: Switch, now: Switch| saved == Switch::On && now == Switch::Off;
    let none = |modes: &Modes| modes.mist == Switch::Off && modes.flood == Switch::Off;
    let turn = |modes: &Modes| regarded_turn(0, modes, state);
    let earlier = turn(saved) != turn(now)
        || comes_on(saved.mist, now.mist)
        || comes_on(saved.flood, now.flood)
        || none(saved) && !none(now);
    if earlier {
        None
    } else if override_flag(saved) != override_flag(now) {
        (override_flag(saved) == Switch::Off).then_some(Control::SpeedOverride)
    } else if comes_on(saved.adaptive_feed, now.adaptive_feed) {
        Some(Control::AdaptiveFeed)
    } else {
        comes_on(saved.feed_stop, now.feed_stop).then_some(Control::FeedStop)
    }
}

/// Quirk rs274.shared-p. Disables the control.
fn disable(control: Control, state: &mut State) {
    let modes = &mut state.modes;
    match control {
        Control::SpeedOverride => {
            for spindle in &mut modes.spindles {
                spindle.speed_override = Switch::Off;
            }
        }
        Control::AdaptiveFeed => modes.adaptive_feed = Switch::Off,
        Control::FeedStop => modes.feed_stop = Switch::Off,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_as_they_are_written() {
        for (number, count, expected) in
            [(12.3456, 1, 12.3), (0.04, 1, 0.0), (1234.56, 0, 1235.0), (1.04, 1, 1.0)]
        {
            assert!((rounded_to_decimals(number, count) - expected).abs() < 1e-12, "{number}");
        }
    }
}
