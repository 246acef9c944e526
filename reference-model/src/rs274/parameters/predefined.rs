//! Predefined named parameters: what the state of machine and interpreter is.

use gaugeblock_vocabulary::{
    Axis, Compensation, Distance, FeedMode, Lathe, LengthUnit, Motion, Plane, ReturnMode,
    SpindleMode, SpindleTurn, Switch,
};

use super::State;
use crate::Choices;
use crate::ids::{Rule, choice, rule};
use crate::rs274::modes::{Spindle, motion_code};
use crate::rs274::refusal::StepError;

/// A predefined parameter: its name, the rule that states it, its value.
struct Predefined(&'static str, Rule, fn(&State) -> f64);

/// Every predefined parameter but those of axes and pockets.
const PREDEFINED: &[Predefined] = &[
    Predefined("_vmajor", rule::parameters::VERSION, |_| 2.9),
    Predefined("_vminor", rule::parameters::VERSION, |_| 0.0),
    Predefined("_line", rule::parameters::LINE, |state| f64::from(state.line)),
    Predefined("_motion_mode", rule::parameters::MOTION_MODE, |state| motion(state.modes.motion)),
    Predefined("_plane", rule::parameters::PLANE, |state| plane(state.modes.plane)),
    Predefined("_ccomp", rule::parameters::COMPENSATION, |state| {
        state.dialect().compensation_parameter(state)
    }),
    Predefined("_metric", rule::parameters::UNITS, |state| {
        flag(state.modes.units == LengthUnit::Millimetre)
    }),
    Predefined("_imperial", rule::parameters::UNITS, |state| {
        flag(state.modes.units == LengthUnit::Inch)
    }),
    Predefined("_absolute", rule::parameters::DISTANCE, |state| {
        flag(state.modes.distance == Distance::Absolute)
    }),
    Predefined("_incremental", rule::parameters::DISTANCE, |state| {
        flag(state.modes.distance == Distance::Incremental)
    }),
    Predefined("_inverse_time", rule::parameters::FEED_MODE, |state| {
        flag(state.modes.feed_mode == FeedMode::InverseTime)
    }),
    Predefined("_units_per_minute", rule::parameters::FEED_MODE, |state| {
        flag(state.modes.feed_mode == FeedMode::PerMinute)
    }),
    Predefined("_units_per_rev", rule::parameters::FEED_MODE, |state| {
        flag(state.modes.feed_mode == FeedMode::PerRevolution)
    }),
    Predefined("_coord_system", rule::parameters::COORDINATE_SYSTEM, |state| {
        coordinate_system(state.modes.work_offset)
    }),
    Predefined("_tool_offset", rule::parameters::TOOL_OFFSET, |state| {
        state.dialect().tool_offset_parameter(state)
    }),
    Predefined("_retract_r_plane", rule::parameters::RETRACT, |state| {
        retract(state, ReturnMode::RPlane)
    }),
    Predefined("_retract_old_z", rule::parameters::RETRACT, |state| {
        retract(state, ReturnMode::OldZ)
    }),
    Predefined("_spindle_rpm_mode", rule::parameters::SPINDLE_MODE, |state| {
        flag(spindle(state).mode == SpindleMode::Rpm)
    }),
    Predefined("_spindle_css_mode", rule::parameters::SPINDLE_MODE, |state| {
        flag(spindle(state).mode == SpindleMode::SurfaceSpeed)
    }),
    Predefined("_ijk_absolute_mode", rule::parameters::ARC_DISTANCE, |state| {
        flag(state.modes.arc_distance == Distance::Absolute)
    }),
    Predefined("_lathe_diameter_mode", rule::parameters::LATHE_MODE, |state| {
        lathe(state, Lathe::Diameter)
    }),
    Predefined("_lathe_radius_mode", rule::parameters::LATHE_MODE, |state| {
        lathe(state, Lathe::Radius)
    }),
    Predefined("_spindle_on", rule::parameters::SPINDLE_STATUS, spindle_on),
    Predefined("_spindle_cw", rule::parameters::SPINDLE_STATUS, |state| {
        flag(state.dialect().known_turn(0, state) == SpindleTurn::Clockwise)
    }),
    Predefined("_mist", rule::parameters::COOLANT, |state| flag(state.modes.mist == Switch::On)),
    Predefined("_flood", rule::parameters::COOLANT, |state| flag(state.modes.flood == Switch::On)),
    Predefined("_feed_override", rule::parameters::OVERRIDE_FLAGS, |state| {
        override_flag(state, true)
    }),
    Predefined("_speed_override", rule::parameters::OVERRIDE_FLAGS, |state| {
        override_flag(state, false)
    }),
    Predefined("_adaptive_feed", rule::parameters::ADAPTIVE_FEED, |state| {
        flag(state.modes.adaptive_feed == Switch::On)
    }),
    Predefined("_feed_hold", rule::parameters::FEED_HOLD, |state| {
        flag(state.modes.feed_stop == Switch::On)
    }),
    Predefined("_feed", rule::parameters::FEED, |state| state.dialect().feed_parameter(state)),
    Predefined("_rpm", rule::parameters::SPEED, |state| spindle(state).speed),
    Predefined("_current_tool", rule::parameters::TOOL, |state| f64::from(state.known_tool)),
    Predefined("_selected_tool", rule::parameters::TOOL, |state| {
        state.dialect().selected_tool_parameter(state)
    }),
    Predefined("_value", rule::parameters::RETURNED_VALUE, |state| state.parameters.returned),
    Predefined("_value_returned", rule::parameters::RETURNED_VALUE, |state| {
        flag(state.parameters.has_returned)
    }),
    Predefined("_task", rule::parameters::TASK, |state| flag(!state.environment.is_stand_alone())),
    Predefined("_call_level", rule::parameters::CALL_LEVEL, |state| f64::from(state.call_level())),
    Predefined("_remap_level", rule::parameters::REMAP_LEVEL, |_| 0.0),
];

/// Operations on parameters that a dialect can replace.
pub(crate) trait ParameterRules {
    /// Rule parameters.feed. `_feed` is the feed rate in force.
    fn feed_parameter(&self, state: &State) -> f64 {
        state.modes.feed_rate
    }

    /// Rule parameters.range. The greatest number of a parameter is 5602.
    /// Rule parameters.greatest. By a choice it is 5399.
    fn last_parameter(&self, choices: &Choices) -> u32 {
        match choices.get() {
            choice::parameters::Greatest::To5602 => 5602,
            choice::parameters::Greatest::To5399 => 5399,
        }
    }

    /// Rule parameters.override-flags. Whether the feed override is enabled.
    fn feed_override_parameter(&self, state: &State) -> Switch {
        state.modes.feed_override
    }

    /// Rule parameters.ini-read-only. Whether a name of the form of an INI or HAL parameter can be assigned: it cannot.
    fn may_assign_outside(&self, _name: &str, _state: &State) -> bool {
        false
    }

    /// Rule parameters.compensation. `_ccomp` is ten times the number of the active compensation code.
    fn compensation_parameter(&self, state: &State) -> f64 {
        f64::from(match state.modes.compensation {
            Compensation::Off => 400,
            Compensation::Left => 410,
            Compensation::Right => 420,
            Compensation::DynamicLeft => 411,
            Compensation::DynamicRight => 421,
        })
    }

    /// Rule parameters.tool-offset. `_tool_offset` is 1 while a tool offset is on, else 0.
    fn tool_offset_parameter(&self, state: &State) -> f64 {
        flag(state.modes.tool_length == Switch::On)
    }

    /// Rule parameters.tool. `_selected_tool` is the tool of the last T, -1 before.
    fn selected_tool_parameter(&self, state: &State) -> f64 {
        f64::from(state.selected_tool)
    }
}

/// Parameters of axes are the prefix and the axis' letter.
///
/// Rule parameters.position. `_x` to `_w` are the position in the active coordinate system with all offsets.
/// Rule parameters.absolute-position. `_abs_x` to `_abs_c` are the position without offsets.
fn of_axis(name: &str, state: &State) -> Option<(Rule, f64)> {
    let axis = |letter: &str| Axis::ALL.iter().find(|axis| axis.word() == letter);
    if let Some(axis) = name.strip_prefix("_abs_").and_then(axis) {
        let machine = state.modes.machine_point(state.position);
        let value = state.dialect().measured(machine, state).get(*axis);
        return (*axis <= Axis::C).then_some((rule::parameters::ABSOLUTE_POSITION, value));
    }
    let axis = name.strip_prefix('_').and_then(axis)?;
    Some((rule::parameters::POSITION, state.position.get(*axis)))
}

/// Whether a name is that of a predefined parameter.
pub(super) fn is_predefined(name: &str) -> bool {
    let axis = name.strip_prefix("_abs_").filter(|letter| "xyzabc".contains(letter));
    let axis =
        axis.or_else(|| name.strip_prefix('_').filter(|letter| "xyzabcuvw".contains(letter)));
    axis.is_some_and(|letter| letter.len() == 1) || is_pocket(name) || entry(name).is_some()
}

/// The value of a predefined parameter; `None` for another name.
pub(super) fn value(name: &str, state: &State) -> Option<Result<f64, StepError>> {
    if is_pocket(name) {
        return Some(pocket(name, state));
    }
    let value = entry(name).map(|Predefined(_, _, value)| value(state));
    value.or_else(|| of_axis(name, state).map(|(_, value)| value)).map(Ok)
}

/// The rule that states a predefined parameter.
pub(super) fn rule(name: &str, state: &State) -> Option<Rule> {
    let rule = entry(name).map(|Predefined(_, rule, _)| *rule);
    let rule = rule.or_else(|| of_axis(name, state).map(|(rule, _)| rule));
    rule.or_else(|| is_pocket(name).then_some(rule::parameters::TOOL))
}

fn entry(name: &str) -> Option<&'static Predefined> {
    PREDEFINED.iter().find(|Predefined(known, ..)| *known == name)
}

