//! G40, G41, G42, G41.1, G42.1.

use gaugeblock_vocabulary::{Compensation, FaultKind, Plane, Position, Tool};

use super::ending::switch_off;
use super::exit;
use super::orientation::shifts;
use crate::ids::choice::compensation::ExitMove;
use crate::ids::{choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::execute::tool::named;
use crate::rs274::execute::{whole, word};
use crate::rs274::modes::unit_size;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::{Exit, State};
use crate::rs274::task::Record;

/// The rules of cutter compensation that a controller may follow differently.
pub(crate) trait CompensationRules {
    /// Rule compensation.entry-length. Whether an entry is long enough for a radius: it is at least as long. Lengths
    /// are in the active unit.
    fn is_entry(&self, length: f64, radius: f64, _state: &State) -> bool {
        length >= radius
    }

    /// Rules compensation.exit-length, compensation.exit-arc. Whether the end of compensation makes the next move the
    /// one that leads away, also where no move was compensated. Choice compensation.exit-move: or none does.
    fn has_exit(&self, _along_path: bool, state: &State) -> bool {
        state.choices.is(ExitMove::Line)
    }

    /// Rule compensation.exit-length. The line that leads away is longer than the diameter of the tool.
    fn check_exit_line(
        &self,
        exit: &Exit,
        end: Position,
        state: &mut State,
    ) -> Result<(), StepError> {
        exit::check_line(exit, end, state)
    }

    /// Rule compensation.exit-arc. A move that is neither a line nor an arc is the next one, too. G33 and G33.1 are
    /// synchronised with the spindle.
    fn lead_away_by_other_move(&self, _is_synchronised: bool, state: &mut State) {
        state.contour.exit = None;
    }

    /// Rules compensation.tool-radius, compensation.dynamic-diameter. The active side and the radius, as programmed.
    fn in_force(&self, side: Compensation, radius: f64, _state: &State) -> (Compensation, f64) {
        (side, radius)
    }

    /// Rule tool.dynamic-compensation-orientation. Whether a number is one of a tool's orientations: 0 to 9.
    fn is_orientation(&self, number: i32, _state: &State) -> bool {
        (0..=9).contains(&number)
    }
}

/// Turns cutter compensation on and off.
///
/// Rule tool.compensation. G41 and G42 turn it on, G40 turns it off, which is allowed when it is off
/// (tool.compensation-off-repeated).
///
/// # Errors
/// Rules tool.compensation-twice, tool.compensation-plane, tool.compensation-tool,
/// tool.dynamic-compensation-needs-diameter, tool.dynamic-compensation-orientation. A tool with an orientation outside
/// of the ZX plane. G40: the tool does not fit along the last move.
pub fn perform(words: &Words, state: &mut State, record: &mut Record) -> Result<(), StepError> {
    let compensation = words.g_tenths.iter().find_map(|code| match code {
        410 => Some(Compensation::Left),
        411 => Some(Compensation::DynamicLeft),
        420 => Some(Compensation::Right),
        421 => Some(Compensation::DynamicRight),
        _ => None,
    });
    let Some(compensation) = compensation else {
        if state.modes.compensation == Compensation::Off {
            state.coverage.accepted(rule::tool::COMPENSATION_OFF_REPEATED);
        }
        state.coverage.accepted(rule::tool::COMPENSATION);
        switch_off(state, record)?;
        state.modes.compensation = Compensation::Off;
        state.modes.compensation_radius = 0.0;
        state.modes.compensation_orientation = 0;
        return Ok(());
    };
    possible(state)?;
    match compensation {
        Compensation::DynamicLeft | Compensation::DynamicRight => dynamic(words, state)?,
        Compensation::Left | Compensation::Right | Compensation::Off => by_tool(words, state)?,
    }
    let in_force = state.dialect().in_force(compensation, state.modes.compensation_radius, state);
    (state.modes.compensation, state.modes.compensation_radius) = in_force;
    Ok(())
}

/// Takes over half of the diameter, active length unit, and the orientation of a tool; without a tool both are zero.
pub(crate) fn use_tool(tool: Option<&Tool>, state: &mut State) {
    let (diameter, orientation) = tool.map_or((0.0, 0), |tool| (tool.diameter, tool.orientation));
    let unit = unit_size(state.stored_unit()) / unit_size(state.modes.units);
    state.modes.compensation_radius = diameter * unit / 2.0;
    state.modes.compensation_orientation = i32::from(orientation);
}

/// Rule tool.compensation-twice. Compensation is not turned on while it is on.
/// Rule tool.compensation-plane. Nor is it turned on in the YZ plane, or any other but XY and ZX. Choice
/// tool.compensation-in-zx: or XY alone.
fn possible(state: &mut State) -> Result<(), StepError> {
    if state.modes.compensation != Compensation::Off {
        let message = "cutter compensation is on already";
        return Err(refuse(rule::tool::COMPENSATION_TWICE, FaultKind::CompensationActive, message));
    }
    let has_zx = state.choices.is(choice::tool::CompensationInZx::Accepted);
    if !(state.modes.plane == Plane::Xy || has_zx && state.modes.plane == Plane::Zx) {
        let message = "cutter compensation in another plane than XY, or XY and ZX";
        return Err(refuse(rule::tool::COMPENSATION_PLANE, FaultKind::ModalConflict, message));
    }
    state.coverage.accepted(rule::tool::COMPENSATION_PLANE);
    Ok(())
}

/// Takes over radius and orientation of a tool.
///
/// Rule tool.compensation-tool. D is a tool of the tool table, or 0: the tool in the spindle, as without D, whose
/// radius is zero when there is none.
/// Rules compensation.tool-number, compensation.tool-number-zero, compensation.tool-number-zero-random,
/// compensation.tool-radius. Which tool that is.
/// Choice tool.length-number-zero. D0 may be a radius of zero.
/// Rule compensation.set-at-run-time. The table is read now: a G10 L1 before counts.
fn by_tool(words: &Words, state: &mut State) -> Result<(), StepError> {
    let rule = rule::tool::COMPENSATION_TOOL;
    let (tool, source) = match word(words, 'd') {
        Some(value) => {
            let message = || format!("D{value} is not a tool number");
            let number =
                whole(value).ok_or_else(|| refuse(rule, FaultKind::NotAnInteger, message()))?;
            let source = match (number, state.machine.random_tool_changer) {
                (0, true) => rule::compensation::TOOL_NUMBER_ZERO_RANDOM,
                (0, false) => rule::compensation::TOOL_NUMBER_ZERO,
                _ => rule::compensation::TOOL_NUMBER,
            };
            let is_none = number == 0 && state.choices.is(choice::tool::LengthNumberZero::Zero);
            let refusing = if number == 0 { source } else { rule };
            (if is_none { None } else { named(number, refusing, state)? }, source)
        }
        None => (state.loaded_tool(), rule::compensation::TOOL_RADIUS),
    };
    let tool = tool.cloned();
    use_tool(tool.as_ref(), state);
    if shifts(state.modes.compensation_orientation) && state.modes.plane != Plane::Zx {
        let message = "a tool with an orientation, in another plane than ZX";
        return Err(refuse(rule::tool::COMPENSATION, FaultKind::ModalConflict, message));
    }
    state.coverage.accepted(rule);
    for rule in [source, rule::tool::COMPENSATION, rule::compensation::SET_AT_RUN_TIME] {
        state.coverage.accepted(rule);
    }
    Ok(())
}

/// Takes over a programmed diameter.
///
/// Rules tool.dynamic-compensation, compensation.dynamic-diameter. D is the diameter.
/// Rule compensation.orientation. L is the orientation; without it there is none.
/// Rule tool.dynamic-compensation-orientation. L is 0 to 9, and only allowed in the ZX plane.
fn dynamic(words: &Words, state: &mut State) -> Result<(), StepError> {
    let Some(diameter) = word(words, 'd') else {
        let rule = rule::tool::DYNAMIC_COMPENSATION_NEEDS_DIAMETER;
        return Err(refuse(
            rule,
            FaultKind::MissingWord,
            "dynamic compensation needs D, the diameter",
        ));
    };
    if let Some(orientation) = word(words, 'l') {
        let rule = rule::tool::DYNAMIC_COMPENSATION_ORIENTATION;
        let known = |number| state.dialect().is_orientation(number, state);
        if !whole(orientation).is_some_and(known) {
            let message = format!("L{orientation} is not an orientation; expected 0 to 9");
            return Err(refuse(rule, FaultKind::WordOutOfRange, message));
        }
        if state.modes.plane != Plane::Zx {
            return Err(refuse(rule, FaultKind::UnusedWord, "L is used in the ZX plane only"));
        }
        state.coverage.accepted(rule);
    }
    state.modes.compensation_radius = diameter / 2.0;
    state.modes.compensation_orientation = word(words, 'l').and_then(whole).unwrap_or(0);
    for rule in [
        rule::tool::DYNAMIC_COMPENSATION,
        rule::compensation::DYNAMIC_DIAMETER,
        rule::compensation::ORIENTATION,
    ] {
        state.coverage.accepted(rule);
    }
    Ok(())
}
