//! A run: lines of the toolpath, and after each the statements of its block, a step at a time.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Channel, Effect};

use super::choices::AssignedAgain;
use super::evaluate::{Stack, StatementError, too_long};
use super::program::{IndexRange, Source, Statement, Target, Test, VariableRef};
use super::runner::{Next, Runner};
use super::statement_end::{File, StatementEnd};
use super::toolpath::Value;
use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};

/// Where a statement was refused, and why.
pub(super) type LocatedError = (File, u32, StatementError);

impl Runner {
    /// Goes on to the next step; whether there is one.
    pub(super) fn advance(&mut self) -> bool {
        loop {
            self.next = match self.next {
                Next::Warning(place) if place < self.program.warnings.len() => return true,
                Next::Warning(_) => Next::Line(0),
                Next::Line(place) if place < self.lines.len() => return true,
                Next::Line(line) => match self.program.newline.filter(|_| self.newline_waits) {
                    Some(at) => {
                        self.newline_waits = false;
                        Next::Statement { at, line }
                    }
                    None => Next::Over,
                },
                Next::Statement { at, line } => match self.program.statements.get(at) {
                    Some(Statement::Jump(to)) => Next::Statement { at: *to, line },
                    Some(Statement::End) | None if self.printing.waits => Next::Rest { line },
                    Some(Statement::End) | None => Next::Line(line),
                    Some(_) => return true,
                },
                Next::Rest { .. } => return true,
                Next::Over => return false,
            };
        }
    }

    /// Nothing comes any more.
    pub(super) fn stop(&mut self) {
        self.next = Next::Over;
    }

    /// Makes a step; nothing where there is none.
    pub(super) fn step<S: Sink>(&mut self, sink: &mut S) -> Result<u64, LocatedError> {
        if !self.advance() {
            return Ok(0);
        }
        self.variables.begin();
        self.printed = 0;
        let (file, line) = match self.next {
            Next::Warning(place) => {
                let warning = self.program.warnings.get(place);
                let (line, text) = warning.map_or((0, ""), |(line, text)| (*line, text.as_str()));
                report_warning(sink, line, format!("warning: {text}"));
                self.next = Next::Warning(place.saturating_add(1));
                sink.end_statement(&StatementEnd::of_warning(line));
                return Ok(1);
            }
            Next::Line(place) => {
                let line = self.lines.get(place).map_or(0, |line| line.line);
                self.toolpath(place).map_err(|refused| (File::Toolpath, line, refused))?;
                (File::Toolpath, line)
            }
            Next::Statement { at, line: after } => {
                let Some(statement) = self.program.statements.get(at).copied() else {
                    return Ok(0);
                };
                let line = statement.line();
                self.statement(statement, at, after, sink)
                    .map_err(|refused| (File::Program, line, refused))?;
                (File::Program, line)
            }
            Next::Rest { line: after } => {
                let line = self.printing.line;
                self.rest(after, sink).map_err(|refused| (File::Program, line, refused))?;
                (File::Program, line)
            }
            Next::Over => return Ok(0),
        };
        let is_first = !core::mem::replace(&mut self.has_reply, true);
        sink.end_statement(&StatementEnd::new(file, line, &self.variables, is_first));
        let set = u64::try_from(self.variables.set_in_step()).unwrap_or(u64::MAX);
        Ok(set.saturating_add(self.printed).saturating_add(1))
    }

    /// A line of the toolpath.
    fn toolpath(&mut self, place: usize) -> Result<(), StatementError> {
        let Some(line) = self.lines.get_mut(place) else { return Ok(()) };
        let sets = core::mem::take(&mut line.sets);
        let block = line.block;
        let done = self.set_systems(&sets);
        if let Some(line) = self.lines.get_mut(place) {
            line.sets = sets;
        }
        let after = place.saturating_add(1);
        self.next = match block {
            Some(at) => Next::Statement { at, line: after },
            None => Next::Line(after),
        };
        done
    }

    fn set_systems(&mut self, sets: &[(usize, Value)]) -> Result<(), StatementError> {
        if !planted(PlantedFault::PresenceStays) {
            // Both are in order: one pass over the variables is enough.
            let mut named: Vec<usize> = sets.iter().map(|(system, _)| *system).collect();
            named.sort_unstable();
            let mut named = named.into_iter().peekable();
            for (place, system) in self.systems.iter().enumerate() {
                if named.next_if_eq(&place).is_none() && system.presence {
                    self.variables.switch(place, false);
                }
            }
        }
        for (system, value) in sets {
            let had_value = self.variables.has_value(*system);
            let changed = self.put(*system, value)?;
            let presence = self.systems.get(*system).is_some_and(|system| system.presence);
            if presence || changed || !had_value {
                self.variables.switch(*system, true);
            }
        }
        Ok(())
    }

    fn put(&mut self, slot: usize, value: &Value) -> Result<bool, StatementError> {
        match value {
            Value::Number(number) => self
                .variables
                .set_number(slot, *number, &self.formats, self.choices.tie_even)
                .map_err(too_long),
            Value::Text(text) => Ok(self.variables.set_text(slot, text)),
        }
    }

