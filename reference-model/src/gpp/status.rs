//! Set status: what turns a variable on, and what turns it off.

use std::collections::BTreeSet;

use gaugeblock_vocabulary::FaultKind;

use super::refusal::{StepError, refuse};
use super::run::Run;
use super::syntax::Target;
use super::variables::{Class, Value};
use crate::ids::choice::gpp::AssignedAgain;
use crate::ids::{choice, rule};

impl Run<'_> {
    /// Rules gpp.first-assignment and gpp.assigned. A statement assigns a value: the first one turns the variable on.
    ///
    /// # Errors
    /// The value has no text in a format.
    pub(super) fn assign(
        &mut self,
        variable: usize,
        cell: usize,
        value: Value,
    ) -> Result<(), StepError> {
        let is_first = self.variables.cells[cell].value.is_none();
        let is_changed = self.set_value(variable, cell, value)?;
        if is_first {
            self.coverage.accepted(rule::gpp::FIRST_ASSIGNMENT);
        }
        let again = match self.choices.get::<AssignedAgain>() {
            AssignedAgain::IfChanged => is_changed,
            AssignedAgain::Always => true,
            AssignedAgain::FirstOnly => false,
        };
        if is_first || again {
            self.turn(variable, cell, true);
        }
        Ok(())
    }

    /// Rules gpp.changed and gpp.presence. The toolpath gives a system variable a value. One of the class change goes
    /// on if its value is another one, one of the class presence because it is there.
    ///
    /// # Errors
    /// The value has no text in a format.
    pub(super) fn receive(&mut self, variable: usize, value: Value) -> Result<(), StepError> {
        let declared = &self.variables.all[variable];
        let (cell, class) = (declared.cell, declared.class);
        let is_first = self.variables.cells[cell].value.is_none();
        let is_changed = self.set_value(variable, cell, value)?;
        match class {
            Some(Class::Presence) => {
                self.coverage.accepted(rule::gpp::PRESENCE);
                self.turn(variable, cell, true);
            }
            Some(Class::Change) | None => {
                if !is_first {
                    self.coverage.accepted(rule::gpp::CHANGED);
                }
                if is_first || is_changed {
                    self.turn(variable, cell, true);
                }
            }
        }
        Ok(())
    }

    /// Rule gpp.presence. What the next block of the toolpath does not include goes off, whatever it was.
    pub(super) fn leave_out(&mut self, included: &[(usize, Value)]) {
        let included: BTreeSet<usize> = included.iter().map(|(place, _)| *place).collect();
        let left_out = |place: &usize| {
            let is_presence = self.variables.all[*place].class == Some(Class::Presence);
            is_presence && !included.contains(place)
        };
        let all: Vec<usize> = (0..self.variables.all.len()).filter(left_out).collect();
        for variable in all {
            let cell = self.variables.all[variable].cell;
            self.turn(variable, cell, false);
        }
    }

    /// Rule gpp.changed-by-format. Sets a value; whether it is another one is told by the text in the variable's
    /// format. All that are identical have it, each in a format of its own.
    fn set_value(&mut self, variable: usize, cell: usize, value: Value) -> Result<bool, StepError> {
        let tie = self.choices.get::<choice::gpp::Tie>();
        let sharing = self.variables.of_cell(cell);
        for place in &sharing {
            self.variables.text(*place, &value, tie).map_err(|_| too_long())?;
        }
        if sharing.len() > 1 {
            self.coverage.accepted(rule::gpp::IDENTICAL);
        }
        let text = |value: &Value| self.variables.text(variable, value, tie).ok();
        let (before, now) = (self.variables.cells[cell].value.as_ref(), &value);
        let is_changed = before.and_then(text) != text(now);
        if before.is_some_and(|before| before != now) && matches!(value, Value::Number(_)) {
            self.coverage.accepted(rule::gpp::CHANGED_BY_FORMAT);
        }
        self.variables.cells[cell].value = Some(value);
        self.record.touch(cell);
        Ok(is_changed)
    }

    /// Rules gpp.set-on and gpp.set-off. The flag is switched, and the value stays.
    ///
    /// # Errors
    /// An index that cannot be evaluated, or leads to no member.
    pub(super) fn switch(&mut self, target: &Target, on: bool) -> Result<(), StepError> {
        let cells: Vec<(usize, usize)> = match target {
            Target::Variable(reference) => {
                vec![(reference.variable, self.cell(reference)?)]
            }
            Target::Array(variable) => self.members(*variable),
            Target::All => (0..self.variables.all.len()).flat_map(|v| self.members(v)).collect(),
        };
        for (variable, cell) in cells {
            self.coverage.accepted(if on { rule::gpp::SET_ON } else { rule::gpp::SET_OFF });
            if !on && !self.variables.all[variable].modal {
                self.coverage.accepted(rule::gpp::NON_MODAL_OFF);
            }
            self.turn(variable, cell, on);
        }
        Ok(())
    }

    /// The cells of a variable, each with the variable's place.
    fn members(&self, variable: usize) -> Vec<(usize, usize)> {
        let declared = &self.variables.all[variable];
        let members = usize::try_from(declared.size.unwrap_or(1)).unwrap_or(usize::MAX);
        (0..members).map(|member| (variable, declared.cell + member)).collect()
    }

    /// Rules gpp.set-flag, gpp.member-flag, gpp.identical-on and gpp.identical-off. Each variable has a flag, and
    /// each member of an array its own; identical variables have one together.
    pub(super) fn turn(&mut self, variable: usize, cell: usize, on: bool) {
        let is_member = self.variables.all[variable].size.is_some();
        self.coverage.accepted(if is_member {
            rule::gpp::MEMBER_FLAG
        } else {
            rule::gpp::SET_FLAG
        });
        if self.variables.is_shared(cell) {
            self.coverage.accepted(if on {
                rule::gpp::IDENTICAL_ON
            } else {
                rule::gpp::IDENTICAL_OFF
            });
        }
        // Nothing here asks for the modality: OUTPUT and PRINT alone do.
        self.coverage.accepted(rule::gpp::ONLY_PRINTING);
        self.variables.cells[cell].on = on;
        self.record.touch(cell);
    }
}

/// Rule gpp.number-format. More digits before the point than the format has are no number of it.
pub(super) fn too_long() -> StepError {
    let message = "more digits before the point than the format has";
    refuse(rule::gpp::NUMBER_FORMAT, FaultKind::NumberTooLong, message)
}
