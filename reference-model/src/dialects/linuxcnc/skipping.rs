//! Quirks of what is passed over on the way to a label: rs274 looks for an end, a sub or a number by reading line after
//! line, and minds some of what it reads.

use gaugeblock_vocabulary::FaultKind;

use super::Shows;
use super::passed_over::{PassedOver, passed_over};
use super::values::{count_too_large, known_number, leave, value_behind, with_zeros};
use crate::dialects::{Quirk, quirk};
use crate::ids::rule;
use crate::math;
use crate::rs274::control::labels::Mark;
use crate::rs274::control::numbered::enabled;
use crate::rs274::control::subs::passed;
use crate::rs274::control::{Call, Control, Frame, Place, SearchTarget, Style, label_of};
use crate::rs274::evaluate;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{self, Keyword, Label};
use crate::rs274::text::Line;

/// Without any of these, what is passed over is not looked at.
const QUIRKS: [Quirk; 3] =
    [quirk::rs274::SKIPPED_IS_READ, quirk::rs274::SKIPPED_LABELS, quirk::rs274::NUMBER_IN_SUB];

/// The lines behind this block and before line `end` are passed over; all of the file, where there is no end.
///
/// Quirk rs274.skipped-is-read. Their length, comments, line numbers, O-words and blocks that begin with M98 are
/// checked. Quirk rs274.skipped-labels. So is a label that is the one of the condition or loop whose end is looked
/// for. Quirk rs274.number-in-sub. A number alone within a sub counts as the beginning of another one.
pub(super) fn pass_over(
    control: &mut Control,
    target: SearchTarget<'_>,
    end: Option<u32>,
    state: &mut State,
) -> Result<(), StepError> {
    if !QUIRKS.iter().any(|quirk| state.shows(*quirk)) {
        return Ok(());
    }
    match target {
        SearchTarget::Numbered { label } => to_numbered(control, label, state),
        SearchTarget::Called { label, arguments } => {
            to_called(control, (label, arguments), end, state)
        }
        SearchTarget::Structure { .. } | SearchTarget::EndSub { .. } => {
            read_over(control, target, end, state)
        }
    }
}

/// The same, line by line.
fn read_over(
    control: &mut Control,
    target: SearchTarget<'_>,
    end: Option<u32>,
    state: &mut State,
) -> Result<(), StepError> {
    let start = control.place;
    for line in start.line + 1..end.unwrap_or(u32::MAX) {
        let place = Place { line, ..start };
        match control.files.line(place, state) {
            None | Some(Line::End) => break,
            Some(Line::Nothing) => {}
            Some(Line::Block(text)) => {
                minded(text, target, state).inspect_err(|_| control.place = place)?;
            }
        }
    }
    Ok(())
}

/// On the way to the numbered program that M98 calls; for one that was called before there is no search.
fn to_numbered(control: &mut Control, label: &str, state: &mut State) -> Result<(), StepError> {
    if is_called_before(control, label) || known_number(control, label, state).is_some() {
        return Ok(());
    }
    let end = next_of_number(control, label);
    read_over(control, SearchTarget::Numbered { label }, end, state)
}

/// Whether the numbered program of this file with this number was called before.
fn is_called_before(control: &Control, label: &str) -> bool {
    let begins = control.files.labels(control.place.file).numbers(label);
    begins.iter().any(|line| control.called.contains(&control.line(line + 1)))
}

/// Line of the next program or sub of this file with a number, in whichever scope.
fn next_of_number(control: &Control, label: &str) -> Option<u32> {
    let fits = |mark: &&Mark| {
        mark.label.as_deref() == Some(label)
            && matches!(mark.keyword, Keyword::ProgramNumber | Keyword::Sub)
    };
    marks_behind(control, control.place.line).iter().find(fits).map(|mark| mark.line)
}

/// Quirk rs274.ends-in-other-subs. Line of the next block after `after` with this label and one of these keywords,
/// in whichever sub, before a numbered program begins.
pub(super) fn end_in_any_sub(
    control: &Control,
    label: &str,
    keywords: &[Keyword],
    after: u32,
    state: &mut State,
) -> Option<u32> {
    let mut later = marks_behind(control, after)
        .iter()
        .take_while(|mark| mark.keyword != Keyword::ProgramNumber)
        .filter(|mark| keywords.contains(&mark.keyword));
    later.find(|mark| mark.has(label, state)).map(|mark| mark.line)
}

