//! Quirks of saving and restoring.
//!
//! `rs274` restores by programming codes again, for what it takes to be different: what such codes cannot say is lost.

use gaugeblock_trace::{Compensation, FaultKind, FeedMode, SpindleLimit, SpindleMode, Switch};

use crate::rs274::control::Frame;
use crate::rs274::machine::State;
use crate::rs274::modes::{Modes, SavedState, Spindle};
use crate::rs274::refusal::{Halt, refuse};
use crate::rs274::step::restore::same;
use crate::rs274::step::tool_length::{apply, table_offset};

/// Quirk rs274.one-store-per-level. M70 and M73 share one place: the end of a sub restores what was saved last, if an M73
/// was executed there, whatever M71 did before.
pub(crate) fn promised_at_return(frame: &Frame) -> Option<SavedState> {
    let saved = frame.saved.as_ref().filter(|saved| saved.valid);
    saved.filter(|_| frame.restore_at_return.is_some()).cloned()
}

/// Quirk rs274.tool-offset-restore. G43 is programmed again when the offset is off, with the tool in the spindle; an offset
/// that is on stays as it is.
pub(crate) fn tool_offset(saved: &Modes, state: &mut State) -> Result<(), Halt> {
    match (state.modes.tool_length, saved.tool_length) {
        (_, Switch::Off) => apply(None, state),
        (Switch::On, Switch::On) => {}
        (Switch::Off, Switch::On) => {
            let offset = table_offset(state.tool, "rs274.tool-offset-restore", state)?;
            apply(Some(offset), state);
        }
    }
    Ok(())
}

/// Quirk rs274.dynamic-compensation-restore. G41.1 comes back as G41 and G42.1 as G42, by the tool in the spindle.
pub(crate) fn compensation(saved: &Modes, state: &mut State) {
    let by_tool = |compensation| match compensation {
        Compensation::Left | Compensation::DynamicLeft => Compensation::Left,
        Compensation::Right | Compensation::DynamicRight => Compensation::Right,
        Compensation::Off => Compensation::Off,
    };
    if by_tool(saved.compensation) != by_tool(state.modes.compensation) {
        state.modes.compensation = by_tool(saved.compensation);
        state.modes.compensation_radius = saved.compensation_radius;
    }
}

/// Quirk rs274.feed-speed-rounded. A feed that changed comes back with one decimal.
/// Quirk rs274.feed-mode-feed. With another mode it does not come back: F is ignored under inverse time, and G94 and G95
/// leave no feed when F is not programmed again, because it is the same.
pub(crate) fn feed(saved: &Modes, state: &mut State) {
    let now = state.modes.feed_rate;
    let is_same = same(now, saved.feed_rate);
    let rounded = state.readings.quirk("rs274.feed-speed-rounded");
    let programmed = if rounded { decimals(saved.feed_rate, 1) } else { saved.feed_rate };
    let mode_changed = saved.feed_mode != state.modes.feed_mode;
    let lost = mode_changed && state.readings.quirk("rs274.feed-mode-feed");
    state.modes.feed_rate = match (lost, saved.feed_mode) {
        (true, FeedMode::InverseTime) => now,
        (true, FeedMode::PerMinute | FeedMode::PerRevolution) if is_same => 0.0,
        _ if is_same => now,
        _ => programmed,
    };
    state.modes.feed_mode = saved.feed_mode;
    state.modes.feed_awaited = saved.feed_awaited;
}

/// The quirks that concern spindles.
pub(crate) const SPINDLES: &[&str] =
    &["rs274.feed-speed-rounded", "rs274.surface-speed-restore", "rs274.first-spindle-saved"];

/// Quirk rs274.first-spindle-saved. Spindles after the first stay as they are.
pub(crate) fn spindles(saved: &Modes, state: &mut State) -> Result<(), Halt> {
    let first_only = state.readings.quirk("rs274.first-spindle-saved");
    let count = if first_only { 1 } else { saved.spindles.len() };
    for (place, saved) in saved.spindles.iter().enumerate().take(count) {
        state.modes.spindles[place] = spindle(saved, &state.modes.spindles[place], state)?;
    }
    Ok(())
}

/// Quirk rs274.feed-speed-rounded. A speed that changed comes back as an integer.
/// Quirk rs274.surface-speed-restore. G96 comes back without D, and is refused when S is not programmed again, because it
/// is the same.
fn spindle(saved: &Spindle, now: &Spindle, state: &State) -> Result<Spindle, Halt> {
    let is_same = same(saved.speed, now.speed);
    let rounded = state.readings.quirk("rs274.feed-speed-rounded");
    let speed = match (is_same, rounded) {
        (true, _) => now.speed,
        (false, true) => decimals(saved.speed, 0),
        (false, false) => saved.speed,
    };
    let mut limit = saved.limit;
    if state.readings.quirk("rs274.surface-speed-restore") {
        let to_surface = saved.mode == SpindleMode::SurfaceSpeed;
        limit = if saved.mode == now.mode { now.limit } else { SpindleLimit::None };
        if to_surface && saved.mode != now.mode && is_same {
            let message = "G96 is programmed again without S";
            return Err(refuse("rs274.surface-speed-restore", FaultKind::MissingWord, message));
        }
    }
    Ok(Spindle {
        speed,
        mode: saved.mode,
        limit,
        turn: saved.turn,
        speed_override: now.speed_override,
    })
}

/// A number as it is written with so many decimals.
fn decimals(number: f64, count: usize) -> f64 {
    format!("{number:.count$}").parse().unwrap_or(number)
}

/// Quirk rs274.off-not-restored. What was on is switched on; nothing is switched off, but both coolants by M9.
pub(crate) fn switches(saved: &Modes, state: &mut State) {
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

/// Quirk rs274.override-restore. The speed overrides are taken as enabled whenever the feed override has changed: M48 when
/// that was saved as enabled, M51 when it was not.
pub(crate) fn overrides(saved: &Modes, state: &mut State) {
    if saved.feed_override == state.modes.feed_override {
        return;
    }
    if saved.feed_override == Switch::On {
        state.modes.feed_override = Switch::On;
    }
    for spindle in &mut state.modes.spindles {
        spindle.speed_override = Switch::On;
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
            assert!((decimals(number, count) - expected).abs() < 1e-12, "{number}");
        }
    }
}
