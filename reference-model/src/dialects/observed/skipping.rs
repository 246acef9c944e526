//! Quirks of lines that rs274 skips. It searches for an end, a sub or a numbered program line by line, and checks part
//! of each line that it reads.

use gaugeblock_vocabulary::FaultKind;

use super::HasQuirk;
use super::passed_over::{PassedOver, passed_over};
use super::values::{count_too_large, known_number, set_returned, value_after, with_zeros};
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

/// If a run has none of these quirks, skipped lines are not read.
const QUIRKS: [Quirk; 3] =
    [quirk::rs274::SKIPPED_IS_READ, quirk::rs274::SKIPPED_LABELS, quirk::rs274::NUMBER_IN_SUB];

/// Skips the lines after this block and before line `end`, or up to the end of the file.
///
/// Quirk rs274.skipped-is-read. Their length, comments, line numbers, O-words and blocks that begin with M98 are
/// checked. Quirk rs274.skipped-labels. Blocks with the label of the condition or loop whose end is searched for are
/// checked, too. Quirk rs274.number-in-sub. A number alone within a sub counts as the beginning of another sub.
pub(super) fn pass_over(
    control: &mut Control,
    target: SearchTarget<'_>,
    end: Option<u32>,
    state: &mut State,
) -> Result<(), StepError> {
    if !QUIRKS.iter().any(|quirk| state.has_quirk(*quirk)) {
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

/// Reads the skipped lines one by one.
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
            Some(Line::Nothing | Line::Skipped(_)) => {}
            Some(Line::Block(text)) => {
                check_skipped_line(text, target, state).inspect_err(|_| control.place = place)?;
            }
        }
    }
    Ok(())
}

/// Skips lines on the way to the numbered program that M98 calls. A program that was called before is not searched for.
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

/// Line of the next program or sub of this file with this number, in any sub.
fn next_of_number(control: &Control, label: &str) -> Option<u32> {
    let fits = |mark: &&Mark| {
        mark.label.as_deref() == Some(label)
            && matches!(mark.keyword, Keyword::ProgramNumber | Keyword::Sub)
    };
    marks_after(control, control.place.line).iter().find(fits).map(|mark| mark.line)
}

/// Quirk rs274.ends-in-other-subs. Line of the next block after `after` with this label and one of these keywords,
/// in any sub, up to the next numbered program.
pub(super) fn end_in_any_sub(
    control: &Control,
    label: &str,
    keywords: &[Keyword],
    after: u32,
    state: &mut State,
) -> Option<u32> {
    let mut later = marks_after(control, after)
        .iter()
        .take_while(|mark| mark.keyword != Keyword::ProgramNumber)
        .filter(|mark| keywords.contains(&mark.keyword));
    later.find(|mark| mark.has(label, state)).map(|mark| mark.line)
}

/// The O-words of this file after a line.
fn marks_after(control: &Control, line: u32) -> &[Mark] {
    let marks = &control.files.labels(control.place.file).marks;
    &marks[marks.partition_point(|mark| mark.line <= line)..]
}

/// Skips lines on the way to a sub that is defined after its call. Expressions on the way are evaluated as within the
/// sub.
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

/// Checks a skipped line, as far as rs274 does.
fn check_skipped_line(
    text: &str,
    target: SearchTarget<'_>,
    state: &mut State,
) -> Result<(), StepError> {
    let reads = state.has_quirk(quirk::rs274::SKIPPED_IS_READ);
    let in_sub = matches!(target, SearchTarget::EndSub { .. });
    let read = match passed_over(text, state) {
        Ok(read) => read,
        Err(error) if reads && !is_passable(&error, text) => return Err(error),
        Err(error) if reads => return check_comments_after(&error, text, state),
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
            if label.as_deref() == Some(own) && state.has_quirk(quirk::rs274::SKIPPED_LABELS) =>
        {
            own_label(word.keyword, ends)
        }
        SearchTarget::EndSub { .. }
            if word.keyword == Keyword::ProgramNumber
                && state.has_quirk(quirk::rs274::NUMBER_IN_SUB) =>
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
                && state.has_quirk(quirk::rs274::VALUE_AT_DEFINITION) =>
        {
            returned(true, text, state)
        }
        SearchTarget::Called { label: own, .. }
            if label.as_deref() == Some(own)
                && matches!(word.keyword, Keyword::EndSub | Keyword::Return)
                && state.has_quirk(quirk::rs274::VALUE_AT_DEFINITION) =>
        {
            returned(false, text, state)
        }
        SearchTarget::Structure { .. }
        | SearchTarget::EndSub { .. }
        | SearchTarget::Called { .. }
        | SearchTarget::Numbered { .. } => Ok(()),
    }
}

/// Quirk rs274.value-at-definition. A skipped return of a sub that is being defined sets the value parameters. So does
/// a skipped endsub or return of a sub that is searched for after its call. In a definition, named parameters that do
/// not exist have the value zero.
fn returned(in_definition: bool, text: &str, state: &mut State) -> Result<(), StepError> {
    let value = value_after(text, state)?;
    let value = value.map(|value| if in_definition { with_zeros(&value, state) } else { value });
    set_returned(value.as_ref(), state)
}

/// Whether an error of a skipped line is ignored: a right parenthesis outside of a comment is.
fn is_passable(error: &StepError, text: &str) -> bool {
    !matches!(error, StepError::Refused(_)) || after_parenthesis(error, text).is_some()
}

/// Checks the comments after a right parenthesis that is ignored.
fn check_comments_after(error: &StepError, text: &str, state: &mut State) -> Result<(), StepError> {
    let mut rest = after_parenthesis(error, text).map(str::to_owned);
    while let Some(after) = rest.take() {
        // The rest of the line cannot begin with an O-word; a letter before it prevents that.
        let line = format!("x{after}");
        if let Err(error) = passed_over(&line, state) {
            let Some(after) = after_parenthesis(&error, &line) else { return Err(error) };
            rest = Some(after.to_owned());
        }
    }
    Ok(())
}

/// The text after the refused right parenthesis; `None` for another error.
fn after_parenthesis<'a>(error: &StepError, text: &'a str) -> Option<&'a str> {
    let StepError::Refused(refusal) = error else { return None };
    let span = refusal.span?;
    let part = text.get(span.start as usize..span.end as usize);
    text.get(span.end as usize..).filter(|_| part == Some(")"))
}

/// Checks P and L of a skipped M98: the number of the program and the count of turns.
fn numbered_call(text: &str, state: &mut State) -> Result<(), StepError> {
    let block = syntax::parse(text, state)?;
    let words = match evaluate::words(&block, state) {
        // It is not checked that a code uses E.
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

/// Checks a block with the label whose end is searched for, before that end. Blocks that cannot be within the condition
/// or loop of this label are refused. Break and continue may name a while or do; a condition has any number of
/// branches.
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