/// The O-words of this file after a line.
fn marks_behind(control: &Control, line: u32) -> &[Mark] {
    let marks = &control.files.labels(control.place.file).marks;
    &marks[marks.partition_point(|mark| mark.line <= line)..]
}

/// On the way to a sub that is behind its call: what is evaluated there is evaluated as within the sub.
fn to_called(
    control: &mut Control,
    (label, arguments): (&str, &[f64]),
    end: Option<u32>,
    state: &mut State,
) -> Result<(), StepError> {
    let call = Call { label: label.to_owned(), back: control.place, style: Style::OWord };
    let passed = passed(arguments, state);
    state.frames.push(Frame { arguments: passed, call: Some(call), ..Frame::default() });
    let target = SearchTarget::Called { label, arguments };
    let passed_over = read_over(control, target, end, state);
    state.frames.pop();
    passed_over
}

/// A line that is passed over.
fn minded(text: &str, target: SearchTarget<'_>, state: &mut State) -> Result<(), StepError> {
    let reads = state.shows(quirk::rs274::SKIPPED_IS_READ);
    let in_sub = matches!(target, SearchTarget::EndSub { .. });
    let read = match passed_over(text, state) {
        Ok(read) => read,
        Err(error) if reads && !is_passable(&error, text) => return Err(error),
        Err(error) if reads => return comments_behind(&error, text, state),
        Err(_) => return Ok(()),
    };
    let word = match read {
        PassedOver::Nothing => return Ok(()),
        PassedOver::NumberedCall if reads => {
            enabled(state)?;
            return numbered_call(text, state);
        }
        PassedOver::NumberedCall => return Ok(()),
        PassedOver::WithoutKeyword(error) if reads && !in_sub => return Err(error),
        PassedOver::WithoutKeyword(_) => return Ok(()),
        PassedOver::OWord(word) => word,
    };
    if word.keyword == Keyword::ProgramNumber && reads {
        enabled(state)?;
    }
    let written = match &word.label {
        Label::Number(number) if in_sub => Label::Number(with_zeros(number, state)),
        label @ (Label::Number(_) | Label::Name(_)) => label.clone(),
    };
    let label = match label_of(&written, state) {
        Err(error) if reads => return Err(error),
        label => label.ok(),
    };
    match target {
        SearchTarget::Structure { label: own, ends }
            if label.as_deref() == Some(own) && state.shows(quirk::rs274::SKIPPED_LABELS) =>
        {
            own_label(word.keyword, ends)
        }
        SearchTarget::EndSub { .. }
            if word.keyword == Keyword::ProgramNumber
                && state.shows(quirk::rs274::NUMBER_IN_SUB) =>
        {
            let message = "a number alone within a sub that is defined";
            Err(refuse(quirk::rs274::NUMBER_IN_SUB, FaultKind::NestedSub, message))
        }
        SearchTarget::EndSub { .. } if word.keyword == Keyword::Sub && reads => {
            let rule = rule::subroutines::NESTED_DEFINITION;
            Err(refuse(rule, FaultKind::NestedSub, "a sub within a sub that is defined"))
        }
        SearchTarget::EndSub { label: own }
            if label.as_deref() == Some(own)
                && word.keyword == Keyword::Return
                && state.shows(quirk::rs274::VALUE_AT_DEFINITION) =>
        {
            returned(true, text, state)
        }
        SearchTarget::Called { label: own, .. }
            if label.as_deref() == Some(own)
                && matches!(word.keyword, Keyword::EndSub | Keyword::Return)
                && state.shows(quirk::rs274::VALUE_AT_DEFINITION) =>
        {
            returned(false, text, state)
        }
        SearchTarget::Structure { .. }
        | SearchTarget::EndSub { .. }
        | SearchTarget::Called { .. }
        | SearchTarget::Numbered { .. } => Ok(()),
    }
}