    /// A statement, and what comes after it.
    fn statement<S: Sink>(
        &mut self,
        statement: Statement,
        at: usize,
        after: usize,
        sink: &mut S,
    ) -> Result<(), StatementError> {
        let follows = Next::Statement { at: at.saturating_add(1), line: after };
        self.next = match statement {
            Statement::Assign { to, source, .. } => {
                self.assign(to, source)?;
                follows
            }
            Statement::Switch { on, targets, .. } => {
                self.switch(on, targets)?;
                follows
            }
            Statement::Test { line, tests, otherwise, warns } => {
                let holds = self.tests(line, tests, warns, sink)?;
                if holds { follows } else { Next::Statement { at: otherwise, line: after } }
            }
            Statement::Print { line, items, is_output } => {
                if self.print((line, at), (items, is_output), sink)? {
                    follows
                } else {
                    self.procedure(after)
                }
            }
            Statement::Jump(_) | Statement::End => follows,
        };
        Ok(())
    }

    /// The newline procedure comes next.
    fn procedure(&self, after: usize) -> Next {
        match self.program.newline {
            Some(at) => Next::Statement { at, line: after },
            None => Next::Rest { line: after },
        }
    }

    /// The rest of an OUTPUT, up to the next newline.
    fn rest<S: Sink>(&mut self, after: usize, sink: &mut S) -> Result<(), StatementError> {
        let at = self.printing.at;
        self.next = if self.print_rest(sink)? {
            Next::Statement { at: at.saturating_add(1), line: after }
        } else {
            self.procedure(after)
        };
        Ok(())
    }

    fn assign(&mut self, to: VariableRef, source: Source) -> Result<(), StatementError> {
        let mut stack = core::mem::take(&mut self.stack);
        stack.clear();
        let slot = self.evaluator().slot(to, &mut stack);
        let done = slot.and_then(|slot| self.assign_slot(slot, source, &mut stack));
        self.stack = stack;
        done
    }

    fn assign_slot(
        &mut self,
        slot: usize,
        source: Source,
        stack: &mut Stack,
    ) -> Result<(), StatementError> {
        let had_value = self.variables.has_value(slot);
        let is_text = self.variables.variable_of(slot).is_some_and(|one| one.is_text());
        let changed = if is_text {
            // The text of a variable may change in place, so that it is copied.
            let mut copy = core::mem::take(&mut self.text);
            copy.clear();
            let text = self.evaluator().text(source, stack).map(|text| copy.push_str(text));
            let changed = text.map(|()| self.variables.set_text(slot, &copy));
            self.text = copy;
            changed?
        } else {
            let number = self.evaluator().source(source, stack)?.0;
            self.put(slot, &Value::Number(number))?
        };
        let goes_on = match self.choices.assigned_again {
            _ if !had_value => !planted(PlantedFault::FirstStaysOff),
            AssignedAgain::IfChanged => changed,
            AssignedAgain::Always => true,
            AssignedAgain::FirstOnly => false,
        };
        if goes_on {
            self.variables.switch(slot, true);
        }
        Ok(())
    }

    fn switch(&mut self, on: bool, targets: IndexRange) -> Result<(), StatementError> {
        self.stack.clear();
        for place in targets.from..targets.to {
            match self.program.targets.get(place).copied() {
                Some(Target::All) => {
                    for slot in 0..self.variables.slots.len() {
                        self.variables.switch(slot, on);
                    }
                }
                Some(Target::Array(variable)) => {
                    let Some(array) = self.variables.variables.get(variable) else { continue };
                    let size = array.size.unwrap_or_default();
                    let size = if planted(PlantedFault::FirstMemberOnly) { 1 } else { size };
                    let first = array.first;
                    for slot in first..first.saturating_add(size) {
                        self.variables.switch(slot, on);
                    }
                }
                Some(Target::VariableRef(place)) => {
                    let mut stack = core::mem::take(&mut self.stack);
                    let slot = self.evaluator().slot(place, &mut stack);
                    self.stack = stack;
                    self.variables.switch(slot?, on);
                }
                None => {}
            }
        }
        Ok(())
    }

    /// Whether all tests hold, up to the first that does not.
    fn tests<S: Sink>(
        &mut self,
        line: u32,
        tests: IndexRange,
        warns: bool,
        sink: &mut S,
    ) -> Result<bool, StatementError> {
        let mut stack = core::mem::take(&mut self.stack);
        stack.clear();
        let evaluator = self.evaluator();
        let mut holds = Ok(true);
        for test in tests.of(&self.program.tests) {
            holds = evaluator.holds(test, &mut stack);
            if let (true, Test::Flag { place, .. }, Ok(_)) = (warns, test, &holds)
                && let Ok(slot) = evaluator.slot(*place, &mut stack)
            {
                let name = self.variables.name_of(slot);
                report_warning(sink, line, format!("warning: {name} is not modal"));
            }
            if !matches!(holds, Ok(true)) {
                break;
            }
        }
        self.stack = stack;
        holds
    }
}

impl Statement {
    fn line(self) -> u32 {
        match self {
            Self::Assign { line, .. }
            | Self::Print { line, .. }
            | Self::Switch { line, .. }
            | Self::Test { line, .. } => line,
            Self::Jump(_) | Self::End => 0,
        }
    }
}

/// Reports a warning.
pub(super) fn report_warning<S: Sink>(sink: &mut S, line: u32, text: String) {
    let _reply = sink.perform(line, &Effect::Message { channel: Channel::Display, text });
}
