//! Subroutines: sub, endsub, return, call.

use gaugeblock_vocabulary::FaultKind;

use super::{Call, Control, Frame, MAIN, Next, Place, SearchTarget, Style, evaluated, o_word};
use crate::ids::{Rule, choice, rule};
use crate::rs274::execute::saved_state;
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Expression, Keyword, OWord};
use crate::rs274::task::Record;

/// Rules subroutines.level-limit, fanuc-subs.level-limit: how many calls may be nested.
const LEVELS: u32 = 10;

/// How many arguments a call takes.
const ARGUMENTS: usize = 30;

/// The rules of subroutines that a controller's dialect may replace.
pub(crate) trait SubroutineRules {
    /// Rule subroutines.unique-name. A second definition is refused; the same one may be reached again.
    fn define_sub(
        &self,
        control: &mut Control,
        label: &str,
        state: &mut State,
    ) -> Result<Next, StepError> {
        if state.call_level() > 0 {
            let message = format!("{} is defined inside another sub", o_word(label));
            return Err(refuse(
                rule::subroutines::NESTED_DEFINITION,
                FaultKind::NestedSub,
                message,
            ));
        }
        if control.subs.get(label).is_some_and(|known| *known != control.place) {
            let message = format!("there is a sub {} already", o_word(label));
            return Err(refuse(rule::subroutines::UNIQUE_NAME, FaultKind::DuplicateSub, message));
        }
        let end = control.define(label, control.place, state)?;
        let next = state.dialect().skip_body(control, end, state)?;
        state.coverage.accepted(rule::subroutines::UNIQUE_NAME);
        Ok(next)
    }

    /// Rule subroutines.body-skipped. The blocks of a sub are not executed where it is defined: the block after its
    /// endsub is next.
    fn skip_body(
        &self,
        control: &mut Control,
        end: u32,
        state: &mut State,
    ) -> Result<Next, StepError> {
        state.coverage.accepted(rule::subroutines::BODY_SKIPPED);
        Ok(Next::At(Place { line: end + 1, ..control.place }))
    }

    /// Whether an endsub with this label ends the sub with the label `own`. By the documents both labels are the same.
    fn ends_sub(&self, own: &str, label: &str, _state: &State) -> bool {
        own == label
    }

    /// Rule subroutines.return. It goes back to the caller at once, as endsub does.
    ///
    /// Rule subroutines.return-label, a choice: whether it must carry the number of its sub.
    fn return_from(
        &self,
        _control: &mut Control,
        label: &str,
        values: &[Expression],
        state: &mut State,
        record: &mut Record,
    ) -> Result<Next, StepError> {
        let own = called_label(rule::subroutines::STRAY_RETURN, state)?;
        if own != label && state.choices.is(choice::subroutines::ReturnLabel::Own) {
            let message =
                format!("a return from {} carries the number {}", o_word(&own), o_word(label));
            return Err(refuse(rule::subroutines::RETURN_LABEL, FaultKind::UnknownLabel, message));
        }
        if own != label {
            state.coverage.accepted(rule::subroutines::RETURN_LABEL);
        }
        state.coverage.accepted(rule::subroutines::RETURN);
        if !state.frame().open.is_empty() {
            state.coverage.accepted(rule::subroutines::RETURN_IN_CONTROL);
        }
        leave_sub(values, state, record)
    }

    /// Rule subroutines.value-cleared. Both value parameters are cleared just before a call.
    fn clear_value_at_call(&self, state: &mut State) {
        clear_value(state);
        state.coverage.accepted(rule::subroutines::VALUE_CLEARED);
    }

    /// A call begins: its first block is next.
    fn enter_call(
        &self,
        _control: &mut Control,
        frame: Frame,
        first: Place,
        state: &mut State,
    ) -> Next {
        state.frames.push(frame);
        Next::At(first)
    }

    /// The sub of a call, if neither a block before the call nor a file defines it. By the documents it is refused.
    ///
    /// Rule subroutines.defined-before-call. A call of a sub that the program defines further on is refused.
    ///
    /// Rule subroutines.unknown-sub. A call of a sub that neither the program nor a file defines is refused.
    ///
    /// Rule fanuc-subs.mixed-o-call. A numbered subprogram is called by M98 only.
    fn sub_after_call(
        &self,
        control: &mut Control,
        label: &str,
        arguments: &[f64],
        state: &mut State,
    ) -> Result<Place, StepError> {
        let (later, number) = control.further_on(label);
        let target = SearchTarget::Called { label, arguments };
        if control.is_numbered(label) {
            state.dialect().pass_over(control, target, number, state)?;
            let message = format!("{} is a numbered program: it is called by M98", o_word(label));
            let rule = rule::fanuc_subs::MIXED_O_CALL;
            return Err(refuse(rule, FaultKind::MixedStyles, message));
        }
        state.dialect().pass_over(control, target, later, state)?;
        if later.is_some() {
            let message = format!("{} is called before its definition", o_word(label));
            let rule = rule::subroutines::DEFINED_BEFORE_CALL;
            return Err(refuse(rule, FaultKind::UnknownSub, message));
        }
        state.coverage.refused(if label.starts_with(|first: char| first.is_ascii_digit()) {
            rule::subroutines::FILE_NUMBERED
        } else {
            rule::subroutines::FILE_CALL
        });
        if control.files.has_elsewhere(&format!("{label}.ngc")) {
            state.coverage.refused(rule::subroutines::FILE_FOLDER);
        }
        let message = format!("neither the program nor a file defines {}", o_word(label));
        Err(refuse(rule::subroutines::UNKNOWN_SUB, FaultKind::UnknownSub, message))
    }

