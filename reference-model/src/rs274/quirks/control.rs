//! Quirks of subroutines and control.

use gaugeblock_vocabulary::FaultKind;

use crate::ids::{quirk, rule};
use crate::rs274::control::{Control, Frame, Next, Place, Structure, turns};
use crate::rs274::evaluate;
use crate::rs274::parameters::{self, Name};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{self, Expression, Keyword, Parameter};
use crate::rs274::text::Line;

/// Quirk rs274.later-conditions-evaluated. The condition of an elseif is evaluated even after a true one.
///
/// # Errors
/// The condition has no value.
pub fn evaluate_later_condition(values: &[Expression], state: &mut State) -> Result<(), StepError> {
    values.iter().try_for_each(|value| evaluate::value_of(value, state).map(|_| ()))
}

/// Quirk rs274.repeat-counter-shared. All invocations of a sub share the counter of a repeat.
///
/// The head takes a turn from the counter when it finds one, whoever left it there; a counter that is used up ends the
/// loop and is gone, so that the next head that comes by begins again.
///
/// # Errors
/// The count has no value, or the loop has no end.
pub fn shared_repeat(
    control: &mut Control,
    label: &str,
    values: &[Expression],
    state: &mut State,
) -> Result<Next, StepError> {
    let turns_left = match control.shared_counters.remove(&control.place) {
        Some(left) => left,
        None => turns(values, state)?,
    };
    if turns_left == 0 {
        return control.past_repeat(label, state);
    }
    control.shared_counters.insert(control.place, turns_left - 1);
    control.enter(label, Structure::Repeat { turns_left: 0 }, state);
    Ok(Next::Following)
}

/// Quirk rs274.file-with-two-subs. Within a called file the head of another sub is passed over: what follows is
/// executed. Quirk rs274.sub-found-later. So it is within a sub of the main program, which nobody has looked at where
/// it was found by its call.
pub fn is_head_within(control: &Control, state: &State) -> bool {
    let quirk = if control.place.file == 0 {
        state.frame().is_sub() && state.choices.quirk(quirk::rs274::SUB_FOUND_LATER)
    } else {
        state.choices.quirk(quirk::rs274::FILE_WITH_TWO_SUBS)
    };
    state.call_level() > 0 && quirk
}

/// Quirk rs274.numbers-of-all-files. The numbered program of this number that was called first, whichever file it
/// stands in.
pub fn known_number(control: &Control, label: &str, state: &State) -> Option<Place> {
    let first = control.numbers_called.get(label).copied();
    first.filter(|_| state.choices.quirk(quirk::rs274::NUMBERS_OF_ALL_FILES))
}

/// Quirk rs274.fanuc-count-too-large. L of M98 is refused, as if it were negative, from 2147483648 on.
///
/// # Errors
/// Such an L.
pub fn count_too_large(turns: f64, state: &State) -> Result<(), StepError> {
    let rule = quirk::rs274::FANUC_COUNT_TOO_LARGE;
    if turns.round() > f64::from(i32::MAX) && state.choices.quirk(rule) {
        return Err(refuse(rule, FaultKind::WordOutOfRange, "L of M98 is too large"));
    }
    Ok(())
}

/// Quirk rs274.fanuc-zero-loops. A call with L0 leaves a call level behind: what follows is executed as if it belonged
/// to the subprogram.
pub fn level_left_behind(control: &Control, frame: Frame, state: &mut State) -> Next {
    state.frames.push(frame);
    Next::At(Place { line: control.place.line + 1, ..control.place })
}

/// Quirk rs274.continue-remembered. A continue in a do loop is remembered until a while or repeat ends; whether this
/// one begins again. A while tests its condition once more, which changes something only where it is broken.
pub fn begins_again(control: &mut Control) -> bool {
    std::mem::take(&mut control.continue_remembered)
}

/// Quirk rs274.break-remembered. A break of a while is remembered until a do loop tests its condition; whether this one
/// ends.
pub fn do_ends(control: &mut Control) -> bool {
    std::mem::take(&mut control.break_remembered)
}

/// Quirks rs274.continue-remembered and rs274.break-remembered. A while ends whose endwhile stands on line `end`: a
/// continue is forgotten, and a break in what is skipped counts.
pub fn while_ends(control: &mut Control, label: &str, end: u32, state: &mut State) {
    control.continue_remembered = false;
    breaks_skipped(control, label, end, state);
}

