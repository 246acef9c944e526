//! G43, G43.1, G43.2, G49.

use gaugeblock_vocabulary::{FaultKind, Position, Switch};

use super::programmed_motion::check_words_after_cancel;
use super::target::offset_words;
use super::tool::named;
use super::{not_under_compensation, whole, word};
use crate::ids::{Rule, choice, rule};
use crate::rs274::evaluate::Words;
use crate::rs274::modes::{converted, each};
use crate::rs274::order::has_axis_words;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;

/// Turns tool length compensation on and off.
///
/// Rule tool.length-moves-nothing. The machine stays; the same point gets other coordinates.
/// Rule tool.length-repeated. The same offset may be programmed again, and G49 when there is none.
///
/// # Errors
/// A tool or a word that the code does not allow. Rules tool.length-under-compensation and
/// motion.offset-words-after-cancel, which are choices.
pub fn perform(words: &Words, state: &mut State) -> Result<(), StepError> {
    check_words_after_cancel(words, state)?;
    not_under_compensation(
        rule::tool::LENGTH_UNDER_COMPENSATION,
        choice::tool::LengthUnderCompensation::Refused,
        state,
    )?;
    let offset = state.dialect().programmed_tool_offset(words, state)?;
    state.coverage.accepted(rule::tool::LENGTH_MOVES_NOTHING);
    state.coverage.accepted(rule::tool::LENGTH_REPEATED);
    state.dialect().apply_tool_offset(offset, state);
    Ok(())
}

/// Operations on tool length compensation that a dialect can replace.
pub(crate) trait ToolLengthRules {
    /// The offset that a block turns on, or none.
    fn programmed_tool_offset(
        &self,
        words: &Words,
        state: &mut State,
    ) -> Result<Option<Position>, StepError> {
        Ok(if words.g_tenths.contains(&490) {
            state.coverage.accepted(rule::tool::LENGTH_OFF);
            None
        } else if words.g_tenths.contains(&431) {
            Some(dynamic(words, state))
        } else if words.g_tenths.contains(&432) {
            Some(state.dialect().additional_tool_offset(words, state)?)
        } else {
            Some(of_tool(words, state)?)
        })
    }

    /// Rule tool.additional-length. G43.2 adds the offset of tool H, or axis values.
    /// Rule tool.additional-length-words. It needs either H or axis words.
    fn additional_tool_offset(
        &self,
        words: &Words,
        state: &mut State,
    ) -> Result<Position, StepError> {
        let rule = rule::tool::ADDITIONAL_LENGTH_WORDS;
        let more = match (word(words, 'h'), has_axis_words(words)) {
            (Some(_), true) => {
                return Err(refuse(
                    rule,
                    FaultKind::UnusedWord,
                    "G43.2 takes H or axis words, not both",
                ));
            }
            (None, false) => {
                return Err(refuse(rule, FaultKind::MissingWord, "G43.2 needs H or axis words"));
            }
            (Some(value), false) => {
                let rule = rule::tool::ADDITIONAL_LENGTH_UNKNOWN_TOOL;
                let message = || format!("H{value} is not a tool number");
                let tool =
                    whole(value).ok_or_else(|| refuse(rule, FaultKind::NotAnInteger, message()))?;
                table_offset(tool, rule, state)?
            }
            (None, true) => {
                let mut more = Position::default();
                for (axis, value) in offset_words(words, state) {
                    *more.get_mut(axis) = value;
                }
                more
            }
        };
        state.coverage.accepted(rule::tool::ADDITIONAL_LENGTH);
        Ok(each(state.modes.tool_offset, more, |offset, more| offset + more))
    }

    /// Applies a tool offset, active length unit, or none.
    fn apply_tool_offset(&self, offset: Option<Position>, state: &mut State) {
        let machine = state.modes.machine_point(state.position);
        state.modes.tool_length = if offset.is_some() { Switch::On } else { Switch::Off };
        state.modes.tool_offset = offset.unwrap_or_default();
        state.position = state.modes.program_point(machine);
    }
}

/// Rule tool.length. G43 applies the offset of tool H from the tool table, all its axes.
/// Rule tool.length-zero. H0, and no H, mean the tool in the spindle, and an offset of zero when there is none: without
/// H that is no number that the table would have to hold.
/// Rule tool.length-number-zero. By a choice H0 is an offset of zero, and H is required.
/// Rule tool.length-zero-random. Where tools change places, H0 is tool 0, which the table must hold.
fn of_tool(words: &Words, state: &mut State) -> Result<Position, StepError> {
    let random = state.machine.random_tool_changer;
    let choice_rule = rule::tool::LENGTH_NUMBER_ZERO;
    let has_no_offset = state.choices.is(choice::tool::LengthNumberZero::Zero);
    let Some(number) = word(words, 'h') else {
        if has_no_offset {
            return Err(refuse(choice_rule, FaultKind::MissingWord, "G43 needs H"));
        }
        state.coverage.accepted(choice_rule);
        state.coverage.accepted(rule::tool::LENGTH_ZERO);
        let offset = state.loaded_tool().map(|tool| tool.offset).unwrap_or_default();
        return Ok(converted(offset, state.stored_unit(), state.modes.units));
    };
    let rule = rule::tool::LENGTH_NOT_AN_INTEGER;
    let Some(whole) = whole(number) else {
        return Err(refuse(
            rule,
            FaultKind::NotAnInteger,
            format!("H{number} is not a tool number"),
        ));
    };
    if whole < 0 {
        let message = format!("H{number} is negative");
        return Err(refuse(rule::tool::LENGTH_NEGATIVE, FaultKind::WordOutOfRange, message));
    }
    if whole == 0 {
        state.coverage.accepted(choice_rule);
        if has_no_offset {
            return Ok(Position::default());
        }
    }
    let rule = match whole {
        0 if random => rule::tool::LENGTH_ZERO_RANDOM,
        0 => rule::tool::LENGTH_ZERO,
        _ => rule::tool::LENGTH,
    };
    let refusing =
        if rule == rule::tool::LENGTH_ZERO_RANDOM { rule } else { rule::tool::LENGTH_UNKNOWN_TOOL };
    let offset = table_offset(whole, refusing, state)?;
    state.coverage.accepted(rule);
    Ok(offset)
}

/// Rule tool.dynamic-length. G43.1 replaces the offset of the axes that it names.
fn dynamic(words: &Words, state: &mut State) -> Position {
    state.coverage.accepted(rule::tool::DYNAMIC_LENGTH);
    let mut offset = state.modes.tool_offset;
    for (axis, value) in offset_words(words, state) {
        *offset.get_mut(axis) = value;
    }
    offset
}

/// The offset of a tool, active length unit.
pub(crate) fn table_offset(tool: i32, rule: Rule, state: &State) -> Result<Position, StepError> {
    let tool = named(tool, rule, state)?;
    let offset = tool.map(|tool| tool.offset).unwrap_or_default();
    Ok(converted(offset, state.stored_unit(), state.modes.units))
}