fn is_pocket(name: &str) -> bool {
    matches!(name, "_current_pocket" | "_selected_pocket")
}

/// The index of a tool in the tool data. No document says how tools are counted there; without a tool it is said, -1
/// for the selected one, and nothing is in the spindle's place.
fn pocket(name: &str, state: &State) -> Result<f64, StepError> {
    match name {
        "_selected_pocket" if state.prepared_tool < 0 => Ok(-1.0),
        "_current_pocket" if state.known_tool == 0 => Ok(0.0),
        _ => Err(StepError::Unspecified(format!(
            "#<{name}> is an index into tool data that no document describes"
        ))),
    }
}

fn flag(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}

/// Values of spindle parameters are those of the first spindle.
fn spindle(state: &State) -> Spindle {
    state.modes.spindles.first().copied().unwrap_or(Spindle::AT_START)
}

/// Rule parameters.spindle-status. `_spindle_on` is 1 after M3 or M4.
/// Choice parameters.spindle-on-at-zero: as commanded, or as it turns, which it does not at a speed of zero.
fn spindle_on(state: &State) -> f64 {
    let turn = state.dialect().known_turn(0, state);
    let commanded = matches!(turn, SpindleTurn::Clockwise | SpindleTurn::Counterclockwise);
    let by_command = state.choices.is(choice::parameters::SpindleOnAtZero::Commanded);
    flag(commanded && (by_command || spindle(state).speed > 0.0))
}