/// Quirk rs274.value-at-definition. A return of the sub that is defined, and an endsub or return of the one that is
/// sought behind its call, leaves its value. In the former, named parameters that do not exist count as zero.
fn returned(in_definition: bool, text: &str, state: &mut State) -> Result<(), StepError> {
    let value = value_behind(text, state)?;
    let value = value.map(|value| if in_definition { with_zeros(&value, state) } else { value });
    leave(value.as_ref(), state)
}

/// What is wrong with a line and passes all the same: a right parenthesis without a comment.
fn is_passable(error: &StepError, text: &str) -> bool {
    !matches!(error, StepError::Refused(_)) || behind_parenthesis(error, text).is_some()
}

/// What stands behind a right parenthesis that is passed is read for its comments.
fn comments_behind(error: &StepError, text: &str, state: &mut State) -> Result<(), StepError> {
    let mut rest = behind_parenthesis(error, text).map(str::to_owned);
    while let Some(behind) = rest.take() {
        // What begins with a parenthesis has no O-word: a letter takes its place.
        let line = format!("x{behind}");
        if let Err(error) = passed_over(&line, state) {
            let Some(behind) = behind_parenthesis(&error, &line) else { return Err(error) };
            rest = Some(behind.to_owned());
        }
    }
    Ok(())
}

/// The text behind the right parenthesis that is refused, if it is one that is.
fn behind_parenthesis<'a>(error: &StepError, text: &'a str) -> Option<&'a str> {
    let StepError::Refused(refusal) = error else { return None };
    let span = refusal.span?;
    let part = text.get(span.start as usize..span.end as usize);
    text.get(span.end as usize..).filter(|_| part == Some(")"))
}

/// The P and L of an M98 are read, and must be numbers of programs and of turns.
fn numbered_call(text: &str, state: &mut State) -> Result<(), StepError> {
    let block = syntax::parse(text, state)?;
    let words = match evaluate::words(&block, state) {
        // Whether an E has its code is not asked here.
        Err(StepError::Refused(refusal)) if refusal.rule == rule::text::WORD_LETTERS => {
            return Ok(());
        }
        read => read?,
    };
    let rule = quirk::rs274::SKIPPED_IS_READ;
    let Some(number) = words.letters.get(&'p') else {
        return Err(refuse(rule, FaultKind::MissingWord, "M98 without P"));
    };
    let turns = words.letters.get(&'l').copied().unwrap_or(1.0);
    if [*number, turns].iter().any(|value| math::near_integer(*value).is_none()) {
        let message = "P or L of M98 is not an integer";
        return Err(refuse(rule, FaultKind::NotAnInteger, message));
    }
    if turns < 0.0 {
        return Err(refuse(rule, FaultKind::WordOutOfRange, "L of M98 is negative"));
    }
    count_too_large(turns, state)
}

/// The label whose end is looked for, before that end: what could not begin there, or end there, is refused.
/// A while or do may be named by break and continue, and a condition has any number of further branches.
fn own_label(keyword: Keyword, ends: &[Keyword]) -> Result<(), StepError> {
    let of_loop = ends.iter().any(|end| matches!(end, Keyword::While | Keyword::EndWhile));
    let of_condition = ends.contains(&Keyword::EndIf);
    let kind = match keyword {
        Keyword::If | Keyword::While | Keyword::Repeat => FaultKind::DuplicateLabel,
        Keyword::Break | Keyword::Continue if of_loop => return Ok(()),
        Keyword::Else | Keyword::ElseIf if of_condition => return Ok(()),
        Keyword::ElseIf
        | Keyword::Else
        | Keyword::EndIf
        | Keyword::EndWhile
        | Keyword::EndRepeat
        | Keyword::Break
        | Keyword::Continue => FaultKind::UnknownLabel,
        Keyword::Do => {
            let why = "a do whose label is that of the condition or loop around it";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        Keyword::Sub
        | Keyword::EndSub
        | Keyword::Call
        | Keyword::Return
        | Keyword::ProgramNumber => return Ok(()),
    };
    let message = "the label of the condition or loop around it, which does not end here";
    Err(refuse(quirk::rs274::SKIPPED_LABELS, kind, message))
}