/// Quirk rs274.continue-remembered, and rs274.break-remembered for a break that is skipped: a do loop is continued
/// whose while stands on line `end`.
pub fn do_continues(control: &mut Control, label: &str, end: u32, state: &mut State) {
    control.continue_remembered = state.choices.quirk(quirk::rs274::CONTINUE_REMEMBERED);
    breaks_skipped(control, label, end, state);
}

fn breaks_skipped(control: &mut Control, label: &str, end: u32, state: &mut State) {
    if state.choices.quirk(quirk::rs274::BREAK_REMEMBERED) {
        let skipped = control.find(label, &[Keyword::Break], control.place.line, state);
        control.break_remembered |= skipped.is_some_and(|line| line < end);
    }
}

/// Quirk rs274.return-after-call. Once something was called, a return in the main program is no error: it keeps its
/// value as a sub's would, and the program goes on behind it.
pub fn returns_in_main(control: &Control, state: &State) -> bool {
    let in_main = state.frame().call.is_none();
    in_main && control.has_called && state.choices.quirk(quirk::rs274::RETURN_AFTER_CALL)
}

/// Quirk rs274.sub-reached-again. A definition that is reached a second time, as in a loop, is refused.
pub fn is_reached_again(known: Option<&Place>, place: Place, state: &State) -> bool {
    known == Some(&place) && state.choices.quirk(quirk::rs274::SUB_REACHED_AGAIN)
}

/// Quirk rs274.value-at-definition. The value of an endsub is evaluated where the sub is defined; named parameters that
/// do not exist there count as zero.
///
/// # Errors
/// The endsub is refused, or its value.
pub fn value_at_definition(
    control: &mut Control,
    end: u32,
    state: &mut State,
) -> Result<(), StepError> {
    control.place.line = end;
    let Some(Line::Block(text)) = control.files.line(control.place, state) else { return Ok(()) };
    let value = value_behind(text, state)?.map(|value| with_zeros(&value, state));
    leave(value.as_ref(), state)
}

/// The value behind an endsub or a return; nobody looks at what stands behind that.
///
/// # Errors
/// The block is refused for what stands up to there.
pub(super) fn value_behind(text: &str, state: &mut State) -> Result<Option<Expression>, StepError> {
    let word = match syntax::parse(text, state) {
        Ok(block) => block.o_word,
        Err(StepError::Refused(refusal)) if refusal.rule == rule::control::UNRELATED_WORDS => {
            syntax::o_word_of(text, state)
        }
        Err(error) => return Err(error),
    };
    Ok(word.and_then(|word| word.arguments.into_iter().next()))
}

/// A value is left as if a sub had returned it; none, where there is none.
///
/// # Errors
/// It has no value.
pub(super) fn leave(value: Option<&Expression>, state: &mut State) -> Result<(), StepError> {
    let value = value.map(|value| evaluate::value_of(value, state)).transpose()?;
    state.parameters.returned = value.unwrap_or(0.0);
    state.parameters.has_returned = value.is_some();
    Ok(())
}

/// An expression with zero for each named parameter that does not exist.
pub(super) fn with_zeros(expression: &Expression, state: &State) -> Expression {
    let inside = |inner: &Expression| Box::new(with_zeros(inner, state));
    match expression {
        Expression::Parameter(Parameter::Named(name))
            if !parameters::exists(&Name::Named(name.clone()), state) =>
        {
            Expression::Number(0.0)
        }
        Expression::Parameter(Parameter::Numbered(number)) => {
            Expression::Parameter(Parameter::Numbered(inside(number)))
        }
        Expression::Negate(inner) => Expression::Negate(inside(inner)),
        Expression::Function(function, inner) => Expression::Function(*function, inside(inner)),
        Expression::ArcTangent(y, x) => Expression::ArcTangent(inside(y), inside(x)),
        Expression::Binary(operator, left, right) => {
            Expression::Binary(*operator, inside(left), inside(right))
        }
        Expression::Number(_)
        | Expression::Parameter(Parameter::Named(_))
        | Expression::Exists(_) => expression.clone(),
    }
}

/// Quirk rs274.fanuc-zero-loops. Whether what is executed may belong to a level left behind, where the labels of the
/// program around it are not known.
pub fn is_left_behind(state: &State) -> bool {
    state.choices.quirk(quirk::rs274::FANUC_ZERO_LOOPS) && state.frame().shares_parameters()
}

/// Quirk rs274.nine-levels. The main program counts as a level.
pub fn levels(documented: u32) -> u32 {
    documented - 1
}