    /// Rule subroutines.file-one-sub. Whether the file of a sub can define others.
    fn allows_other_subs(&self, _state: &State) -> bool {
        false
    }

    /// Rule subroutines.unpassed-arguments. The values of #1 to #30 for which no argument is passed: those of the
    /// caller.
    fn unpassed_arguments(&self, state: &State) -> [f64; 30] {
        state.frame().arguments
    }

    /// Rules subroutines.level-limit, fanuc-subs.level-limit: how many calls can be nested.
    fn most_levels(&self, _state: &State) -> u32 {
        LEVELS
    }
}

impl Control {
    /// The sub and the numbered program with this label that are further on in this file: the line of each.
    pub(crate) fn further_on(&self, label: &str) -> (Option<u32>, Option<u32>) {
        let labels = self.files.labels(self.place.file);
        let behind = |lines: &[u32]| lines.iter().copied().find(|line| *line > self.place.line);
        (behind(labels.subs(label)), behind(labels.numbers(label)))
    }

    /// Whether this file has a numbered program with this label.
    pub(crate) fn is_numbered(&self, label: &str) -> bool {
        !self.files.labels(self.place.file).numbers(label).is_empty()
    }

    /// Records the definition of a sub. Returns the line of its endsub.
    ///
    /// Rule subroutines.missing-endsub. A sub ends with an endsub of its own number.
    ///
    /// Rule subroutines.nested-definition. Its body cannot contain another sub.
    fn define(&mut self, label: &str, place: Place, state: &mut State) -> Result<u32, StepError> {
        let end = self.files.labels_mut(place.file).end_of_defined(label, place.line, state);
        state.dialect().pass_over(self, SearchTarget::EndSub { label }, end, state)?;
        let labels = self.files.labels(place.file);
        let in_loop = state.frame().open.iter().any(|open| open.structure.head() != Keyword::If);
        let until = end.map_or(u32::MAX, |end| end + 1);
        if in_loop && labels.computed_between(place.line - 1, until) {
            let why = "when the number of a sub or endsub is computed, of one defined in a loop";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        if let Some(inner) = labels.sub_between(place.line, end.unwrap_or(u32::MAX)) {
            self.place = Place { line: inner, ..place };
            let message = format!("a sub begins inside {}", o_word(label));
            return Err(refuse(
                rule::subroutines::NESTED_DEFINITION,
                FaultKind::NestedSub,
                message,
            ));
        }
        let Some(end) = end else {
            self.place = place;
            let message = format!("{} sub has no endsub", o_word(label));
            return Err(refuse(rule::subroutines::MISSING_ENDSUB, FaultKind::MissingEnd, message));
        };
        self.subs.insert(label.to_owned(), place);
        Ok(end)
    }

    /// The end of a sub, with its value.
    ///
    /// Rules subroutines.stray-endsub, subroutines.missing-endsub: it ends the sub that is being executed, and
    /// carries its number.
    pub(super) fn end_sub(
        &mut self,
        label: &str,
        values: &[Expression],
        state: &mut State,
        record: &mut Record,
    ) -> Result<Next, StepError> {
        let own = called_label(rule::subroutines::STRAY_ENDSUB, state)?;
        if !state.dialect().ends_sub(&own, label, state) {
            let message = format!("{} sub cannot end with {} endsub", o_word(&own), o_word(label));
            return Err(refuse(
                rule::subroutines::MISSING_ENDSUB,
                FaultKind::UnknownLabel,
                message,
            ));
        }
        leave_sub(values, state, record)
    }

    /// Rule subroutines.call. It executes the body of the sub and goes on with the block after the call.
    pub(super) fn call(
        &mut self,
        label: &str,
        word: &OWord,
        state: &mut State,
    ) -> Result<Next, StepError> {
        let arguments = arguments(&word.arguments, state)?;
        self.call_with(label, &arguments, state)
    }

    /// Calls a sub with arguments that are evaluated.
    ///
    /// # Errors
    /// The sub is not defined. Calls are nested too deep.
    pub(crate) fn call_with(
        &mut self,
        label: &str,
        arguments: &[f64],
        state: &mut State,
    ) -> Result<Next, StepError> {
        let sub = self.found(label, arguments, state)?;
        deeper(rule::subroutines::LEVEL_LIMIT, state)?;
        state.dialect().clear_value_at_call(state);
        if state.call_level() > 0 {
            let recursive = state.frames.iter().any(|frame| frame.is_called(label));
            let rule = if recursive {
                rule::subroutines::RECURSION
            } else {
                rule::subroutines::CALLS_OTHER_SUBS
            };
            state.coverage.accepted(rule);
        }
        state.coverage.accepted(rule::subroutines::CALL);
        state.coverage.accepted(rule::subroutines::CALL_LEVEL);
        let back = Place { line: self.place.line + 1, ..self.place };
        let call = Call { label: label.to_owned(), back, style: Style::OWord };
        let frame =
            Frame { arguments: passed(arguments, state), call: Some(call), ..Frame::default() };
        let first = Place { line: sub.line + 1, ..sub };
        Ok(state.dialect().enter_call(self, frame, first, state))
    }

    /// The sub with this number or name: one of the program, else one in a file.
    ///
    /// Rule subroutines.defined-before-call. A sub of the program can be called only after its definition.
    ///
    /// No document says whether a block that is entered by hand can call a sub of a program that has ended.
    fn found(
        &mut self,
        label: &str,
        arguments: &[f64],
        state: &mut State,
    ) -> Result<Place, StepError> {
        if let Some(sub) = self.subs.get(label) {
            if self.program_is_over && sub.file == MAIN {
                let why = format!("{} of a program that has ended, called by hand", o_word(label));
                return Err(StepError::Unspecified(why));
            }
            state.coverage.accepted(rule::subroutines::DEFINED_BEFORE_CALL);
            state.coverage.accepted(rule::subroutines::UNKNOWN_SUB);
            return Ok(*sub);
        }
        if let Some(sub) = self.in_file(label, state)? {
            return Ok(sub);
        }
        state.dialect().sub_after_call(self, label, arguments, state)
    }

    /// Rules subroutines.file-call, subroutines.file-numbered, subroutines.file-name-case. A sub that the program
    /// does not define is sought in the file of its name, in lower case.
    ///
    /// Rule subroutines.file-folder. A file in another folder does not count.
    ///
    /// Rule subroutines.file-one-sub. That file defines this sub and no other. A missing endsub is found when the
    /// body is executed.
    fn in_file(&mut self, label: &str, state: &mut State) -> Result<Option<Place>, StepError> {
        if label.starts_with('.') || label.contains(['/', '\\']) {
            let why = "a sub without a definition whose name would lead to another folder";
            return Err(StepError::Unspecified(why.to_owned()));
        }
        let name = format!("{label}.ngc");
        let Some(first) = self.files.open(&name, state) else { return Ok(None) };
        let subs: Vec<_> = self.files.labels(first.file).all_subs().collect();
        let own = subs.iter().position(|(_, found)| *found == Some(label));
        let Some(own) = own else {
            let message = format!("the file {name} has no sub {}", o_word(label));
            return Err(refuse(rule::subroutines::FILE_CALL, FaultKind::UnknownSub, message));
        };
        let sub = Place { line: subs[own].0, ..first };
        if subs.len() > 1 && !state.dialect().allows_other_subs(state) {
            if own == 0 {
                self.body_of_file(label, sub, state)?;
            }
            let message =
                format!("the file {name} defines other subs in addition to {}", o_word(label));
            return Err(refuse(rule::subroutines::FILE_ONE_SUB, FaultKind::DuplicateSub, message));
        }
        self.subs.insert(label.to_owned(), sub);
        let numbered = label.starts_with(|first: char| first.is_ascii_digit());
        let rule =
            if numbered { rule::subroutines::FILE_NUMBERED } else { rule::subroutines::FILE_CALL };
        state.coverage.accepted(rule);
        state.coverage.accepted(rule::subroutines::FILE_NAME_CASE);
        if self.files.has_elsewhere(&name) {
            state.coverage.accepted(rule::subroutines::FILE_FOLDER);
        }
        Ok(Some(sub))
    }
}

impl Control {
    /// Rule subroutines.nested-definition. A sub inside the body of the file's sub is refused at its own block.
    fn body_of_file(
        &mut self,
        label: &str,
        sub: Place,
        state: &mut State,
    ) -> Result<(), StepError> {
        let labels = self.files.labels(sub.file);
        let end = labels.find(label, &[Keyword::EndSub], sub.line, sub.line + 1, state);
        let Some(inner) = labels.sub_between(sub.line, end.unwrap_or(u32::MAX)) else {
            return Ok(());
        };
        self.place = Place { line: inner, ..sub };
        let message = format!("a sub begins inside {}", o_word(label));
        Err(refuse(rule::subroutines::NESTED_DEFINITION, FaultKind::NestedSub, message))
    }
}

/// Rule subroutines.arguments. All arguments are evaluated with the parameters of the caller.
///
/// Rule subroutines.argument-limit. More than thirty are refused.
fn arguments(values: &[Expression], state: &mut State) -> Result<Vec<f64>, StepError> {
    if values.len() > ARGUMENTS {
        let message = format!("a call takes up to {ARGUMENTS} arguments, not {}", values.len());
        return Err(refuse(
            rule::subroutines::ARGUMENT_LIMIT,
            FaultKind::TooManyArguments,
            message,
        ));
    }
    let evaluate = |value| evaluated(rule::subroutines::ARGUMENTS, value, state);
    let found: Vec<f64> = values.iter().map(evaluate).collect::<Result<_, _>>()?;
    state.coverage.accepted(rule::subroutines::ARGUMENTS);
    state.coverage.accepted(rule::subroutines::ARGUMENT_LIMIT);
    Ok(found)
}

/// Rule subroutines.unpassed-arguments. From the first one not passed, #1 to #30 have the caller's values.
pub(crate) fn passed(arguments: &[f64], state: &mut State) -> [f64; 30] {
    state.coverage.accepted(rule::subroutines::UNPASSED_ARGUMENTS);
    let mut all = state.dialect().unpassed_arguments(state);
    all[..arguments.len()].copy_from_slice(arguments);
    all
}

/// Rules subroutines.level-limit, fanuc-subs.level-limit. Calls can be nested ten levels deep and no deeper.
pub(crate) fn deeper(rule: Rule, state: &mut State) -> Result<(), StepError> {
    let levels = state.dialect().most_levels(state);
    if state.call_level() >= levels {
        let message = format!("calls can be nested {levels} levels deep");
        return Err(refuse(rule, FaultKind::TooManyLevels, message));
    }
    state.coverage.accepted(rule);
    Ok(())
}

/// The number or name of the sub that is being executed.
///
/// Rules subroutines.stray-endsub, subroutines.stray-return. An endsub or return outside of any sub is refused.
///
/// Rule fanuc-subs.mixed-endsub. A numbered subprogram ends with M99.
fn called_label(rule: Rule, state: &State) -> Result<String, StepError> {
    match &state.frame().call {
        Some(Call { label, style: Style::OWord, .. }) => Ok(label.clone()),
        Some(Call { label, style: Style::Numbered { .. }, .. }) => {
            let message = format!("the numbered subprogram {label} ends with M99");
            Err(refuse(rule::fanuc_subs::MIXED_ENDSUB, FaultKind::MixedStyles, message))
        }
        None => Err(refuse(rule, FaultKind::OutsideSub, "no sub is being executed")),
    }
}

/// Leaves the sub.
///
/// Rules subroutines.parameters-restored, subroutines.local-named-deleted. The frame holds the sub's local
/// parameters; when it is removed, those of the caller apply again.
fn leave_sub(
    values: &[Expression],
    state: &mut State,
    record: &mut Record,
) -> Result<Next, StepError> {
    keep_value(values, state)?;
    saved_state::restore_at_return(state, record)?;
    state.coverage.accepted(rule::subroutines::PARAMETERS_RESTORED);
    state.coverage.accepted(rule::subroutines::PARAMETERS_LOCAL);
    let left = state.frames.pop().and_then(|frame| frame.call);
    Ok(Next::At(left.expect("control: only a called frame is left").back))
}

/// Rules subroutines.return-value, subroutines.no-return-value. The value is evaluated in the sub that ends; without
/// one both value parameters are 0.
pub(crate) fn keep_value(values: &[Expression], state: &mut State) -> Result<(), StepError> {
    match values {
        [] => {
            clear_value(state);
            state.coverage.accepted(rule::subroutines::NO_RETURN_VALUE);
        }
        [value] => {
            state.parameters.returned = evaluated(rule::subroutines::RETURN_VALUE, value, state)?;
            state.parameters.has_returned = true;
            state.coverage.accepted(rule::subroutines::RETURN_VALUE);
            state.coverage.accepted(rule::subroutines::VALUE_KEPT);
        }
        [_, _, ..] => {
            let message = format!("a sub has one value, not {}", values.len());
            return Err(refuse(rule::subroutines::RETURN_VALUE, FaultKind::BadBlock, message));
        }
    }
    Ok(())
}

/// Rule subroutines.value-cleared. Both value parameters are cleared just before the next call.
pub(crate) fn clear_value(state: &mut State) {
    state.parameters.returned = 0.0;
    state.parameters.has_returned = false;
}