/// Rule parameters.motion-mode. `_motion_mode` is ten times the number of the active motion code; 800 for G80.
fn motion(motion: Motion) -> f64 {
    f64::from(motion_code(motion))
}

/// Rule parameters.plane. `_plane` is ten times the number of the active plane code.
fn plane(plane: Plane) -> f64 {
    f64::from(match plane {
        Plane::Xy => 170,
        Plane::Zx => 180,
        Plane::Yz => 190,
        Plane::Uv => 171,
        Plane::Wu => 181,
        Plane::Vw => 191,
    })
}

/// Rule parameters.coordinate-system. `_coord_system` is ten times the number of the active work offset code.
fn coordinate_system(system: u32) -> f64 {
    f64::from(if system <= 6 { 530 + 10 * system } else { 584 + system })
}

/// Rule parameters.retract. `_retract_r_plane` and `_retract_old_z` report the canned cycle return mode.
/// Choice parameters.retract-names: each as it is named, or each under the other one's code.
fn retract(state: &State, named: ReturnMode) -> f64 {
    let by_name = state.choices.is(choice::parameters::RetractNames::ByName);
    flag((state.modes.retract == named) == by_name)
}

/// Rule parameters.lathe-mode. `_lathe_diameter_mode` and `_lathe_radius_mode` are 1 under G7 and G8.
/// Choice parameters.lathe-flags: on every machine or on a lathe only, which no machine of a scenario is.
fn lathe(state: &State, mode: Lathe) -> f64 {
    flag(state.modes.lathe == mode && state.choices.is(choice::parameters::LatheFlags::AnyMachine))
}

/// Rule parameters.override-flags. `_feed_override` and `_speed_override` are 1 while that override is enabled.
/// Choice parameters.override-names: each as it is named, or each under the other one's code.
fn override_flag(state: &State, feed: bool) -> f64 {
    let by_name = state.choices.is(choice::parameters::OverrideNames::ByName);
    let switch = if feed == by_name {
        state.dialect().feed_override_parameter(state)
    } else {
        spindle(state).speed_override
    };
    flag(switch == Switch::On)
}

/// The names of the predefined parameters but those of axes and pockets.
#[cfg(test)]
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    PREDEFINED.iter().map(|Predefined(name, ..)| *name)
}
