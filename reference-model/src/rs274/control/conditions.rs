//! Conditions: if, elseif, else, endif; and the labels of conditions and loops.

use gaugeblock_vocabulary::FaultKind;

use super::{Control, Next, Open, Place, Structure, condition, o_word};
use crate::ids::{Rule, choice, rule};
use crate::rs274::refusal::{StepError, refuse};
use crate::rs274::state::State;
use crate::rs274::syntax::{Expression, Keyword};

const BRANCHES: &[Keyword] = &[Keyword::ElseIf, Keyword::Else, Keyword::EndIf];

/// The rules of conditions that a controller's dialect may replace.
pub(crate) trait ConditionRules {
    /// Rule control.first-true-only. After a true condition the others of the group are not evaluated.
    fn skip_elseif(
        &self,
        control: &mut Control,
        label: &str,
        _values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        control.at_end(label, state)
    }

    /// Whether the block in progress belongs to the sub, or the main program, that its frame is a call of. Then a label
    /// in the text around the block is a label of this call.
    fn labels_are_of_call(&self, _state: &State) -> bool {
        true
    }
}

impl Control {
    /// Rule control.if. The blocks after the if are executed when its condition is true; else the next branch is tried.
    pub(super) fn if_(
        &mut self,
        label: &str,
        values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        self.refuse_duplicate_label(label, rule::control::DUPLICATE_IF, state)?;
        let taken = condition(rule::control::IF, values, state)?;
        let next = if taken {
            Next::Following
        } else {
            let line = self.end_of_skipped(label, BRANCHES, self.place.line, state)?;
            Next::At(self.line(line))
        };
        self.enter(label, Structure::If { taken }, state);
        Ok(next)
    }

    /// Rule control.elseif. The conditions are tried in order, and the first true one counts.
    ///
    /// Rule control.first-true-only. After a true condition no more of the group are evaluated.
    pub(super) fn else_if(
        &mut self,
        label: &str,
        values: &[Expression],
        state: &mut State,
    ) -> Result<Next, StepError> {
        let Some(taken) = self.branch(label, Keyword::ElseIf, state)? else {
            return self.at_end(label, state);
        };
        if *taken {
            state.coverage.accepted(rule::control::FIRST_TRUE_ONLY);
            return state.dialect().skip_elseif(self, label, values, state);
        }
        let is_true = condition(rule::control::ELSEIF, values, state)?;
        if let Some(taken) = self.branch(label, Keyword::ElseIf, state)? {
            *taken = is_true;
        }
        if is_true { Ok(Next::Following) } else { self.at_branch(label, state) }
    }

    /// Rule control.else. The blocks after the else are executed when no condition of the group was true.
    pub(super) fn else_(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        match self.branch(label, Keyword::Else, state)? {
            Some(taken) if !*taken => {
                *taken = true;
                state.coverage.accepted(rule::control::ELSE);
                Ok(Next::Following)
            }
            Some(_) => {
                state.coverage.accepted(rule::control::ELSE);
                self.at_end(label, state)
            }
            None => self.at_end(label, state),
        }
    }

    /// The end of the group. A condition ends once, unless its label may be followed afterwards.
    pub(super) fn end_if(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        if self.branch(label, Keyword::EndIf, state)?.is_some() {
            self.leave(label, |structure| matches!(structure, Structure::If { .. }), state)?;
        }
        Ok(Next::Following)
    }

    /// Of the open condition with this label: whether a branch of it was taken.
    ///
    /// Choice control.ended-label. None when the condition has ended, and a label may still point to it.
    ///
    /// Rule control.undefined-else. An else or elseif with an undefined label is refused.
    ///
    /// Rule control.unmatched-endif. An else, elseif or endif whose label does not point to a matching if is refused.
    fn branch<'s>(
        &self,
        label: &str,
        keyword: Keyword,
        state: &'s mut State,
    ) -> Result<Option<&'s mut bool>, StepError> {
        let is_if = |structure| matches!(structure, Structure::If { .. });
        if state.frame().find_open(label, is_if).is_some() {
            return Ok(state.frame_mut().open_condition(label));
        }
        if state.frame().ended_conditions.contains(label) {
            let followed = state.choices.is(choice::control::EndedLabel::Followed);
            let message = format!("the condition {} has ended", o_word(label));
            let refusal = refuse(rule::control::UNMATCHED_ENDIF, FaultKind::UnknownLabel, message);
            return if followed { Ok(None) } else { Err(refusal) };
        }
        let defined = self.definitions(label);
        if defined.is_empty() {
            if matches!(keyword, Keyword::Else | Keyword::ElseIf) {
                let message = format!("no if has the label {}", o_word(label));
                return Err(refuse(
                    rule::control::UNDEFINED_ELSE,
                    FaultKind::UnknownLabel,
                    message,
                ));
            }
        } else if defined.iter().any(|definition| definition.keyword == Keyword::If)
            && state.dialect().labels_are_of_call(state)
        {
            let why = format!(
                "the condition {} is in the text, but was not entered by its if",
                o_word(label)
            );
            return Err(StepError::Unspecified(why));
        }
        let message = format!("{} is not an open condition", o_word(label));
        Err(refuse(rule::control::UNMATCHED_ENDIF, FaultKind::UnknownLabel, message))
    }

    /// The block after the skipped rest of a condition: its endif.
    pub(crate) fn at_end(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        let line = self.end_of_skipped(label, &[Keyword::EndIf], self.place.line, state)?;
        Ok(Next::At(self.line(line)))
    }

    /// The next elseif, else or endif of a condition.
    pub(crate) fn at_branch(&mut self, label: &str, state: &mut State) -> Result<Next, StepError> {
        let line = self.end_of_skipped(label, BRANCHES, self.place.line, state)?;
        Ok(Next::At(self.line(line)))
    }

    /// Refuses the label of a condition or loop if another block of the sub defines it, or if it is the number of the
    /// sub.
    ///
    /// Choice control.skipped-definition. Under one option only an executed block defines a label. The documents do not
    /// say whether a block counts that was executed in an earlier call of the sub: the block is then unspecified.
    pub(super) fn refuse_duplicate_label(
        &mut self,
        label: &str,
        rule: Rule,
        state: &mut State,
    ) -> Result<(), StepError> {
        self.refuse_number_of_sub(label, rule, state)?;
        if self.find_other_definition(label, state).is_none() {
            return Ok(());
        }
        let executed = state.choices.is(choice::control::SkippedDefinition::DoesNotCount);
        if executed && !state.frame().has_met(label) && state.dialect().labels_are_of_call(state) {
            let why = format!("{} has been defined in another call of its sub", o_word(label));
            return Err(StepError::Unspecified(why));
        }
        Err(duplicate(label, rule))
    }

    /// Choice control.sub-number-as-label: whether a condition or loop may carry the number of the sub around it.
    pub(super) fn refuse_number_of_sub(
        &self,
        label: &str,
        rule: Rule,
        state: &State,
    ) -> Result<(), StepError> {
        let own = state.frame().is_called(label);
        if own && state.choices.is(choice::control::SubNumberAsLabel::Refused) {
            return Err(duplicate(label, rule));
        }
        Ok(())
    }

    /// The line of the first block that defines a label in this sub, if that is not the current block.
    ///
    /// Rule control.labels-in-subs. Each sub, and the main program, may define the same label.
    ///
    /// Choice control.skipped-definition: whether the first definition is the first one in the text, or the first one
    /// that is executed.
    pub(super) fn find_other_definition(&mut self, label: &str, state: &mut State) -> Option<u32> {
        let Place { file, line: here } = self.place;
        let labels = self.files.labels(file);
        if labels.is_shared(label) {
            state.coverage.accepted(rule::control::LABELS_IN_SUBS);
        }
        let scope = labels.scope(state.frame().numbered_line().unwrap_or(here));
        let counts = state.choices.is(choice::control::SkippedDefinition::Counts);
        let in_text = labels.definitions(label, here).first().map(|definition| definition.line);
        let earlier = in_text.filter(|line| counts && *line < here);
        let executed = *self.defined.entry((file, scope, label.to_owned())).or_insert(here);
        earlier.or((executed != here).then_some(executed))
    }

    /// The blocks that define a label in the sub of the current block.
    pub(super) fn definitions(&self, label: &str) -> &[super::labels::Definition] {
        self.files.labels(self.place.file).definitions(label, self.place.line)
    }

    /// Begins a condition or loop whose first block is the current one.
    ///
    /// Rule control.nesting. Conditions and loops can be inside each other, each with its own label.
    pub(crate) fn enter(&self, label: &str, structure: Structure, state: &mut State) {
        self.enter_at(self.place.line, label, structure, state);
    }

    /// Begins a condition or loop whose first block is at `line`.
    pub(super) fn enter_at(&self, line: u32, label: &str, structure: Structure, state: &mut State) {
        let frame = state.frame_mut();
        let nested = !frame.open.is_empty();
        let open = Open { label: label.to_owned(), line, structure };
        frame.open.push(open);
        if nested {
            state.coverage.accepted(rule::control::NESTING);
        }
    }

    /// Ends a condition or loop. It must be the innermost one: the documents leave overlaps open.
    pub(crate) fn leave(
        &self,
        label: &str,
        kind: impl Fn(Structure) -> bool,
        state: &mut State,
    ) -> Result<(), StepError> {
        let frame = state.frame_mut();
        if frame.find_open(label, kind).map(|place| place + 1) != Some(frame.open.len()) {
            let why = format!(
                "{} ends while a condition or loop that began inside it is open",
                o_word(label)
            );
            return Err(StepError::Unspecified(why));
        }
        if let Some(open) = frame.open.pop() {
            frame.end(open);
        }
        Ok(())
    }
}

/// The refusal of a label that another block defines.
pub(super) fn duplicate(label: &str, rule: Rule) -> StepError {
    let message = format!("the label {} is defined elsewhere", o_word(label));
    refuse(rule, FaultKind::DuplicateLabel, message)
}
